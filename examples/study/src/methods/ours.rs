//! femto itself.

use femto::element::Factored;
use femto::{Budget, OwnedBody, Pin, Preconditioner, Scene, Settings, Start, StepReport};

use crate::method::{Contender, Method, widened};
use crate::problem::Problem;

/// A start and a preconditioner, with the names that scene files use.
#[derive(Clone, Copy)]
pub struct Solver {
    pub name: &'static str,
    pub start: Start,
    pub preconditioner: Preconditioner,
    /// 1 backward Euler, ½ trapezoidal.
    pub theta: f32,
}

impl Solver {
    /// The paper's solver with another start and preconditioner.
    pub const fn new(start: Start, preconditioner: Preconditioner) -> Self {
        solver("", start, preconditioner)
    }

    const fn trapezoidal(self, name: &'static str) -> Self {
        Self {
            name,
            theta: 0.5,
            ..self
        }
    }
}

const fn solver(name: &'static str, start: Start, preconditioner: Preconditioner) -> Solver {
    Solver {
        name,
        start,
        preconditioner,
        theta: 1.0,
    }
}

/// The paper's choice.
pub const PAPER: Solver = solver(
    "paper: velocity, jacobi",
    Start::Velocity,
    Preconditioner::Jacobi,
);
const GALERKIN_1: Solver = solver(
    "galerkin-1, jacobi",
    Start::Galerkin(1),
    Preconditioner::Jacobi,
);
const GALERKIN_2: Solver = solver(
    "galerkin-2, jacobi",
    Start::Galerkin(2),
    Preconditioner::Jacobi,
);
const RIGID_1: Solver = solver("rigid-1, jacobi", Start::Rigid(1), Preconditioner::Jacobi);
const RIGID_2: Solver = solver("rigid-2, jacobi", Start::Rigid(2), Preconditioner::Jacobi);
const BLOCK: Solver = solver(
    "galerkin-2, block-jacobi",
    Start::Galerkin(2),
    Preconditioner::BlockJacobi,
);

/// Every solver whose error is held against its time: more are more entries.
pub const SOLVERS: [Solver; 8] = [
    PAPER,
    GALERKIN_1,
    GALERKIN_2,
    RIGID_1,
    RIGID_2,
    BLOCK,
    GALERKIN_2.trapezoidal("galerkin-2, jacobi, θ = ½"),
    RIGID_2.trapezoidal("rigid-2, jacobi, θ = ½"),
];

/// A problem's body in the library.
pub struct Ours {
    pub body: OwnedBody<Factored>,
    pins: Vec<Pin>,
    gravity: femto::glam::Vec3,
    settings: Settings,
}

impl Ours {
    pub fn new(problem: &Problem, dt: f64, solver: Solver, budget: Budget) -> Self {
        let settings = Settings::new(dt as f32)
            .and_then(|settings| settings.with_theta(solver.theta))
            .expect("a positive time step")
            .with_start(solver.start)
            .with_preconditioner(solver.preconditioner)
            .with_budget(budget);
        Self {
            body: problem.body(solver.start),
            pins: problem.pins(),
            gravity: problem.gravity(),
            settings,
        }
    }

    /// As [`Method::step`], with other settings.
    pub fn step_with(&mut self, settings: &Settings) -> StepReport {
        let scene = Scene {
            gravity: self.gravity,
            pins: &self.pins,
            ..Scene::default()
        };
        self.body.step(&scene, settings)
    }

    pub fn settings(&self) -> Settings {
        self.settings
    }
}

impl Method for Ours {
    fn step(&mut self) {
        // A refused step stays where it is; its error shows it.
        _ = self.step_with(&self.settings.clone());
    }
    fn positions(&self) -> Vec<[f64; 3]> {
        widened(self.body.positions())
    }
    fn velocities(&self) -> Vec<[f64; 3]> {
        widened(self.body.velocities())
    }
}

/// One budget of a solver.
pub fn contender(solver: Solver, substeps: u32, iterations: u32, polar_sweeps: u32) -> Contender {
    let budget = Budget {
        iterations,
        polar_sweeps,
    };
    Contender::new(
        solver.name,
        format!("{substeps}×{iterations} it., {polar_sweeps} sweeps"),
        substeps,
        move |problem, dt| Ours::new(problem, dt, solver, budget),
    )
}
