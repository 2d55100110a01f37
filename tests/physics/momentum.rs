//! A free body has the exact linear momentum after every step, at every iteration count, whatever
//! the preconditioner: the translations are in W. With the rotations in W too, its angular momentum is
//! nearly kept.

use crate::support::factors;
use crate::support::scenes::{self, Setup};
use femto::owned::OwnedBody;
use femto::settings::{Preconditioner, Settings, Start};
use nalgebra::Vector3;

const STEPS: usize = 150;

fn linear(body: &OwnedBody) -> Vector3<f64> {
    Vector3::from(body.momenta().linear)
}

/// Centre of mass, in f64.
fn centre(body: &OwnedBody) -> Vector3<f64> {
    let (mut sum, mut mass) = (Vector3::zeros(), 0.0);
    for (m, x) in body.rest().masses.iter().zip(body.positions()) {
        sum += Vector3::from(x.map(f64::from)) * f64::from(*m);
        mass += f64::from(*m);
    }
    sum / mass
}

/// L about the centre of mass.
fn spin(body: &OwnedBody) -> Vector3<f64> {
    Vector3::from(body.momenta().angular) - centre(body).cross(&linear(body))
}

/// A bar thrown and spinning under gravity.
fn thrown(young: f32, alpha: f32, theta: f32) -> Setup {
    Setup {
        young,
        alpha,
        theta,
        ..scenes::free_spin()
    }
}

/// Worst |p − p_exact| along a run, in units of the largest momentum that was around, and the worst
/// distance of the centre from its parabola, metres.
fn drift(setup: &Setup, settings: &Settings) -> (f64, f64) {
    let mut body: OwnedBody = setup.body(settings);
    let (h, theta, alpha) = (
        f64::from(setup.h),
        f64::from(setup.theta),
        f64::from(setup.alpha),
    );
    let mass: f64 = body.rest().masses.iter().map(|m| f64::from(*m)).sum();
    let weight = Vector3::from(setup.gravity.map(f64::from)) * mass;
    let (mut p, mut c) = (linear(&body), centre(&body));
    let (mut largest, mut worst, mut astray) = (p.norm(), 0.0_f64, 0.0_f64);
    for _ in 0..STEPS {
        assert!(body.step(&setup.scene(&[]), settings).advanced());
        // (1 + θhα) p⁺ = (1 − (1−θ)hα) p + h m g
        let next = (p * (1.0 - (1.0 - theta) * h * alpha) + weight * h) / (1.0 + theta * h * alpha);
        c += (next * theta + p * (1.0 - theta)) * (h / mass);
        p = next;
        largest = largest.max(p.norm());
        worst = worst.max((linear(&body) - p).norm());
        astray = astray.max((centre(&body) - c).norm());
    }
    (worst / largest, astray)
}

#[test]
fn linear_momentum_is_exact_at_every_budget() {
    // Each step rounds the velocities' mean (ε/2 over √nodes; as a bound, ε/2) and the target (a few
    // roundings of ε/2): 4 ε a step, adding up at random over the steps.
    let bound = 4.0 * f64::from(f32::EPSILON) * (STEPS as f64).sqrt();
    // The positions (of the order of 10 m at the end) round at ε/2 a step, too.
    let travel = 10.0 * bound + bound * 15.0 * STEPS as f64 / 150.0;
    for setup in [
        thrown(1e6, 0.0, 1.0),
        thrown(1e8, 0.0, 1.0),
        thrown(1e7, 0.7, 0.5),
    ] {
        let preconditioners: Vec<_> = (0..factors::COUNT)
            .map(|which| factors::preconditioner(&setup, which))
            .collect();
        for start in [
            Start::Galerkin(0),
            Start::Galerkin(1),
            Start::Galerkin(3),
            Start::Rigid(0),
            Start::Rigid(2),
        ] {
            // Without v(t) in W, and with one iteration of a wrong factor, the body keeps its spin and does not
            // pull itself together: fitting the rotations anew feeds it energy, until rounding is of
            // another size.
            let remembers = !matches!(start, Start::Galerkin(0) | Start::Rigid(0));
            for which in 0..factors::COUNT - usize::from(!remembers) {
                let preconditioner = preconditioners[which];
                for iterations in [0, 1, 2, 5] {
                    let (worst, astray) =
                        drift(&setup, &setup.solver(start, preconditioner, iterations));
                    let case = format!(
                        "E = {:e}, {start:?}, {}, {iterations}",
                        setup.young,
                        factors::name(which)
                    );
                    assert!(worst < bound, "{case}: momentum off by {worst:e}");
                    assert!(astray < travel, "{case}: centre off by {astray:e} m");
                }
            }
        }
    }
}

#[test]
fn the_velocity_start_gets_free_fall_wrong() {
    let setup = thrown(1e6, 0.0, 1.0);
    let (worst, astray) = drift(
        &setup,
        &setup.solver(Start::Velocity, Preconditioner::Jacobi, 3),
    );
    println!("velocity, Jacobi, 3 iterations: momentum off by {worst}, centre by {astray} m");
    assert!(worst > 0.2 && astray > 0.5);
}

/// Relative drift of |L| after a second of free spin without gravity.
fn spin_drift(young: f32, start: Start, iterations: u32) -> f64 {
    let setup = Setup {
        gravity: [0.0; 3],
        ..thrown(young, 0.0, 1.0)
    };
    let mut body: OwnedBody = setup.body(start);
    let before = spin(&body);
    let settings = setup.solver(start, Preconditioner::Jacobi, iterations);
    for _ in 0..STEPS {
        assert!(body.step(&setup.scene(&[]), &settings).advanced());
    }
    (spin(&body) - before).norm() / before.norm()
}

/// Of the order of the strain that the spin itself makes, ρω²R²/2E = 5e-3 at E = 1e6: A annihilates the
/// rotations of the unstrained body.
const SPIN_BOUND: f64 = 5e-3;

#[test]
fn rotations_in_w_keep_angular_momentum() {
    for young in [1e6, 1e7] {
        for iterations in [0, 1, 2, 5, 10] {
            let with = spin_drift(young, Start::Rigid(1), iterations);
            let without = spin_drift(young, Start::Galerkin(1), iterations);
            println!(
                "E = {young:e}, {iterations} iterations: |ΔL|/|L| {with:.1e} with rotations, {without:.1e} without"
            );
            assert!(with < SPIN_BOUND && without > 10.0 * SPIN_BOUND);
        }
    }
}
