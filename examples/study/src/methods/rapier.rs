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

struct Rapier {
    world: PhysicsWorld,
    body: SoftBodyHandle,
}

fn vector([x, y, z]: [f32; 3]) -> Vector {
    Vector::new(x, y, z)
}

impl Rapier {
    fn new(problem: &Problem, dt: f64, iterations: usize) -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = vector(problem.gravity);
        let parameters = &mut world.integration_parameters;
        parameters.dt = dt as f32;
        parameters.num_solver_iterations = 1;
        parameters.soft_bodies.fem.max_linear_iterations = iterations;
        parameters.soft_bodies.fem.linear_tolerance = 1e-7;
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

pub fn contender(substeps: u32, iterations: usize) -> Contender {
    Contender::new(
        NAME,
        format!("{substeps}×{iterations} it."),
        substeps,
        move |problem, dt| Rapier::new(problem, dt, iterations),
    )
    .varying()
}
