//! Frames that move as rigid bodies do, by prescribed velocity and spin: they carry colliders and pins.
//!
//! In a time t a frame with velocity v and spin ω moves its origin by vt and turns by the angle |ω|t about ω.
//! With the half angle's vector w = ωt/2 and q = w·w, the turn is the quaternion
//!
//! ```text
//! (D, N w),  tan √q / √q ≈ N/D,  N = 945 − 105 q + q²,  D = 945 − 420 q + 15 q²
//! E = [(D² − N²q) I + 2N² w wᵀ + 2DN [w]×] / (D² + N²q)
//! ```
//!
//! (the fifth convergent of Lambert's continued fraction of the tangent). E is a rotation for every q, to rounding;
//! its angle is off by less than 1e-6 rad up to 2 rad a step, and takes + − × ÷ only.

use core::fmt;

use glam::{Mat3, Vec3};

use crate::constraint::Pin;
use crate::math::sqrt;

/// A rigid frame, x = origin + rotation · p, and how it moves. Lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    origin: Vec3,
    rotation: Mat3,
    velocity: Vec3,
    spin: Vec3,
}

/// What is wrong with a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FrameError {
    /// The origin is not finite.
    Origin,
    /// The matrix is no rotation.
    Rotation,
    /// The velocity is not finite.
    Velocity,
    /// The spin is not finite, or its square is not.
    Spin,
}

impl fmt::Display for FrameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Origin => "the origin must be finite",
            Self::Rotation => "the matrix must be a rotation",
            Self::Velocity => "the velocity must be finite",
            Self::Spin => "the spin must be finite, and its square",
        })
    }
}

impl core::error::Error for FrameError {}

impl Frame {
    /// At the origin of the world, along its axes, at rest.
    pub const WORLD: Self = Self {
        origin: Vec3::ZERO,
        rotation: Mat3::IDENTITY,
        velocity: Vec3::ZERO,
        spin: Vec3::ZERO,
    };

    /// At rest. The matrix may be off from a rotation by rounding, up to 1e-3; the frame's is not.
    ///
    /// # Errors
    /// [`FrameError::Origin`], [`FrameError::Rotation`].
    pub fn new(origin: Vec3, rotation: Mat3) -> Result<Self, FrameError> {
        if !origin.is_finite() {
            return Err(FrameError::Origin);
        }
        let (x, y, z) = (rotation.x_axis, rotation.y_axis, rotation.z_axis);
        let off = [
            x.dot(x) - 1.0,
            y.dot(y) - 1.0,
            z.dot(z) - 1.0,
            x.dot(y),
            y.dot(z),
            z.dot(x),
        ];
        // False for NaN.
        let orthonormal = off.iter().all(|c| c.abs() < 1e-3);
        if !(orthonormal && x.cross(y).dot(z) > 0.0) {
            return Err(FrameError::Rotation);
        }
        Ok(Self {
            origin,
            rotation: orthonormalised(rotation),
            ..Self::WORLD
        })
    }

    /// Whose origin moves at `velocity`, m/s.
    ///
    /// # Errors
    /// [`FrameError::Velocity`].
    pub fn with_velocity(self, velocity: Vec3) -> Result<Self, FrameError> {
        if velocity.is_finite() {
            Ok(Self { velocity, ..self })
        } else {
            Err(FrameError::Velocity)
        }
    }

    /// Which turns about its origin, rad/s along the axis.
    ///
    /// # Errors
    /// [`FrameError::Spin`].
    pub fn with_spin(self, spin: Vec3) -> Result<Self, FrameError> {
        if spin.dot(spin).is_finite() {
            Ok(Self { spin, ..self })
        } else {
            Err(FrameError::Spin)
        }
    }

    /// Where it is.
    #[must_use]
    pub fn origin(&self) -> Vec3 {
        self.origin
    }

    /// Its axes, as columns.
    #[must_use]
    pub fn rotation(&self) -> Mat3 {
        self.rotation
    }

    /// Velocity of its origin, m/s.
    #[must_use]
    pub fn velocity(&self) -> Vec3 {
        self.velocity
    }

    /// Rad/s along the axis.
    #[must_use]
    pub fn spin(&self) -> Vec3 {
        self.spin
    }

    /// Whether it moves at all.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.velocity != Vec3::ZERO || self.spin != Vec3::ZERO
    }

    /// Moves it on by `time` seconds.
    pub fn advance(&mut self, time: f32) {
        *self = self.after(time);
        self.rotation = orthonormalised(self.rotation);
    }

    /// Where it will be `time` seconds later.
    #[inline]
    #[must_use]
    pub fn after(&self, time: f32) -> Self {
        Self {
            origin: self.origin + self.velocity * time,
            rotation: turn(self.spin, time) * self.rotation,
            ..*self
        }
    }

    /// The point of the world that is at `p` in the frame.
    #[inline]
    #[must_use]
    pub fn to_world(&self, p: Vec3) -> Vec3 {
        self.origin + self.rotation * p
    }

    /// The point of the frame that is at `x` in the world.
    #[inline]
    #[must_use]
    pub fn to_local(&self, x: Vec3) -> Vec3 {
        let from = x - self.origin;
        let r = &self.rotation;
        Vec3::new(r.x_axis.dot(from), r.y_axis.dot(from), r.z_axis.dot(from))
    }

    /// v + ω × (x − origin), m/s
    #[inline]
    #[must_use]
    pub fn velocity_at(&self, x: Vec3) -> Vec3 {
        self.velocity + self.spin.cross(x - self.origin)
    }

    /// ω × (ω × (x − origin)), m/s²
    #[inline]
    #[must_use]
    pub fn acceleration_at(&self, x: Vec3) -> Vec3 {
        self.spin.cross(self.spin.cross(x - self.origin))
    }

    /// Writes where the pinned nodes are in the frame, for [`Self::carry`]. `x` are the body's positions. A pin of a
    /// node that does not exist gets zero.
    pub fn hold(&self, pins: &[Pin], x: &[[f32; 3]], local: &mut [[f32; 3]]) {
        for (local, pin) in local.iter_mut().zip(pins) {
            let x = x.get(pin.node as usize).copied().map(Vec3::from_array);
            *local = x.map_or([0.0; 3], |x| self.to_local(x).to_array());
        }
    }

    /// Gives pins the velocities (m/s) that take their nodes in one step of `dt` seconds from `x` to where they are in
    /// the frame by then: x + dt v = frame(dt) · local. They follow to rounding however long they are carried, as the
    /// target does not come from where they are.
    pub fn carry(&self, local: &[[f32; 3]], x: &[[f32; 3]], dt: f32, pins: &mut [Pin]) {
        let later = self.after(dt);
        for (pin, local) in pins.iter_mut().zip(local) {
            if let Some(x) = x.get(pin.node as usize) {
                let target = later.to_world(Vec3::from_array(*local));
                pin.velocity = (target - Vec3::from_array(*x)) / dt;
            }
        }
    }
}

/// E
#[inline]
fn turn(spin: Vec3, time: f32) -> Mat3 {
    let w = spin * (0.5 * time);
    let q = w.dot(w);
    // Both by (1 + q)²: nothing overflows.
    let s = 1.0 / (1.0 + q);
    let p = q * s;
    let n = 945.0 * (s * s) - 105.0 * (p * s) + p * p;
    let d = 945.0 * (s * s) - 420.0 * (p * s) + 15.0 * (p * p);
    let scale = 1.0 / (d * d + n * n * q);
    let same = (d * d - n * n * q) * scale;
    let outer = w * (2.0 * n * n * scale);
    let skew = w * (2.0 * d * n * scale);
    Mat3::from_cols(
        w * outer.x + Vec3::new(same, skew.z, -skew.y),
        w * outer.y + Vec3::new(-skew.z, same, skew.x),
        w * outer.z + Vec3::new(skew.y, -skew.x, same),
    )
}

/// Gram and Schmidt, for columns that are nearly so.
fn orthonormalised(m: Mat3) -> Mat3 {
    let unit = |v: Vec3| v / sqrt(v.dot(v));
    let x = unit(m.x_axis);
    let y = unit(m.y_axis - x * x.dot(m.y_axis));
    Mat3::from_cols(x, y, x.cross(y))
}
