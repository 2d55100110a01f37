//! femto itself.

use std::collections::BTreeMap;
use std::sync::Mutex;

use femto::element::Factored;
use femto::preconditioner::aggregate::{Aggregates, DEFAULT_AGGREGATES};
use femto::{Budget, Factor, OwnedBody, Pin, Preconditioner, Scene, Settings, Start, StepReport};
use femto_bake::{FactorOptions, Kind, Precision, factor};

use crate::method::{Contender, Method, widened};
use crate::problem::Problem;

/// A preconditioner before it has met a body.
#[derive(Clone, Copy)]
pub enum Choice {
    Local(Preconditioner<'static>),
    /// What it drops comes last.
    Factored(Kind, Precision, f64),
    TwoLevel,
}

const JACOBI: Choice = Choice::Local(Preconditioner::Jacobi);
const WARPED: Choice = Choice::Factored(Kind::Warped, Precision::Single, 0.0);
const LAPLACIAN: Choice = Choice::Factored(Kind::Laplacian, Precision::Single, 0.0);
/// Without the entries that couple least: on a large body, a third of them is left.
const THINNED: Choice = Choice::Factored(Kind::Warped, Precision::Single, 0.005);

/// A start and a preconditioner, with the names that scene files use.
#[derive(Clone, Copy)]
pub struct Solver {
    pub name: &'static str,
    pub start: Start,
    pub choice: Choice,
    /// 1 backward Euler, ½ trapezoidal.
    pub theta: f32,
}

const fn solver(name: &'static str, start: Start, choice: Choice) -> Solver {
    Solver {
        name,
        start,
        choice,
        theta: 1.0,
    }
}

/// The paper's choice.
pub const PAPER: Solver = solver("paper: velocity, jacobi", Start::Velocity, JACOBI);
const BLOCK: Choice = Choice::Local(Preconditioner::BlockJacobi);
const GALERKIN_2: Solver = solver("galerkin-2, jacobi", Start::Galerkin(2), JACOBI);
const RIGID_2: Solver = solver("rigid-2, jacobi", Start::Rigid(2), JACOBI);
const WARPED_1: Solver = solver("galerkin-1, warped", Start::Galerkin(1), WARPED);
const WARPED_2: Solver = solver("galerkin-2, warped", Start::Galerkin(2), WARPED);
pub const THINNED_1: Solver = solver("galerkin-1, warped, thinned", Start::Galerkin(1), THINNED);

/// Every solver whose error is held against its time: more are more entries.
pub const SOLVERS: [Solver; 17] = [
    PAPER,
    solver("galerkin-1, jacobi", Start::Galerkin(1), JACOBI),
    GALERKIN_2,
    solver("galerkin-3, jacobi", Start::Galerkin(3), JACOBI),
    solver("rigid-1, jacobi", Start::Rigid(1), JACOBI),
    RIGID_2,
    solver("galerkin-2, block-jacobi", Start::Galerkin(2), BLOCK),
    solver(
        "galerkin-2, two-level",
        Start::Galerkin(2),
        Choice::TwoLevel,
    ),
    GALERKIN_2.trapezoidal("galerkin-2, jacobi, θ = ½"),
    RIGID_2.trapezoidal("rigid-2, jacobi, θ = ½"),
    solver("galerkin-2, laplacian", Start::Galerkin(2), LAPLACIAN),
    WARPED_1,
    WARPED_2,
    solver(
        "galerkin-1, warped in f16",
        Start::Galerkin(1),
        Choice::Factored(Kind::Warped, Precision::Half, 0.0),
    ),
    WARPED_2.trapezoidal("galerkin-2, warped, θ = ½"),
    THINNED_1,
    THINNED_1.trapezoidal("galerkin-1, warped, thinned, θ = ½"),
];

/// Those that come nearest to the converged step.
pub const EXACT: [Solver; 2] = [WARPED_1, WARPED_2];

impl Solver {
    /// A nameless one.
    pub const fn new(start: Start, preconditioner: Preconditioner<'static>) -> Self {
        solver("", start, Choice::Local(preconditioner))
    }

    const fn trapezoidal(self, name: &'static str) -> Self {
        Self {
            name,
            theta: 0.5,
            ..self
        }
    }

    pub fn is_factored(&self) -> bool {
        matches!(self.choice, Choice::Factored(..))
    }

    /// For a body and a step. Factors are made once, and kept as long as the program runs.
    pub fn settings(&self, problem: &Problem, dt: f64, budget: Budget) -> Settings<'static> {
        let settings = Settings::new(dt as f32)
            .and_then(|settings| settings.with_theta(self.theta))
            .expect("a positive time step")
            .with_start(self.start)
            .with_budget(budget);
        settings.with_preconditioner(match self.choice {
            Choice::Local(preconditioner) => preconditioner,
            Choice::TwoLevel => {
                let body = problem.body::<Factored>(Start::Zero);
                let of = Box::leak(vec![0; problem.nodes.len()].into_boxed_slice());
                let aggregates = Aggregates::divide(&body.rest(), DEFAULT_AGGREGATES, of);
                Preconditioner::TwoLevel(aggregates.expect("one entry a node"))
            }
            Choice::Factored(kind, precision, drop) => {
                let options = FactorOptions {
                    kind,
                    precision,
                    drop,
                    held: problem.held.clone(),
                    ..FactorOptions::default()
                };
                Preconditioner::Factored(made(problem, &settings, &options))
            }
        })
    }
}

/// Body; stiffness, time step and θ; what kind of factor, and what it drops.
type Key = (&'static str, [u32; 3], bool, bool, u64);
static FACTORS: Mutex<BTreeMap<Key, &'static Factor<'static>>> = Mutex::new(BTreeMap::new());

fn made(
    problem: &Problem,
    settings: &Settings<'static>,
    options: &FactorOptions,
) -> &'static Factor<'static> {
    let numbers = [problem.young, settings.dt(), settings.theta()].map(f32::to_bits);
    let (warped, half) = (
        options.kind == Kind::Warped,
        options.precision == Precision::Half,
    );
    let mut factors = FACTORS.lock().expect("nobody panics with it");
    factors
        .entry((problem.name, numbers, warped, half, options.drop.to_bits()))
        .or_insert_with(|| {
            let body = problem.body::<Factored>(Start::Zero);
            let owned =
                factor(&body.rest(), settings, options).expect("a positive definite matrix");
            let owned: &'static _ = Box::leak(Box::new(owned));
            Box::leak(Box::new(owned.view()))
        })
}

/// A problem's body in the library.
pub struct Ours {
    pub body: OwnedBody<Factored>,
    pins: Vec<Pin>,
    gravity: femto::glam::Vec3,
    settings: Settings<'static>,
}

impl Ours {
    pub fn new(problem: &Problem, dt: f64, solver: Solver, budget: Budget) -> Self {
        let settings = solver.settings(problem, dt, budget);
        Self {
            body: problem.body(&settings),
            pins: problem.pins(),
            gravity: problem.gravity(),
            settings,
        }
    }

    /// As [`Method::step`], with other settings.
    pub fn step_with(&mut self, settings: &Settings<'_>) -> StepReport {
        let scene = Scene {
            gravity: self.gravity,
            pins: &self.pins,
            ..Scene::default()
        };
        self.body.step(&scene, settings)
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
