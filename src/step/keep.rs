//! The end of a step: new positions, checked before any is kept.

use super::units::Units;
use crate::body::StateMut;
use crate::constraint::land;
use crate::coupling::hook::Couple;
use crate::element::Sym3;
use crate::rest::Points;
use crate::scene::Scene;
use crate::vector::{copy, project};

/// v⁺ in m/s, and x⁺ from it. Returns the first node that is not finite.
pub(super) fn advance<C: Couple>(
    rest: Points<'_>,
    state: &StateMut<'_>,
    scene: &Scene<'_>,
    units: &Units,
    filter: &[Sym3<f32>],
    couplings: &mut C,
    [x_new, v_new]: [&mut [[f32; 3]]; 2],
) -> Option<u32> {
    let (h, theta) = (units.dt, units.theta);
    let old = state.x.iter().zip(&*state.v).zip(filter);
    let new = x_new.iter_mut().zip(&mut *v_new);
    let touched = couplings.touched(rest.masses).len();
    for (node, (((x, v), p), (x_new, v_new))) in old.zip(new).enumerate() {
        *v_new = v_new.map(|v| v * units.velocity);
        // The constrained part of v(t) is that of v⁺.
        let change = project(p, &core::array::from_fn(|a| v_new[a] - v[a]));
        *x_new = core::array::from_fn(|a| x[a] + h * (v_new[a] - (1.0 - theta) * change[a]));
        if !C::SOME || node < touched {
            land(scene.colliders, h, rest.header.length_unit, x, x_new, v_new);
        }
    }
    couplings.place(h, units.impulse, units.velocity, x_new, v_new);
    // Pins go where they are told, whatever is in the way.
    for pin in scene.pins {
        let node = pin.node as usize;
        if let (Some(x), Some(x_new), Some(v_new)) =
            (state.x.get(node), x_new.get_mut(node), v_new.get_mut(node))
        {
            *v_new = pin.velocity.to_array();
            *x_new = core::array::from_fn(|a| x[a] + h * v_new[a]);
        }
    }
    let mut first = None;
    for (node, (x, v)) in (0_u32..).zip(x_new.iter().zip(&*v_new)) {
        // 0 · c is 0 where c is finite, else NaN.
        let [x, v] = [x, v].map(|c| 0.0 * c[0] + 0.0 * c[1] + 0.0 * c[2]);
        let finite = x + v == 0.0;
        if !finite && first.is_none() {
            first = Some(node);
        }
    }
    first
}

/// Keeps what [`advance`] found.
pub(super) fn commit(state: &mut StateMut<'_>, [x, v]: [&[[f32; 3]]; 2]) {
    let nodes = state.v.len().max(1);
    let mut later = &mut *state.history;
    // From the oldest to the latest, each takes over its successor.
    while let Some(kept) = later.len().checked_sub(nodes) {
        let (newer, oldest) = later.split_at_mut(kept);
        let successor = newer.get(kept.saturating_sub(nodes)..).unwrap_or_default();
        copy(oldest, if kept < nodes { state.v } else { successor });
        later = newer;
    }
    copy(state.v, v);
    copy(state.x, x);
}
