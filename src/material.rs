//! Isotropic linear elastic materials with Rayleigh damping, one for a body or several in it.

use core::fmt;

/// Material of a body, in SI units, validated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    young: f32,
    poisson: f32,
    density: f32,
    alpha: f32,
    beta: f32,
}

/// Which parameter of a material is out of its range; it carries the value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MaterialError {
    /// Young's modulus must be positive and finite (Pa).
    Young(f32),
    /// Poisson's ratio must lie strictly between −1 and 0.5.
    Poisson(f32),
    /// Density must be positive and finite (kg/m³).
    Density(f32),
    /// Mass-proportional damping must be finite and not negative (1/s).
    Alpha(f32),
    /// Stiffness-proportional damping must be finite and not negative (s).
    Beta(f32),
}

impl fmt::Display for MaterialError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Young(x) => write!(f, "Young's modulus {x} must be positive and finite"),
            Self::Poisson(x) => write!(f, "Poisson's ratio {x} must be above -1 and below 0.5"),
            Self::Density(x) => write!(f, "density {x} must be positive and finite"),
            Self::Alpha(x) => write!(f, "damping alpha {x} must be finite and not negative"),
            Self::Beta(x) => write!(f, "damping beta {x} must be finite and not negative"),
        }
    }
}

impl core::error::Error for MaterialError {}

impl Material {
    /// A material without damping: Young's modulus (Pa), Poisson's ratio, density (kg/m³).
    ///
    /// # Errors
    /// The first parameter that is out of range: `young > 0`, `−1 < poisson < 0.5`, `density > 0`.
    pub fn new(young: f32, poisson: f32, density: f32) -> Result<Self, MaterialError> {
        let positive = |x: f32| x > 0.0 && x.is_finite();
        if !positive(young) {
            Err(MaterialError::Young(young))
        } else if !(poisson > -1.0 && poisson < 0.5) {
            Err(MaterialError::Poisson(poisson))
        } else if !positive(density) {
            Err(MaterialError::Density(density))
        } else {
            Ok(Self {
                young,
                poisson,
                density,
                alpha: 0.0,
                beta: 0.0,
            })
        }
    }

    /// With Rayleigh damping D = αM + βK; α in 1/s, β in s.
    ///
    /// # Errors
    /// [`MaterialError::Alpha`] or [`MaterialError::Beta`] where negative or not finite.
    pub fn with_damping(self, alpha: f32, beta: f32) -> Result<Self, MaterialError> {
        let usable = |x: f32| x >= 0.0 && x.is_finite();
        if !usable(alpha) {
            Err(MaterialError::Alpha(alpha))
        } else if !usable(beta) {
            Err(MaterialError::Beta(beta))
        } else {
            Ok(Self {
                alpha,
                beta,
                ..self
            })
        }
    }

    /// Lamé's parameters λ and μ (Pa), in f64:
    /// λ = Eν/((1 + ν)(1 − 2ν)), μ = E/(2(1 + ν)).
    #[must_use]
    pub fn lame(&self) -> (f64, f64) {
        let (e, nu) = (f64::from(self.young), f64::from(self.poisson));
        (
            e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)),
            e / (2.0 * (1.0 + nu)),
        )
    }

    /// Young's modulus E, Pa.
    #[must_use]
    pub fn young(&self) -> f32 {
        self.young
    }

    /// Poisson's ratio ν.
    #[must_use]
    pub fn poisson(&self) -> f32 {
        self.poisson
    }

    /// Density, kg/m³.
    #[must_use]
    pub fn density(&self) -> f32 {
        self.density
    }

    /// Mass-proportional damping α, 1/s.
    #[must_use]
    pub fn alpha(&self) -> f32 {
        self.alpha
    }

    /// Stiffness-proportional damping β, s.
    #[must_use]
    pub fn beta(&self) -> f32 {
        self.beta
    }
}

/// The materials of a body: a [`Material`] for all of it, a slice `[Material]` with one a
/// tetrahedron, or [`Regions`].
///
/// Damping is a body's, not a tetrahedron's (D = αM + βK): all materials must have the same.
pub trait Materials {
    /// Of tetrahedron `tet`, counted from zero; `None` where it is given none.
    fn of(&self, tet: usize) -> Option<&Material>;

    /// For how many tetrahedra there is an entry; `None` where for any number.
    fn tets(&self) -> Option<usize> {
        None
    }
}

impl Materials for Material {
    fn of(&self, _: usize) -> Option<&Material> {
        Some(self)
    }
}

impl Materials for [Material] {
    fn of(&self, tet: usize) -> Option<&Material> {
        self.get(tet)
    }

    fn tets(&self) -> Option<usize> {
        Some(self.len())
    }
}

/// A few materials, and which of them each tetrahedron is made of.
#[derive(Clone, Copy, Debug)]
pub struct Regions<'a> {
    /// The materials.
    pub materials: &'a [Material],
    /// One a tetrahedron: its place in `materials`.
    pub of: &'a [u16],
}

impl Materials for Regions<'_> {
    fn of(&self, tet: usize) -> Option<&Material> {
        self.materials.get(usize::from(*self.of.get(tet)?))
    }

    fn tets(&self) -> Option<usize> {
        Some(self.of.len())
    }
}
