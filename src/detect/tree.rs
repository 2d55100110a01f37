//! Boxes around runs of a surface's triangles, or of its edges: a complete binary tree without pointers.
//!
//! Box 1 is around all t items, boxes 2k and 2k + 1 are the two halves of box k, and leaf i of 2^l is around items
//! ⌊i t/2^l⌋ to ⌊(i + 1) t/2^l⌋. So the tree is known from t alone, is as good as the order of the items is
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

use crate::coupling::CoupleStep;

/// Items of a leaf, at most, where there is room for all boxes.
const RUN: usize = 4;

/// Boxes for the search among so many triangles of a piece, or edges; with fewer it is slower, and finds the same.
#[must_use]
pub const fn boxes(items: usize) -> usize {
    if items <= RUN {
        return 0;
    }
    2 * items.div_ceil(RUN).next_power_of_two() - 1
}

/// [`boxes`] in bytes.
#[must_use]
pub const fn boxes_bytes(items: usize) -> usize {
    boxes(items) * size_of::<Aabb>()
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

    #[inline]
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
    #[inline]
    fn widened(&self) -> Self {
        let most = each(self.low.abs(), self.high.abs(), more);
        let slack = most * (8.0 * f32::EPSILON);
        Self {
            low: self.low - slack,
            high: self.high + slack,
        }
    }

    pub(super) fn at(point: Vec3) -> Self {
        Self {
            low: point,
            high: point,
        }
    }

    /// Of the distance between both, 0 where they meet.
    #[inline]
    pub(super) fn square(&self, other: &Self) -> f32 {
        let outside = each(self.low - other.high, other.low - self.high, more);
        let outside = each(outside, Vec3::ZERO, more);
        outside.dot(outside)
    }
}

#[inline]
fn each(a: Vec3, b: Vec3, f: impl Fn(f32, f32) -> f32) -> Vec3 {
    Vec3::new(f(a.x, b.x), f(a.y, b.y), f(a.z, b.z))
}

fn less(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

fn more(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

/// Items of leaf `i` of 2^`levels`.
pub(super) fn run(i: usize, levels: u32, items: usize) -> Range<usize> {
    // Both below 2³²: nodes and what is between them are counted in u32.
    let cut = |i: usize| ((i as u64 * items as u64) >> levels) as usize;
    cut(i)..cut(i + 1)
}

/// Half as many as there are boxes, as a power of two: log₂ of the leaves. 0, one run of all, without boxes.
fn levels(boxes: &[Aabb]) -> u32 {
    boxes.len().div_ceil(2).checked_ilog2().unwrap_or(0)
}

/// Fits boxes to where the nodes are.
#[inline(never)]
pub(super) fn fit<const N: usize>(boxes: &mut [Aabb], items: &[[u32; N]], step: &CoupleStep<'_>) {
    let levels = levels(boxes);
    let leaves = 1_usize << levels;
    for k in (1..2 * leaves).rev() {
        let child = |c: usize| boxes.get(c.wrapping_sub(1));
        let around = match (child(2 * k), child(2 * k + 1)) {
            (Some(a), Some(b)) if k < leaves => a.join(b),
            _ => {
                let items = items.get(run(k - leaves, levels, items.len()));
                let corners = items.unwrap_or_default().iter();
                let corners = corners.filter_map(|nodes| corners_of(step, nodes));
                corners.fold(Aabb::NONE, |all, own| all.join(&around(&own)))
            }
        };
        if let Some(place) = boxes.get_mut(k - 1) {
            *place = around;
        }
    }
}

/// The tree over the triangles or edges of a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tree<'a, const N: usize> {
    /// Nodes of each.
    pub items: &'a [[u32; N]],
    /// Fitted.
    pub boxes: &'a [Aabb],
}

impl<const N: usize> Tree<'_, N> {
    /// Calls `look` for the items whose boxes are no farther from `from` than the root of `limit`, near boxes first;
    /// it may lower the limit.
    pub fn walk(
        &self,
        step: &CoupleStep<'_>,
        from: &Aabb,
        limit: &mut f32,
        mut look: impl FnMut(u32, [Vec3; N], &mut f32),
    ) {
        let levels = levels(self.boxes);
        let leaves = 1_usize << levels;
        // Boxes are counted from 1.
        let square = |k: usize| {
            let here = self.boxes.get(k.wrapping_sub(1));
            here.map_or(0.0, |b| b.square(from))
        };
        // A bit for each level below the root: whether it is the second of its pair that is being visited.
        let (mut k, mut seconds) = (1_usize, 0_u32);
        let mut near = square(k) <= *limit;
        loop {
            if near && k < leaves {
                let (a, b) = (square(2 * k), square(2 * k + 1));
                k = 2 * k + usize::from(b < a);
                seconds <<= 1;
                near = (if b < a { b } else { a }) <= *limit;
                continue;
            }
            if near {
                let run = run(k - leaves, levels, self.items.len());
                self.each_of(run, step, from, limit, &mut look);
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
            near = square(k) <= *limit;
        }
    }

    fn each_of(
        &self,
        run: Range<usize>,
        step: &CoupleStep<'_>,
        from: &Aabb,
        limit: &mut f32,
        look: &mut impl FnMut(u32, [Vec3; N], &mut f32),
    ) {
        let items = self.items.get(run.clone()).unwrap_or_default();
        for (index, nodes) in run.zip(items) {
            let Some(corners) = corners_of(step, nodes) else {
                continue;
            };
            if around(&corners).square(from) <= *limit {
                look(index as u32, corners, limit);
            }
        }
    }
}

#[inline]
pub(super) fn corners_of<const N: usize>(
    step: &CoupleStep<'_>,
    nodes: &[u32; N],
) -> Option<[Vec3; N]> {
    let mut corners = [Vec3::ZERO; N];
    for (corner, &node) in corners.iter_mut().zip(nodes) {
        *corner = Vec3::from_array(*step.x.get(node as usize)?);
    }
    Some(corners)
}

#[inline]
pub(super) fn around(corners: &[Vec3]) -> Aabb {
    let mut out = Aabb::NONE;
    for &corner in corners {
        out.add(corner);
    }
    out.widened()
}
