//! Attachments and springs.

use glam::Vec3;

use super::contact::STUCK;
use super::predict::Prediction;
use super::{Coupling, SOFT};
use crate::math::select;
use crate::rigid::Rigid;
use crate::vector::sym_mul;

/// A spring with a dashpot that draws two points, or a point and a moving target, together (rest length 0).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    nodes: [u32; 8],
    weights: [f32; 8],
    target: Vec3,
    velocity: Vec3,
    stiffness: f32,
    damping: f32,
}

impl Link {
    /// Between node `a` and node `b`. Hard until it is [`soft`](Self::soft).
    #[must_use]
    pub fn nodes(a: u32, b: u32) -> Self {
        Self::points([(a, 1.0); 1], [(b, 1.0); 1])
    }

    /// Between two points, each given by up to four nodes and weights that sum to 1 (barycentric ones; those of
    /// a rigid body's point are [`point_of`](Self::point_of)).
    #[must_use]
    pub fn points<const A: usize, const B: usize>(a: [(u32, f32); A], b: [(u32, f32); B]) -> Self {
        let mut out = Self::to_target(a, Vec3::ZERO, Vec3::ZERO);
        let second = out.nodes.iter_mut().zip(&mut out.weights).skip(4);
        for ((node, weight), (of, w)) in second.zip(b) {
            (*node, *weight) = (of, -w);
        }
        out
    }

    /// Between a point and `target` (metres, now), which moves at `velocity` (m/s): a mouse that drags.
    #[must_use]
    pub fn to_target<const A: usize>(a: [(u32, f32); A], target: Vec3, velocity: Vec3) -> Self {
        let mut out = Self {
            nodes: [0; 8],
            weights: [0.0; 8],
            target,
            velocity,
            stiffness: f32::INFINITY,
            damping: 0.0,
        };
        let first = out.nodes.iter_mut().zip(&mut out.weights).take(4);
        for ((node, weight), (of, w)) in first.zip(a) {
            (*node, *weight) = (of, w);
        }
        out
    }

    /// Nodes and weights of a point of a rigid body, given where it is now.
    #[must_use]
    pub fn point_of(body: &Rigid, x: &[[f32; 3]], point: Vec3) -> [(u32, f32); 4] {
        let mut body = *body;
        body.locate(x);
        let weights = body.weights(point);
        core::array::from_fn(|k| (body.first.wrapping_add(k as u32), weights[k]))
    }

    /// With this stiffness (N/m) and damping (N·s/m); both finite and not negative, else it does nothing.
    #[must_use]
    pub fn soft(self, stiffness: f32, damping: f32) -> Self {
        Self {
            stiffness,
            damping,
            ..self
        }
    }

    /// Moves the target.
    #[must_use]
    pub fn with_target(self, target: Vec3, velocity: Vec3) -> Self {
        Self {
            target,
            velocity,
            ..self
        }
    }

    pub(super) fn names(&self) -> impl Iterator<Item = u32> {
        self.nodes.into_iter()
    }

    pub(super) fn is_anchored(&self) -> bool {
        let [.., a, b, c, d] = self.weights;
        a == 0.0 && b == 0.0 && c == 0.0 && d == 0.0
    }

    /// Writes it into a slot, decided.
    #[inline(never)]
    pub(super) fn decide(&self, prediction: &Prediction<'_>) -> Coupling {
        let (step, rigids) = (prediction.step, prediction.rigids);
        let rigid_of = |node: u32| {
            let found = (1_u16..).zip(rigids).find(|(_, r)| r.first == node);
            found.map_or(SOFT, |(at, _)| at)
        };
        let anchored = self.is_anchored();
        let mut slot = Coupling {
            nodes: self.nodes,
            weights: self.weights,
            acts: 1.0,
            rigid: [rigid_of(self.nodes[0]), rigid_of(self.nodes[4])],
            drift: self.velocity.to_array(),
            ..Coupling::EMPTY
        };
        if anchored {
            slot.rigid[1] = SOFT;
        }
        let mass = prediction.mass(&slot, Vec3::ZERO);
        let h = step.dt;
        let hard = self.stiffness == f32::INFINITY;
        let per_mass = 1.0 / step.mass_unit;
        let spring = select(hard, STUCK * mass, h * h * self.stiffness * per_mass);
        let damper = h * self.damping * per_mass;
        let good = (spring >= 0.0) & (damper >= 0.0);
        let b = select(good, spring + damper, 0.0);
        let apart = Vec3::from_array(slot.relative(step.x)) - self.target;
        let pull = apart * (select(good, spring, 0.0) / h);
        slot.block = [b, 0.0, 0.0, b, 0.0, b];
        let drift = Vec3::from_array(sym_mul(&slot.block, &slot.drift));
        slot.push = ((drift - pull) * (1.0 / step.velocity_unit)).to_array();
        slot.stiffness = spring * step.mass_unit / h / h;
        slot.gap = apart.length_squared();
        let now = Vec3::from_array(slot.relative(step.v)) - self.velocity;
        slot.speed = now.to_array();
        slot
    }
}
