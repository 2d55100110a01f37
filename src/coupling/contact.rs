//! The law of one contact; the formulas are in the module above.

use glam::Vec3;

use super::predict::Prediction;
use super::{Coupling, SOFT};
use crate::math::{Mask, ratio_or_zero, select, sqrt};
use crate::vector::sym_mul;

/// c/a
const HARDNESS: f32 = 32.0;
/// κ
const RETURN: f32 = 0.125;
/// Over all contacts, before they are decided.
pub(super) const SWEEPS: u32 = 4;
/// c_t/a between rigid bodies and colliders, and h²k/a of hard links
pub(super) const STUCK: f32 = 1024.0;

fn part(x: f32) -> f32 {
    select(x < 0.0, -x, 0.0)
}

fn least(a: f32, b: f32) -> f32 {
    select(a < b, a, b)
}

/// The speed along the normal that a contact asks for: out of the depth, or to touch at the end of the step.
fn goal(slot: &Coupling, h: f32) -> f32 {
    let d = slot.gap;
    select(d <= 0.0, RETURN * part(d) / h, -(d / h))
}

/// Writes a into `stiffness`, and no impulse into `impulse`.
#[inline(never)]
pub(super) fn weigh(slot: &mut Coupling, prediction: &Prediction<'_>) {
    slot.stiffness = prediction.mass(slot, Vec3::from_array(slot.normal));
    slot.impulse = [0.0; 3];
}

/// One contact's turn of Gauss and Seidel: N is `impulse[0]`, over the mass unit.
#[inline(never)]
pub(super) fn relax(slot: &mut Coupling, prediction: &mut Prediction<'_>) {
    let n = Vec3::from_array(slot.normal);
    let missing = goal(slot, prediction.step.dt) - n.dot(prediction.of(slot));
    let before = slot.impulse[0];
    let now = before + slot.stiffness * missing;
    let now = select((now > 0.0) & (now < f32::MAX), now, 0.0);
    slot.impulse[0] = now;
    prediction.push(slot, n * (now - before));
}

/// Decides one contact: writes its block, push and stiffness. Returns whether it acts.
#[inline(never)]
pub(super) fn decide(slot: &mut Coupling, prediction: &Prediction<'_>) -> bool {
    let step = prediction.step;
    let n = Vec3::from_array(slot.normal);
    let now = Vec3::from_array(slot.relative(step.v)) - Vec3::from_array(slot.drift);
    let own = slot.impulse[0] * ratio_or_zero(1.0, slot.stiffness, 0.0);
    let predicted = prediction.of(slot) - n * own;
    let (h, d, a) = (step.dt, slot.gap, slot.stiffness);
    let (u, w) = (n.dot(now), n.dot(predicted));
    let hard = HARDNESS * a;
    let closed = d <= 0.0;
    let out = RETURN * part(d) / h;
    let active = (n.dot(n) > 0.0) & (w < goal(slot, h));

    // a (h|w| − d)/d, never beyond c
    let excess = a * (h * part(w) - d);
    let brake = select(excess < hard * d, ratio_or_zero(excess, d, 0.0), hard);
    let normal = select(active, select(closed, hard, brake), 0.0);
    let push = select(active & closed, hard * out, 0.0);

    let pressed = push + least(hard * part(u), 2.0 * a * part(w));
    let met = a * part(w) * ratio_or_zero(normal, a + normal, 0.0);
    let grip = slot.friction * select(active, select(closed, pressed, met), 0.0);
    let slip = now - n * u;
    let ahead = predicted - n * w;
    let speed = sqrt(slip.dot(slip));
    let least_speed = sqrt(ahead.dot(ahead)) - 4.0 * grip * ratio_or_zero(1.0, a, 0.0);
    let speed = select(speed > least_speed, speed, least_speed);
    let mut soft = 0;
    for (rigid, weights) in slot.rigid.into_iter().zip(slot.weights.chunks(4)) {
        let square = weights.iter().fold(0.0, |sum, w| sum + w * w);
        soft |= Mask::of((rigid == SOFT) & (square > 0.0)).pick_u32(1, 0);
    }
    let stuck = select(soft == 1, HARDNESS, STUCK) * a;
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
    slot.acts = 1.0;
    slot.speed = now.to_array();
    active
}

/// Lets go of a contact that pulls at `v`, and if `back`, one that was let go and would push is back. b − A `v` in `r`
/// follows. Returns the change of `acts`. (Links have no normal, and never pull.)
#[inline(never)]
pub(super) fn switch(slot: &mut Coupling, v: &[[f32; 3]], r: &mut [[f32; 3]], back: bool) -> f32 {
    let impulse = Vec3::from_array(slot.whole_impulse(v));
    let pulls = impulse.dot(Vec3::from_array(slot.normal)) < 0.0;
    let pushes = select(back, 1.0, slot.acts);
    let acts = select(pulls, 0.0, pushes);
    let change = acts - slot.acts;
    slot.acts = acts;
    slot.spread(&(impulse * change).to_array(), r);
    change
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
