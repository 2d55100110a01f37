//! Edges of one piece against edges of another.
//!
//! Two edges a + s d and b + t e touch where the points that are nearest to each other lie between their ends, with the normal
//! n = ±(d × e)/|d × e| of the sense in which a plane across n parts the two surfaces there: both triangles beside the first
//! edge on its upper side, both beside the second on its lower one. The gap is n·(a + s d − b − t e): the distance where the
//! surfaces are apart, minus the depth where each edge is inside the other body. (Ericson, *Real-Time Collision
//! Detection*, 2005, sections 5.1.9 and 5.2.1, on local geometry instead of whole convex bodies.)

use glam::Vec3;

use super::forest::Surface;
use super::surface::{nearest, reach};
use super::tree::{Tree, around, corners_of};
use super::{Bounds, Side, Touch};
use crate::coupling::CoupleStep;
use crate::math::sqrt;

/// sin² of the angle below which edges are parallel: their ends touch instead.
const PARALLEL: f32 = 1.0 / 64.0;
/// The part of an edge at either end where the end touches instead.
const END: f32 = 1.0 / 64.0;

/// Where two edges touch.
#[derive(Clone, Copy)]
struct Crossing {
    /// Of the first edge, of the second.
    at: [f32; 2],
    /// To the first edge.
    normal: Vec3,
    gap: f32,
}

/// Both by their ends and what the triangles beside them have besides.
#[inline(never)]
fn crossing([a, a1, a2, a3]: [Vec3; 4], [b, b1, b2, b3]: [Vec3; 4]) -> Option<Crossing> {
    let (d, e, r) = (a1 - a, b1 - b, a - b);
    let (dd, ee, de) = (d.dot(d), e.dot(e), d.dot(e));
    let (dr, er) = (d.dot(r), e.dot(r));
    let across = dd * ee - de * de;
    let both = dd * ee * PARALLEL;
    if across <= both || across <= 0.0 {
        return None;
    }
    let (s, t) = ((de * er - dr * ee) / across, (dd * er - de * dr) / across);
    let between = |x: f32| (END..=1.0 - END).contains(&x);
    if !(between(s) && between(t)) {
        return None;
    }
    let n = d.cross(e);
    let n = n / sqrt(n.dot(n));
    let parts = |n: Vec3| {
        let (above, below) = ([a2 - a, a3 - a], [b2 - b, b3 - b]);
        above.iter().all(|w| w.dot(n) >= 0.0) && below.iter().all(|w| w.dot(n) <= 0.0)
    };
    let normal = [n, -n].into_iter().find(|n| parts(*n))?;
    let apart = r + d * s - e * t;
    let gap = normal.dot(apart);
    gap.is_finite().then_some(Crossing {
        at: [s, t],
        normal,
        gap,
    })
}

/// The edge of the tree that is nearest to an edge, or least deep, by its number.
fn closest(
    step: &CoupleStep<'_>,
    edge: [Vec3; 4],
    tree: &Tree<'_, 4>,
    reach: f32,
) -> Option<(u32, Crossing)> {
    let mut best: Option<(u32, Crossing)> = None;
    let mut limit = reach * reach;
    tree.walk(step, &around(&edge[..2]), &mut limit, |index, other, _| {
        let Some(found) = crossing(edge, other) else {
            return;
        };
        let (far, first) = best.map_or((reach, u32::MAX), |(i, b)| (b.gap.abs(), i));
        let near = found.gap.abs();
        if near < far || (near == far && index < first) {
            best = Some((index, found));
        }
    });
    best
}

/// One of the two pieces, as its edges look for those of the other.
struct Looking<'s, 'a> {
    step: &'s CoupleStep<'s>,
    region: &'s Bounds,
    reach: f32,
    of: &'s Surface<'a>,
    other: &'s Surface<'a>,
}

impl Looking<'_, '_> {
    /// What an edge touches, if it is where the pieces meet.
    fn found(&self, edge: usize) -> Option<(u32, Crossing)> {
        let nodes = self.of.piece.edges.get(edge)?;
        let corners = corners_of(self.step, nodes)?;
        let ends = nodes.iter().take(2);
        let mut moving = ends.filter_map(|&node| super::moving(self.step, node));
        if !moving.any(|(x, v)| self.region.holds(x, v, self.step.dt))
            && around(&corners[..2]).square(&self.region.around) > 0.0
        {
            return None;
        }
        let (index, found) = closest(self.step, corners, &self.other.edges, self.reach)?;
        let [a, b, ..] = corners;
        let deep = found.gap >= 0.0 || {
            // Edges that cross far inside are not where the pieces meet: a face is nearer.
            let point = a + (b - a) * found.at[0];
            let face = nearest(self.step, point, self.other, self.reach)?;
            found.gap >= 2.0 * face.gap
        };
        deep.then_some((index, found))
    }

    fn side(surface: &Surface<'_>, edge: usize, at: f32) -> Option<Side> {
        let &[i, j, ..] = surface.piece.edges.get(edge)?;
        Some(Side {
            nodes: [i, j, i, j],
            weights: [1.0 - at, at, 0.0, 0.0],
            friction: surface.piece.friction,
            ..Side::NONE
        })
    }

    fn take(&self, touch: &mut Touch<'_, '_>, edge: usize, (other, found): (u32, Crossing)) {
        let sides = (
            Self::side(self.of, edge, found.at[0]),
            Self::side(self.other, other as usize, found.at[1]),
        );
        if let (Some(a), Some(b)) = sides {
            touch.pair(a, b, found.normal, found.gap);
        }
    }
}

/// Each edge of either piece against that of the other which it meets first; what two mean to each other counts once.
#[inline(never)]
pub(super) fn pair(
    touch: &mut Touch<'_, '_>,
    first: &Surface<'_>,
    second: &Surface<'_>,
    region: &Bounds,
) {
    if first.piece.edges.is_empty() || second.piece.edges.is_empty() {
        return;
    }
    let looking = |of, other| Looking {
        step: touch.step,
        region,
        reach: reach(touch, region.speed),
        of,
        other,
    };
    let (there, back) = (looking(first, second), looking(second, first));
    for edge in 0..first.piece.edges.len() {
        if let Some(found) = there.found(edge) {
            there.take(touch, edge, found);
        }
    }
    for edge in 0..second.piece.edges.len() {
        if let Some(found) = back.found(edge) {
            let mutual = there.found(found.0 as usize);
            if mutual.is_none_or(|(back, _)| back as usize != edge) {
                back.take(touch, edge, found);
            }
        }
    }
}
