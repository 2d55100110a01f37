//! The two-level preconditioner against its dense formula in f64,
//!
//! ```text
//! P (B + Z E⁻¹ Zᵀ) P,   E = Zᵀ (c_M M + c_K K_cut) Z + Zᵀ (1 − P) S (1 − P) Z,   S = blockdiag A,  B = S⁻¹
//! ```
//!
//! and what it has to be in any state: symmetric, positive, finite, the same bits in every lane width.

use crate::support::meshes::{
    Lcg, TetMesh, box_mesh, chain, jitter, noise, single_tet, two_pieces,
};
use crate::support::scenes::{Setup, bar, bent};
use femto::constraint::FREE;
use femto::element::{Dense, Factored, Layout, Sym3};
use femto::lane::{Lanes, Native};
use femto::operator::{Fit, Operator, RotationBlock, fit_rotations, rotate};
use femto::owned::OwnedRest;
use femto::preconditioner::aggregate::{MAX_AGGREGATES, NONE};
use femto::preconditioner::coarse::coarse_length;
use femto::preconditioner::{Aggregates, Preconditioner, Room};
use nalgebra::{DMatrix, DVector, Matrix3, Quaternion, UnitQuaternion, Vector3};
use proptest::prelude::*;
use wide::{f32x4, f32x8};

const EPS: f64 = f32::EPSILON as f64;

/// One state of a body, ready to be preconditioned, in the body's units.
struct Case<L: Layout> {
    setup: Setup,
    rest: OwnedRest<L>,
    of: Vec<u8>,
    count: usize,
    filter: Vec<Sym3<f32>>,
    rotations: Vec<RotationBlock>,
    rotated: Vec<L::Rotated>,
    inertia: Vec<f32>,
    stiffness: f32,
}

impl<L: Layout> Case<L> {
    fn new(setup: &Setup, of: Vec<u8>, count: usize, filter: Vec<Sym3<f32>>) -> Self {
        let rest: OwnedRest<L> = setup.rest();
        let view = rest.view();
        let mut rotations = vec![RotationBlock::ZERO; view.blocks.len()];
        fit_rotations::<f32, L>(&view, &setup.x, Fit::Cold, &mut rotations);
        let mut rotated = vec![L::ZERO_ROTATED; view.blocks.len()];
        let mut forces = vec![[0.0; 3]; setup.x.len()];
        rotate::<f32, L>(&view, &setup.x, &rotations, 1.0, &mut rotated, &mut forces);
        let header = view.header;
        let inertia = view.masses.iter().map(|m| m / header.mass_unit).collect();
        let stiffness =
            setup.h * setup.h / header.mass_unit / header.length_unit / header.length_unit;
        Self {
            setup: setup.clone(),
            of,
            count,
            filter,
            rotations,
            rotated,
            inertia,
            stiffness,
            rest,
        }
    }

    /// Divided by the crate, and free.
    fn divided(setup: &Setup, count: usize) -> Self {
        let mut of = vec![0; setup.x.len()];
        Aggregates::divide(&setup.rest::<L>().view(), count, &mut of).unwrap();
        Self::new(setup, of, count, vec![FREE; setup.x.len()])
    }

    fn operator(&self) -> Operator<'_, L> {
        Operator {
            rest: self.rest.view(),
            rotated: &self.rotated,
            inertia: &self.inertia,
            stiffness: self.stiffness,
        }
    }

    /// The preconditioner times each of `vectors`.
    fn apply<R: Lanes>(&self, vectors: &[Vec<[f32; 3]>]) -> Vec<Vec<[f32; 3]>> {
        let nodes = self.setup.x.len();
        let aggregates = Aggregates::new(&self.of, self.count).unwrap();
        let preconditioner = Preconditioner::TwoLevel(aggregates);
        let operator = self.operator();
        let mut diagonal = vec![[0.0; 6]; nodes];
        operator.diagonal::<R>(&mut diagonal);
        // What was there before must not matter, nor that there is more than is needed.
        let mut coarse = vec![f32::NAN; coarse_length(self.count + 1)];
        let room = Room {
            blocks: &mut diagonal,
            coarse: &mut coarse,
        };
        let prepared = preconditioner.prepare::<R, L>(
            &operator,
            &self.setup.x,
            &self.rotations,
            (&self.filter, true),
            room,
            &mut vec![[f32::NAN; 3]; nodes],
        );
        let product = |r: &Vec<[f32; 3]>| {
            let mut z = vec![[f32::NAN; 3]; nodes];
            prepared.apply(&self.filter, r, &mut z);
            z
        };
        vectors.iter().map(product).collect()
    }

    /// All of it, by columns.
    fn matrix(&self) -> DMatrix<f64> {
        let nodes = self.setup.x.len();
        let unit = |dof: usize| {
            let mut e = vec![[0.0; 3]; nodes];
            e[dof / 3][dof % 3] = 1.0;
            e
        };
        let columns = self.apply::<Native>(&(0..3 * nodes).map(unit).collect::<Vec<_>>());
        DMatrix::from_fn(3 * nodes, 3 * nodes, |i, j| {
            f64::from(columns[j][i / 3][i % 3])
        })
    }

    /// The dense formula, and E with its diagonal scaled to one.
    fn oracle(&self) -> (DMatrix<f64>, DMatrix<f64>) {
        let (setup, nodes) = (&self.setup, self.setup.x.len());
        let header = self.rest.view().header;
        let unit = f64::from(header.length_unit);
        let q: Vec<Matrix3<f64>> = (0..setup.mesh.tets.len())
            .map(|e| {
                let [w, x, y, z] = self.rotations[e / 8].0.map(|c| f64::from(c[e % 8]));
                let q = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
                q.to_rotation_matrix().into_inner()
            })
            .collect();
        let mut whole = setup.reference();
        let scale = f64::from(self.stiffness) * unit * unit;
        let mass = DVector::from_fn(3 * nodes, |dof, _| f64::from(self.inertia[dof / 3]));
        let a = DMatrix::from_diagonal(&mass) + whole.stiffness(&q) * scale;
        // Only the tetrahedra that are cut.
        let cut: Vec<usize> = (0..whole.tets.len())
            .filter(|&e| {
                whole.tets[e]
                    .iter()
                    .any(|&i| self.of[i] != self.of[whole.tets[e][0]])
            })
            .collect();
        whole.volumes = cut.iter().map(|&e| whole.volumes[e]).collect();
        whole.gradients = cut.iter().map(|&e| whole.gradients[e]).collect();
        whole.tets = cut.iter().map(|&e| whole.tets[e]).collect();
        let q: Vec<_> = cut.iter().map(|&e| q[e]).collect();
        let k_cut = whole.stiffness(&q) * scale;

        let at = |i: usize| Vector3::from(setup.x[i].map(f64::from));
        let mut z = DMatrix::zeros(3 * nodes, 6 * self.count);
        for aggregate in 0..self.count {
            let members: Vec<usize> = (0..nodes)
                .filter(|&i| usize::from(self.of[i]) == aggregate)
                .collect();
            let centre = members.iter().map(|&i| at(i)).sum::<Vector3<f64>>();
            let centre = centre / members.len().max(1) as f64;
            for i in members {
                let turn = -((at(i) - centre) / unit).cross_matrix();
                let column = 6 * aggregate;
                z.fixed_view_mut::<3, 3>(3 * i, column)
                    .copy_from(&Matrix3::identity());
                z.fixed_view_mut::<3, 3>(3 * i, column + 3).copy_from(&turn);
            }
        }
        let blockwise = |f: &dyn Fn(usize) -> Matrix3<f64>| {
            let mut out = DMatrix::zeros(3 * nodes, 3 * nodes);
            for i in 0..nodes {
                out.fixed_view_mut::<3, 3>(3 * i, 3 * i).copy_from(&f(i));
            }
            out
        };
        let s = |i: usize| a.fixed_view::<3, 3>(3 * i, 3 * i).into_owned();
        let blocks = blockwise(&s);
        let local = blockwise(&|i| s(i).try_inverse().unwrap());
        let p = blockwise(&|i| {
            let [xx, xy, xz, yy, yz, zz] = self.filter[i].map(f64::from);
            Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
        });
        let forbidden = DMatrix::identity(3 * nodes, 3 * nodes) - &p;
        let inner = DMatrix::from_diagonal(&mass) + k_cut + &forbidden * blocks * &forbidden;
        let e = z.transpose() * inner * &z;
        let scaled = DMatrix::from_fn(e.nrows(), e.ncols(), |i, j| {
            let size = (e[(i, i)] * e[(j, j)]).sqrt();
            if size > 0.0 { e[(i, j)] / size } else { 0.0 }
        });
        // Motions that are the same for every node say nothing twice: any generalised inverse will do.
        let per = |i: usize| {
            if e[(i, i)] > 0.0 {
                1.0 / e[(i, i)].sqrt()
            } else {
                0.0
            }
        };
        let scaling = DMatrix::from_diagonal(&DVector::from_fn(e.nrows(), |i, _| per(i)));
        let inverse = &scaling * scaled.clone().pseudo_inverse(GONE).unwrap() * &scaling;
        (&p * (local + &z * inverse * z.transpose()) * &p, scaled)
    }

    /// Against the oracle. The factorisation's backward error is at most the number of motions times ε/2
    /// of the scaled E (Higham 2002, theorem 10.5), and E is summed with fewer roundings than that.
    fn check(&self) {
        let (expected, scaled) = self.oracle();
        let values = scaled.symmetric_eigenvalues();
        let least = values.iter().copied().filter(|&x| x > GONE);
        let condition = values.max() / least.fold(f64::INFINITY, f64::min);
        let motions = (6 * self.count + 6) as f64;
        let bound = 2.0 * motions * EPS * condition.max(1.0);
        assert!(
            bound < 0.3,
            "E is too ill-conditioned to compare: {condition:e}"
        );
        let (found, size) = (self.matrix(), expected.amax());
        let error = (found - expected).amax() / size;
        assert!(error <= bound, "off by {error:e}, bound {bound:e}");
    }

    /// Symmetric and positive, whatever the state. In the norm of E each triangular solve is off by the number
    /// of motions times ε/2 and the condition of Cholesky's factor, √(motions · 2¹⁸) at most where smaller
    /// pivots are dropped.
    fn check_definite(&self, seed: u64) {
        let nodes = self.setup.x.len();
        let vectors: Vec<_> = (0..6).map(|k| noise(nodes, 1.0, seed + k)).collect();
        let products = self.apply::<Native>(&vectors);
        assert!(products.iter().flatten().flatten().all(|z| z.is_finite()));
        let dot = |a: &[[f32; 3]], b: &[[f32; 3]]| -> f64 {
            let pairs = a.as_flattened().iter().zip(b.as_flattened());
            pairs.map(|(a, b)| f64::from(*a) * f64::from(*b)).sum()
        };
        let motions = (6 * self.count + 6) as f64;
        let bound = motions * EPS * (motions * f64::from(1 << 18)).sqrt();
        assert!(bound < 0.1);
        let held = self.filter.iter().all(|p| *p == [0.0; 6]);
        for (r, z) in vectors.iter().zip(&products) {
            let own = dot(r, z);
            assert!(own > 0.0 || (held && own == 0.0), "rᵀPr = {own:e}");
            for (s, y) in vectors.iter().zip(&products) {
                let off = (dot(s, z) - dot(r, y)).abs();
                let size = (own * dot(s, y)).sqrt();
                assert!(off <= bound * size, "asymmetric: {off:e} of {size:e}");
            }
        }
    }

    fn check_lanes(&self, seed: u64) {
        let vectors = [noise(self.setup.x.len(), 1.0, seed)];
        let bits = |z: Vec<Vec<[f32; 3]>>| -> Vec<u32> {
            z.concat()
                .as_flattened()
                .iter()
                .map(|z| z.to_bits())
                .collect()
        };
        let one = bits(self.apply::<f32>(&vectors));
        assert_eq!(one, bits(self.apply::<f32x4>(&vectors)));
        assert_eq!(one, bits(self.apply::<f32x8>(&vectors)));
    }
}

/// Eigenvalues of the scaled E below this are zero: between those of motions that are there, and the
/// oracle's rounding.
const GONE: f64 = 1e-9;

/// Random filters: most nodes free, some sliding on a plane, some held.
fn filters(nodes: usize, seed: u64) -> Vec<Sym3<f32>> {
    let mut random = Lcg(seed);
    let one = |_| {
        let kind = random.signed();
        let n = Vector3::from_fn(|_, _| random.signed()).normalize();
        if kind < 0.4 {
            FREE
        } else if kind < 0.8 {
            let p = Matrix3::identity() - n * n.transpose();
            [p.m11, p.m12, p.m13, p.m22, p.m23, p.m33].map(|x| x as f32)
        } else {
            [0.0; 6]
        }
    };
    (0..nodes).map(one).collect()
}

#[test]
fn equals_the_dense_formula() {
    for setup in [bar(), bent(bar()), Setup::new("two", two_pieces())] {
        for count in [1, 3, 8] {
            Case::<Factored>::divided(&setup, count).check();
            Case::<Dense>::divided(&setup, count).check();
            for seed in 0..3 {
                let mut case = Case::<Factored>::divided(&setup, count);
                case.filter = filters(setup.x.len(), seed);
                case.check();
            }
        }
    }
}

/// Aggregates of one node, of two, of a line of them, of none; and all nodes in none.
#[test]
fn degenerate_aggregates_drop_what_they_cannot_move() {
    let setup = bent(bar());
    let nodes = setup.x.len();
    let case = |of: Vec<u8>, count| Case::<Factored>::new(&setup, of, count, vec![FREE; nodes]);
    let few = |members: &[usize]| {
        let mut of = vec![0; nodes];
        members.iter().for_each(|&i| of[i] = 2);
        of
    };
    // The nodes along one edge of an unbent bar.
    let mut line = Setup::new("line", box_mesh([1.0, 0.3, 0.2], [6, 2, 2]));
    line.name = "line";
    let along: Vec<usize> = (0..nodes)
        .filter(|&i| line.x[i][1] == 0.0 && line.x[i][2] == 0.0)
        .collect();
    assert_eq!(along.len(), 7);
    for members in [&[][..], &[7], &[7, 8], &[7, 30]] {
        case(few(members), 3).check();
    }
    Case::<Factored>::new(&line, few(&along), 3, vec![FREE; nodes]).check();
    case(vec![NONE; nodes], 4).check();
    let none = case(vec![NONE; nodes], MAX_AGGREGATES);
    none.check_definite(1);
}

fn mesh() -> impl Strategy<Value = TetMesh> {
    let kind = prop_oneof![
        Just(single_tet()),
        (1..5_usize, 1..4_usize).prop_map(|(n, shared)| chain(n, shared)),
        Just(two_pieces()),
        (1..5_usize, 1..3_usize).prop_map(|(nx, ny)| box_mesh([1.0, 0.3, 0.2], [nx, ny, 1])),
    ];
    (kind, 0.0..0.1_f64, any::<u64>()).prop_map(|(mesh, amount, seed)| jitter(&mesh, amount, seed))
}

/// Rest, noisy, random, mirrored, flat, on a line, in a point, huge.
fn state(setup: &mut Setup, kind: u32, seed: u64) {
    let noise = noise(setup.x.len(), 1.0, seed);
    for (x, n) in setup.x.iter_mut().zip(noise) {
        *x = match kind {
            0 => *x,
            1 => std::array::from_fn(|a| x[a] + 0.05 * n[a]),
            2 => n,
            3 => [-x[0], x[1], x[2]],
            4 => [x[0], 0.25, x[2]],
            5 => [x[0], 0.25, -1.0],
            6 => [0.5; 3],
            _ => n.map(|n| 1e6 * n),
        };
    }
}

fn case() -> impl Strategy<Value = (Setup, Vec<u8>, usize, Vec<Sym3<f32>>, u64)> {
    let what = (mesh(), 0..8_u32, 0..=MAX_AGGREGATES, any::<u64>());
    let how = (3.0..9.5_f64, -0.5..0.499_f32, 1e-3..0.03_f32, 0..3_u32);
    (what, how).prop_map(|((mesh, kind, count, seed), (young, poisson, h, chosen))| {
        let mut setup = Setup::new("random", mesh);
        (setup.young, setup.poisson, setup.h) = (10_f64.powf(young) as f32, poisson, h);
        state(&mut setup, kind, seed);
        let nodes = setup.x.len();
        let mut of = vec![0; nodes];
        Aggregates::divide(&setup.rest::<Factored>().view(), count, &mut of).unwrap();
        if chosen == 0 {
            // Any assignment, some nodes left out.
            let mut random = Lcg(seed ^ 2);
            for of in &mut of {
                let pick = (0.5 * (random.signed() + 1.0) * (count + 1) as f64) as usize;
                *of = if pick < count { pick as u8 } else { NONE };
            }
        }
        let filter = if chosen == 1 {
            vec![FREE; nodes]
        } else {
            filters(nodes, seed ^ 3)
        };
        (setup, of, count, filter, seed)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn symmetric_positive_and_the_same_in_every_width((setup, of, count, filter, seed) in case()) {
        let factored = Case::<Factored>::new(&setup, of.clone(), count, filter.clone());
        factored.check_definite(seed);
        factored.check_lanes(seed);
        let dense = Case::<Dense>::new(&setup, of, count, filter);
        dense.check_definite(seed);
        dense.check_lanes(seed);
    }

    /// Every node is in an aggregate unless its piece has none, all that can be are used, and a piece is
    /// never divided from itself: aggregates are connected.
    #[test]
    fn the_division_is_sensible(mesh in mesh(), count in 0..=MAX_AGGREGATES) {
        let nodes = mesh.nodes.len();
        let setup = Setup::new("divided", mesh);
        let mut of = vec![7; nodes];
        let aggregates = Aggregates::divide(&setup.rest::<Factored>().view(), count, &mut of).unwrap();
        prop_assert_eq!(aggregates.count(), count);
        let of = aggregates.of();
        prop_assert!(Aggregates::new(of, count).is_ok());
        let used = (0..count).filter(|&a| of.contains(&(a as u8))).count();
        prop_assert_eq!(used, count.min(nodes));
        for aggregate in 0..count as u8 {
            let members: Vec<usize> = (0..nodes).filter(|&i| of[i] == aggregate).collect();
            let mut reached: Vec<usize> = members.iter().take(1).copied().collect();
            let mut next = 0;
            while let Some(&node) = reached.get(next) {
                let around = setup.mesh.tets.iter().filter(|t| t.contains(&(node as u32))).flatten();
                for &other in around {
                    let other = other as usize;
                    if of[other] == aggregate && !reached.contains(&other) {
                        reached.push(other);
                    }
                }
                next += 1;
            }
            prop_assert_eq!(reached.len(), members.len());
        }
        let pieces = if setup.mesh.tets == two_pieces().tets { 2 } else { 1 };
        if count >= pieces {
            prop_assert!(!of.contains(&NONE));
        }
    }
}
