//! Error against time, all methods, per scene.

use femto_bench::baseline::Stop;

use crate::Run;
use crate::measure::{Outcome, References, run};
use crate::method::Contender;
use crate::methods::{direct, explicit, ours, pipeline, projective, rapier, xpbd};
use crate::output::{Done, Output, exact, short};
use crate::plot::{Plot, Series};
use crate::problem::{Problem, three};

/// Everything that runs on a scene.
pub fn contenders(problem: &Problem, quick: bool) -> Vec<Contender> {
    let large = problem.tets.len() > 10_000;
    let mut all = Vec::new();
    let budgets: &[(u32, u32)] = match quick {
        true => &[(1, 5), (2, 2)],
        false => &[
            (1, 1),
            (1, 2),
            (1, 5),
            (1, 10),
            (1, 20),
            (2, 1),
            (2, 5),
            (4, 1),
            (4, 2),
            (4, 5),
            (8, 1),
            (8, 3),
        ],
    };
    for solver in ours::SOLVERS {
        for &(substeps, iterations) in budgets {
            all.push(ours::contender(solver, substeps, iterations, 1));
        }
    }
    let substeps: &[u32] = if quick { &[1] } else { &[1, 2, 4] };
    for &s in substeps {
        all.push(pipeline::contender(s, Stop::At(1e-10)));
        for k in [5, 20] {
            all.push(pipeline::contender(s, Stop::After(k)));
        }
        if !large || (s == 1 && !quick) {
            all.push(direct::contender(s));
        }
    }
    for &s in if quick {
        &[4][..]
    } else {
        &[1, 2, 5, 10, 20, 40]
    } {
        all.push(xpbd::contender(s, 1));
    }
    for &(s, k) in if quick {
        &[(1, 5)][..]
    } else {
        &[(1, 1), (1, 5), (1, 20), (2, 2), (4, 1), (4, 5), (8, 2)]
    } {
        all.push(projective::contender(s, k));
    }
    let stable = explicit::stable_substeps(problem);
    all.push(explicit::contender(stable));
    if !quick {
        all.push(explicit::contender(2 * stable));
    }
    for k in if quick { &[5][..] } else { &[3, 5, 10, 20, 50] } {
        all.push(rapier::contender(1, *k));
    }
    all
}

pub fn chapter(study: &Run, out: &mut Output) -> Done {
    out.text("## Other methods at equal time");
    let mut problems = three()?;
    if study.quick {
        problems.truncate(1);
        problems[0].steps = 30;
    }
    for problem in &problems {
        let outcomes = outcomes(study, problem);
        report(out, problem, &outcomes)?;
    }
    Ok(())
}

fn outcomes(study: &Run, problem: &Problem) -> Vec<Outcome> {
    study.progress(&format!("{}: references", problem.name));
    let references = References::new(problem);
    let contenders = contenders(problem, study.quick);
    study.progress(&format!("{}: {} budgets", problem.name, contenders.len()));
    let repeats = if study.quick || problem.tets.len() > 10_000 {
        1
    } else {
        3
    };
    contenders
        .iter()
        .map(|c| run(problem, &references, c, repeats))
        .collect()
}

fn report(out: &mut Output, problem: &Problem, outcomes: &[Outcome]) -> Done {
    let mut families: Vec<String> = outcomes.iter().map(|o| o.family.clone()).collect();
    families.dedup();
    let mut seen = Vec::new();
    families.retain(|f| {
        !seen.contains(f) && {
            seen.push(f.clone());
            true
        }
    });
    let curve = |pick: fn(&Outcome) -> f64| {
        let series = families.iter().map(|family| {
            let mut points: Vec<_> = outcomes
                .iter()
                .filter(|o| o.family == *family)
                .map(|o| (o.seconds * 1e6, pick(o)))
                .collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            Series::new(family.clone(), points)
        });
        series.collect::<Vec<_>>()
    };
    out.text(&format!("### {}: {}", problem.name, problem.what));
    for (what, pick) in [
        ("truth", (|o| o.to_truth) as fn(&Outcome) -> f64),
        ("converged", |o| o.to_converged),
    ] {
        out.plot(
            &format!("{}-{what}", problem.name.replace(' ', "-")),
            &Plot {
                title: format!("{}: error against the {what} run", problem.name),
                x: "µs a step",
                y: "mean error over the diagonal",
                log: [true, true],
                series: curve(pick),
            },
        )?;
    }
    let rows: Vec<_> = outcomes
        .iter()
        .map(|o| {
            vec![
                o.family.clone(),
                o.budget.clone(),
                short(o.seconds * 1e6),
                short(o.to_truth),
                short(o.to_converged),
            ]
        })
        .collect();
    out.table(
        &[
            "method",
            "budget",
            "µs a step",
            "error to truth",
            "error to converged",
        ],
        &rows,
    );
    let rows: Vec<_> = outcomes
        .iter()
        .map(|o| {
            vec![
                o.family.clone(),
                o.budget.clone(),
                exact(o.seconds),
                exact(o.to_truth),
                exact(o.to_converged),
            ]
        })
        .collect();
    out.csv(
        &format!("peers-{}", problem.name.replace(' ', "-")),
        &["method", "budget", "seconds", "to_truth", "to_converged"],
        &rows,
    )
}
