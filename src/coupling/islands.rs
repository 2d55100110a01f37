//! Which pieces are free: each island of pieces that couplings join, and that nothing holds, has its translations in W.
//!
//! For such an island A' t = c_M M t exactly: K t = 0, and the weights of couplings within it sum to zero. So a piece that
//! flies by itself falls exactly at every budget, whatever the others do, and its momentum is its own.
//!
//! All of it costs the same in every state: what is chosen is chosen by masks.

use super::{Coupling, Piece};
use crate::constraint::FREE;
use crate::detect::{MAX_PIECES, MAX_RIGIDS};
use crate::element::{Layout, Sym3};
use crate::math::{Mask, ratio_or_zero, select};
use crate::rest::Rest;
use crate::scene::Scene;
use crate::space::{Translate, add_motion};
use crate::step::Units;
use crate::vector::momentum;

const MAX_PARTS: usize = MAX_PIECES + MAX_RIGIDS;

/// No island.
const NONE: u32 = u32::MAX;

/// A piece or rigid body.
#[derive(Clone, Copy, Debug)]
struct Part {
    /// One past its last node.
    end: usize,
    /// By the number of one of its parts.
    island: u32,
    /// 1 where something that does not move in the system holds it, else 0.
    held: u32,
}

/// The parts of a mesh, in the order of their nodes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Islands {
    parts: heapless::Vec<Part, MAX_PARTS>,
}

impl Islands {
    /// Every part by itself.
    pub fn new(pieces: &[Piece<'_>], rigids: usize, soft: usize) -> Self {
        let ends = pieces.iter().map(|p| p.nodes_end());
        let ends = ends.chain((1..=rigids).map(|k| soft + 4 * k));
        // No more than `check` lets pass.
        let parts = (0..).zip(ends.take(MAX_PARTS)).map(|(island, end)| Part {
            end,
            island,
            held: 0,
        });
        Self {
            parts: parts.collect(),
        }
    }

    /// The island of a side of a coupling, given its nodes and weights; [`NONE`] where nothing has a weight.
    #[inline(never)]
    fn of(&self, nodes: &[u32], weights: &[f32]) -> u32 {
        let (mut node, mut some) = (0, 0);
        for (&k, &w) in nodes.iter().zip(weights) {
            let named = Mask::of(w != 0.0);
            node = named.pick_u32(k, node);
            some |= named.pick_u32(1, 0);
        }
        // Of the first part that ends behind the node.
        let mut island = NONE;
        for part in self.parts.iter().rev() {
            let behind = Mask::of((node as usize) < part.end);
            island = behind.pick_u32(part.island, island);
        }
        Mask::of(some == 1).pick_u32(island, NONE)
    }

    /// Joins what a coupling joins, and holds what it holds, where it acts.
    #[inline(never)]
    pub fn join(&mut self, slot: &Coupling, acts: bool) {
        let (nodes, weights) = (
            slot.nodes.as_chunks::<4>().0,
            slot.weights.as_chunks::<4>().0,
        );
        let ([first, second], [own, other]) = (nodes, weights) else {
            return;
        };
        let (a, b) = (self.of(first, own), self.of(second, other));
        let holds = (a == NONE) | (b == NONE);
        let joined_to = Mask::of(a == NONE).pick_u32(b, a);
        for part in self.parts.iter_mut() {
            let joins = acts & ((part.island == a) | (part.island == b));
            part.held |= Mask::of(joins & holds).pick_u32(1, 0);
            part.island = Mask::of(joins).pick_u32(joined_to, part.island);
        }
    }

    /// One over the mass of each part's island where nothing holds that, also no node that touches or is pinned; else 0. 1/kg
    #[inline(never)]
    pub fn per_masses(&self, masses: &[f32], filter: &[Sym3<f32>]) -> [f32; MAX_PARTS] {
        let mut sums = [(0.0_f32, 0_u32); MAX_PARTS];
        let mut start = 0;
        for part in &self.parts {
            let range = start..part.end;
            start = part.end;
            let Some((mass, held)) = sums.get_mut(part.island as usize) else {
                continue;
            };
            for m in masses.get(range.clone()).unwrap_or_default() {
                *mass += m;
            }
            let nodes = filter.get(range).unwrap_or_default();
            *held |= part.held;
            for p in nodes {
                let entries = p.iter().zip(&FREE);
                let free = entries.fold(true, |free, (a, b)| free & (a == b));
                *held |= Mask::of(free).pick_u32(0, 1);
            }
        }
        let mut out = [0.0; MAX_PARTS];
        for (out, part) in out.iter_mut().zip(&self.parts) {
            let (mass, held) = sums.get(part.island as usize).copied().unwrap_or_default();
            *out = select(held == 0, ratio_or_zero(1.0, mass, 0.0), 0.0);
        }
        out
    }

    /// Σ over each island of what `sum` makes of a part's nodes, times `per_mass`: one value a part.
    fn means(
        &self,
        per_mass: &[f32; MAX_PARTS],
        sum: impl Fn(core::ops::Range<usize>) -> [f32; 3],
    ) -> [[f32; 3]; MAX_PARTS] {
        let mut sums = [[0.0_f32; 3]; MAX_PARTS];
        let mut start = 0;
        for part in &self.parts {
            if let Some(out) = sums.get_mut(part.island as usize) {
                for (out, part) in out.iter_mut().zip(sum(start..part.end)) {
                    *out += part;
                }
            }
            start = part.end;
        }
        let mut out = [[0.0_f32; 3]; MAX_PARTS];
        for ((out, part), per_mass) in out.iter_mut().zip(&self.parts).zip(per_mass) {
            let sum = sums.get(part.island as usize).copied().unwrap_or_default();
            *out = sum.map(|s| s * per_mass);
        }
        out
    }

    /// Calls `f` with the nodes of each part and its mean.
    fn spread(
        &self,
        means: &[[f32; 3]; MAX_PARTS],
        mut f: impl FnMut(core::ops::Range<usize>, [f32; 3]),
    ) {
        let mut start = 0;
        for (part, mean) in self.parts.iter().zip(means) {
            f(start..part.end, *mean);
            start = part.end;
        }
    }
}

/// The translations of all free islands.
#[derive(Debug)]
pub(crate) struct IslandTranslations<'a> {
    pub islands: Islands,
    pub masses: &'a [f32],
    pub mass_factor: f32,
    /// 1 over the mass of a part's island where that is free, else 0, 1/kg
    pub per_mass: [f32; MAX_PARTS],
}

impl Translate for IslandTranslations<'_> {
    fn hold(&mut self, filter: &[Sym3<f32>], _: Mask) {
        let now = self.islands.per_masses(self.masses, filter);
        for (per_mass, now) in self.per_mass.iter_mut().zip(now) {
            *per_mass = select(now > 0.0, *per_mass, 0.0);
        }
    }

    fn remove(&self, z: &mut [[f32; 3]]) {
        let means = self.islands.means(&self.per_mass, |nodes| {
            let masses = self.masses.get(nodes.clone()).unwrap_or_default();
            weighted(masses, z.get(nodes).unwrap_or_default())
        });
        self.islands.spread(&means, |nodes, mean| {
            for z in z.get_mut(nodes).unwrap_or_default() {
                for axis in 0..3 {
                    z[axis] -= mean[axis];
                }
            }
        });
    }

    fn project(&self, v: &mut [[f32; 3]], r: &mut [[f32; 3]]) {
        let means = self.islands.means(&self.per_mass, |nodes| {
            let mut sum = [0.0_f32; 3];
            for r in r.get(nodes).unwrap_or_default() {
                for axis in 0..3 {
                    sum[axis] += r[axis];
                }
            }
            sum
        });
        self.islands.spread(&means, |nodes, mean| {
            let speed = mean.map(|s| s / self.mass_factor);
            let v = v.get_mut(nodes.clone()).unwrap_or_default();
            let r = r.get_mut(nodes.clone()).unwrap_or_default();
            let masses = self.masses.get(nodes).unwrap_or_default();
            add_motion(speed, self.mass_factor, masses, v, r);
        });
    }

    fn restore<L: Layout>(
        &self,
        rest: &Rest<'_, L>,
        before: &[[f32; 3]],
        scene: &Scene<'_>,
        units: &Units,
        v: &mut [[f32; 3]],
    ) {
        let (h, alpha) = (units.dt, rest.header.alpha);
        let gravity = scene.gravity.to_array();
        let missing = self.islands.means(&self.per_mass, |nodes| {
            let masses = rest.masses.get(nodes.clone()).unwrap_or_default();
            let past = momentum(masses, before.get(nodes.clone()).unwrap_or_default());
            let now = momentum(masses, v.get(nodes.clone()).unwrap_or_default());
            let mass = masses.iter().fold(0.0, |sum, m| sum + m);
            let mut force = [0.0_f32; 3];
            for f in scene.forces.get(nodes).unwrap_or_default() {
                for axis in 0..3 {
                    force[axis] += f[axis];
                }
            }
            // θ = 1: couplings take no other.
            core::array::from_fn(|axis| {
                let gained = h * (mass * gravity[axis] + force[axis]);
                let target = (past[axis] + gained) / (1.0 + h * alpha);
                target / units.velocity - now[axis]
            })
        });
        self.islands.spread(&missing, |nodes, missing| {
            for v in v.get_mut(nodes).unwrap_or_default() {
                for axis in 0..3 {
                    v[axis] += missing[axis];
                }
            }
        });
    }
}

fn weighted(masses: &[f32], u: &[[f32; 3]]) -> [f32; 3] {
    let mut sum = [0.0_f32; 3];
    for (m, u) in masses.iter().zip(u) {
        for axis in 0..3 {
            sum[axis] += m * u[axis];
        }
    }
    sum
}
