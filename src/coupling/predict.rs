//! What nodes would do by themselves, and what contacts make of it: the prediction that contacts are decided by.
//!
//! One row of A v⁺ = b a node, its neighbours as they are at v(t): v̂ = v + (b − A v)/a with a = tr(A_kk)/3. Then
//! projected Gauss–Seidel over the contacts, on A's diagonal: each takes the impulse N ≥ 0 that it needs beside the
//! others' to bring the pair to the speed it asks for.

use glam::Vec3;

use super::{CoupleStep, Coupling, SOFT};
use crate::math::{Mask, ratio_or_zero, select, select3};
use crate::rigid::Rigid;
use crate::vector::sym_mul;

/// v̂, and what moves it.
pub(super) struct Prediction<'a> {
    pub step: &'a CoupleStep<'a>,
    pub rigids: &'a [Rigid],
    /// m/s
    pub velocities: &'a mut [[f32; 3]],
}

impl<'a> Prediction<'a> {
    /// Without contacts. `kept` is A v(t), in SI units but for A; it gets v̂.
    #[inline(never)]
    pub fn new(step: &'a CoupleStep<'a>, rigids: &'a [Rigid], kept: &'a mut [[f32; 3]]) -> Self {
        let system = step.blocks.iter().zip(step.rhs).zip(step.v);
        let constraint = step.filter.iter().zip(step.targets);
        for ((kept, ((block, rhs), v)), (filter, target)) in
            kept.iter_mut().zip(system).zip(constraint)
        {
            let push = Vec3::from_array(*rhs) * step.velocity_unit - Vec3::from_array(*kept);
            let w = Vec3::from_array(*v) + push * inverse(block);
            let free = Vec3::from_array(sym_mul(filter, &w.to_array()));
            *kept = (free + Vec3::from_array(*target)).to_array();
        }
        Self {
            step,
            rigids,
            velocities: kept,
        }
    }

    /// 1/a of a node, and P there.
    fn compliance(&self, node: u32) -> (f32, [f32; 6]) {
        let at = node as usize;
        let own = self.step.blocks.get(at).map_or(0.0, inverse);
        (own, self.step.filter.get(at).copied().unwrap_or_default())
    }

    /// The effective mass of a pair, over the mass unit. `along` is a unit normal, or 0 for the mean over directions.
    #[inline(never)]
    pub fn mass(&self, slot: &Coupling, along: Vec3) -> f32 {
        let anyhow = along.dot(along) == 0.0;
        let mut compliance = 0.0_f32;
        let sides = slot.nodes.chunks(4).zip(slot.weights.chunks(4));
        for ((nodes, weights), rigid) in sides.zip(slot.rigid) {
            let soft = rigid == SOFT;
            let (mut at, mut last) = (Vec3::ZERO, 0.0);
            for (&node, &w) in nodes.iter().zip(weights) {
                let (inverse, filter) = self.compliance(node);
                let x = self.step.x.get(node as usize).copied().unwrap_or_default();
                let free = along.dot(Vec3::from_array(sym_mul(&filter, &along.to_array())));
                let mean = (filter[0] + filter[3] + filter[5]) * (1.0 / 3.0);
                let share = select(anyhow, mean, free);
                compliance += select(soft, w * w * inverse * share, 0.0);
                at += Vec3::from_array(x) * w;
                last = inverse;
            }
            // A soft side asks the first body, too, and takes nothing of it.
            if let Some(body) = self.body(rigid) {
                // Signed weights: those of the second side sum to −1.
                let sign = weights.iter().fold(0.0, |sum, w| sum + w);
                let at = at * select(sign < 0.0, -1.0, 1.0);
                let along = select3(anyhow, Vec3::X.to_array(), along.to_array());
                let own = body.compliance(at, Vec3::from_array(along)) * last;
                compliance += select(soft, 0.0, own);
            }
        }
        ratio_or_zero(1.0, compliance, 0.0)
    }

    /// A rigid side's, else the first.
    fn body(&self, rigid: u16) -> Option<&'a Rigid> {
        let place = Mask::of(rigid == SOFT).pick_u32(1, u32::from(rigid));
        self.rigids.get((place as usize).wrapping_sub(1))
    }

    /// v̂ += D⁻¹ Wᵀ `impulse` (m/s times the mass unit), on what the nodes and bodies may do.
    #[inline(never)]
    pub fn push(&mut self, slot: &Coupling, impulse: Vec3) {
        let sides = slot.nodes.as_chunks::<4>().0.iter();
        let sides = sides.zip(slot.weights.as_chunks::<4>().0);
        for ((nodes, weights), rigid) in sides.zip(slot.rigid) {
            let mut change = [[0.0; 3]; 4];
            for ((change, &node), &w) in change.iter_mut().zip(nodes).zip(weights) {
                let (inverse, filter) = self.compliance(node);
                *change = sym_mul(&filter, &(impulse * (w * inverse)).to_array());
            }
            let mut of_body = change;
            if let Some(body) = self.body(rigid) {
                body.project_four(&mut of_body);
            }
            for ((soft, stiff), &node) in change.iter().zip(&of_body).zip(nodes) {
                if let Some(v) = self.velocities.get_mut(node as usize) {
                    let change = select3(rigid == SOFT, *soft, *stiff);
                    *v = core::array::from_fn(|axis| v[axis] + change[axis]);
                }
            }
        }
    }

    /// W v̂, relative to the drift, m/s
    pub fn of(&self, slot: &Coupling) -> Vec3 {
        Vec3::from_array(slot.relative(self.velocities)) - Vec3::from_array(slot.drift)
    }
}

/// 1/a
fn inverse(block: &[f32; 6]) -> f32 {
    ratio_or_zero(1.0, (block[0] + block[3] + block[5]) * (1.0 / 3.0), 0.0)
}
