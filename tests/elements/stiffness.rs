//! Energy → force → stiffness: the crate's forces are the slope of its energy, its stiffness is the
//! slope of its forces, both are those of the oracle, and the stiffness is the one that scikit-fem
//! assembles. Both layouts.
//!
//! Every tolerance is a count of roundings times the size of what is rounded, tetrahedron by
//! tetrahedron, so that a soft or well-shaped one is not hidden behind a stiff sliver:
//!
//! ```text
//! K between corners i ≠ j    V (|λ| + 2μ) γ_i γ_j      γ_i = |g_i|, γ_0² = Σ_j |g_j|²
//! K_ii                       V (|λ| + 2μ) γ_i Σ_j γ_j  (the dense layout sums −K_ij)
//! force on corner i          V (√3|λ| + 2μ) γ_i Φ      Φ² = γ_0² Σ_j (|x_j − x_0|² + |X_j − X_0|²)
//! ```
//!
//! Roundings are taken as independent: N of them add up to √N ½ ε, three times that is allowed.

use crate::support::assert_within;
use crate::support::meshes::{Lcg, TetMesh, box_mesh, chain, jitter, single_tet, two_pieces};
use crate::support::reference::{Reference, node, stack};
use crate::support::scenes::Setup;
use femto::body::StateRef;
use femto::element::{Dense, Factored, Layout};
use femto::energy::{self, Rotations};
use femto::lane::{BLOCK, Native};
use femto::mesh::Mesh;
use femto::operator::{Fit, Operator, RotationBlock, fit_rotations, rotate};
use femto::owned::OwnedRest;
use nalgebra::{DMatrix, DVector, Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use proptest::prelude::*;

const EPS: f64 = f32::EPSILON as f64;

/// Roundings of an entry of K u or of a force: a rotated gradient G = Q g has 13 from Q (10 of them from
/// the length of q), 1 from g, 3 from the product, and enters twice; strain or H 4, λV and μV with their
/// scale 2, S 4, S G 3, the fourth corner 2, and the sum over the tets around a node up to 24.
const ELEMENT: f64 = 3.0 * 8.6 * 0.5 * EPS;

/// |ω| gap/‖F‖ of a converged Q: 9 roundings for an entry of B = QᵀF, two of them in axial(B).
const TURN: f64 = 3.0 * 4.25 * 0.5 * EPS;

struct Body<L: Layout> {
    rest: OwnedRest<L>,
    oracle: Reference,
}

impl<L: Layout> Body<L> {
    fn new(setup: &Setup) -> Self {
        let mesh = Mesh::new(&setup.mesh.nodes, &setup.mesh.tets).unwrap();
        Self {
            rest: OwnedRest::new(&mesh, &setup.material()).unwrap(),
            oracle: setup.reference(),
        }
    }

    fn fitted(&self, x: &[[f32; 3]]) -> Vec<RotationBlock> {
        let mut out = vec![RotationBlock::ZERO; self.rest.view().blocks.len()];
        fit_rotations::<Native, L>(&self.rest.view(), x, Fit::Cold, &mut out);
        out
    }

    fn turned(&self, by: &Rotation3<f64>) -> Vec<RotationBlock> {
        let q = UnitQuaternion::from_rotation_matrix(by);
        let block = RotationBlock([q.w, q.i, q.j, q.k].map(|c| [c as f32; BLOCK]));
        vec![block; self.rest.view().blocks.len()]
    }

    fn rotate(&self, x: &[[f32; 3]], q: &[RotationBlock]) -> (Vec<L::Rotated>, Vec<[f32; 3]>) {
        let rest = self.rest.view();
        let mut rotated = vec![L::ZERO_ROTATED; rest.blocks.len()];
        let mut f = vec![[0.0; 3]; rest.nodes.len()];
        rotate::<Native, L>(&rest, x, q, 1.0, &mut rotated, &mut f);
        (rotated, f)
    }

    fn forces(&self, x: &[[f32; 3]], q: &[RotationBlock]) -> DVector<f64> {
        stack(&self.rotate(x, q).1)
    }

    /// K u. The blocks are in units of length; 1/unit² takes that back, exactly.
    fn product(&self, rotated: &[L::Rotated], u: &[[f32; 3]]) -> DVector<f64> {
        let rest = self.rest.view();
        let unit = rest.header.length_unit;
        let inertia = vec![0.0; u.len()];
        let operator = Operator {
            rest,
            rotated,
            inertia: &inertia,
            stiffness: 1.0 / (unit * unit),
        };
        let mut out = vec![[f32::NAN; 3]; u.len()];
        operator.apply::<Native>(u, &mut out);
        stack(&out)
    }

    /// K, column by column.
    fn stiffness(&self, q: &[RotationBlock]) -> DMatrix<f64> {
        let (rotated, _) = self.rotate(self.rest.view().nodes, q);
        let nodes = self.rest.view().nodes.len();
        let columns = (0..3 * nodes).map(|dof| {
            let mut u = vec![[0.0; 3]; nodes];
            u.as_flattened_mut()[dof] = 1.0;
            self.product(&rotated, &u)
        });
        DMatrix::from_columns(&columns.collect::<Vec<_>>())
    }

    /// γ_i of tet e.
    fn gradients(&self, e: usize) -> [f64; 4] {
        let [_, a, b, c] = self.oracle.gradients[e].map(|g| g.norm());
        [(a * a + b * b + c * c).sqrt(), a, b, c]
    }

    /// The roundings of every entry of K.
    fn stiffness_rounding(&self) -> DMatrix<f64> {
        let size = self.oracle.rest.len();
        let mut out = DMatrix::zeros(size, size);
        for (e, tet) in self.oracle.tets.iter().enumerate() {
            let size = self.oracle.volumes[e] * (self.oracle.lambda.abs() + 2.0 * self.oracle.mu);
            let g = self.gradients(e);
            for (a, b) in (0..16).map(|k| (k / 4, k % 4)) {
                let mut bound = out.fixed_view_mut::<3, 3>(3 * tet[a], 3 * tet[b]);
                let other = if a == b { g.iter().sum() } else { g[b] };
                bound.add_scalar_mut(ELEMENT * size * g[a] * other);
            }
        }
        out
    }

    /// The roundings of every force at x, with Q off by `turns`: f turns, and so does the strain
    /// under it, sym(WB) being at most |ω| ‖B‖.
    fn force_rounding(&self, x: &[[f32; 3]], turns: impl Fn(usize) -> f64) -> DVector<f64> {
        let x = stack(x);
        let mut out = DVector::zeros(x.len());
        for (e, tet) in self.oracle.tets.iter().enumerate() {
            let size = self.oracle.volumes[e]
                * (3_f64.sqrt() * self.oracle.lambda.abs() + 2.0 * self.oracle.mu);
            let g = self.gradients(e);
            let edge =
                |x: &DVector<f64>, j: usize| (node(x, tet[j]) - node(x, tet[0])).norm_squared();
            let edges: f64 = (1..4)
                .map(|j| edge(&x, j) + edge(&self.oracle.rest, j))
                .sum();
            let spread = edges.sqrt() * g[0];
            let each = ELEMENT + 2.0 * turns(e);
            for (&i, g) in tet.iter().zip(g) {
                out.fixed_rows_mut::<3>(3 * i)
                    .add_scalar_mut(each * size * g * spread);
            }
        }
        out
    }

    /// ‖F‖/gap of tet e at x: how far rounding turns Q (see the polar tests).
    fn looseness(&self, x: &[[f32; 3]], e: usize) -> f64 {
        let f = self.oracle.deformation(&stack(x), e);
        let mut s: [f64; 3] = f.singular_values().into();
        s.sort_by(|a, b| b.total_cmp(a));
        let gap = s[1] + s[2].copysign(f.determinant());
        assert!(gap > 0.1 * f.norm(), "a tie: choose another state");
        f.norm() / gap
    }
}

/// The meshes of the golden file, each with its K and masses.
fn golden() -> Vec<(Setup, DMatrix<f64>, Vec<f64>)> {
    let mut out: Vec<(Setup, DMatrix<f64>, Vec<f64>)> = Vec::new();
    for line in include_str!("../golden/stiffness.txt")
        .lines()
        .filter(|line| !line.starts_with('#'))
    {
        let (kind, fields) = line.split_once(' ').unwrap();
        // All are numbers but the mesh's name.
        let fields: Vec<f64> = fields
            .split(' ')
            .filter_map(|field| field.parse().ok())
            .collect();
        let index = |k: usize| fields[k] as usize;
        if kind == "mesh" {
            let mut setup = Setup::new("golden", TetMesh::default());
            (setup.young, setup.poisson) = (fields[0] as f32, fields[1] as f32);
            out.push((
                setup,
                DMatrix::zeros(3 * index(2), 3 * index(2)),
                vec![0.0; index(2)],
            ));
        }
        let (setup, stiffness, masses) = out.last_mut().unwrap();
        match kind {
            "node" => setup.mesh.nodes.push([0, 1, 2].map(|k| fields[k] as f32)),
            "tet" => setup.mesh.tets.push([0, 1, 2, 3].map(|k| index(k) as u32)),
            "k" => {
                stiffness[(index(0), index(1))] = fields[2];
                stiffness[(index(1), index(0))] = fields[2];
            }
            "mass" => masses[index(0)] = fields[1],
            _ => assert_eq!(kind, "mesh"),
        }
    }
    assert_eq!(
        out.iter()
            .map(|(setup, ..)| setup.mesh.tets.len())
            .collect::<Vec<_>>(),
        [1, 12, 24]
    );
    out
}

/// The file's ν is not an f32: dλ/λ ≤ (1 + 2ν/(1 − 2ν)) dν/ν, 5 roundings at ν = 0.4.
const LAME: f64 = 2.5 * EPS;

fn is_golden<L: Layout>() {
    for (setup, stiffness, masses) in golden() {
        let (body, nodes) = (Body::<L>::new(&setup), &setup.mesh.nodes);
        let q = body.turned(&Rotation3::identity());
        let bound = body.stiffness_rounding() * (1.0 + LAME / ELEMENT);
        assert_within(&body.stiffness(&q), &stiffness, &bound);
        // No force at rest, and each mass a sum of rounded quarters.
        let none = DVector::zeros(3 * nodes.len());
        assert_within(
            &body.forces(nodes, &q),
            &none,
            &body.force_rounding(nodes, |_| 0.0),
        );
        for (&mass, expected) in body.rest.view().masses.iter().zip(&masses) {
            assert!(
                (f64::from(mass) - expected).abs() <= ELEMENT * expected,
                "{mass}, not {expected}"
            );
        }
    }
}

#[test]
fn stiffness_and_masses_are_those_of_scikit_fem() {
    is_golden::<Factored>();
    is_golden::<Dense>();
}

/// A power of two and a grid on which x ± 2 `STEP` is exact in f32 for |x| < 4.
const STEP: f32 = 1.0 / 4096.0;

fn on_grid(x: [f64; 3]) -> [f32; 3] {
    x.map(|c| (c / f64::from(STEP)).round() as f32 * STEP)
}

/// A turned, sheared, uneven state of a mesh; `noise` is a part of every coordinate.
fn deformed(mesh: &TetMesh, noise: f64, seed: u64) -> Vec<[f64; 3]> {
    let mut random = Lcg(seed);
    let turn = Rotation3::new(Vector3::from_fn(|_, _| 2.0 * random.signed()));
    let shear = Matrix3::new(1.2, 0.2, 0.0, 0.0, 0.9, -0.1, 0.1, 0.0, 1.1);
    let place = |x: &[f32; 3]| {
        let uneven = Vector3::from(x.map(|c| f64::from(c) * (1.0 + noise * random.signed())));
        (turn * (shear * uneven) + Vector3::new(0.3, -0.5, 0.7)).into()
    };
    mesh.nodes.iter().map(place).collect()
}

/// States for finite differences; the last has a tet turned inside out.
fn states() -> Vec<Setup> {
    let grid = jitter(&box_mesh([1.0, 1.5, 1.0], [2, 3, 2]), 0.1, 7);
    let inverted = vec![
        [0.43, 0.45, 0.44],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
    ];
    let states = [
        (single_tet(), deformed(&single_tet(), 0.2, 1)),
        (grid.clone(), deformed(&grid, 0.05, 2)),
        (two_pieces(), deformed(&two_pieces(), 0.1, 3)),
        (single_tet(), inverted),
    ];
    let setup = |(mesh, x): (_, Vec<_>)| Setup {
        x: x.into_iter().map(on_grid).collect(),
        young: 1e5,
        ..Setup::new("deformed", mesh)
    };
    states.map(setup).into()
}

fn force_is_slope<L: Layout>() {
    for setup in states() {
        let (body, x) = (Body::<L>::new(&setup), &setup.x);
        let q = body.fitted(x);
        let f = body.forces(x, &q);
        // With the state's own rotations the energy is quadratic, and a central difference exact.
        // Converged ones follow x, whatever the state holds: Richardson's rule leaves
        // (δ|g|/gap)⁴ < 1e-9 of the force, far below its rounding.
        let other = body.turned(&Rotation3::new(Vector3::new(1.0, -2.0, 0.5)));
        let turns: Vec<_> = (0..body.oracle.tets.len())
            .map(|e| TURN * body.looseness(x, e))
            .collect();
        let fixed = body.force_rounding(x, |_| 0.0);
        let following = body.force_rounding(x, |e| turns[e]);
        let kinds = [
            (Rotations::Stored, &q, fixed),
            (Rotations::Converged, &other, following),
        ];
        for (kind, rotations, bound) in kinds {
            let central = |dof: usize, step: f32| {
                let energy = |step: f32| {
                    let mut x = x.clone();
                    x.as_flattened_mut()[dof] += step;
                    let (v, history) = (&[], &[]);
                    let state = StateRef::new(&x, v, history, rotations);
                    energy::elastic(&body.rest.view(), &state, kind)
                };
                (energy(step) - energy(-step)) / (2.0 * f64::from(step))
            };
            let slope = DVector::from_fn(f.len(), |dof, _| {
                (4.0 * central(dof, STEP) - central(dof, 2.0 * STEP)) / 3.0
            });
            assert_within(&f, &-slope, &bound);
            assert!(bound.amax() < 1e-3 * f.amax(), "an empty bound");
        }
    }
}

#[test]
fn forces_are_the_slope_of_the_energy() {
    force_is_slope::<Factored>();
    force_is_slope::<Dense>();
}

/// f(x + d) − f(x) = −K d at frozen rotations, whatever d: a factor of four, as the paper's printed
/// formula has it, would show here.
fn stiffness_is_slope<L: Layout>() {
    for setup in states() {
        let (body, x) = (Body::<L>::new(&setup), &setup.x);
        let q = body.fitted(x);
        let (k, before) = (body.stiffness(&q), body.forces(x, &q));
        for dof in 0..3 * x.len() {
            let mut moved = x.clone();
            moved.as_flattened_mut()[dof] += 0.25;
            let change = body.forces(&moved, &q) - &before;
            let bound = body.force_rounding(x, |_| 0.0)
                + body.force_rounding(&moved, |_| 0.0)
                + body.stiffness_rounding().column(dof) * 0.25;
            assert_within(&change, &(k.column(dof) * -0.25), &bound);
            assert!(bound.amax() < 1e-3 * k.column(dof).amax(), "an empty bound");
        }
    }
}

#[test]
fn stiffness_is_the_slope_of_the_frozen_forces() {
    stiffness_is_slope::<Factored>();
    stiffness_is_slope::<Dense>();
}

/// A body of any shape and stiffness, slivers among them, in any state.
fn any_body() -> impl Strategy<Value = Setup> {
    let mesh = prop_oneof![
        Just(single_tet()),
        Just(two_pieces()),
        (1..5_usize, 1..4_usize).prop_map(|(n, shared)| chain(n, shared)),
        (1..4_usize, 1..3_usize, -3.0..0.0_f64)
            .prop_map(|(nx, ny, flat)| box_mesh([1.0, 0.5, 10_f64.powf(flat)], [nx, ny, 1])),
    ];
    // Mildly deformed, a heap of inverted tets, flat, a line, a point.
    let noise = prop_oneof![Just(0.0), 0.0..0.2_f64, 0.2..4.0_f64];
    let kept = prop_oneof![4 => Just(3_usize), 1 => 0..3_usize];
    let material = (3.0..10.0_f32, prop_oneof![-0.9..0.499_f32, Just(0.499_f32)]);
    (mesh, material, noise, kept, any::<u64>()).prop_map(
        |(mesh, (young, poisson), noise, kept, seed)| {
            let mesh = jitter(&mesh, 0.02, seed);
            let crush =
                |x: [f64; 3]| core::array::from_fn(|a| if a < kept { x[a] as f32 } else { 0.25 });
            let x = deformed(&mesh, noise, seed)
                .into_iter()
                .map(crush)
                .collect();
            Setup {
                x,
                young: 10_f32.powf(young),
                poisson,
                ..Setup::new("any", mesh)
            }
        },
    )
}

fn agrees<L: Layout>(setup: &Setup, turn: &Rotation3<f64>) {
    let (body, x) = (Body::<L>::new(setup), &setup.x);
    let fitted = body.fitted(x);
    let matrix = |e: usize| {
        let [w, x, y, z] = fitted[e / BLOCK]
            .0
            .map(|component| f64::from(component[e % BLOCK]));
        let q = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        q.to_rotation_matrix().into_inner()
    };
    let q: Vec<_> = (0..setup.mesh.tets.len()).map(matrix).collect();
    let (k, bound) = (body.stiffness(&fitted), body.stiffness_rounding());
    assert_within(&k, &body.oracle.stiffness(&q), &bound);
    // Rows sum to zero, axis by axis.
    for axis in 0..3 {
        let ones = DVector::from_fn(k.nrows(), |dof, _| f64::from(dof % 3 == axis));
        assert_within(&(&k * &ones), &DVector::zeros(k.nrows()), &(&bound * &ones));
    }
    let expected = body.oracle.elastic_forces(&stack(x), &q);
    assert_within(
        &body.forces(x, &fitted),
        &expected,
        &body.force_rounding(x, |_| 0.0),
    );

    // A body turned as a whole: K annihilates translations, to the bit, and turns about any axis.
    let (rotated, _) = body.rotate(x, &body.turned(turn));
    let shift = vec![[1.1_f32, -2.3, 3.7]; x.len()];
    assert_eq!(body.product(&rotated, &shift).amax(), 0.0);
    for axis in 0..3 {
        let spin = |x: &[f32; 3]| {
            let at = turn * Vector3::from(x.map(f64::from));
            let u: [f64; 3] = Vector3::ith(axis, 1.0).cross(&at).into();
            u.map(|c| c as f32)
        };
        let u: Vec<_> = setup.mesh.nodes.iter().map(spin).collect();
        let found = body.product(&rotated, &u);
        assert_within(
            &found,
            &DVector::zeros(found.len()),
            &(&bound * stack(&u).abs()),
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    /// K and the forces at the rotations that the crate fitted, whatever they are.
    #[test]
    fn stiffness_and_forces_are_those_of_the_oracle(
        setup in any_body(), turn in prop::array::uniform3(-2.0..2.0_f64),
    ) {
        let turn = Rotation3::new(Vector3::from(turn));
        agrees::<Factored>(&setup, &turn);
        agrees::<Dense>(&setup, &turn);
    }
}
