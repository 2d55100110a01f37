//! How to split a fixed time between substeps, iterations and sweeps.

use crate::Run;
use crate::measure::{Outcome, References, run};
use crate::methods::ours::{SOLVERS, Solver, contender};
use crate::output::{Done, Output, exact, short};
use crate::problem::{H, Problem, box_mesh};

/// One measured budget on one body.
struct Entry {
    solver: Solver,
    substeps: u32,
    iterations: u32,
    sweeps: u32,
    outcome: Outcome,
}

impl Entry {
    fn budget(&self) -> String {
        format!(
            "{}×{} it., {} sw.",
            self.substeps, self.iterations, self.sweeps
        )
    }
}

/// A bar of 208 nodes, held or free, at one stiffness.
fn bodies(young: f32) -> Result<Vec<Problem>, Box<dyn std::error::Error>> {
    let mesh = box_mesh([1.0, 0.25, 0.25], [12, 3, 3])?;
    let mut held = Problem::new("held bar", "", mesh.clone(), young).hold(|x| x[0] < 1e-6);
    // As large a motion at every stiffness.
    let speed = 0.15 * (young / 1000.0).sqrt();
    held = held.start(|x| [0.0, speed * x[0] * x[0], 0.0]);
    let mut free = Problem::new("free bar", "", mesh, young);
    free = free.start(|[x, y, z]| {
        let (a, b) = (x - 0.5, y - 0.125);
        [
            1.0 - 6.0 * b,
            6.0 * a + speed * a * a,
            2.0 * a - 0.5 * (z - 0.125),
        ]
    });
    held.steps = 75;
    free.steps = 75;
    Ok(vec![held, free])
}

fn measured(study: &Run, problem: &Problem) -> Vec<Entry> {
    let to = References::new(problem);
    let mut all = Vec::new();
    for solver in SOLVERS.into_iter().filter(|s| s.theta == 1.0) {
        let counts: &[u32] = match (study.quick, solver.is_factored()) {
            (true, _) => &[1, 5],
            (false, true) => &[1, 2, 3],
            (false, false) => &[1, 2, 3, 5, 10, 20],
        };
        for &substeps in if study.quick { &[1][..] } else { &[1, 2, 4, 8] } {
            for &iterations in counts {
                for &sweeps in if study.quick { &[1][..] } else { &[1, 2] } {
                    let contender = contender(solver, substeps, iterations, sweeps);
                    all.push(Entry {
                        solver,
                        substeps,
                        iterations,
                        sweeps,
                        outcome: run(problem, &to, &contender, 2),
                    });
                }
            }
        }
    }
    all
}

pub fn chapter(study: &Run, out: &mut Output) -> Done {
    out.text("## Choosing a budget");
    out.text(
        "A bar of 208 nodes, held at one end or thrown and spinning, at four stiffnesses, h = 1/150 s: error to the truth, and time over that of \
         the default (`galerkin-1`, Jacobi, 1×5 iterations, two sweeps).",
    );
    let stiffness: &[f32] = if study.quick {
        &[1e6]
    } else {
        &[1e5, 1e6, 1e7, 1e8]
    };
    let (mut rows, mut cheapest, mut data) = (Vec::new(), Vec::new(), Vec::new());
    for &young in stiffness {
        for problem in bodies(young)? {
            study.progress(&format!("budget: {}, E = {young:e}", problem.name));
            let all = measured(study, &problem);
            let number = short(problem.stiffness(H));
            let unit = unit(&all);
            splits(&mut rows, &problem, &number, &all, unit);
            targets(&mut cheapest, &problem, &number, &all, unit);
            for e in &all {
                let o = &e.outcome;
                data.push(vec![
                    problem.name.into(),
                    number.clone(),
                    e.solver.name.into(),
                    e.substeps.to_string(),
                    e.iterations.to_string(),
                    e.sweeps.to_string(),
                    exact(o.seconds / unit),
                    exact(o.to_truth),
                    exact(o.to_converged),
                ]);
            }
        }
    }
    out.text("The best split of a fixed time, for every solver (time in units of the default's):");
    out.table(
        &[
            "body",
            "h²E/(ρ dx²)",
            "solver",
            "best in 1",
            "best in 2",
            "best in 4",
            "best in 8",
        ],
        &rows,
    );
    out.text("The cheapest budget for an allowed error (of the body's diagonal), and its time:");
    let header = [
        "body",
        "h²E/(ρ dx²)",
        "allowed error",
        "without a factor",
        "with a factor",
    ];
    out.table(&header, &cheapest);
    let header = [
        "body",
        "stiffness",
        "solver",
        "substeps",
        "iterations",
        "sweeps",
        "time",
        "to_truth",
        "to_converged",
    ];
    out.csv("budgets", &header, &data)
}

/// Seconds of the default budget.
fn unit(all: &[Entry]) -> f64 {
    let wanted = |e: &&Entry| {
        let default = femto::Budget::default();
        e.solver.start == femto::Start::default()
            && !e.solver.is_factored()
            && (e.substeps, e.iterations) == (1, default.iterations)
    };
    let seconds = all.iter().filter(wanted).map(|e| e.outcome.seconds);
    seconds.fold(0.0, f64::max)
}

fn splits(rows: &mut Vec<Vec<String>>, problem: &Problem, number: &str, all: &[Entry], unit: f64) {
    let mut names: Vec<&str> = all.iter().map(|e| e.solver.name).collect();
    names.dedup();
    for name in names {
        let mine: Vec<&Entry> = all.iter().filter(|e| e.solver.name == name).collect();
        let mut row = vec![
            problem.name.to_string(),
            number.to_string(),
            name.to_string(),
        ];
        for time in [1.0, 2.0, 4.0, 8.0] {
            // A tenth for the clock.
            let fit = mine
                .iter()
                .filter(|e| e.outcome.seconds <= 1.1 * time * unit);
            let best = fit.min_by(|a, b| a.outcome.to_truth.total_cmp(&b.outcome.to_truth));
            row.push(best.map_or("–".into(), |e| {
                format!("{}: {}", e.budget(), short(e.outcome.to_truth))
            }));
        }
        rows.push(row);
    }
}

fn targets(rows: &mut Vec<Vec<String>>, problem: &Problem, number: &str, all: &[Entry], unit: f64) {
    for allowed in [0.05, 0.02, 0.01, 0.005] {
        let mut row = vec![
            problem.name.to_string(),
            number.to_string(),
            format!("{} %", 100.0 * allowed),
        ];
        for factored in [false, true] {
            let good = all
                .iter()
                .filter(|e| e.solver.is_factored() == factored && e.outcome.to_truth <= allowed);
            let best = good.min_by(|a, b| a.outcome.seconds.total_cmp(&b.outcome.seconds));
            row.push(best.map_or("none of these".into(), |e| {
                format!(
                    "{}, {} ({})",
                    e.solver.name,
                    e.budget(),
                    short(e.outcome.seconds / unit)
                )
            }));
        }
        rows.push(row);
    }
}
