//! The oracle: corotated linear tetrahedra in f64, dense, with rotations from an SVD and a
//! direct solve. It shares no line with the crate and as few ideas as the equations allow.
//!
//! ```text
//! F = Σ x_i g_iᵀ        g_i = ∇N_i, from the inverse of the 4×4 matrix of columns (1, X_i)
//! Q = argmax tr(QᵀF)    the nearest rotation, det +1
//! ε = sym(QᵀF) − I      σ = λ tr(ε) I + 2μ ε
//! E = V (μ ‖ε‖² + ½λ tr(ε)²)            f_i = −∂E/∂x_i = −V Q σ g_i
//! K_ij = −∂f_i/∂x_j at frozen Q, positive semidefinite
//! D = αM + βK
//! M (v⁺ − v) = h (f − θh K v_θ) − h D v_θ,   v_θ = θv⁺ + (1−θ)v,   x⁺ = x + h v_θ
//! ```
//!
//! Vectors over the body are stacked node by node: x_0 y_0 z_0 x_1 …

use nalgebra::{DMatrix, DVector, Matrix3, Matrix4, Vector3};

/// One body and its settings; every field may be changed between steps.
#[derive(Clone)]
pub struct Reference {
    /// X
    pub rest: DVector<f64>,
    pub tets: Vec<[usize; 4]>,
    pub volumes: Vec<f64>,
    /// g_i, one array a tet
    pub gradients: Vec<[Vector3<f64>; 4]>,
    /// lumped: a quarter of every tet around the node
    pub masses: Vec<f64>,
    pub lambda: f64,
    pub mu: f64,
    /// Rayleigh damping D = αM + βK
    pub alpha: f64,
    pub beta: f64,
    pub gravity: [f64; 3],
    /// constant force on each node, besides its weight
    pub forces: Vec<[f64; 3]>,
    /// prescribed velocity, where there is one
    pub pins: Vec<Option<[f64; 3]>>,
    /// 1 backward Euler, ½ trapezoidal
    pub theta: f64,
    pub h: f64,
    pub x: DVector<f64>,
    pub v: DVector<f64>,
    /// the rotations that the last step froze; the identity before the first
    pub linearisation: Vec<Matrix3<f64>>,
}

#[allow(non_snake_case)]
impl Reference {
    /// At rest, free, undamped, weightless; backward Euler with h = 0.01.
    pub fn new(
        nodes: &[[f32; 3]],
        tets: &[[u32; 4]],
        young: f64,
        poisson: f64,
        density: f64,
    ) -> Self {
        let rest = stack(nodes);
        let tets: Vec<[usize; 4]> = tets.iter().map(|tet| tet.map(|i| i as usize)).collect();
        let mut masses = vec![0.0; nodes.len()];
        let (mut volumes, mut gradients) = (Vec::new(), Vec::new());
        for tet in &tets {
            // N(X) = T⁻¹ (1, X), so g_i is row i of T⁻¹ without its first entry; X from X_0,
            // which changes no gradient and keeps digits far from the origin.
            let X = tet.map(|i| node(&rest, i) - node(&rest, tet[0]));
            let T = Matrix4::from_fn(|row, i| if row == 0 { 1.0 } else { X[i][row - 1] });
            let N = T.try_inverse().expect("a tet without volume");
            volumes.push(T.determinant() / 6.0);
            gradients.push([0, 1, 2, 3].map(|i| N.fixed_view::<1, 3>(i, 1).transpose()));
            for &i in tet {
                masses[i] += density * volumes[volumes.len() - 1] / 4.0;
            }
        }
        Self {
            volumes,
            gradients,
            masses,
            lambda: young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
            mu: young / (2.0 * (1.0 + poisson)),
            alpha: 0.0,
            beta: 0.0,
            gravity: [0.0; 3],
            forces: vec![[0.0; 3]; nodes.len()],
            pins: vec![None; nodes.len()],
            theta: 1.0,
            h: 0.01,
            x: rest.clone(),
            v: DVector::zeros(rest.len()),
            linearisation: vec![Matrix3::identity(); tets.len()],
            rest,
            tets,
        }
    }

    /// F = Σ x_i g_iᵀ of tet e.
    pub fn deformation(&self, x: &DVector<f64>, e: usize) -> Matrix3<f64> {
        let terms = self.tets[e].iter().zip(&self.gradients[e]);
        terms.map(|(&i, g)| node(x, i) * g.transpose()).sum()
    }

    pub fn rotations(&self, x: &DVector<f64>) -> Vec<Matrix3<f64>> {
        (0..self.tets.len())
            .map(|e| nearest_rotation(&self.deformation(x, e)))
            .collect()
    }

    /// E with the nearest rotations.
    pub fn elastic_energy(&self, x: &DVector<f64>) -> f64 {
        self.elastic_energy_frozen(x, &self.rotations(x))
    }

    /// E with given rotations: quadratic in x.
    pub fn elastic_energy_frozen(&self, x: &DVector<f64>, Q: &[Matrix3<f64>]) -> f64 {
        let energy = |e: usize| {
            let strain = strain(&Q[e], &self.deformation(x, e));
            let trace = strain.trace();
            // V (μ ‖ε‖² + ½λ tr(ε)²)
            self.volumes[e] * (self.mu * strain.norm_squared() + 0.5 * self.lambda * trace * trace)
        };
        (0..self.tets.len()).map(energy).sum()
    }

    /// f_i = −V Q σ g_i
    pub fn elastic_forces(&self, x: &DVector<f64>, Q: &[Matrix3<f64>]) -> DVector<f64> {
        let mut f = DVector::zeros(x.len());
        for (e, tet) in self.tets.iter().enumerate() {
            let strain = strain(&Q[e], &self.deformation(x, e));
            // σ = λ tr(ε) I + 2μ ε
            let stress =
                Matrix3::identity() * (self.lambda * strain.trace()) + strain * (2.0 * self.mu);
            for (&i, g) in tet.iter().zip(&self.gradients[e]) {
                let mut f_i = f.fixed_rows_mut::<3>(3 * i);
                f_i -= Q[e] * stress * g * self.volumes[e];
            }
        }
        f
    }

    /// K_ij = V Q [λ g_i g_jᵀ + μ (g_i·g_j) I + μ g_j g_iᵀ] Qᵀ
    pub fn stiffness(&self, Q: &[Matrix3<f64>]) -> DMatrix<f64> {
        let mut K = DMatrix::zeros(self.rest.len(), self.rest.len());
        for (e, tet) in self.tets.iter().enumerate() {
            for (&i, g_i) in tet.iter().zip(&self.gradients[e]) {
                for (&j, g_j) in tet.iter().zip(&self.gradients[e]) {
                    let block = g_i * g_j.transpose() * self.lambda
                        + Matrix3::identity() * (self.mu * g_i.dot(g_j))
                        + g_j * g_i.transpose() * self.mu;
                    let mut K_ij = K.fixed_view_mut::<3, 3>(3 * i, 3 * j);
                    K_ij += Q[e] * block * Q[e].transpose() * self.volumes[e];
                }
            }
        }
        K
    }

    /// The diagonal of M.
    pub fn mass(&self) -> DVector<f64> {
        DVector::from_fn(self.rest.len(), |dof, _| self.masses[dof / 3])
    }

    /// Weight and given forces.
    pub fn external_forces(&self) -> DVector<f64> {
        DVector::from_fn(self.rest.len(), |dof, _| {
            let (i, axis) = (dof / 3, dof % 3);
            self.masses[i] * self.gravity[axis] + self.forces[i][axis]
        })
    }

    /// v(t), where pins already move as prescribed.
    pub fn pinned_velocity(&self) -> DVector<f64> {
        let mut v = self.v.clone();
        for (i, pin) in self.pins.iter().enumerate() {
            if let Some(velocity) = pin {
                v.fixed_rows_mut::<3>(3 * i).copy_from_slice(velocity);
            }
        }
        v
    }

    /// A v⁺ = b at x(t), pins not yet eliminated.
    pub fn system(&self, Q: &[Matrix3<f64>]) -> (DMatrix<f64>, DVector<f64>) {
        let (theta, h, v) = (self.theta, self.h, self.pinned_velocity());
        let K = self.stiffness(Q);
        let M = DMatrix::from_diagonal(&self.mass());
        let D = &M * self.alpha + &K * self.beta;
        let f = self.elastic_forces(&self.x, Q) + self.external_forces();
        // what multiplies v⁺ in the step, and all the rest; so b − A v = h f − θh² K v − h D v
        let A = &M + &K * (theta * theta * h * h) + &D * (theta * h);
        let b = &M * &v + f * h
            - &K * &v * (theta * (1.0 - theta) * h * h)
            - &D * &v * ((1.0 - theta) * h);
        (A, b)
    }

    /// v⁺: prescribed where pinned.
    pub fn solve(&self, A: &DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
        let held: Vec<Option<f64>> = (0..b.len())
            .map(|dof| self.pins[dof / 3].map(|velocity| velocity[dof % 3]))
            .collect();
        solve_held(A, b, &held)
    }

    /// One step: rotations fitted to x(t) and frozen, one linear solve.
    pub fn step(&mut self) {
        self.v = self.pinned_velocity();
        self.linearisation = self.rotations(&self.x);
        let (A, b) = self.system(&self.linearisation);
        let v = self.solve(&A, &b);
        // x⁺ = x + h (θ v⁺ + (1−θ) v)
        self.x += (&v * self.theta + &self.v * (1.0 - self.theta)) * self.h;
        self.v = v;
    }

    /// ½ vᵀMv
    pub fn kinetic(&self) -> f64 {
        0.5 * self.v.dot(&self.mass().component_mul(&self.v))
    }

    /// −Σ m g·x
    pub fn potential(&self) -> f64 {
        let g = Vector3::from(self.gravity);
        let masses = self.masses.iter().enumerate();
        -masses
            .map(|(i, m)| m * g.dot(&node(&self.x, i)))
            .sum::<f64>()
    }

    /// Σ m v
    pub fn linear_momentum(&self) -> Vector3<f64> {
        let masses = self.masses.iter().enumerate();
        masses.map(|(i, &m)| node(&self.v, i) * m).sum()
    }

    /// Σ m x × v, about the origin
    pub fn angular_momentum(&self) -> Vector3<f64> {
        let masses = self.masses.iter().enumerate();
        masses
            .map(|(i, &m)| node(&self.x, i).cross(&node(&self.v, i)) * m)
            .sum()
    }

    /// The smallest det F.
    pub fn min_det(&self) -> f64 {
        (0..self.tets.len())
            .map(|e| self.deformation(&self.x, e).determinant())
            .fold(f64::INFINITY, f64::min)
    }

    /// Of the rest shape.
    pub fn bbox_diagonal(&self) -> f64 {
        let side = |axis: usize| {
            let along = self.rest.iter().skip(axis).step_by(3);
            let high = along.clone().fold(f64::NEG_INFINITY, |a, &b| a.max(b));
            high - along.fold(f64::INFINITY, |a, &b| a.min(b))
        };
        Vector3::from_fn(|axis, _| side(axis)).norm()
    }
}

/// A v = b where v is not held: A_ff v_f = b_f − A_fp v_p, by Cholesky.
#[allow(non_snake_case)]
pub fn solve_held(A: &DMatrix<f64>, b: &DVector<f64>, held: &[Option<f64>]) -> DVector<f64> {
    let free: Vec<usize> = (0..b.len()).filter(|&dof| held[dof].is_none()).collect();
    let mut v = DVector::from_fn(b.len(), |dof, _| held[dof].unwrap_or(0.0));
    if free.is_empty() {
        return v;
    }
    let right = (b - A * &v).select_rows(&free);
    let A_ff = A.select_rows(&free).select_columns(&free);
    let v_f = A_ff
        .cholesky()
        .expect("A is positive definite")
        .solve(&right);
    for (&dof, value) in free.iter().zip(&v_f) {
        v[dof] = *value;
    }
    v
}

/// The rotation Q that maximises tr(QᵀF): U Vᵀ, with the direction of the smallest singular
/// value flipped where that is a reflection.
///
/// nalgebra's 3×3 SVD reads V off FᵀF, so QᵀF is symmetric up to about ε s₁²/s₂ only; its
/// general SVD is no way out, it was measured 0.1 off on flat F.
#[allow(non_snake_case)]
pub fn nearest_rotation(F: &Matrix3<f64>) -> Matrix3<f64> {
    // Scaled, so that FᵀF cannot underflow; where F = 0 every rotation is as near as any.
    let size = F.amax();
    if size == 0.0 {
        return Matrix3::identity();
    }
    let svd = (F / size).svd(true, true);
    let (mut U, V_t) = (svd.u.unwrap(), svd.v_t.unwrap());
    if (U * V_t).determinant() < 0.0 {
        U.column_mut(svd.singular_values.imin()).neg_mut();
    }
    U * V_t
}

/// ε = sym(QᵀF) − I
#[allow(non_snake_case)]
fn strain(Q: &Matrix3<f64>, F: &Matrix3<f64>) -> Matrix3<f64> {
    (Q.transpose() * F).symmetric_part() - Matrix3::identity()
}

/// The crate's arrays of nodes as one f64 vector.
pub fn stack(nodes: &[[f32; 3]]) -> DVector<f64> {
    let flat = nodes.as_flattened();
    DVector::from_iterator(flat.len(), flat.iter().map(|&x| f64::from(x)))
}

/// Node i of a stacked vector.
pub fn node(x: &DVector<f64>, i: usize) -> Vector3<f64> {
    x.fixed_rows::<3>(3 * i).into_owned()
}
