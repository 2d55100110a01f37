//! What the fuzz targets of the tool check, as plain functions of bytes that panic where something is wrong.

#![allow(dead_code, reason = "each target uses a part of it")]

#[path = "../src/bytes.rs"]
mod bytes;
pub mod mesh_file;
pub mod scene_file;

/// One line of text, without what a terminal would obey.
fn check_line(line: &str) {
    assert!(!line.trim().is_empty(), "an error without a word");
    assert!(!line.chars().any(char::is_control), "{line:?}");
}
