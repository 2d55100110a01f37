//! Rigid bodies with mass: their inertia, collisions, flight and friction, against closed forms.

use femto::Scene;
use femto::collider::Collider;
use femto::glam::Vec3;
use femto::join::Assembly;
use femto::rigid::Shape;
use femto::settings::{Budget, Settings, Start};
use nalgebra::{Matrix3, Vector3};

use super::world::{AXES, World, ball, cube, soft};

const H: f32 = 1.0 / 150.0;

fn settings(iterations: u32) -> Settings<'static> {
    Settings::new(H)
        .unwrap()
        .with_start(Start::Galerkin(1))
        .with_budget(Budget {
            iterations,
            polar_sweeps: 2,
        })
}

fn cuboid(x: f32, y: f32, z: f32) -> Shape {
    Shape::Cuboid {
        half: Vec3::new(x, y, z),
    }
}

fn one(shape: Shape, mass: f32, settings: &Settings<'_>, friction: f32, at: Vec3) -> World {
    let mut parts = Assembly::new();
    parts
        .rigid(shape, mass, at, AXES, friction, &soft(1e5))
        .unwrap();
    World::new(parts, settings, 16)
}

#[test]
fn four_nodes_have_the_mass_and_inertia_of_the_body() {
    let settings = settings(1);
    let box_moment = |a: f64, b: f64| 3.0 * (4.0 * a * a + 4.0 * b * b) / 12.0;
    for (shape, expected) in [
        (ball(0.3), [0.4 * 3.0 * 0.09; 3]),
        (
            cuboid(0.2, 0.1, 0.05),
            [
                box_moment(0.1, 0.05),
                box_moment(0.2, 0.05),
                box_moment(0.2, 0.1),
            ],
        ),
    ] {
        let world = one(shape, 3.0, &settings, 0.0, Vec3::new(0.5, -1.0, 2.0));
        let c = world.centre_of(0);
        let mut inertia = Matrix3::zeros();
        for (x, m) in world.body.positions().iter().zip(world.body.rest().masses) {
            let d = Vector3::from(x.map(f64::from)) - c;
            inertia += (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * f64::from(*m);
        }
        assert!((world.mass_of(0) - 3.0).abs() < 3e-6);
        assert!((c - Vector3::new(0.5, -1.0, 2.0)).norm() < 1e-6);
        let error = (inertia - Matrix3::from_diagonal(&Vector3::from(expected))).norm();
        // Coordinates of 2 m are rounded at ε, arms are 0.03 and up.
        assert!(error < 1e-5 * expected[0], "{inertia} {expected:?}");
    }
}

#[test]
fn a_central_collision_of_equal_balls_ends_in_one_velocity() {
    for iterations in [0, 1, 2, 5] {
        let settings = settings(iterations);
        let mut parts = Assembly::new();
        for x in [0.0, 0.25] {
            parts
                .rigid(
                    ball(0.1),
                    2.0,
                    Vec3::new(x, 0.0, 0.0),
                    AXES,
                    0.3,
                    &soft(1e5),
                )
                .unwrap();
        }
        let mut world = World::new(parts, &settings, 8);
        world.throw(&[(Vec3::X, Vec3::ZERO), (Vec3::ZERO, Vec3::ZERO)]);
        for _ in 0..60 {
            assert!(world.step(&Scene::default(), &settings).advanced());
        }
        let (a, b) = (world.velocity_of(0), world.velocity_of(1));
        assert!((a + b - Vector3::x()).norm() < 1e-6, "{a} {b}");
        // Restitution 0: the open contact leaves at most a ninth of the approach, closed by at most that much a step, and
        // an eighth of it comes back: 1/72.
        assert!((a - b).norm() < 1.0 / 72.0, "{a} {b}");
        assert!(a.y.abs() < 1e-6 && a.z.abs() < 1e-6);
    }
}

#[test]
fn a_ball_shares_its_momentum_with_a_block() {
    for iterations in [1, 2, 5, 20] {
        let settings = settings(iterations);
        let mut parts = Assembly::new();
        let mesh = cube(0.4, 4, [0.0; 3]);
        parts.soft(&mesh.nodes, &mesh.tets, soft(1e5), 0.3).unwrap();
        parts
            .rigid(
                ball(0.1),
                10.0,
                Vec3::new(0.2, 0.6, 0.2),
                AXES,
                0.3,
                &soft(1e5),
            )
            .unwrap();
        let mut world = World::new(parts, &settings, 64);
        let spin = Vec3::new(0.0, 0.0, 3.0);
        world.throw(&[(Vec3::ZERO, Vec3::ZERO), (Vec3::new(0.0, -3.0, 0.0), spin)]);
        let (before, energy) = (world.linear(), world.body.energies(Vec3::ZERO).total());
        for _ in 0..80 {
            assert!(world.step(&Scene::default(), &settings).advanced());
        }
        assert!((world.linear() - before).norm() < 1e-6 * before.norm());
        // Between together (30/74) and elastic (twice that): 64 kg against 10.
        let block = -world.velocity_of(0).y;
        assert!(
            (0.99 * 30.0 / 74.0..2.0 * 30.0 / 74.0).contains(&block),
            "{block}"
        );
        assert!(
            world.velocity_of(1).y > -block,
            "they part, or move on together"
        );
        assert!(world.body.energies(Vec3::ZERO).total() < energy);
    }
}

#[test]
fn a_tumbling_box_keeps_its_momenta() {
    const STEPS: usize = 1500;
    let settings = settings(2);
    let mut world = one(cuboid(0.2, 0.1, 0.05), 3.0, &settings, 0.0, Vec3::ZERO);
    world.throw(&[(Vec3::new(0.1, 0.0, 0.0), Vec3::new(0.1, 5.0, 0.2))]);
    let (l, energy) = (world.angular(), world.body.energies(Vec3::ZERO).total());
    let shape: Vec<f64> = distances(&world);
    let (mut turned, mut worst) = (0.0_f64, 0.0_f64);
    for _ in 0..STEPS {
        assert!(world.step(&Scene::default(), &settings).advanced());
        let (_, [_, axis, _]) = world.rigids[0].pose(world.body.positions()).unwrap();
        turned = turned.max(1.0 - f64::from(axis.y));
        worst = worst.max((world.body.energies(Vec3::ZERO).total() / energy - 1.0).abs());
    }
    // About the middle axis it tips over.
    assert!(turned > 1.9, "{turned}");
    // A step rounds L a dozen times by ε/2.
    let bound = 6.0 * f64::from(f32::EPSILON) * STEPS as f64;
    assert!((world.angular() - l).norm() < bound * l.norm());
    // Midpoint rule: (h ω)² ≈ 1e-3 in a turn, with little left over after one.
    assert!(worst < 2e-3, "{worst}");
    for (now, before) in distances(&world).iter().zip(&shape) {
        assert!(
            (now - before).abs() < 4.0 * f64::from(f32::EPSILON) * 11.0 * 0.1,
            "rigid to rounding at {now}"
        );
    }
}

fn distances(world: &World) -> Vec<f64> {
    let x: Vec<Vector3<f64>> = world
        .body
        .positions()
        .iter()
        .map(|x| Vector3::from(x.map(f64::from)))
        .collect();
    let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    pairs.iter().map(|&(a, b)| (x[a] - x[b]).norm()).collect()
}

/// A box on a slope of tan θ = `ratio` μ: its speed along the slope after each second, and its height over it.
fn slope(mu: f32, ratio: f32, seconds: usize) -> (Vec<f64>, f64) {
    let settings = settings(5);
    let mut world = one(
        cuboid(0.2, 0.1, 0.15),
        3.0,
        &settings,
        mu,
        Vec3::new(0.0, 0.1, 0.0),
    );
    let tan = mu * ratio;
    let cos = 1.0 / (1.0 + tan * tan).sqrt();
    let ground = [Collider::half_space(Vec3::Y, 0.0)
        .unwrap()
        .with_friction(mu)
        .unwrap()];
    let scene = Scene {
        gravity: Vec3::new(tan * cos, -cos, 0.0) * 9.81,
        colliders: &ground,
        ..Scene::default()
    };
    let mut speeds = Vec::new();
    for step in 1..=150 * seconds {
        assert!(world.step(&scene, &settings).advanced());
        if step % 150 == 0 {
            speeds.push(world.velocity_of(0).x);
        }
    }
    (speeds, world.centre_of(0).y)
}

#[test]
fn a_box_sticks_below_the_angle_of_friction_and_slides_above() {
    for mu in [0.3, 0.8] {
        let (speeds, height) = slope(mu, 0.99, 6);
        // It has come to rest, but for the creep T/c_t = h g sin θ/1024 and less.
        let creep = f64::from(H) * 9.81 / 1024.0;
        assert!(speeds[5] < 2.0 * creep, "{mu}: {speeds:?}");
        // It sinks in by h²g/4 where the effective masses of its corners share the load: a corner's is between a quarter of
        // the mass and all of it.
        let sunk = 0.1 - height;
        assert!(
            sunk > 0.0 && sunk < f64::from(H) * f64::from(H) * 9.81 / 4.0 * 1.5,
            "{sunk}"
        );

        let (speeds, _) = slope(mu, 1.01, 6);
        assert!(speeds.is_sorted() && speeds[5] > 0.02, "{mu}: {speeds:?}");
        // Well above, the acceleration is g (sin θ − μ cos θ), with a friction that is right to 1 %.
        let (speeds, _) = slope(mu, 1.5, 6);
        let cos = 1.0 / (1.0 + 2.25 * mu * mu).sqrt();
        let expected = f64::from(9.81 * 0.5 * mu * cos);
        let found = speeds[5] - speeds[4];
        assert!(
            (found - expected).abs() < 0.01 * f64::from(9.81 * mu * cos),
            "{mu}: {found}, not {expected}"
        );
    }
}

#[test]
fn a_ball_rolls_and_a_box_rides_on_what_moves() {
    // On ground that moves at 0.5 m/s a ball that was at rest ends with the speed of rolling: the impulse J of friction gives
    // it v = J/m, and turns it by ω = Jr/I against that; rolling is v + ωr = 0.5, so v = 0.5/(1 + 5/2).
    let settings = settings(5);
    let gravity = Vec3::new(0.0, -9.81, 0.0);
    for (shape, expected) in [(ball(0.1), 0.5 / 3.5), (cuboid(0.2, 0.1, 0.15), 0.5)] {
        let mut world = one(shape, 2.0, &settings, 0.3, Vec3::new(0.0, 0.1, 0.0));
        let mut ground = Collider::half_space(Vec3::Y, 0.0)
            .and_then(|c| c.with_friction(0.5))
            .and_then(|c| c.with_velocity(Vec3::new(0.5, 0.0, 0.0)))
            .unwrap();
        for _ in 0..450 {
            let scene = Scene {
                gravity,
                colliders: &[ground],
                ..Scene::default()
            };
            assert!(world.step(&scene, &settings).advanced());
            ground.advance(H);
        }
        let v = world.velocity_of(0);
        assert!((v.x - expected).abs() < 5e-3, "{shape:?}: {v}");
        assert!(v.y.abs() < 1e-3);
    }
}
