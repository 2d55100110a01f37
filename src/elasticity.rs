//! Elasticity of materials that are not the same in all directions, from engineering constants, for
//! [`OwnedRest::anisotropic`](crate::owned::OwnedRest::anisotropic).
//!
//! An *orthotropic* material has three planes of symmetry. Along its axes 1, 2, 3 its strains are
//!
//! ```text
//! ε_i = σ_i/E_i − Σ_{j≠i} ν_ji σ_j/E_j,    γ_23 = τ_23/G_23, …,    ν_ij/E_i = ν_ji/E_j
//! ```
//!
//! where ν_ij is the contraction along j under a stress along i. Inverted (Jones, "Mechanics of Composite
//! Materials", 2nd ed. 1999, Eqs. 2.28 and 2.29), with Δ = 1 − ν₁₂ν₂₁ − ν₂₃ν₃₂ − ν₃₁ν₁₃ − 2ν₂₁ν₃₂ν₁₃:
//!
//! ```text
//! C_11 = E₁ (1 − ν₂₃ν₃₂)/Δ,   C_12 = E₁ (ν₂₁ + ν₃₁ν₂₃)/Δ,   cyclically;   C_44 = G₂₃, C_55 = G₁₃, C_66 = G₁₂
//! ```
//!
//! No stress may do negative work (Lempriere 1968): E, G, Δ and each 1 − ν_ij ν_ji are positive.
//!
//! A *fibre-reinforced* material is transversely isotropic: the same in all directions across its fibres.
//!
//! ```
//! use femto::elasticity::Fibres;
//! // Muscle-like: ten times as stiff along the fibres.
//! let fibres = Fibres { along: 1e6, across: 1e5, poisson_along: 0.4, poisson_across: 0.4, shear: 3.5e4 };
//! let c = fibres.elasticity([1.0, 0.0, 0.2])?;
//! assert!(c[0][0] > c[1][1]);
//! # Ok::<(), femto::elasticity::ElasticityError>(())
//! ```

use core::fmt;

pub use crate::element::Elasticity;
use crate::element::VOIGT;

/// What is wrong with engineering constants.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ElasticityError {
    /// Young's modulus along this axis (0, 1, 2) must be positive and finite (Pa).
    Young {
        /// The axis.
        axis: usize,
        /// Its value.
        value: f64,
    },
    /// The shear modulus must be positive and finite (Pa).
    Shear {
        /// The axis across its plane.
        axis: usize,
        /// Its value.
        value: f64,
    },
    /// Poisson's ratios must be such that no stress does negative work.
    Poisson,
    /// A direction must be finite and not zero.
    Direction([f64; 3]),
}

impl fmt::Display for ElasticityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Young { axis, value } => {
                write!(
                    f,
                    "Young's modulus {value} along axis {axis} must be positive and finite"
                )
            }
            Self::Shear { axis, value } => {
                write!(
                    f,
                    "shear modulus {value} across axis {axis} must be positive and finite"
                )
            }
            Self::Poisson => {
                write!(
                    f,
                    "with these Poisson's ratios some stress would do negative work"
                )
            }
            Self::Direction([x, y, z]) => {
                write!(f, "direction [{x}, {y}, {z}] must be finite and not zero")
            }
        }
    }
}

impl core::error::Error for ElasticityError {}

/// Engineering constants of an orthotropic material along its own axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orthotropic {
    /// Young's moduli E₁, E₂, E₃, Pa.
    pub young: [f64; 3],
    /// Poisson's ratios ν₂₃, ν₁₃, ν₁₂: the second axis contracts under a stress along the first.
    pub poisson: [f64; 3],
    /// Shear moduli G₂₃, G₁₃, G₁₂, Pa.
    pub shear: [f64; 3],
}

impl Orthotropic {
    /// Elasticity along its own axes.
    ///
    /// # Errors
    /// [`ElasticityError`], but for directions.
    pub fn elasticity(&self) -> Result<Elasticity, ElasticityError> {
        let bad = |x: &f64| !(*x > 0.0 && x.is_finite());
        if let Some(axis) = self.young.iter().position(bad) {
            return Err(ElasticityError::Young {
                axis,
                value: self.young[axis],
            });
        }
        if let Some(axis) = self.shear.iter().position(bad) {
            return Err(ElasticityError::Shear {
                axis,
                value: self.shear[axis],
            });
        }
        let [e1, e2, e3] = self.young;
        let [n23, n13, n12] = self.poisson;
        let (n32, n31, n21) = (n23 * e3 / e2, n13 * e3 / e1, n12 * e2 / e1);
        let minors = [1.0 - n23 * n32, 1.0 - n13 * n31, 1.0 - n12 * n21];
        let delta = 1.0 - n12 * n21 - n23 * n32 - n31 * n13 - 2.0 * n21 * n32 * n13;
        // False for NaN, too.
        if !(delta > 0.0 && minors.iter().all(|minor| *minor > 0.0)) {
            return Err(ElasticityError::Poisson);
        }
        let mut c = [[0.0; 6]; 6];
        for axis in 0..3 {
            c[axis][axis] = self.young[axis] * minors[axis] / delta;
            c[axis + 3][axis + 3] = self.shear[axis];
        }
        let coupled = [
            (0, 1, e1 * (n21 + n31 * n23)),
            (0, 2, e1 * (n31 + n21 * n32)),
            (1, 2, e2 * (n32 + n12 * n31)),
        ];
        for (i, j, stiffness) in coupled {
            (c[i][j], c[j][i]) = (stiffness / delta, stiffness / delta);
        }
        Ok(c)
    }

    /// Elasticity with the material's axes along these unit vectors, which must be at right angles.
    ///
    /// # Errors
    /// [`ElasticityError`].
    pub fn along(&self, axes: &[[f64; 3]; 3]) -> Result<Elasticity, ElasticityError> {
        for axis in axes {
            unit(*axis)?;
        }
        Ok(turned(&self.elasticity()?, axes))
    }
}

/// Engineering constants of a fibre-reinforced, that is, transversely isotropic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibres {
    /// Young's modulus along the fibres, Pa.
    pub along: f64,
    /// Young's modulus across them, Pa.
    pub across: f64,
    /// Contraction across the fibres under a stress along them.
    pub poisson_along: f64,
    /// Contraction across the fibres under a stress across them, at right angles.
    pub poisson_across: f64,
    /// Shear modulus in planes along the fibres, Pa.
    pub shear: f64,
}

impl Fibres {
    /// Elasticity with the fibres in this direction, of any length.
    ///
    /// # Errors
    /// [`ElasticityError`]; axis 0 is that of the fibres.
    pub fn elasticity(&self, direction: [f64; 3]) -> Result<Elasticity, ElasticityError> {
        let fibre = unit(direction)?;
        // Across, shear is that of an isotropic plane: G₂₃ = E₂/(2(1 + ν₂₃)).
        let across = self.across / (2.0 * (1.0 + self.poisson_across));
        if self.poisson_across.is_nan() || self.poisson_across <= -1.0 {
            return Err(ElasticityError::Poisson);
        }
        let material = Orthotropic {
            young: [self.along, self.across, self.across],
            poisson: [self.poisson_across, self.poisson_along, self.poisson_along],
            shear: [across, self.shear, self.shear],
        };
        // Any two axes across: the first with the base vector that is least along.
        let sizes = fibre.map(f64::abs);
        let least = (0..3).fold(0, |l, a| if sizes[a] < sizes[l] { a } else { l });
        let base = core::array::from_fn(|a| if a == least { 1.0 } else { 0.0 });
        let second = unit(cross(&fibre, &base))?;
        let third = cross(&fibre, &second);
        material.along(&[fibre, second, third])
    }
}

fn unit(v: [f64; 3]) -> Result<[f64; 3], ElasticityError> {
    // Scaled, so that no square overflows or vanishes.
    let most = v.iter().fold(
        0.0,
        |most: f64, x| if x.abs() > most { x.abs() } else { most },
    );
    if !(most > 0.0 && v.iter().all(|x| x.is_finite())) {
        return Err(ElasticityError::Direction(v));
    }
    let v = v.map(|x| x / most);
    let length = libm::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    Ok(v.map(|x| x / length))
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// C_ijkl = Σ R_ai R_bj R_ck R_dl C°_abcd, with the rows of R the material's axes.
fn turned(c: &Elasticity, axes: &[[f64; 3]; 3]) -> Elasticity {
    const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)];
    // σ = T σ°: a stress of the material in our axes, and the shear strains doubled the other way round.
    let t: Elasticity = core::array::from_fn(|row| {
        let (i, j) = PAIRS[row];
        let mut out = [0.0; 6];
        for a in 0..3 {
            for b in 0..3 {
                out[VOIGT[a][b]] += axes[a][i] * axes[b][j];
            }
        }
        out
    });
    // C = T C° Tᵀ
    core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            let mut sum = 0.0;
            for a in 0..6 {
                for b in 0..6 {
                    sum += t[i][a] * c[a][b] * t[j][b];
                }
            }
            sum
        })
    })
}
