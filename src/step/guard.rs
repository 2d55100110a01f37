//! A step that contact may not add energy to.
//!
//! Let d be what the nodes move by in the step, over h: v⁺ with what putting nodes back on surfaces adds to it. No node keeps more speed
//! than that. So if all moved by a part s of it,
//!
//! ```text
//! E⁺ − E ≤ ½ s² dᵀA d − s hfᵀd − ½ vᵀM v,      A = M + h²K + hD,
//! ```
//!
//! with the rotations at the begin of the step. The right-hand side is convex in s, and not positive at s = 0: what is needed is
//! its positive root.

use super::units::Units;
use crate::body::StateMut;
use crate::constraint::land;
use crate::math::{ratio_or_zero, select, sqrt};
use crate::rest::Points;
use crate::scene::Scene;
use crate::vector::dot;

/// `d`, over the velocity unit, from v⁺ = `v`. Returns whether a node was put back.
pub(super) fn displacements(
    rest: Points<'_>,
    state: &StateMut<'_>,
    scene: &Scene<'_>,
    units: &Units,
    v: &[[f32; 3]],
    d: &mut [[f32; 3]],
) -> bool {
    let mut landed = false;
    let per_step = 1.0 / (units.dt * units.velocity);
    for ((x, v), d) in state.x.iter().zip(v).zip(d) {
        let mut speed = v.map(|v| v * units.velocity);
        let free: [f32; 3] = core::array::from_fn(|a| x[a] + units.dt * speed[a]);
        let mut at = free;
        land(
            scene.colliders,
            units.dt,
            rest.header.length_unit,
            x,
            &mut at,
            &mut speed,
        );
        let lift: [f32; 3] = core::array::from_fn(|a| at[a] - free[a]);
        landed |= (lift[0] != 0.0) | (lift[1] != 0.0) | (lift[2] != 0.0);
        *d = core::array::from_fn(|a| v[a] + lift[a] * per_step);
    }
    landed
}

/// The largest s ≤ 1 that keeps E⁺ − E below ½m(gh)², given d, A d and b = M v + h f.
pub(super) fn share(
    rest: Points<'_>,
    state: &StateMut<'_>,
    scene: &Scene<'_>,
    units: &Units,
    [d, ad, b]: [&[[f32; 3]]; 3],
) -> f32 {
    let (mut along, mut square) = (0.0_f32, 0.0_f32);
    for ((m, v), d) in rest.masses.iter().zip(&*state.v).zip(d) {
        let m = m / units.mass;
        let v = v.map(|v| v / units.velocity);
        along += m * (v[0] * d[0] + v[1] * d[1] + v[2] * d[2]);
        square += m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    let fall = scene.gravity * (units.dt / units.velocity);
    let kinetic = 0.5 * (square + rest.header.total_mass / units.mass * fall.dot(fall));
    let (bend, push) = (dot(d, ad), dot(b, d) - along);
    let rises = 0.5 * bend - push > kinetic;
    let size = sqrt(push * push + 2.0 * bend * kinetic);
    // The form of the two that does not cancel.
    let root = select(
        push > 0.0,
        ratio_or_zero(push + size, bend, 0.0),
        ratio_or_zero(2.0 * kinetic, size - push, 0.0),
    );
    let part = select(root > 0.0, select(root < 1.0, root, 1.0), 0.0);
    select(rises, part, 1.0)
}
