//! What acts on a body from outside: gravity, forces, pins, colliders.

use glam::Vec3;

use crate::collider::Collider;
use crate::constraint::Pin;

/// What acts on a body during a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scene<'a> {
    /// Acceleration of gravity, m/s².
    pub gravity: Vec3,
    /// A force on every node in newtons, or empty for none.
    pub forces: &'a [[f32; 3]],
    /// Nodes whose velocity is prescribed. Of two pins on a node the later counts.
    pub pins: &'a [Pin],
    /// What nodes cannot enter.
    pub colliders: &'a [Collider<'a>],
}

impl Scene<'_> {
    /// Whether anything in it has a velocity of its own.
    pub(crate) fn moves(&self) -> bool {
        self.pins.iter().any(|pin| pin.velocity != Vec3::ZERO)
            || self.colliders.iter().any(Collider::moves)
    }
}
