//! Runs the scenes of every kind for 1,000 steps and compares their hashes with `golden.txt`.
//!
//! `bits [STEPS [SCENE]]` checks, all scenes or one to so many steps if not to 1,000; `bits --bless` writes the file
//! anew, with the feature `guard`, so that it has the scene of that.

use std::fmt::Write;
use std::process::ExitCode;

use femto_cases::scenes::{Bodies, STEPS, cases, check, run};

fn main() -> ExitCode {
    let mut bodies = Box::new(Bodies::new());
    if std::env::args().any(|argument| argument == "--bless") {
        return bless(&mut bodies);
    }
    let steps = std::env::args()
        .nth(1)
        .and_then(|steps| steps.parse().ok())
        .unwrap_or(STEPS);
    let only = std::env::args().nth(2);
    let chosen = |name: &str| only.as_ref().is_none_or(|only| only == name);
    let mut checked = 0;
    let wrong = check(
        &mut bodies,
        |case| if chosen(case.name[1]) { steps } else { 0 },
        |case, step, hash, right| {
            let [kind, name] = case.name;
            checked += 1;
            let verdict = if right { "" } else { " WRONG" };
            println!("{kind} {name} {step} {hash:016x}{verdict}");
        },
    );
    println!(
        "{wrong} of {checked} hashes differ, to {steps} steps, {} lanes",
        <femto::lane::Native as femto::lane::Lanes>::WIDTH
    );
    ExitCode::from(u8::from(wrong > 0 || checked == 0))
}

/// Writes the hashes of this build, if a replay after a snapshot has those of the run without.
fn bless(bodies: &mut Bodies) -> ExitCode {
    if !cfg!(feature = "guard") {
        eprintln!("not all scenes are there without the feature guard");
        return ExitCode::FAILURE;
    }
    let mut text = String::new();
    for case in cases() {
        let [kind, name] = case.name;
        let ran = run(&case, bodies, STEPS, |step, hash| {
            _ = writeln!(text, "{kind} {name} {step} {hash:016x}");
        });
        if ran.is_err() {
            eprintln!("{kind} {name} does not run");
            return ExitCode::FAILURE;
        }
    }
    let of = |name: &str| -> Vec<String> {
        let lines = text.lines().filter_map(|line| line.strip_prefix(name));
        lines.map(str::to_string).collect()
    };
    if of("scene snapshot ") != of("scene contact ") {
        eprintln!("a replay after a snapshot gives other bits");
        return ExitCode::FAILURE;
    }
    match std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/golden.txt"), text) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("golden.txt: {error}");
            ExitCode::FAILURE
        }
    }
}
