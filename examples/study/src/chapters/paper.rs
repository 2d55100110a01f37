//! The study of Dahl and Bargteil (MIG 2019), redone: starts, preconditioners, iterations.

use femto::{Budget, Preconditioner, Settings, Start};

use crate::Run;
use crate::measure::{References, error, kinetic, run};
use crate::method::Method;
use crate::methods::ours::{Ours, PAPER, Solver, contender};
use crate::output::{Done, Output, exact, short};
use crate::plot::{Plot, Series};
use crate::problem::{H, Problem, STEPS_PER_FRAME};

use super::parts;

const STARTS: [(&str, Start); 3] = [
    ("0", Start::Zero),
    ("v", Start::Velocity),
    ("v+f", Start::VelocityForce),
];
const PRECONDITIONERS: [(&str, Preconditioner<'static>); 3] = [
    ("identity", Preconditioner::Identity),
    ("mass", Preconditioner::Mass),
    ("jacobi", Preconditioner::Jacobi),
];
const ITERATIONS: [u32; 4] = [1, 2, 5, 10];
/// r·r ≤ 1e-10 b·b
const CONVERGED: f32 = 1e-5;
const LIMIT: u32 = 3000;

/// One start and preconditioner on one body.
struct Case {
    start: usize,
    preconditioner: usize,
    /// Of the trajectory to the converged one, after [`ITERATIONS`].
    errors: [f64; 4],
    /// Seconds a frame.
    seconds: [f64; 5],
    /// Iterations to convergence, mean over the run.
    count: f64,
    /// Kinetic energy at the end of a run of five iterations, over the converged run's.
    kinetic: f64,
}

fn solver(start: usize, preconditioner: usize) -> Solver {
    Solver::new(STARTS[start].1, PRECONDITIONERS[preconditioner].1)
}

fn budget(iterations: u32) -> Budget {
    Budget {
        iterations,
        polar_sweeps: 1,
    }
}

/// The fewest iterations after which the residual of the next step is small enough, to two per cent; near `guess`.
fn to_converge(ours: &mut Ours, settings: &Settings<'_>, guess: u32) -> u32 {
    let saved = ours.body.state().clone();
    let mut good = |k: u32| {
        let report = ours.step_with(&settings.with_budget(budget(k)));
        *ours.body.state_mut() = saved.clone();
        report.relative_residual() <= CONVERGED
    };
    let (mut low, mut high) = (0, guess);
    while !good(high) && high < LIMIT {
        (low, high) = (high, high + high / 2 + 1);
    }
    if low == 0 {
        low = 3 * high / 4;
        while low > 0 && good(low) {
            (low, high) = (3 * low / 4, low);
        }
    }
    while high - low > 1 + high / 50 {
        let middle = low.midpoint(high);
        if good(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// Mean over some steps of the converged motion.
fn mean_count(problem: &Problem, solver: Solver) -> f64 {
    let mut ours = Ours::new(problem, H, PAPER, budget(400));
    let asked = solver.settings(problem, H, budget(0));
    let mut counts = Vec::new();
    for step in 0..problem.steps.min(60) {
        if step % 18 == 6 {
            let guess = counts.last().map_or(40, |last: &f64| *last as u32);
            counts.push(f64::from(to_converge(&mut ours, &asked, guess)));
        }
        ours.step();
    }
    counts.iter().sum::<f64>() / counts.len() as f64
}

/// The same state's step after 0, 1, 2 … iterations: the kinetic energy that it ends with.
fn energy_by_iteration(problem: &Problem, solver: Solver) -> Vec<(f64, f64)> {
    let mut ours = Ours::new(problem, H, PAPER, budget(400));
    for _ in 0..20 {
        ours.step();
    }
    let asked = solver.settings(problem, H, budget(0));
    let saved = ours.body.state().clone();
    let masses = ours.body.rest().masses.to_vec();
    let mut after = |settings: &Settings<'_>| {
        _ = ours.step_with(settings);
        let energy = kinetic(&masses, &ours);
        *ours.body.state_mut() = saved.clone();
        energy
    };
    let exact = after(
        &asked
            .with_start(Start::Velocity)
            .with_preconditioner(Preconditioner::Jacobi)
            .with_budget(budget(1000)),
    );
    (0..=40)
        .map(|k| (f64::from(k), after(&asked.with_budget(budget(k))) / exact))
        .collect()
}

fn last_kinetic(problem: &Problem, solver: Solver, iterations: u32) -> f64 {
    let mut ours = Ours::new(problem, H, solver, budget(iterations));
    for _ in 0..problem.steps {
        ours.step();
    }
    ours.body.energies(problem.gravity()).kinetic
}

fn case(
    problem: &Problem,
    to: &References,
    converged: f64,
    start: usize,
    preconditioner: usize,
) -> Case {
    let asked = solver(start, preconditioner);
    let outcomes = ITERATIONS.map(|k| run(problem, to, &contender(asked, 1, k, 1)));
    let times = outcomes
        .each_ref()
        .map(|o| o.seconds * STEPS_PER_FRAME as f64);
    let count = mean_count(problem, asked);
    let per_iteration = (times[3] - times[0]) / 9.0;
    let [a, b, c, d] = times;
    Case {
        start,
        preconditioner,
        errors: outcomes.map(|o| o.to_converged),
        seconds: [a, b, c, d, a + (count - 1.0) * per_iteration],
        count,
        kinetic: last_kinetic(problem, asked, 5) / converged,
    }
}

pub fn chapter(study: &Run, out: &mut Output) -> Done {
    out.text("## The paper's study, redone");
    out.text(
        "Dahl and Bargteil, \"Early Termination of Conjugate Gradients for Corotated Finite Elements\" (MIG 2019): \
         h = 1/150 s, five steps a frame, one polar sweep, on bodies of the sizes in their Table 1. Errors are of whole \
         trajectories against the converged one (f64, solved to r·r ≤ 1e-20 b·b), mean RMS node distance over the \
         diagonal; \"converged\" in the tables is theirs, r·r ≤ 1e-10 b·b. Times are ratios to the frame of five \
         iterations from v with Jacobi.",
    );
    let mut problems = study.bodies()?;
    if study.quick {
        problems.truncate(1);
        problems[0].steps = 20;
    }
    let mut all = Vec::new();
    for problem in &problems {
        study.progress(&format!("paper: {}: references", problem.name));
        let to = References::new(problem);
        let converged = last_kinetic(problem, PAPER, 200);
        let mut cases = Vec::new();
        for (start, (name, _)) in STARTS.iter().enumerate() {
            study.progress(&format!("paper: {}: start {name}", problem.name));
            for preconditioner in 0..3 {
                cases.push(case(problem, &to, converged, start, preconditioner));
            }
        }
        body(out, problem, &to, &cases)?;
        all.push((problem.clone(), to, cases));
    }
    claims(out, &all)?;
    parts::break_even(study, out, &problems)
}

fn body(out: &mut Output, problem: &Problem, to: &References, cases: &[Case]) -> Done {
    let own = error(&to.converged, &to.truth, problem.diagonal());
    let still = vec![
        problem
            .nodes
            .iter()
            .map(|x| x.map(f64::from))
            .collect::<Vec<_>>();
        problem.steps
    ];
    out.text(&format!(
        "### {} ({} nodes, {} tetrahedra): {}",
        problem.name,
        problem.nodes.len(),
        problem.tets.len(),
        problem.what
    ));
    out.text(&format!(
        "h²E/(ρ dx²) = {}. A body that never moves scores {}; the converged step's own distance to the truth is {}.",
        short(problem.stiffness(H)),
        short(error(&still, &to.converged, problem.diagonal())),
        short(own),
    ));
    let reference = cases[5].seconds[2];
    let name = |c: &Case| {
        vec![
            STARTS[c.start].0.to_string(),
            PRECONDITIONERS[c.preconditioner].0.to_string(),
        ]
    };
    let rows: Vec<_> = cases
        .iter()
        .map(|c| {
            [
                name(c),
                c.errors.map(short).to_vec(),
                vec![format!("{:.0}", c.count)],
                c.seconds.map(|s| format!("{:.2}", s / reference)).to_vec(),
                vec![short(c.kinetic)],
            ]
            .concat()
        })
        .collect();
    out.table(
        &[
            "start",
            "preconditioner",
            "error, 1 it.",
            "2",
            "5",
            "10",
            "iterations to converge",
            "time a frame, 1 it.",
            "2",
            "5",
            "10",
            "converged",
            "final kinetic energy, 5 it.",
        ],
        &rows,
    );
    parts::costs(out, problem)?;
    let data: Vec<_> = cases
        .iter()
        .map(|c| {
            [
                name(c),
                c.errors.map(exact).to_vec(),
                vec![exact(c.count)],
                c.seconds.map(exact).to_vec(),
                vec![exact(c.kinetic)],
            ]
            .concat()
        })
        .collect();
    let file = problem.name.replace(' ', "-");
    out.csv(
        &format!("paper-{file}"),
        &[
            "start",
            "preconditioner",
            "error_1",
            "error_2",
            "error_5",
            "error_10",
            "iterations",
            "frame_1",
            "frame_2",
            "frame_5",
            "frame_10",
            "frame_converged",
            "kinetic_5",
        ],
        &data,
    )?;
    let by = |label: &str, start: usize, preconditioner: usize| {
        Series::new(
            label,
            energy_by_iteration(problem, solver(start, preconditioner)),
        )
    };
    let figures = [
        (
            "preconditioners",
            (0..3)
                .map(|p| by(PRECONDITIONERS[p].0, 1, p))
                .collect::<Vec<_>>(),
        ),
        ("starts", (0..3).map(|s| by(STARTS[s].0, s, 2)).collect()),
    ];
    for (what, series) in figures {
        out.plot(
            &format!("{file}-energy-{what}"),
            &Plot {
                title: format!("{}: kinetic energy by iteration, {what}", problem.name),
                x: "iteration of one step",
                y: "kinetic energy over the solved step's",
                log: [false, true],
                series,
            },
        )?;
    }
    Ok(())
}

/// Whether a claim holds on a body, and the figures.
type Question<'a> = dyn Fn(&Problem, &References, &[Case]) -> (bool, String) + 'a;

/// Each of the paper's claims, with what was found.
fn claims(out: &mut Output, all: &[(Problem, References, Vec<Case>)]) -> Done {
    out.text("### The paper's claims");
    let each = |f: &Question<'_>| {
        let found: Vec<_> = all
            .iter()
            .map(|(p, to, cases)| (p.name, f(p, to, cases)))
            .collect();
        let yes = found.iter().filter(|(_, (good, _))| *good).count();
        let verdict = match yes {
            n if n == found.len() => "yes".to_string(),
            0 => "no".to_string(),
            _ => "depends".to_string(),
        };
        let text: Vec<_> = found
            .iter()
            .map(|(name, (_, text))| format!("{name}: {text}"))
            .collect();
        vec![verdict, text.join("; ")]
    };
    let row = |claim: &str, found: Vec<String>| [vec![claim.to_string()], found].concat();
    // Cases stand in the order start × preconditioner.
    let at = |cases: &[Case], start: usize, preconditioner: usize| {
        cases[3 * start + preconditioner].errors
    };
    let rows = vec![
        row(
            "Fewer than ten iterations are enough (from v, Jacobi: truncation below the step's own error)",
            each(&|p, to, c| {
                let own = error(&to.converged, &to.truth, p.diagonal());
                let ten = at(c, 1, 2)[3];
                (
                    ten <= own,
                    format!(
                        "error {} after ten, the step's own {}",
                        short(ten),
                        short(own)
                    ),
                )
            }),
        ),
        row(
            "The start v(t) is best (Jacobi, at 1, 2, 5 and 10 iterations)",
            each(&|_, _, c| {
                let better = (0..4)
                    .filter(|&k| {
                        at(c, 1, 2)[k] <= at(c, 0, 2)[k] && at(c, 1, 2)[k] <= at(c, 2, 2)[k]
                    })
                    .count();
                (
                    better == 4,
                    format!(
                        "at {better} of 4 budgets; after five {} against {} (0) and {} (v+f)",
                        short(at(c, 1, 2)[2]),
                        short(at(c, 0, 2)[2]),
                        short(at(c, 2, 2)[2])
                    ),
                )
            }),
        ),
        row(
            "v+f goes unstable (any preconditioner and budget: error above the body's diagonal, or lost)",
            each(&|_, _, c| {
                let lost = (0..3)
                    .flat_map(|p| at(c, 2, p))
                    .filter(|e| e.is_nan() || *e >= 1.0)
                    .count();
                (lost > 0, format!("{lost} of 12 runs"))
            }),
        ),
        row(
            "Jacobi needs a fifth of the identity's iterations to converge (from v)",
            each(&|_, _, c| {
                let ratio = c[3].count / c[5].count;
                (
                    ratio >= 4.0,
                    format!(
                        "{ratio:.1} times fewer ({:.0} against {:.0}; mass: {:.0})",
                        c[5].count, c[3].count, c[4].count
                    ),
                )
            }),
        ),
        row(
            "0 damps (final kinetic energy after five Jacobi iterations a step below 0.9 of the converged run's)",
            each(&|_, _, c| {
                (
                    c[2].kinetic < 0.9,
                    format!(
                        "{} from 0, {} from v",
                        short(c[2].kinetic),
                        short(c[5].kinetic)
                    ),
                )
            }),
        ),
        row(
            "Few polar sweeps suffice (one sweep, CG converged: error below the step's own)",
            each(&|p, to, _| {
                let own = error(&to.converged, &to.truth, p.diagonal());
                let e = [1, 2, 4]
                    .map(|sweeps| run(p, to, &contender(PAPER, 1, 200, sweeps)).to_converged);
                (
                    e[0] <= own,
                    format!(
                        "{}, {}, {} with 1, 2, 4 sweeps",
                        short(e[0]),
                        short(e[1]),
                        short(e[2])
                    ),
                )
            }),
        ),
    ];
    out.table(&["claim", "answer", "found"], &rows);
    Ok(())
}
