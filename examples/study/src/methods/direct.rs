//! The usual pipeline with a sparse Cholesky factorisation in every step.

use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Col, Side};
use femto_bench::baseline::Baseline;

use crate::method::{Contender, Method, widened};
use crate::problem::Problem;

/// Backward Euler with rotations frozen, solved directly.
struct Direct {
    body: Baseline<f32>,
    /// The row of each node's first unknown; none where it is held.
    rows: Vec<Option<usize>>,
    unknowns: usize,
    symbolic: Option<SymbolicLlt<usize>>,
}

impl Direct {
    fn new(problem: &Problem, dt: f64) -> Self {
        let rows = free_rows(problem, 3);
        let unknowns = 3 * (problem.nodes.len() - problem.held.len());
        Self {
            body: problem.baseline(dt),
            rows,
            unknowns,
            symbolic: None,
        }
    }
}

/// Where the unknowns of the free nodes stand, `width` of them a node.
pub fn free_rows(problem: &Problem, width: usize) -> Vec<Option<usize>> {
    let mut next = 0;
    let mut rows = vec![None; problem.nodes.len()];
    for (node, row) in (0_u32..).zip(&mut rows) {
        if !problem.held.contains(&node) {
            *row = Some(next);
            next += width;
        }
    }
    rows
}

impl Method for Direct {
    fn step(&mut self) {
        self.body.assemble();
        let mut entries = Vec::new();
        let mut right = Col::<f32>::zeros(self.unknowns);
        for (i, j, block) in self.body.matrix.blocks() {
            let (Some(row), Some(column)) = (self.rows[i], self.rows[j]) else {
                continue;
            };
            for (k, &value) in block.iter().enumerate() {
                let (row, column) = (row + k % 3, column + k / 3);
                if row >= column {
                    entries.push(Triplet::new(row, column, value));
                }
            }
        }
        for (node, row) in self.rows.iter().enumerate() {
            if let Some(row) = *row {
                for (axis, value) in self.body.right_hand_side(node).into_iter().enumerate() {
                    right[row + axis] = value;
                }
            }
        }
        let matrix = SparseColMat::try_new_from_triplets(self.unknowns, self.unknowns, &entries)
            .expect("indices in range");
        let symbolic = self.symbolic.get_or_insert_with(|| {
            SymbolicLlt::try_new(matrix.symbolic(), Side::Lower).expect("memory for the factor")
        });
        let factor = Llt::try_new_with_symbolic(symbolic.clone(), matrix.as_ref(), Side::Lower)
            .expect("A is positive definite");
        let v = factor.solve(&right);
        self.body.advance(|node| match self.rows[node] {
            Some(row) => [v[row], v[row + 1], v[row + 2]],
            None => [0.0; 3],
        });
    }
    fn positions(&self) -> Vec<[f64; 3]> {
        widened(&self.body.x)
    }
    fn velocities(&self) -> Vec<[f64; 3]> {
        widened(&self.body.v)
    }
}

pub fn contender(substeps: u32) -> Contender {
    Contender::new(
        "assembled, factored each step",
        format!("{substeps}×"),
        substeps,
        Direct::new,
    )
}
