//! Edges against edges: beams that cross, whose nodes meet nothing.

use femto::Scene;
use femto::glam::{Quat, Vec3};
use femto::join::Assembly;
use femto::settings::{Budget, Settings, Start};
use femto::surface::{boundary_triangles, sharp_edges};
use nalgebra::Vector3;
use proptest::prelude::*;

use super::support::meshes::{TetMesh, box_mesh};
use super::world::{World, cube, soft};

const THICK: f64 = 0.1;
const CELL: f64 = 0.4;

/// A beam of three cells along x about the origin, turned by 45° about x so that it lies on an edge.
fn beam() -> TetMesh {
    let mut mesh = box_mesh([3.0 * CELL, THICK, THICK], [3, 1, 1]);
    let half = [1.5 * CELL, 0.5 * THICK, 0.5 * THICK].map(|x| x as f32);
    let turn = Quat::from_rotation_x(core::f32::consts::FRAC_PI_4);
    for node in &mut mesh.nodes {
        *node = (turn * (Vec3::from_array(*node) - Vec3::from_array(half))).to_array();
    }
    mesh
}

/// One beam along x at the origin, and one across it, `over` from edge to edge, moved by `by` and turned by `turn` about y.
fn crossed(over: f32, by: [f32; 2], turn: f32, friction: f32, edges: bool) -> World {
    let mut parts = Assembly::new();
    let lower = beam();
    let mut upper = lower.clone();
    let rotation = Quat::from_rotation_y(turn);
    let height = over + (THICK * 2_f64.sqrt()) as f32;
    for node in &mut upper.nodes {
        let at = rotation * Vec3::from_array(*node) + Vec3::new(by[0], height, by[1]);
        *node = at.to_array();
    }
    for mesh in [lower, upper] {
        parts
            .soft(&mesh.nodes, &mesh.tets, soft(2e6), friction)
            .unwrap();
    }
    if edges {
        parts.touch_by_edges();
    }
    World::new(parts, &settings(), 256)
}

fn settings() -> Settings<'static> {
    Settings::new(1.0 / 150.0)
        .unwrap()
        .with_start(Start::Rigid(1))
        .with_budget(Budget {
            iterations: 20,
            polar_sweeps: 2,
        })
}

const RIGHT: f32 = core::f32::consts::FRAC_PI_2;

#[test]
fn crossed_beams_pass_through_each_other_by_their_nodes_and_not_by_their_edges() {
    for speed in [0.2, 1.0, 5.0] {
        for edges in [false, true] {
            let mut world = crossed(0.02, [0.03, -0.02], RIGHT, 0.3, edges);
            world.throw(&[(Vec3::ZERO, Vec3::ZERO), (Vec3::NEG_Y * speed, Vec3::ZERO)]);
            let mut touched = 0;
            for _ in 0..(0.4 / speed * 150.0) as usize {
                let report = world.step(&Scene::default(), &settings());
                assert!(report.advanced() && report.dropped == 0);
                touched += report.couplings;
            }
            let above = world.centre_of(1).y - world.centre_of(0).y;
            if edges {
                assert!(touched > 0 && above > 0.12, "{speed}: {above}");
            } else {
                assert!(touched == 0 && above < -0.12, "{speed}: {above}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn beams_exchange_momentum_exactly(
        by in [-0.15_f32..0.15, -0.15_f32..0.15],
        turn in 0.3_f32..2.8,
        speed in 0.5_f32..4.0,
        spin in -2.0_f32..2.0,
        friction in prop_oneof![Just(0.0_f32), Just(0.5)],
    ) {
        let mut world = crossed(0.01, by, turn, friction, true);
        world.throw(&[(Vec3::Y * speed, Vec3::Y * spin), (Vec3::NEG_Y * speed, Vec3::ZERO)]);
        let (linear, angular) = (world.linear(), world.angular());
        let (mut touched, mut couple, mut stretch) = (0, 0.0, 0.0_f64);
        for _ in 0..20 {
            stretch = stretch.max(world.body.energies(Vec3::ZERO).elastic);
            let report = world.step(&Scene::default(), &settings());
            prop_assert!(report.advanced());
            touched += report.couplings;
            // Friction acts at two points that are a gap apart.
            for slot in world.slots.iter().filter(|slot| slot.is_active()) {
                let (j, n) = (Vec3::from_array(slot.impulse()), Vec3::from_array(slot.normal()));
                couple += f64::from((j - n * n.dot(j)).length() * slot.gap().abs());
            }
        }
        prop_assert!(touched > 0);
        let size = 2.0 * world.mass_of(0) * f64::from(speed);
        // Each step rounds means of velocities.
        let rounding = 20.0 * 4.0 * f64::from(f32::EPSILON) * size;
        prop_assert!((world.linear() - linear).norm() < rounding);
        // What frozen rotations leave of the impulse's moment at the beams' half length: their strain, √(2e/(E V)).
        let strain = (2.0 * stretch / (2e6 * 2.0 * 3.0 * CELL * THICK * THICK)).sqrt();
        let drift = (world.angular() - angular).norm();
        prop_assert!(drift < couple + strain * 1.5 * CELL * size + rounding, "{} {} {}", drift, couple, strain);
    }
}

/// The points that touch are where the lines of both edges are nearest to each other, as f64 has it, and the normal is
/// square to both.
#[test]
fn the_points_are_the_nearest_of_both_lines() {
    let mut looked_at = 0;
    for k in 0..40_u8 {
        let part = f32::from(k) / 40.0;
        let over = [0.002, -0.004][usize::from(k % 2)];
        let mut world = crossed(
            over,
            [0.25 * part, 0.1 - 0.2 * part],
            0.4 + 2.2 * part,
            0.0,
            true,
        );
        world.throw(&[(Vec3::Y, Vec3::ZERO), (Vec3::NEG_Y, Vec3::X)]);
        let x: Vec<_> = world
            .body
            .positions()
            .iter()
            .map(|x| Vector3::from(x.map(f64::from)))
            .collect();
        assert!(world.step(&Scene::default(), &settings()).advanced());
        for slot in world.slots.iter().filter(|slot| slot.normal() != [0.0; 3]) {
            let pairs: Vec<(usize, f64)> = slot
                .weights()
                .map(|(n, w)| (n as usize, f64::from(w)))
                .collect();
            if pairs[1].1 == 0.0 {
                continue; // a node and a triangle
            }
            let (a, d) = (x[pairs[0].0], x[pairs[1].0] - x[pairs[0].0]);
            let (b, e) = (x[pairs[4].0], x[pairs[5].0] - x[pairs[4].0]);
            // Where the plane of one line and n holds the other line.
            let n = d.cross(&e);
            let s = (b - a).cross(&e).dot(&n) / n.norm_squared();
            let t = (b - a).cross(&d).dot(&n) / n.norm_squared();
            assert!(
                (s - pairs[1].1).abs() < 1e-4 && (t + pairs[5].1).abs() < 1e-4,
                "{s} {t} {pairs:?}"
            );
            let normal = Vector3::from(slot.normal().map(f64::from));
            assert!((n.normalize().dot(&normal).abs() - 1.0).abs() < 1e-6);
            assert!(normal.y.abs() > 0.9, "{normal}");
            let gap = normal.dot(&(a + d * s - b - e * t));
            assert!(
                (gap - f64::from(slot.gap())).abs() < 1e-6,
                "{gap} {}",
                slot.gap()
            );
            assert!((gap - f64::from(over)).abs() < 1e-6);
            looked_at += 1;
        }
    }
    assert!(looked_at >= 30, "{looked_at}");
}

#[test]
fn sharp_edges_are_those_of_a_box() {
    let mesh = cube(0.4, 3, [0.0; 3]);
    let edges = sharp_edges(&mesh.nodes, &boundary_triangles(&mesh.tets));
    assert_eq!(edges.len(), 12 * 3);
    for [i, j, ..] in edges {
        let on = |n: u32| mesh.nodes[n as usize].map(|x| !(1e-6..=0.4 - 1e-6).contains(&x));
        let both = (0..3).filter(|&k| on(i)[k] && on(j)[k]).count();
        assert!(both >= 2);
    }
    assert!(sharp_edges(&mesh.nodes, &[]).is_empty());
}
