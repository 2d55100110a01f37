//! The system of one step as the solver sees it, in the range of the filter P.

use crate::cg::System;
use crate::collider::Collider;
use crate::constraint::{self, ContactStep};
use crate::coupling::hook::Couple;
use crate::element::{Layout, Sym3};
use crate::lane::Lanes;
use crate::math::{ratio_or_zero, select, sqrt};
use crate::operator::Operator;
use crate::preconditioner::Prepared;
use crate::space::{Space, Translate};
use crate::vector::{self, dot, multiply_blocks, sym_mul};

/// The system as the solver sees it.
pub(super) struct Filtered<'a, L: Layout, R, C> {
    pub operator: &'a Operator<'a, L>,
    pub couplings: &'a mut C,
    pub preconditioner: Prepared<'a>,
    /// P
    pub filter: &'a mut [Sym3<f32>],
    pub colliders: &'a [Collider<'a>],
    pub contact: &'a ContactStep<'a>,
    /// Σ n of the colliders that hold a node; none where there are no colliders.
    pub normals: &'a mut [[f32; 3]],
    pub lanes: core::marker::PhantomData<R>,
}

impl<L: Layout, R: Lanes, C: Couple> System for Filtered<'_, L, R, C> {
    fn apply(&self, u: &[[f32; 3]], out: &mut [[f32; 3]]) {
        self.operator.apply::<R>(u, out);
        self.couplings.apply(u, out);
        self.couplings.project(out);
    }
    #[inline(always)]
    fn precondition(&self, r: &[[f32; 3]], z: &mut [[f32; 3]]) {
        self.preconditioner.apply(self.filter, r, z);
        self.couplings.project(z);
    }
    /// Impulses of contacts are of b's size, and a u whose normal is not along an axis lets a rounding of them
    /// through. Pins have an exact P.
    #[inline(never)]
    fn dot(&self, u: &[[f32; 3]], r: &[[f32; 3]]) -> f32 {
        if self.colliders.is_empty() {
            dot(u, r)
        } else {
            filtered_dot(self.filter, u, r)
        }
    }
    fn size(&self, r: &[[f32; 3]], rz: f32) -> f32 {
        if self.preconditioner.is_cheap() {
            rz
        } else {
            filtered_square(self.filter, r)
        }
    }
    fn filter(&self) -> &[Sym3<f32>] {
        self.filter
    }
    fn touches(&self) -> bool {
        !self.colliders.is_empty()
    }
    fn joins(&self) -> bool {
        C::SOME
    }
    fn switch(
        &mut self,
        v: &mut [[f32; 3]],
        r: &mut [[f32; 3]],
        space: &mut Space<'_, impl Translate>,
    ) -> bool {
        let stored = [&mut *space.vectors, &mut *space.products];
        let switched = self.couplings.switch(v, r, stored, true);
        space.settle(self, v, r);
        switched
    }
    fn release(&mut self, r: &[[f32; 3]], now: bool) -> bool {
        constraint::release(now, r, self.filter, self.normals)
    }
    fn enter(&mut self, v: &[[f32; 3]], g: &mut [[f32; 3]], now: bool) -> bool {
        constraint::enter(
            now,
            self.colliders,
            self.contact,
            v,
            self.filter,
            self.normals,
            g,
        )
    }
}

impl<L: Layout, R: Lanes, C: Couple> Filtered<'_, L, R, C> {
    /// [`System::size`] of any residual; `z` is scratch.
    #[inline(always)]
    pub(super) fn size_of(&self, r: &[[f32; 3]], z: &mut [[f32; 3]]) -> f32 {
        let rz = if self.preconditioner.is_cheap() {
            self.precondition(r, z);
            self.dot(z, r)
        } else {
            0.0
        };
        self.size(r, rz)
    }
}

/// ‖P u‖
pub(super) fn filtered_norm(filter: &[Sym3<f32>], u: &[[f32; 3]]) -> f32 {
    sqrt(filtered_square(filter, u))
}

/// ‖P u‖²: not u · P u, which rounding can make negative.
#[inline(never)]
fn filtered_square(filter: &[Sym3<f32>], u: &[[f32; 3]]) -> f32 {
    let mut sum = 0.0;
    for (p, u) in filter.iter().zip(u) {
        let u = sym_mul(p, u);
        sum += u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    }
    sum
}

/// u · P r
#[inline(never)]
fn filtered_dot(filter: &[Sym3<f32>], u: &[[f32; 3]], r: &[[f32; 3]]) -> f32 {
    let mut sums = [0.0_f32; 3];
    for ((p, u), r) in filter.iter().zip(u).zip(r) {
        let r = sym_mul(p, r);
        for axis in 0..3 {
            sums[axis] += r[axis] * u[axis];
        }
    }
    sums[0] + sums[1] + sums[2]
}

/// Line search along the solution itself, but for what W has of it, so that (8) of the front page holds: from rest, too, where
/// conjugate gradients in f32 have lost their directions' conjugacy (a start with W has v(t) to hold on to), and
/// where couplings were switched during the solve. Beside W nothing is sped up or turned by it: v ⟂ r or v · r > 0.
pub(super) fn search_along<L: Layout, R: Lanes, C: Couple>(
    system: &Filtered<'_, L, R, C>,
    space: &Space<'_, impl Translate>,
    [v, r, p, q]: [&mut [[f32; 3]]; 4],
) {
    multiply_blocks(p, system.filter, v);
    if C::SOME {
        space.orthogonalise(p);
    }
    system.apply(p, q);
    let (rp, pap) = (system.dot(p, r), system.dot(p, q));
    let along = ratio_or_zero(rp, pap, 0.0);
    let some = select(along < 0.0, select(along > -1.0, along, -1.0), 0.0);
    let beside = C::SOME & space.translations.is_some();
    vector::advance(v, r, select(beside, some, along), p, q);
}
