//! Runs the scenes for ten seconds each at several budgets, a tower for longer, and checks what must hold.
//!
//! `cargo run --release -p femto-cli --example endurance [SCENE[/ITERATIONS[/START]]...]`; exit status 1 if anything does not.

use std::process::ExitCode;

use femto_cli::endurance::{Case, Outcome, run};

const BUDGETS: [u32; 4] = [1, 2, 5, 10];

fn main() -> ExitCode {
    let only: Vec<String> = std::env::args().skip(1).collect();
    let mut cases = Vec::new();
    for scene in ["snowman", "bowling", "cars"] {
        cases.extend(BUDGETS.map(|iterations| Case {
            scene,
            iterations,
            rigid: false,
            seconds: 10.0,
            settled: None,
        }));
    }
    // Nothing but the start keeps spin where a solve is stopped early.
    cases.extend(BUDGETS.map(|iterations| Case {
        scene: "cars",
        iterations,
        rigid: true,
        seconds: 10.0,
        settled: None,
    }));
    // Ten seconds to settle, and a minute.
    cases.extend(BUDGETS.map(|iterations| Case {
        scene: "tower",
        iterations,
        rigid: false,
        seconds: 70.0,
        settled: Some(10.0),
    }));
    println!("h = 1/150, 2 sweeps. Momenta over Σ m|v|, energies over the total at the start.\n");
    println!(
        "| scene | iterations | start | steps | in the air: error | drift | angular | ground pulls | beyond μ | rises above start | above lowest | contacts hold | lost | contact | friction | ½m Δv² | depth (m) | ball (m) | dropped | m/min |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    let mut failed = false;
    for case in cases {
        let start = if case.rigid { "rigid-1" } else { "galerkin-1" };
        let name = format!("{}/{}/{start}", case.scene, case.iterations);
        if !only.is_empty() && !only.iter().any(|start| name.starts_with(start)) {
            continue;
        }
        match run(&case) {
            Ok(outcome) => {
                row(&case, start, &outcome);
                for wrong in outcome.wrong() {
                    failed = true;
                    println!("WRONG {} {}: {wrong}", case.scene, case.iterations);
                }
            }
            Err(why) => {
                failed = true;
                println!("WRONG {}: {why}", case.scene);
            }
        }
    }
    match failed {
        true => ExitCode::FAILURE,
        false => ExitCode::SUCCESS,
    }
}

fn row(case: &Case, start: &str, o: &Outcome) {
    let some = |x: Option<f64>| x.map_or_else(|| "–".into(), |x| format!("{x:.1e}"));
    let percent = |x: f64| format!("{:.1} %", 100.0 * x);
    println!(
        "| {} | {} | {start} | {} of {} | {} × {:.1e} | {} | {} | {} | {} | {:.1e} | {:.1e} | {:.1e} | {} | {} | {} | {} | {:.1e} | {:.1e} | {} | {} |",
        case.scene,
        case.iterations,
        o.steps,
        o.asked,
        o.free,
        o.free_error,
        some(o.drift),
        some(o.angular_drift),
        percent(o.pull),
        percent(o.beyond_friction),
        o.rise,
        o.returned,
        o.stored,
        percent(o.lost),
        percent(o.contact),
        percent(o.friction),
        percent(o.inertia),
        o.depth,
        o.rigid_depth,
        o.dropped,
        some(o.creep),
    );
}
