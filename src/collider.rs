//! Shapes that nodes cannot enter, by signed distance.

use core::fmt;

use glam::Vec3;

use crate::math::{select, sqrt};

/// A rigid shape with Coulomb friction. Restitution is 0. Lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Collider {
    shape: Shape,
    friction: f32,
    velocity: Vec3,
}

/// The shapes, each with a signed distance.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    /// Keeps normal · x ≥ offset; the normal is of unit length.
    HalfSpace { normal: Vec3, offset: f32 },
    /// Keeps |x − centre| ≥ radius.
    Sphere { centre: Vec3, radius: f32 },
}

/// What is wrong with a collider.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ColliderError {
    /// The normal is zero, or not finite.
    Normal,
    /// The offset or centre is not finite.
    Place,
    /// The radius is not positive, or its square not finite.
    Radius,
    /// The coefficient of friction is negative or not finite.
    Friction,
    /// The velocity is not finite.
    Velocity,
}

impl fmt::Display for ColliderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Normal => "the normal must be finite and not zero",
            Self::Place => "the offset or centre must be finite",
            Self::Radius => "the radius must be positive, and its square finite",
            Self::Friction => "the coefficient of friction must be finite and not negative",
            Self::Velocity => "the velocity must be finite",
        })
    }
}

impl core::error::Error for ColliderError {}

impl Collider {
    /// Keeps `normal` · x ≥ `offset` (the offset is along the unit normal, in metres). No friction.
    ///
    /// # Errors
    /// [`ColliderError::Normal`], [`ColliderError::Place`].
    pub fn half_space(normal: Vec3, offset: f32) -> Result<Self, ColliderError> {
        // By the largest component first, so that squares stay in range.
        let largest = normal.abs().max_element();
        let normal = normal / if largest > 0.0 { largest } else { 1.0 };
        let length = sqrt(normal.dot(normal));
        if !(length.is_normal() && normal.is_finite()) {
            return Err(ColliderError::Normal);
        }
        if !offset.is_finite() {
            return Err(ColliderError::Place);
        }
        let normal = normal / length;
        Ok(Self {
            shape: Shape::HalfSpace { normal, offset },
            friction: 0.0,
            velocity: Vec3::ZERO,
        })
    }

    /// Keeps nodes out of a ball. No friction.
    ///
    /// # Errors
    /// [`ColliderError::Place`], [`ColliderError::Radius`].
    pub fn sphere(centre: Vec3, radius: f32) -> Result<Self, ColliderError> {
        if !centre.is_finite() {
            return Err(ColliderError::Place);
        }
        // Its square is needed, too.
        if !(radius > 0.0 && (radius * radius).is_finite()) {
            return Err(ColliderError::Radius);
        }
        Ok(Self {
            shape: Shape::Sphere { centre, radius },
            friction: 0.0,
            velocity: Vec3::ZERO,
        })
    }

    /// With Coulomb's coefficient of friction, static and sliding.
    ///
    /// # Errors
    /// [`ColliderError::Friction`].
    pub fn with_friction(self, friction: f32) -> Result<Self, ColliderError> {
        if friction >= 0.0 && friction.is_finite() {
            Ok(Self { friction, ..self })
        } else {
            Err(ColliderError::Friction)
        }
    }

    /// Whose surface moves at `velocity` (m/s). The shape stays where it is until [`Self::advance`].
    ///
    /// # Errors
    /// [`ColliderError::Velocity`].
    pub fn with_velocity(self, velocity: Vec3) -> Result<Self, ColliderError> {
        if velocity.is_finite() {
            Ok(Self { velocity, ..self })
        } else {
            Err(ColliderError::Velocity)
        }
    }

    /// Moves the shape on by `time` seconds of its velocity.
    pub fn advance(&mut self, time: f32) {
        let travel = self.velocity * time;
        match &mut self.shape {
            Shape::HalfSpace { normal, offset } => *offset += normal.dot(travel),
            Shape::Sphere { centre, .. } => *centre += travel,
        }
    }

    /// Coefficient of friction.
    #[must_use]
    pub fn friction(&self) -> f32 {
        self.friction
    }

    /// Velocity of the surface, m/s.
    #[must_use]
    pub fn velocity(&self) -> Vec3 {
        self.velocity
    }

    /// Signed distance of a point (metres, negative inside) and the outward unit normal there.
    #[inline]
    #[must_use]
    pub fn distance(&self, x: Vec3) -> (f32, Vec3) {
        match self.shape {
            Shape::HalfSpace { normal, offset } => (normal.dot(x) - offset, normal),
            Shape::Sphere { centre, radius } => {
                let from = x - centre;
                let length = sqrt(from.dot(from));
                // At the centre any direction leads out; so near to it that squares vanish, too.
                let inside = length < 1e-18;
                let scale = 1.0 / select(inside, 1.0, length);
                let normal = Vec3::new(
                    from.x * scale,
                    select(inside, 1.0, from.y * scale),
                    from.z * scale,
                );
                (length - radius, normal)
            }
        }
    }
}
