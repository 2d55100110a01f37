//! Factors: what they invert, that they are positive definite whatever they hold, and what is refused.

use crate::support::factors::{factor, factor_with};
use crate::support::meshes::{
    Lcg, TetMesh, box_mesh, chain, jitter, noise, single_tet, two_pieces,
};
use crate::support::reference::stack;
use crate::support::scenes::{self, Setup};
use femto::Preconditioner;
use femto::element::{Dense, Factored};
use femto::material::Material;
use femto::mesh::Mesh;
use femto::owned::OwnedRest;
use femto::preconditioner::factor::{Entries, Factor, FactorError};
use femto::report::Refusal;
use femto::settings::{Settings, Start};
use femto_bake::{FactorOptions, HostFactorError, Kind, Precision};
use nalgebra::{DMatrix, DVector, Matrix3};
use proptest::prelude::*;

fn setups() -> Vec<Setup> {
    let meshes = [
        ("tet", single_tet()),
        ("chain", chain(9, 2)),
        ("pieces", two_pieces()),
        (
            "box",
            jitter(&box_mesh([1.0, 0.4, 0.3], [5, 2, 2]), 0.03, 5),
        ),
    ];
    let free = meshes.map(|(name, mesh)| Setup {
        young: 1e5,
        alpha: 0.3,
        beta: 0.002,
        ..Setup::new(name, mesh)
    });
    let held = free
        .clone()
        .map(|setup| setup.pinned(|x| x[0] < 0.2, |_| [0.0; 3]));
    free.into_iter().chain(held).collect()
}

/// A₀ by the oracle, rows and columns of held nodes reduced to their diagonal blocks.
#[allow(non_snake_case)]
fn rest_matrix(setup: &Setup, kind: Kind) -> DMatrix<f64> {
    let oracle = setup.reference();
    let upright = vec![Matrix3::identity(); setup.mesh.tets.len()];
    let (elastic, _) = oracle.system(&upright);
    let mut A = match kind {
        Kind::Warped => elastic,
        Kind::Laplacian => {
            let h = oracle.h;
            let weight = (oracle.lambda.min(2.0 * oracle.mu) + 4.0 * oracle.mu) / 3.0;
            let mut A = DMatrix::from_diagonal(&(oracle.mass() * (1.0 + h * oracle.alpha)));
            for (e, tet) in oracle.tets.iter().enumerate() {
                for (&i, g_i) in tet.iter().zip(&oracle.gradients[e]) {
                    for (&j, g_j) in tet.iter().zip(&oracle.gradients[e]) {
                        for axis in 0..3 {
                            A[(3 * i + axis, 3 * j + axis)] += (h * h + h * oracle.beta)
                                * weight
                                * oracle.volumes[e]
                                * g_i.dot(g_j);
                        }
                    }
                }
            }
            A
        }
    };
    for &(node, _) in &setup.pins {
        for other in (0..setup.x.len()).filter(|&other| other != node as usize) {
            A.fixed_view_mut::<3, 3>(3 * node as usize, 3 * other)
                .fill(0.0);
            A.fixed_view_mut::<3, 3>(3 * other, 3 * node as usize)
                .fill(0.0);
        }
    }
    A
}

#[test]
fn a_factor_inverts_the_rest_matrix() {
    for setup in setups() {
        for kind in [Kind::Warped, Kind::Laplacian] {
            let matrix = rest_matrix(&setup, kind);
            let eigenvalues = matrix.symmetric_eigenvalues();
            let condition = eigenvalues.max() / eigenvalues.min();
            let unit = f64::from(setup.body::<Factored>(Start::Zero).rest().header.mass_unit);
            for (precision, rounding) in [
                (Precision::Single, f64::from(f32::EPSILON)),
                (Precision::Half, HALF_EPSILON),
            ] {
                let factor = factor(&setup, kind, precision);
                assert_eq!(factor.nodes(), setup.x.len());
                let mut z = noise(setup.x.len(), 1.0, 7);
                let r = stack(&z);
                factor.solve(&mut z);
                let exact = matrix.clone().cholesky().unwrap().solve(&r) * unit;
                let off = (stack(&z) - &exact).norm() / exact.norm();
                // Every entry is off by half a rounding, and the inverse by that times the condition at worst.
                let bound = rounding * condition.max(2.0);
                let name = (setup.name, setup.pins.len(), kind, precision);
                assert!(off < bound, "{name:?}: {off:e} of {bound:e}");
                println!("{name:?}: {off:e}, condition {condition:.1e}");
            }
        }
    }
}

/// Of binary16.
const HALF_EPSILON: f64 = 1.0 / 1024.0;

/// Any order, any rows, any entries: what `Factor::new` takes is symmetric and positive definite.
fn parts() -> impl Strategy<Value = (Vec<u16>, Vec<u32>, Vec<u16>, u64)> {
    (1..12_u16).prop_flat_map(|nodes| {
        let n = usize::from(nodes);
        let order = prop::collection::vec(0..nodes, n);
        let counts = prop::collection::vec(0..4_u32, n);
        (order, counts, any::<u64>()).prop_flat_map(move |(order, counts, seed)| {
            let ends: Vec<u32> = counts
                .iter()
                .scan(0, |end, count| {
                    *end += count;
                    Some(*end)
                })
                .collect();
            let rows = prop::collection::vec(0..nodes, ends[n - 1] as usize);
            (Just(order), Just(ends), rows, Just(seed))
        })
    })
}

fn check_definite(factor: &Factor<'_>, seed: u64) -> Result<(), TestCaseError> {
    let nodes = factor.nodes();
    let apply = |u: &[[f32; 3]]| {
        let mut z = u.to_vec();
        factor.solve(&mut z);
        stack(&z)
    };
    let (x, y) = (noise(nodes, 1.0, seed ^ 1), noise(nodes, 1.0, seed ^ 2));
    let (px, py) = (apply(&x), apply(&y));
    let (x, y) = (stack(&x), stack(&y));
    let size = (x.norm() * py.norm()).max(y.norm() * px.norm());
    let skew = (x.dot(&py) - y.dot(&px)).abs();
    prop_assert!(skew <= 1e-4 * size, "not symmetric: {skew:e} of {size:e}");
    prop_assert!(x.dot(&px) > -1e-4 * x.norm() * px.norm());
    Ok(())
}

proptest! {
    #[test]
    fn any_factor_is_symmetric_and_positive((order, ends, rows, seed) in parts()) {
        let nodes = order.len();
        let mut random = Lcg(seed);
        let mut number = || random.signed() as f32;
        let pivots: Vec<[f32; 6]> = (0..nodes)
            .map(|_| {
                let b = Matrix3::from_fn(|_, _| number());
                let p = b * b.transpose() + Matrix3::identity() * 0.1;
                [p[(0, 0)], p[(0, 1)], p[(0, 2)], p[(1, 1)], p[(1, 2)], p[(2, 2)]]
            })
            .collect();
        let lower: Vec<[f32; 9]> = rows.iter().map(|_| std::array::from_fn(|_| 0.5 * number())).collect();
        let warped = Entries::Warped { pivots: &pivots, lower: &lower };
        check_definite(&Factor::new(0, &order, &ends, &rows, warped).unwrap(), seed)?;
        let bits: Vec<[u16; 9]> = lower.iter().map(|b| b.map(|x| if x > 0.0 { 0x3555 } else { 0xb801 })).collect();
        let halves = Entries::WarpedHalf { pivots: &pivots, lower: &bits };
        check_definite(&Factor::new(0, &order, &ends, &rows, halves).unwrap(), seed)?;
        let pivots: Vec<f32> = pivots.iter().map(|p| p[0]).collect();
        let lower: Vec<f32> = lower.iter().map(|b| b[0]).collect();
        let laplacian = Entries::Laplacian { pivots: &pivots, lower: &lower };
        check_definite(&Factor::new(0, &order, &ends, &rows, laplacian).unwrap(), seed)?;
    }
}

#[test]
fn malformed_factors_are_named() {
    let (order, ends, rows) = ([0_u16, 1, 2], [1_u32, 2, 2], [1_u16, 2]);
    let (pivots, lower) = ([1.0_f32; 3], [0.5_f32; 2]);
    let laplacian = |pivots, lower| Entries::Laplacian { pivots, lower };
    let good = laplacian(&pivots, &lower);
    let make = Factor::new;
    assert!(make(0, &order, &ends, &rows, good).is_ok());
    let cases = [
        (make(0, &order[..2], &ends, &rows, good), FactorError::Shape),
        (make(0, &order, &ends[..2], &rows, good), FactorError::Shape),
        (make(0, &order, &ends, &rows[..1], good), FactorError::Shape),
        (make(0, &order, &[2, 1, 2], &rows, good), FactorError::Shape),
        (make(0, &order, &[1, 2, 3], &rows, good), FactorError::Shape),
        (
            make(0, &order, &ends, &rows, laplacian(&pivots[..2], &lower)),
            FactorError::Shape,
        ),
        (
            make(0, &order, &ends, &rows, laplacian(&pivots, &lower[..1])),
            FactorError::Shape,
        ),
        (
            make(0, &[0, 3, 2], &ends, &rows, good),
            FactorError::Node { place: 1 },
        ),
        (
            make(0, &order, &ends, &[3, 1], good),
            FactorError::Node { place: 0 },
        ),
        (
            make(0, &order, &ends, &rows, laplacian(&[1.0, 0.0, 1.0], &lower)),
            FactorError::Pivot { node: 1 },
        ),
        (
            make(
                0,
                &order,
                &ends,
                &rows,
                laplacian(&pivots, &[0.5, f32::NAN]),
            ),
            FactorError::Entry { place: 1 },
        ),
    ];
    for (found, expected) in cases {
        assert_eq!(found, Err(expected));
        assert!(!expected.to_string().is_empty());
    }
    // Half precision: infinite, NaN, subnormal; and a block that is not positive definite.
    for bits in [0x7c00, 0xfe00, 0x0001] {
        let lower = [0x3c00, bits];
        let entries = Entries::LaplacianHalf {
            pivots: &pivots,
            lower: &lower,
        };
        let found = Factor::new(0, &order, &ends, &rows, entries);
        assert_eq!(found, Err(FactorError::Entry { place: 1 }));
    }
    let pivots = [
        [1.0, 0.0, 0.0, 1.0, 0.0, 1.0],
        [1.0, 2.0, 0.0, 1.0, 0.0, 1.0],
        [1.0, 0.0, 0.0, 1.0, 0.0, 1.0],
    ];
    let entries = Entries::Warped {
        pivots: &pivots,
        lower: &[[0.0; 9]; 2],
    };
    let found = Factor::new(0, &order, &ends, &rows, entries);
    assert_eq!(found, Err(FactorError::Pivot { node: 1 }));
}

#[test]
fn a_factor_of_another_mesh_is_refused() {
    let setup = scenes::free_spin();
    let mut others = [setup.clone(), setup.clone(), scenes::two()];
    others[0].mesh.nodes[3][1] += 1e-3;
    others[1].mesh.tets.swap(0, 1);
    for mut other in others {
        other.x.clone_from(&other.mesh.nodes);
        let factor = factor(&other, Kind::Laplacian, Precision::Single);
        let mut body = setup.body::<Factored>(Start::Zero);
        let before = body.state().clone();
        let settings = setup.solver(Start::Zero, Preconditioner::Factored(factor), 3);
        let report = body.step(&setup.scene(&[]), &settings);
        assert_eq!(report.refusal, Some(Refusal::Factor));
        assert!(*body.state() == before);
    }
}

#[test]
fn what_no_factor_can_be_made_of() {
    let setup = scenes::cantilever();
    let body = setup.body::<Factored>(Start::Zero);
    let make = |options: &FactorOptions| {
        femto_bake::factor(&body.rest(), &setup.settings(), options).map(|_| ())
    };
    let missing = setup.x.len() as u32;
    let options = FactorOptions {
        held: vec![0, missing],
        ..FactorOptions::default()
    };
    assert_eq!(make(&options), Err(HostFactorError::Held { node: missing }));

    let many = chain(65_533, 3);
    let mesh = Mesh::new(&many.nodes, &many.tets).unwrap();
    let rest = OwnedRest::<Factored>::new(&mesh, &setup.material()).unwrap();
    let found = femto_bake::factor(&rest.view(), &setup.settings(), &FactorOptions::default());
    assert_eq!(found, Err(HostFactorError::TooManyNodes { nodes: 65_536 }));

    // A material that gains energy by being deformed.
    let TetMesh { nodes, tets } = box_mesh([1.0, 1.0, 1.0], [2, 2, 2]);
    let mesh = Mesh::new(&nodes, &tets).unwrap();
    let material = Material::new(1e6, 0.3, 1000.0).unwrap();
    let mut unstable = [[0.0; 6]; 6];
    for (k, row) in unstable.iter_mut().enumerate() {
        row[k] = -1e6;
    }
    let rest = OwnedRest::<Dense>::anisotropic(&mesh, &material, |_| unstable).unwrap();
    let settings = Settings::new(0.01).unwrap();
    let found = femto_bake::factor(&rest.view(), &settings, &FactorOptions::default());
    assert!(matches!(
        found,
        Err(HostFactorError::NotPositiveDefinite { .. })
    ));
}

/// Both layouts describe the same body, so that their factors agree to the rounding of the dense blocks.
#[test]
fn the_layout_does_not_matter() {
    let setup = scenes::cantilever();
    let settings = setup.settings();
    let options = FactorOptions::default();
    let factored = setup.body::<Factored>(Start::Zero);
    let dense = setup.body::<Dense>(Start::Zero);
    let factored = femto_bake::factor(&factored.rest(), &settings, &options).unwrap();
    let dense = femto_bake::factor(&dense.rest(), &settings, &options).unwrap();
    let solve = |factor: &Factor<'_>| {
        let mut z = noise(setup.x.len(), 1.0, 3);
        factor.solve(&mut z);
        stack(&z)
    };
    let (a, b): (DVector<f64>, DVector<f64>) = (solve(&factored.view()), solve(&dense.view()));
    assert!((&a - &b).norm() < 1e-4 * a.norm());
}

#[test]
fn thinned_factors_are_smaller_and_still_guide() {
    let setup = scenes::cantilever();
    let full = factor(&setup, Kind::Warped, Precision::Single);
    let step = |preconditioner, iterations| {
        let mut body = setup.body::<Factored>(Start::Zero);
        let pins = setup.pin_list();
        let settings = setup.solver(Start::Zero, preconditioner, iterations);
        let report = body.step(&setup.scene(&pins), &settings);
        assert!(report.advanced());
        report.relative_residual()
    };
    let jacobi = step(Preconditioner::Jacobi, 10);
    let held: Vec<u32> = setup.pins.iter().map(|pin| pin.0).collect();
    let half = full.rows().len() / 2;
    for options in [
        FactorOptions {
            drop: 0.05,
            held: held.clone(),
            ..FactorOptions::default()
        },
        FactorOptions {
            fill: Some(half),
            held: held.clone(),
            ..FactorOptions::default()
        },
    ] {
        let thin = factor_with(&setup, &options);
        println!("{} of {} blocks", thin.rows().len(), full.rows().len());
        assert!(thin.rows().len() < full.rows().len());
        assert!(options.fill.is_none_or(|fill| thin.rows().len() <= fill));
        let residual = step(Preconditioner::Factored(thin), 10);
        assert!(residual < 0.2 * jacobi, "{residual:e}, Jacobi {jacobi:e}");
    }
}

/// What is dropped goes to a neighbour: the blocks of a column sum to what they summed to, each number rounded once.
#[test]
fn thinned_columns_keep_their_sums() {
    let setup = scenes::cantilever();
    let full = factor(&setup, Kind::Warped, Precision::Single);
    let thin = factor_with(
        &setup,
        &FactorOptions {
            fill: Some(full.rows().len() / 2),
            held: setup.pins.iter().map(|pin| pin.0).collect(),
            ..FactorOptions::default()
        },
    );
    let mut moved = 0;
    for j in 0..full.nodes() {
        let ((count, sum, size), (few, thin_sum, thin_size)) = (column(full, j), column(thin, j));
        if few == 0 {
            continue;
        }
        moved += usize::from(few < count);
        for k in 0..9 {
            let rounding = f64::from(f32::EPSILON) * (size[k] + thin_size[k]);
            assert!((sum[k] - thin_sum[k]).abs() <= rounding, "column {j}");
        }
    }
    assert!(moved > full.nodes() / 2, "{moved} columns");
}

/// How many blocks column `j` of a warped factor has, their sum, and the sum of their magnitudes.
fn column(factor: &Factor<'_>, j: usize) -> (usize, [f64; 9], [f64; 9]) {
    let Entries::Warped { lower, .. } = factor.entries() else {
        unreachable!("single precision was asked for")
    };
    let start = j.checked_sub(1).map_or(0, |i| factor.ends()[i] as usize);
    let blocks = &lower[start..factor.ends()[j] as usize];
    let total = |size: fn(f64) -> f64| {
        std::array::from_fn(|k| blocks.iter().map(|block| size(f64::from(block[k]))).sum())
    };
    (blocks.len(), total(|x| x), total(f64::abs))
}
