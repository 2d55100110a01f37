//! What colliders say that they did: impulses that push and do no work, whatever the budget, and the f64 system's own when
//! the solve has converged.

use femto::collider::Capsule;
use femto::glam::Vec3;
use femto::owned::OwnedBody;
use femto::settings::Settings;
use femto::{Collider, Pin, Preconditioner, Scene, Start};
use proptest::prelude::*;

use crate::oracle::{self, V, v};
use crate::support::account::frozen_rotations;
use crate::support::meshes::{box_mesh, jitter};
use crate::support::reference::stack;
use crate::support::scenes::Setup;

const GRAVITY: Vec3 = Vec3::new(0.0, -9.81, 0.0);
const RADIUS: f32 = 0.35;
const CENTRE: Vec3 = Vec3::new(0.75, -0.4, 0.75);
const FROM: Vec3 = Vec3::new(0.4, -0.45, 0.3);
const TO: Vec3 = Vec3::new(1.1, -0.3, 1.2);
/// Some roundings of coordinates of one or two metres.
const MARGIN: f64 = 8.0 * f32::EPSILON as f64;

/// A plane, a ball or a capsule, in f64.
fn distance(which: usize, x: V) -> f64 {
    match which {
        0 => x.y,
        1 => (x - v(CENTRE)).norm() - f64::from(RADIUS),
        _ => oracle::capsule(x, v(FROM), v(TO), RADIUS.into()),
    }
}

/// The gradient of the distance, by differences.
fn normal(which: usize, x: V) -> V {
    V::from_fn(|axis, _| {
        let step = V::ith(axis, 1e-5);
        (distance(which, x + step) - distance(which, x - step)) / 2e-5
    })
    .normalize()
}

fn cube(young: f32, velocity: Vec3, seed: u64) -> Setup {
    let mut setup = Setup::new("cube", jitter(&box_mesh([0.5; 3], [3; 3]), 0.01, seed));
    (setup.young, setup.gravity) = (young, GRAVITY.to_array());
    for (x, v) in setup.x.iter_mut().zip(&mut setup.v) {
        *x = (Vec3::from_array(*x) + Vec3::new(0.5, 0.05, 0.55)).to_array();
        *v = velocity.to_array();
    }
    setup
}

fn points(body: &OwnedBody) -> Vec<V> {
    let positions = body.positions().iter();
    positions.map(|x| v(Vec3::from_array(*x))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(64) })]
    #[test]
    fn colliders_push_and_do_no_work(
        which in 0..3_usize,
        stiff in 4.0..9.0_f32,
        velocity in prop::array::uniform3(-1.0_f32..1.0),
        friction in prop::sample::select(vec![0.0_f32, 0.3, 1.0]),
        start in prop::sample::select(vec![Start::Zero, Start::Galerkin(1), Start::Rigid(1)]),
        iterations in 0..20_u32,
        seed in any::<u64>(),
    ) {
        let setup = cube(10_f32.powf(stiff), Vec3::from_array(velocity), seed);
        let capsule = Capsule::new(FROM, TO, RADIUS).unwrap();
        let shape = match which {
            0 => Collider::half_space(Vec3::Y, 0.0).unwrap(),
            1 => Collider::sphere(CENTRE, RADIUS).unwrap(),
            _ => Collider::shape(&capsule),
        };
        let colliders = [shape.with_friction(friction).unwrap()];
        let scene = Scene { gravity: GRAVITY, colliders: &colliders, ..Scene::default() };
        let settings = setup.solver(start, Preconditioner::Jacobi, iterations);
        let mut body: OwnedBody = setup.body(start);
        let curvature = if which == 0 { 0.0 } else { 1.0 / f64::from(RADIUS) };
        let mut pushes = 0;
        for step in 0..100 {
            let before = points(&body);
            let report = body.step(&scene, &settings);
            prop_assert!(report.advanced());
            for ((j, x), x_new) in body.reactions(&settings).zip(&before).zip(points(&body)) {
                let (j, n, moved) = (v(j), normal(which, *x), x_new - x);
                let rounding = 1e-5 * (j.norm() + f64::from(report.residual_after));
                prop_assert!(j.dot(&n) >= -rounding, "step {step}: pulls by {:e}", -j.dot(&n));
                // A curve falls away from its tangent by this on a node's way.
                let chord = curvature * moved.norm_squared();
                let work = j.dot(&moved);
                let small = j.norm() * (MARGIN + chord) + rounding * moved.norm();
                prop_assert!(work <= small, "step {step}: work {work:e} J, of rounding {small:e}");
                pushes += u32::from(j.dot(&n) > rounding);
            }
        }
        prop_assert!(pushes > 0 || start == Start::Zero);
    }
}

/// The residual of the f64 system is the impulse that is reported, when nothing else is left of it.
#[test]
fn reactions_are_the_residual_of_the_dense_system() {
    for young in [1e4, 1e6] {
        let setup = cube(young, Vec3::new(0.2, -1.0, 0.0), 7);
        let colliders = [Collider::half_space(Vec3::Y, 0.0).unwrap()];
        let scene = Scene {
            gravity: GRAVITY,
            colliders: &colliders,
            ..Scene::default()
        };
        let settings = setup.solver(Start::Galerkin(1), Preconditioner::BlockJacobi, 200);
        let mut body: OwnedBody = setup.body(Start::Galerkin(1));
        let mut oracle = setup.reference();
        let (mut pushed, mut off) = (0.0, 0.0);
        for _ in 0..60 {
            let q = frozen_rotations(&body.state().view(), setup.mesh.tets.len());
            (oracle.x, oracle.v) = (stack(body.positions()), stack(body.velocities()));
            let (a, b) = oracle.system(&q);
            assert!(body.step(&scene, &settings).advanced());
            let left = a * ((stack(body.positions()) - &oracle.x) / oracle.h) - b;
            for (i, j) in body.reactions(&settings).enumerate() {
                let expected = V::new(left[3 * i], left[3 * i + 1], left[3 * i + 2]);
                pushed += v(j).norm();
                off += (v(j) - expected).norm();
            }
        }
        assert!(
            pushed > 1.0 && off < 1e-3 * pushed,
            "E = {young:e}: {off:e} of {pushed:e}"
        );
    }
}

/// A bar that hangs at rest pulls at its pins with its weight; without pins there are no reactions.
#[test]
fn pins_carry_the_weight() {
    let mut setup = Setup::new("bar", box_mesh([0.2, 1.0, 0.2], [2, 8, 2]));
    (setup.young, setup.alpha, setup.beta) = (1e5, 2.0, 0.05);
    let pins: Vec<Pin> = (0_u32..)
        .zip(&setup.x)
        .filter(|(_, x)| x[1] > 0.99)
        .map(|(node, _)| Pin::held(node))
        .collect();
    let settings: Settings = setup.solver(Start::Galerkin(1), Preconditioner::BlockJacobi, 60);
    let mut body: OwnedBody = setup.body(Start::Galerkin(1));
    let mut sum = |pins: &[Pin], steps: u32| {
        let scene = Scene {
            gravity: GRAVITY,
            pins,
            ..Scene::default()
        };
        for _ in 0..steps {
            assert!(body.step(&scene, &settings).advanced());
        }
        assert_eq!(body.reactions(&settings).len(), setup.x.len());
        let sum = body.reactions(&settings).fold(Vec3::ZERO, |a, b| a + b);
        let weight = f64::from(body.rest().header.total_mass) * 9.81 * f64::from(setup.h);
        v(sum) / weight
    };
    let hung = sum(&pins, 600);
    assert!((hung - V::y()).norm() < 1e-3, "{hung}");
    assert_eq!(sum(&[], 1), V::zeros());
}
