//! Stacks come to rest and stay.

use femto::Scene;
use femto::collider::Collider;
use femto::glam::Vec3;
use femto::join::Assembly;
use femto::rigid::Shape;
use femto::settings::{Budget, Settings, Start};

use super::world::{AXES, World, cube, soft};

fn settings(iterations: u32) -> Settings<'static> {
    Settings::new(1.0 / 150.0)
        .unwrap()
        .with_start(Start::Galerkin(1))
        .with_budget(Budget {
            iterations,
            polar_sweeps: 2,
        })
}

/// Runs 8 s; the drift of the top body over the last 4 s, in metres a minute, and the kinetic energy at the end.
fn settle(mut world: World, settings: &Settings<'_>) -> (f64, f64, World) {
    let ground = [Collider::half_space(Vec3::Y, 0.0)
        .unwrap()
        .with_friction(0.5)
        .unwrap()];
    let scene = Scene {
        gravity: Vec3::new(0.0, -9.81, 0.0),
        colliders: &ground,
        ..Scene::default()
    };
    let mut halfway = world.centre_of(2);
    for step in 0..1200 {
        let report = world.step(&scene, settings);
        assert!(report.advanced() && report.dropped == 0, "{report:?}");
        if step == 599 {
            halfway = world.centre_of(2);
        }
    }
    let drift = (world.centre_of(2) - halfway).norm() * 15.0;
    (drift, world.body.energies(Vec3::ZERO).kinetic, world)
}

#[test]
fn a_stack_of_soft_cubes() {
    for (iterations, young) in [(2, 2e6), (5, 2e6), (10, 2e6), (10, 2e5)] {
        let settings = settings(iterations);
        let mut parts = Assembly::new();
        let material = soft(young).with_damping(0.0, 0.002).unwrap();
        for k in 0..3 {
            let k = k as f32;
            let mesh = cube(0.2, 2, [0.01 * k, 0.205 * k, 0.015 * k]);
            parts.soft(&mesh.nodes, &mesh.tets, material, 0.5).unwrap();
        }
        let (drift, kinetic, world) = settle(World::new(parts, &settings, 128), &settings);
        println!("E {young:e}, {iterations} iterations: {drift:.2e} m a minute, {kinetic:.2e} J");
        // 0.5 m, 24 kg: it would take 70 J to fall over.
        assert!(world.centre_of(2).y > 0.48 && kinetic < 1e-4, "{kinetic:e}");
        assert!(drift < 0.02, "{drift:e}");
    }
}

#[test]
fn a_stack_of_rigid_boxes() {
    for iterations in [2, 5, 10] {
        let settings = settings(iterations);
        let mut parts = Assembly::new();
        let shape = Shape::Cuboid {
            half: Vec3::splat(0.1),
        };
        for k in 0..3 {
            let at = Vec3::new(0.01 * k as f32, 0.1 + 0.202 * k as f32, 0.0);
            parts.rigid(shape, 3.0, at, AXES, 0.5, &soft(1e5)).unwrap();
        }
        let (drift, kinetic, world) = settle(World::new(parts, &settings, 64), &settings);
        println!("rigid, {iterations} iterations: {drift:.2e} m a minute, {kinetic:.2e} J");
        // Depths of h²g/4 times the load: three boxes, two, one; 6 in all, where corners take a quarter each.
        let depth = 9.81 / 150.0 / 150.0 / 4.0;
        assert!(
            (0.5 - world.centre_of(2).y) < 12.0 * depth,
            "{}",
            world.centre_of(2).y
        );
        assert!(kinetic < 1e-7 && drift < 1e-3, "{kinetic:e} {drift:e}");
    }
}
