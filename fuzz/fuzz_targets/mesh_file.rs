#![no_main]

#[path = "../tool/mod.rs"]
mod tool;

libfuzzer_sys::fuzz_target!(|data: &[u8]| tool::mesh_file::run(data));
