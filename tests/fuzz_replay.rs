//! What the fuzzer has found interesting, replayed: `fuzz/corpus` through the functions of `fuzz/src`.
#![cfg(not(miri))]

use std::fs;
use std::path::Path;

#[path = "../fuzz/src/lib.rs"]
mod fuzz;

fn replay(target: &str, run: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("fuzz/corpus")
        .join(target);
    let entries =
        fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<_> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    assert!(!files.is_empty(), "{} is empty", folder.display());
    files.sort();
    for file in files {
        println!("{}", file.display());
        run(&fs::read(&file).expect("a readable file"));
    }
}

#[test]
fn asset() {
    replay("asset", fuzz::asset::run);
}

#[test]
fn mesh() {
    replay("mesh", fuzz::mesh::run);
}

#[test]
fn polar() {
    replay("polar", fuzz::polar::run);
}

#[test]
fn step() {
    replay("step", fuzz::step::run);
}

#[test]
fn parts() {
    replay("parts", fuzz::parts::run);
}

#[test]
fn coupled() {
    replay("coupled", fuzz::coupled::run);
}
