//! The space W that a step solves exactly: past velocities and rotations, stored with their products
//! A w, and the translations of a free body, which need no storage.

use crate::body::StateMut;
use crate::cg::System;
use crate::element::{Layout, Sym3};
use crate::lane::{Lanes, Native};
use crate::math::{Mask, ratio_or_zero, select, sqrt};
use crate::rest::{Points, Rest};
use crate::scene::Scene;
use crate::settings::Start;
use crate::step::{Units, add_free};
use crate::vector::{add_scaled, add_scaled_dot, advance, dot, momentum, project, scale_or_clear};

/// Translations in W, of what nothing holds.
pub(crate) trait Translate {
    /// Takes those out of W that P does not leave; where nothing has changed, says `stays`.
    fn hold(&mut self, filter: &[Sym3<f32>], stays: Mask);
    /// Takes the mean motion out of `z`.
    fn remove(&self, z: &mut [[f32; 3]]);
    /// Galerkin over the translations: v += t (t·r)/(t·At), r −= At (t·r)/(t·At).
    fn project(&self, v: &mut [[f32; 3]], r: &mut [[f32; 3]]);
    /// Gives `v` the momentum that the external forces leave what had the velocities `before`, to rounding.
    fn restore<L: Layout>(
        &self,
        rest: &Rest<'_, L>,
        before: &[[f32; 3]],
        scene: &Scene<'_>,
        units: &Units,
        v: &mut [[f32; 3]],
    );
}

/// The three translations of a free body: A t = c_M M t exactly, so they need no storage.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Translations<'a> {
    pub masses: &'a [f32],
    /// c_M
    pub mass_factor: f32,
    /// 1/Σ m_i while nothing holds the body, else 0: the vectors are then zero.
    pub per_mass: f32,
}

impl Translations<'_> {
    /// Σ m_i u_i / Σ m_i, or zero.
    fn mean(&self, u: &[[f32; 3]]) -> [f32; 3] {
        weighted_sum(self.masses, u).map(|sum| sum * self.per_mass)
    }
}

impl Translate for Translations<'_> {
    fn hold(&mut self, _: &[Sym3<f32>], stays: Mask) {
        self.per_mass = stays.keep(self.per_mass);
    }

    #[inline(never)]
    fn remove(&self, z: &mut [[f32; 3]]) {
        let mean = self.mean(z);
        for z in z.iter_mut() {
            for axis in 0..3 {
                z[axis] -= mean[axis];
            }
        }
    }

    fn project(&self, v: &mut [[f32; 3]], r: &mut [[f32; 3]]) {
        let mut sum = [0.0_f32; 3];
        for r in r.iter() {
            for axis in 0..3 {
                sum[axis] += r[axis];
            }
        }
        let speed = sum.map(|s| s * self.per_mass / self.mass_factor);
        add_motion(speed, self.mass_factor, self.masses, v, r);
    }

    fn restore<L: Layout>(
        &self,
        rest: &Rest<'_, L>,
        before: &[[f32; 3]],
        scene: &Scene<'_>,
        units: &Units,
        v: &mut [[f32; 3]],
    ) {
        keep_momentum(rest.points(), before, scene, units, self.per_mass > 0.0, v);
    }
}

/// v += t and r −= c_M M t, for a translation t.
#[inline(always)]
pub(crate) fn add_motion(
    t: [f32; 3],
    mass_factor: f32,
    masses: &[f32],
    v: &mut [[f32; 3]],
    r: &mut [[f32; 3]],
) {
    for ((v, r), m) in v.iter_mut().zip(r).zip(masses) {
        let m = mass_factor * m;
        for axis in 0..3 {
            v[axis] += t[axis];
            r[axis] -= m * t[axis];
        }
    }
}

fn weighted_sum(masses: &[f32], u: &[[f32; 3]]) -> [f32; 3] {
    let mut sum = [0.0_f32; 3];
    for (m, u) in masses.iter().zip(u) {
        for axis in 0..3 {
            sum[axis] += m * u[axis];
        }
    }
    sum
}

/// The space W: some stored vectors with their products, and the translations.
#[derive(Debug)]
pub(crate) struct Space<'a, T> {
    /// A-orthonormal vectors w_j, one after the other, `nodes` entries each.
    pub vectors: &'a mut [[f32; 3]],
    /// A w_j
    pub products: &'a mut [[f32; 3]],
    pub nodes: usize,
    pub translations: Option<T>,
}

/// A vector that orthogonalisation shortens below this (squared) is parallel to the others.
const PARALLEL: f32 = 1e-12;
/// Squares below this (in the body's units) are nothing; far above f32's subnormals.
pub(crate) const NOTHING: f32 = 1e-30;

impl<T: Translate> Space<'_, T> {
    /// How many vectors are stored.
    fn count(&self) -> usize {
        self.vectors.len().checked_div(self.nodes).unwrap_or(0)
    }

    /// Makes the stored vectors A-orthonormal, in order. A vector that is zero, not finite, or
    /// parallel to the ones before is replaced by zero, at the same cost.
    pub fn orthonormalise(&mut self, system: &impl System) {
        for k in 0..self.count() {
            let Some(Split { before, w, aw }) = split(self.vectors, self.products, self.nodes, k)
            else {
                return;
            };
            let long = dot(w, w);
            // Twice is enough (Giraud, Langou and Rozloznik 2005).
            for _ in 0..2 {
                if let Some(translations) = &self.translations {
                    translations.remove(w);
                }
                remove(before[0], before[1], self.nodes, w);
            }
            let left = dot(w, w);
            system.apply(w, aw);
            normalise(w, aw, (left > PARALLEL * long) & (left > NOTHING));
        }
    }

    /// The same after couplings have changed A, by the products alone, which have changed with it; then Galerkin over W. (The
    /// translations in W do not know of couplings.)
    pub fn settle(&mut self, system: &impl System, v: &mut [[f32; 3]], r: &mut [[f32; 3]]) {
        for k in 0..self.count() {
            let Some(Split { before, w, aw }) = split(self.vectors, self.products, self.nodes, k)
            else {
                return;
            };
            for (u, au) in pairs(before[0], before[1], self.nodes) {
                let c = -dot(au, w);
                add_scaled(w, c, u);
                add_scaled(aw, c, au);
            }
            normalise(w, aw, true);
        }
        self.project(system, v, r);
    }

    /// Galerkin over W: v += w (w·r), r −= Aw (w·r).
    pub fn project(&self, system: &impl System, v: &mut [[f32; 3]], r: &mut [[f32; 3]]) {
        if let Some(translations) = &self.translations {
            translations.project(v, r);
        }
        for (w, aw) in pairs(self.vectors, self.products, self.nodes) {
            advance(v, r, system.dot(w, r), w, aw);
        }
    }

    /// Galerkin over one more vector `g`, with its coefficient held between 0 and 1: v += τ g', r −= τ Ag'
    /// where g' is g made A-orthogonal to the stored vectors. `g` is overwritten; `ag` is scratch.
    pub fn close_gap(
        &self,
        system: &impl System,
        v: &mut [[f32; 3]],
        r: &mut [[f32; 3]],
        g: &mut [[f32; 3]],
        ag: &mut [[f32; 3]],
    ) {
        remove(self.vectors, self.products, self.nodes, g);
        system.apply(g, ag);
        let tau = ratio_or_zero(dot(g, r), dot(g, ag), 0.0);
        let tau = select(tau > 0.0, select(tau < 1.0, tau, 1.0), 0.0);
        advance(v, r, tau, g, ag);
    }

    /// P has changed unless it `stays`: empties what was stored, and takes out the translations that P no longer leaves. (Products
    /// of nothing come with a factor of nothing.)
    pub fn hold(&mut self, filter: &[Sym3<f32>], stays: Mask) {
        if let Some(translations) = &mut self.translations {
            translations.hold(filter, stays);
        }
        scale_or_clear(self.vectors, 1.0, stays);
    }

    /// Makes `z` A-orthogonal to W.
    pub fn orthogonalise(&self, z: &mut [[f32; 3]]) {
        if let Some(translations) = &self.translations {
            translations.remove(z);
        }
        remove(self.vectors, self.products, self.nodes, z);
    }
}

/// A stored vector with its product.
struct Split<'a> {
    /// The vectors before it, and their products.
    before: [&'a [[f32; 3]]; 2],
    w: &'a mut [[f32; 3]],
    aw: &'a mut [[f32; 3]],
}

/// Vector k.
fn split<'a>(
    vectors: &'a mut [[f32; 3]],
    products: &'a mut [[f32; 3]],
    nodes: usize,
    k: usize,
) -> Option<Split<'a>> {
    let (vectors, rest) = vectors.split_at_mut_checked(k * nodes)?;
    let (products, rest_products) = products.split_at_mut_checked(k * nodes)?;
    Some(Split {
        before: [vectors, products],
        w: rest.get_mut(..nodes)?,
        aw: rest_products.get_mut(..nodes)?,
    })
}

/// Makes w · A w = 1; zero where it is not `usable` or nothing.
fn normalise(w: &mut [[f32; 3]], aw: &mut [[f32; 3]], usable: bool) {
    let square = dot(w, aw);
    let usable = Mask::of(usable & (square > NOTHING) & square.is_finite());
    let scale = 1.0 / sqrt(usable.pick(square, 1.0));
    scale_or_clear(w, scale, usable);
    scale_or_clear(aw, scale, usable);
}

/// The stored vectors with their products.
fn pairs<'a>(
    vectors: &'a [[f32; 3]],
    products: &'a [[f32; 3]],
    nodes: usize,
) -> impl Iterator<Item = (&'a [[f32; 3]], &'a [[f32; 3]])> {
    // A body has nodes; `max` only keeps a division by zero out of the binary.
    vectors
        .chunks_exact(nodes.max(1))
        .zip(products.chunks_exact(nodes.max(1)))
}

/// z −= w_j (Aw_j·z)
#[inline(never)]
fn remove(vectors: &[[f32; 3]], products: &[[f32; 3]], nodes: usize, z: &mut [[f32; 3]]) {
    let mut pairs = pairs(vectors, products, nodes);
    if !Native::STAGES {
        for (w, aw) in pairs {
            let c = dot(aw, z);
            add_scaled(z, -c, w);
        }
        return;
    }
    let Some((mut w, aw)) = pairs.next() else {
        return;
    };
    let mut c = dot(aw, z);
    for (next, aw) in pairs {
        c = add_scaled_dot(z, -c, w, aw);
        w = next;
    }
    add_scaled(z, -c, w);
}

/// Writes the stored vectors of W: the velocities v(t), v(t−h), …, then the rotations about the centre
/// of mass, or of the pinned nodes; filtered.
pub(crate) fn fill_space(
    rest: Points<'_>,
    state: &StateMut<'_>,
    scene: &Scene<'_>,
    start: Start,
    units: &Units,
    filter: &[Sym3<f32>],
    vectors: &mut [[f32; 3]],
) {
    // At least 1: see `pairs`.
    let nodes = rest.masses.len().max(1);
    let (velocities, rotations) = match start {
        Start::Galerkin(m) => (usize::from(m), false),
        Start::Rigid(m) => (usize::from(m), true),
        _ => (0, false),
    };
    let mut vectors = vectors.chunks_exact_mut(nodes);
    let past = core::iter::once(&*state.v).chain(state.history.chunks_exact(nodes));
    for (w, v) in vectors.by_ref().zip(past).take(velocities) {
        w.fill([0.0; 3]);
        add_free(v, filter, units, w);
    }
    if rotations {
        let centre = pivot(rest, state, scene);
        let per_length = 1.0 / rest.header.length_unit;
        for (axis, w) in vectors.take(3).enumerate() {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            for ((w, x), p) in w.iter_mut().zip(&*state.x).zip(filter) {
                // e × (x − centre)
                let mut turn = [0.0; 3];
                turn[next] = -((x[last] - centre[last]) * per_length);
                turn[last] = (x[next] - centre[next]) * per_length;
                *w = project(p, &turn);
            }
        }
    }
}

/// The centre of mass, or the middle of the pinned nodes.
fn pivot(rest: Points<'_>, state: &StateMut<'_>, scene: &Scene<'_>) -> [f32; 3] {
    if scene.pins.is_empty() {
        return momentum(rest.masses, state.x).map(|sum| sum / rest.header.total_mass);
    }
    let (mut sum, mut count) = ([0.0_f32; 3], 0.0_f32);
    for x in scene
        .pins
        .iter()
        .filter_map(|pin| state.x.get(pin.node as usize))
    {
        for axis in 0..3 {
            sum[axis] += x[axis];
        }
        count += 1.0;
    }
    sum.map(|s| s / count)
}

/// Gives a free body the linear momentum that its external forces leave it, to rounding:
/// (1 + θhα) Σ m v⁺ = (1 − (1−θ)hα) Σ m v + h Σ f_external. W has the translations, so the solve gave it
/// already, but for the rounding of elastic forces that cancel.
fn keep_momentum(
    rest: Points<'_>,
    before: &[[f32; 3]],
    scene: &Scene<'_>,
    units: &Units,
    free: bool,
    v: &mut [[f32; 3]],
) {
    let (h, alpha, total) = (units.dt, rest.header.alpha, rest.header.total_mass);
    let before = momentum(rest.masses, before);
    let now = momentum(rest.masses, v);
    let mut force = [0.0_f32; 3];
    for f in scene.forces {
        for axis in 0..3 {
            force[axis] += f[axis];
        }
    }
    let gravity = scene.gravity.to_array();
    let missing: [f32; 3] = core::array::from_fn(|axis| {
        let kept = (1.0 - (1.0 - units.theta) * h * alpha) * before[axis];
        let gained = h * (total * gravity[axis] + force[axis]);
        let target = (kept + gained) / (1.0 + units.theta * h * alpha);
        select(free, (target / units.velocity - now[axis]) / total, 0.0)
    });
    for v in v {
        for axis in 0..3 {
            v[axis] += missing[axis];
        }
    }
}
