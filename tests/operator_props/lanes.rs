//! Lane widths and units are of no account, to the bit: kernels, and whole steps with pins, contact,
//! friction, and every start and preconditioner.

use femto::collider::Collider;
use femto::element::{Dense, Factored, Layout};
use femto::glam::Vec3;
use femto::lane::{Lanes, Native};
use femto::operator::{Fit, Operator, RotationBlock, fit_rotations, rotate};
use femto::owned::{OwnedState, OwnedWorkspace};
use femto::settings::{Preconditioner, Start};
use femto::step::{Scene, step};
use proptest::prelude::*;
use wide::{f32x4, f32x8};

use super::support::meshes::{box_mesh, jitter};
use super::support::scenes::Setup;
use super::{any_setup, any_vector, noise, rest};

/// A small body that falls, spins and slides on a tilted ground with friction and against a moving ball,
/// in units of `length`, `mass` and `time`.
struct Slide {
    setup: Setup,
    forces: Vec<[f32; 3]>,
    colliders: [Collider<'static>; 2],
}

impl Slide {
    fn new(pinned: bool, theta: f32, [length, mass, time]: [f32; 3]) -> Self {
        let mesh = jitter(&box_mesh([1.0, 0.25, 0.25], [3, 2, 2]).ordered(), 0.02, 5);
        let mut setup = Setup::new("slide", mesh).spinning([0.5, 2.0, 1.0]);
        if pinned {
            setup = setup.pinned(|x| x[0] < 0.05 && x[1] < 0.05, |x| [0.0, 0.1 * x[2], 0.0]);
        }
        // Pressed flat, so that it swells against the ground.
        setup.x.iter_mut().for_each(|x| x[1] *= 0.8);
        let speed = length / time;
        let scaled = |u: Vec<[f32; 3]>, by: f32| {
            u.into_iter().map(|u| u.map(|c| c * by)).collect::<Vec<_>>()
        };
        (setup.mesh.nodes, setup.x) = (scaled(setup.mesh.nodes, length), scaled(setup.x, length));
        setup.v = scaled(setup.v, speed);
        setup
            .pins
            .iter_mut()
            .for_each(|(_, v)| *v = v.map(|c| c * speed));
        setup.gravity = [0.5, -9.81, 0.25].map(|g| g * speed / time);
        setup.young = 1e5 * (mass / length / time / time);
        setup.density = 1000.0 * (mass / length / length / length);
        (setup.alpha, setup.beta) = (0.5 / time, 0.001 * time);
        (setup.h, setup.theta) = (0.01 * time, theta);
        let forces = scaled(noise(setup.x.len(), 5.0, 3), mass * length / time / time);
        let ground = Collider::half_space(Vec3::new(0.1, 1.0, -0.05), -0.01 * length).unwrap();
        let ball = Collider::sphere(Vec3::new(0.5, 0.375, 0.1) * length, 0.13 * length).unwrap();
        let ball = ball
            .with_friction(0.2)
            .unwrap()
            .with_velocity(Vec3::new(0.1, -1.0, 0.0) * speed)
            .unwrap();
        Self {
            setup,
            forces,
            colliders: [ground.with_friction(0.4).unwrap(), ball],
        }
    }

    /// x; v and its history; rotations; the report's numbers: after every step. And the contacts there were.
    fn run<R: Lanes, L: Layout>(
        &self,
        start: Start,
        preconditioner: Preconditioner,
        steps: usize,
    ) -> (Vec<[Vec<f32>; 4]>, u32) {
        let rest = rest::<L>(&self.setup);
        let rest = rest.view();
        let mut state = OwnedState::new(&rest, start);
        state
            .view_mut()
            .place(&rest, &self.setup.x, &self.setup.v)
            .unwrap();
        let mut work = OwnedWorkspace::new(&rest, start);
        let pins = self.setup.pin_list();
        let scene = Scene {
            forces: &self.forces,
            colliders: &self.colliders,
            ..self.setup.scene(&pins)
        };
        let settings = self
            .setup
            .settings()
            .with_start(start)
            .with_preconditioner(preconditioner);
        let (mut out, mut contacts) = (Vec::new(), 0);
        for _ in 0..steps {
            let report = step::<R, L>(
                &rest,
                &mut state.view_mut(),
                &mut work.view_mut(&rest),
                &scene,
                &settings,
            );
            assert!(report.advanced(), "{report:?}");
            contacts += report.contacts;
            let now = state.view();
            let rotations = now
                .rotations
                .iter()
                .flat_map(|block| block.0)
                .flatten()
                .collect();
            let speeds = now.v.iter().chain(now.history).flatten().copied().collect();
            let norms = vec![report.rhs, report.residual_before, report.residual_after];
            out.push([now.x.as_flattened().to_vec(), speeds, rotations, norms]);
        }
        (out, contacts)
    }
}

fn bits(values: &[f32]) -> Vec<u32> {
    values.iter().map(|x| x.to_bits()).collect()
}

fn any_start() -> impl Strategy<Value = Start> {
    let others = prop::sample::select(vec![Start::Zero, Start::Velocity, Start::VelocityForce]);
    prop_oneof![
        others,
        (0..4_u8).prop_map(Start::Galerkin),
        (0..3_u8).prop_map(Start::Rigid)
    ]
}

const PRECONDITIONERS: [Preconditioner; 4] = [
    Preconditioner::Identity,
    Preconditioner::Mass,
    Preconditioner::Jacobi,
    Preconditioner::BlockJacobi,
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Micrometres or kilometres, nanograms or tons: the same digits.
    #[test]
    fn units_change_no_digit(
        powers in prop::array::uniform3(-20..21_i32),
        start in any_start(),
        preconditioner in prop::sample::select(&PRECONDITIONERS),
        pinned in any::<bool>(),
        newmark in any::<bool>(),
    ) {
        let units = powers.map(|power| 2_f32.powi(power));
        let theta = if newmark { 0.5 } else { 1.0 };
        let run = |units| Slide::new(pinned, theta, units).run::<Native, Factored>(start, preconditioner, 10);
        let ((one, _), (other, contacts)) = (run([1.0; 3]), run(units));
        prop_assert!(contacts > 0);
        let [length, mass, time] = units;
        let units = [length, length / time, 1.0, mass * length / time];
        for (one, other) in one.iter().zip(&other) {
            for ((one, other), unit) in one.iter().zip(other).zip(units) {
                let scaled: Vec<f32> = one.iter().map(|x| x * unit).collect();
                prop_assert_eq!(bits(&scaled), bits(other));
            }
        }
    }
}

fn lanes_agree<L: Layout>() {
    for preconditioner in PRECONDITIONERS {
        let others = [
            Start::Zero,
            Start::Velocity,
            Start::VelocityForce,
            Start::Rigid(0),
            Start::Rigid(2),
        ];
        for start in (0..4).map(Start::Galerkin).chain(others) {
            for (pinned, theta) in [(false, 1.0), (true, 0.5)] {
                let slide = Slide::new(pinned, theta, [1.0; 3]);
                let (one, contacts) = slide.run::<f32, L>(start, preconditioner, 20);
                assert!(contacts > 20, "{contacts} contacts");
                let (four, _) = slide.run::<f32x4, L>(start, preconditioner, 20);
                let (eight, _) = slide.run::<f32x8, L>(start, preconditioner, 20);
                for ((one, four), eight) in one
                    .as_flattened()
                    .iter()
                    .zip(four.as_flattened())
                    .zip(eight.as_flattened())
                {
                    assert_eq!(bits(one), bits(four), "{start:?}, {preconditioner:?}");
                    assert_eq!(bits(one), bits(eight), "{start:?}, {preconditioner:?}");
                }
            }
        }
    }
}

#[test]
fn steps_are_the_same_in_every_lane_width() {
    lanes_agree::<Factored>();
    lanes_agree::<Dense>();
}

/// Everything that the kernels write, as bits.
fn kernels<R: Lanes, L: Layout>(setup: &Setup, u: &[[f32; 3]]) -> [Vec<u32>; 4] {
    let rest = rest::<L>(setup);
    let rest = rest.view();
    let mut q = vec![RotationBlock::ZERO; rest.blocks.len()];
    fit_rotations::<R, L>(&rest, &setup.x, Fit::Cold, &mut q);
    fit_rotations::<R, L>(&rest, rest.nodes, Fit::Warm(1), &mut q);
    let mut rotated = vec![L::ZERO_ROTATED; q.len()];
    let mut f = vec![[0.0; 3]; u.len()];
    rotate::<R, L>(&rest, &setup.x, &q, 0.5, &mut rotated, &mut f);
    let operator = Operator {
        rest,
        rotated: &rotated,
        inertia: rest.masses,
        stiffness: 0.25,
    };
    let (mut product, mut diagonal) = (vec![[0.0; 3]; u.len()], vec![[0.0; 6]; u.len()]);
    operator.apply::<R>(u, &mut product);
    operator.diagonal::<R>(&mut diagonal);
    let q: Vec<f32> = q.iter().flat_map(|block| block.0).flatten().collect();
    [
        bits(&q),
        bits(f.as_flattened()),
        bits(product.as_flattened()),
        bits(diagonal.as_flattened()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn kernels_are_the_same_in_every_lane_width(setup in any_setup(), seed in any::<u64>()) {
        let u = any_vector(&setup, seed);
        let one = kernels::<f32, Factored>(&setup, &u);
        prop_assert_eq!(&one, &kernels::<f32x4, Factored>(&setup, &u));
        prop_assert_eq!(&one, &kernels::<f32x8, Factored>(&setup, &u));
        let one = kernels::<f32, Dense>(&setup, &u);
        prop_assert_eq!(&one, &kernels::<f32x4, Dense>(&setup, &u));
        prop_assert_eq!(&one, &kernels::<f32x8, Dense>(&setup, &u));
    }
}
