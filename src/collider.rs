//! Shapes that nodes cannot enter, by signed distance.
//!
//! A half-space and a sphere are part of every step that takes colliders; all other shapes are borrowed as
//! `&dyn` [`SignedDistance`], so that firmware links those that it uses: [`Capsule`], [`Cuboid`], [`HeightField`], each
//! carried by a moving [`Frame`](crate::frame::Frame) as [`Placed`], or a function of one's own.
//!
//! ```
//! use femto::collider::{Capsule, Collider, Placed};
//! use femto::frame::Frame;
//! use femto::glam::{Mat3, Vec3};
//!
//! // A drum of 2 m along z, turning once in a second, and a bowl by its signed distance.
//! let drum = Capsule::new(Vec3::NEG_Z, Vec3::Z, 0.2)?;
//! let frame = Frame::new(Vec3::Y, Mat3::IDENTITY)?.with_spin(Vec3::Z * core::f32::consts::TAU)?;
//! let mut drum = Placed::new(drum, frame);
//! let bowl = |x: Vec3| {
//!     let length = x.length().max(1e-9);
//!     (3.0 - length, -x / length)
//! };
//! for _ in 0..10 {
//!     let colliders = [
//!         Collider::half_space(Vec3::Y, 0.0)?,
//!         Collider::shape(&drum).with_friction(0.5)?,
//!         Collider::shape(&bowl),
//!     ];
//!     // body.step(&Scene { colliders: &colliders, ..scene }, &settings);
//!     # assert_eq!(colliders.len(), 3);
//!     drum.advance(0.01);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Every node is compared with every collider in every step. What that costs is the same in every state for the
//! shapes here; a function of one's own should choose by [`select`], not by `if`.

mod height_field;
mod shapes;

use core::fmt;

use glam::Vec3;

use crate::cost::Shapes;
use crate::math::{select, sqrt};
pub use height_field::HeightField;
pub use shapes::{Capsule, Cuboid, Placed};

/// What a node sees of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// Signed distance, metres; negative inside.
    pub distance: f32,
    /// The outward unit normal: the gradient of the distance.
    pub normal: Vec3,
    /// Velocity of the shape's surface here, m/s.
    pub velocity: Vec3,
    /// Acceleration of what is at the surface here, m/s².
    pub acceleration: Vec3,
    /// x − distance · `way_out` is on the surface, for x inside: the normal, where the distance is a true one.
    pub way_out: Vec3,
}

impl Near {
    /// Of a shape that rests.
    #[inline]
    #[must_use]
    pub const fn fixed(distance: f32, normal: Vec3) -> Self {
        Self {
            distance,
            normal,
            velocity: Vec3::ZERO,
            acceleration: Vec3::ZERO,
            way_out: normal,
        }
    }
}

/// A shape's surface in a step: its mean velocity there in the step before, and in this one.
pub(crate) struct Surface {
    pub distance: f32,
    pub normal: Vec3,
    pub before: Vec3,
    pub velocity: Vec3,
}

/// A shape, by its signed distance. Also any `Fn(Vec3) -> (f32, Vec3)` that gives the distance (metres, negative
/// inside) and the outward unit normal of a shape that rests, if `Sync`.
pub trait SignedDistance: Sync {
    /// What is near `x`, as the shape will be `later` seconds from now; 0 is now.
    fn near(&self, x: Vec3, later: f32) -> Near;

    /// Whether its surface has a velocity anywhere.
    fn moves(&self) -> bool {
        false
    }

    /// Adds it to the shapes whose cost is known.
    fn count(&self, shapes: &mut Shapes) {
        shapes.others += 1;
    }
}

impl<F: Fn(Vec3) -> (f32, Vec3) + Sync> SignedDistance for F {
    #[inline]
    fn near(&self, x: Vec3, _later: f32) -> Near {
        let (distance, normal) = self(x);
        Near::fixed(distance, normal)
    }
}

/// A shape with Coulomb friction. Restitution is 0. Lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Collider<'a> {
    shape: Shape<'a>,
    friction: f32,
    velocity: Vec3,
}

/// The shapes, each with a signed distance.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape<'a> {
    /// Keeps normal · x ≥ offset; the normal is of unit length.
    HalfSpace { normal: Vec3, offset: f32 },
    /// Keeps |x − centre| ≥ radius.
    Sphere { centre: Vec3, radius: f32 },
    /// Any other.
    Borrowed(Borrowed<'a>),
}

#[derive(Clone, Copy)]
struct Borrowed<'a>(&'a dyn SignedDistance);

impl fmt::Debug for Borrowed<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("&dyn SignedDistance")
    }
}

/// The same one.
impl PartialEq for Borrowed<'_> {
    fn eq(&self, other: &Self) -> bool {
        core::ptr::addr_eq(self.0, other.0)
    }
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
    /// A borrowed shape moves by itself: its frame has the velocity.
    Borrowed,
    /// A box's half lengths are not positive, or their squares not finite.
    Size,
    /// Fewer than two samples an axis, another number of heights than of samples, or a spacing that is not positive.
    Grid,
    /// A height is not finite, or the slope to the next is not.
    Height {
        /// Its place in the list.
        index: u32,
    },
}

impl fmt::Display for ColliderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Self::Normal => "the normal must be finite and not zero",
            Self::Place => "the offset or centre must be finite",
            Self::Radius => "the radius must be positive, and its square finite",
            Self::Friction => "the coefficient of friction must be finite and not negative",
            Self::Velocity => "the velocity must be finite",
            Self::Borrowed => "a borrowed shape moves by its own frame",
            Self::Size => "half the lengths of a box must be positive, and their squares finite",
            Self::Grid => {
                "a height field needs two samples an axis, one height for each, and a positive spacing"
            }
            Self::Height { index } => {
                return write!(f, "height {index}, or the slope there, is not finite");
            }
        };
        f.write_str(text)
    }
}

impl core::error::Error for ColliderError {}

impl<'a> Collider<'a> {
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

    /// Keeps nodes out of a shape that is borrowed. No friction; it moves as it says itself.
    #[must_use]
    pub const fn shape(shape: &'a dyn SignedDistance) -> Self {
        Self {
            shape: Shape::Borrowed(Borrowed(shape)),
            friction: 0.0,
            velocity: Vec3::ZERO,
        }
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

    /// A half-space or sphere whose surface moves at `velocity` (m/s). The shape stays where it is until
    /// [`Self::advance`].
    ///
    /// # Errors
    /// [`ColliderError::Velocity`], [`ColliderError::Borrowed`].
    pub fn with_velocity(self, velocity: Vec3) -> Result<Self, ColliderError> {
        if matches!(self.shape, Shape::Borrowed(_)) {
            Err(ColliderError::Borrowed)
        } else if velocity.is_finite() {
            Ok(Self { velocity, ..self })
        } else {
            Err(ColliderError::Velocity)
        }
    }

    /// Moves the shape on by `time` seconds of its velocity. A borrowed one is advanced by who owns it.
    pub fn advance(&mut self, time: f32) {
        let travel = self.velocity * time;
        match &mut self.shape {
            Shape::HalfSpace { normal, offset } => *offset += normal.dot(travel),
            Shape::Sphere { centre, .. } => *centre += travel,
            Shape::Borrowed(_) => {}
        }
    }

    /// Coefficient of friction.
    #[must_use]
    pub fn friction(&self) -> f32 {
        self.friction
    }

    /// Velocity of the surface, m/s; zero for a borrowed shape, see [`Self::near_after`].
    #[must_use]
    pub fn velocity(&self) -> Vec3 {
        self.velocity
    }

    /// Whether its surface has a velocity anywhere.
    #[must_use]
    pub fn moves(&self) -> bool {
        match self.shape {
            Shape::Borrowed(shape) => shape.0.moves(),
            _ => self.velocity != Vec3::ZERO,
        }
    }

    /// Adds its shape to those that a step's load has.
    pub(crate) fn count(&self, shapes: &mut Shapes) {
        match self.shape {
            Shape::HalfSpace { .. } => {}
            Shape::Sphere { .. } => shapes.spheres += 1,
            Shape::Borrowed(shape) => shape.0.count(shapes),
        }
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
            Shape::Borrowed(shape) => {
                let near = shape.0.near(x, 0.0);
                (near.distance, near.normal)
            }
        }
    }

    /// The speeds that a step of `dt` compares a node at `x` with: see [`crate::constraint`].
    #[inline]
    pub(crate) fn over(&self, x: Vec3, dt: f32) -> Surface {
        let near = self.near_after(x, 0.0);
        let gained = near.acceleration * (0.5 * dt);
        let along = gained - near.normal * gained.dot(near.normal);
        Surface {
            distance: near.distance,
            normal: near.normal,
            before: near.velocity - along,
            velocity: near.velocity + along,
        }
    }

    /// What is near a point `time` seconds later.
    #[inline(never)]
    #[must_use]
    pub fn near_after(&self, x: Vec3, time: f32) -> Near {
        if let Shape::Borrowed(shape) = self.shape {
            return shape.0.near(x, time);
        }
        let (distance, normal) = self.distance(x - self.velocity * time);
        Near {
            velocity: self.velocity,
            ..Near::fixed(distance, normal)
        }
    }
}
