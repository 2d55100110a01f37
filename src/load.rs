//! Loads on a surface: pressure, enclosed gas, wind.
//!
//! Each adds to a list of forces (newtons, one a node) that the scene takes in [`forces`](crate::Scene::forces); cleared
//! by who owns it, before every step. They cost the same in every state.
//!
//! ```
//! use femto::glam::Vec3;
//! use femto::load::{Gas, Triangles, Wind};
//!
//! let nodes = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
//! let surface = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
//! let surface = Triangles::new(&surface, nodes.len())?;
//! let gas = Gas::new(5e3, surface.volume(&nodes))?;
//! let wind = Wind::new(Vec3::new(12.0, 0.0, 0.0), 1.2)?;
//!
//! let (x, v) = (nodes, [[0.0; 3]; 4]);  // every step: body.positions(), body.velocities()
//! let mut forces = [[0.0; 3]; 4];
//! gas.pressure(surface.volume(&x)).add(&surface, &x, &mut forces);
//! wind.add(&surface, &x, &v, &mut forces);
//! assert!(forces[0][0] < 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A triangle has the area vector a = (x₁ − x₀) × (x₂ − x₀)/2, outward, and the area A = |a|; its nodes share its force.
//!
//! **Pressure** p on the inside gives f = p a. On a closed surface that is p ∇V of the enclosed volume V, so its
//! work is p dV, and its sum and its torque are zero. A gas at constant temperature has p = p₀V₀/V.
//!
//! **Wind** meets the triangles that face it. With the air's velocity u relative to the triangle's (the mean of its nodes'),
//! of which u_n is along the normal and u_t along the surface, air of density ρ arrives at the rate
//! ρA(−u·n)₊ kg/s and leaves a part of its momentum:
//!
//! ```text
//! f = ½ρ (−u·a)₊ (c_n u_n + c_t u_t)
//! ```
//!
//! c_n = 2 takes all of the momentum across the surface, as in Newton's theory of impact (Anderson, "Hypersonic and
//! High-Temperature Gas Dynamics", section 3.2); c_t is friction, and with c_t = c_n the force is along u. Nothing acts where
//! u = 0, and in air at rest the force only brakes: f·v ≤ 0. Both loads are explicit, from the state before the step; wind
//! must not stop a layer of the body in less than one step: h ρ c |u| ≪ 2 (density of the body · size of a tetrahedron).

use core::fmt;

use glam::Vec3;

use crate::math::{ratio_or_zero, select, sqrt};

/// What is wrong with a load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LoadError {
    /// A triangle names a node that does not exist.
    Node {
        /// The triangle.
        triangle: u32,
    },
    /// The pressure is not finite.
    Pressure,
    /// The volume is not positive, or not finite.
    Volume,
    /// The velocity of the air is not finite.
    Velocity,
    /// The density of the air is negative, or not finite.
    Density,
    /// A coefficient is negative, or not finite.
    Coefficient,
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Node { triangle } => {
                return write!(f, "triangle {triangle} names a node that does not exist");
            }
            Self::Pressure => "the pressure must be finite",
            Self::Volume => "the volume must be positive and finite",
            Self::Velocity => "the velocity of the air must be finite",
            Self::Density => "the density of the air must be finite and not negative",
            Self::Coefficient => "the coefficients must be finite and not negative",
        })
    }
}

impl core::error::Error for LoadError {}

/// Triangles of a surface, counter-clockwise as seen from outside; with the feature `alloc`,
/// `surface::boundary_triangles` finds those of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Triangles<'a>(&'a [[u32; 3]]);

impl<'a> Triangles<'a> {
    /// Of a body of so many nodes.
    ///
    /// # Errors
    /// [`LoadError::Node`].
    pub fn new(triangles: &'a [[u32; 3]], nodes: usize) -> Result<Self, LoadError> {
        let lost = |&(_, corners): &(u32, &[u32; 3])| corners.iter().any(|&n| n as usize >= nodes);
        (0..)
            .zip(triangles)
            .find(lost)
            .map_or(Ok(Self(triangles)), |(triangle, _)| {
                Err(LoadError::Node { triangle })
            })
    }

    /// The volume (m³) that a closed surface encloses at these positions; negative inside out.
    #[must_use]
    pub fn volume(&self, x: &[[f32; 3]]) -> f32 {
        let origin = self.corners(x).next().map_or(Vec3::ZERO, |([a, ..], _)| a);
        let mut six_volumes = 0.0;
        for ([a, b, c], _) in self.corners(x) {
            six_volumes += (a - origin).dot((b - origin).cross(c - origin));
        }
        six_volumes * (1.0 / 6.0)
    }

    fn corners<'b>(&self, x: &'b [[f32; 3]]) -> impl Iterator<Item = ([Vec3; 3], [u32; 3])> + 'b
    where
        'a: 'b,
    {
        let at = |node: u32| Vec3::from_array(x.get(node as usize).copied().unwrap_or([0.0; 3]));
        self.0.iter().map(move |&nodes| (nodes.map(at), nodes))
    }
}

/// Adds a third of a triangle's force to each of its nodes.
#[inline]
fn share(force: Vec3, nodes: [u32; 3], forces: &mut [[f32; 3]]) {
    let third = force * (1.0 / 3.0);
    for node in nodes {
        if let Some(force) = forces.get_mut(node as usize) {
            *force = (Vec3::from_array(*force) + third).to_array();
        }
    }
}

/// a, m²
#[inline]
fn area([a, b, c]: [Vec3; 3]) -> Vec3 {
    (b - a).cross(c - a) * 0.5
}

/// A pressure on the inside of a surface, less that outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressure(f32);

impl Pressure {
    /// In pascals; negative presses inward.
    ///
    /// # Errors
    /// [`LoadError::Pressure`].
    pub fn new(pascals: f32) -> Result<Self, LoadError> {
        if pascals.is_finite() {
            Ok(Self(pascals))
        } else {
            Err(LoadError::Pressure)
        }
    }

    /// Pa
    #[must_use]
    pub fn pascals(&self) -> f32 {
        self.0
    }

    /// Adds its forces (N) on a body at positions `x` (m).
    pub fn add(&self, surface: &Triangles<'_>, x: &[[f32; 3]], forces: &mut [[f32; 3]]) {
        for (corners, nodes) in surface.corners(x) {
            share(area(corners) * self.0, nodes, forces);
        }
    }
}

/// Gas at constant temperature inside a closed surface: p V = p₀ V₀.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gas {
    /// p₀V₀, J
    energy: f32,
    outside: f32,
}

impl Gas {
    /// Of this pressure (Pa) in this volume (m³), into a vacuum.
    ///
    /// # Errors
    /// [`LoadError::Pressure`], [`LoadError::Volume`].
    pub fn new(pressure: f32, volume: f32) -> Result<Self, LoadError> {
        if !(volume > 0.0 && volume.is_finite()) {
            return Err(LoadError::Volume);
        }
        let energy = pressure * volume;
        if !energy.is_finite() {
            return Err(LoadError::Pressure);
        }
        let outside = 0.0;
        Ok(Self { energy, outside })
    }

    /// Against a pressure (Pa) outside.
    ///
    /// # Errors
    /// [`LoadError::Pressure`].
    pub fn with_outside(self, outside: f32) -> Result<Self, LoadError> {
        if outside.is_finite() {
            Ok(Self { outside, ..self })
        } else {
            Err(LoadError::Pressure)
        }
    }

    /// Its pressure in this volume (m³), less that outside. Zero inside where the volume is not positive.
    #[must_use]
    pub fn pressure(&self, volume: f32) -> Pressure {
        Pressure(ratio_or_zero(self.energy, volume, 0.0) - self.outside)
    }
}

/// Air that blows at a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wind {
    velocity: Vec3,
    density: f32,
    normal: f32,
    tangential: f32,
}

impl Wind {
    /// Of this velocity (m/s) and density (kg/m³; air has 1.2), with c_n = 2 and c_t = 0.
    ///
    /// # Errors
    /// [`LoadError::Velocity`], [`LoadError::Density`].
    pub fn new(velocity: Vec3, density: f32) -> Result<Self, LoadError> {
        if !velocity.is_finite() {
            return Err(LoadError::Velocity);
        }
        if !(density >= 0.0 && density.is_finite()) {
            return Err(LoadError::Density);
        }
        Ok(Self {
            velocity,
            density,
            normal: 2.0,
            tangential: 0.0,
        })
    }

    /// With other c_n and c_t.
    ///
    /// # Errors
    /// [`LoadError::Coefficient`].
    pub fn with_coefficients(self, normal: f32, tangential: f32) -> Result<Self, LoadError> {
        if [normal, tangential]
            .iter()
            .all(|c| *c >= 0.0 && c.is_finite())
        {
            Ok(Self {
                normal,
                tangential,
                ..self
            })
        } else {
            Err(LoadError::Coefficient)
        }
    }

    /// Adds its forces (N) on a body at positions `x` (m) with velocities `v` (m/s).
    pub fn add(
        &self,
        surface: &Triangles<'_>,
        x: &[[f32; 3]],
        v: &[[f32; 3]],
        forces: &mut [[f32; 3]],
    ) {
        for ((corners, nodes), ([a, b, c], _)) in surface.corners(x).zip(surface.corners(v)) {
            let u = self.velocity - (a + b + c) * (1.0 / 3.0);
            let a = area(corners);
            let n = a * ratio_or_zero(1.0, sqrt(a.dot(a)), 0.0);
            let arrives = -u.dot(a);
            let rate = 0.5 * self.density * select(arrives > 0.0, arrives, 0.0);
            let across = n * u.dot(n);
            let along = u - across;
            let taken = across * self.normal + along * self.tangential;
            share(taken * rate, nodes, forces);
        }
    }
}
