//! How long the steps of a scene take, with and without contact between its bodies.

use std::path::Path;
use std::time::Duration;

use crate::prepare::Factors;
use crate::scene;
use crate::sim::Sim;

/// How bodies find each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// As the scene has it.
    Boxes,
    /// Each point against all triangles of the other body: the same contacts.
    EveryTriangle,
    /// They do not: each is solved by itself. Only where no body is rigid.
    None,
}

/// Seconds of each step by the clock `now`, from the fastest to the slowest: of each the least of `runs` runs, which
/// are all alike.
///
/// # Errors
///
/// A scene that is not there or not right, or a step that is refused.
pub fn step_times(
    scene: &str,
    search: Search,
    runs: usize,
    now: impl Fn() -> Duration,
) -> Result<Vec<f64>, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenes/{scene}.toml"));
    let mut scene = scene::load(&path).map_err(|e| e.to_string())?;
    if search == Search::None {
        scene.coupled = None;
    }
    let factors = Factors::new(&scene).map_err(|e| e.to_string())?;
    let mut least = vec![f64::INFINITY; scene.steps as usize];
    for _ in 0..runs {
        let mut sim = Sim::new(&scene, &factors).map_err(|e| e.to_string())?;
        if search == Search::EveryTriangle {
            sim.search_without_boxes();
        }
        for least in &mut least {
            let begin = now();
            sim.step()?;
            *least = least.min((now() - begin).as_secs_f64());
        }
    }
    least.sort_by(f64::total_cmp);
    Ok(least)
}
