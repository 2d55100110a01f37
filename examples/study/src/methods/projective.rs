//! Projective Dynamics (Bouaziz et al., "Projective Dynamics", SIGGRAPH 2014) on the same energy.
//!
//! Backward Euler as a minimum of ½‖x − y‖²_M/h² + E(x), y = x + hv + h²g. The corotated energy is the
//! distance to two sets, with weights w₁ = 2μV (rotations) and w₂ = 3λV (F with tr(RᵀF) = 3):
//!
//! ```text
//! V (μ ‖F − R‖² + ½λ (tr(RᵀF) − 3)²) = ½ w₁ ‖F − R‖² + ½ w₂ ‖F − P‖²,   P = F − (tr(RᵀF) − 3)/3 R
//! (M/h² + Σ (w₁ + w₂) g_i g_jᵀ) Δx = M/h² (y − x) + f(x)
//! ```
//!
//! The local step is R, and with it the forces f; the global one a scalar matrix that never changes,
//! factored beforehand, for x, y and z at once.

use faer::Mat;
use faer::Side;
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMat, Triplet};

use crate::method::{Contender, Method, widened};
use crate::methods::direct::free_rows;
use crate::methods::forces::Forces;
use crate::problem::Problem;

struct Projective {
    forces: Forces,
    factor: Llt<usize, f32>,
    rows: Vec<Option<usize>>,
    right: Mat<f32>,
    f: Vec<[f32; 3]>,
    x: Vec<[f32; 3]>,
    v: Vec<[f32; 3]>,
    /// y
    target: Vec<[f32; 3]>,
    old: Vec<[f32; 3]>,
    gravity: [f32; 3],
    dt: f32,
    iterations: u32,
}

impl Projective {
    fn new(problem: &Problem, dt: f64, iterations: u32) -> Self {
        let forces = Forces::new(problem);
        let rest = forces.rest.view();
        let rows = free_rows(problem, 1);
        let unknowns = problem.nodes.len() - problem.held.len();
        let mut entries = Vec::new();
        let mut add = |i: usize, j: usize, value: f64| {
            if let (Some(row), Some(column)) = (rows[i], rows[j])
                && row >= column
            {
                entries.push(Triplet::new(row, column, value as f32));
            }
        };
        for (node, &m) in rest.masses.iter().enumerate() {
            add(node, node, f64::from(m) / dt / dt);
        }
        for (e, tet) in problem.tets.iter().enumerate() {
            let (block, lane) = (&rest.blocks[e / 8], e % 8);
            let weight = 2.0 * f64::from(block.mu_v[lane]) + 3.0 * f64::from(block.lambda_v[lane]);
            let g = block.gradients.map(|g| g.map(|axis| f64::from(axis[lane])));
            let first = [0, 1, 2].map(|a| -(g[0][a] + g[1][a] + g[2][a]));
            let g = [first, g[0], g[1], g[2]];
            for (i, gi) in tet.iter().zip(&g) {
                for (j, gj) in tet.iter().zip(&g) {
                    let dot: f64 = gi.iter().zip(gj).map(|(a, b)| a * b).sum();
                    add(*i as usize, *j as usize, weight * dot);
                }
            }
        }
        let matrix = SparseColMat::try_new_from_triplets(unknowns, unknowns, &entries)
            .expect("indices in range");
        let factor = matrix.sp_cholesky(Side::Lower).expect("positive definite");
        Self {
            factor,
            right: Mat::zeros(unknowns, 3),
            rows,
            f: vec![[0.0; 3]; problem.nodes.len()],
            x: problem.nodes.clone(),
            v: problem.v.clone(),
            target: problem.nodes.clone(),
            old: problem.nodes.clone(),
            gravity: problem.gravity,
            dt: dt as f32,
            iterations,
            forces,
        }
    }
}

impl Method for Projective {
    fn step(&mut self) {
        let h = self.dt;
        self.old.copy_from_slice(&self.x);
        for (node, row) in self.rows.iter().enumerate() {
            if row.is_some() {
                let (x, v) = (self.x[node], self.v[node]);
                self.target[node] = [0, 1, 2].map(|a| x[a] + h * (v[a] + h * self.gravity[a]));
            }
        }
        self.x.copy_from_slice(&self.target);
        for _ in 0..self.iterations {
            self.f.fill([0.0; 3]);
            self.forces.add(&self.x, 1, &mut self.f);
            let masses = self.forces.rest.view().masses;
            for (node, row) in self.rows.iter().enumerate() {
                if let Some(row) = *row {
                    let pull = masses[node] / (h * h);
                    for a in 0..3 {
                        let away = self.target[node][a] - self.x[node][a];
                        self.right[(row, a)] = pull * away + self.f[node][a];
                    }
                }
            }
            self.factor.solve_in_place(&mut self.right);
            for (node, row) in self.rows.iter().enumerate() {
                if let Some(row) = *row {
                    for a in 0..3 {
                        self.x[node][a] += self.right[(row, a)];
                    }
                }
            }
        }
        for ((v, x), old) in self.v.iter_mut().zip(&self.x).zip(&self.old) {
            *v = [0, 1, 2].map(|a| (x[a] - old[a]) / h);
        }
    }
    fn positions(&self) -> Vec<[f64; 3]> {
        widened(&self.x)
    }
    fn velocities(&self) -> Vec<[f64; 3]> {
        widened(&self.v)
    }
}

pub fn contender(substeps: u32, iterations: u32) -> Contender {
    Contender::new(
        "Projective Dynamics",
        format!("{substeps}×{iterations} it."),
        substeps,
        move |problem, dt| Projective::new(problem, dt, iterations),
    )
}
