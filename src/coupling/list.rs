//! The list of couplings of a scene, over memory of the caller's.

use glam::Vec3;

use super::contact::{self, keep_finite};
use super::hook::{Counts, FreeStep};
use super::islands::{IslandTranslations, Islands};
use super::predict::Prediction;
use super::{Couple, CoupleStep, Coupling, Link, add_diagonal, apply};
use crate::detect::{self, Aabb, Slots};
use crate::element::Sym3;
use crate::math::select;
use crate::report::{CouplingFault, Refusal};
use crate::rigid::Rigid;
use crate::scene::Scene;
use crate::settings::Settings;
use crate::vector::sym_mul;

/// A soft piece of the mesh, with its surface.
#[derive(Clone, Copy, Debug)]
pub struct Piece<'a> {
    /// Its nodes: pieces follow each other, from node 0 to the first rigid body.
    pub range: (u32, u32),
    /// Its boundary triangles, counter-clockwise from outside
    /// (`surface::boundary_triangles`), in any order; contacts are found fast in that of
    /// [`spatial_order`](detect::spatial_order).
    pub triangles: &'a [[u32; 3]],
    /// The tetrahedron of each of them, by its place in the mesh: where it has failed, its triangle is gone. Empty for a
    /// piece that does not break, or whose triangles stay.
    pub tets: &'a [u32],
    /// Edges that may touch those of other pieces, by nodes: the two ends, then what the triangles on
    /// either side have besides (`surface::sharp_edges`). None: only nodes touch triangles.
    pub edges: &'a [[u32; 4]],
    /// The nodes of the triangles, each once.
    pub nodes: &'a [u32],
    /// Coulomb's coefficient of friction; a pair has the geometric mean of its two.
    pub friction: f32,
}

impl Piece<'_> {
    pub(super) fn nodes_end(&self) -> usize {
        self.range.1 as usize
    }
}

/// What touches, joins and is rigid in a mesh of several pieces.
///
/// Links take the first slots, contacts the others; slots that are left over are empty, and cost the same.
#[derive(Debug)]
pub struct Couplings<'a> {
    /// Soft pieces that may touch each other and rigid bodies.
    pub pieces: &'a [Piece<'a>],
    /// Rigid bodies. Their nodes are the last of the mesh, in this order.
    pub rigids: &'a mut [Rigid],
    /// Attachments and springs.
    pub links: &'a [Link],
    /// Room for links and contacts: the capacity.
    pub slots: &'a mut [Coupling],
    /// Room for the search; see [`Couplings::with_boxes`].
    boxes: &'a mut [Aabb],
    counts: Counts,
    islands: Islands,
}

impl<'a> Couplings<'a> {
    /// Over these parts.
    #[must_use]
    pub fn new(
        pieces: &'a [Piece<'a>],
        rigids: &'a mut [Rigid],
        links: &'a [Link],
        slots: &'a mut [Coupling],
    ) -> Self {
        Self {
            pieces,
            rigids,
            links,
            slots,
            boxes: &mut [],
            counts: Counts::default(),
            islands: Islands::default(),
        }
    }

    /// Scratch of the search for contacts, which finds the same in any number of boxes, and fastest in
    /// [`boxes`](detect::boxes) of the triangles and as many of the edges of every piece.
    #[must_use]
    pub fn with_boxes(self, boxes: &'a mut [Aabb]) -> Self {
        Self { boxes, ..self }
    }

    /// Contacts of the last step.
    #[must_use]
    pub fn contacts(&self) -> &[Coupling] {
        self.slots.get(self.links.len()..).unwrap_or_default()
    }

    /// Nodes before those of rigid bodies.
    fn soft(&self, nodes: usize) -> usize {
        nodes.saturating_sub(4 * self.rigids.len())
    }

    fn faults(
        &self,
        nodes: usize,
        scene: &Scene<'_>,
        settings: &Settings<'_>,
    ) -> Option<CouplingFault> {
        let soft = self.soft(nodes);
        let named = |node: u32| (node as usize) < nodes;
        let is_soft = |node: u32| (node as usize) < soft;
        if settings.theta() < 1.0 {
            return Some(CouplingFault::Theta);
        }
        if self.links.len() > self.slots.len() {
            return Some(CouplingFault::Slots);
        }
        let mut next = 0;
        for piece in self.pieces {
            let (first, end) = piece.range;
            if first != next || end <= first || end as usize > soft {
                return Some(CouplingFault::Piece);
            }
            next = end;
        }
        if next as usize != soft {
            return Some(CouplingFault::Piece);
        }
        let mut next = soft;
        for rigid in &*self.rigids {
            if rigid.first as usize != next {
                return Some(CouplingFault::Rigid);
            }
            next += 4;
        }
        if next != nodes || self.rigids.len() > detect::MAX_RIGIDS {
            return Some(CouplingFault::Rigid);
        }
        let surface = self.pieces.iter().all(|piece| {
            let corners = piece.triangles.as_flattened().iter().chain(piece.nodes);
            let all = corners.chain(piece.edges.as_flattened());
            all.copied().all(is_soft)
        });
        if !surface || self.pieces.len() > detect::MAX_PIECES {
            return Some(CouplingFault::Piece);
        }
        if !self.links.iter().all(|link| link.names().all(named)) {
            return Some(CouplingFault::Link);
        }
        let pinned = scene.pins.iter().any(|pin| !is_soft(pin.node));
        pinned.then_some(CouplingFault::Pinned)
    }
}

/// Decides what was found, and what was not. Returns how many act. (A function by itself: who counts what a search costs
/// sees by it where that ends.)
#[inline(never)]
fn decide_all(
    contacts: &mut [Coupling],
    prediction: &mut Prediction<'_>,
    islands: &mut Islands,
) -> u32 {
    for slot in contacts.iter_mut() {
        contact::weigh(slot, prediction);
    }
    for _ in 0..contact::SWEEPS {
        for slot in contacts.iter_mut() {
            contact::relax(slot, prediction);
        }
    }
    let mut count = 0;
    for slot in contacts {
        let active = contact::decide(slot, prediction);
        keep_finite(slot);
        islands.join(slot, active);
        count += u32::from(active);
    }
    count
}

impl Couple for Couplings<'_> {
    const SOME: bool = true;

    #[inline(never)]
    fn check(
        &self,
        nodes: usize,
        scene: &Scene<'_>,
        settings: &Settings<'_>,
    ) -> Result<(), Refusal> {
        self.faults(nodes, scene, settings)
            .map_or(Ok(()), |fault| Err(Refusal::Coupling(fault)))
    }

    fn touched<'b>(&self, masses: &'b [f32]) -> &'b [f32] {
        masses.get(..self.soft(masses.len())).unwrap_or_default()
    }

    fn locate(&mut self, x: &[[f32; 3]]) {
        for rigid in self.rigids.iter_mut() {
            rigid.locate(x);
        }
    }

    #[inline(never)]
    fn decide(&mut self, step: &CoupleStep<'_>, kept: &mut [[f32; 3]]) {
        let soft = self.soft(step.masses.len());
        let (links, contacts) = self
            .slots
            .split_at_mut_checked(self.links.len())
            .unwrap_or_default();
        self.islands = Islands::new(self.pieces, self.rigids.len(), soft);
        let mut prediction = Prediction::new(step, self.rigids, kept);
        for (slot, link) in links.iter_mut().zip(self.links) {
            *slot = link.decide(&prediction);
            keep_finite(slot);
            self.islands.join(slot, true);
        }
        let mut found = Slots::new(contacts);
        detect::find(self.pieces, self.boxes, self.rigids, step, &mut found);
        let dropped = found.dropped();
        let active = decide_all(contacts, &mut prediction, &mut self.islands);
        self.counts = Counts { active, dropped };
    }

    type Free<'b> = IslandTranslations<'b>;

    fn translations<'b>(
        &mut self,
        step: &FreeStep<'b>,
        filter: &[Sym3<f32>],
    ) -> Option<IslandTranslations<'b>> {
        step.augmented.then(|| IslandTranslations {
            per_mass: self.islands.per_masses(step.masses, filter),
            islands: core::mem::take(&mut self.islands),
            masses: step.masses,
            mass_factor: step.mass_factor,
        })
    }

    #[inline(never)]
    fn add_to(&self, blocks: &mut [Sym3<f32>], rhs: &mut [[f32; 3]]) {
        add_diagonal(self.slots, blocks);
        for slot in &*self.slots {
            slot.spread(&slot.push, rhs);
        }
    }

    #[inline(never)]
    fn apply(&self, u: &[[f32; 3]], out: &mut [[f32; 3]]) {
        apply(self.slots, u, out);
    }

    #[inline(never)]
    fn switch(
        &mut self,
        v: &[[f32; 3]],
        r: &mut [[f32; 3]],
        [vectors, products]: [&mut [[f32; 3]]; 2],
        back: bool,
    ) -> bool {
        let nodes = v.len().max(1);
        let mut any = false;
        for slot in self.slots.iter_mut() {
            let change = contact::switch(slot, v, r, back);
            for (w, aw) in vectors
                .chunks_exact(nodes)
                .zip(products.chunks_exact_mut(nodes))
            {
                let f = sym_mul(&slot.block, &slot.relative(w));
                slot.spread(&f.map(|f| change * f), aw);
            }
            any |= change != 0.0;
        }
        self.project(r);
        for aw in products.chunks_exact_mut(nodes) {
            self.project(aw);
        }
        any
    }

    #[inline(never)]
    fn project(&self, u: &mut [[f32; 3]]) {
        for rigid in &*self.rigids {
            rigid.project(u);
        }
    }

    #[inline(never)]
    fn place(
        &mut self,
        h: f32,
        impulse_unit: f32,
        velocity_unit: f32,
        x: &mut [[f32; 3]],
        v: &mut [[f32; 3]],
    ) {
        let per_unit = 1.0 / velocity_unit;
        for slot in self.slots.iter_mut() {
            let speed = slot.relative(v);
            let drag = sym_mul(&slot.block, &speed.map(|u| u * per_unit));
            let impulse = Vec3::from_array(slot.push) - Vec3::from_array(drag);
            // `restore` may have moved a speed by a rounding.
            let pulls = impulse.dot(Vec3::from_array(slot.normal)) < 0.0;
            slot.impulse = (impulse * (impulse_unit * select(pulls, 0.0, slot.acts))).to_array();
            for axis in 0..3 {
                slot.speed[axis] = speed[axis] - slot.drift[axis];
            }
        }
        for rigid in self.rigids.iter_mut() {
            rigid.turn(h, x, v);
        }
    }

    fn counts(&self) -> Counts {
        self.counts
    }
}
