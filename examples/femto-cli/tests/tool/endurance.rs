//! The short form of the program `endurance`: a second of its scenes.

use femto_cli::endurance::{Case, Outcome, run};

fn short(scene: &'static str, iterations: u32, seconds: f64) -> Outcome {
    let case = Case {
        scene,
        iterations,
        rigid: false,
        seconds,
        settled: None,
    };
    let outcome = run(&case).expect("a scene that runs");
    assert!(
        outcome.wrong().is_empty(),
        "{case:?}: {:?}",
        outcome.wrong()
    );
    outcome
}

#[test]
fn a_snowman_falls_and_hits_the_ground() {
    for iterations in [1, 5] {
        let outcome = short("snowman", iterations, 1.0);
        assert!(outcome.free > 20, "{outcome:?}");
        assert!(outcome.lost > 0.01, "{outcome:?}");
    }
}

#[test]
fn a_tower_settles() {
    let outcome = short("tower", 5, 1.0);
    assert!(
        outcome.stored > 0.0 && outcome.friction > 0.0,
        "{outcome:?}"
    );
}

#[test]
fn a_ball_hits_pins() {
    // (With two iterations the law of closed contacts gives back a little more than what they have taken by then.)
    let outcome = short("bowling", 5, 0.2);
    assert!(outcome.lost > 0.01 && outcome.contact > 0.0, "{outcome:?}");
}

#[test]
fn what_does_not_hold_is_named() {
    let asked = Outcome {
        asked: 10,
        steps: 10,
        ..Outcome::default()
    };
    assert!(asked.wrong().is_empty());
    let bad = |change: fn(&mut Outcome)| {
        let mut outcome = asked;
        change(&mut outcome);
        outcome.wrong().concat()
    };
    assert!(bad(|o| o.steps = 9).contains("not made"));
    assert!(bad(|o| o.free_error = 1e-6).contains("in the air"));
    assert!(bad(|o| o.drift = Some(1e-5)).contains("drift"));
    assert!(bad(|o| o.rise = f64::NAN).contains("energy"));
    assert!(bad(|o| o.depth = 1e-4).contains("depth"));
    assert!(bad(|o| o.dropped = 1).contains("dropped"));
    assert!(bad(|o| o.creep = Some(0.01)).contains("creep"));
}

#[test]
fn every_scene_of_the_folder_runs() {
    let scenes = [
        "bodies",
        "bowling",
        "cantilever",
        "cars",
        "clay",
        "snowman",
        "tear",
        "tower",
        "twist",
    ];
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");
    let files = std::fs::read_dir(folder).expect("the folder of scenes");
    let names = files.map(|f| f.expect("a file").file_name().into_string());
    let count = names.filter(|n| n.as_ref().is_ok_and(|n| n.ends_with(".toml")));
    assert_eq!(count.count(), scenes.len());
    for scene in scenes {
        let case = Case {
            scene,
            iterations: 5,
            rigid: false,
            seconds: 0.03,
            settled: None,
        };
        let outcome = run(&case).expect("a scene that runs");
        assert!(
            outcome.steps >= 4 && outcome.steps == outcome.asked,
            "{outcome:?}"
        );
    }
}
