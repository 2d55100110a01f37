//! The oracle on frictionless ground y ≥ 0: who touches, and what the solve may do about it, as the module
//! `constraint` of the crate says, in f64 and with a direct solve. Since the normal is an axis, the filter is a
//! choice of coordinates.

use nalgebra::{DMatrix, DVector};

use super::reference::{Reference, solve_held};

/// An oracle on the ground, with the velocities that W holds besides v(t).
pub struct Grounded {
    pub body: Reference,
    /// A node that starts a step deeper than this is pushed out without the speed of it, metres.
    margin: f64,
    /// v(t−h), …
    history: Vec<DVector<f64>>,
}

#[allow(non_snake_case)]
impl Grounded {
    /// W holds `vectors` ≥ 1 velocities.
    pub fn new(body: Reference, vectors: usize, margin: f64) -> Self {
        let history = vec![DVector::zeros(body.x.len()); vectors - 1];
        Self {
            body,
            margin,
            history,
        }
    }

    pub fn step(&mut self) {
        let body = &self.body;
        let (h, mass) = (body.h, body.mass());
        let (A, b) = body.system(&body.rotations(&body.x));
        let touches: Vec<bool> = (0..body.x.len())
            .map(|dof| dof % 3 == 1 && self.touches(dof, &A, &b, &mass))
            .collect();
        let free = |u: &DVector<f64>| {
            DVector::from_fn(u.len(), |dof, _| if touches[dof] { 0.0 } else { u[dof] })
        };

        // The gap closes by that part τ of itself which the Galerkin solution over W leaves to it.
        let mut W: Vec<DVector<f64>> = Vec::new();
        let flies = !touches.contains(&true);
        let axes = (0..3)
            .map(|axis| DVector::from_fn(b.len(), |dof, _| f64::from(u8::from(dof % 3 == axis))));
        let past = [&body.v].into_iter().chain(&self.history).map(&free);
        for mut w in axes.filter(|_| flies).chain(past) {
            let before = w.norm_squared();
            for w_j in W.iter().chain(&W) {
                w -= w_j * (&A * w_j).dot(&w);
            }
            if w.norm_squared() > 1e-12 * before {
                let size = (&A * &w).dot(&w).sqrt();
                W.push(w / size);
            }
        }
        let mut r = b.clone();
        for w in &W {
            r -= &A * w * w.dot(&b);
        }
        let gap = DVector::from_fn(b.len(), |dof, _| {
            if touches[dof] {
                -body.x[dof].max(0.0) / h
            } else {
                0.0
            }
        });
        let mut g = gap.clone();
        for w in &W {
            g -= w * (&A * w).dot(&gap);
        }
        let square = (&A * &g).dot(&g);
        let tau = if square > 0.0 {
            (g.dot(&r) / square).clamp(0.0, 1.0)
        } else {
            0.0
        };

        // What pulls is let go, then what enters is taken in, and again.
        let mut targets: Vec<Option<f64>> = (0..b.len())
            .map(|dof| touches[dof].then_some(gap[dof] * tau))
            .collect();
        let mut v = solve_pushed(&A, &b, &mut targets);
        for dof in (1..v.len()).step_by(3) {
            let least = -body.x[dof] / h;
            if targets[dof].is_none() && v[dof] < least {
                targets[dof] = Some(least);
            }
        }
        v = solve_pushed(&A, &b, &mut targets);
        self.history.rotate_right(1);
        if let Some(latest) = self.history.first_mut() {
            *latest = self.body.v.clone();
        }
        let old = self.body.x.clone();
        let body = &mut self.body;
        body.x += &v * h;
        for dof in (1..v.len()).step_by(3) {
            let enters = body.x[dof] < 0.0;
            let leaves = old[dof] < -self.margin && v[dof] > 0.0;
            if leaves || (enters && v[dof] < 0.0) {
                v[dof] = 0.0;
            }
            if enters {
                body.x[dof] = 0.0;
            }
        }
        body.v = v;
    }

    /// Whether the node whose height is coordinate `dof` is pressed on the ground: its neighbours moving along
    /// with it, it would be below at the end of the step.
    fn touches(&self, dof: usize, A: &DMatrix<f64>, b: &DVector<f64>, mass: &DVector<f64>) -> bool {
        let (body, first) = (&self.body, dof - 1);
        let a = (0..3).map(|k| A[(first + k, first + k)]).sum::<f64>() / 3.0;
        let w = body.v[dof] + (b[dof] - mass[dof] * body.v[dof]) / a;
        body.x[dof] + body.h * w < 0.0
    }
}

/// A v = b with the targets given, but those that would pull: their impulse is A v − b.
#[allow(non_snake_case)]
fn solve_pushed(A: &DMatrix<f64>, b: &DVector<f64>, targets: &mut [Option<f64>]) -> DVector<f64> {
    loop {
        let v = solve_held(A, b, targets);
        let impulse = A * &v - b;
        let size = b.amax() * 1e-9;
        let pulls: Vec<usize> = (0..b.len())
            .filter(|&dof| targets[dof].is_some() && impulse[dof] < -size)
            .collect();
        if pulls.is_empty() {
            return v;
        }
        for dof in pulls {
            targets[dof] = None;
        }
    }
}
