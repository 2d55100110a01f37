//! Pins and contact as one projection filter (Baraff and Witkin, SIGGRAPH 1998, section 5.3).
//!
//! Each node has a symmetric projection P_i: the identity where it is free, I − nnᵀ where it slides
//! on a surface, 0 where it is held. The solver searches in the range of P only; the rest of a
//! node's velocity is its *target* c_i. Free nodes pay the same, so the cost does not depend on who
//! touches what.
//!
//! **Before the solve**, one pass over nodes and colliders says who touches. Node i, its
//! neighbours moving along with it, would take the velocity w = v + h f/a with a = tr(A_ii)/3: one
//! node's row of A v⁺ = b. With signed distance d, normal n, and the surface's velocity s,
//!
//! ```text
//! N = −(w − s⁻)·n − d/h         impulse (over a) that would keep the node out
//! active:  N > 0
//! it moves with the surface, c·n = s·n, and closes the gap: c_gap·n = −τ max(d, 0)/h with 0 ≤ τ ≤ 1
//! |w_t − s⁻_t| ≤ μN: it sticks, c_t = s_t
//! else it slides:     −γ (v⁺_t − s_t) acts on it, γ = aμN / (|w_t − s⁻_t| − μN)
//! ```
//!
//! The points of a surface that spins have an acceleration ṡ, of which the part along the surface counts. s is their mean
//! velocity in this step, ṡh/2 more than at its begin, so that what sticks goes round with it; s⁻ = s − hṡ is
//! that of the step before, when what moves along got its velocity.
//!
//! The node by itself would slide at v⁺_t − s_t = (w_t − s_t)(1 − μN/|w_t − s_t|), so that γ is Coulomb's
//! friction made implicit: in steady sliding it is exactly aμN, it cannot turn the motion round, and
//! as sliding ends it passes over into sticking. γ is a node's share of A's diagonal.
//!
//! In a body at rest or in steady sliding, h f holds what the constraint held in the step before, so
//! N is that step's constraint impulse: Coulomb's law is exact there without any memory, and a state needs no
//! contact history.
//!
//! τ is one number for the body, and belongs to the Galerkin solution: nodes that were told to reach the
//! surface (τ = 1) while a truncated solve stops the rest of the body would store energy that was
//! never there.
//!
//! **During the solve**, from its middle on and with a budget of three iterations or more, who is held is made right by what
//! the iterate says, as in an active-set method for the complementarity problem v⁺·n ≥ −d/h, impulse ≥ 0 (Dostál and Schöberl
//! 2005), but with a fixed number of products: nodes whose impulse (A v − b)·n is negative are let go, and those that v
//! moves into a surface are taken in (without friction in that step). A let-go node keeps its γ until the next step.
//! What would pull after the last iteration is let go, too: it is part of the residual, and goes to zero with it.
//! What is left of contacts pushes: [`Workspace::reactions`](crate::body::Workspace::reactions).
//!
//! **After it**, nodes that are inside nevertheless are put back on the surface, and so are nodes that start a step
//! inside. So no node ends a step inside: to rounding of its coordinates for one
//! collider; for several, to what correcting one after the other leaves where they meet at an acute
//! angle. Putting back strains, which truncated solves have not relaxed: in bodies of h²E/(ρ·dx²) above 10 it may add
//! energy, and where surfaces have valleys a little in softer ones, unless the feature
//! `energy-guard` is there and [`Settings`](crate::Settings) ask for it.

use core::iter::Zip;
use core::slice::Iter;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use crate::collider::Collider;
use crate::element::Sym3;
use crate::math::{ratio_or_zero, select, sqrt};
use crate::vector::project;

/// A node whose velocity is prescribed (m/s); zero holds it.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
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
        Self {
            node,
            velocity: Vec3::ZERO,
        }
    }
}

/// P = I
pub const FREE: Sym3<f32> = [1.0, 0.0, 0.0, 1.0, 0.0, 1.0];
const HELD: Sym3<f32> = [0.0; 6];

/// A node that begins a step deeper than this part of the body's length unit is put out without the speed of it.
const TOUCHING: f32 = 1.0 / 4096.0;

/// A node whose sliding would lose all but this part of its speed in one step sticks.
const STUCK: f32 = 1e-3;

/// What contact needs to know of a body and its step. SI units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactStep<'a> {
    pub masses: &'a [f32],
    pub x: &'a [[f32; 3]],
    pub v: &'a [[f32; 3]],
    pub dt: f32,
    pub length_unit: f32,
    pub mass_unit: f32,
    /// Velocity of which one mass unit's momentum is one unit of the right-hand side, m/s.
    pub velocity_unit: f32,
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

/// What contact decides, node by node.
#[derive(Debug)]
pub(crate) struct Decisions<'a> {
    /// b; sliding on a moving surface adds γs.
    pub rhs: &'a mut [[f32; 3]],
    /// The diagonal blocks of A, and its scalar part; friction adds γ to both.
    pub diagonal: &'a mut [Sym3<f32>],
    pub inertia: &'a mut [f32],
    /// P
    pub filter: &'a mut [Sym3<f32>],
    /// c, m/s
    pub targets: &'a mut [[f32; 3]],
    /// c_gap for τ = 1, m/s
    pub gaps: &'a mut [[f32; 3]],
    /// Σ n of the colliders in contact
    pub normals: &'a mut [[f32; 3]],
}

/// Decides who is in contact and who slides. Returns the number of contacts. Without colliders nothing
/// is read or written.
#[inline(never)]
pub(crate) fn touch(
    colliders: &[Collider<'_>],
    step: &ContactStep<'_>,
    out: &mut Decisions<'_>,
) -> u32 {
    if colliders.is_empty() {
        return 0;
    }
    let per_dt = 1.0 / step.dt;
    let mut contacts = 0;
    let per_unit = 1.0 / step.velocity_unit;
    let body = step.masses.iter().zip(step.x).zip(step.v);
    let system = out
        .rhs
        .iter_mut()
        .zip(&mut *out.diagonal)
        .zip(&mut *out.inertia);
    let constraint = out
        .filter
        .iter_mut()
        .zip(&mut *out.targets)
        .zip(&mut *out.gaps)
        .zip(&mut *out.normals);
    for ((((mass, x), v), ((rhs, diagonal), inertia)), (((p, c), gap), normal)) in
        body.zip(system).zip(constraint)
    {
        let (x, v) = (Vec3::from_array(*x), Vec3::from_array(*v));
        let a = (diagonal[0] + diagonal[3] + diagonal[5]) * (1.0 / 3.0);
        let push = Vec3::from_array(*rhs) - v * (mass / step.mass_unit * per_unit); // h f
        let w = v + push * (step.velocity_unit / a);
        *gap = [0.0; 3];
        *normal = [0.0; 3];
        for collider in colliders {
            let surface = collider.over(x, step.dt);
            let (d, n) = (surface.distance, surface.normal);
            let (before, s) = (surface.before, surface.velocity); // s⁻, s
            let keep = -((w - before).dot(n) + d * per_dt); // N
            // What earlier constraints leave of the normal.
            let free = project(p, &n.to_array());
            let share = n.dot(Vec3::from_array(free));
            let active = (keep > 0.0) & (share > 1e-3);
            contacts += u32::from(active);
            let open = select(d > 0.0, -(d * per_dt), 0.0);
            add_if(active, normal, n);
            target(active, c, &free, share, n, s.dot(n));
            target(active, gap, &free, share, n, open);
            hold(active, p, &free, share);

            let slip = project(p, &(w - before).to_array()); // w_t − s⁻_t
            let speed = sqrt(slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2]);
            let grip = collider.friction() * select(active, keep, 0.0); // μN
            let left = speed - grip;
            let slides = active & (left > STUCK * speed);
            let gamma = select(slides, a * ratio_or_zero(grip, left, 0.0), 0.0);
            *inertia += gamma;
            for entry in [0, 3, 5] {
                diagonal[entry] += gamma;
            }
            let s_t = project(p, &s.to_array());
            for axis in 0..3 {
                rhs[axis] += gamma * s_t[axis] * per_unit;
            }
            let sticks = active & !slides & (collider.friction() > 0.0);
            let s = s.to_array();
            let hold = project(p, &[s[0] - c[0], s[1] - c[1], s[2] - c[2]]);
            add_if(sticks, c, Vec3::from_array(hold));
            let free = select(sticks, 0.0, 1.0);
            for entry in p.iter_mut() {
                *entry *= free;
            }
        }
    }
    contacts
}

/// If `now`, takes in the free nodes that `v` (over the velocity unit) moves into a surface, without friction, and writes to `g` what
/// brings to the surface whoever would be inside. Returns whether there were any to take in.
#[inline(never)]
pub(crate) fn enter(
    now: bool,
    colliders: &[Collider<'_>],
    step: &ContactStep<'_>,
    v: &[[f32; 3]],
    filter: &mut [Sym3<f32>],
    normals: &mut [[f32; 3]],
    g: &mut [[f32; 3]],
) -> bool {
    let mut some = false;
    let per_step = 1.0 / (step.dt * step.velocity_unit);
    g.fill([0.0; 3]);
    let nodes = step.x.iter().zip(v).zip(filter).zip(normals).zip(g);
    for ((((x, v), p), normal), g) in nodes {
        let mut at = core::array::from_fn(|axis| x[axis] + v[axis] / per_step);
        let (way, n) = land(
            colliders,
            step.dt,
            step.length_unit,
            x,
            &mut at,
            &mut [0.0; 3],
        );
        let free = project(p, &n.to_array());
        let share = n.dot(Vec3::from_array(free));
        let enters = now & (share > 1e-3);
        let held = Vec3::from_array(*normal);
        let pinned = (share <= 1e-3) & (held.dot(held) <= 0.0);
        *g = (way * select(pinned, 0.0, per_step)).to_array();
        hold(enters, p, &free, share);
        add_if(enters, normal, n);
        some |= enters;
    }
    some
}

/// Nodes that surfaces hold.
pub(crate) fn held(normals: &[[f32; 3]]) -> u32 {
    let holds = |n: &[f32; 3]| u32::from(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] > 0.0);
    normals.iter().map(holds).sum()
}

/// If `now`, releases the nodes that contact would pull: −(1 − P) r is its impulse. Returns whether there were any. Where several
/// surfaces hold a node, it is released by all, if their sum pulls.
#[inline(never)]
pub(crate) fn release(
    now: bool,
    r: &[[f32; 3]],
    filter: &mut [Sym3<f32>],
    normals: &mut [[f32; 3]],
) -> bool {
    let mut some = false;
    for ((r, p), n) in r.iter().zip(filter).zip(normals) {
        let pulls = now & (n[0] * r[0] + n[1] * r[1] + n[2] * r[2] > 0.0);
        let (keep, free) = (select(pulls, 0.0, 1.0), select(pulls, 1.0, 0.0));
        for (entry, one) in p.iter_mut().zip(FREE) {
            *entry = *entry * keep + one * free;
        }
        *n = n.map(|n| n * keep);
        some |= pulls;
    }
    some
}

/// Impulses with which pins and colliders have acted, node by node, N·s: −(I − P) r.
#[derive(Clone, Debug)]
pub struct Reactions<'a> {
    nodes: Zip<Iter<'a, Sym3<f32>>, Iter<'a, [f32; 3]>>,
    impulse_unit: f32,
}

impl<'a> Reactions<'a> {
    pub(crate) fn new(filter: &'a [Sym3<f32>], r: &'a [[f32; 3]], impulse_unit: f32) -> Self {
        Self {
            nodes: filter.iter().zip(r),
            impulse_unit,
        }
    }
}

impl Iterator for Reactions<'_> {
    type Item = Vec3;

    fn next(&mut self) -> Option<Vec3> {
        let (p, r) = self.nodes.next()?;
        Some((Vec3::from_array(project(p, r)) - Vec3::from_array(*r)) * self.impulse_unit)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.nodes.size_hint()
    }
}

impl ExactSizeIterator for Reactions<'_> {}

/// u += n if `active`
#[inline]
fn add_if(active: bool, u: &mut [f32; 3], n: Vec3) {
    *u = (Vec3::from_array(*u) + n * select(active, 1.0, 0.0)).to_array();
}

/// If `active`: c·n = speed from now on, along `free` = P n (n·P n = `share`).
#[inline(never)]
fn target(active: bool, c: &mut [f32; 3], free: &[f32; 3], share: f32, n: Vec3, speed: f32) {
    let missing = select(
        active,
        ratio_or_zero(1.0, share, 0.0) * (speed - n.dot(Vec3::from_array(*c))),
        0.0,
    );
    *c = core::array::from_fn(|axis| c[axis] + missing * free[axis]);
}

/// If `active`: P n = 0 from now on, given `free` = P n (n·P n = `share`).
#[inline(never)]
fn hold(active: bool, p: &mut Sym3<f32>, free: &[f32; 3], share: f32) {
    let inverse = select(active, ratio_or_zero(1.0, share, 0.0), 0.0);
    for (entry, product) in p.iter_mut().zip(outer(free)) {
        *entry -= inverse * product;
    }
}

/// u uᵀ
#[inline]
fn outer(&[x, y, z]: &[f32; 3]) -> Sym3<f32> {
    [x * x, x * y, x * z, y * y, y * z, z * z]
}

/// Puts one node back on every collider that it would enter, where the collider will be after `dt`,
/// and takes the speed of entering from it. A node that started the step inside leaves it without the
/// speed of being pushed out. Returns the way that it was put back, and the sum of the normals on it.
#[inline(never)]
pub(crate) fn land(
    colliders: &[Collider<'_>],
    dt: f32,
    length_unit: f32,
    x_old: &[f32; 3],
    x: &mut [f32; 3],
    v: &mut [f32; 3],
) -> (Vec3, Vec3) {
    let (mut way, mut normals) = (Vec3::ZERO, Vec3::ZERO);
    let margin = TOUCHING * length_unit;
    for collider in colliders {
        let was_inside = collider.near_after(Vec3::from_array(*x_old), 0.0).distance < -margin;
        let (mut at, mut speed) = (Vec3::from_array(*x), Vec3::from_array(*v));
        let near = collider.near_after(at, dt);
        let (d, n, s) = (near.distance, near.normal, near.velocity);
        let enters = d < 0.0;
        let out = near.way_out * select(enters, -d, 0.0);
        at += out;
        (way, normals) = (way + out, normals + n * select(enters, 1.0, 0.0));
        let normal_speed = (speed - s).dot(n);
        let stop = (enters & (normal_speed < 0.0)) | (was_inside & (normal_speed > 0.0));
        speed -= n * select(stop, normal_speed, 0.0);
        (*x, *v) = (at.to_array(), speed.to_array());
    }
    (way, normals)
}
