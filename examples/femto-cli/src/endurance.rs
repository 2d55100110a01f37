//! Long runs of the scenes of `scenes/`, with an account of momentum, energy, depth and contacts.
//!
//! `cargo run --release -p femto-cli --example endurance` makes all of them.

mod account;

use std::path::Path;

use crate::prepare::Factors;
use crate::scene::{self, Scene, Start};
use crate::sim::Sim;
use account::{Account, Masses};

/// Energies, which take longer than a step, are looked at every so many steps.
const LOOK: u32 = 10;

/// What one run is.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// The name of a file in `scenes/`, without its `.toml`.
    pub scene: &'static str,
    /// CG iterations, with two sweeps; the preconditioner is the scene's.
    pub iterations: u32,
    /// Start `rigid-1`, which keeps angular momentum too, instead of the default, `galerkin-1`.
    pub rigid: bool,
    /// How long, simulated.
    pub seconds: f64,
    /// Of these, those after which bodies must rest.
    pub settled: Option<f64>,
}

/// What a run came to. Energies are relative to the total at the start, momenta to Σ m|v|.
#[derive(Clone, Copy, Debug, Default)]
pub struct Outcome {
    /// Steps made; all of them, if none was refused.
    pub steps: u32,
    /// Steps that were asked for.
    pub asked: u32,
    /// Steps of bodies that touch nothing, in which momentum must change by h m g.
    pub free: u32,
    /// The most that it missed that by.
    pub free_error: f64,
    /// Where nothing is near the ground all the time: what the total momentum has drifted by in the end.
    pub drift: Option<f64>,
    /// The same of the angular momentum, relative to that at the start.
    pub angular_drift: Option<f64>,
    /// Of the impulse of a level ground: the part that pulls, and the part of its friction beyond Coulomb's law.
    pub pull: f64,
    /// See `pull`.
    pub beyond_friction: f64,
    /// The most that kinetic, elastic and potential energy rose above the start; 0 for never.
    pub rise: f64,
    /// The most that they rose above what they had sunk to before: what contacts gave back.
    pub returned: f64,
    /// The most that closed contacts stored as ½kd².
    pub stored: f64,
    /// Lost in all, and of that: to contact between bodies, along the normal and by friction, and as ½m|Δv|² of
    /// backward Euler. The rest is its ½h²vᵀKv and what the ground takes.
    pub lost: f64,
    /// See `lost`.
    pub contact: f64,
    /// See `lost`.
    pub friction: f64,
    /// See `lost`.
    pub inertia: f64,
    /// The deepest that a node of a soft body was below a plane, m.
    pub depth: f64,
    /// The same of a rigid ball.
    pub rigid_depth: f64,
    /// Contacts that found no room.
    pub dropped: u64,
    /// Of bodies that rest: how far the node that moved most has gone since then, m/min.
    pub creep: Option<f64>,
}

/// What must hold. Each has its reason beside it.
pub mod bound {
    /// A step rounds the mean of the velocities and its target: 4 ε.
    pub const FREE: f64 = 4.0 * f32::EPSILON as f64;
    /// Rotations that are fitted anew feed E V θ⁴ in a step in which a body turns by θ.
    pub const RISE: f64 = 1e-3;
    /// Nodes are put back on the ground: rounding of coordinates, which are below 64 m.
    pub const DEPTH: f64 = 64.0 * f32::EPSILON as f64;
    /// A rigid ball of radius 0.28 m, on springs that its weight presses in by h²g/4 = 0.1 mm: a hundredth of its radius.
    pub const RIGID_DEPTH: f64 = 2.8e-3;
    /// A tower that stands moves by less in a minute: a hundredth of a cube's side.
    pub const CREEP: f64 = 2e-3;
}

impl Outcome {
    /// What does not hold, in words; nothing if all is well.
    #[must_use]
    pub fn wrong(&self) -> Vec<String> {
        let drift = bound::FREE * f64::from(self.steps).sqrt();
        let checks = [
            ("steps not made", f64::from(self.asked - self.steps), 0.0),
            ("momentum in the air", self.free_error, bound::FREE),
            ("drift of momentum", self.drift.unwrap_or(0.0), drift),
            ("rise of energy", self.rise, bound::RISE),
            ("depth below the ground", self.depth, bound::DEPTH),
            (
                "depth of a rigid body",
                self.rigid_depth,
                bound::RIGID_DEPTH,
            ),
            ("dropped contacts", self.dropped as f64, 0.0),
            ("creep at rest", self.creep.unwrap_or(0.0), bound::CREEP),
        ];
        let wrong = checks
            .iter()
            .filter(|(_, value, most)| value > most || value.is_nan());
        wrong
            .map(|(name, value, most)| format!("{name}: {value:.2e}, at most {most:.2e}"))
            .collect()
    }
}

/// Runs one case.
///
/// # Errors
///
/// A scene that is not there or not right.
pub fn run(case: &Case) -> Result<Outcome, String> {
    let name = format!("{}.toml", case.scene);
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("scenes")
        .join(name);
    let mut scene = scene::load(&path).map_err(|e| e.to_string())?;
    scene.budget.iterations = case.iterations;
    scene.budget.polar_sweeps = 2;
    scene.start = match case.rigid {
        true => Start::Rigid(1),
        false => Start::Galerkin(1),
    };
    let factors = Factors::new(&scene).map_err(|e| e.to_string())?;
    let mut sim = Sim::new(&scene, &factors).map_err(|e| e.to_string())?;
    let steps = |seconds: f64| (seconds / scene.dt).round() as u32;
    Ok(follow(
        &scene,
        &mut sim,
        steps(case.seconds),
        case.settled.map(steps),
    ))
}

fn follow(scene: &Scene, sim: &mut Sim, steps: u32, settled: Option<u32>) -> Outcome {
    let masses = Masses::new(scene);
    let start = sim.measure();
    let mut account = Account::new(&masses, scene, sim);
    let mut out = Outcome {
        asked: steps,
        ..Outcome::default()
    };
    let mut resting = None;
    let whole = start.energy.total();
    let (mut now, mut lowest) = (whole, whole);
    while out.steps < steps {
        if settled == Some(out.steps) {
            resting = Some(positions(sim));
        }
        let Ok(info) = sim.step() else {
            break;
        };
        out.steps += 1;
        out.dropped += u64::from(info.dropped);
        account.step(sim);
        if out.steps.is_multiple_of(LOOK) || out.steps == steps {
            now = sim.measure().energy.total();
            lowest = lowest.min(now);
            out.stored = out.stored.max(account.stored(sim) / whole);
            out.rise = out.rise.max((now - whole) / whole);
            out.returned = out.returned.max((now - lowest) / whole);
        }
    }
    account.finish(&mut out, whole);
    out.lost = (whole - now) / whole;
    if scene.colliders.is_empty() {
        let spin = |l: [f64; 3]| glam::DVec3::from(l);
        let (before, after) = (spin(start.angular), spin(sim.measure().angular));
        out.angular_drift = Some((after - before).length() / before.length());
    }
    if let (Some(from), Some(since)) = (resting, settled) {
        let now = positions(sim);
        let moved = from.iter().zip(&now).map(|(a, b)| a.distance(*b));
        let minutes = f64::from(out.steps - since) * scene.dt / 60.0;
        out.creep = Some(moved.fold(0.0, f64::max) / minutes);
    }
    out
}

fn positions(sim: &Sim) -> Vec<glam::DVec3> {
    let all = (0..sim.bodies()).flat_map(|body| sim.positions(body));
    all.map(|x| glam::DVec3::from(x.map(f64::from))).collect()
}
