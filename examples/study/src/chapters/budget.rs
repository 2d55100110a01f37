//! How to split a fixed time between substeps, iterations and sweeps.

use crate::Run;
use crate::measure::{Outcome, References, run};
use crate::methods::ours::{self, SOLVERS, Solver, contender};
use crate::output::{Done, Output, exact, short};
use crate::problem::{H, Problem, box_mesh};

/// Errors that somebody may allow, as parts of the diagonal.
const ALLOWED: [f64; 4] = [0.05, 0.02, 0.01, 0.005];

/// What adds nothing to the choice.
const SKIPPED: [&str; 5] = [
    ours::PAPER.name,
    "rigid-1, jacobi",
    "galerkin-2, block-jacobi",
    "galerkin-1, warped in f16",
    ours::THINNED_1.name,
];

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
    held.steps = 60;
    free.steps = 60;
    Ok(vec![held, free])
}

fn measured(study: &Run, problem: &Problem) -> Vec<Entry> {
    let to = References::new(problem);
    let mut all = Vec::new();
    for solver in SOLVERS
        .into_iter()
        .filter(|s| s.theta == 1.0 && !SKIPPED.contains(&s.name))
    {
        let counts: &[u32] = match (study.quick, solver.is_factored()) {
            (true, _) => &[1, 5],
            (false, true) => &[1, 2, 3],
            (false, false) => &[1, 2, 5, 10, 20],
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
                        outcome: run(problem, &to, &contender),
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
    let mut both = Vec::new();
    for &young in stiffness {
        let mut pair = Vec::new();
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
            pair.push((problem.stiffness(H), unit, all));
        }
        for_both(&mut both, &pair);
    }
    std::fs::write(&study.page, page(&both))?;
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
    for allowed in ALLOWED {
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

/// For one stiffness and an allowed error.
struct Cheapest {
    number: String,
    stiffness: f64,
    allowed: f64,
    /// Without a factor and with one: what keeps it on every body, and its time in units of the default's.
    best: [Option<(String, f64)>; 2],
}

fn for_both(rows: &mut Vec<Cheapest>, bodies: &[(f64, f64, Vec<Entry>)]) {
    let Some((stiffness, _, first)) = bodies.first() else {
        return;
    };
    for allowed in ALLOWED {
        // Entries stand in the same order for every body.
        let worst = |k: usize, of: &dyn Fn(&Entry, f64) -> f64| {
            let each = bodies.iter().map(|(_, unit, all)| of(&all[k], *unit));
            each.fold(0.0, f64::max)
        };
        let time = |k: usize| worst(k, &|e, unit| e.outcome.seconds / unit);
        let best = [false, true].map(|factored| {
            let good = (0..first.len()).filter(|&k| {
                first[k].solver.is_factored() == factored
                    && worst(k, &|e, _| e.outcome.to_truth) <= allowed
            });
            let best = good.min_by(|&a, &b| time(a).total_cmp(&time(b)));
            best.map(|k| {
                let name = format!("`{}`, {}", first[k].solver.name, first[k].budget());
                (name, time(k))
            })
        });
        rows.push(Cheapest {
            number: short(*stiffness),
            stiffness: *stiffness,
            allowed,
            best,
        });
    }
}

/// The library's page on budgets.
fn page(rows: &[Cheapest]) -> String {
    let stiff = rows.iter().filter(|row| row.stiffness > 1.0);
    let compared: Vec<bool> = stiff
        .filter_map(|row| match &row.best {
            [Some((_, local)), Some((_, factored))] => Some(factored < local),
            [None, factored] => factored.as_ref().map(|_| true),
            [Some(_), None] => Some(false),
        })
        .collect();
    let ahead = compared.iter().filter(|&&ahead| ahead).count();
    let ahead = format!("{ahead} of {}", compared.len());
    let mut text = PAGE.replace("{ahead}", &ahead);
    for row in rows {
        let [local, factored] = row.best.each_ref().map(|best| match best {
            Some((name, time)) => format!("{name}; {}", short(*time)),
            None => "none of these".into(),
        });
        let allowed = 100.0 * row.allowed;
        text += &format!("| {} | {allowed} % | {local} | {factored} |\n", row.number);
    }
    text
}

const PAGE: &str = "\
Which solver and budget to take: measured, not guessed.

What a budget reaches depends on how stiff a body is for its step, on the number h²E/(ρ dx²), with the \
edge dx of a cell of six tetrahedra. Below, a bar of 208 nodes that vibrates at one end of a clamp, and the same bar \
thrown and spinning, at h = 1/150 s; the error is that of the nodes' positions (RMS, mean over 0.4 s, over the body's \
diagonal) against explicit integration in f64. Each cell has the cheapest start, preconditioner, substeps × \
iterations and polar sweeps (sw.) that keep the allowed error on both bodies, and its time over that of the default. A shorter step \
beats more iterations once a solve is better than the step itself. *None of these* means that the held bar vibrates faster than eight \
substeps resolve; it can be damped, not followed.

The table is written by `cargo run --release -p femto-study -- --publish`, whose report has every split. For a scene of \
one's own, `femto suggest SCENE.toml` measures the same.

* Stiff free bodies that spin (from some tens on) need `rigid-m` or a warped factor; beyond 10⁴ not `rigid-m`, because \
  there the rounding of elastic forces can set them spinning (`tests/golden/hard_cases.txt`).
* A factor pays on stiff bodies that keep their topology: above 1, where an error can be kept at all, it is cheaper than every \
  local preconditioner in {ahead} rows of the table. Beyond 10⁷ single precision no longer holds the inertia beside the \
  stiffness: take a shorter step.
* A warped factor of some thousand nodes should be thinned (`femto bake --drop 0.005`): of the report's car a third of the entries \
  is left, a step takes two thirds of the time, and its error to the truth is the same.
* `velocity` and `velocity-force` are for comparison with the literature only: they can raise the energy without bound.
* θ = ½ damps nothing, and at the same cost is nearer to the true motion where that is smooth; the energy bound does not cover it. \
  The table is of backward Euler.
* One sweep is enough where the rotations of a step stay below some degrees; two where they do not.

| h²E/(ρ dx²) | allowed error | without a factor | with a factor |
|---|---|---|---|
";
