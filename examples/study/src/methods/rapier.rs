//! The `fem` feature of rapier3d: corotated cells, assembled, block-Jacobi CG of a capped count.

use rapier3d::prelude::{
    PhysicsWorld, SoftBodyBuilder, SoftBodyCellModel, SoftBodyHandle, SoftBodyMaterial,
    SoftBodySolver, Vector,
};

use crate::method::{Contender, Method};
use crate::methods::forces::Forces;
use crate::problem::Problem;

/// Its curve's name.
pub const NAME: &str = "rapier3d fem";

/// What a step of it may cost.
#[derive(Clone, Copy)]
pub struct Budget {
    /// Its own, which share the preparation of a step.
    pub substeps: u32,
    /// At most so many a substep.
    pub iterations: u32,
    /// Relative residual at which it stops before.
    pub tolerance: f32,
}

impl Budget {
    /// All of the iterations.
    pub const fn capped(substeps: u32, iterations: u32) -> Self {
        Self {
            substeps,
            iterations,
            tolerance: 1e-7,
        }
    }

    /// As many as it takes.
    pub const fn until(tolerance: f32) -> Self {
        Self {
            substeps: 1,
            iterations: 1000,
            tolerance,
        }
    }

    fn name(&self) -> String {
        match self.iterations {
            1000 => format!("{}× until {:e}", self.substeps, self.tolerance),
            iterations => format!("{}×{iterations} it.", self.substeps),
        }
    }
}

struct Rapier {
    world: PhysicsWorld,
    body: SoftBodyHandle,
}

fn vector([x, y, z]: [f32; 3]) -> Vector {
    Vector::new(x, y, z)
}

impl Rapier {
    fn new(problem: &Problem, dt: f64, budget: Budget) -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = vector(problem.gravity);
        let parameters = &mut world.integration_parameters;
        parameters.dt = dt as f32;
        parameters.num_solver_iterations = budget.substeps as usize;
        parameters.soft_bodies.fem.max_linear_iterations = budget.iterations as usize;
        parameters.soft_bodies.fem.linear_tolerance = budget.tolerance;
        let masses = Forces::new(problem).rest.view().masses.to_vec();
        let builder = SoftBodyBuilder::new(problem.nodes.iter().map(|&x| vector(x)).collect())
            .cells(problem.tets.clone())
            .masses(masses)
            .pinned_particles(problem.held.iter().copied())
            .cell_model(SoftBodyCellModel::Corotational)
            .material(SoftBodyMaterial {
                young_modulus: problem.young,
                poisson_ratio: problem.poisson,
                elastic_damping_ratio: 0.0,
                ..SoftBodyMaterial::default()
            })
            .solver(SoftBodySolver::Fem)
            .no_surface_collider()
            .can_sleep(false);
        let body = world.insert_soft_body(builder);
        for (node, &v) in problem.v.iter().enumerate() {
            world.soft_bodies[body].set_particle_velocity(node, vector(v));
        }
        Self { world, body }
    }
}

impl Method for Rapier {
    fn step(&mut self) {
        self.world.step();
    }
    fn positions(&self) -> Vec<[f64; 3]> {
        let all = self.world.soft_bodies[self.body].particle_positions();
        all.map(|x| [x.x, x.y, x.z].map(f64::from)).collect()
    }
    fn velocities(&self) -> Vec<[f64; 3]> {
        let all = self.world.soft_bodies[self.body].particle_velocities();
        all.map(|v| [v.x, v.y, v.z].map(f64::from)).collect()
    }
}

pub fn contender(budget: Budget) -> Contender {
    Contender::new(NAME, budget.name(), 1, move |problem, dt| {
        Rapier::new(problem, dt, budget)
    })
    .varying()
}
