//! The guard over contact's energy: see [`Settings::with_energy_guard`](crate::Settings::with_energy_guard).

use super::system::Filtered;
use super::units::Units;
use crate::cg::System;
use crate::constraint;
use crate::coupling::hook::Couple;
use crate::element::Layout;
use crate::lane::Lanes;
use crate::math::{Mask, ratio_or_zero, select};
use crate::space::{Space, Translate};
use crate::vector::{advance, copy, dot};

/// How much of what a step has lost for certain its excess may take back: half of it is left to rounding.
const SHARE: f32 = 0.25;

/// Takes the nodes in that the last iterations have moved into a surface, with the energy that it takes to bring them back, and
/// shortens u = v⁺, beside the translations of what nothing holds, as far as energy asks for it. For every u,
///
/// ```text
/// E⁺ − E = −u·r − ½‖u − v‖²_M − ½h²‖u‖²_K − h‖u‖²_D,   r = b − A u
/// ```
///
/// of which the first term is the solve's excess, and ‖u − v‖² is at least D = ‖v‖² − (u·Mv)²/‖u‖², at every length of u. So
/// energy does not rise where the excess is at most D/4. Shortening by a part t of u takes t |u·r| of it, and from t = −u·r/(u·Au)
/// on, where u·r = 0, all.
pub(super) fn keep_energy<L: Layout, R: Lanes, C: Couple>(
    system: &mut Filtered<'_, L, R, C>,
    space: &mut Space<'_, impl Translate>,
    units: &Units,
    before: &[[f32; 3]],
    [v, r, p, q]: [&mut [[f32; 3]]; 4],
) {
    let entered = system.enter(v, p, true);
    space.hold(system.filter, Mask::of(!entered));
    system.apply(p, q);
    advance(v, r, 1.0, p, q);

    copy(p, v);
    for (q, v) in q.iter_mut().zip(before) {
        *q = v.map(|v| v / units.velocity);
    }
    if let Some(translations) = &space.translations {
        translations.remove(p);
        translations.remove(q);
    }
    let lost = SHARE * lost(system.operator.rest.masses, units.mass, p, q);
    system.apply(p, q);
    let (excess, square) = (-dot(p, r), dot(p, q));
    let along = ratio_or_zero(excess, square, 0.0);
    let along = select(along < 1.0, along, 1.0);
    let part = ratio_or_zero(excess - lost, excess, 0.0);
    let acts = (constraint::held(system.normals) > 0) & (excess > 0.0) & (part > 0.0);
    advance(v, r, -select(acts, along * part, 0.0), p, q);
}

/// D, the square of what u lacks of v whatever its length, by the masses over their unit.
#[inline(never)]
fn lost(masses: &[f32], unit: f32, u: &[[f32; 3]], v: &[[f32; 3]]) -> f32 {
    let [mut uu, mut ud, mut dd] = [0.0; 3];
    for ((m, u), v) in masses.iter().zip(u).zip(v) {
        let m = m / unit;
        for axis in 0..3 {
            let d = v[axis] - u[axis];
            uu += m * u[axis] * u[axis];
            ud += m * u[axis] * d;
            dd += m * d * d;
        }
    }
    let lost = dd - ud * ratio_or_zero(ud, uu, 0.0);
    select(lost > 0.0, lost, 0.0)
}
