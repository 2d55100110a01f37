//! `femto suggest`: which budget for a scene, by measuring.
//!
//! The scene is run with many solvers and budgets, and once with substeps so short and solves so
//! exact that it counts as the truth. Of each budget the fastest step counts: what a step costs does not
//! depend on the state.

use std::fmt::Write as _;
use std::path::PathBuf;

use femto_bake::Kind;

use crate::error::Error;
use crate::prepare::Factors;
use crate::run::Progress;
use crate::scene::{self, Preconditioner, Scene, Start};
use crate::scene_file::Budget;
use crate::sim::Sim;
use crate::tables::{diagonal, rms};

#[derive(clap::Args)]
pub struct Args {
    /// The scene, a TOML file
    pub scene: PathBuf,
    /// Look at so many steps of it
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..))]
    pub steps: u32,
}

const STARTS: [(&str, Start); 4] = [
    ("galerkin-1", Start::Galerkin(1)),
    ("galerkin-2", Start::Galerkin(2)),
    ("rigid-1", Start::Rigid(1)),
    ("rigid-2", Start::Rigid(2)),
];
const PRECONDITIONERS: [(&str, Preconditioner); 5] = [
    ("jacobi", Preconditioner::Jacobi),
    ("block-jacobi", Preconditioner::BlockJacobi),
    ("two-level", Preconditioner::TwoLevel),
    ("laplacian", Preconditioner::Factored(Kind::Laplacian)),
    ("warped", Preconditioner::Factored(Kind::Warped)),
];
const SUBSTEPS: [u32; 3] = [1, 2, 4];
const ITERATIONS: [u32; 6] = [1, 2, 3, 5, 10, 20];
const SWEEPS: [u32; 2] = [1, 2];
/// Errors that somebody may allow, as parts of the diagonal.
const ALLOWED: [f64; 4] = [0.05, 0.02, 0.01, 0.005];
const TRUTH: Budget = Budget {
    iterations: 60,
    polar_sweeps: 4,
    substeps: 16,
};

/// Positions of all bodies after each step.
type Track = Vec<Vec<Vec<[f32; 3]>>>;

/// A solver with a budget, and what it came to.
struct Entry {
    start: &'static str,
    preconditioner: &'static str,
    budget: Budget,
    /// Of a step of dt.
    seconds: f64,
    error: f64,
}

/// Returns the exit status.
pub fn command(args: &Args) -> Result<u8, Error> {
    let mut scene = scene::load(&args.scene)?;
    if scene.steps == 0 {
        return Err(Error::Value {
            file: scene.file,
            key: "time.steps".into(),
            value: "0".into(),
            why: "there is nothing to measure".into(),
        });
    }
    scene.steps = scene.steps.min(args.steps);
    let Some((truth, _)) = follow(&scene, "galerkin-2", "jacobi", TRUTH)? else {
        eprintln!("error: {}: the exact run was refused", scene.file);
        return Ok(3);
    };
    let mut places = Vec::new();
    for (start, _) in STARTS {
        for (preconditioner, _) in PRECONDITIONERS {
            for substeps in SUBSTEPS {
                for iterations in ITERATIONS {
                    for polar_sweeps in SWEEPS {
                        let budget = Budget {
                            iterations,
                            polar_sweeps,
                            substeps,
                        };
                        places.push((start, preconditioner, budget));
                    }
                }
            }
        }
    }
    let progress = Progress::new(places.len() as u32, false);
    let mut entries = Vec::new();
    for ((start, preconditioner, budget), done) in places.into_iter().zip(1..) {
        if let Some((track, seconds)) = follow(&scene, start, preconditioner, budget)? {
            entries.push(Entry {
                start,
                preconditioner,
                budget,
                seconds,
                error: error(&scene, &track, &truth),
            });
        }
        progress.set(done);
    }
    progress.clear();
    crate::print(&describe(&scene, front(entries)));
    Ok(0)
}

/// Runs the scene; `None` where there is no factor of it, or a step was refused. Seconds of its fastest
/// step.
fn follow(
    scene: &Scene,
    start: &str,
    preconditioner: &str,
    budget: Budget,
) -> Result<Option<(Track, f64)>, Error> {
    let mut scene = scene.clone();
    let named = |name: &str| STARTS.iter().find(|(known, _)| *known == name);
    if let Some((_, start)) = named(start) {
        scene.start = *start;
    }
    let named = |name: &str| PRECONDITIONERS.iter().find(|(known, _)| *known == name);
    if let Some((_, preconditioner)) = named(preconditioner) {
        scene.preconditioner = *preconditioner;
    }
    scene.substep = scene.dt / f64::from(budget.substeps);
    scene.budget = budget;
    let Ok(factors) = Factors::new(&scene) else {
        return Ok(None);
    };
    let mut sim = Sim::new(&scene, &factors)?;
    let (mut track, mut seconds) = (Track::new(), f64::INFINITY);
    for _ in 0..scene.steps {
        let Ok(info) = sim.step() else {
            return Ok(None);
        };
        seconds = seconds.min(info.took.as_secs_f64());
        let bodies = 0..sim.bodies();
        track.push(bodies.map(|body| sim.positions(body).to_vec()).collect());
    }
    Ok(Some((track, seconds)))
}

/// RMS distance over the diagonal, mean over the steps, of the worst body.
fn error(scene: &Scene, track: &Track, truth: &Track) -> f64 {
    let bodies = scene.bodies.iter().enumerate();
    bodies
        .map(|(body, of)| {
            let scale = diagonal(&of.rest) * track.len() as f64;
            let steps = track.iter().zip(truth);
            steps.map(|(a, b)| rms(&a[body], &b[body])).sum::<f64>() / scale
        })
        .fold(0.0, f64::max)
}

/// By rising time, those that are better by more than a hair than everything cheaper.
fn front(mut entries: Vec<Entry>) -> Vec<Entry> {
    entries.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let mut best = f64::INFINITY;
    entries.retain(|entry| {
        let better = entry.error < 0.98 * best;
        if better {
            best = entry.error;
        }
        better
    });
    entries
}

fn describe(scene: &Scene, front: Vec<Entry>) -> String {
    let mut text = format!(
        "{}: {} steps; error against {} substeps of {} iterations, mean RMS node\n\
         distance over the diagonal; time of the fastest step\n\n",
        scene.file, scene.steps, TRUTH.substeps, TRUTH.iterations
    );
    for body in &scene.bodies {
        let stiffness = stiffness(body, scene.dt);
        let _ = writeln!(text, "  h²E/(ρ dx²) = {stiffness:.2e}  {}", body.source);
    }
    let head = [
        "µs",
        "error",
        "start",
        "preconditioner",
        "substeps × iterations, sweeps",
    ];
    let [a, b, c, d, e] = head;
    let _ = writeln!(text, "\n  {a:>8}  {b:>9}  {c:<11} {d:<15} {e}");
    for entry in &front {
        let Budget {
            iterations,
            polar_sweeps,
            substeps,
        } = entry.budget;
        let (time, error) = (entry.seconds * 1e6, format!("{:.3} %", 100.0 * entry.error));
        let (start, preconditioner) = (entry.start, entry.preconditioner);
        let _ = writeln!(
            text,
            "  {time:>8.0}  {error:>9}  {start:<11} {preconditioner:<15} {substeps} × {iterations}, {polar_sweeps}"
        );
    }
    text.push('\n');
    for allowed in ALLOWED {
        let percent = 100.0 * allowed;
        match front.iter().find(|entry| entry.error <= allowed) {
            Some(entry) => {
                let _ = writeln!(
                    text,
                    "  for {percent} %: budget = {{ substeps = {}, iterations = {}, polar_sweeps = {} }}, \
                     solver = {{ start = \"{}\", preconditioner = \"{}\" }}",
                    entry.budget.substeps,
                    entry.budget.iterations,
                    entry.budget.polar_sweeps,
                    entry.start,
                    entry.preconditioner
                );
            }
            None => {
                let _ = writeln!(text, "  for {percent} %: none of these; take a shorter dt");
            }
        }
    }
    text
}

/// h²E/(ρ dx²), with dx the edge of a cell of six mean tetrahedra.
fn stiffness(body: &scene::Body, dt: f64) -> f64 {
    let corner = |i: u32| glam::Vec3::from_array(body.rest[i as usize]).as_dvec3();
    let volume: f64 = body
        .tets
        .iter()
        .map(|&[a, b, c, d]| {
            let origin = corner(a);
            (corner(b) - origin)
                .cross(corner(c) - origin)
                .dot(corner(d) - origin)
                / 6.0
        })
        .sum();
    let dx = libm::cbrt(6.0 * volume / body.tets.len() as f64);
    dt * dt * f64::from(body.young) / (f64::from(body.density) * dx * dx)
}
