//! Methods that are held against each other.

use crate::problem::Problem;

/// A body in some method's hands.
pub trait Method {
    /// Advances by one of its own steps.
    fn step(&mut self);
    /// Where the nodes are.
    fn positions(&self) -> Vec<[f64; 3]>;
    /// How fast they are.
    fn velocities(&self) -> Vec<[f64; 3]>;
}

/// Makes a method's body for a problem, given its time step.
type Build = Box<dyn Fn(&Problem, f64) -> Box<dyn Method>>;

/// One method with one budget.
pub struct Contender {
    /// The curve that it belongs to.
    pub family: String,
    /// Its budget.
    pub budget: String,
    /// Equal steps that a step of the problem is made of.
    pub substeps: u32,
    /// Whether every step does the same work.
    pub steady: bool,
    pub build: Build,
}

impl Contender {
    pub fn new<M: Method + 'static>(
        family: impl Into<String>,
        budget: impl Into<String>,
        substeps: u32,
        build: impl Fn(&Problem, f64) -> M + 'static,
    ) -> Self {
        Self {
            family: family.into(),
            budget: budget.into(),
            substeps,
            steady: true,
            build: Box::new(move |problem, dt| Box::new(build(problem, dt))),
        }
    }

    /// Whose steps differ in their work.
    pub fn varying(self) -> Self {
        Self {
            steady: false,
            ..self
        }
    }
}

/// f32 as f64.
pub fn widened(u: &[[f32; 3]]) -> Vec<[f64; 3]> {
    u.iter().map(|u| u.map(f64::from)).collect()
}
