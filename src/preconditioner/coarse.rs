//! The coarse half of the two-level preconditioner.
//!
//! A few aggregates of nodes, each with the six motions of a rigid body, span a coarse space Z: what
//! a local preconditioner needs many iterations to move, because it only knows neighbours. Additively,
//!
//! ```text
//! z = P B P r + P Z E⁻¹ Zᵀ P r        B block Jacobi,   E ≈ Zᵀ P A P Z,   6 × 6 blocks E_ab
//! (Z w)_i = N_i w_a,  N_i = [ 1 | −[d_i]× ],  d_i = x_i − c_a     node i of aggregate a, its mean position c_a
//! ```
//!
//! (Nicolaides 1987 takes constants on subdomains; rigid motions for elasticity are in Bridson and Greif,
//! "A multipreconditioned conjugate gradient algorithm", 2006, and in aggregation multigrid, Vaněk, Mandel and
//! Brezina 1996.) E is made anew in each step, of three parts:
//!
//! * K of the tetrahedra that are *cut*, whose corners are not all of one aggregate. K annihilates a rigid
//!   motion up to the strain, so the others say little; leaving out a positive semidefinite part keeps E so;
//! * the mass, c_M Σ m_i N_iᵀ N_i, with what friction adds;
//! * the filter: Σ N_iᵀ (1 − P_i) A_ii (1 − P_i) N_i makes motions stiff that contact, or a pin that the aggregates
//!   do not know of, forbids.
//!
//! Take it with v(t) in W (`galerkin-1` or more): from `zero`, a few iterations turn a very stiff body without pulling
//! it together, and it can be lost (h²E/(ρdx²) from some 1e4; `tests/golden/hard_cases.txt`).
//!
//! Which tetrahedra are cut depends on the mesh alone, so the cost is fixed. E = L D Lᵀ drops a motion whose
//! pivot has sunk to rounding (an aggregate of one node cannot turn): the pivot's inverse and its column of L become
//! zero. Whatever the numbers in L, the sum is symmetric positive semidefinite, since both triangular solves
//! read the same ones.
//!
//! Measured on a cantilever in closed loop (the README has the figures): aggregates that leave pinned nodes out
//! are no better than those which the filter's part has to hold; nor are weights other than 1 on the coarse half.

use super::aggregate::{Aggregates, MAX_AGGREGATES, NONE};
use super::fold::{Group, MODES, cross, motion, restricted};
use crate::algebra::{add3, scale3};
use crate::cost::Coarse as Load;
use crate::element::{Layout, Sym3};
use crate::lane::{BLOCK, Lanes};
use crate::math::{Mask, ratio_or_zero};
use crate::operator::Operator;
use crate::rest::TetBlock;
use crate::vector::{dot_numbers, sym_mul};

/// Numbers of workspace that so many aggregates take: the capacity `COARSE`. (8 take 1,200, or 4,800 bytes.)
#[must_use]
pub const fn coarse_length(aggregates: usize) -> usize {
    let modes = MODES * aggregates;
    3 * aggregates + modes * (modes + 1) / 2
}

/// A pivot below this part of its diagonal entry is rounding: some 48 subtractions of ε/2 each.
const ROUNDING: f32 = 1.0 / (1_u32 << 18) as f32;

/// E⁻¹ of this step, and what takes it to the nodes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coarse<'a> {
    aggregates: Aggregates<'a>,
    x: &'a [[f32; 3]],
    per_length: f32,
    /// Mean positions of the aggregates, metres.
    centres: &'a [[f32; 3]],
    /// D⁻¹ and, right of it, L, by columns: Lᵀ by rows.
    factor: &'a [f32],
}

impl<'a> Coarse<'a> {
    /// Makes and factors E. `blocks` are the diagonal blocks of A, `scratch` is as long as the body has nodes,
    /// `out` as [`coarse_length`] says.
    #[inline(never)]
    pub fn new<R: Lanes, L: Layout>(
        aggregates: Aggregates<'a>,
        operator: &Operator<'_, L>,
        x: &'a [[f32; 3]],
        filter: &[Sym3<f32>],
        blocks: &[Sym3<f32>],
        scratch: &mut [[f32; 3]],
        out: &'a mut [f32],
    ) -> Self {
        // Of a longer workspace, as much as is needed: the solves go through the factor from both ends.
        let (centres, matrix) = out
            .get_mut(..coarse_length(aggregates.count()))
            .and_then(|out| out.split_at_mut_checked(3 * aggregates.count()))
            .unwrap_or_default();
        let (centres, _) = centres.as_chunks_mut();
        let per_length = 1.0 / operator.rest.header.length_unit;
        mean_positions(&aggregates, x, centres);
        for ((d, x), &of) in scratch.iter_mut().zip(x).zip(aggregates.of()) {
            *d = centres
                .get(usize::from(of))
                .map_or([0.0; 3], |c| offset(x, c, per_length));
        }
        matrix.fill(0.0);
        let mut e = Matrix {
            rows: matrix,
            modes: MODES * aggregates.count(),
        };
        add_nodes(
            &aggregates,
            operator.inertia,
            filter,
            blocks,
            scratch,
            &mut e,
        );
        add_cuts::<R, L>(&aggregates, operator, scratch, &mut e);
        factorise(&mut e);
        Self {
            aggregates,
            x,
            per_length,
            centres,
            factor: e.rows,
        }
    }

    /// `z` += P Z E⁻¹ Zᵀ P r
    #[inline(never)]
    pub fn add(&self, filter: &[Sym3<f32>], r: &[[f32; 3]], z: &mut [[f32; 3]]) {
        let mut motions = [[0.0_f32; MODES]; MAX_AGGREGATES];
        for (((r, p), x), &of) in r.iter().zip(filter).zip(self.x).zip(self.aggregates.of()) {
            let of = usize::from(of);
            if let (Some(sum), Some(centre)) = (motions.get_mut(of), self.centres.get(of)) {
                let d = offset(x, centre, self.per_length);
                for (sum, part) in sum.iter_mut().zip(restricted(&d, &sym_mul(p, r))) {
                    *sum += part;
                }
            }
        }
        solve(self.factor, self.aggregates.count(), &mut motions);
        for (((z, p), x), &of) in z
            .iter_mut()
            .zip(filter)
            .zip(self.x)
            .zip(self.aggregates.of())
        {
            let of = usize::from(of);
            if let (Some(&[a, b, c, u, v, w]), Some(centre)) =
                (motions.get(of), self.centres.get(of))
            {
                let d = offset(x, centre, self.per_length);
                let moved = add3(&[a, b, c], &cross(&[u, v, w], &d));
                *z = add3(z, &sym_mul(p, &moved));
            }
        }
    }
}

/// d = x − c, in length units.
#[inline(always)]
fn offset(x: &[f32; 3], centre: &[f32; 3], per_length: f32) -> [f32; 3] {
    core::array::from_fn(|axis| (x[axis] - centre[axis]) * per_length)
}

fn mean_positions(aggregates: &Aggregates<'_>, x: &[[f32; 3]], centres: &mut [[f32; 3]]) {
    centres.fill([0.0; 3]);
    let mut counts = [0.0_f32; MAX_AGGREGATES];
    for (x, &of) in x.iter().zip(aggregates.of()) {
        let of = usize::from(of);
        if let (Some(sum), Some(count)) = (centres.get_mut(of), counts.get_mut(of)) {
            *sum = add3(sum, x);
            *count += 1.0;
        }
    }
    for (sum, &count) in centres.iter_mut().zip(&counts) {
        *sum = scale3(sum, ratio_or_zero(1.0, count, 0.0));
    }
}

/// The upper triangle of E, row after row.
struct Matrix<'a> {
    rows: &'a mut [f32],
    modes: usize,
}

impl Matrix<'_> {
    /// Adds to row `mode` of aggregate `a`, in the columns of aggregate `b` ≥ `a`; the part left of the
    /// diagonal is left out.
    #[inline(always)]
    fn add(&mut self, a: u8, mode: usize, b: u8, values: impl Iterator<Item = f32>) {
        let (row, column) = (MODES * usize::from(a) + mode, MODES * usize::from(b));
        let left_out = row.saturating_sub(column);
        let start = row * (2 * self.modes).saturating_sub(row + 1) / 2 + column + left_out;
        let entries = self.rows.get_mut(start..start + MODES - left_out);
        for (entry, value) in entries
            .unwrap_or_default()
            .iter_mut()
            .zip(values.skip(left_out))
        {
            *entry += value;
        }
    }
}

/// Mass, friction, and what the filter forbids.
fn add_nodes(
    aggregates: &Aggregates<'_>,
    inertia: &[f32],
    filter: &[Sym3<f32>],
    blocks: &[Sym3<f32>],
    offsets: &[[f32; 3]],
    e: &mut Matrix<'_>,
) {
    let nodes = inertia.iter().zip(filter).zip(blocks).zip(offsets);
    for ((((&m, p), s), d), &of) in nodes.zip(aggregates.of()) {
        if of == NONE {
            continue;
        }
        let forbidden = |u: &[f32; 3]| {
            let free = sym_mul(p, u);
            [u[0] - free[0], u[1] - free[1], u[2] - free[2]]
        };
        for mode in 0..MODES {
            let u = motion(mode, d);
            let f = forbidden(&sym_mul(s, &forbidden(&u)));
            let f = add3(&f, &scale3(&u, m));
            e.add(of, mode, of, restricted(d, &f).into_iter());
        }
    }
}

/// The aggregates of one tetrahedron, in rising order, each once, then [`NONE`]; nothing where it is not cut.
fn cut(of: [u8; 4]) -> [u8; 4] {
    let mut sorted = of;
    for (i, j) in [(0, 1), (2, 3), (0, 2), (1, 3), (1, 2)] {
        if sorted[i] > sorted[j] {
            sorted.swap(i, j);
        }
    }
    let mut distinct = [NONE; 4];
    if sorted[0] != sorted[3] {
        let mut count = 0;
        for (i, &of) in sorted.iter().enumerate() {
            if i == 0 || of != sorted[i - 1] {
                distinct[count] = of;
                count += 1;
            }
        }
    }
    distinct
}

/// The aggregates of a tetrahedron's corners.
#[inline(never)]
fn aggregates_of(tet: &TetBlock, lane: usize, of: &[u8]) -> [u8; 4] {
    let aggregate = |node: u32| of.get(node as usize).copied().unwrap_or(NONE);
    core::array::from_fn(|corner| aggregate(tet.corners[corner][lane % BLOCK]))
}

/// What a block of eight tetrahedra is to the coarse space.
struct Cuts {
    /// The aggregates of each lane, as [`cut`] has them.
    aggregates: [[u8; 4]; BLOCK],
    /// 1 where the corner is in the slot-th aggregate of its lane, else 0: `[slot][corner][lane]`.
    members: [[[f32; BLOCK]; 4]; 4],
    /// d of the corners, `[corner][axis][lane]`.
    offsets: [[[f32; BLOCK]; 3]; 4],
    /// The most aggregates of a lane.
    slots: usize,
}

impl Cuts {
    const EMPTY: Self = Self {
        aggregates: [[0; 4]; BLOCK],
        members: [[[0.0; BLOCK]; 4]; 4],
        offsets: [[[0.0; BLOCK]; 3]; 4],
        slots: 0,
    };

    /// Reads a block; whether any of its lanes is cut. Else nothing of use is here.
    fn read(&mut self, tet: &TetBlock, of: &[u8], offsets: &[[f32; 3]]) -> bool {
        let mut differs = 0;
        for lane in 0..BLOCK {
            let [a, b, c, d] = aggregates_of(tet, lane, of);
            differs |= (a ^ b) | (a ^ c) | (a ^ d);
        }
        if differs == 0 {
            return false;
        }
        self.slots = 0;
        for (lane, cuts) in self.aggregates.iter_mut().enumerate() {
            let of = aggregates_of(tet, lane, of);
            *cuts = cut(of);
            for (slot, (&aggregate, members)) in cuts.iter().zip(&mut self.members).enumerate() {
                if aggregate != NONE {
                    self.slots = self.slots.max(slot + 1);
                }
                for (members, of) in members.iter_mut().zip(of) {
                    let member = (aggregate != NONE) & (of == aggregate);
                    members[lane] = f32::from(u8::from(member));
                }
            }
            for (out, nodes) in self.offsets.iter_mut().zip(&tet.corners) {
                let d = offsets.get(nodes[lane] as usize).unwrap_or(&[0.0; 3]);
                for (out, d) in out.iter_mut().zip(d) {
                    out[lane] = *d;
                }
            }
        }
        true
    }

    #[inline(never)]
    fn fold<R: Lanes, L: Layout>(
        &self,
        tet: &TetBlock,
        rotated: &L::Rotated,
        slot: usize,
        at: usize,
    ) -> L::Folded<R> {
        // A tetrahedron has four slots: the remainder only keeps panics out of the binary, here and below.
        let members = &self.members[slot % 4];
        let members = core::array::from_fn(|corner| R::load(&members[corner], at));
        let d = core::array::from_fn(|corner| {
            core::array::from_fn(|axis| R::load(&self.offsets[corner][axis], at))
        });
        let group = Group {
            members: &members,
            d: &d,
        };
        L::fold(tet, rotated, at, &group)
    }
}

/// What [`add_cuts`] goes through, for the cost of a step.
pub(crate) fn load(blocks: &[TetBlock], aggregates: &Aggregates<'_>) -> Load {
    let pairs = |n: usize| n * (n + 1) / 2;
    let mut load = Load {
        aggregates: aggregates.count(),
        ..Load::default()
    };
    let mut cuts = Cuts::EMPTY;
    for tet in blocks {
        if !cuts.read(tet, aggregates.of(), &[]) {
            continue;
        }
        load.cut_blocks += 1;
        load.products += pairs(cuts.slots);
        for of in &cuts.aggregates {
            load.sums += pairs(of.iter().filter(|&&of| of != NONE).count());
        }
    }
    load
}

/// c_K Zᵀ K Z of the cut tetrahedra: motion by motion through the element's product.
fn add_cuts<R: Lanes, L: Layout>(
    aggregates: &Aggregates<'_>,
    operator: &Operator<'_, L>,
    offsets: &[[f32; 3]],
    e: &mut Matrix<'_>,
) {
    let scale = R::splat(operator.stiffness);
    let mut cuts = Cuts::EMPTY;
    for (tet, rotated) in operator.rest.blocks.iter().zip(operator.rotated) {
        if !cuts.read(tet, aggregates.of(), offsets) {
            continue;
        }
        for slot in 0..cuts.slots {
            for other in slot..cuts.slots {
                let mut rows = [[[0.0; BLOCK]; MODES]; MODES];
                let mut at = 0;
                while at < BLOCK {
                    let from = cuts.fold::<R, L>(tet, rotated, slot, at);
                    let to = cuts.fold::<R, L>(tet, rotated, other, at);
                    for (mode, row) in rows.iter_mut().enumerate() {
                        let response = L::response(tet, rotated, at, scale, (&from, mode), &to);
                        for (response, out) in response.into_iter().zip(row) {
                            response.store(out, at);
                        }
                    }
                    at += R::WIDTH;
                }
                for (lane, aggregates) in cuts.aggregates.iter().enumerate() {
                    let (a, b) = (aggregates[slot % 4], aggregates[other % 4]);
                    if b != NONE {
                        for (mode, row) in rows.iter().enumerate() {
                            e.add(a, mode, b, row.iter().map(|lanes| lanes[lane]));
                        }
                    }
                }
            }
        }
    }
}

/// E = L D Lᵀ in place; D⁻¹ on the diagonal.
fn factorise(e: &mut Matrix<'_>) {
    let mut entries = [0.0; MODES * MAX_AGGREGATES];
    let mut rows = &mut *e.rows;
    for (length, entry) in (1..=e.modes).rev().zip(&mut entries) {
        let (row, below) = rows.split_at_mut_checked(length).unwrap_or_default();
        *entry = row.first().copied().unwrap_or(0.0);
        rows = below;
    }
    let mut rows = &mut *e.rows;
    for (length, &entry) in (1..=e.modes).rev().zip(&entries) {
        let (row, below) = rows.split_at_mut_checked(length).unwrap_or_default();
        let Some((pivot, row)) = row.split_first_mut() else {
            return;
        };
        *pivot = ratio_or_zero(1.0, *pivot, ROUNDING * entry);
        let mut left = &mut *below;
        for (k, &u) in row.iter().enumerate() {
            let l = u * *pivot;
            let l = Mask::of(l.is_finite()).keep(l);
            let (target, next) = left
                .split_at_mut_checked(length - 1 - k)
                .unwrap_or_default();
            for (target, u) in target.iter_mut().zip(row.iter().skip(k)) {
                *target -= l * u;
            }
            left = next;
        }
        for u in row.iter_mut() {
            let l = *u * *pivot;
            *u = Mask::of(l.is_finite()).keep(l);
        }
        rows = below;
    }
}

/// y ← (L D Lᵀ)⁻¹ y
fn solve(factor: &[f32], aggregates: usize, motions: &mut [[f32; MODES]; MAX_AGGREGATES]) {
    let modes = MODES * aggregates;
    let y = motions.as_flattened_mut();
    let y = y.get_mut(..modes).unwrap_or_default();
    // L y = r, then D
    let (mut rows, mut left) = (factor, &mut *y);
    while let Some((first, others)) = left.split_first_mut() {
        let (row, below) = rows.split_at_checked(1 + others.len()).unwrap_or_default();
        if let Some((pivot, row)) = row.split_first() {
            for (other, l) in others.iter_mut().zip(row) {
                *other -= l * *first;
            }
            *first *= pivot;
        }
        (rows, left) = (below, others);
    }
    // Lᵀ z = y, from the last row to the first
    let mut rows = factor;
    for k in (0..modes).rev() {
        let start = rows.len().saturating_sub(modes - k);
        let (above, row) = rows.split_at_checked(start).unwrap_or_default();
        let (first, others) = y.split_at_mut_checked(k + 1).unwrap_or_default();
        if let (Some((_, row)), Some(z)) = (row.split_first(), first.last_mut()) {
            *z -= dot_numbers(row, others);
        }
        rows = above;
    }
}
