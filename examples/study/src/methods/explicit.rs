//! Explicit integration at a stable step; in f64 at a small one, it is the truth.

use femto::polar;
use nalgebra::{Matrix3, Vector3};

use crate::measure::Track;
use crate::method::{Contender, Method, widened};
use crate::methods::forces::Forces;
use crate::problem::{H, Problem};

/// Symplectic Euler: forces at x, then x with the new velocity.
struct Explicit {
    forces: Forces,
    f: Vec<[f32; 3]>,
    x: Vec<[f32; 3]>,
    v: Vec<[f32; 3]>,
    gravity: [f32; 3],
    held: Vec<u32>,
    dt: f32,
}

impl Method for Explicit {
    fn step(&mut self) {
        self.f.fill([0.0; 3]);
        self.forces.add(&self.x, 1, &mut self.f);
        let masses = self.forces.rest.view().masses;
        for ((v, f), m) in self.v.iter_mut().zip(&self.f).zip(masses) {
            *v = [0, 1, 2].map(|a| v[a] + self.dt * (f[a] / m + self.gravity[a]));
        }
        for &node in &self.held {
            self.v[node as usize] = [0.0; 3];
        }
        for (x, v) in self.x.iter_mut().zip(&self.v) {
            *x = [0, 1, 2].map(|a| x[a] + self.dt * v[a]);
        }
    }
    fn positions(&self) -> Vec<[f64; 3]> {
        widened(&self.x)
    }
    fn velocities(&self) -> Vec<[f64; 3]> {
        widened(&self.v)
    }
}

/// Substeps of the problem's step that are stable, with a tenth to spare.
pub fn stable_substeps(problem: &Problem) -> u32 {
    let omega = Forces::new(problem).highest_frequency(&problem.nodes);
    (1.1 * H * omega / 2.0).ceil() as u32
}

pub fn contender(substeps: u32) -> Contender {
    Contender::new(
        "explicit, stable step",
        format!("{substeps}×"),
        substeps,
        |problem, dt| Explicit {
            forces: Forces::new(problem),
            f: vec![[0.0; 3]; problem.nodes.len()],
            x: problem.nodes.clone(),
            v: problem.v.clone(),
            gravity: problem.gravity,
            held: problem.held.clone(),
            dt: dt as f32,
        },
    )
}

/// One tetrahedron in f64.
struct Tet {
    corners: [usize; 4],
    gradients: [Vector3<f64>; 4],
    volume: f64,
    rotation: [f64; 4],
}

/// Velocity Verlet in f64, with rotations to rounding, at half the stable step and h/16 at most: of
/// second order, and it neither damps nor truncates.
pub fn truth(problem: &Problem) -> Track {
    let substeps = (2 * stable_substeps(problem)).max(16);
    let dt = H / f64::from(substeps);
    let (lambda, mu) = problem.material().lame();
    let mut x: Vec<Vector3<f64>> = problem
        .nodes
        .iter()
        .map(|x| x.map(f64::from).into())
        .collect();
    let mut v: Vec<Vector3<f64>> = problem.v.iter().map(|v| v.map(f64::from).into()).collect();
    let mut masses = vec![0.0; x.len()];
    let mut tets: Vec<Tet> = Vec::new();
    for tet in &problem.tets {
        let corners = tet.map(|i| i as usize);
        let [a, b, c, d] = corners.map(|i| x[i]);
        let edges = Matrix3::from_columns(&[b - a, c - a, d - a]);
        let inverse = edges.try_inverse().expect("a tetrahedron with a volume");
        let g = [0, 1, 2].map(|row| inverse.row(row).transpose());
        let volume = edges.determinant() / 6.0;
        for corner in corners {
            masses[corner] += f64::from(problem.density) * volume / 4.0;
        }
        tets.push(Tet {
            corners,
            gradients: [-(g[0] + g[1] + g[2]), g[0], g[1], g[2]],
            volume,
            rotation: polar::identity(),
        });
    }
    let gravity = Vector3::from(problem.gravity.map(f64::from));
    let mut acceleration = vec![gravity; x.len()];
    let accelerate = |x: &[Vector3<f64>], tets: &mut [Tet], out: &mut [Vector3<f64>]| {
        out.fill(Vector3::zeros());
        for tet in tets {
            let mut f = Matrix3::zeros();
            for (corner, g) in tet.corners.iter().zip(&tet.gradients) {
                f += (x[*corner] - x[tet.corners[0]]) * g.transpose();
            }
            let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| f[(i, j)]));
            tet.rotation = polar::sweeps(&tet.rotation, &rows, 3);
            let q = polar::matrix(&tet.rotation);
            let q = Matrix3::from_fn(|i, j| q[i][j]);
            let strain = (q.transpose() * f).symmetric_part() - Matrix3::identity();
            let stress =
                Matrix3::from_diagonal_element(lambda * strain.trace()) + strain * (2.0 * mu);
            let p = q * stress * tet.volume;
            for (corner, g) in tet.corners.iter().zip(&tet.gradients) {
                out[*corner] -= p * g;
            }
        }
        for (out, m) in out.iter_mut().zip(&masses) {
            *out = *out / *m + gravity;
        }
        for &node in &problem.held {
            out[node as usize] = Vector3::zeros();
        }
    };
    accelerate(&x, &mut tets, &mut acceleration);
    let mut track = Vec::new();
    for _ in 0..problem.steps {
        for _ in 0..substeps {
            for ((x, v), a) in x.iter_mut().zip(&mut v).zip(&acceleration) {
                *v += a * (0.5 * dt);
                *x += *v * dt;
            }
            accelerate(&x, &mut tets, &mut acceleration);
            for (v, a) in v.iter_mut().zip(&acceleration) {
                *v += a * (0.5 * dt);
            }
        }
        track.push(x.iter().map(|x| (*x).into()).collect());
    }
    track
}
