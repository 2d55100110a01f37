//! What the demonstration simulates; the build script runs it on the host, too.

use femto::glam::Vec3;
use femto::{Budget, Pin, Scene, Settings, Start};

/// A cube of 3×3×3 cells.
pub const NODES: usize = 64;
/// Six a cell.
pub const TETS: usize = 162;

/// Steps: three seconds.
pub const STEPS: u32 = 300;
/// Steps a second: what the timer is set to.
pub const RATE: u32 = 100;

/// 5 iterations, 1 sweep, Jacobi.
pub static SETTINGS: Settings = match Settings::new(1.0 / RATE as f32) {
    Ok(settings) => settings.with_start(Start::Galerkin(1)).with_budget(Budget {
        iterations: 5,
        polar_sweeps: 1,
    }),
    Err(_) => panic!("a valid time step"),
};

const HELD: Pin = Pin {
    node: 0,
    velocity: Vec3::ZERO,
};

/// It hangs by one edge, and swings.
pub static SCENE: Scene<'static> = Scene {
    gravity: Vec3::new(0.0, -9.81, 0.0),
    forces: &[],
    pins: &[
        HELD,
        Pin { node: 1, ..HELD },
        Pin { node: 2, ..HELD },
        Pin { node: 3, ..HELD },
    ],
    colliders: &[],
};
