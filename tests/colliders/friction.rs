//! Coulomb's law on slopes, belts and turntables.

use femto::collider::{Capsule, Cuboid, HeightField, Placed, SignedDistance};
use femto::element::Factored;
use femto::glam::{Mat3, Vec3};
use femto::owned::OwnedBody;
use femto::{Collider, Frame, Preconditioner, Scene, Start};

use crate::support::meshes::{box_mesh, jitter};
use crate::support::scenes::Setup;

const GRAVITY: Vec3 = Vec3::new(0.0, -9.81, 0.0);

/// A stiff block of side 0.5, its lowest face on y = 0 about the origin.
fn block() -> Setup {
    let mut setup = Setup::new("block", jitter(&box_mesh([0.5; 3], [3; 3]), 0.01, 5));
    setup.young = 1e7;
    let lowest = setup.x.iter().fold(f32::INFINITY, |y, x| y.min(x[1]));
    for x in &mut setup.x {
        *x = [x[0] - 0.25, x[1] - lowest, x[2] - 0.25];
    }
    setup
}

fn velocity(body: &OwnedBody<Factored>) -> Vec3 {
    let mass = f64::from(body.rest().header.total_mass);
    Vec3::from_array(body.momenta().linear.map(|p| (p / mass) as f32))
}

/// Steps with one collider, which may move between steps.
fn run(setup: &Setup, body: &mut OwnedBody<Factored>, collider: Collider<'_>, steps: usize) {
    let colliders = [collider];
    let scene = Scene {
        gravity: GRAVITY,
        colliders: &colliders,
        ..Scene::default()
    };
    let settings = setup.solver(Start::Galerkin(1), Preconditioner::BlockJacobi, 60);
    for _ in 0..steps {
        assert!(body.step(&scene, &settings).advanced());
    }
}

/// The block on a slope of `tan`, turned about z so that down is +x: speed along it after one and two seconds.
fn slide(shape: &dyn SignedDistance, mu: f32, tan: f32) -> (f32, f32) {
    let turn = Mat3::from_rotation_z(-tan.atan());
    let mut setup = block();
    for x in &mut setup.x {
        *x = (turn * Vec3::from_array(*x)).to_array();
    }
    setup.mesh.nodes.clone_from(&setup.x);
    let mut body = setup.body(Start::Galerkin(1));
    let down = turn * Vec3::X;
    let collider = Collider::shape(shape).with_friction(mu).unwrap();
    run(&setup, &mut body, collider, 150);
    let first = velocity(&body).dot(down);
    run(&setup, &mut body, collider, 150);
    (first, velocity(&body).dot(down))
}

/// A long box whose top goes through the origin, turned about z so that down is +x.
fn slope(tan: f32) -> Placed<Cuboid> {
    let cuboid = Cuboid::new(Vec3::NEG_Y, Vec3::new(30.0, 1.0, 5.0)).unwrap();
    let frame = Frame::new(Vec3::ZERO, Mat3::from_rotation_z(-tan.atan())).unwrap();
    Placed::new(cuboid, frame)
}

#[test]
fn blocks_stick_and_slide_on_a_turned_box() {
    for mu in [0.2_f32, 0.5] {
        let below = 0.99 * mu;
        let (_, creep) = slide(&slope(below), mu, below);
        assert!(
            creep.abs() < 1e-3,
            "slides at {creep} m/s below the angle of friction"
        );
        let above = 1.01 * mu;
        let (first, second) = slide(&slope(above), mu, above);
        assert!(
            second > first && second > 0.02,
            "sticks above the angle of friction: {first}, {second}"
        );
    }
    for (mu, tan) in [(0.0_f32, 0.5_f32), (0.3, 0.6), (0.5, 1.0)] {
        // a = g (sin θ − μ cos θ)
        let exact = 9.81 * (tan - mu) / (1.0 + tan * tan).sqrt();
        let n = Vec3::new(tan, 1.0, 0.0).normalize();
        let plane = move |x: Vec3| (n.dot(x), n);
        let shapes: [&dyn SignedDistance; 2] = [&slope(tan), &plane];
        for (k, shape) in shapes.into_iter().enumerate() {
            let (first, second) = slide(shape, mu, tan);
            assert!(
                (second - first - exact).abs() < 0.01 * exact,
                "shape {k}, {mu} {tan}: {} m/s² for {exact}",
                second - first
            );
        }
    }
}

/// Found on a half-space tilted by 31°: impulses of contacts that leaked through a rounded projection made the solver diverge.
#[test]
fn solves_converge_on_tilted_ground() {
    let n = Vec3::new(0.3, 1.0, 0.2).normalize();
    let mut setup = block();
    for x in &mut setup.x {
        x[1] += 0.7;
    }
    let colliders = [Collider::half_space(n, 0.0)
        .unwrap()
        .with_friction(0.3)
        .unwrap()];
    let scene = Scene {
        gravity: GRAVITY,
        colliders: &colliders,
        ..Scene::default()
    };
    let settings = setup.solver(Start::Galerkin(1), Preconditioner::BlockJacobi, 200);
    let mut body = setup.body::<Factored>(Start::Galerkin(1));
    let mut contacts = 0;
    for step in 0..200 {
        let report = body.step(&scene, &settings);
        contacts += report.contacts;
        // The solver stops at 2⁻²² of b in its own norm.
        let left = report.relative_residual();
        assert!(left < 1e-5, "step {step}: {left:e}");
    }
    assert!(contacts > 0);
}

/// A field of constant slope is that slope.
#[test]
fn a_sloping_field_is_a_half_space() {
    for (mu, tan) in [(0.3_f32, 0.6_f32), (0.5, 0.3)] {
        let heights: Vec<f32> = (0..50 * 4).map(|n| (25 - n / 4) as f32 * tan).collect();
        let field = HeightField::new(&heights, [50, 4], [1.0, 4.0]).unwrap();
        let field = Placed::new(
            field,
            Frame::new(Vec3::new(-25.0, 0.0, -6.0), Mat3::IDENTITY).unwrap(),
        );
        let n = Vec3::new(tan, 1.0, 0.0).normalize();
        let plane = move |x: Vec3| (n.dot(x), n);
        let (of_field, of_plane) = (slide(&field, mu, tan), slide(&plane, mu, tan));
        let gained = |(first, second): (f32, f32)| second - first;
        let scale = of_plane.1.abs().max(0.1);
        assert!(
            (gained(of_field) - gained(of_plane)).abs() < 1e-3 * scale,
            "{of_field:?} for {of_plane:?}"
        );
    }
}

/// A belt at 4 m/s: the block gains μg a second up to the belt's speed, and keeps it.
#[test]
fn a_belt_drags_a_block_up_to_its_speed() {
    let (mu, speed) = (0.25_f32, 4.0);
    let setup = block();
    let mut body = setup.body(Start::Galerkin(1));
    let frame = Frame::WORLD.with_velocity(Vec3::X * speed).unwrap();
    let belt = Cuboid::new(Vec3::NEG_Y, Vec3::new(30.0, 1.0, 5.0)).unwrap();
    let mut belt = Placed::new(belt, frame);
    let mut speeds = Vec::new();
    for _ in 0..400 {
        let collider = Collider::shape(&belt).with_friction(mu).unwrap();
        run(&setup, &mut body, collider, 1);
        belt.advance(setup.h);
        speeds.push(velocity(&body).x);
    }
    // While it slides by 3 m/s or more: the friction of a step is that of its end, h μg/3 = 0.5 % less.
    let gained = (speeds[59] - speeds[29]) / (30.0 * setup.h);
    assert!(
        (gained - 9.81 * mu).abs() < 0.01 * 9.81 * mu,
        "{gained} m/s²"
    );
    // As it sticks, its shear is let go, and the block swings on its lower face.
    let fastest = speeds.iter().fold(0.0_f32, |a, &b| a.max(b));
    assert!(fastest < speed + 0.01, "{fastest} m/s");
    assert!((speeds[399] - speed).abs() < 1e-3, "{}", speeds[399]);
}

/// Drums of equal spin, a capsule's side: the block on top gains μg a second.
#[test]
fn a_drum_drags_a_block() {
    let (mu, radius, rate) = (0.25_f32, 20.0_f32, 0.5_f32);
    for sense in [-1.0, 1.0] {
        let setup = block();
        let mut body = setup.body(Start::Galerkin(1));
        // Turning about −z moves its top to +x.
        let frame = Frame::new(Vec3::NEG_Y * radius, Mat3::IDENTITY)
            .unwrap()
            .with_spin(Vec3::NEG_Z * (rate * sense))
            .unwrap();
        let drum = Capsule::new(Vec3::Z * -9.0, Vec3::Z * 9.0, radius).unwrap();
        let drum = Placed::new(drum, frame);
        let collider = Collider::shape(&drum).with_friction(mu).unwrap();
        run(&setup, &mut body, collider, 15);
        let first = velocity(&body).x;
        run(&setup, &mut body, collider, 30);
        // On its top, whose slope adds g x/R.
        let gained = sense * (velocity(&body).x - first) / (30.0 * setup.h);
        assert!(
            (gained - 9.81 * mu).abs() < 0.03 * 9.81 * mu,
            "{gained} m/s²"
        );
    }
}

/// On a turntable the block stays in its place where μg > ω²r, and goes outward where not.
#[test]
fn a_turntable_carries_a_block_round() {
    let (rate, radius) = (2.0_f32, 1.0);
    let needed = rate * rate * radius / 9.81;
    for (mu, stays) in [(1.3 * needed, true), (0.7 * needed, false)] {
        let mut setup = block();
        let frame = Frame::WORLD.with_spin(Vec3::Y * rate).unwrap();
        for (x, v) in setup.x.iter_mut().zip(&mut setup.v) {
            x[0] += radius;
            *v = frame.velocity_at(Vec3::from_array(*x)).to_array();
        }
        let mut body = setup.body(Start::Galerkin(1));
        let table = Cuboid::new(Vec3::NEG_Y, Vec3::new(5.0, 1.0, 5.0)).unwrap();
        let mut table = Placed::new(table, frame);
        // Once round, in 471 steps.
        let mut local = Vec3::ZERO;
        for step in 0..471 {
            run(
                &setup,
                &mut body,
                Collider::shape(&table).with_friction(mu).unwrap(),
                1,
            );
            table.advance(setup.h);
            let x = Vec3::from_array(body.positions()[0]);
            if step == 30 {
                local = table.frame.to_local(x);
            }
        }
        let moved = table.frame.to_local(Vec3::from_array(body.positions()[0])) - local;
        assert_eq!(moved.length() < 0.02, stays, "{mu}: {moved}");
    }
}
