//! Pins and contact: nobody penetrates, Coulomb's law, release, and exact pins.

use crate::support::account::frozen_rotations;
use crate::support::meshes::{box_mesh, jitter};
use crate::support::reference::stack;
use crate::support::scenes::Setup;
use femto::collider::Collider;
use femto::glam::Vec3;
use femto::owned::OwnedBody;
use femto::settings::{Preconditioner, Settings, Start};
use femto::step::{Scene, StepReport};

const GRAVITY: Vec3 = Vec3::new(0.0, -9.81, 0.0);

fn ground(friction: f32) -> Collider<'static> {
    Collider::half_space(Vec3::Y, 0.0)
        .unwrap()
        .with_friction(friction)
        .unwrap()
}

fn settings(setup: &Setup, start: Start, iterations: u32) -> Settings<'static> {
    setup.solver(start, Preconditioner::Jacobi, iterations)
}

/// A cube of side 0.5 whose lowest face is at `height`.
fn cube(young: f32, height: f32) -> Setup {
    let mut setup = Setup::new("cube", jitter(&box_mesh([0.5; 3], [3; 3]), 0.01, 5));
    setup.young = young;
    let lowest = setup.x.iter().fold(f32::INFINITY, |y, x| y.min(x[1]));
    for x in &mut setup.x {
        x[1] += height - lowest;
    }
    setup
}

fn lowest(body: &OwnedBody) -> f32 {
    body.positions()
        .iter()
        .fold(f32::INFINITY, |y, x| y.min(x[1]))
}

fn run(
    body: &mut OwnedBody,
    scene: &Scene<'_>,
    settings: &Settings,
    steps: usize,
    mut look: impl FnMut(usize, &OwnedBody, &StepReport),
) {
    for step in 0..steps {
        let report = body.step(scene, settings);
        assert!(report.advanced(), "{report:?}");
        look(step, body, &report);
    }
}

/// One rounding of a coordinate of order one.
const MARGIN: f32 = 2.0 * f32::EPSILON;

/// Dropped from 0.3 m. At rest a cube has lost the energy of its fall and kept that of its weight.
#[test]
fn dropped_cubes_never_enter_the_ground_and_come_to_rest() {
    let colliders = [ground(0.5)];
    let scene = Scene {
        gravity: GRAVITY,
        colliders: &colliders,
        ..Scene::default()
    };
    for (young, guard) in [1e5, 1e6, 1e8]
        .map(|young| [(young, false), (young, true)])
        .into_iter()
        .flatten()
    {
        for (start, iterations) in [
            (Start::Zero, 20),
            (Start::Galerkin(1), 0),
            (Start::Galerkin(1), 1),
            (Start::Galerkin(2), 5),
            (Start::Rigid(1), 2),
        ] {
            let case = format!("E = {young:e}, {start:?}, {iterations} iterations, guard: {guard}");
            let setup = cube(young, 0.3);
            let mut settings = settings(&setup, start, iterations);
            if guard {
                settings = settings.with_energy_guard();
            }
            let mut body = setup.body(start);
            let first = body.energies(GRAVITY).total();
            run(&mut body, &scene, &settings, 400, |step, body, _| {
                assert!(
                    lowest(body) >= -MARGIN,
                    "{case}, step {step}: {}",
                    lowest(body)
                );
                let now = body.energies(GRAVITY).total();
                assert!(now < first, "{case}, step {step}: energy {now} of {first}");
            });
            let last = body.energies(GRAVITY);
            assert!(last.kinetic < 1e-4 * first, "{case}: {last:?}");
            assert!(lowest(&body) < 1e-4, "{case}: floats at {}", lowest(&body));
        }
    }
}

#[test]
fn a_sheet_drapes_over_a_sphere() {
    let mut setup = Setup::new("sheet", box_mesh([1.0, 0.05, 1.0], [8, 1, 8]));
    setup.young = 2e4;
    for x in &mut setup.x {
        *x = [x[0] - 0.5, x[1] + 0.35, x[2] - 0.5];
    }
    let mut body = setup.body(Start::Galerkin(1));
    let colliders = [Collider::sphere(Vec3::ZERO, 0.3)
        .unwrap()
        .with_friction(1.0)
        .unwrap()];
    let scene = Scene {
        gravity: GRAVITY,
        colliders: &colliders,
        ..Scene::default()
    };
    let mut touched = 0;
    run(
        &mut body,
        &scene,
        &settings(&setup, Start::Galerkin(1), 10),
        60,
        |step, body, report| {
            for x in body.positions() {
                let depth = 0.3 - Vec3::from_array(*x).length();
                assert!(depth <= MARGIN, "step {step}: {depth}");
            }
            touched = touched.max(report.contacts);
        },
    );
    assert!(touched > 3);
}

/// A stiff block on a slope of `tan` with friction `mu`, from rest: its speed after one and two seconds.
fn slide(mu: f32, tan: f32) -> (f64, f64) {
    let setup = cube(1e7, 0.0);
    let mut body: OwnedBody = setup.body(Start::Galerkin(1));
    let cos = 1.0 / (1.0 + tan * tan).sqrt();
    let colliders = [ground(mu)];
    let scene = Scene {
        gravity: Vec3::new(tan, -1.0, 0.0) * (cos * 9.81),
        colliders: &colliders,
        ..Scene::default()
    };
    let settings =
        settings(&setup, Start::Galerkin(1), 60).with_preconditioner(Preconditioner::BlockJacobi);
    let speed =
        |body: &OwnedBody| body.momenta().linear[0] / f64::from(body.rest().header.total_mass);
    run(&mut body, &scene, &settings, 150, |_, _, _| {});
    let first = speed(&body);
    run(&mut body, &scene, &settings, 150, |_, _, _| {});
    (first, speed(&body))
}

#[test]
fn blocks_stick_and_slide_by_coulombs_law() {
    for mu in [0.2_f32, 0.5] {
        let (_, below) = slide(mu, 0.99 * mu);
        assert!(
            below.abs() < 1e-3,
            "slides at {below} m/s below the angle of friction"
        );
        let (first, above) = slide(mu, 1.01 * mu);
        assert!(
            above > first && above > 0.02,
            "sticks above the angle of friction: {first}, {above}"
        );
    }
    for (mu, tan) in [(0.0, 0.5), (0.3, 0.6), (0.5, 1.0)] {
        let (first, second) = slide(mu, tan);
        // a = g (sin θ − μ cos θ), over the second that follows the transient of letting go.
        let exact = 9.81 * f64::from((tan - mu) / (1.0 + tan * tan).sqrt());
        assert!(
            (second - first - exact).abs() < 0.01 * exact,
            "{mu} {tan}: {} m/s² for {exact}",
            second - first
        );
    }
}

/// A ground that sinks takes the resting body along; one that rises pushes it, and nobody enters.
#[test]
fn moving_ground_carries_what_rests_on_it() {
    for speed in [-0.5_f32, 0.5] {
        let setup = cube(1e6, 0.0);
        let mut body: OwnedBody = setup.body(Start::Galerkin(1));
        let mut ground = [ground(0.5)
            .with_velocity(Vec3::new(0.0, speed, 0.0))
            .unwrap()];
        let mut level = 0.0;
        for step in 0..150 {
            let scene = Scene {
                gravity: GRAVITY,
                colliders: &ground,
                ..Scene::default()
            };
            let report = body.step(&scene, &settings(&setup, Start::Galerkin(1), 20));
            assert!(report.advanced());
            ground[0].advance(setup.h);
            level += speed * setup.h;
            // The level itself is a sum of roundings.
            let gap = lowest(&body) - level;
            assert!(gap > -200.0 * f32::EPSILON, "{speed}: step {step} {gap}");
            assert!(
                step < 60 || gap < 1e-3 && report.contacts > 0,
                "{speed}: step {step} {gap} {report:?}"
            );
        }
    }
}

/// Thrown upwards while it rests on the ground, a body leaves it in one step: contact never pulls.
#[test]
fn contact_never_pulls() {
    let colliders = [ground(0.5)];
    let scene = Scene {
        gravity: GRAVITY,
        colliders: &colliders,
        ..Scene::default()
    };
    let mut setup = cube(1e6, 0.0);
    for v in &mut setup.v {
        v[1] = 2.0;
    }
    let mut body = setup.body(Start::Galerkin(1));
    run(
        &mut body,
        &scene,
        &settings(&setup, Start::Galerkin(1), 5),
        1,
        |_, body, report| {
            assert_eq!(report.contacts, 0);
            assert!(lowest(body) > 0.01);
        },
    );
    // Pressed flat by 20 % and let go: it jumps.
    let mut setup = cube(1e5, 0.0);
    for x in &mut setup.x {
        x[1] *= 0.8;
    }
    let mut body = setup.body(Start::Galerkin(1));
    let mut highest = 0.0_f32;
    run(
        &mut body,
        &scene,
        &settings(&setup, Start::Galerkin(1), 20),
        60,
        |_, body, _| highest = highest.max(lowest(body)),
    );
    assert!(highest > 0.02, "jumps only {highest} m");
}

/// Three half-spaces make a corner; a body thrown into it stays out of all three.
#[test]
fn corners_hold() {
    let mut setup = cube(1e6, 0.02);
    for (x, v) in setup.x.iter_mut().zip(&mut setup.v) {
        (x[0], x[2]) = (x[0] + 0.03, x[2] + 0.05);
        *v = [-3.0, -4.0, -2.0];
    }
    let walls = [Vec3::X, Vec3::Y, Vec3::Z].map(|n| {
        Collider::half_space(n, 0.0)
            .unwrap()
            .with_friction(0.2)
            .unwrap()
    });
    let scene = Scene {
        gravity: GRAVITY,
        colliders: &walls,
        ..Scene::default()
    };
    let mut body = setup.body(Start::Galerkin(1));
    run(
        &mut body,
        &scene,
        &settings(&setup, Start::Galerkin(1), 5),
        150,
        |step, body, _| {
            let least = body
                .positions()
                .iter()
                .flatten()
                .fold(f32::INFINITY, |a, &b| a.min(b));
            assert!(least >= -MARGIN, "step {step}: {least}");
        },
    );
}

/// Pins go exactly where they are told, and contact leaves them alone.
#[test]
fn pins_obey() {
    let mut setup = cube(1e6, 0.0).pinned(|x| x[1] < 0.02, |_| [0.1, -0.2, 0.0]);
    setup.theta = 0.5;
    let pins = setup.pin_list();
    let colliders = [ground(0.5)];
    let scene = Scene {
        gravity: GRAVITY,
        colliders: &colliders,
        pins: &pins,
        ..Scene::default()
    };
    let mut body = setup.body(Start::Galerkin(1));
    // 30 steps of 1/150 s; a rounding of a coordinate each.
    run(
        &mut body,
        &Scene {
            colliders: &[],
            ..scene
        },
        &settings(&setup, Start::Galerkin(1), 3),
        30,
        |_, _, _| {},
    );
    assert!(!pins.is_empty());
    for pin in &pins {
        let (from, to) = (
            setup.x[pin.node as usize],
            body.positions()[pin.node as usize],
        );
        for (axis, travel) in [0.02, -0.04, 0.0].into_iter().enumerate() {
            assert!((to[axis] - from[axis] - travel).abs() < 30.0 * f32::EPSILON);
        }
        assert_eq!(body.velocities()[pin.node as usize], [0.1, -0.2, 0.0]);
    }
    // The ground does not stop them.
    let mut below = 0;
    run(
        &mut body,
        &scene,
        &settings(&setup, Start::Galerkin(1), 3),
        1,
        |_, body, _| {
            below = pins
                .iter()
                .filter(|pin| body.positions()[pin.node as usize][1] < -0.03)
                .count();
        },
    );
    assert!(below > 0);
}

/// What the ground does to a cube that is thrown onto it, by the residual of the f64 oracle: impulses
/// that push and that pull, N·s.
fn pushes_and_pulls(young: f32, iterations: u32, seed: u64) -> (f64, f64) {
    let mut setup = cube(young, 0.2);
    setup.gravity = GRAVITY.to_array();
    let tilt = femto::glam::Quat::from_rotation_z(0.1 + 0.01 * (seed % 40) as f32);
    for (x, v) in setup.x.iter_mut().zip(&mut setup.v) {
        *x = (tilt * Vec3::from_array(*x)).to_array();
        x[1] += 0.2;
        *v = [0.5, -1.0, 0.2];
    }
    let colliders = [ground(0.0)];
    let scene = Scene {
        gravity: GRAVITY,
        colliders: &colliders,
        ..Scene::default()
    };
    let settings = settings(&setup, Start::Galerkin(1), iterations);
    let mut body: OwnedBody = setup.body(Start::Galerkin(1));
    let mut oracle = setup.reference();
    let (mut pushed, mut pulled) = (0.0, 0.0);
    for _ in 0..150 {
        let q = frozen_rotations(&body.state().view(), setup.mesh.tets.len());
        (oracle.x, oracle.v) = (stack(body.positions()), stack(body.velocities()));
        let (a, b) = oracle.system(&q);
        let report = body.step(&scene, &settings);
        assert!(report.advanced());
        let moved = (stack(body.positions()) - &oracle.x) / oracle.h;
        let impulse = a * moved - b;
        for i in 0..setup.x.len() {
            let j = impulse[3 * i + 1];
            let touches = body.positions()[i][1] < 1e-4;
            let pulls = touches && j < -1e-6;
            pushed += if touches && !pulls { j } else { 0.0 };
            pulled -= if pulls { j } else { 0.0 };
        }
    }
    (pushed, pulled)
}

/// Contact pulls by no more than the solve has left over: less and less the more iterations, and not when it has converged.
#[test]
fn what_pulls_is_what_the_solve_leaves() {
    for young in [1e4, 1e5, 1e6, 1e7] {
        for (iterations, part) in [(5, 2e-3), (10, 1e-3), (150, 1e-5)] {
            for seed in [0, 21] {
                let (pushed, pulled) = pushes_and_pulls(young, iterations, seed);
                assert!(
                    pulled < part * pushed,
                    "E = {young:e}, {iterations} iterations: {pulled} of {pushed}"
                );
            }
        }
    }
}
