//! The nearest relative, rapier's `fem`, on a cantilever and a free bar.

use crate::Run;
use crate::chapters::peers::{file_name, is_ours, of, plots, solvers};
use crate::measure::{Outcome, References, race, run};
use crate::method::Contender;
use crate::methods::{ours, rapier};
use crate::output::{Done, Output, short};
use crate::pareto::{Metric, TO_CONVERGED, TO_TRUTH, best_at};
use crate::problem::{Problem, cantilever, free_bar};

/// Of the tip's travel.
const ALLOWED: f64 = 0.01;
/// Of each side so many that reach it are timed in turns.
const CANDIDATES: usize = 3;
const ROUNDS: usize = 25;

/// Iterations that rapier may take.
const CAPS: [u32; 13] = [3, 5, 10, 15, 20, 25, 30, 40, 50, 70, 100, 150, 200];

/// Its other budgets: until a residual, and in substeps.
fn uncapped() -> Vec<rapier::Budget> {
    let until = [1e-2, 1e-3, 1e-4, 1e-5].map(rapier::Budget::until);
    let split = [(2, 20), (2, 50), (4, 20), (4, 50), (8, 20)];
    let split = split.map(|(s, k)| rapier::Budget::capped(s, k));
    [until.as_slice(), &split].concat()
}

/// A contender, and what its run came to.
struct Entry {
    contender: Contender,
    outcome: Outcome,
}

impl Entry {
    fn is_good(&self) -> bool {
        self.outcome.tip <= ALLOWED
    }
}

pub fn chapter(study: &Run, out: &mut Output) -> Done {
    out.text("## rapier3d 0.36.1, feature `fem`");
    out.text(&format!(
        "The same comparison on a cantilever of 425 nodes and a free, spinning bar of 208. rapier may take {} to {} \
         iterations, stop at a relative residual, or take substeps of its own. femto has budgets of two polar sweeps \
         besides (with one, the rotations are the last error that is left), and of up to 64 substeps.",
        CAPS[0],
        CAPS[CAPS.len() - 1],
    ));
    let mut problems = Vec::new();
    for young in if study.quick { &[1e6][..] } else { &[1e6, 1e7] } {
        problems.push(cantilever(*young)?);
        problems.push(free_bar(*young)?);
    }
    let mut verdicts = Vec::new();
    for problem in &mut problems {
        if study.quick {
            problem.steps = 20;
        }
        study.progress(&format!("{}, {:e} Pa", problem.name, problem.young));
        let references = References::new(problem);
        let mut entries = entries(problem, &references, study.quick);
        if !study.quick {
            refine(problem, &references, &mut entries);
        }
        verdicts.push(against(study, out, problem, &entries)?);
    }
    out.text(&format!(
        "In short: the time a step that keeps the tip's error (RMS over the run, against the converged step) below {} of \
         its travel, and rapier's error over femto's in the same time, at that of rapier's budgets where the ratio is least. Both \
         sides were timed in turns: of each step the fastest of {ROUNDS} rounds, averaged over the steps.",
        percent(ALLOWED)
    ));
    out.table(
        &[
            "scene",
            "femto",
            "rapier",
            "ratio of times",
            "target",
            "least ratio of errors to truth",
            "… to converged",
            "target",
        ],
        &verdicts,
    );
    Ok(())
}

fn percent(x: f64) -> String {
    format!("{} %", x * 100.0)
}

fn entries(problem: &Problem, references: &References, quick: bool) -> Vec<Entry> {
    let mut contenders = solvers(problem, quick);
    if quick {
        contenders.push(rapier::contender(rapier::Budget::capped(1, 5)));
    } else {
        for solver in ours::EXACT {
            contenders.extend([2, 3].map(|k| ours::contender(solver, 1, k, 2)));
            contenders.extend([16, 32, 64].map(|s| ours::contender(solver, s, 1, 1)));
        }
        let capped = CAPS.map(|k| rapier::Budget::capped(1, k));
        let budgets = capped.into_iter().chain(uncapped());
        contenders.extend(budgets.map(rapier::contender));
    }
    let each = contenders.into_iter();
    each.map(|contender| entry(problem, references, contender))
        .collect()
}

fn entry(problem: &Problem, references: &References, contender: Contender) -> Entry {
    Entry {
        outcome: run(problem, references, &contender),
        contender,
    }
}

/// Adds the fewest iterations with which rapier reaches what is allowed, found by halving.
fn refine(problem: &Problem, references: &References, entries: &mut Vec<Entry>) {
    let capped = |k| rapier::contender(rapier::Budget::capped(1, k));
    let good = |k: u32, entries: &[Entry]| {
        let name = capped(k).budget;
        let theirs = |e: &&Entry| e.contender.family == rapier::NAME && e.contender.budget == name;
        entries.iter().find(theirs).is_some_and(Entry::is_good)
    };
    let Some(first) = CAPS.iter().position(|&k| good(k, entries)) else {
        return;
    };
    let (mut low, mut high) = (if first > 0 { CAPS[first - 1] } else { 0 }, CAPS[first]);
    while high - low > 1 {
        let middle = u32::midpoint(low, high);
        entries.push(entry(problem, references, capped(middle)));
        if good(middle, entries) {
            high = middle;
        } else {
            low = middle;
        }
    }
}

/// Every budget of rapier's; returns the row of the summary.
fn against(
    study: &Run,
    out: &mut Output,
    problem: &Problem,
    entries: &[Entry],
) -> Result<Vec<String>, Box<dyn std::error::Error>> {
    let name = format!("{}, E = {:e} Pa", problem.name, problem.young);
    out.text(&format!("### {name}"));
    let outcomes: Vec<Outcome> = entries.iter().map(|e| e.outcome.clone()).collect();
    let file = format!("{}-{:e}", file_name(problem), problem.young);
    plots(out, &file, problem, &outcomes)?;

    let ours = of(&outcomes, is_ours);
    let mut theirs = of(&outcomes, |f| f == rapier::NAME);
    theirs.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let ratio = |o: &Outcome, metric: Metric| metric(o) / best_at(&ours, metric, o.seconds);
    let faster = |o: &Outcome, metric: Metric| {
        let equal = ours.iter().filter(|m| metric(m) <= metric(o));
        o.seconds / equal.map(|m| m.seconds).fold(f64::INFINITY, f64::min)
    };
    let rows: Vec<_> = theirs
        .iter()
        .map(|o| {
            vec![
                o.budget.clone(),
                short(o.seconds * 1e6),
                short(o.to_truth),
                short(best_at(&ours, TO_TRUTH, o.seconds)),
                short(o.to_converged),
                short(best_at(&ours, TO_CONVERGED, o.seconds)),
                short(faster(o, TO_TRUTH)),
                short(faster(o, TO_CONVERGED)),
            ]
        })
        .collect();
    out.table(
        &[
            "rapier",
            "µs a step",
            "its error to truth",
            "femto's in that time",
            "its error to converged",
            "femto's in that time",
            "femto reaches its error to truth so many times faster",
            "… to converged",
        ],
        &rows,
    );

    let least = |metric| {
        let ratios = theirs.iter().map(|o| ratio(o, metric));
        ratios.fold(f64::INFINITY, f64::min)
    };
    let errors = [least(TO_TRUTH), least(TO_CONVERGED)];
    let [mine, its] = fastest(study, problem, entries);
    let tell = |fastest: &Option<(String, f64)>| match fastest {
        Some((name, seconds)) => format!("{} µs ({name})", short(seconds * 1e6)),
        None => "never".into(),
    };
    let times = match (&mine, &its) {
        (Some((_, mine)), Some((_, its))) => Some(its / mine),
        _ => None,
    };
    let met = |met: bool| if met { "met" } else { "missed" };
    Ok(vec![
        name,
        tell(&mine),
        tell(&its),
        times.map_or("–".into(), short),
        // Where rapier never gets there, any time of femto's is shorter.
        format!(
            "≥ 10: {}",
            met(mine.is_some() && times.is_none_or(|r| r >= 10.0))
        ),
        short(errors[0]),
        short(errors[1]),
        format!("> 1: {}", met(errors.iter().all(|&r| r > 1.0))),
    ])
}

/// The fastest budget of either side that keeps what is allowed, its name and seconds a step.
fn fastest(study: &Run, problem: &Problem, entries: &[Entry]) -> [Option<(String, f64)>; 2] {
    let good = |member: &dyn Fn(&str) -> bool| {
        let good = entries
            .iter()
            .filter(|e| member(&e.contender.family) && e.is_good());
        let mut good: Vec<&Entry> = good.collect();
        good.sort_by(|a, b| a.outcome.seconds.total_cmp(&b.outcome.seconds));
        good.truncate(CANDIDATES);
        good
    };
    let sides = [good(&is_ours), good(&|family| family == rapier::NAME)];
    let all: Vec<&Contender> = sides.iter().flatten().map(|e| &e.contender).collect();
    let times = race(problem, &all, if study.quick { 1 } else { ROUNDS });
    let (mine, its) = times.split_at(sides[0].len());
    let best = |side: &[&Entry], times: &[f64]| {
        let timed = side.iter().zip(times);
        let best = timed.min_by(|a, b| a.1.total_cmp(b.1));
        best.map(|(e, &seconds)| (e.outcome.name(), seconds))
    };
    [best(&sides[0], mine), best(&sides[1], its)]
}
