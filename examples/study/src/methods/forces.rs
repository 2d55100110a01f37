//! Elastic forces of the corotated energy by femto's own kernels, in lanes, for methods that need no
//! matrix: they get the fastest forces that there are here.

use femto::Mesh;
use femto::element::{Factored, Layout};
use femto::lane::Native;
use femto::operator::{Fit, Operator, RotationBlock, fit_rotations, rotate};
use femto::owned::OwnedRest;

use crate::problem::Problem;

pub struct Forces {
    pub rest: OwnedRest<Factored>,
    rotations: Vec<RotationBlock>,
    rotated: Vec<<Factored as Layout>::Rotated>,
}

impl Forces {
    pub fn new(problem: &Problem) -> Self {
        let mesh = Mesh::new(&problem.nodes, &problem.tets).expect("a valid mesh");
        let rest = OwnedRest::new(&mesh, &problem.material()).expect("in range");
        let view = rest.view();
        let mut rotations = vec![RotationBlock::ZERO; view.blocks.len()];
        fit_rotations::<Native, Factored>(&view, &problem.nodes, Fit::Cold, &mut rotations);
        let rotated = vec![Factored::ZERO_ROTATED; view.blocks.len()];
        Self {
            rest,
            rotations,
            rotated,
        }
    }

    /// `out` += forces at `x`, in newtons, after `sweeps` sweeps of the rotations.
    pub fn add(&mut self, x: &[[f32; 3]], sweeps: u32, out: &mut [[f32; 3]]) {
        let rest = self.rest.view();
        fit_rotations::<Native, Factored>(&rest, x, Fit::Warm(sweeps), &mut self.rotations);
        rotate::<Native, Factored>(&rest, x, &self.rotations, 1.0, &mut self.rotated, out);
    }

    /// The highest angular frequency of the mesh at rest, by power iteration on M⁻¹K; 1/s.
    pub fn highest_frequency(&mut self, x: &[[f32; 3]]) -> f64 {
        let mut u: Vec<[f32; 3]> = (0..x.len())
            .map(|i| [((i * 37 % 101) as f32) - 50.0; 3])
            .collect();
        for (k, u) in u.iter_mut().enumerate() {
            u[k % 3] = -u[k % 3];
        }
        let mut f = u.clone();
        self.add(x, 0, &mut f);
        let rest = self.rest.view();
        let unit = rest.header.length_unit;
        let operator = Operator {
            rest,
            rotated: &self.rotated,
            inertia: &[],
            stiffness: 1.0 / unit / unit,
        };
        let mut square = 0.0;
        for _ in 0..300 {
            f.fill([0.0; 3]);
            operator.add_stiffness::<Native>(&u, &mut f);
            for (f, m) in f.iter_mut().zip(rest.masses) {
                *f = f.map(|f| f / m);
            }
            square = f
                .as_flattened()
                .iter()
                .map(|x| f64::from(*x).powi(2))
                .sum::<f64>()
                .sqrt();
            for (u, f) in u.iter_mut().zip(&f) {
                *u = f.map(|f| (f64::from(f) / square) as f32);
            }
        }
        square.sqrt()
    }
}
