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

use crate::math::{ratio_or_zero, select};
use crate::space::{NOTHING, Space, Translate};
use crate::vector::{advance, dot, scale_and_add};

/// What the solver knows of the system.
pub(crate) trait System {
    /// `out` = A u
    fn apply(&self, u: &[[f32; 3]], out: &mut [[f32; 3]]);
    /// `q` = P q, where A p would leave what drowns P r.
    fn confine(&self, q: &mut [[f32; 3]]);
    /// `z` = P B P r, symmetric and positive semidefinite
    fn precondition(&self, r: &[[f32; 3]], z: &mut [[f32; 3]]);
    /// Square of the norm that tells a residual from rounding, given rᵀPBPr.
    fn size(&self, r: &[[f32; 3]], rz: f32) -> f32;
}

/// Residuals below this part (squared) of the right-hand side are rounding: (2⁻²²)², two bits
/// above the last of f32.
const ROUNDING: f32 = 1.0 / (1_u64 << 44) as f32;

/// Runs exactly `iterations` iterations from the iterate `v` with residual `r` ⟂ W; `p` and `q` are
/// scratch. `rhs_size` is [`System::size`] of b. Returns after how many iterations the update froze.
pub(crate) fn solve(
    system: &impl System,
    space: &Space<'_, impl Translate>,
    iterations: u32,
    rhs_size: f32,
    [v, r, p, q]: [&mut [[f32; 3]]; 4],
) -> u32 {
    let floor = {
        let relative = ROUNDING * rhs_size;
        select(relative > NOTHING, relative, NOTHING)
    };
    let (mut live, mut updates, mut previous) = (true, 0, 0.0);
    p.fill([0.0; 3]);
    for _ in 0..iterations {
        system.precondition(r, q); // z
        space.orthogonalise(q);
        let rz = dot(r, q);
        live &= system.size(r, rz) > floor;
        updates += u32::from(live);
        // The first iteration has no previous square: β = 0.
        let beta = ratio_or_zero(rz, previous, 0.0);
        previous = select(live, rz, 0.0);
        scale_and_add(p, beta, q);
        system.apply(p, q);
        system.confine(q);
        let (rp, pap) = (dot(r, p), dot(p, q));
        let alpha = select(live, ratio_or_zero(rp, pap, 0.0), 0.0);
        advance(v, r, alpha, p, q);
    }
    updates
}
