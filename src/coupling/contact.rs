//! The law of one contact; the formulas are in the module above.

use glam::Vec3;

use super::{CoupleStep, Coupling, SOFT};
use crate::math::{Mask, ratio_or_zero, select, sqrt};
use crate::rigid::Rigid;
use crate::vector::sym_mul;

/// c/a
const HARDNESS: f32 = 32.0;
/// κ
const RETURN: f32 = 0.125;
/// c_t/a between rigid bodies and colliders, and h²k/a of hard links
pub(super) const STUCK: f32 = 1024.0;

/// What a coupling knows of its pair before it is decided.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactStep {
    /// W v(t), relative to the drift, m/s
    pub now: Vec3,
    /// W (v + h f/a), relative to the drift, m/s
    pub predicted: Vec3,
    /// Of the effective mass along the normal (or of any direction, for links), over the mass unit.
    pub mass: f32,
}

/// a v + h f over a, node by node, where nothing forbids it.
#[inline(never)]
fn node_prediction(step: &CoupleStep<'_>, node: usize) -> Option<(Vec3, f32)> {
    let (block, rhs) = (step.blocks.get(node)?, step.rhs.get(node)?);
    let (v, mass) = (step.v.get(node)?, step.masses.get(node)?);
    let (filter, target) = (step.filter.get(node)?, step.targets.get(node)?);
    let a = (block[0] + block[3] + block[5]) * (1.0 / 3.0);
    let v = Vec3::from_array(*v);
    let push = Vec3::from_array(*rhs) * step.velocity_unit - v * (mass / step.mass_unit);
    let w = v + push * ratio_or_zero(1.0, a, 0.0);
    let free = Vec3::from_array(sym_mul(filter, &w.to_array()));
    Some((free + Vec3::from_array(*target), a))
}

impl ContactStep {
    /// Looks at the nodes of a coupling. `along` is the normal, or 0 for the mean over directions.
    #[inline(never)]
    pub fn new(slot: &Coupling, along: Vec3, step: &CoupleStep<'_>, rigids: &[Rigid]) -> Self {
        let drift = Vec3::from_array(slot.drift);
        let (mut now, mut predicted) = (-drift, -drift);
        let mut compliance = 0.0_f32;
        let sides = slot.nodes.chunks(4).zip(slot.weights.chunks(4));
        for ((nodes, weights), rigid) in sides.zip(slot.rigid) {
            let mut at = Vec3::ZERO;
            let mut inverse = 0.0_f32;
            for (&node, &w) in nodes.iter().zip(weights) {
                let node = node as usize;
                let (Some((prediction, a)), Some(v), Some(x), Some(filter)) = (
                    node_prediction(step, node),
                    step.v.get(node),
                    step.x.get(node),
                    step.filter.get(node),
                ) else {
                    continue;
                };
                now += Vec3::from_array(*v) * w;
                predicted += prediction * w;
                at += Vec3::from_array(*x) * w;
                inverse = ratio_or_zero(1.0, a, 0.0);
                let free = along.dot(Vec3::from_array(sym_mul(filter, &along.to_array())));
                let mean = (filter[0] + filter[3] + filter[5]) * (1.0 / 3.0);
                let share = select(along == Vec3::ZERO, mean, free);
                compliance += select(rigid == SOFT, w * w * inverse * share, 0.0);
            }
            if let Some(body) = usize::from(rigid)
                .checked_sub(1)
                .and_then(|k| rigids.get(k))
            {
                // Signed weights: those of the second side sum to −1.
                let sign = weights.iter().sum::<f32>();
                let at = at * select(sign < 0.0, -1.0, 1.0);
                let along = if along == Vec3::ZERO { Vec3::X } else { along };
                compliance += body.compliance(at, along) * inverse;
            }
        }
        Self {
            now,
            predicted,
            mass: ratio_or_zero(1.0, compliance, 0.0),
        }
    }
}

fn part(x: f32) -> f32 {
    select(x < 0.0, -x, 0.0)
}

fn least(a: f32, b: f32) -> f32 {
    select(a < b, a, b)
}

/// Decides one contact: writes its block, push and stiffness. Returns whether it acts.
#[inline(never)]
pub(super) fn decide(slot: &mut Coupling, step: &CoupleStep<'_>, rigids: &[Rigid]) -> bool {
    let n = Vec3::from_array(slot.normal);
    let pair = ContactStep::new(slot, n, step, rigids);
    let (h, d, a) = (step.dt, slot.gap, pair.mass);
    let (u, w) = (n.dot(pair.now), n.dot(pair.predicted));
    let hard = HARDNESS * a;
    let closed = d <= 0.0;
    let depth = part(d);
    let out = RETURN * depth / h;
    let active = (n != Vec3::ZERO) & select_bool(closed, w < out, d + h * w < 0.0);

    // a (h|w| − d)/d, never beyond c
    let excess = a * (h * part(w) - d);
    let brake = select(excess < hard * d, ratio_or_zero(excess, d, 0.0), hard);
    let normal = select(active, select(closed, hard, brake), 0.0);
    let push = select(active & closed, hard * out, 0.0);

    let pressed = push + least(hard * part(u), 2.0 * a * part(w));
    let met = a * part(w) * ratio_or_zero(normal, a + normal, 0.0);
    let grip = slot.friction * select(active, select(closed, pressed, met), 0.0);
    let slip = pair.now - n * u;
    let ahead = pair.predicted - n * w;
    let speed = sqrt(slip.dot(slip));
    let least_speed = sqrt(ahead.dot(ahead)) - 4.0 * grip * ratio_or_zero(1.0, a, 0.0);
    let speed = select(speed > least_speed, speed, least_speed);
    let rigid_only = slot.rigid.iter().zip(slot.weights.chunks(4));
    let soft = rigid_only.fold(false, |soft, (&rigid, w)| {
        soft | ((rigid == SOFT) & w.iter().any(|&w| w != 0.0))
    });
    let stuck = select(soft, HARDNESS, STUCK) * a;
    let tangent = select(
        grip < stuck * speed,
        ratio_or_zero(grip, speed, 0.0),
        select(grip > 0.0, stuck, 0.0),
    );

    let across = normal - tangent;
    slot.block = [
        tangent + across * n.x * n.x,
        across * n.x * n.y,
        across * n.x * n.z,
        tangent + across * n.y * n.y,
        across * n.y * n.z,
        tangent + across * n.z * n.z,
    ];
    let drift = sym_mul(&slot.block, &slot.drift);
    let per_unit = 1.0 / step.velocity_unit;
    slot.push = (Vec3::from_array(drift) + n * push)
        .to_array()
        .map(|j| j * per_unit);
    slot.stiffness = RETURN * hard * step.mass_unit / h / h;
    slot.speed = pair.now.to_array();
    active
}

fn select_bool(condition: bool, yes: bool, no: bool) -> bool {
    (condition & yes) | (!condition & no)
}

/// Zero where it would not be finite: a slot that cannot be computed does nothing.
pub(super) fn keep_finite(slot: &mut Coupling) {
    let sum = slot
        .block
        .iter()
        .chain(&slot.push)
        .fold(0.0, |sum, x| sum + 0.0 * x);
    let good = Mask::of(sum == 0.0);
    for x in slot.block.iter_mut().chain(&mut slot.push) {
        *x = good.keep(*x);
    }
}
