//! Error against time, all methods, per scene.

use femto_bench::baseline::Stop;

use crate::Run;
use crate::measure::{Outcome, References, run};
use crate::method::Contender;
use crate::methods::{direct, explicit, ours, pipeline, projective, rapier, xpbd};
use crate::output::{Done, Output, exact, short};
use crate::pareto::{Metric, TO_CONVERGED, TO_TRUTH, best_at, common_times, front};
use crate::plot::{Plot, Series};
use crate::problem::Problem;

/// The two yardsticks.
const METRICS: [(&str, &str, Metric); 2] = [
    ("truth", "against the truth", TO_TRUTH),
    ("converged", "against the converged step", TO_CONVERGED),
];

/// Substeps and iterations.
fn budgets(solver: ours::Solver, quick: bool, large: bool) -> &'static [(u32, u32)] {
    match (quick, solver.is_factored()) {
        (true, _) => &[(1, 5), (2, 2)],
        (false, true) if large => &[(1, 1), (1, 2), (2, 1), (4, 1)],
        (false, false) if large => &[
            (1, 1),
            (1, 2),
            (1, 5),
            (1, 7),
            (1, 10),
            (1, 20),
            (2, 5),
            (4, 5),
            (8, 3),
        ],
        (false, true) => &[(1, 1), (1, 2), (1, 3), (2, 1), (2, 2), (4, 1), (8, 1)],
        (false, false) => &[
            (1, 1),
            (1, 2),
            (1, 3),
            (1, 4),
            (1, 5),
            (1, 7),
            (1, 10),
            (1, 20),
            (2, 2),
            (2, 5),
            (4, 2),
            (4, 5),
            (8, 3),
        ],
    }
}

/// More substeps, up to those of an explicit method, where the truth is aimed at.
fn many_substeps(solver: ours::Solver, quick: bool) -> &'static [(u32, u32)] {
    match (quick || solver.theta == 1.0, solver.is_factored()) {
        (true, _) => &[],
        (false, true) => &[(16, 1), (32, 1)],
        (false, false) => &[(16, 3), (32, 3)],
    }
}

/// femto's budgets, the paper's choice among them.
pub(super) fn solvers(problem: &Problem, quick: bool) -> Vec<Contender> {
    let large = is_large(problem);
    let mut all = Vec::new();
    for solver in ours::SOLVERS {
        let each = |&(s, k): &(u32, u32)| ours::contender(solver, s, k, 1);
        all.extend(budgets(solver, quick, large).iter().map(each));
        all.extend(many_substeps(solver, quick).iter().map(each));
    }
    all
}

fn is_large(problem: &Problem) -> bool {
    problem.tets.len() > 10_000
}

/// Everything that runs on a scene.
fn contenders(problem: &Problem, quick: bool) -> Vec<Contender> {
    let large = is_large(problem);
    let mut all = solvers(problem, quick);
    for &s in if quick || large { &[1][..] } else { &[1, 2, 4] } {
        all.push(pipeline::contender(s, Stop::At(1e-10)));
        all.extend([5, 20].map(|k| pipeline::contender(s, Stop::After(k))));
        if !large || (s == 1 && !quick) {
            all.push(direct::contender(s));
        }
    }
    let small_steps: &[u32] = if quick { &[4] } else { &[1, 2, 5, 10, 20, 40] };
    all.extend(small_steps.iter().map(|&s| xpbd::contender(s, 1)));
    let passes: &[(u32, u32)] = match quick {
        true => &[(1, 5)],
        false => &[
            (1, 1),
            (1, 2),
            (1, 5),
            (1, 20),
            (2, 1),
            (2, 2),
            (4, 1),
            (4, 5),
            (8, 1),
            (8, 2),
            (16, 1),
        ],
    };
    all.extend(passes.iter().map(|&(s, k)| projective::contender(s, k)));
    let stable = explicit::stable_substeps(problem);
    all.push(explicit::contender(stable));
    if !quick {
        all.push(explicit::contender(2 * stable));
    }
    let counts: &[u32] = if quick { &[5] } else { &[3, 5, 10, 20, 50] };
    all.extend(
        counts
            .iter()
            .map(|&k| rapier::contender(rapier::Budget::capped(1, k))),
    );
    all
}

pub fn chapter(study: &Run, out: &mut Output) -> Done {
    out.text("## Other methods at equal time");
    out.text(
        "Nothing touches these bodies but gravity and pins, so that all methods solve the same equations. *Truth* is \
         velocity Verlet in f64 at half its stable step, and h/16 at most; *converged* the linearly implicit Euler step \
         of h = 1/150 s in f64, solved to r·r ≤ 1e-20 b·b. Methods that aim at another step (XPBD, Projective Dynamics, explicit \
         ones, θ = ½, substeps) can only be judged by the truth. Error: mean over the steps of the RMS node distance over the \
         diagonal of the bounding box. Time: one thread; the fastest step where all do the same work, else each step's fastest of three runs, averaged. \
         `2×5 it.` is two substeps of five iterations. All in f32; XPBD, Projective Dynamics and the explicit method use \
         femto's polar decomposition, the latter two its vectorised forces, too.",
    );
    let mut problems = study.bodies()?;
    if study.quick {
        problems.truncate(1);
        problems[0].steps = 30;
    }
    for problem in &problems {
        let entries = contenders(problem, study.quick);
        let outcomes = outcomes(study, problem, &entries);
        report(out, problem, &outcomes)?;
    }
    Ok(())
}

fn outcomes(study: &Run, problem: &Problem, contenders: &[Contender]) -> Vec<Outcome> {
    study.progress(&format!("{}: references", problem.name));
    let references = References::new(problem);
    study.progress(&format!("{}: {} budgets", problem.name, contenders.len()));
    let each = contenders.iter();
    each.map(|c| run(problem, &references, c)).collect()
}

fn families(outcomes: &[Outcome]) -> Vec<String> {
    let mut families: Vec<String> = Vec::new();
    for outcome in outcomes {
        if !families.contains(&outcome.family) {
            families.push(outcome.family.clone());
        }
    }
    families
}

pub(super) fn of(outcomes: &[Outcome], family: impl Fn(&str) -> bool) -> Vec<&Outcome> {
    outcomes.iter().filter(|o| family(&o.family)).collect()
}

/// Which families.
type Member = fn(&str) -> bool;

/// femto's solvers without the paper's.
pub(super) fn is_ours(family: &str) -> bool {
    ours::SOLVERS[1..].iter().any(|s| s.name == family)
}

/// Those that need no factor.
fn is_local(family: &str) -> bool {
    let local = |s: &&ours::Solver| !s.is_factored();
    ours::SOLVERS[1..]
        .iter()
        .filter(local)
        .any(|s| s.name == family)
}

pub(super) fn file_name(problem: &Problem) -> String {
    problem.name.replace(' ', "-")
}

pub(super) fn plots(out: &mut Output, file: &str, problem: &Problem, outcomes: &[Outcome]) -> Done {
    for (what, title, metric) in METRICS {
        let series = families(outcomes).into_iter().map(|family| {
            let points = front(&of(outcomes, |f| f == family), metric);
            Series::new(family, points.iter().map(|&(t, e)| (t * 1e6, e)).collect())
        });
        let plot = Plot {
            title: format!("{}: error {title} by time", problem.name),
            x: "µs a step of 1/150 s",
            y: "mean error over the diagonal",
            log: [true, true],
            series: series.collect(),
        };
        out.plot(&format!("{file}-{what}"), &plot)?;
    }
    let rows: Vec<_> = outcomes
        .iter()
        .map(|o| {
            let numbers = [o.seconds, o.to_truth, o.to_converged].map(exact);
            [vec![o.family.clone(), o.budget.clone()], numbers.to_vec()].concat()
        })
        .collect();
    out.csv(
        &format!("peers-{file}"),
        &["method", "budget", "seconds", "to_truth", "to_converged"],
        &rows,
    )
}

fn report(out: &mut Output, problem: &Problem, outcomes: &[Outcome]) -> Done {
    out.text(&format!("### {}: {}", problem.name, problem.what));
    plots(out, &file_name(problem), problem, outcomes)?;
    fronts(out, outcomes);
    paper_at_equal_time(out, outcomes);
    for peer in families(outcomes) {
        if !is_ours(&peer) {
            ratios(out, outcomes, &peer);
        }
    }
    Ok(())
}

/// The budgets that no cheaper budget of any method beats.
fn fronts(out: &mut Output, outcomes: &[Outcome]) {
    let everything = of(outcomes, |_| true);
    let best = front(&everything, TO_TRUTH);
    let rows: Vec<_> = best
        .iter()
        .filter_map(|point| {
            everything
                .iter()
                .find(|o| (o.seconds, o.to_truth) == *point)
        })
        .map(|o| {
            vec![
                short(o.seconds * 1e6),
                o.family.clone(),
                o.budget.clone(),
                short(o.to_truth),
            ]
        })
        .collect();
    out.text("Who is best at which time (budgets that nothing cheaper beats, error to the truth):");
    out.table(&["µs a step", "method", "budget", "error"], &rows);
}

/// femto's solvers against the best that the paper's choices reach with up to ten iterations.
fn paper_at_equal_time(out: &mut Output, outcomes: &[Outcome]) {
    let single = |o: &&&Outcome| o.budget.starts_with("1×") && !o.budget.starts_with("1×20");
    let papers = of(outcomes, |f| f == ours::PAPER.name);
    let groups: [(&str, Member, f64); 2] = [
        ("without a factor", is_local, 2.0),
        ("with any preconditioner", is_ours, 10.0),
    ];
    let tell = |o: &Outcome, error: f64| {
        format!(
            "{error} in {time} µs",
            error = short(error),
            time = short(o.seconds * 1e6)
        )
    };
    let mut rows = Vec::new();
    for (what, _, metric) in METRICS {
        for (group, member, target) in groups {
            let ours = of(outcomes, member);
            let by_error = |a: &&&Outcome, b: &&&Outcome| metric(a).total_cmp(&metric(b));
            let Some(best) = papers.iter().filter(single).min_by(by_error) else {
                continue;
            };
            let fit = ours.iter().filter(|o| o.seconds <= best.seconds);
            let Some(mine) = fit.min_by(by_error) else {
                continue;
            };
            let ratio = metric(best) / metric(mine);
            rows.push(vec![
                what.to_string(),
                group.to_string(),
                format!("{}: {}", best.budget, tell(best, metric(best))),
                format!("{}: {}", mine.name(), tell(mine, metric(mine))),
                short(ratio),
                format!(
                    "≥ {target}: {}",
                    if ratio >= target { "met" } else { "missed" }
                ),
            ]);
        }
    }
    out.text("The paper's best (from v, Jacobi, up to ten iterations) and femto's best in the same time:");
    out.table(
        &[
            "error to",
            "femto",
            "the paper's best",
            "femto's best",
            "ratio",
            "target",
        ],
        &rows,
    );
}

/// Error of a peer over femto's at equal time, over the range of times.
fn ratios(out: &mut Output, outcomes: &[Outcome], peer: &str) {
    let theirs = of(outcomes, |f| f == peer);
    let all_times = common_times(&theirs, &of(outcomes, is_ours), 9);
    let mut rows = Vec::new();
    let mut verdicts = Vec::new();
    for (group, member) in [
        ("femto", is_ours as Member),
        ("femto without a factor", is_local),
    ] {
        let ours = of(outcomes, member);
        let ratio = |&t: &f64| best_at(&theirs, TO_TRUTH, t) / best_at(&ours, TO_TRUTH, t);
        let all: Vec<f64> = all_times.iter().map(ratio).collect();
        let changes = all.windows(2).zip(all_times.windows(2));
        let crossings: Vec<_> = changes
            .filter(|(r, _)| (r[0] > 1.0) != (r[1] > 1.0))
            .map(|(_, t)| format!("between {} and {} µs", short(t[0] * 1e6), short(t[1] * 1e6)))
            .collect();
        verdicts.push(match (crossings.as_slice(), all[0] > 1.0) {
            ([], true) => format!("{group} is ahead at every time"),
            ([], false) => format!("{peer} is ahead of {group} at every time"),
            (crossings, _) => format!("{peer} and {group} cross {}", crossings.join(", ")),
        });
        rows.push(
            [
                vec![group.to_string()],
                all.iter().map(|r| short(*r)).collect(),
            ]
            .concat(),
        );
    }
    out.text(&format!(
        "**{peer}**, its error to the truth over femto's at equal time: {}.",
        verdicts.join("; ")
    ));
    let header: Vec<String> = all_times
        .iter()
        .map(|t| format!("{} µs", short(t * 1e6)))
        .collect();
    let header: Vec<&str> = std::iter::once("")
        .chain(header.iter().map(String::as_str))
        .collect();
    out.table(&header, &rows);
}
