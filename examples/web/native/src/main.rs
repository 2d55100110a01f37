//! `femto-web-native ASSET STEPS RUNS`: the body of an asset on the ground, at its own settings and Jacobi. Prints the least
//! milliseconds a step over the runs, each of so many steps from rest, and the state hash after a run; then how many
//! operations of f32 the tetrahedra of a step take, and the hash that those who counted them came to.

mod count;

use std::error::Error;
use std::time::Instant;

use count::{Counted, operations};
use femto::asset::AssetBytes;
use femto::element::Factored;
use femto::energy::StateHash;
use femto::glam::Vec3;
use femto::lane::{Lanes, Native};
use femto::owned::{OwnedState, OwnedWorkspace};
use femto::step::step;
use femto::{Asset, Collider, Scene};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut next = |what: &str| arguments.next().ok_or(format!("{what} is missing"));
    let bytes = AssetBytes::copy_from(&std::fs::read(next("ASSET")?)?);
    let steps: u32 = next("STEPS")?.parse()?;
    let runs: u32 = next("RUNS")?.parse()?;

    let asset = Asset::new(&bytes)?;
    let ground = [Collider::half_space(Vec3::Y, 0.0)?.with_friction(0.4)?];
    let scene = Scene {
        gravity: Vec3::new(0.0, -9.81, 0.0),
        pins: asset.pins,
        colliders: &ground,
        ..Scene::default()
    };
    let run = |steps| Run {
        asset: &asset,
        scene: &scene,
        steps,
    };
    let (mut least, mut hash) = (f64::INFINITY, 0);
    for _ in 0..runs {
        let (seconds, end) = run(steps).of::<Native>()?;
        (least, hash) = (least.min(seconds), end);
    }
    let (_, counted) = run(steps).of::<Counted>()?;
    println!(
        "{} {hash:016x} {} {counted:016x}",
        1e3 * least / f64::from(steps),
        operations() / u64::from(steps),
    );
    Ok(())
}

/// So many steps from rest.
struct Run<'a> {
    asset: &'a Asset<'a>,
    scene: &'a Scene<'a>,
    steps: u32,
}

impl Run<'_> {
    /// Seconds that they took in these lanes, and the state hash.
    fn of<R: Lanes>(&self) -> Result<(f64, u64), Box<dyn Error>> {
        let (rest, settings) = (&self.asset.rest, &self.asset.metadata.settings);
        let mut workspace = OwnedWorkspace::new(rest, settings);
        let mut state = OwnedState::new(rest, settings);
        let begin = Instant::now();
        for _ in 0..self.steps {
            let report = step::<R, Factored>(
                rest,
                &mut state.view_mut(),
                &mut workspace.view_mut(rest),
                self.scene,
                settings,
            );
            if let Some(refusal) = report.refusal {
                return Err(refusal.to_string().into());
            }
        }
        let seconds = begin.elapsed().as_secs_f64();
        let hash = StateHash::new().with(state.view().x, state.view().v);
        Ok((seconds, hash.value()))
    }
}
