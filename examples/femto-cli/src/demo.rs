//! Without a command: the built-in scene, what it cost, and how exact it was.

use std::fmt::Write as _;
use std::path::Path;

use femto_bake::Kind;

use crate::error::Error;
use crate::info::thousands;
use crate::mesh::{Mesh, gmsh};
use crate::prepare::Factors;
use crate::report::StepTimes;
use crate::run;
use crate::scene::{self, Meshes, Scene};
use crate::sim::{Energies, Sim};
use crate::tables::{diagonal, rms};

const SCENE: &str = include_str!("../scenes/snowman.toml");
const SNOWMAN: &[u8] = include_bytes!("../meshes/snowman.msh");
const OUT: &str = "femto-out";

/// The budget of the run that counts as converged.
const CONVERGED: u32 = 200;
const CONVERGED_SWEEPS: u32 = 8;

/// The built-in mesh, whatever name the scene gives it.
struct BuiltIn;

impl Meshes for BuiltIn {
    fn load(&mut self, _: &str) -> Result<Mesh, String> {
        gmsh::parse(SNOWMAN)
    }
}

/// What the scene could be solved with instead, in about the same time: a factor, and iterations.
const INSTEAD: [(Kind, &str, u32); 2] = [
    (Kind::Laplacian, "laplacian", 3),
    (Kind::Warped, "warped", 2),
];

/// Where the nodes were after every step.
type Track = Vec<Vec<[f32; 3]>>;

/// Mean error over the steps, and the error after the last.
type MeanAndLast = (f64, f64);

/// Returns the exit status, 0 or 3.
pub fn command() -> Result<u8, Error> {
    let scene = scene::parse("snowman.toml", SCENE, &mut BuiltIn)?;
    let factors = Factors::new(&scene)?;
    let mut sim = Sim::new(&scene, &factors)?;
    let mut track = Vec::new();
    let summary = run::run(&scene, &mut sim, Path::new(OUT), &[], false, |sim| {
        track.push(sim.positions(0).to_vec());
    })?;
    if let Some(why) = &summary.refused {
        eprintln!(
            "error: {}: step {} was refused: {why}",
            scene.file,
            summary.steps_run + 1
        );
        return Ok(3);
    }
    let converged = with_budget(&scene, CONVERGED, CONVERGED_SWEEPS);
    let converged = track_of(&converged)?.map(|(track, _)| track);
    let error = |track: &Track| error_of(&scene, track, converged.as_ref()?);
    let mut instead = Vec::new();
    for (kind, name, iterations) in INSTEAD {
        let mut other = with_budget(&scene, iterations, scene.budget.polar_sweeps);
        other.preconditioner = scene::Preconditioner::Factored(kind);
        if let Some((track, time)) = track_of(&other)? {
            instead.push((name, iterations, time, error(&track)));
        }
    }
    crate::print(&describe(&scene, &sim, &summary, error(&track), &instead));
    Ok(0)
}

fn with_budget(scene: &Scene, iterations: u32, polar_sweeps: u32) -> Scene {
    let mut other = scene.clone();
    other.budget.iterations = iterations;
    other.budget.polar_sweeps = polar_sweeps;
    other
}

/// Runs a scene, and says how long a step took; `None` where one is refused.
fn track_of(scene: &Scene) -> Result<Option<(Track, StepTimes)>, Error> {
    let factors = Factors::new(scene)?;
    let mut sim = Sim::new(scene, &factors)?;
    let (mut track, mut times) = (Vec::new(), Vec::new());
    for _ in 0..scene.steps {
        let Ok(info) = sim.step() else {
            return Ok(None);
        };
        times.push(info.took);
        track.push(sim.positions(0).to_vec());
    }
    Ok(Some((track, StepTimes::new(&mut times))))
}

/// RMS distance of the nodes from where the converged run has them, over the diagonal of the
/// rest shape: mean over the steps, and after the last.
fn error_of(scene: &Scene, track: &Track, converged: &Track) -> Option<MeanAndLast> {
    let diagonal = diagonal(&scene.bodies[0].rest);
    let pairs = track.iter().zip(converged);
    let errors: Vec<f64> = pairs.map(|(a, b)| rms(a, b) / diagonal).collect();
    let last = *errors.last()?;
    Some((errors.iter().sum::<f64>() / errors.len() as f64, last))
}

/// Name, iterations, times and error of another solver.
type Other = (&'static str, u32, StepTimes, Option<MeanAndLast>);

fn describe(
    scene: &Scene,
    sim: &Sim,
    summary: &run::Summary,
    error: Option<MeanAndLast>,
    instead: &[Other],
) -> String {
    let body = &scene.bodies[0];
    let memory = sim.memory();
    let budget = scene.budget;
    let mut text = format!(
        "femto {}: a snowman falls and topples\n\n",
        env!("CARGO_PKG_VERSION")
    );
    let mut row = |name: &str, value: String| {
        let _ = writeln!(text, "  {name:<10}{value}");
    };
    row(
        "body",
        format!(
            "{} nodes, {} tets; E = {:e} Pa, ν = {}, {} kg/m³",
            thousands(body.rest.len()),
            thousands(body.tets.len()),
            body.young,
            body.poisson,
            body.density
        ),
    );
    row(
        "run",
        format!(
            "{} steps of {:.3} ms, {:.1} s in all",
            summary.steps_run,
            scene.dt * 1e3,
            f64::from(summary.steps_run) * scene.dt
        ),
    );
    row(
        "budget",
        format!(
            "{} iterations and {} polar sweep{} a step; {}, start {}",
            budget.iterations,
            budget.polar_sweeps,
            if budget.polar_sweeps == 1 { "" } else { "s" },
            scene.solver.preconditioner,
            scene.solver.start
        ),
    );
    row("", String::new());
    if let (Some(min), Some(median)) = (summary.times.min, summary.times.median) {
        row(
            "a step",
            format!("{:.0} µs (median; fastest {:.0})", median * 1e6, min * 1e6),
        );
    }
    row(
        "memory",
        format!(
            "rest {}, state {}, workspace {} bytes",
            thousands(memory.rest),
            thousands(memory.state),
            thousands(memory.workspace)
        ),
    );
    match error {
        Some((mean, last)) => {
            row(
                "error",
                format!("{} mean, {} at the end", percent(mean), percent(last)),
            );
            row(
                "",
                "RMS position error over the body's diagonal, against the same".into(),
            );
            row(
                "",
                format!(
                    "scene with {CONVERGED} iterations and {CONVERGED_SWEEPS} polar sweeps a step"
                ),
            );
        }
        None => row("error", "unknown: the converged run was refused".into()),
    }
    row(
        "choice",
        "Jacobi: a factor of the free body knows nothing of the ground that".into(),
    );
    row(
        "",
        "holds it. Instead of Jacobi, and its mean error:".into(),
    );
    for (name, iterations, times, error) in instead {
        let error = error.map_or("unknown".into(), |(mean, _)| percent(mean));
        let time = times.median.unwrap_or(f64::NAN) * 1e6;
        row(
            "",
            format!("{name}, {iterations} iterations, {time:.0} µs: {error}"),
        );
    }
    row("energy", format!("first {}", energies(&summary.first)));
    row("", format!("last  {}", energies(&summary.last)));
    let (rise, step) = summary.max_rise;
    row(
        "",
        match step {
            0 => "it never rose in a step".into(),
            _ => format!("the most it rose in a step: {rise:.2e} J (step {step})"),
        },
    );
    row("", String::new());
    row("picture", format!("{OUT}/preview.svg"));
    row(
        "numbers",
        format!("{OUT}/final.csv, trace.csv, report.json"),
    );
    row(
        "your own",
        "femto run SCENE.toml --out DIR; femto info MESH".into(),
    );
    text.lines()
        .map(|line| line.trim_end().to_owned() + "\n")
        .collect()
}

fn percent(part: f64) -> String {
    format!("{:.2} %", 100.0 * part)
}

fn energies(e: &Energies) -> String {
    format!(
        "{:.1} J (kinetic {:.1}, elastic {:.1}, potential {:.1})",
        e.total(),
        e.kinetic,
        e.elastic,
        e.potential
    )
}
