//! Couplings: elements between pieces of one mesh, for contact, attachments and springs.
//!
//! Bodies that touch are *one* system: a mesh of several pieces, one state, one conjugate gradient over
//! all. What joins them is a list of couplings c of fixed length, each with up to eight (node, weight) pairs:
//!
//! ```text
//! W_c v = Σ_k w_k v_k        A' = A + Σ_c W_cᵀ B_c W_c,   b' = b + Σ_c W_cᵀ j_c
//! impulse on the first side, of those that act: j_c − B_c W_c v⁺, spread by the weights
//! ```
//!
//! Weights between two bodies sum to zero, and those of each side give the point they stand for: what one side gets,
//! the other gives, so linear momentum is exact, and so is angular momentum where the impulse lies in the line of
//! the two points. B_c is positive semidefinite, so A' is as good as A for every start and preconditioner; factored ones
//! and the coarse half of two-level do not know of couplings, which costs iterations only. B_c is stiff along the normal alone, in
//! no axis' direction: block Jacobi knows that and Jacobi does not, which leaves bodies more of their motion in a collision. Empty slots have
//! weights of zero and are computed like others.
//!
//! # Contact
//!
//! One-sided and implicit, restitution 0, decided before the solve ([`detect`](crate::detect) finds the points) and put right in it.
//! With the gap d along the normal n (negative inside), u = n·W v(t), a prediction w of what u would become without this
//! contact, and the effective mass a of the pair,
//! 1/a = nᵀ W D⁻¹ Wᵀ n with D_k = a_k = tr(A_kk)/3 (for rigid bodies 1/m + (r×n)ᵀ I⁻¹ (r×n)):
//!
//! ```text
//! closed (d ≤ 0):   active where w < κ|d|/h:     B_n = c,   j_n = κ c |d|/h        c = 32 a, κ = 1/8
//! open   (d > 0):   active where d + h w < 0:    B_n = min(c, a (h|w|/d − 1)),  j_n = 0
//! ```
//!
//! The prediction is one row of A v⁺ = b a node, v̂ = v + D⁻¹(b − A v), and the other contacts' impulses on it: those of
//! four sweeps of projected Gauss–Seidel, N ← max(0, N + a (goal − n·W v̂)), v̂ ← v̂ + D⁻¹ Wᵀ n ΔN, over all slots in
//! their order, the goal being κ|d|/h or −d/h; so w = n·W v̂ − N/a. A v is one application of A, without couplings.
//!
//! A closed contact is a spring k = κc/h² (backward Euler) with a dashpot (1 − κ)c/h beside it: at rest under a load
//! f it sinks in by f/k = f h²/(4a), a quarter of what the load would move the node by itself, or h²g/4
//! for a body under its weight; and it is pushed out at κ|d|/h, an eighth of its depth a step.
//! An open contact is a dashpot, as strong as it takes for the pair by itself to end the step just touching.
//!
//! **Energy.** An open contact is a dashpot: it only takes. A closed one gives back κcd²/(4h²) = κ/2 · ½kd² in a step
//! at most, a sixteenth of what its spring holds (at u⁺ = κ|d|/2h), and only while it is closed. So kinetic and elastic
//! energy rise by no more than that, however early a solve is stopped.
//!
//! With ½kd² of closed contacts in E, k frozen in the step, the energy theorem of the crate's front page holds: the closed
//! law is a quadratic potential and a dashpot, and an open contact that ends closed, at d⁺ = d + hu⁺, has paid for
//! ½kd⁺² by its dashpot as long as |u⁺| ≤ |w|, since ½κ(c/a) s(1 − s) ≤ 1 for s = d/(h|w|). What the account
//! leaves out is a contact that the prediction missed (a stiff body that an impact turns within the step): it is
//! found closed in the next step, with an energy that nobody paid, of which the bound above lets little through.
//! Measured in `tests/contact_bodies/free.rs`: over collisions of bodies of 1e5 to 1e8 Pa, at every budget, kinetic and
//! elastic energy never exceed that of the start by more than 1e-5 and what fitting rotations anew feeds.
//!
//! **Contacts never pull.** A closed contact would pull within a step if its ends separate faster than κ|d|/h, an open one if they
//! separate at all. The prediction says that neither does; the solve knows better. So with three or more iterations, in their
//! middle, and again each time in the middle of what is left, contacts that pull at the iterate are let go, and those
//! that were let go and would push are back: an active-set step (Hüeber and Wohlmuth 2005), some log₂ k of them in k iterations.
//! A, b, b − A v and the products A w of the start's vectors follow exactly, in one pass over the slots, and v is the Galerkin
//! solution over W again. After the last iteration it is done once more; then v, but for what W has of it, is scaled by the line search that makes
//! v ⟂ b − A v again, if that slows it down, so that the energy theorem holds for the contacts that the step ends with; and at last what
//! pulls is let go for good, which takes nothing from the theorem, as it separates. Converged, a step is the solution in which no contact pulls
//! (`tests/contact_bodies/oracle.rs`); truncated, impulses do not pull either, and what the solver has not settled is
//! residual: over collisions with soft and rigid bodies of up to 1e6 Pa, less than 5 % of the impulses with 60
//! iterations (`tests/contact_bodies/pull.rs`).
//!
//! **Friction** is Coulomb's, a dashpot γ in the tangent plane:
//!
//! ```text
//! γ = min(c_t, μN/û),   û = max(|u_t|, |w_t| − 4μN/a),   c_t = 32 a, or 1024 a between rigid bodies and colliders
//! N = κc|d|/h + min(c |u|₋, 2a |w|₋)  (closed),   a|w| B_n/(a + B_n)  (open)       x₋ = max(−x, 0)
//! ```
//!
//! In steady sliding γ|u_t| = μN exactly, and at rest the depth d remembers N. A contact sticks, up to a creep of
//! T/c_t under a load T (impulse a step), as long as |T| < μN. Where a side is hit, the friction of the first step
//! follows û; a body that is put down exactly touching (d = 0, u = 0) has none in its first step. Friction acts at two points that are d apart: a couple of at most |d| μN a step is all that
//! angular momentum is wrong by.
//!
//! # Links
//!
//! A [`Link`] is a spring k with a dashpot between two points, or a point and a target that moves, at any distance
//! e = W x − target: B = (h²k + hc) I, j = −hk e + B s, backward Euler; a *hard* one has h²k = 1024 a.
//!
//! # Cost
//!
//! Every slot, used or not, is read and written once in each application of A (a gather of eight nodes, a symmetric
//! 3×3 product, a scatter), in each sweep of the prediction, twice in building b and the diagonal, whenever contacts let go or come
//! back, and thrice after the solve, which takes one application of A more than without couplings: the number of
//! instructions of that does not depend on the state (counted: `.ci/run cost`), and [`cost`](crate::cost) knows it. That of the search
//! does, within the bounds of [`detect`](crate::detect).
//! A step without couplings is compiled without any of it; firmware that links it all takes some 31 KB of flash more
//! (`examples/firmware`, program `code`, feature `contact`).
//!
//! # Free islands
//!
//! A start with W (`galerkin-m`, `rigid-m`) has the translations of every island of pieces that couplings join and
//! nothing holds: each falls exactly, and keeps its own momentum, at every budget. The rotations of `rigid-m` are those
//! of the whole system.
//!
//! # Flow and fracture
//!
//! Bodies that touch may yield and break, each by a law of its own
//! ([`Settings::with_regions`](crate::settings::Settings)): forces of plastic strain are part of b, what has failed is no part
//! of A, and both are updated behind the step as ever, so that momentum and the energy bounds stay
//! (`tests/contact_bodies/damage.rs`). A boundary triangle whose tetrahedron has failed is gone, if the piece says which that
//! is ([`Piece::tets`]); a crack's own faces are not found, but for their nodes that were on the surface. So a crack can leave
//! pieces deep in each other, with an energy that nobody paid: the bound of a step stays, but over many steps some bodies
//! that break gain more than they had.
//!
//! # Limits
//!
//! Backward Euler only (θ = 1). With x⁺ = x + h(θv⁺ + (1−θ)v) half of the speed of an impact would go in whatever the
//! solve does, (1−θ)h|u| deep, and a contact's spring would give back in the next step what it took: bodies would
//! bounce, and the bounds above would not hold. A solve that is truncated early lets contacts sink in deeper, and an
//! unconverged stack is soft; take `galerkin-1` or more. A contact that a step misses is closed in
//! the next. The stiff lines of A' raise its condition number by up to 32 (1024 for hard links and rigid sticking).

mod contact;
pub(crate) mod hook;
mod islands;
mod link;
mod list;
mod predict;

pub use link::Link;
pub use list::{Couplings, Piece};

pub(crate) use hook::{Couple, CoupleStep};

use crate::element::Sym3;
use crate::vector::sym_mul;

/// A side that is not a rigid body; that number k counts as k + 1, so that an empty slot is all zero bits.
pub(crate) const SOFT: u16 = 0;

/// One coupling. A slot for it, all zero, is empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupling {
    /// Nodes of the first side, then of the second.
    pub(crate) nodes: [u32; 8],
    pub(crate) weights: [f32; 8],
    /// The rigid bodies that the sides are, counted from 1, or [`SOFT`].
    pub(crate) rigid: [u16; 2],
    /// Unit normal, from the second side to the first.
    pub(crate) normal: [f32; 3],
    /// d, metres
    pub(crate) gap: f32,
    /// d + h u before the step: what counts as deep.
    pub(crate) predicted: f32,
    /// μ
    pub(crate) friction: f32,
    /// Velocity of a second side that has no nodes, m/s.
    pub(crate) drift: [f32; 3],
    /// B, over the mass unit
    pub(crate) block: Sym3<f32>,
    /// j, over the impulse unit
    pub(crate) push: [f32; 3],
    /// 1, or 0 where the solve has let go of it
    pub(crate) acts: f32,
    /// k, N/m
    pub(crate) stiffness: f32,
    /// W v(t), then W v⁺ (m/s).
    pub(crate) speed: [f32; 3],
    /// What it did, N·s on the first side.
    pub(crate) impulse: [f32; 3],
}

impl Coupling {
    /// An empty slot.
    pub const EMPTY: Self = Self {
        nodes: [0; 8],
        weights: [0.0; 8],
        rigid: [SOFT; 2],
        normal: [0.0; 3],
        gap: 0.0,
        predicted: 0.0,
        friction: 0.0,
        drift: [0.0; 3],
        block: [0.0; 6],
        push: [0.0; 3],
        acts: 0.0,
        stiffness: 0.0,
        speed: [0.0; 3],
        impulse: [0.0; 3],
    };

    /// Nodes and weights: the first four are one side's, the others the other's. Unused ones weigh nothing.
    pub fn weights(&self) -> impl Iterator<Item = (u32, f32)> {
        self.nodes.into_iter().zip(self.weights)
    }

    /// Unit normal, pointing at the first side; zero for a link.
    #[must_use]
    pub fn normal(&self) -> [f32; 3] {
        self.normal
    }

    /// Gap at the start of the last step, metres; negative inside.
    #[must_use]
    pub fn gap(&self) -> f32 {
        self.gap
    }

    /// Velocity of the first side against the second after the last step, m/s.
    #[must_use]
    pub fn velocity(&self) -> [f32; 3] {
        self.speed
    }

    /// Impulse on the first side in the last step, N·s.
    #[must_use]
    pub fn impulse(&self) -> [f32; 3] {
        self.impulse
    }

    /// Stiffness k in the last step, N/m.
    #[must_use]
    pub fn stiffness(&self) -> f32 {
        self.stiffness
    }

    /// Whether it acted in the last step.
    #[must_use]
    pub fn is_active(&self) -> bool {
        self.acts * (self.block[0] + self.block[3] + self.block[5]) > 0.0
    }

    /// W u
    #[inline]
    pub(crate) fn relative(&self, u: &[[f32; 3]]) -> [f32; 3] {
        let mut sum = [0.0_f32; 3];
        for (&node, &w) in self.nodes.iter().zip(&self.weights) {
            let u = u.get(node as usize).copied().unwrap_or([0.0; 3]);
            for axis in 0..3 {
                sum[axis] += w * u[axis];
            }
        }
        sum
    }

    /// j − B W v, as if it acted; `v` over the velocity unit
    #[inline]
    pub(crate) fn whole_impulse(&self, v: &[[f32; 3]]) -> [f32; 3] {
        let drag = sym_mul(&self.block, &self.relative(v));
        core::array::from_fn(|axis| self.push[axis] - drag[axis])
    }

    /// `out` += Wᵀ f
    #[inline]
    pub(crate) fn spread(&self, f: &[f32; 3], out: &mut [[f32; 3]]) {
        for (&node, &w) in self.nodes.iter().zip(&self.weights) {
            if let Some(out) = out.get_mut(node as usize) {
                for axis in 0..3 {
                    out[axis] += w * f[axis];
                }
            }
        }
    }
}

/// `out` += Σ Wᵀ B W u
pub(crate) fn apply(slots: &[Coupling], u: &[[f32; 3]], out: &mut [[f32; 3]]) {
    for slot in slots {
        let f = sym_mul(&slot.block, &slot.relative(u));
        slot.spread(&f.map(|f| f * slot.acts), out);
    }
}

/// Adds Σ w_k² B to the diagonal blocks.
pub(crate) fn add_diagonal(slots: &[Coupling], blocks: &mut [Sym3<f32>]) {
    for slot in slots {
        for (&node, &w) in slot.nodes.iter().zip(&slot.weights) {
            if let Some(block) = blocks.get_mut(node as usize) {
                for (entry, b) in block.iter_mut().zip(&slot.block) {
                    *entry += w * w * b;
                }
            }
        }
    }
}
