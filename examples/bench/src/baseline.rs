//! Corotated elements the usual way, for comparison: rotations from an SVD, element matrices
//! R K⁰ Rᵀ, assembled into block-CSR, and a Jacobi-preconditioned CG from v(t). In f32, and as good as
//! plain code gets: the pattern and the entries that a tetrahedron adds to are computed beforehand.

use femto::element::Factored;
use nalgebra::{Matrix3, Vector3};

use crate::csr::BlockCsr;
use crate::kernels::{Body, DT};
use crate::mesh::Scene;

/// One tetrahedron at rest.
struct Tet {
    corners: [u32; 4],
    /// g₁, g₂, g₃ as rows: F = [x_j − x_0] · gradients.
    gradients: Matrix3<f32>,
    /// K⁰, `[row corner][column corner]`.
    stiffness: [[Matrix3<f32>; 4]; 4],
}

/// A body and its solver.
pub struct Baseline {
    rest: Vec<Vector3<f32>>,
    masses: Vec<f32>,
    tets: Vec<Tet>,
    pub x: Vec<[f32; 3]>,
    pub v: Vec<[f32; 3]>,
    matrix: BlockCsr,
    forces: Vec<[f32; 3]>,
    vectors: [Vec<[f32; 3]>; 4],
}

/// The rotation nearest to F.
pub fn polar(f: &Matrix3<f32>) -> Matrix3<f32> {
    let svd = f.svd(true, true);
    let (u, mut v_t) = (svd.u.unwrap_or_default(), svd.v_t.unwrap_or_default());
    if u.determinant() * v_t.determinant() < 0.0 {
        v_t.row_mut(2).neg_mut(); // of the smallest singular value
    }
    u * v_t
}

impl Baseline {
    /// The body of the scene, with the masses and gradients of femto's rest data.
    pub fn new(scene: &Scene, body: &Body<Factored>) -> Self {
        let rest = body.rest.view();
        let tet = |(tet, &corners): (usize, &[u32; 4])| {
            let (block, lane) = (&rest.blocks[tet / 8], tet % 8);
            let g: [Vector3<f32>; 3] = block
                .gradients
                .map(|g| Vector3::from(g.map(|axis| axis[lane])));
            let (lambda, mu) = (block.lambda_v[lane], block.mu_v[lane]);
            let gradients = Matrix3::from_rows(&g.map(|g| g.transpose()));
            let g = [-(g[0] + g[1] + g[2]), g[0], g[1], g[2]];
            let stiffness = g.map(|gi| {
                g.map(|gj| {
                    let isotropic = Matrix3::from_diagonal_element(mu * gi.dot(&gj));
                    gi * gj.transpose() * lambda + isotropic + gj * gi.transpose() * mu
                })
            });
            Tet {
                corners,
                gradients,
                stiffness,
            }
        };
        let zeros = || vec![[0.0; 3]; scene.nodes.len()];
        Self {
            rest: scene.nodes.iter().map(|&node| node.into()).collect(),
            masses: rest.masses.to_vec(),
            tets: scene.tets.iter().enumerate().map(tet).collect(),
            x: scene.x.clone(),
            v: scene.v.clone(),
            matrix: BlockCsr::new(scene.nodes.len(), &scene.tets),
            forces: zeros(),
            vectors: [zeros(), zeros(), zeros(), zeros()],
        }
    }

    /// Back to the state of the scene.
    pub fn reset(&mut self, scene: &Scene) {
        self.x.copy_from_slice(&scene.x);
        self.v.copy_from_slice(&scene.v);
    }

    /// Writes the rotations of all tetrahedra.
    pub fn rotations(&self, out: &mut [Matrix3<f32>]) {
        for (tet, out) in self.tets.iter().zip(out) {
            *out = tet.rotation(&self.x);
        }
    }

    /// One step of backward Euler.
    pub fn step(&mut self, iterations: u32) {
        self.assemble();
        let [v, r, p, q] = &mut self.vectors;
        // A v⁺ = M v + h f, from v(t).
        v.copy_from_slice(&self.v);
        self.matrix.product_in_lanes(v, q);
        let rows = r
            .iter_mut()
            .zip(&self.v)
            .zip(&self.forces)
            .zip(&self.masses)
            .zip(&*q);
        for ((((r, v), f), m), q) in rows {
            *r = [0, 1, 2].map(|axis| m * v[axis] + DT * f[axis] - q[axis]);
        }
        let inverse: Vec<[f32; 3]> = self.matrix.diagonal().map(|d| d.map(|d| 1.0 / d)).collect();
        p.fill([0.0; 3]);
        let mut previous = f32::INFINITY;
        for _ in 0..iterations {
            let rz = sum(r, &inverse, |r, d| r * r * d);
            let beta = rz / previous;
            previous = rz;
            for ((p, r), d) in p.iter_mut().zip(&*r).zip(&inverse) {
                *p = [0, 1, 2].map(|axis| d[axis] * r[axis] + beta * p[axis]);
            }
            self.matrix.product_in_lanes(p, q);
            let square = sum(p, q, |p, q| p * q);
            let alpha = if square > 0.0 { rz / square } else { 0.0 };
            for (((v, r), p), q) in v.iter_mut().zip(r.iter_mut()).zip(&*p).zip(&*q) {
                for axis in 0..3 {
                    v[axis] += alpha * p[axis];
                    r[axis] -= alpha * q[axis];
                }
            }
        }
        for ((x, v), new) in self.x.iter_mut().zip(&mut self.v).zip(&*v) {
            *v = *new;
            *x = [0, 1, 2].map(|axis| x[axis] + DT * v[axis]);
        }
    }

    /// A = M + h²K and the elastic forces at x.
    fn assemble(&mut self) {
        self.matrix.clear(self.masses.iter().copied());
        self.forces.fill([0.0; 3]);
        for (index, tet) in self.tets.iter().enumerate() {
            let q = tet.rotation(&self.x);
            let corners = tet.corners.map(|corner| corner as usize);
            // f = −R K⁰ (Rᵀx − X)
            let d = corners.map(|i| q.tr_mul(&Vector3::from(self.x[i])) - self.rest[i]);
            for (row, &node) in tet.stiffness.iter().zip(&corners) {
                let f = q * (row[0] * d[0] + row[1] * d[1] + row[2] * d[2] + row[3] * d[3]);
                for axis in 0..3 {
                    self.forces[node][axis] -= f[axis];
                }
            }
            let (q, q_t) = (q * (DT * DT), q.transpose());
            self.matrix.add(index, |i, j| {
                let block = q * tet.stiffness[i][j] * q_t;
                core::array::from_fn(|k| block[k])
            });
        }
    }
}

impl Tet {
    fn rotation(&self, x: &[[f32; 3]]) -> Matrix3<f32> {
        let [a, b, c, d] = self.corners.map(|corner| Vector3::from(x[corner as usize]));
        polar(&(Matrix3::from_columns(&[b - a, c - a, d - a]) * self.gradients))
    }
}

/// Σ f(a, b) over all components, in four running sums.
fn sum(a: &[[f32; 3]], b: &[[f32; 3]], f: impl Fn(f32, f32) -> f32) -> f32 {
    let (a, a_rest) = a.as_flattened().as_chunks::<4>();
    let (b, b_rest) = b.as_flattened().as_chunks::<4>();
    let mut sums = [0.0_f32; 4];
    for (a, b) in a.iter().zip(b) {
        for k in 0..4 {
            sums[k] += f(a[k], b[k]);
        }
    }
    let rest: f32 = a_rest.iter().zip(b_rest).map(|(&a, &b)| f(a, b)).sum();
    sums.iter().sum::<f32>() + rest
}
