//! XPBD (Macklin, Müller and Chentanez, "XPBD", MIG 2016) with small steps (Macklin et al., "Small Steps
//! in Physics Simulation", SCA 2019) on the same energy: two constraints a tetrahedron,
//!
//! ```text
//! C₁ = ‖F − R‖,  α₁ = 1/(2μV)        C₂ = tr(RᵀF) − 3,  α₂ = 1/(λV)        E = ½ C₁²/α₁ + ½ C₂²/α₂
//! ```
//!
//! solved together as a 2×2 block, one tetrahedron after the other, with R by one warm Jacobi sweep.

use femto::polar::{self, Quaternion};

use crate::method::{Contender, Method, widened};
use crate::methods::forces::Forces;
use crate::problem::Problem;

struct Tet {
    corners: [usize; 4],
    gradients: [[f32; 3]; 4],
    /// α/h², of both constraints
    compliance: [f32; 2],
    rotation: Quaternion<f32>,
    /// Sums of Δλ in this step.
    lambda: [f32; 2],
}

struct Xpbd {
    tets: Vec<Tet>,
    /// 1/m; 0 where held.
    inverse: Vec<f32>,
    x: Vec<[f32; 3]>,
    v: Vec<[f32; 3]>,
    old: Vec<[f32; 3]>,
    gravity: [f32; 3],
    dt: f32,
    iterations: u32,
}

impl Xpbd {
    fn new(problem: &Problem, dt: f64, iterations: u32) -> Self {
        let dt = dt as f32;
        let forces = Forces::new(problem);
        let rest = forces.rest.view();
        let mut inverse: Vec<f32> = rest.masses.iter().map(|m| 1.0 / m).collect();
        for &node in &problem.held {
            inverse[node as usize] = 0.0;
        }
        let tet = |(e, tet): (usize, &[u32; 4])| {
            let (block, lane) = (&rest.blocks[e / 8], e % 8);
            let g = block.gradients.map(|g| g.map(|axis| axis[lane]));
            let first = [0, 1, 2].map(|a| -(g[0][a] + g[1][a] + g[2][a]));
            Tet {
                corners: tet.map(|i| i as usize),
                gradients: [first, g[0], g[1], g[2]],
                compliance: [2.0 * block.mu_v[lane], block.lambda_v[lane]]
                    .map(|k| 1.0 / (k * dt * dt)),
                rotation: polar::identity(),
                lambda: [0.0; 2],
            }
        };
        Self {
            tets: problem.tets.iter().enumerate().map(tet).collect(),
            inverse,
            x: problem.nodes.clone(),
            v: problem.v.clone(),
            old: problem.nodes.clone(),
            gravity: problem.gravity,
            dt,
            iterations,
        }
    }
}

impl Tet {
    /// Moves the corners so that both constraints hold as far as their compliance allows.
    #[inline]
    fn project(&mut self, x: &mut [[f32; 3]], inverse: &[f32]) {
        let at = self.corners.map(|i| x[i]);
        let mut f = [[0.0_f32; 3]; 3];
        for (x, g) in at[1..].iter().zip(&self.gradients[1..]) {
            for i in 0..3 {
                for j in 0..3 {
                    f[i][j] += (x[i] - at[0][i]) * g[j];
                }
            }
        }
        self.rotation = polar::sweeps(&self.rotation, &f, 1);
        let r = polar::matrix(&self.rotation);
        let (mut square, mut trace) = (0.0, 0.0);
        let mut away = [[0.0; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                away[i][j] = f[i][j] - r[i][j];
                square += away[i][j] * away[i][j];
                trace += r[i][j] * f[i][j];
            }
        }
        let c = [square.sqrt(), trace - 3.0];
        let unit = if c[0] > 1e-9 { 1.0 / c[0] } else { 0.0 };
        let times = |m: &[[f32; 3]; 3], g: &[f32; 3], s: f32| {
            [0, 1, 2].map(|i| s * (m[i][0] * g[0] + m[i][1] * g[1] + m[i][2] * g[2]))
        };
        let first = self.gradients.map(|g| times(&away, &g, unit));
        let second = self.gradients.map(|g| times(&r, &g, 1.0));
        let dot = |a: &[[f32; 3]; 4], b: &[[f32; 3]; 4]| {
            let mut sum = 0.0;
            for (corner, &node) in self.corners.iter().enumerate() {
                let (a, b) = (a[corner], b[corner]);
                sum += inverse[node] * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
            }
            sum
        };
        let [e1, e2] = self.compliance;
        let (a, b, d) = (
            dot(&first, &first) + e1,
            dot(&first, &second),
            dot(&second, &second) + e2,
        );
        let (r1, r2) = (-c[0] - e1 * self.lambda[0], -c[1] - e2 * self.lambda[1]);
        let det = a * d - b * b;
        let (l1, l2) = ((d * r1 - b * r2) / det, (a * r2 - b * r1) / det);
        self.lambda[0] += l1;
        self.lambda[1] += l2;
        for (corner, &node) in self.corners.iter().enumerate() {
            for axis in 0..3 {
                x[node][axis] +=
                    inverse[node] * (l1 * first[corner][axis] + l2 * second[corner][axis]);
            }
        }
    }
}

impl Method for Xpbd {
    fn step(&mut self) {
        let h = self.dt;
        self.old.copy_from_slice(&self.x);
        for ((x, v), w) in self.x.iter_mut().zip(&self.v).zip(&self.inverse) {
            if *w > 0.0 {
                *x = [0, 1, 2].map(|a| x[a] + h * (v[a] + h * self.gravity[a]));
            }
        }
        for tet in &mut self.tets {
            tet.lambda = [0.0; 2];
        }
        for _ in 0..self.iterations {
            for tet in &mut self.tets {
                tet.project(&mut self.x, &self.inverse);
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
        "XPBD, small steps",
        format!("{substeps}×{iterations} it."),
        substeps,
        move |problem, dt| Xpbd::new(problem, dt, iterations),
    )
}
