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

use crate::math::{ratio_or_zero, select, sqrt};
use crate::vector::{add_scaled, dot, scale_and_add};

/// What the solver knows of the system.
pub(crate) trait System {
    /// `out` = A u
    fn apply(&self, u: &[[f32; 3]], out: &mut [[f32; 3]]);
    /// `z` = P B P r, symmetric and positive semidefinite
    fn precondition(&self, r: &[[f32; 3]], z: &mut [[f32; 3]]);
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

    /// Takes the mean motion out of `z`.
    fn remove(&self, z: &mut [[f32; 3]]) {
        let mean = self.mean(z);
        for z in z.iter_mut() {
            for axis in 0..3 {
                z[axis] -= mean[axis];
            }
        }
    }

    /// Galerkin over the translations: v += t (t·r)/(t·At), r −= At (t·r)/(t·At).
    fn project(&self, v: &mut [[f32; 3]], r: &mut [[f32; 3]]) {
        let mut sum = [0.0_f32; 3];
        for r in r.iter() {
            for axis in 0..3 {
                sum[axis] += r[axis];
            }
        }
        let speed = sum.map(|s| s * self.per_mass / self.mass_factor);
        for ((v, r), m) in v.iter_mut().zip(r).zip(self.masses) {
            let m = self.mass_factor * m;
            for axis in 0..3 {
                v[axis] += speed[axis];
                r[axis] -= m * speed[axis];
            }
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
pub(crate) struct Space<'a> {
    /// A-orthonormal vectors w_j, one after the other, `nodes` entries each.
    pub vectors: &'a mut [[f32; 3]],
    /// A w_j
    pub products: &'a mut [[f32; 3]],
    pub nodes: usize,
    pub translations: Option<Translations<'a>>,
}

/// A vector that orthogonalisation shortens below this (squared) is parallel to the others.
const PARALLEL: f32 = 1e-12;
/// Squares below this (in the body's units) are nothing; far above f32's subnormals.
const NOTHING: f32 = 1e-30;

impl Space<'_> {
    /// Makes the stored vectors A-orthonormal, in order. A vector that is zero, not finite, or
    /// parallel to the ones before is replaced by zero, at the same cost.
    pub fn orthonormalise(&mut self, system: &impl System) {
        let count = self.vectors.len().checked_div(self.nodes).unwrap_or(0);
        for k in 0..count {
            let (vectors, rest) = self.vectors.split_at_mut(k * self.nodes);
            let (products, rest_products) = self.products.split_at_mut(k * self.nodes);
            let (Some(w), Some(aw)) = (
                rest.get_mut(..self.nodes),
                rest_products.get_mut(..self.nodes),
            ) else {
                return;
            };
            let before = dot(w, w);
            // Twice is enough (Giraud, Langou and Rozloznik 2005).
            for _ in 0..2 {
                if let Some(translations) = &self.translations {
                    translations.remove(w);
                }
                remove(vectors, products, self.nodes, w);
            }
            let after = dot(w, w);
            system.apply(w, aw);
            let square = dot(w, aw);
            let usable = (after > PARALLEL * before)
                & (after > NOTHING)
                & (square > NOTHING)
                & square.is_finite();
            let scale = 1.0 / sqrt(select(usable, square, 1.0));
            for x in w.as_flattened_mut().iter_mut().chain(aw.as_flattened_mut()) {
                *x = select(usable, *x * scale, 0.0);
            }
        }
    }

    /// Galerkin over W: v += w (w·r), r −= Aw (w·r).
    pub fn project(&self, v: &mut [[f32; 3]], r: &mut [[f32; 3]]) {
        if let Some(translations) = &self.translations {
            translations.project(v, r);
        }
        for (w, aw) in pairs(self.vectors, self.products, self.nodes) {
            let c = dot(w, r);
            add_scaled(v, c, w);
            add_scaled(r, -c, aw);
        }
    }

    /// Galerkin over one more vector `g`, with its coefficient held between 0 and 1: v += τ g', r −= τ Ag'
    /// where g' is g made A-orthogonal to the stored vectors. `g` and `ag` = A g are overwritten.
    pub fn close_gap(
        &self,
        v: &mut [[f32; 3]],
        r: &mut [[f32; 3]],
        g: &mut [[f32; 3]],
        ag: &mut [[f32; 3]],
    ) {
        for (w, aw) in pairs(self.vectors, self.products, self.nodes) {
            let c = dot(aw, g);
            add_scaled(g, -c, w);
            add_scaled(ag, -c, aw);
        }
        let tau = ratio_or_zero(dot(g, r), dot(g, ag), 0.0);
        let tau = select(tau > 0.0, select(tau < 1.0, tau, 1.0), 0.0);
        add_scaled(v, tau, g);
        add_scaled(r, -tau, ag);
    }

    /// Makes `z` A-orthogonal to W.
    fn orthogonalise(&self, z: &mut [[f32; 3]]) {
        if let Some(translations) = &self.translations {
            translations.remove(z);
        }
        remove(self.vectors, self.products, self.nodes, z);
    }
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
fn remove(vectors: &[[f32; 3]], products: &[[f32; 3]], nodes: usize, z: &mut [[f32; 3]]) {
    for (w, aw) in pairs(vectors, products, nodes) {
        let c = dot(aw, z);
        add_scaled(z, -c, w);
    }
}

/// Residuals below this part (squared) of the right-hand side are rounding: (2⁻²²)², two bits
/// above the last of f32.
const ROUNDING: f32 = 1.0 / (1_u64 << 44) as f32;

/// Runs exactly `iterations` iterations from the iterate `v` with residual `r` ⟂ W; `p` and `q` are
/// scratch. `rhs_square` is bᵀPBPb. Returns after how many iterations the update froze.
pub(crate) fn solve(
    system: &impl System,
    space: &Space<'_>,
    iterations: u32,
    rhs_square: f32,
    [v, r, p, q]: [&mut [[f32; 3]]; 4],
) -> u32 {
    let floor = {
        let relative = ROUNDING * rhs_square;
        select(relative > NOTHING, relative, NOTHING)
    };
    let (mut live, mut updates, mut previous) = (true, 0, 0.0);
    p.fill([0.0; 3]);
    for _ in 0..iterations {
        system.precondition(r, q); // z
        space.orthogonalise(q);
        let rz = dot(r, q);
        live &= rz > floor;
        updates += u32::from(live);
        // The first iteration has no previous square: β = 0.
        let beta = ratio_or_zero(rz, previous, 0.0);
        previous = select(live, rz, 0.0);
        scale_and_add(p, beta, q);
        system.apply(p, q);
        let alpha = select(live, ratio_or_zero(dot(r, p), dot(p, q), 0.0), 0.0);
        add_scaled(v, alpha, p);
        add_scaled(r, -alpha, q);
    }
    updates
}
