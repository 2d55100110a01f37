//! The usual pipeline: rotations from an SVD, an assembled matrix, Jacobi-preconditioned CG from v(t);
//! solved, or stopped early.

use femto_bench::baseline::{Baseline, Stop};

use crate::method::{Contender, Method, widened};
use crate::problem::Problem;

struct Pipeline {
    body: Baseline<f32>,
    stop: Stop,
}

impl Method for Pipeline {
    fn step(&mut self) {
        self.body.step(self.stop);
    }
    fn positions(&self) -> Vec<[f64; 3]> {
        widened(&self.body.x)
    }
    fn velocities(&self) -> Vec<[f64; 3]> {
        widened(&self.body.v)
    }
}

pub fn contender(substeps: u32, stop: Stop) -> Contender {
    let (family, budget) = match stop {
        Stop::After(k) => ("SVD, assembled, stopped", format!("{substeps}×{k} it.")),
        Stop::At(_) => ("SVD, assembled, converged", format!("{substeps}×")),
    };
    let build = move |problem: &Problem, dt| Pipeline {
        body: problem.baseline(dt),
        stop,
    };
    Contender::new(family, budget, substeps, build).varying()
}
