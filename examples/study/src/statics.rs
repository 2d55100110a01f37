//! Bodies at rest under a load, and their frequencies.

use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Col, Side};
use femto::element::Factored;
use femto::{Budget, Preconditioner, Scene, Settings, Start};
use femto_bake::{FactorOptions, Kind, factor};

use crate::methods::direct::free_rows;
use crate::problem::Problem;

/// Where femto's step brings the nodes to rest: backward Euler with long steps damps what still moves.
pub fn settled(problem: &Problem, forces: &[[f32; 3]], h: f32, steps: u32) -> Vec<[f32; 3]> {
    let start = Start::Galerkin(1);
    let mut body = problem.body::<Factored>(start);
    let budget = Budget {
        iterations: 12,
        polar_sweeps: 4,
    };
    let settings = Settings::new(h)
        .expect("a positive time step")
        .with_start(start)
        .with_budget(budget);
    let options = FactorOptions {
        kind: Kind::Warped,
        held: problem.held.clone(),
        ..FactorOptions::default()
    };
    let made = factor(&body.rest(), &settings, &options).expect("a positive definite matrix");
    let view = made.view();
    let settings = settings.with_preconditioner(Preconditioner::Factored(&view));
    let pins = problem.pins();
    let scene = Scene {
        gravity: problem.gravity(),
        pins: &pins,
        forces,
        ..Scene::default()
    };
    for _ in 0..steps {
        let report = body.step(&scene, &settings);
        assert!(report.advanced(), "{}: {report:?}", problem.name);
    }
    body.positions().to_vec()
}

/// Which mass matrix.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Mass {
    Lumped,
    Consistent,
}

/// The lowest frequency of the body at rest in hertz: inverse iteration on K u = ω² M u, in f64.
pub fn lowest_frequency(problem: &Problem, mass: Mass) -> f64 {
    let mut body = problem.baseline::<f64>(1.0);
    body.assemble();
    let rows = free_rows(problem, 3);
    let n = 3 * (problem.nodes.len() - problem.held.len());
    let mut entries = Vec::new();
    for (i, j, block) in body.matrix.blocks() {
        let (Some(row), Some(column)) = (rows[i], rows[j]) else {
            continue;
        };
        for (k, &value) in block.iter().enumerate() {
            let (row, column) = (row + k % 3, column + k / 3);
            // A = M + K at a step of one second.
            let value = if row == column {
                value - body.masses[i]
            } else {
                value
            };
            if row >= column {
                entries.push(Triplet::new(row, column, value));
            }
        }
    }
    let stiffness = SparseColMat::try_new_from_triplets(n, n, &entries).expect("indices in range");
    let factor: Llt<usize, f64> = stiffness.sp_cholesky(Side::Lower).expect("a held body");
    let times = |u: &Col<f64>| {
        let mut out = Col::<f64>::zeros(n);
        for tet in &problem.tets {
            let part = problem.volume(*tet) * f64::from(problem.density) / 20.0;
            for (a, i) in tet.iter().enumerate() {
                let Some(row) = rows[*i as usize] else {
                    continue;
                };
                for (b, j) in tet.iter().enumerate() {
                    let weight = match mass {
                        Mass::Lumped if a == b => 5.0,
                        Mass::Lumped => 0.0,
                        Mass::Consistent if a == b => 2.0,
                        Mass::Consistent => 1.0,
                    };
                    if let Some(column) = rows[*j as usize] {
                        for axis in 0..3 {
                            out[row + axis] += part * weight * u[column + axis];
                        }
                    }
                }
            }
        }
        out
    };
    let dot = |a: &Col<f64>, b: &Col<f64>| (0..n).map(|i| a[i] * b[i]).sum::<f64>();
    // Sideways, and differently so in y and z: the two bending modes have one frequency.
    let mut u = Col::<f64>::from_fn(n, |i| {
        if i % 3 == 0 {
            0.0
        } else {
            1.0 + (i % 3) as f64
        }
    });
    let mut square = 0.0;
    for _ in 0..40 {
        let m_u = times(&u);
        let next = factor.solve(&m_u);
        let m_next = times(&next);
        square = dot(&next, &m_u) / dot(&next, &m_next);
        let size = dot(&next, &m_next).sqrt();
        u = Col::from_fn(n, |i| next[i] / size);
    }
    square.sqrt() / std::f64::consts::TAU
}
