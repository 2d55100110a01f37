//! `femto-web-native ASSET STEPS RUNS`: the body of an asset on the ground, at its own settings and Jacobi. Prints the least
//! milliseconds a step over the runs, each of so many steps from rest, and the state hash after a run.

use std::error::Error;
use std::time::Instant;

use femto::asset::AssetBytes;
use femto::element::Factored;
use femto::energy::StateHash;
use femto::glam::Vec3;
use femto::lane::Native;
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
    let settings = asset.metadata.settings;
    let ground = [Collider::half_space(Vec3::Y, 0.0)?.with_friction(0.4)?];
    let scene = Scene {
        gravity: Vec3::new(0.0, -9.81, 0.0),
        pins: asset.pins,
        colliders: &ground,
        ..Scene::default()
    };
    let mut workspace = OwnedWorkspace::new(&asset.rest, &settings);
    let (mut least, mut hash) = (f64::INFINITY, 0);
    for _ in 0..runs {
        let mut state = OwnedState::new(&asset.rest, &settings);
        let begin = Instant::now();
        for _ in 0..steps {
            let report = step::<Native, Factored>(
                &asset.rest,
                &mut state.view_mut(),
                &mut workspace.view_mut(&asset.rest),
                &scene,
                &settings,
            );
            if let Some(refusal) = report.refusal {
                return Err(refusal.to_string().into());
            }
        }
        least = least.min(begin.elapsed().as_secs_f64());
        hash = StateHash::new()
            .with(state.view().x, state.view().v)
            .value();
    }
    println!("{} {hash:016x}", 1e3 * least / f64::from(steps));
    Ok(())
}
