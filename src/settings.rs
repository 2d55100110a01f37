//! What the user chooses for a step: time step, integration rule, solver and budget.

use core::fmt;

#[cfg(feature = "fracture")]
use crate::fracture::Fracture;
#[cfg(feature = "plasticity")]
use crate::plasticity::Plasticity;
pub use crate::preconditioner::Preconditioner;
use crate::scene::Scene;

/// How much work a step may do. It does exactly this much.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Iterations of the conjugate gradient.
    /// In scenes with colliders it is one more, for what the iterate changes about who touches ([`constraint`](crate::constraint)).
    /// Contact decides with three or more.
    pub iterations: u32,
    /// Jacobi sweeps of the polar decomposition.
    pub polar_sweeps: u32,
}

impl Default for Budget {
    /// [`Budget::DEFAULT`]
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl Budget {
    /// 5 iterations, 2 sweeps.
    pub const DEFAULT: Self = Self {
        iterations: 5,
        polar_sweeps: 2,
    };
}

/// Where the solver starts, and the space W that it solves exactly (see the front page).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Start {
    /// From rest, with a line search along the solution at the end, which costs one application. Energy-stable,
    /// but damps motion until it has converged.
    Zero,
    /// From v(t), the choice of Dahl and Bargteil. Can raise the energy, without bound where bodies are stiff.
    Velocity,
    /// From v(t) + hM⁻¹f. Unstable where bodies are stiff; here for comparison.
    VelocityForce,
    /// W = the last so many velocities, v(t) the first, and the translations of a free body. Energy-stable;
    /// linear momentum is exact. Without v(t), `Galerkin(0)`, what a body has stored is not seen by a
    /// truncated solve, and energy can build up over the steps.
    Galerkin(u8),
    /// As `Galerkin`, and the three rotations about the centre of mass (of the pinned nodes, where a
    /// body is held). Costs three applications more. Not for bodies that are very stiff for their step
    /// (h²E/(ρ dx²) beyond 10⁴, with the cell's edge dx): there the rounding of elastic forces, which W's rotations
    /// carry exactly, can set a body spinning.
    Rigid(u8),
}

impl Default for Start {
    /// `Galerkin(1)`
    fn default() -> Self {
        Self::Galerkin(1)
    }
}

impl Start {
    /// Velocities before v(t) that a state must keep: the capacity `HISTORY`.
    #[must_use]
    pub const fn history(self) -> usize {
        match self {
            Self::Galerkin(m) | Self::Rigid(m) => (m as usize).saturating_sub(1),
            _ => 0,
        }
    }

    /// Vectors of W that a workspace must hold: the capacity `VECTORS`.
    #[must_use]
    pub const fn vectors(self) -> usize {
        match self {
            Self::Galerkin(m) => m as usize,
            Self::Rigid(m) => m as usize + 3,
            _ => 0,
        }
    }

    /// Whether the iterate is a Galerkin solution, with W's translations where a body is free.
    pub(crate) const fn is_augmented(self) -> bool {
        matches!(self, Self::Galerkin(_) | Self::Rigid(_))
    }
}

/// What a solver needs room for, besides the body's size: of a [`Start`], or of whole [`Settings`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// Velocities before v(t): [`Start::history`].
    pub history: usize,
    /// Vectors of W: [`Start::vectors`].
    pub vectors: usize,
    /// Numbers of a coarse solve: [`Preconditioner::coarse_length`].
    pub coarse: usize,
    /// Plastic strain of every tetrahedron.
    #[cfg(feature = "plasticity")]
    pub plastic: bool,
    /// Of every tetrahedron, whether it has broken.
    #[cfg(feature = "fracture")]
    pub broken: bool,
}

impl From<Start> for Needs {
    fn from(start: Start) -> Self {
        Self {
            history: start.history(),
            vectors: start.vectors(),
            ..Self::default()
        }
    }
}

impl From<&Settings<'_>> for Needs {
    fn from(settings: &Settings<'_>) -> Self {
        Self {
            coarse: settings.preconditioner.coarse_length(),
            #[cfg(feature = "plasticity")]
            plastic: settings.plasticity.is_some(),
            #[cfg(feature = "fracture")]
            broken: settings.fracture.is_some(),
            ..settings.start.into()
        }
    }
}

/// Parts of a body, or bodies of one system, that yield and break by laws of their own.
#[cfg(any(feature = "plasticity", feature = "fracture"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LawRegions<'a> {
    /// One a tetrahedron: its place in the lists below.
    pub of: &'a [u16],
    /// Plastic flow; what has none of it, and what is beyond the list, does not yield.
    #[cfg(feature = "plasticity")]
    pub plasticity: &'a [Option<Plasticity>],
    /// Strength, Pa; what is beyond the list, or is not positive there, does not fail.
    #[cfg(feature = "fracture")]
    pub strength: &'a [f32],
}

/// Everything about a step but the scene, validated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings<'a> {
    dt: f32,
    theta: f32,
    /// Iterations and sweeps.
    pub budget: Budget,
    /// Start of the solver.
    pub start: Start,
    /// Preconditioner of the solver.
    pub preconditioner: Preconditioner<'a>,
    /// Whether contact is kept from adding energy: [`Self::with_energy_guard`].
    #[cfg(feature = "energy-guard")]
    pub energy_guard: bool,
    /// Plastic flow, if any.
    #[cfg(feature = "plasticity")]
    pub plasticity: Option<Plasticity>,
    /// Fracture, if any.
    #[cfg(feature = "fracture")]
    pub fracture: Option<Fracture>,
    /// Whose laws differ from those above, if any do.
    #[cfg(any(feature = "plasticity", feature = "fracture"))]
    pub regions: Option<LawRegions<'a>>,
}

/// Which setting is out of its range; it carries the value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SettingsError {
    /// The time step must be positive, finite and a normal f32 (s).
    Dt(f32),
    /// θ must lie between 0.5 and 1.
    Theta(f32),
}

impl fmt::Display for SettingsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Dt(x) => write!(f, "time step {x} must be positive and finite"),
            Self::Theta(x) => write!(f, "theta {x} must be between 0.5 and 1"),
        }
    }
}

impl core::error::Error for SettingsError {}

impl<'a> Settings<'a> {
    /// Backward Euler with a time step of `dt` seconds and the default budget and solver.
    ///
    /// # Errors
    /// [`SettingsError::Dt`].
    pub const fn new(dt: f32) -> Result<Self, SettingsError> {
        if !(dt > 0.0 && dt.is_normal()) {
            return Err(SettingsError::Dt(dt));
        }
        Ok(Self {
            dt,
            theta: 1.0,
            budget: Budget::DEFAULT,
            start: Start::Galerkin(1),
            preconditioner: Preconditioner::Jacobi,
            #[cfg(feature = "energy-guard")]
            energy_guard: false,
            #[cfg(feature = "plasticity")]
            plasticity: None,
            #[cfg(feature = "fracture")]
            fracture: None,
            #[cfg(any(feature = "plasticity", feature = "fracture"))]
            regions: None,
        })
    }

    /// With θ: 1 is backward Euler, 0.5 the implicit Newmark (trapezoidal) rule.
    ///
    /// # Errors
    /// [`SettingsError::Theta`].
    pub const fn with_theta(self, theta: f32) -> Result<Self, SettingsError> {
        if theta >= 0.5 && theta <= 1.0 {
            Ok(Self { theta, ..self })
        } else {
            Err(SettingsError::Theta(theta))
        }
    }

    /// With this budget.
    #[must_use]
    pub const fn with_budget(self, budget: Budget) -> Self {
        Self { budget, ..self }
    }

    /// With this start.
    #[must_use]
    pub const fn with_start(self, start: Start) -> Self {
        Self { start, ..self }
    }

    /// With this preconditioner.
    #[must_use]
    pub const fn with_preconditioner(self, preconditioner: Preconditioner<'a>) -> Self {
        Self {
            preconditioner,
            ..self
        }
    }

    /// With a guard over contact's energy, for two more products with A in scenes with
    /// colliders.
    ///
    /// Nodes that the last iterations move into a surface are put back on it, which strains the body. With the guard, that is part
    /// of the step's energy, and where its displacements u would add some, it goes a part 0 ≤ s ≤ 1 of them: as far as it
    /// needs to, at most to the least of its energy along u, where uᵀ(b − A u) is not negative and (8) of the front page holds.
    /// So no step with contact adds energy (kinetic, elastic and potential, with the rotations at its begin): at every
    /// stiffness, start, preconditioner and number of iterations, to rounding, and on every shape.
    ///
    /// It takes motion where a stopped solve has no better to offer: a body that is too stiff for its iterations, and could
    /// only go on by straining itself, stays where it is. (Without it, it goes on more often, with energy that it did not have.)
    ///
    /// It acts where θ = 1 and nothing moves by itself: pins held, colliders at rest. Bodies that also touch each other gain no more
    /// than the law of their [contacts](crate::coupling) gives back.
    #[cfg(feature = "energy-guard")]
    #[must_use]
    pub const fn with_energy_guard(self) -> Self {
        Self {
            energy_guard: true,
            ..self
        }
    }

    /// With plastic flow. The state needs room for it.
    #[cfg(feature = "plasticity")]
    #[must_use]
    pub const fn with_plasticity(self, plasticity: Plasticity) -> Self {
        Self {
            plasticity: Some(plasticity),
            ..self
        }
    }

    /// With fracture. The state needs room for it.
    #[cfg(feature = "fracture")]
    #[must_use]
    pub const fn with_fracture(self, fracture: Fracture) -> Self {
        Self {
            fracture: Some(fracture),
            ..self
        }
    }

    /// With laws by region, in place of the yield strain, limit and relaxation of the body's plastic flow and of the
    /// strength of its fracture; it needs these all the same.
    #[cfg(any(feature = "plasticity", feature = "fracture"))]
    #[must_use]
    pub const fn with_regions(self, regions: LawRegions<'a>) -> Self {
        Self {
            regions: Some(regions),
            ..self
        }
    }

    /// Time step h, seconds.
    #[must_use]
    pub fn dt(&self) -> f32 {
        self.dt
    }

    /// Whether the guard over contact's energy acts in a scene.
    pub(crate) fn guards(&self, scene: &Scene<'_>) -> bool {
        #[cfg(feature = "energy-guard")]
        let asked = self.energy_guard;
        #[cfg(not(feature = "energy-guard"))]
        let asked = false;
        asked && self.theta == 1.0 && !scene.colliders.is_empty() && !scene.moves()
    }

    /// θ
    #[must_use]
    pub fn theta(&self) -> f32 {
        self.theta
    }
}
