//! Bodies that fall on every shape: nobody enters, nothing pulls, no energy comes from nowhere.

use femto::collider::{Capsule, Cuboid, HeightField, Placed};
use femto::glam::{Mat3, Vec3};
use femto::{Collider, Frame, Preconditioner, Scene, Start};
use proptest::prelude::*;

use crate::oracle::{self, Ground, V, v};
use crate::support::account::account;
use crate::support::meshes::{box_mesh, jitter};
use crate::support::scenes::Setup;

const GRAVITY: Vec3 = Vec3::new(0.0, -9.81, 0.0);

/// Where the shapes below are; unturned, so that the oracles need no frame.
const HEIGHTS: [f32; 16] = [
    0.1, 0.0, 0.2, 0.1, -0.1, -0.2, 0.0, 0.3, 0.2, -0.3, -0.1, 0.2, 0.1, 0.2, 0.3, 0.1,
];
const SPACING: f32 = 0.5;
const FROM: Vec3 = Vec3::new(0.4, -0.45, 0.3);
const TO: Vec3 = Vec3::new(1.1, -0.3, 1.2);
const RADIUS: f32 = 0.35;
const CENTRE: Vec3 = Vec3::new(0.75, -0.4, 0.75);
const HALF: Vec3 = Vec3::new(0.4, 0.3, 0.5);

/// What a shape's surface may be off by: some roundings of coordinates of one or two metres.
const MARGIN: f64 = 8.0 * f32::EPSILON as f64;

/// A cube that is thrown onto shape `which` of five.
#[derive(Debug)]
struct Throw {
    which: usize,
    seed: u64,
    young: f32,
    velocity: Vec3,
    friction: f32,
    start: Start,
    iterations: u32,
}

fn throw(youngs: std::ops::Range<f32>) -> impl Strategy<Value = Throw> {
    let start = prop_oneof![
        Just(Start::Zero),
        Just(Start::Galerkin(1)),
        Just(Start::Rigid(1))
    ];
    let velocity = prop::array::uniform3(-1.0_f32..1.0).prop_map(Vec3::from_array);
    (
        0_usize..5,
        any::<u64>(),
        youngs.prop_map(|exponent| 10_f32.powf(exponent)),
        velocity,
        0.0_f32..1.0,
        start,
        0_u32..20,
    )
        .prop_map(
            |(which, seed, young, velocity, friction, start, iterations)| Throw {
                which,
                seed,
                young,
                velocity,
                friction,
                start,
                iterations,
            },
        )
}

/// Throws it. After each step: nobody inside, and no more energy than at first. With the guard, no more than before
/// the step, by the account of the theorem (rotations of the step's begin: those of its end are another matter, which
/// contact has no part in).
fn drop_on(thrown: &Throw, guard: bool) -> Result<(), TestCaseError> {
    let &Throw { which, seed, .. } = thrown;
    let mut setup = Setup::new("cube", jitter(&box_mesh([0.5; 3], [3; 3]), 0.01, seed));
    (setup.young, setup.gravity) = (thrown.young, GRAVITY.to_array());
    for (x, v) in setup.x.iter_mut().zip(&mut setup.v) {
        *x = (Vec3::from_array(*x) + Vec3::new(0.5, 0.45, 0.55)).to_array();
        *v = thrown.velocity.to_array();
    }
    let capsule = Capsule::new(FROM, TO, RADIUS).unwrap();
    let cuboid = Cuboid::new(CENTRE, HALF).unwrap();
    let field = HeightField::new(&HEIGHTS, [4, 4], [SPACING; 2]).unwrap();
    // A bowl, of one's own.
    let bowl = |x: Vec3| {
        let from = x - Vec3::new(0.75, 1.0, 0.75);
        (1.3 - from.length(), -from.normalize())
    };
    let shape = match which {
        0 => Collider::shape(&capsule),
        1 => Collider::shape(&cuboid),
        2 => Collider::shape(&field),
        3 => Collider::half_space(Vec3::Y, 0.0).unwrap(),
        _ => Collider::shape(&bowl),
    };
    let ground = Ground {
        heights: HEIGHTS.to_vec(),
        samples: [4, 4],
        spacing: [SPACING.into(); 2],
    };
    // Beyond its border the field goes on level: the oracle is asked at the border.
    let edge = 3.0 * f64::from(SPACING) - 1e-9;
    let exact = |x: V| match which {
        0 => oracle::capsule(x, v(FROM), v(TO), RADIUS.into()),
        1 => oracle::cuboid(x, v(CENTRE), v(HALF)),
        2 => ground.above(V::new(x.x.clamp(1e-9, edge), x.y, x.z.clamp(1e-9, edge))),
        3 => x.y,
        _ => f64::from(1.3_f32) - (x - V::new(0.75, 1.0, 0.75)).norm(),
    };
    let colliders = [shape.with_friction(thrown.friction).unwrap()];
    let scene = Scene {
        gravity: GRAVITY,
        colliders: &colliders,
        ..Scene::default()
    };
    let mut settings = setup.solver(thrown.start, Preconditioner::Jacobi, thrown.iterations);
    if guard {
        settings = settings.with_energy_guard();
    }
    let mut body = setup.body::<femto::element::Factored>(thrown.start);
    let first = body.energies(GRAVITY).total();
    let mut touched = 0;
    for step in 0..100 {
        if guard {
            let account = account(&setup, &mut body, &scene, &settings);
            prop_assert!(
                account.rise <= account.rounding,
                "shape {which}, step {step}: {:e} of {first:e}, rounding {:e}",
                account.rise,
                account.rounding
            );
        } else {
            prop_assert!(body.step(&scene, &settings).advanced());
        }
        let near = |&x: &[f32; 3]| exact(v(Vec3::from_array(x))) < 0.02;
        touched += u32::from(body.positions().iter().any(near));
        for x in body.positions() {
            let d = exact(v(Vec3::from_array(*x)));
            prop_assert!(d > -MARGIN, "shape {which}, step {step}: {d:e}");
        }
        let now = body.energies(GRAVITY).total();
        prop_assert!(
            now <= first || guard,
            "shape {which}, step {step}: {now} of {first}"
        );
    }
    // From rest with few iterations, none gets that far.
    prop_assert!(touched > 0 || thrown.start == Start::Zero);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn nobody_enters_and_no_energy_comes_from_nowhere(thrown in throw(4.0..6.0)) {
        drop_on(&thrown, false)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn with_the_guard_no_step_adds_energy_however_stiff(thrown in throw(4.0..9.0)) {
        drop_on(&thrown, true)?;
    }
}

/// A cube at rest on the top of a shape at y = 0, thrown upwards, leaves in one step, with its whole momentum.
#[test]
fn nothing_pulls() {
    let turned = Frame::new(
        Vec3::new(0.25, -1.0, 0.25),
        Mat3::from_rotation_z(core::f32::consts::FRAC_PI_2),
    )
    .unwrap();
    let top = Placed::new(
        Cuboid::new(Vec3::ZERO, Vec3::new(1.0, 2.0, 3.0)).unwrap(),
        turned,
    );
    let flat = [0.0; 4];
    let field = HeightField::new(&flat, [2, 2], [1.0; 2]).unwrap();
    let drum = Capsule::new(Vec3::new(0.25, -3.0, -9.0), Vec3::new(0.25, -3.0, 9.0), 3.0).unwrap();
    let plane = |x: Vec3| (x.y, Vec3::Y);
    for shape in [
        Collider::shape(&top),
        Collider::shape(&field),
        Collider::shape(&drum),
        Collider::shape(&plane),
    ] {
        let colliders = [shape.with_friction(0.5).unwrap()];
        let scene = Scene {
            gravity: GRAVITY,
            colliders: &colliders,
            ..Scene::default()
        };
        let setup = Setup::new("cube", box_mesh([0.5; 3], [3; 3]));
        let settings = setup.solver(Start::Galerkin(1), Preconditioner::BlockJacobi, 20);
        let mut body = setup.body::<femto::element::Factored>(Start::Galerkin(1));
        let mut resting = 0;
        for _ in 0..150 {
            resting = body.step(&scene, &settings).contacts;
        }
        assert!(resting > 0, "{colliders:?}");
        let (x, thrown) = (
            body.positions().to_vec(),
            vec![[0.0, 2.0, 0.0]; setup.v.len()],
        );
        body.place(&x, &thrown).unwrap();
        let report = body.step(&scene, &settings);
        assert_eq!(report.contacts, 0, "{colliders:?}");
        let mass = f64::from(body.rest().header.total_mass);
        let speed = body.momenta().linear[1] / mass;
        assert!((speed - (2.0 - 9.81 / 150.0)).abs() < 1e-5, "{speed}");
    }
}

/// A box that turns like a paddle sweeps a free cube along: nobody is inside it where it is after the step.
#[test]
fn a_paddle_sweeps_and_is_not_entered() {
    for rate in [-6.0_f32, 6.0] {
        let frame = Frame::new(Vec3::ZERO, Mat3::from_rotation_z(0.3 * rate.signum()))
            .unwrap()
            .with_spin(Vec3::Z * -rate)
            .unwrap();
        let half = Vec3::new(2.0, 0.05, 1.0);
        let mut paddle = Placed::new(Cuboid::new(Vec3::ZERO, half).unwrap(), frame);
        let mut setup = Setup::new("cube", jitter(&box_mesh([0.3; 3], [2; 3]), 0.01, 3));
        for x in &mut setup.x {
            *x = (Vec3::from_array(*x) + Vec3::new(0.8 * rate.signum() - 0.15, -0.2, -0.15))
                .to_array();
        }
        let mut body = setup.body::<femto::element::Factored>(Start::Galerkin(1));
        let mut fastest = 0.0_f64;
        for step in 0..60 {
            let colliders = [Collider::shape(&paddle).with_friction(0.3).unwrap()];
            let scene = Scene {
                gravity: GRAVITY,
                colliders: &colliders,
                ..Scene::default()
            };
            let settings = setup.solver(Start::Galerkin(1), Preconditioner::Jacobi, 10);
            assert!(body.step(&scene, &settings).advanced());
            paddle.advance(setup.h);
            for x in body.positions() {
                let p = paddle.frame.to_local(Vec3::from_array(*x));
                let d = oracle::cuboid(v(p), V::zeros(), v(half));
                assert!(d > -4.0 * MARGIN, "step {step}: {d:e}");
            }
            fastest = fastest
                .max(body.momenta().linear[1].abs() / f64::from(body.rest().header.total_mass));
        }
        assert!(fastest > 3.0, "swept at {fastest} m/s only");
    }
}

/// A sphere written by the user is the crate's sphere, bit for bit.
#[test]
fn a_function_of_ones_own_is_as_good() {
    let (centre, radius) = (Vec3::new(0.2, -0.5, 0.3), 0.45);
    let own = move |x: Vec3| {
        let from = x - centre;
        let length = femto::math::sqrt(from.dot(from));
        (length - radius, from * (1.0 / length))
    };
    let run = |collider: Collider<'_>| {
        let setup = Setup::new("cube", jitter(&box_mesh([0.5; 3], [2; 3]), 0.01, 9));
        let colliders = [collider.with_friction(0.4).unwrap()];
        let scene = Scene {
            gravity: GRAVITY,
            colliders: &colliders,
            ..Scene::default()
        };
        let settings = setup.solver(Start::Galerkin(1), Preconditioner::Jacobi, 5);
        let mut body = setup.body::<femto::element::Factored>(Start::Galerkin(1));
        let mut contacts = 0;
        for _ in 0..200 {
            contacts += body.step(&scene, &settings).contacts;
        }
        assert!(contacts > 0);
        body.positions().to_vec()
    };
    assert_eq!(
        run(Collider::shape(&own)),
        run(Collider::sphere(centre, radius).unwrap())
    );
}
