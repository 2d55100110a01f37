//! Pins and contact as one projection filter (Baraff and Witkin, SIGGRAPH 1998, section 5.3).
//!
//! Each node has a symmetric projection P_i: the identity where it is free, I − nnᵀ where it slides
//! on a surface, 0 where it is held. The solver searches in the range of P only; the rest of a
//! node's velocity is its *target* c_i. Free nodes pay the same, so the cost does not depend on who
//! touches what.
//!
//! **Contact** is decided before the solve, in one pass over nodes and colliders, from the right-hand
//! side b = M v + h f: w_i = b_i/m_i is the velocity that node i would take by itself. With signed
//! distance d, normal n, and the surface's velocity s,
//!
//! ```text
//! N = −(w − s)·n − d/h          impulse (over m_i) that would keep the node out
//! active:  N > 0, and either touching (d ≤ margin) or bound to touch: d + h (v − s + h g)·n < 0
//! normal target:  c·n = s·n − d/h
//! |w_t − s_t| < μN: it sticks, c_t = s_t;   else it slides and −μN (w_t − s_t)/|w_t − s_t| acts on it
//! ```
//!
//! In a body at rest or in steady sliding, h f holds what the constraint held in the step before, so
//! N is that step's constraint impulse: Coulomb's law is exact there without any memory, a node
//! that is pulled (N < 0) is released at the next step, and a state needs no contact history.
//!
//! Nodes that the solve moves into a surface nevertheless are put back on it after it ([`land`]),
//! so no node ends a step inside: up to rounding of its coordinates for one collider, for several
//! up to what their correction in turn leaves where they meet at an acute angle.

use glam::Vec3;

use crate::collider::Collider;
use crate::element::Sym3;
use crate::math::{ratio_or_zero, select, select3, sqrt};
use crate::vector::sym_mul;

/// A node whose velocity is prescribed (m/s); zero holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pin {
    /// The node.
    pub node: u32,
    /// Its velocity, m/s.
    pub velocity: Vec3,
}

impl Pin {
    /// Holds a node where it is.
    #[must_use]
    pub fn held(node: u32) -> Self {
        Self { node, velocity: Vec3::ZERO }
    }
}

/// P = I
pub const FREE: Sym3<f32> = [1.0, 0.0, 0.0, 1.0, 0.0, 1.0];
const HELD: Sym3<f32> = [0.0; 6];

/// A node counts as touching within this part of the body's length unit.
const TOUCHING: f32 = 1.0 / 4096.0;

/// What contact needs to know of a body and its step. SI units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactStep<'a> {
    pub masses: &'a [f32],
    pub x: &'a [[f32; 3]],
    pub v: &'a [[f32; 3]],
    pub gravity: Vec3,
    pub dt: f32,
    pub length_unit: f32,
    /// Impulse of one unit of the right-hand side, N·s.
    pub impulse_unit: f32,
}

/// Holds the pinned nodes: P = 0 there, and their velocity (m/s) is the target.
pub(crate) fn pin(pins: &[Pin], filter: &mut [Sym3<f32>], targets: &mut [[f32; 3]]) {
    filter.fill(FREE);
    targets.fill([0.0; 3]);
    for pin in pins {
        let node = pin.node as usize;
        if let (Some(p), Some(c)) = (filter.get_mut(node), targets.get_mut(node)) {
            *p = HELD;
            *c = pin.velocity.to_array();
        }
    }
}

/// Decides who is in contact and who slides; friction goes to `rhs`. Returns the number of contacts.
pub(crate) fn touch(
    colliders: &[Collider],
    step: &ContactStep<'_>,
    rhs: &mut [[f32; 3]],
    filter: &mut [Sym3<f32>],
    targets: &mut [[f32; 3]],
) -> u32 {
    let margin = TOUCHING * step.length_unit;
    let per_dt = 1.0 / step.dt;
    let mut contacts = 0;
    let nodes = rhs.iter_mut().zip(filter).zip(targets).zip(step.masses).zip(step.x).zip(step.v);
    for (((((rhs, p), c), &mass), &x), &v) in nodes {
        let (x, v) = (Vec3::from_array(x), Vec3::from_array(v));
        let to_impulse = mass / step.impulse_unit;
        for collider in colliders {
            let (d, n) = collider.distance(x);
            let w = Vec3::from_array(*rhs) / to_impulse - collider.velocity();
            let push = -(w.dot(n) + d * per_dt); // N
            let meeting = d + step.dt * (v - collider.velocity() + step.gravity * step.dt).dot(n) < 0.0;
            // What earlier constraints leave of the normal.
            let free = sym_mul(p, &n.to_array());
            let share = n.dot(Vec3::from_array(free));
            let active = (push > 0.0) & ((d <= margin) | meeting) & (share > 1e-3);
            contacts += u32::from(active);
            constrain(active, p, c, &free, share, n, collider.velocity().dot(n) - d * per_dt);

            let slip = sym_mul(p, &w.to_array()); // w_t − s_t
            let speed = sqrt(slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2]);
            let grip = collider.friction() * push; // μN
            let sticks = active & (speed < grip);
            let slides = active & !(speed < grip);
            let rub = select(slides, to_impulse * ratio_or_zero(grip, speed, 0.0), 0.0);
            for axis in 0..3 {
                rhs[axis] -= rub * slip[axis];
            }
            let s = collider.velocity().to_array();
            let hold = sym_mul(p, &[s[0] - c[0], s[1] - c[1], s[2] - c[2]]);
            *c = select3(sticks, [c[0] + hold[0], c[1] + hold[1], c[2] + hold[2]], *c);
            for entry in p.iter_mut() {
                *entry = select(sticks, 0.0, *entry);
            }
        }
    }
    contacts
}

/// If `active`: c·n = target from now on, and P loses the direction `free` = P n (n·P n = `share`).
#[inline]
fn constrain(
    active: bool,
    p: &mut Sym3<f32>,
    c: &mut [f32; 3],
    free: &[f32; 3],
    share: f32,
    n: Vec3,
    target: f32,
) {
    let inverse = select(active, ratio_or_zero(1.0, share, 0.0), 0.0);
    let missing = (target - n.dot(Vec3::from_array(*c))) * inverse;
    *c = select3(active, [c[0] + missing * free[0], c[1] + missing * free[1], c[2] + missing * free[2]], *c);
    let [x, y, z] = *free;
    let outer = [x * x, x * y, x * z, y * y, y * z, z * z];
    for (entry, product) in p.iter_mut().zip(outer) {
        *entry -= inverse * product;
    }
}

/// Puts one node back on every collider that it would enter, and takes the speed of entering from
/// it. A node that started the step inside leaves it without the speed of being pushed out.
pub(crate) fn land(
    colliders: &[Collider],
    margin_unit: f32,
    x_old: &[f32; 3],
    x: &mut [f32; 3],
    v: &mut [f32; 3],
) {
    let margin = TOUCHING * margin_unit;
    for collider in colliders {
        let was_inside = collider.distance(Vec3::from_array(*x_old)).0 < -margin;
        let (mut at, mut speed) = (Vec3::from_array(*x), Vec3::from_array(*v));
        let (d, n) = collider.distance(at);
        let enters = d < 0.0;
        at -= n * select(enters, d, 0.0);
        let normal_speed = (speed - collider.velocity()).dot(n);
        let stop = (enters & (normal_speed < 0.0)) | (was_inside & (normal_speed > 0.0));
        speed -= n * select(stop, normal_speed, 0.0);
        (*x, *v) = (at.to_array(), speed.to_array());
    }
}
