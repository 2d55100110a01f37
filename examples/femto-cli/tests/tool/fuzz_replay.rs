//! What the fuzzer has found interesting in the tool's readers, replayed: `fuzz/corpus` through the functions of
//! `fuzz/tool`.

use std::fs;
use std::path::Path;

#[path = "../../../../fuzz/tool/mod.rs"]
mod tool;

fn replay(target: &str, run: fn(&[u8])) {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus");
    let mut files: Vec<_> = fs::read_dir(corpus.join(target))
        .expect("a corpus")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    assert!(!files.is_empty(), "{target} has no corpus");
    files.sort();
    for file in files {
        println!("{}", file.display());
        run(&fs::read(&file).expect("a readable file"));
    }
}

#[test]
fn scene_files() {
    replay("scene_file", tool::scene_file::run);
}

#[test]
fn mesh_files() {
    replay("mesh_file", tool::mesh_file::run);
}
