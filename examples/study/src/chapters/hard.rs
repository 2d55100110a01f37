//! The hard cases in their full form: a bar of 45 nodes.

#[path = "../../../../tests/hard_cases/cases.rs"]
mod cases;
#[path = "../../../../tests/support/meshes.rs"]
#[allow(dead_code, reason = "the tests use more of it")]
mod meshes;
#[path = "../../../../tests/hard_cases/run.rs"]
mod run;

use cases::{Case, Expected};
use femto::{Budget, Start};
use run::{ITERATIONS, Outcome, PRECONDITIONERS, STARTS};

use crate::Run;
use crate::output::{Done, Output, exact};

pub fn chapter(study: &Run, out: &mut Output) -> Done {
    let cells = if study.quick { [2, 1, 1] } else { [4, 2, 2] };
    let mut cases = cases::all(cells);
    if study.quick {
        cases.truncate(8);
    }
    study.progress(&format!("hard cases: {} of them", cases.len()));
    out.text("## Hard cases");
    out.text(
        "Every case with 7 starts, 6 preconditioners and 1, 2, 5 and 20 iterations. *Worst* is the highest energy over the first \
         among all of the cells; *rises* counts cells in which a step raised the energy with its own rotations, *lost* those that were \
         refused later than at the first step. The defaults are `galerkin-1`, Jacobi, five iterations, two sweeps.",
    );
    let lines = run::table(&cases, 2);
    let (mut rows, mut data) = (Vec::new(), Vec::new());
    for (index, case) in cases.iter().enumerate() {
        let default = run::run(case, Start::default(), "jacobi", Budget::default());
        let mut cells = vec![
            case.name.to_string(),
            default.cell(),
            verdict(case, &default).to_string(),
        ];
        for groups in [&[0, 3, 4][..], &[5, 6], &[1], &[2]] {
            let mine = lines
                .iter()
                .filter(|l| l.case == index && groups.contains(&l.start));
            cells.push(summary(mine.flat_map(|l| &l.outcomes)));
        }
        rows.push(cells);
    }
    for line in &lines {
        for (outcome, k) in line.outcomes.iter().zip(ITERATIONS) {
            let mut row = vec![
                cases[line.case].name.to_string(),
                STARTS[line.start].0.to_string(),
                PRECONDITIONERS[line.preconditioner].to_string(),
                k.to_string(),
            ];
            row.extend(match outcome {
                Outcome::Refused(why) => [
                    format!("refused: {why}"),
                    String::new(),
                    String::new(),
                    String::new(),
                    String::new(),
                ],
                Outcome::Lost => [
                    "lost".into(),
                    String::new(),
                    String::new(),
                    String::new(),
                    String::new(),
                ],
                Outcome::Ran {
                    growth,
                    step,
                    recovered,
                    least_det,
                } => [
                    "ran".into(),
                    exact(*growth),
                    exact(*step),
                    recovered.map_or(String::new(), |t| t.to_string()),
                    exact(*least_det),
                ],
            });
            data.push(row);
        }
    }
    let header = [
        "case",
        "defaults: energy, seconds to recover",
        "",
        "zero, galerkin",
        "rigid",
        "velocity",
        "velocity-force",
    ];
    out.table(&header, &rows);
    let failed = rows.iter().filter(|row| row[2] == "FAILED").count();
    out.text(&format!("Failures of the defaults: {failed}."));
    many_steps(study, out);
    let header = [
        "case",
        "start",
        "preconditioner",
        "iterations",
        "end",
        "growth",
        "step",
        "recovered",
        "least_det",
    ];
    out.csv("hard-cases", &header, &data)
}

fn verdict(case: &Case, outcome: &Outcome) -> &'static str {
    let good = match case.expected {
        Expected::Refused(why) => {
            matches!(outcome, Outcome::Refused(said) if said.starts_with(why))
        }
        Expected::Bounded | Expected::BoundedLocally => outcome.is_bounded(),
        Expected::Recovered => {
            outcome.is_bounded()
                && matches!(
                    outcome,
                    Outcome::Ran {
                        recovered: Some(_),
                        ..
                    }
                )
        }
    };
    if good { "passed" } else { "FAILED" }
}

/// Worst energy, and how many of the cells went wrong.
fn summary<'a>(outcomes: impl Iterator<Item = &'a Outcome>) -> String {
    let (mut worst, mut rises, mut lost, mut refused, mut all) = (1.0_f64, 0, 0, 0, 0);
    for outcome in outcomes {
        all += 1;
        match outcome {
            Outcome::Ran { growth, .. } => {
                worst = worst.max(*growth);
                rises += u32::from(!outcome.is_bounded());
            }
            Outcome::Lost => lost += 1,
            Outcome::Refused(_) => refused += 1,
        }
    }
    match (refused == all, rises + lost) {
        (true, _) => "refused".into(),
        (false, 0) => format!("worst {worst:.3}"),
        _ => format!(
            "worst {}, rises {rises}, lost {lost} of {all}",
            crate::output::short(worst)
        ),
    }
}

/// A flying, spinning tetrahedron, for very long.
fn many_steps(study: &Run, out: &mut Output) {
    let steps = if study.quick { 100_000 } else { 10_000_000 };
    study.progress(&format!("hard cases: {steps} steps"));
    let found = cases::all([2, 1, 1])
        .into_iter()
        .find(|case| case.name == "one tetrahedron");
    let Some(mut case) = found else { return };
    case.v = case
        .x
        .iter()
        .map(|x| [-2.0 * x[1], 2.0 * x[0], 0.5])
        .collect();
    let outcome = long(&case, steps);
    out.text(&format!(
        "{steps} steps of a spinning, flying tetrahedron: {outcome}."
    ));
}

fn long(case: &Case, steps: u32) -> String {
    use femto::{Mesh, OwnedBody, Scene, Settings};
    let built = Mesh::new(&case.mesh.nodes, &case.mesh.tets)
        .ok()
        .and_then(|mesh| {
            let materials = run::materials(case);
            OwnedBody::<femto::element::Factored>::new(
                &mesh,
                materials.as_slice(),
                Start::default(),
            )
            .ok()
        });
    let (Some(mut body), Ok(settings)) = (built, Settings::new(case.h)) else {
        return "could not be built".into();
    };
    if let Err(e) = body.place(&case.x, &case.v) {
        return e.to_string();
    }
    let first = body.energies(femto::glam::Vec3::ZERO).total();
    for step in 0..steps {
        if let Some(refusal) = body.step(&Scene::default(), &settings).refusal {
            return format!("step {step} was refused: {refusal}");
        }
    }
    let quaternion = body.state().view().rotations[0].0.map(|c| f64::from(c[0]));
    let off = (quaternion.iter().map(|c| c * c).sum::<f64>() - 1.0).abs();
    let last = body.energies(femto::glam::Vec3::ZERO).total();
    format!(
        "energy {:.4} of the first, least det F {:.4}, |q|² − 1 = {off:.1e}",
        last / first,
        body.min_det()
    )
}
