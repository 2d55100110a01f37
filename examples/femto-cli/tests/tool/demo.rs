//! `femto` without arguments.

use crate::support::{Folder, table};

#[test]
fn the_built_in_scene_runs_and_fits_one_screen() {
    let folder = Folder::new();
    let run = folder.femto(&[]).succeeds();
    for word in [
        "509 nodes",
        "1,716 tets",
        "a step",
        "memory",
        "error",
        "energy",
        "femto-out/preview.svg",
    ] {
        assert!(run.out.contains(word), "{word}: {}", run.out);
    }
    assert!(run.out.lines().count() <= 24, "{}", run.out);
    assert!(
        run.out.lines().all(|line| line.chars().count() <= 80),
        "{}",
        run.out
    );
    for file in ["final.csv", "trace.csv", "report.json", "preview.svg"] {
        assert!(folder.path("femto-out").join(file).exists(), "{file}");
    }
    assert!(
        folder
            .read("femto-out/report.json")
            .contains("\"ended\": \"completed\"")
    );
    // Falls, and topples: the head ends low and to the side.
    let (_, rows) = table(&folder.read("femto-out/final.csv"));
    assert!(rows.iter().all(|row| row[3] < 0.75), "it no longer stands");
}
