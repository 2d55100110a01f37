//! Contacts push, and never pull: collisions of soft bodies, and of a soft with a rigid one.

use femto::Scene;
use femto::glam::Vec3;
use femto::join::Assembly;
use femto::settings::{Budget, Settings, Start};

use proptest::prelude::*;

use nalgebra::Vector3;

use super::support::meshes::TetMesh;
use super::world::{AXES, World, ball, cube, soft};

fn settings(start: Start, iterations: u32, h: f32) -> Settings<'static> {
    Settings::new(h)
        .unwrap()
        .with_start(start)
        .with_budget(Budget {
            iterations,
            polar_sweeps: 2,
        })
}

/// A ball of `radius` about `centre`, from a cube's grid.
fn soft_ball(radius: f64, cells: usize, centre: [f32; 3]) -> TetMesh {
    let mut mesh = cube(2.0, cells, [-1.0; 3]);
    for node in &mut mesh.nodes {
        let [x, y, z] = node.map(f64::from);
        let largest = x.abs().max(y.abs()).max(z.abs());
        let length = (x * x + y * y + z * z).sqrt();
        let scale = if length > 0.0 {
            radius * largest / length
        } else {
            0.0
        };
        *node = core::array::from_fn(|a| centre[a] + (scale * [x, y, z][a]) as f32);
    }
    mesh
}

fn cubes(settings: &Settings<'_>, young: f32, tilt: f32) -> World {
    let mut parts = Assembly::new();
    for at in [[0.0; 3], [0.45, 0.03, 0.05]] {
        let mesh = cube(0.4, 4, at);
        parts
            .soft(&mesh.nodes, &mesh.tets, soft(young), 0.3)
            .unwrap();
    }
    let mut world = World::new(parts, settings, 256);
    world.throw(&[
        (Vec3::X, Vec3::ZERO),
        (Vec3::new(-1.0, tilt, 0.0), Vec3::Z * tilt),
    ]);
    world
}

fn balls(settings: &Settings<'_>, young: f32, tilt: f32) -> World {
    let mut parts = Assembly::new();
    let mesh = soft_ball(0.2, 4, [0.0, 0.0, 0.0]);
    parts
        .soft(&mesh.nodes, &mesh.tets, soft(young), 0.3)
        .unwrap();
    parts
        .rigid(
            ball(0.2),
            30.0,
            Vec3::new(0.42, 0.02, 0.0),
            AXES,
            0.3,
            &soft(young),
        )
        .unwrap();
    let mut world = World::new(parts, settings, 256);
    world.throw(&[
        (Vec3::X, Vec3::Y * tilt),
        (Vec3::new(-1.0, tilt, 0.0), Vec3::ZERO),
    ]);
    world
}

/// Over a collision: the impulses that bodies gave each other, and what of the first one's change of momentum is not theirs.
fn pushed(mut world: World, settings: &Settings<'_>) -> Result<[f64; 2], TestCaseError> {
    let [mut pushes, mut unexplained] = [0.0; 2];
    let first = world.parts.parts[0].nodes.clone();
    for _ in 0..100 {
        let before = world.linear_of(0);
        let report = world.step(&Scene::default(), settings);
        prop_assert!(report.advanced() && report.dropped == 0, "{report:?}");
        let mut sum = Vector3::zeros();
        for slot in &world.slots {
            let (n, impulse) = (slot.normal(), slot.impulse().map(f64::from));
            let push: f64 = n.iter().zip(impulse).map(|(n, j)| f64::from(*n) * j).sum();
            // A slot that does not act gives nothing, of either sign; the rest is the rounding of this product.
            let rounding = 4.0 * f64::from(f32::EPSILON) * Vector3::from(impulse).norm();
            prop_assert!(push >= -rounding, "{push}: {slot:?}");
            pushes += push;
            let own = slot.weights().take(4).find(|(_, w)| *w != 0.0);
            let side = own.is_some_and(|(node, _)| first.contains(&(node as usize)));
            sum += Vector3::from(impulse) * if side { 1.0 } else { -1.0 };
        }
        unexplained += (world.linear_of(0) - before - sum).norm();
    }
    Ok([pushes, unexplained])
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(16) })]
    #[test]
    fn contacts_never_pull(
        rigid in any::<bool>(),
        stiff in 4.5..7.5_f32,
        tilt in 0.0..0.6_f32,
        history in 0..3_u8,
        iterations in prop::sample::select(vec![0, 1, 2, 3, 5, 10, 60]),
    ) {
        let settings = settings(Start::Galerkin(history), iterations, 1.0 / 150.0);
        let make = if rigid { balls } else { cubes };
        let [pushes, unexplained] = pushed(make(&settings, 10_f32.powf(stiff), tilt), &settings)?;
        prop_assert!(iterations == 0 || pushes > 10.0, "{pushes}");
        // That is no matter of book-keeping: what the solver leaves where one let go is residual, and goes with the number of
        // iterations (of stiffer bodies later: at 3e7 Pa, 60 are not enough). Of 400 cases: some 3 % at most.
        let converged = iterations == 60 && stiff < 6.0;
        prop_assert!(!converged || unexplained < 0.05 * pushes, "{unexplained} of {pushes}");
    }
}
