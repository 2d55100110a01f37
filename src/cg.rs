//! Conjugate gradients with exactly the budgeted number of iterations, in the complement of a
//! space W.
//!
//! The search space is *augmented* by W = span(w₁, …): the residual is made orthogonal to W first,
//! and every direction is kept A-orthogonal to W (Erhel and Guyomarc'h 2000; Fischer 1998 projects
//! in the same way). The iterate is then the Galerkin solution over W plus the Krylov space at every
//! iteration count, 0 included, which is what the energy theorem of the crate's front page needs.
//!
//! A breakdown (residual at rounding level, pᵀAp not positive) makes the update zero from there on,
//! at the same cost. The step length is the exact line search (r·p)/(p·Ap): in exact arithmetic it
//! is the usual (r·z)/(p·Ap), in f32 it cannot raise the error where the projection has turned p
//! into noise.

use crate::element::Sym3;
use crate::math::{Mask, ratio_or_zero, select};
use crate::space::{NOTHING, Space, Translate};
use crate::vector::{advance, keep_or_take, scale_and_add, scale_or_clear};

/// What the solver knows of the system.
pub(crate) trait System {
    /// `out` = A u
    fn apply(&self, u: &[[f32; 3]], out: &mut [[f32; 3]]);
    /// `z` = P B P r, symmetric and positive semidefinite
    fn precondition(&self, r: &[[f32; 3]], z: &mut [[f32; 3]]);
    /// u · P r, for u in the range of P.
    fn dot(&self, u: &[[f32; 3]], r: &[[f32; 3]]) -> f32;
    /// Square of the norm that tells a residual from rounding, given rᵀPBPr.
    fn size(&self, r: &[[f32; 3]], rz: f32) -> f32;
    /// P
    fn filter(&self) -> &[Sym3<f32>];
    /// Whether surfaces may change P during the solve.
    fn touches(&self) -> bool;
    /// Whether couplings may change A and b during the solve.
    fn joins(&self) -> bool;
    /// Takes couplings that pull at `v` out of A and b, and those in again that it took out and that would push.
    /// `r` and W follow, and `v` to the Galerkin solution over W. Returns whether there were any.
    fn switch(
        &mut self,
        v: &mut [[f32; 3]],
        r: &mut [[f32; 3]],
        space: &mut Space<'_, impl Translate>,
    ) -> bool;
    /// If `now`: widens P where a surface would pull, given the whole residual r. Returns whether it did.
    fn release(&mut self, r: &[[f32; 3]], now: bool) -> bool;
    /// If `now`: narrows P where `v` enters a surface, and writes to `g` what `v` lacks. Returns whether it did.
    fn enter(&mut self, v: &[[f32; 3]], g: &mut [[f32; 3]], now: bool) -> bool;
}

/// Residuals below this part (squared) of the right-hand side are rounding: (2⁻²²)², two bits
/// above the last of f32.
const ROUNDING: f32 = 1.0 / (1_u64 << 44) as f32;

/// So many iterations make an iterate that means something to decisions.
const DECIDING: u32 = 3;

/// How often couplings are switched in a solve of so many iterations: first in the middle, then each time in the middle of what is
/// left, so that every decision has time to settle.
pub(crate) const fn switches(iterations: u32, touches: bool) -> u32 {
    let products = iterations.saturating_add(touches as u32);
    match products.div_ceil(2).checked_ilog2() {
        Some(halvings) if iterations >= DECIDING => halvings + 1,
        _ => 0,
    }
}

/// Runs exactly `iterations` iterations from the iterate `v` with residual `r` ⟂ W; `p` and `q` are
/// scratch. `rhs_size` is [`System::size`] of b. Returns after how many iterations the update froze.
///
/// Where there are surfaces, it is one iteration more; with three or more, from the middle on, what pulls is let go. In the middle,
/// what `v` moves into a surface is taken in: if there is something, that iteration brings it back instead, W is given up, and the
/// search begins anew. That is an active-set method with a fixed number of products (for its exact kin see Dostál and
/// Schöberl 2005).
pub(crate) fn solve(
    system: &mut impl System,
    space: &mut Space<'_, impl Translate>,
    iterations: u32,
    rhs_size: f32,
    [v, r, p, q]: [&mut [[f32; 3]]; 4],
) -> u32 {
    let floor = {
        let relative = ROUNDING * rhs_size;
        select(relative > NOTHING, relative, NOTHING)
    };
    let (touches, joins) = (system.touches(), system.joins());
    let decides = iterations >= DECIDING;
    let products = iterations.saturating_add(u32::from(touches));
    let middle = products / 2;
    let mut next = if decides { middle } else { u32::MAX };
    let (mut live, mut updates, mut previous) = (true, 0, 0.0);
    p.fill([0.0; 3]);
    for k in 0..products {
        let (mut released, mut entered) = (false, false);
        if touches {
            released = system.release(r, decides & (k >= middle));
        }
        if joins & (k == next) {
            released |= system.switch(v, r, space);
            next = k + (products - k).div_ceil(2);
        }
        if touches & (k == middle) {
            entered = system.enter(v, q, decides);
            let stays = Mask::of(!entered);
            keep_or_take(p, stays, q);
            space.hold(system.filter(), stays);
        }
        system.precondition(r, q); // z
        space.orthogonalise(q);
        let rz = system.dot(q, r);
        live = ((live | released) & (system.size(r, rz) > floor)) | entered;
        updates += u32::from(live);
        // No previous square, as in the first iteration: β = 0. (To the last direction nothing needs to be conjugate.)
        previous = select(released & (k + 1 < products), 0.0, previous);
        let beta = ratio_or_zero(rz, previous, 0.0);
        previous = select(live & !entered, rz, 0.0);
        if touches & (k == middle) {
            // p stays what brings back.
            scale_or_clear(q, 1.0, Mask::of(!entered));
        }
        scale_and_add(p, select(entered, 1.0, beta), q);
        system.apply(p, q);
        let (rp, pap) = (system.dot(p, r), system.dot(p, q));
        let alpha = select(live, ratio_or_zero(rp, pap, 0.0), 0.0);
        advance(v, r, select(entered, 1.0, alpha), p, q);
    }
    updates
}
