//! Factored preconditioners in any state: symmetric, positive, and in a turned body the dense inverse of the
//! matrix at rest, turned with it.

use crate::support::factors::factor;
use crate::support::meshes::{Lcg, box_mesh, chain, jitter, noise, two_pieces};
use crate::support::reference::stack;
use crate::support::scenes::Setup;
use femto::element::{Factored, Layout, Sym3};
use femto::lane::{Lanes, Native};
use femto::operator::{Fit, Operator, RotationBlock, fit_rotations};
use femto::owned::OwnedRest;
use femto::preconditioner::{Preconditioner, Room};
use femto_bake::{Kind, Precision};
use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Vector3};
use proptest::prelude::*;

const FREE: Sym3<f32> = [1.0, 0.0, 0.0, 1.0, 0.0, 1.0];

/// A body of the setup, in its state, and what its nodes may do.
struct Placed {
    setup: Setup,
    rest: OwnedRest<Factored>,
    rotations: Vec<RotationBlock>,
    filter: Vec<Sym3<f32>>,
}

impl Placed {
    fn new(setup: Setup, filter: Vec<Sym3<f32>>) -> Self {
        let rest = setup.rest::<Factored>();
        let view = rest.view();
        let mut rotations = vec![RotationBlock::ZERO; view.blocks.len()];
        fit_rotations::<Native, Factored>(&view, &setup.x, Fit::Cold, &mut rotations);
        Self {
            rest: rest.clone(),
            setup,
            rotations,
            filter,
        }
    }

    fn apply<R: Lanes>(
        &self,
        preconditioner: Preconditioner<'static>,
        r: &[[f32; 3]],
    ) -> Vec<[f32; 3]> {
        let (rest, nodes) = (self.rest.view(), r.len());
        let operator = Operator {
            rest,
            rotated: &vec![Factored::ZERO_ROTATED; rest.blocks.len()],
            inertia: &vec![1.0; nodes],
            stiffness: 1.0,
        };
        // What was there before must not matter.
        let (mut blocks, mut z) = (vec![[f32::NAN; 6]; nodes], vec![[f32::NAN; 3]; nodes]);
        let room = Room {
            blocks: &mut blocks,
            coarse: &mut [],
        };
        let prepared = preconditioner.prepare::<R, Factored>(
            &operator,
            &self.setup.x,
            &self.rotations,
            (&self.filter, true),
            room,
            &mut vec![[f32::NAN; 3]; nodes],
        );
        prepared.apply(&self.filter, r, &mut z);
        z
    }
}

fn kinds(setup: &Setup) -> [Preconditioner<'static>; 4] {
    [
        (Kind::Warped, Precision::Single),
        (Kind::Warped, Precision::Half),
        (Kind::Laplacian, Precision::Single),
        (Kind::Laplacian, Precision::Half),
    ]
    .map(|(kind, precision)| Preconditioner::Factored(factor(setup, kind, precision)))
}

/// Any turned body: z = R A₀⁻¹ Rᵀ r, with A₀ and its inverse by the oracle.
#[test]
fn in_a_turned_body_it_is_the_turned_inverse() {
    let turn = Rotation3::from_euler_angles(0.7, -2.1, 1.3);
    for mesh in [
        chain(6, 3),
        two_pieces(),
        jitter(&box_mesh([1.0, 0.4, 0.3], [3, 2, 1]), 0.02, 9),
    ] {
        let mut setup = Setup {
            young: 1e5,
            ..Setup::new("turned", mesh)
        };
        for x in &mut setup.x {
            *x = (turn * Vector3::from(x.map(f64::from)))
                .map(|c| c as f32)
                .into();
        }
        let nodes = setup.x.len();
        let oracle = setup.reference();
        let (rest_matrix, _) = oracle.system(&vec![Matrix3::identity(); oracle.tets.len()]);
        let turns = DMatrix::from_fn(3 * nodes, 3 * nodes, |i, j| {
            if i / 3 == j / 3 {
                turn[(i % 3, j % 3)]
            } else {
                0.0
            }
        });
        let condition = {
            let eigenvalues = rest_matrix.symmetric_eigenvalues();
            eigenvalues.max() / eigenvalues.min()
        };
        let placed = Placed::new(setup, vec![FREE; nodes]);
        let unit = f64::from(placed.rest.view().header.mass_unit);
        let r = noise(nodes, 1.0, 4);
        let inverse = rest_matrix.cholesky().unwrap();
        let exact: DVector<f64> = &turns * inverse.solve(&(turns.transpose() * stack(&r))) * unit;
        let warped = kinds(&placed.setup)[0];
        let off = (stack(&placed.apply::<Native>(warped, &r)) - &exact).norm() / exact.norm();
        let bound = 8.0 * f64::from(f32::EPSILON) * condition;
        assert!(off < bound, "{off:e} of {bound:e}");
    }
}

/// Symmetric projections: free, on a plane, held.
fn projection(random: &mut Lcg) -> Sym3<f32> {
    let n = Vector3::from_fn(|_, _| random.signed()).normalize();
    let choice = random.signed();
    let [x, y, z] = [n.x as f32, n.y as f32, n.z as f32];
    if choice < 0.3 {
        FREE
    } else if choice < 0.8 {
        [
            1.0 - x * x,
            -x * y,
            -x * z,
            1.0 - y * y,
            -y * z,
            1.0 - z * z,
        ]
    } else {
        [0.0; 6]
    }
}

proptest! {
    /// Random, mirrored, crushed to a point, flat, and huge states.
    #[test]
    fn symmetric_and_positive_in_any_state(kind in 0..5_usize, seed in any::<u64>()) {
        let mut setup = Setup::new("any", jitter(&box_mesh([1.0, 0.4, 0.3], [3, 2, 1]), 0.02, 9));
        let mut random = Lcg(seed);
        for x in &mut setup.x {
            *x = match kind {
                0 => [(); 3].map(|()| random.signed() as f32),
                1 => [-x[0], x[1], x[2]],
                2 => [0.5; 3],
                3 => [x[0], 0.1, x[2]],
                _ => [(); 3].map(|()| 1e15 * random.signed() as f32),
            };
        }
        let nodes = setup.x.len();
        let filter: Vec<_> = (0..nodes).map(|_| projection(&mut random)).collect();
        let placed = Placed::new(setup, filter);
        let (x, y) = (noise(nodes, 1.0, seed ^ 1), noise(nodes, 1.0, seed ^ 2));
        for preconditioner in kinds(&placed.setup) {
            let (px, py) = (placed.apply::<Native>(preconditioner, &x), placed.apply::<Native>(preconditioner, &y));
            prop_assert_eq!(&px, &placed.apply::<f32>(preconditioner, &x));
            prop_assert_eq!(&px, &placed.apply::<wide::f32x8>(preconditioner, &x));
            let (x, y, px, py) = (stack(&x), stack(&y), stack(&px), stack(&py));
            let size = x.norm() * py.norm() + y.norm() * px.norm();
            prop_assert!((x.dot(&py) - y.dot(&px)).abs() <= 1e-5 * size);
            prop_assert!(x.dot(&px) >= -1e-5 * x.norm() * px.norm());
        }
    }
}
