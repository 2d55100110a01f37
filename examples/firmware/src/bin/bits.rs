//! The scenes of every kind, against the golden hashes of `examples/cases/golden.txt`.
//!
//! `bits [SHORT]`: all scenes to 1,000 steps; where SHORT is given, the first one to 1,000 and the others
//! to so many (soft float takes its time).
#![no_std]
#![no_main]

use femto_cases::scenes::{Bodies, STEPS, check};
use femto_firmware::{Once, entry, report_panics};
use semihosting::{experimental::env, println, process};

static BODIES: Once<Bodies> = Once::new(Bodies::new());
report_panics!();

#[entry]
fn main() -> ! {
    let short = env::args::<128>()
        .ok()
        .and_then(|arguments| (&arguments).nth(1)?.ok()?.parse().ok())
        .unwrap_or(STEPS);
    // SAFETY: here only, and `main` runs once.
    let bodies = unsafe { BODIES.take() };
    let steps = |name: [&str; 2]| {
        if name == ["scene", "spin"] {
            STEPS
        } else {
            short
        }
    };
    let wrong = check(
        bodies,
        |case| steps(case.name),
        |case, step, hash, right| {
            let [kind, name] = case.name;
            if !right {
                println!("{kind} {name} {step} {hash:016x} WRONG");
            }
        },
    );
    println!("{wrong} hashes differ, the first scene to {STEPS} steps, the others to {short}");
    process::exit(i32::from(wrong > 0))
}
