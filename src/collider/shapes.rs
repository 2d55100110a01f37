//! Capsules, boxes, and any shape carried by a frame.

use glam::Vec3;

use super::{ColliderError, Near, SignedDistance};
use crate::cost::Shapes;
use crate::frame::Frame;
use crate::math::{Mask, ratio_or_zero, select, select3, sqrt};

/// Squares of shorter lengths vanish.
const NOTHING: f32 = 1e-18;

/// All points within a radius of a line segment; a ball where its ends are one point. Metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    from: Vec3,
    /// To the other end.
    axis: Vec3,
    /// 1/|axis|², or 0
    inverse_square: f32,
    /// A unit vector across the axis: the way out for points on it.
    across: Vec3,
    radius: f32,
}

impl Capsule {
    /// # Errors
    /// [`ColliderError::Place`], [`ColliderError::Radius`].
    pub fn new(from: Vec3, to: Vec3, radius: f32) -> Result<Self, ColliderError> {
        let axis = to - from;
        let square = axis.dot(axis);
        if !(from.is_finite() && square.is_finite()) {
            return Err(ColliderError::Place);
        }
        if !(radius > 0.0 && (radius * radius).is_finite()) {
            return Err(ColliderError::Radius);
        }
        let least = axis.abs().min_element();
        let across = if axis.y.abs() == least {
            axis.cross(Vec3::Y)
        } else if axis.x.abs() == least {
            axis.cross(Vec3::X)
        } else {
            axis.cross(Vec3::Z)
        };
        let length = sqrt(across.dot(across));
        Ok(Self {
            from,
            axis,
            inverse_square: ratio_or_zero(1.0, square, NOTHING * NOTHING),
            across: if length > NOTHING {
                across / length
            } else {
                Vec3::Y
            },
            radius,
        })
    }
}

impl SignedDistance for Capsule {
    /// To the nearest point of the segment, from + t axis with t = clamp((x − from)·axis / |axis|²).
    #[inline]
    fn near(&self, x: Vec3, _later: f32) -> Near {
        let from = x - self.from;
        let t = from.dot(self.axis) * self.inverse_square;
        let t = select(t > 0.0, t, 0.0);
        let t = select(t < 1.0, t, 1.0);
        let from = from - self.axis * t;
        let length = sqrt(from.dot(from));
        let on_axis = length < NOTHING;
        let scale = 1.0 / select(on_axis, 1.0, length);
        let normal = select3(on_axis, self.across.to_array(), (from * scale).to_array());
        Near::fixed(length - self.radius, Vec3::from_array(normal))
    }

    fn count(&self, shapes: &mut Shapes) {
        shapes.capsules += 1;
    }
}

/// A box along the axes of its frame. Metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    centre: Vec3,
    half: Vec3,
}

impl Cuboid {
    /// From its centre to its faces along x, y, z: `half`.
    ///
    /// # Errors
    /// [`ColliderError::Place`], [`ColliderError::Size`].
    pub fn new(centre: Vec3, half: Vec3) -> Result<Self, ColliderError> {
        if !centre.is_finite() {
            return Err(ColliderError::Place);
        }
        if !(half.cmpgt(Vec3::ZERO).all() && half.dot(half).is_finite()) {
            return Err(ColliderError::Size);
        }
        Ok(Self { centre, half })
    }
}

impl SignedDistance for Cuboid {
    /// With q = |x − centre| − half: outside, the length of q's positive part; inside, the largest of q.
    #[inline]
    fn near(&self, x: Vec3, _later: f32) -> Near {
        let from = x - self.centre;
        let q = from.abs() - self.half;
        let positive = |q: f32| select(q > 0.0, q, 0.0);
        let outside = Vec3::new(positive(q.x), positive(q.y), positive(q.z));
        let length = sqrt(outside.dot(outside));
        let is_inside = length < NOTHING;
        // The face that is nearest from inside; of two that are as near the first.
        let x_wins = (q.x >= q.y) & (q.x >= q.z);
        let y_wins = !x_wins & (q.y >= q.z);
        let one = |wins: bool| Mask::of(wins).keep(1.0);
        let face = Vec3::new(one(x_wins), one(y_wins), one(!x_wins & !y_wins));
        let depth = select(x_wins, q.x, select(y_wins, q.y, q.z));
        let out = outside * (1.0 / select(is_inside, 1.0, length));
        let out = select3(is_inside, face.to_array(), out.to_array());
        let signed = |c: f32, from: f32| select(from < 0.0, -c, c);
        let normal = Vec3::new(
            signed(out[0], from.x),
            signed(out[1], from.y),
            signed(out[2], from.z),
        );
        Near::fixed(select(is_inside, depth, length), normal)
    }

    fn count(&self, shapes: &mut Shapes) {
        shapes.boxes += 1;
    }
}

/// A shape carried by a [`Frame`]: turned, moved, spinning. Its own coordinates are those of the frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed<S> {
    /// In the frame's coordinates.
    pub shape: S,
    /// Where the shape is, and how it moves.
    pub frame: Frame,
}

impl<S> Placed<S> {
    /// A shape in a frame.
    #[must_use]
    pub const fn new(shape: S, frame: Frame) -> Self {
        Self { shape, frame }
    }

    /// Moves it on by `time` seconds.
    pub fn advance(&mut self, time: f32) {
        self.frame.advance(time);
    }
}

impl<S: SignedDistance> SignedDistance for Placed<S> {
    #[inline]
    fn near(&self, x: Vec3, later: f32) -> Near {
        let frame = self.frame.after(later);
        let own = self.shape.near(frame.to_local(x), later);
        let turned = |v: Vec3| frame.rotation() * v;
        Near {
            distance: own.distance,
            normal: turned(own.normal),
            way_out: turned(own.way_out),
            velocity: frame.velocity_at(x) + turned(own.velocity),
            acceleration: frame.acceleration_at(x) + turned(own.acceleration),
        }
    }

    fn moves(&self) -> bool {
        self.frame.moves() || self.shape.moves()
    }

    fn count(&self, shapes: &mut Shapes) {
        shapes.placed += 1;
        self.shape.count(shapes);
    }
}
