//! `femto suggest`: what it prints is measured, ordered, and fits into a scene file.

use crate::support::{BEAM, Folder, Run};

#[test]
fn longer_budgets_are_listed_only_where_they_are_better() {
    let folder = Folder::new();
    folder.write("beam.toml", BEAM);
    let run = folder
        .femto(&["suggest", "beam.toml", "--steps", "10"])
        .succeeds();
    assert!(run.out.contains("h²E/(ρ dx²) = "), "{}", run.out);
    let rows: Vec<(f64, f64)> = run
        .out
        .lines()
        .filter(|line| line.contains(" × ") && line.contains('%'))
        .map(|line| {
            let words: Vec<&str> = line.split_whitespace().collect();
            (words[0].parse().unwrap(), words[1].parse().unwrap())
        })
        .collect();
    assert!(rows.len() > 2, "{}", run.out);
    for pair in rows.windows(2) {
        assert!(pair[0].0 <= pair[1].0 && pair[0].1 > pair[1].1, "{pair:?}");
    }
    // A suggestion, pasted in front of the scene, runs.
    let line = run
        .out
        .lines()
        .find(|line| line.contains("budget = "))
        .unwrap();
    let (_, settings) = line.split_once(": ").unwrap();
    let settings = settings.replace(", solver = ", "\nsolver = ");
    folder.run(&format!("{settings}\n{BEAM}"), &[]).succeeds();
}

#[test]
fn a_bad_scene_is_an_error() {
    let folder = Folder::new();
    folder.write("bad.toml", BEAM.replace("young = 1e5", "young = -1"));
    fails(folder.femto(&["suggest", "bad.toml"]), "young");
    fails(folder.femto(&["suggest", "nothing.toml"]), "nothing.toml");
    folder.write("still.toml", BEAM.replace("steps = 10", "steps = 0"));
    let nothing = "still.toml: time.steps = 0: there is nothing to measure";
    fails(folder.femto(&["suggest", "still.toml"]), nothing);
    folder.write("beam.toml", BEAM);
    fails(
        folder.femto(&["suggest", "beam.toml", "--steps", "0"]),
        "--steps",
    );
}

fn fails(run: Run, names: &str) {
    assert_eq!(run.status, 2);
    assert!(run.err.contains(names), "{}", run.err);
}
