//! One step and 200 steps against the oracle, which solves the same equations in f64, dense and
//! directly, with rotations from an SVD.

use crate::support::scenes::{self, Setup, distance};
use femto::element::{Dense, Factored, Layout};
use femto::settings::{Budget, Preconditioner, Start};

const CONVERGED: Budget = Budget {
    iterations: 400,
    polar_sweeps: 8,
};

/// A step rounds a position once (6e-8), and its velocity times h is known to better.
const ONE_STEP: f64 = 2.0 * f32::EPSILON as f64;
/// Asked for over 200 steps; a free, spinning body adds up the roundings of its angular velocity
/// (measured: 3e-5), a held one does not (3e-7).
const RUN: f64 = 1e-4;
const HELD_RUN: f64 = 2e-6;

/// Distances after the first step and after `steps`, over the bounding box.
fn run<L: Layout>(
    setup: &Setup,
    start: Start,
    preconditioner: Preconditioner,
    steps: usize,
) -> (f64, f64) {
    let mut body = setup.body::<L>(start);
    let mut reference = setup.reference();
    let pins = setup.pin_list();
    let settings = setup
        .settings()
        .with_budget(CONVERGED)
        .with_start(start)
        .with_preconditioner(preconditioner);
    let mut first = 0.0;
    for step in 0..steps {
        let report = body.step(&setup.scene(&pins), &settings);
        assert!(report.advanced(), "{}: {report:?}", setup.name);
        reference.step();
        if step == 0 {
            first = distance(body.positions(), &reference);
        }
    }
    (first, distance(body.positions(), &reference))
}

#[test]
fn two_hundred_steps_follow_the_oracle() {
    for setup in scenes::all() {
        let runs = [
            run::<Factored>(&setup, Start::Zero, Preconditioner::Jacobi, 200),
            run::<Factored>(&setup, Start::Velocity, Preconditioner::Mass, 200),
            run::<Factored>(&setup, Start::Galerkin(2), Preconditioner::Jacobi, 200),
            run::<Factored>(&setup, Start::Rigid(1), Preconditioner::BlockJacobi, 200),
            run::<Dense>(&setup, Start::Galerkin(1), Preconditioner::BlockJacobi, 200),
        ];
        let allowed = if setup.pins.is_empty() { RUN } else { HELD_RUN };
        for (first, last) in runs {
            println!(
                "{}: {first:.1e} after one step, {last:.1e} after 200",
                setup.name
            );
            assert!(first < ONE_STEP, "{}: {first:e} after one step", setup.name);
            assert!(last < allowed, "{}: {last:e} after 200 steps", setup.name);
        }
    }
}

#[test]
fn the_velocity_force_start_agrees_where_it_converges() {
    let (first, last) = run::<Factored>(
        &scenes::cantilever(),
        Start::VelocityForce,
        Preconditioner::Jacobi,
        50,
    );
    assert!(first < ONE_STEP && last < HELD_RUN, "{first:e} {last:e}");
}
