//! Corotated elements the usual way, for comparison: rotations from an SVD, element matrices
//! R K⁰ Rᵀ, assembled into block-CSR, and a Jacobi-preconditioned CG from v(t). As good as plain
//! code gets: the pattern and the entries that a tetrahedron adds to are computed beforehand. In f32,
//! or in f64 as a reference.

use nalgebra::{Matrix3, Vector3, convert};

use crate::csr::{BlockCsr, Scalar};

/// One tetrahedron at rest.
struct Tet<T: Scalar> {
    corners: [u32; 4],
    /// g₁, g₂, g₃ as rows: F = [x_j − x_0] · gradients.
    gradients: Matrix3<T>,
    /// K⁰, `[row corner][column corner]`.
    stiffness: [[Matrix3<T>; 4]; 4],
}

/// What does not change: mesh, material, world and time step.
pub struct Setup<'a> {
    pub nodes: &'a [[f32; 3]],
    pub tets: &'a [[u32; 4]],
    /// λ and μ, Pa.
    pub lame: [f64; 2],
    /// kg/m³
    pub density: f64,
    /// m/s²
    pub gravity: [f64; 3],
    /// Nodes that do not move.
    pub held: &'a [u32],
    /// s
    pub dt: f64,
}

/// When the conjugate gradient stops.
#[derive(Clone, Copy)]
pub enum Stop {
    /// After so many iterations.
    After(u32),
    /// At r·r ≤ tolerance · b·b, or after 10,000 iterations.
    At(f64),
}

/// A body and its solver.
pub struct Baseline<T: Scalar = f32> {
    rest: Vec<Vector3<T>>,
    pub masses: Vec<T>,
    tets: Vec<Tet<T>>,
    held: Vec<u32>,
    gravity: [T; 3],
    pub dt: T,
    pub x: Vec<[T; 3]>,
    pub v: Vec<[T; 3]>,
    pub matrix: BlockCsr<T>,
    forces: Vec<[T; 3]>,
    inverse: Vec<[T; 3]>,
    vectors: [Vec<[T; 3]>; 4],
}

/// The rotation nearest to F.
pub fn polar<T: Scalar>(f: &Matrix3<T>) -> Matrix3<T> {
    let svd = f.svd(true, true);
    let (u, mut v_t) = (svd.u.unwrap_or_default(), svd.v_t.unwrap_or_default());
    if u.determinant() * v_t.determinant() < T::zero() {
        v_t.row_mut(2).neg_mut(); // of the smallest singular value
    }
    u * v_t
}

impl<T: Scalar> Baseline<T> {
    /// At rest, in f64 rounded once.
    pub fn new(setup: &Setup<'_>) -> Self {
        let rest: Vec<Vector3<f64>> = setup
            .nodes
            .iter()
            .map(|x| x.map(f64::from).into())
            .collect();
        let mut masses = vec![0.0; rest.len()];
        let tets = setup.tets.iter().map(|&corners| {
            let [a, b, c, d] = corners.map(|i| rest[i as usize]);
            let edges = Matrix3::from_columns(&[b - a, c - a, d - a]);
            let volume = edges.determinant() / 6.0;
            for corner in corners {
                masses[corner as usize] += setup.density * volume / 4.0;
            }
            let gradients = edges.try_inverse().expect("a tetrahedron with a volume");
            let [lambda, mu] = setup.lame.map(|c| c * volume);
            let g = [0, 1, 2].map(|row| gradients.row(row).transpose());
            let g = [-(g[0] + g[1] + g[2]), g[0], g[1], g[2]];
            let stiffness = g.map(|gi| {
                g.map(|gj| {
                    let isotropic = Matrix3::from_diagonal_element(mu * gi.dot(&gj));
                    convert(gi * gj.transpose() * lambda + isotropic + gj * gi.transpose() * mu)
                })
            });
            Tet {
                corners,
                gradients: convert(gradients),
                stiffness,
            }
        });
        let tets = tets.collect();
        let zeros = || vec![[T::zero(); 3]; rest.len()];
        Self {
            tets,
            masses: masses.into_iter().map(convert).collect(),
            held: setup.held.to_vec(),
            gravity: setup.gravity.map(convert),
            dt: convert(setup.dt),
            x: rest
                .iter()
                .map(|x| [0, 1, 2].map(|a| convert(x[a])))
                .collect(),
            v: zeros(),
            matrix: BlockCsr::new(rest.len(), setup.tets),
            forces: zeros(),
            inverse: zeros(),
            vectors: [zeros(), zeros(), zeros(), zeros()],
            rest: rest.into_iter().map(convert).collect(),
        }
    }

    /// Sets positions and velocities.
    pub fn place(&mut self, x: &[[f32; 3]], v: &[[f32; 3]]) {
        let all = |out: &mut [[T; 3]], from: &[[f32; 3]]| {
            for (out, from) in out.iter_mut().zip(from) {
                *out = from.map(|c| convert(f64::from(c)));
            }
        };
        all(&mut self.x, x);
        all(&mut self.v, v);
        for &node in &self.held {
            self.v[node as usize] = [T::zero(); 3];
        }
    }

    /// Writes the rotations of all tetrahedra.
    pub fn rotations(&self, out: &mut [Matrix3<T>]) {
        for (tet, out) in self.tets.iter().zip(out) {
            *out = tet.rotation(&self.x);
        }
    }

    /// One step of backward Euler. Returns the iterations that it took.
    pub fn step(&mut self, stop: Stop) -> u32 {
        self.assemble();
        let [v, r, p, q] = &mut self.vectors;
        // A v⁺ = M v + h f, from v(t); held nodes by projecting the residual.
        v.copy_from_slice(&self.v);
        T::product(&self.matrix, v, q);
        let rows = r
            .iter_mut()
            .zip(&self.v)
            .zip(&self.forces)
            .zip(&self.masses);
        for (((r, v), f), m) in rows {
            *r = [0, 1, 2].map(|a| *m * v[a] + self.dt * f[a]);
        }
        hold(&self.held, r);
        let (count, limit) = match stop {
            Stop::After(count) => (count, None),
            Stop::At(tolerance) => {
                let tolerance: T = convert(tolerance);
                (10_000, Some(tolerance * sum(r, r, |a, b| a * b)))
            }
        };
        for (r, q) in r.iter_mut().zip(&*q) {
            *r = [0, 1, 2].map(|a| r[a] - q[a]);
        }
        hold(&self.held, r);
        for (out, d) in self.inverse.iter_mut().zip(self.matrix.diagonal()) {
            *out = d.map(|d| T::one() / d);
        }
        p.fill([T::zero(); 3]);
        let mut previous = T::zero();
        let mut made = 0;
        while made < count && !limit.is_some_and(|limit| sum(r, r, |a, b| a * b) <= limit) {
            let rz = sum(r, &self.inverse, |r, d| r * r * d);
            let beta = if previous > T::zero() {
                rz / previous
            } else {
                T::zero()
            };
            previous = rz;
            for ((p, r), d) in p.iter_mut().zip(&*r).zip(&self.inverse) {
                *p = [0, 1, 2].map(|a| d[a] * r[a] + beta * p[a]);
            }
            T::product(&self.matrix, p, q);
            hold(&self.held, q);
            let square = sum(p, q, |p, q| p * q);
            let alpha = if square > T::zero() {
                rz / square
            } else {
                T::zero()
            };
            for (((v, r), p), q) in v.iter_mut().zip(r.iter_mut()).zip(&*p).zip(&*q) {
                for a in 0..3 {
                    v[a] += alpha * p[a];
                    r[a] -= alpha * q[a];
                }
            }
            made += 1;
        }
        for ((x, v), new) in self.x.iter_mut().zip(&mut self.v).zip(&*v) {
            *v = *new;
            *x = [0, 1, 2].map(|a| x[a] + self.dt * v[a]);
        }
        made
    }

    /// Moves on with velocities that were found otherwise.
    pub fn advance(&mut self, velocity: impl Fn(usize) -> [T; 3]) {
        for (i, (x, v)) in self.x.iter_mut().zip(&mut self.v).enumerate() {
            *v = velocity(i);
            *x = [0, 1, 2].map(|a| x[a] + self.dt * v[a]);
        }
    }

    /// M v + h f of the last [`Self::assemble`].
    pub fn right_hand_side(&self, node: usize) -> [T; 3] {
        let (m, v, f) = (self.masses[node], self.v[node], self.forces[node]);
        [0, 1, 2].map(|a| m * v[a] + self.dt * f[a])
    }

    /// A = M + h²K, and the forces at x.
    pub fn assemble(&mut self) {
        self.matrix.clear(self.masses.iter().copied());
        for (f, m) in self.forces.iter_mut().zip(&self.masses) {
            *f = self.gravity.map(|g| *m * g);
        }
        for (index, tet) in self.tets.iter().enumerate() {
            let q = tet.rotation(&self.x);
            let corners = tet.corners.map(|corner| corner as usize);
            // f = −R K⁰ (Rᵀx − X)
            let d = corners.map(|i| q.tr_mul(&Vector3::from(self.x[i])) - self.rest[i]);
            for (row, &node) in tet.stiffness.iter().zip(&corners) {
                let f = q * (row[0] * d[0] + row[1] * d[1] + row[2] * d[2] + row[3] * d[3]);
                for a in 0..3 {
                    self.forces[node][a] -= f[a];
                }
            }
            let (q, q_t) = (q * (self.dt * self.dt), q.transpose());
            self.matrix.add(index, |i, j| {
                let block = q * tet.stiffness[i][j] * q_t;
                core::array::from_fn(|k| block[k])
            });
        }
    }
}

impl<T: Scalar> Tet<T> {
    fn rotation(&self, x: &[[T; 3]]) -> Matrix3<T> {
        let [a, b, c, d] = self.corners.map(|corner| Vector3::from(x[corner as usize]));
        polar(&(Matrix3::from_columns(&[b - a, c - a, d - a]) * self.gradients))
    }
}

fn hold<T: Scalar>(held: &[u32], u: &mut [[T; 3]]) {
    for &node in held {
        u[node as usize] = [T::zero(); 3];
    }
}

/// Σ f(a, b) over all components, in four running sums.
fn sum<T: Scalar>(a: &[[T; 3]], b: &[[T; 3]], f: impl Fn(T, T) -> T) -> T {
    let (a, a_rest) = a.as_flattened().as_chunks::<4>();
    let (b, b_rest) = b.as_flattened().as_chunks::<4>();
    let mut sums = [T::zero(); 4];
    for (a, b) in a.iter().zip(b) {
        for k in 0..4 {
            sums[k] += f(a[k], b[k]);
        }
    }
    let rest = a_rest
        .iter()
        .zip(b_rest)
        .fold(T::zero(), |s, (&a, &b)| s + f(a, b));
    sums[0] + sums[1] + (sums[2] + sums[3]) + rest
}
