//! What the matrix-free operator must be whatever the body and its state: symmetric, semidefinite,
//! the same in both layouts, in every frame and unit, in every order of nodes and tetrahedra, and to
//! the bit in every lane width. And the dense layout with materials that the factored one cannot hold.
//!
//! Tolerances count roundings (independent: √N ½ ε, three times that allowed), tetrahedron by
//! tetrahedron, relative to
//!
//! ```text
//! K u            V (√3|λ| + 2μ) γ² |u|      γ² = Σ_{j≥1} |g_j|², |u| over the four corners
//! force          V (√3|λ| + 2μ) γ² |e|      |e|² = Σ_j |x_j − x_0|² + |X_j − X_0|²
//! ```

mod support;

#[path = "operator_props/frames.rs"]
mod frames;
#[path = "operator_props/lanes.rs"]
mod lanes;
#[path = "operator_props/materials.rs"]
mod materials;

use femto::element::{Dense, Factored, Layout, Sym3};
use femto::lane::{BLOCK, Native};
use femto::mesh::Mesh;
use femto::operator::{Fit, Operator, RotationBlock, fit_rotations, rotate};
use femto::owned::OwnedRest;
use nalgebra::{DVector, Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use support::assert_within;
use support::meshes::{Lcg, box_mesh, chain, jitter, noise, single_tet, two_pieces};
use support::reference::{Reference, node, stack};
use support::scenes::Setup;

const EPS: f64 = f32::EPSILON as f64;

/// Roundings of one entry, counted in the stiffness tests: 73.
const ELEMENT: f64 = 3.0 * 8.6 * 0.5 * EPS;

/// m u, and its sum with K u.
const MASS: f64 = 2.0 * EPS;

/// Rest data, and the kernels' results at x with rotations q.
struct Body<L: Layout> {
    rest: OwnedRest<L>,
    rotated: Vec<L::Rotated>,
    f: DVector<f64>,
    /// c_K of A = M + c_K K
    stiffness: f32,
}

fn rest<L: Layout>(setup: &Setup) -> OwnedRest<L> {
    let mesh = Mesh::new(&setup.mesh.nodes, &setup.mesh.tets).unwrap();
    OwnedRest::new(&mesh, &setup.material()).unwrap()
}

fn fitted(setup: &Setup, x: &[[f32; 3]]) -> Vec<RotationBlock> {
    let rest = rest::<Factored>(setup);
    let mut out = vec![RotationBlock::ZERO; rest.view().blocks.len()];
    fit_rotations::<Native, Factored>(&rest.view(), x, Fit::Cold, &mut out);
    out
}

impl<L: Layout> Body<L> {
    fn new(setup: &Setup, x: &[[f32; 3]], q: &[RotationBlock]) -> Self {
        Self::of(rest(setup), setup, x, q)
    }

    fn of(rest: OwnedRest<L>, setup: &Setup, x: &[[f32; 3]], q: &[RotationBlock]) -> Self {
        let mut rotated = vec![L::ZERO_ROTATED; q.len()];
        let mut f = vec![[0.0; 3]; x.len()];
        rotate::<Native, L>(&rest.view(), x, q, 1.0, &mut rotated, &mut f);
        Self {
            rest,
            rotated,
            f: stack(&f),
            stiffness: setup.h * setup.h,
        }
    }

    fn operator<'a>(&'a self, inertia: &'a [f32]) -> Operator<'a, L> {
        let rest = self.rest.view();
        let unit = rest.header.length_unit;
        Operator {
            rest,
            rotated: &self.rotated,
            inertia,
            stiffness: self.stiffness / (unit * unit),
        }
    }

    /// K u times c_K
    fn product(&self, u: &[[f32; 3]]) -> DVector<f64> {
        self.product_with(&vec![0.0; u.len()], u)
    }

    /// diag(inertia) u + c_K K u
    fn product_with(&self, inertia: &[f32], u: &[[f32; 3]]) -> DVector<f64> {
        let mut out = vec![[f32::NAN; 3]; u.len()];
        self.operator(inertia).apply::<Native>(u, &mut out);
        stack(&out)
    }

    fn diagonal(&self) -> Vec<Sym3<f32>> {
        let masses = self.rest.view().masses;
        let mut out = vec![[f32::NAN; 6]; masses.len()];
        self.operator(masses).diagonal::<Native>(&mut out);
        out
    }
}

/// Σ over the tetrahedra around a node of ELEMENT V (√3|λ| + 2μ) γ² times `of(tet)`.
fn rounding(oracle: &Reference, of: impl Fn(&[usize; 4]) -> f64) -> DVector<f64> {
    let mut out = DVector::zeros(oracle.rest.len());
    for (e, tet) in oracle.tets.iter().enumerate() {
        let gradients: f64 = oracle.gradients[e][1..]
            .iter()
            .map(|g| g.norm_squared())
            .sum();
        let size =
            oracle.volumes[e] * (3_f64.sqrt() * oracle.lambda.abs() + 2.0 * oracle.mu) * gradients;
        for &i in tet {
            out.fixed_rows_mut::<3>(3 * i)
                .add_scalar_mut(ELEMENT * size * of(tet));
        }
    }
    out
}

fn product_rounding(oracle: &Reference, body: &Body<impl Layout>, u: &[[f32; 3]]) -> DVector<f64> {
    let u = stack(u);
    let over = |tet: &[usize; 4]| {
        tet.iter()
            .map(|&i| node(&u, i).norm_squared())
            .sum::<f64>()
            .sqrt()
    };
    rounding(oracle, over) * f64::from(body.stiffness)
        + oracle.mass().component_mul(&u.abs()) * MASS
}

fn force_rounding(oracle: &Reference, x: &[[f32; 3]]) -> DVector<f64> {
    let x = stack(x);
    let edges = |x: &DVector<f64>, tet: &[usize; 4]| -> f64 {
        tet.iter()
            .map(|&j| (node(x, j) - node(x, tet[0])).norm_squared())
            .sum()
    };
    rounding(oracle, |tet| {
        (edges(&x, tet) + edges(&oracle.rest, tet)).sqrt()
    })
}

/// Any body, slivers and huge ratios of stiffness to mass among them, in any state: at rest, uneven, a
/// heap of inverted tets, flat.
fn any_setup() -> impl Strategy<Value = Setup> {
    let mesh = prop_oneof![
        Just(single_tet()),
        Just(two_pieces()),
        (1..5_usize, 1..4_usize).prop_map(|(n, shared)| chain(n, shared)),
        (1..4_usize, 1..3_usize, -3.0..0.0_f64)
            .prop_map(|(nx, ny, flat)| box_mesh([1.0, 0.5, 10_f64.powf(flat)], [nx, ny, 1])),
        (2..4_usize).prop_map(|nx| box_mesh([1.0, 0.5, 0.5], [nx, 2, 2]).ordered()),
    ];
    let material = (
        3.0..10.0_f32,
        prop_oneof![-0.9..0.499_f32, Just(0.499_f32)],
        -4.0..0.0_f32,
    );
    let uneven = prop_oneof![Just(0.0), 0.0..0.2_f64, 0.2..4.0_f64];
    (
        mesh,
        material,
        uneven,
        prop::bool::weighted(0.1),
        any::<u64>(),
    )
        .prop_map(|(mesh, (young, poisson, h), uneven, flat, seed)| {
            let mut setup = Setup::new("any", jitter(&mesh, 0.02, seed));
            (setup.young, setup.poisson, setup.h) = (10_f32.powf(young), poisson, 10_f32.powf(h));
            let mut random = Lcg(seed);
            for x in setup.x.as_flattened_mut() {
                *x *= (1.0 + uneven * random.signed()) as f32;
            }
            for x in setup.x.iter_mut().filter(|_| flat) {
                x[2] = 0.25 * x[0];
            }
            setup
        })
}

/// A vector: random, or close to one that K annihilates or barely resists (an affine motion).
fn any_vector(setup: &Setup, seed: u64) -> Vec<[f32; 3]> {
    let mut random = Lcg(seed);
    let linear = Matrix3::from_fn(|_, _| random.signed());
    let linear = [
        linear,
        linear - linear.transpose(),
        Matrix3::identity(),
        Matrix3::zeros(),
    ];
    let (linear, size) = (
        linear[seed as usize % 4],
        [1.0, 1e-3, 0.0][seed as usize / 4 % 3],
    );
    let moved = setup
        .mesh
        .nodes
        .iter()
        .zip(noise(setup.mesh.nodes.len(), size, seed));
    moved
        .map(|(x, noise)| {
            let u: [f64; 3] = (linear * Vector3::from(x.map(f64::from))
                + Vector3::from(noise.map(f64::from)))
            .into();
            u.map(|c| c as f32)
        })
        .collect()
}

/// vᵀAu = uᵀAv, uᵀKu ≥ 0 and uᵀAu ≥ uᵀMu.
fn assert_definite(oracle: &Reference, body: &Body<impl Layout>, u: &[[f32; 3]], v: &[[f32; 3]]) {
    let (wide_u, wide_v) = (stack(u), stack(v));
    let (bound_u, bound_v) = (
        product_rounding(oracle, body, u),
        product_rounding(oracle, body, v),
    );
    let masses = body.rest.view().masses;
    for (mass, inertia) in [(0.0, vec![0.0; u.len()]), (1.0, masses.to_vec())] {
        let (au, av) = (
            body.product_with(&inertia, u),
            body.product_with(&inertia, v),
        );
        let (vau, uav) = (wide_v.dot(&au), wide_u.dot(&av));
        let bound = bound_u.dot(&wide_v.abs()) + bound_v.dot(&wide_u.abs());
        assert!(
            (vau - uav).abs() <= bound,
            "vᵀAu = {vau:e}, uᵀAv = {uav:e}, bound {bound:e}"
        );
        let least = mass * oracle.mass().component_mul(&wide_u).dot(&wide_u);
        let found = wide_u.dot(&au);
        assert!(
            found >= least - bound_u.dot(&wide_u.abs()),
            "uᵀAu = {found:e}, uᵀMu = {least:e}"
        );
    }
}

/// Each 3×3 block on the diagonal, column by column.
fn has_diagonal<L: Layout>(setup: &Setup) {
    let oracle = setup.reference();
    let body = Body::<L>::new(setup, &setup.x, &fitted(setup, &setup.x));
    for (i, &[xx, xy, xz, yy, yz, zz]) in body.diagonal().iter().enumerate() {
        let block = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        for axis in 0..3 {
            let mut u = vec![[0.0; 3]; setup.x.len()];
            u[i][axis] = 1.0;
            let (column, bound) = (
                body.product_with(body.rest.view().masses, &u),
                product_rounding(&oracle, &body, &u),
            );
            let bound = bound
                .fixed_rows::<3>(3 * i)
                .add_scalar(MASS * oracle.masses[i]);
            assert_within(
                &Vector3::from(block[axis].map(f64::from)),
                &node(&column, i),
                &(bound * 2.0),
            );
        }
    }
}

fn quaternion(block: &RotationBlock, lane: usize) -> Quaternion<f64> {
    let [w, x, y, z] = block.0.map(|c| f64::from(c[lane]));
    Quaternion::new(w, x, y, z)
}

fn matrix(q: &[RotationBlock], e: usize) -> Matrix3<f64> {
    let q = UnitQuaternion::from_quaternion(quaternion(&q[e / BLOCK], e % BLOCK));
    q.to_rotation_matrix().into_inner()
}

/// R Q for every tetrahedron.
fn turned_rotations(q: &[RotationBlock], r: &Rotation3<f64>) -> Vec<RotationBlock> {
    let r = UnitQuaternion::from_rotation_matrix(r).into_inner();
    let mut out = q.to_vec();
    for (out, q) in out.iter_mut().zip(q) {
        for lane in 0..BLOCK {
            let turned = r * quaternion(q, lane);
            let parts = [turned.w, turned.i, turned.j, turned.k];
            out.0
                .iter_mut()
                .zip(parts)
                .for_each(|(out, part)| out[lane] = part as f32);
        }
    }
    out
}

fn turned(r: &Matrix3<f64>, u: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let turn = |u: &[f32; 3]| -> [f64; 3] { (r * Vector3::from(u.map(f64::from))).into() };
    u.iter().map(|u| turn(u).map(|c| c as f32)).collect()
}

/// A rotation with entries 0 and ±1, or any.
fn any_turn() -> impl Strategy<Value = Matrix3<f64>> {
    let quarters = prop::array::uniform3(0..4_u8).prop_map(|quarters| {
        let [a, b, c] = quarters.map(|k| f64::from(k) * std::f64::consts::FRAC_PI_2);
        Rotation3::from_euler_angles(a, b, c)
            .into_inner()
            .map(f64::round)
    });
    let any = prop::array::uniform3(-2.0..2.0_f64)
        .prop_map(|r| Rotation3::new(Vector3::from(r)).into_inner());
    prop_oneof![quarters, any]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn products_are_symmetric_and_semidefinite(setup in any_setup(), seed in any::<u64>()) {
        let (oracle, q) = (setup.reference(), fitted(&setup, &setup.x));
        let (u, v) = (any_vector(&setup, seed), any_vector(&setup, seed.rotate_left(9)));
        assert_definite(&oracle, &Body::<Factored>::new(&setup, &setup.x, &q), &u, &v);
        assert_definite(&oracle, &Body::<Dense>::new(&setup, &setup.x, &q), &u, &v);
    }

    #[test]
    fn diagonals_are_those_of_the_products(setup in any_setup()) {
        has_diagonal::<Factored>(&setup);
        has_diagonal::<Dense>(&setup);
    }

    #[test]
    fn layouts_agree(setup in any_setup(), seed in any::<u64>()) {
        let (oracle, q) = (setup.reference(), fitted(&setup, &setup.x));
        let factored = Body::<Factored>::new(&setup, &setup.x, &q);
        let dense = Body::<Dense>::new(&setup, &setup.x, &q);
        assert_within(&factored.f, &dense.f, &(force_rounding(&oracle, &setup.x) * 2.0));
        let u = any_vector(&setup, seed);
        let bound = product_rounding(&oracle, &dense, &u) * 2.0;
        assert_within(&factored.product(&u), &dense.product(&u), &bound);
        let ones = vec![[1.0; 3]; u.len()];
        let bound = product_rounding(&oracle, &dense, &ones) * 2.0;
        for (i, (a, b)) in factored.diagonal().iter().zip(dense.diagonal()).enumerate() {
            assert!(a.iter().zip(b).all(|(a, b)| f64::from((a - b).abs()) <= bound[3 * i]), "{a:?}, not {b:?}");
        }
    }
}
