//! Boxes around runs of a surface's triangles: a complete binary tree without pointers.
//!
//! Box 1 is around all t triangles, boxes 2k and 2k + 1 are the two halves of box k, and leaf i of 2^l is around triangles
//! ⌊i t/2^l⌋ to ⌊(i + 1) t/2^l⌋. So the tree is known from t alone, is as good as the order of the triangles is
//! ([`spatial_order`](super::spatial_order)), and what changes from step to step is boxes only, refitted from the leaves up
//! (van den Bergen, "Efficient Collision Detection of Complex Deformable Models using AABB Trees", 1997).
//!
//! # Exact pruning
//!
//! What a search finds is what it would find among all triangles, to the last bit. The point of a triangle that is
//! nearest to p is computed as q = u a + v b + w c, with u, v, w ≥ −2ε and their sum within 2ε of 1 (ε = 2⁻²⁴): three products,
//! two sums, so on each axis within 12 ε M of the corners' range, M the greatest of their |coordinates|. Leaves are made wider
//! by 16 ε M. Rounding is monotone, so p − q is nowhere smaller than the distance of p from the box, as computed, nor is
//! the sum of its squares, and boxes of boxes hold theirs exactly.

use core::ops::Range;

use glam::Vec3;

use crate::coupling::{CoupleStep, Piece};

/// Triangles of a leaf, at most, where there is room for all boxes.
const RUN: usize = 4;

/// Boxes for the search among so many triangles of a piece; with fewer it is slower, and finds the same.
#[must_use]
pub const fn boxes(triangles: usize) -> usize {
    2 * triangles.div_ceil(RUN).next_power_of_two() - 1
}

/// [`boxes`] in bytes.
#[must_use]
pub const fn boxes_bytes(triangles: usize) -> usize {
    boxes(triangles) * size_of::<Aabb>()
}

/// A box along the axes, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    pub(super) low: Vec3,
    pub(super) high: Vec3,
}

impl Aabb {
    /// Room for one: a search writes it before it reads it.
    pub const EMPTY: Self = Self {
        low: Vec3::ZERO,
        high: Vec3::ZERO,
    };

    /// Around nothing.
    pub(super) const NONE: Self = Self {
        low: Vec3::INFINITY,
        high: Vec3::NEG_INFINITY,
    };

    pub(super) fn add(&mut self, point: Vec3) {
        self.low = each(self.low, point, less);
        self.high = each(self.high, point, more);
    }

    fn join(&self, other: &Self) -> Self {
        Self {
            low: each(self.low, other.low, less),
            high: each(self.high, other.high, more),
        }
    }

    /// What both have in common, `margin` wider; nothing where they are apart.
    pub(super) fn meet(&self, other: &Self, margin: f32) -> Option<Self> {
        let low = each(self.low, other.low, more) - Vec3::splat(margin);
        let high = each(self.high, other.high, less) + Vec3::splat(margin);
        let meets = low.x <= high.x && low.y <= high.y && low.z <= high.z;
        meets.then_some(Self { low, high })
    }

    pub(super) fn holds(&self, p: Vec3) -> bool {
        let (low, high) = (self.low, self.high);
        (p.x >= low.x)
            & (p.y >= low.y)
            & (p.z >= low.z)
            & (p.x <= high.x)
            & (p.y <= high.y)
            & (p.z <= high.z)
    }

    /// 16 ε M wider on each axis.
    fn widened(&self) -> Self {
        let most = each(self.low.abs(), self.high.abs(), more);
        let slack = most * (8.0 * f32::EPSILON);
        Self {
            low: self.low - slack,
            high: self.high + slack,
        }
    }

    /// Of the distance of `p`, 0 inside.
    pub(super) fn square(&self, p: Vec3) -> f32 {
        let outside = each(self.low - p, p - self.high, more);
        let outside = each(outside, Vec3::ZERO, more);
        outside.dot(outside)
    }
}

fn each(a: Vec3, b: Vec3, f: impl Fn(f32, f32) -> f32) -> Vec3 {
    Vec3::new(f(a.x, b.x), f(a.y, b.y), f(a.z, b.z))
}

fn less(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

fn more(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

/// Triangles of leaf `i` of 2^`levels`.
pub(super) fn run(i: usize, levels: u32, triangles: usize) -> Range<usize> {
    // Both below 2³²: nodes and their triangles are counted in u32.
    let cut = |i: usize| ((i as u64 * triangles as u64) >> levels) as usize;
    cut(i)..cut(i + 1)
}

/// The tree over a piece's triangles, in memory of the caller's.
#[derive(Debug)]
pub(super) struct Tree<'a, 'b> {
    pub piece: &'a Piece<'a>,
    boxes: &'b mut [Aabb],
    levels: u32,
    fitted: bool,
}

impl<'a, 'b> Tree<'a, 'b> {
    /// As deep as there are boxes for, from the front of `left`; without any, one run of all triangles.
    pub fn new(piece: &'a Piece<'a>, left: &mut &'b mut [Aabb]) -> Self {
        let most = boxes(piece.triangles.len());
        let room = if left.len() < most { left.len() } else { most };
        let levels = room.div_ceil(2).checked_ilog2().unwrap_or(0);
        let (boxes, rest) = core::mem::take(left)
            .split_at_mut_checked(room)
            .unwrap_or_default();
        *left = rest;
        Self {
            piece,
            boxes,
            levels,
            fitted: false,
        }
    }

    /// Box `k`, from 1.
    fn at(&self, k: usize) -> Option<&Aabb> {
        self.boxes.get(k.wrapping_sub(1))
    }

    /// Fits the boxes to where the nodes are, once a step.
    #[inline(never)]
    pub fn fit(&mut self, step: &CoupleStep<'_>) {
        if self.fitted || self.boxes.is_empty() {
            return;
        }
        self.fitted = true;
        let leaves = 1_usize << self.levels;
        for k in (1..2 * leaves).rev() {
            let around = match (self.at(2 * k), self.at(2 * k + 1)) {
                (Some(a), Some(b)) if k < leaves => a.join(b),
                _ => {
                    let run = run(k - leaves, self.levels, self.piece.triangles.len());
                    let triangles = self.piece.triangles.get(run).unwrap_or_default();
                    let corners = triangles.iter().filter_map(|nodes| corners(step, nodes));
                    corners.fold(Aabb::NONE, |all, own| all.join(&around(&own)))
                }
            };
            if let Some(place) = self.boxes.get_mut(k - 1) {
                *place = around;
            }
        }
    }

    /// Calls `look` for the triangles whose boxes are no farther from `p` than the root of `limit`, near boxes first;
    /// it may lower the limit.
    pub fn walk(
        &self,
        step: &CoupleStep<'_>,
        p: Vec3,
        limit: &mut f32,
        mut look: impl FnMut(u32, [Vec3; 3], &mut f32),
    ) {
        let leaves = 1_usize << self.levels;
        let square = |k: usize| self.at(k).map_or(0.0, |b| b.square(p));
        // A bit for each level below the root: whether it is the second of its pair that is being visited.
        let (mut k, mut seconds) = (1_usize, 0_u32);
        loop {
            let near = square(k) <= *limit;
            if near && k < leaves {
                k = 2 * k + usize::from(square(2 * k + 1) < square(2 * k));
                seconds <<= 1;
                continue;
            }
            if near {
                let run = run(k - leaves, self.levels, self.piece.triangles.len());
                self.each_of(run, step, p, limit, &mut look);
            }
            while seconds & 1 == 1 {
                seconds >>= 1;
                k >>= 1;
            }
            if k <= 1 {
                return;
            }
            seconds |= 1;
            k ^= 1;
        }
    }

    fn each_of(
        &self,
        run: Range<usize>,
        step: &CoupleStep<'_>,
        p: Vec3,
        limit: &mut f32,
        look: &mut impl FnMut(u32, [Vec3; 3], &mut f32),
    ) {
        let triangles = self.piece.triangles.get(run.clone()).unwrap_or_default();
        for (index, nodes) in run.zip(triangles) {
            let Some(corners) = corners(step, nodes) else {
                continue;
            };
            if around(&corners).square(p) <= *limit {
                look(index as u32, corners, limit);
            }
        }
    }
}

fn corners(step: &CoupleStep<'_>, &[i, j, k]: &[u32; 3]) -> Option<[Vec3; 3]> {
    let place = |node: u32| step.x.get(node as usize).map(|x| Vec3::from_array(*x));
    Some([place(i)?, place(j)?, place(k)?])
}

pub(super) fn around(&[a, b, c]: &[Vec3; 3]) -> Aabb {
    let mut out = Aabb { low: a, high: a };
    out.add(b);
    out.add(c);
    out.widened()
}
