//! Points against the triangles of a piece.

use glam::Vec3;

use super::forest::Surface;
use super::point::on_triangle;
use super::tree::Aabb;
use super::{Bounds, DEPTH, Side, Touch, moving};
use crate::coupling::CoupleStep;
use crate::math::sqrt;

/// Distances that differ by less than half this part are the same: of triangles that meet there, the one that faces
/// the point most says on which side it is.
const SAME: f32 = 1e-4;

/// The nearest point of a surface.
#[derive(Clone, Copy)]
pub(super) struct Nearest {
    pub side: Side,
    /// Outward.
    pub normal: Vec3,
    /// Negative inside.
    pub gap: f32,
}

/// A point and the nearest one of a triangle.
struct Foot {
    weights: [f32; 3],
    /// From there to the point.
    apart: Vec3,
    square: f32,
    /// Unit normal of the triangle.
    normal: Vec3,
    /// Over the triangle's plane.
    height: f32,
}

/// Nothing for a triangle without area.
#[inline(never)]
fn foot(p: Vec3, [a, b, c]: [Vec3; 3]) -> Option<Foot> {
    let weights = on_triangle(p, [a, b, c]);
    let q = a * weights[0] + b * weights[1] + c * weights[2];
    let apart = p - q;
    let area = (b - a).cross(c - a);
    let length = sqrt(area.dot(area));
    (length > 0.0).then(|| Foot {
        weights,
        apart,
        square: apart.dot(apart),
        normal: area / length,
        height: apart.dot(area) / length,
    })
}

/// The point of a piece's surface that is nearest to `p`, no farther than `reach`. Of triangles that are equally
/// near it is of the one that faces `p` most, and of those that do so equally of the first of the list.
#[inline(never)]
pub(super) fn nearest(
    step: &CoupleStep<'_>,
    p: Vec3,
    surface: &Surface<'_>,
    reach: f32,
) -> Option<Nearest> {
    let (tree, here) = (&surface.triangles, Aabb::at(p));
    let mut least = reach * reach;
    let mut found = false;
    tree.walk(step, &here, &mut least, |index, corners, least| {
        if !is_torn(step, surface.piece, index)
            && let Some(foot) = foot(p, corners)
            && foot.square <= *least
        {
            *least = foot.square;
            found = true;
        }
    });
    if !found {
        return None;
    }
    let tiny = 1e-5 * step.length_unit;
    let mut limit = least * (1.0 + SAME) + tiny * tiny;
    let mut best: Option<(f32, u32, Nearest)> = None;
    tree.walk(step, &here, &mut limit, |index, corners, limit| {
        let Some(foot) = foot(p, corners) else {
            return;
        };
        if is_torn(step, surface.piece, index) {
            return;
        }
        let distance = sqrt(foot.square);
        let touching = distance <= tiny;
        let facing = if touching {
            1.0
        } else {
            foot.height.abs() / distance
        };
        let better = best
            .as_ref()
            .is_none_or(|(most, first, _)| facing > *most || (facing == *most && index < *first));
        if foot.square > *limit || !better {
            return;
        }
        let (normal, gap) = if touching {
            (foot.normal, foot.height)
        } else {
            let signed = if foot.height < 0.0 {
                -distance
            } else {
                distance
            };
            (foot.apart / signed, signed)
        };
        let [i, j, k] = tree.items.get(index as usize).copied().unwrap_or_default();
        let [u, v, w] = foot.weights;
        let side = Side {
            nodes: [i, j, k, i],
            weights: [u, v, w, 0.0],
            friction: surface.piece.friction,
            ..Side::NONE
        };
        best = Some((facing, index, Nearest { side, normal, gap }));
    });
    best.map(|(_, _, nearest)| nearest)
}

/// Whether the tetrahedron of a triangle has failed.
fn is_torn(step: &CoupleStep<'_>, piece: &crate::coupling::Piece<'_>, triangle: u32) -> bool {
    #[cfg(feature = "fracture")]
    if let Some(&tet) = piece.tets.get(triangle as usize) {
        return crate::fracture::has_failed(step.broken, tet as usize);
    }
    let _ = (step, piece, triangle);
    false
}

/// How far a point is to be looked for, that meets others at up to `speed`.
pub(super) fn reach(touch: &Touch<'_, '_>, speed: f32) -> f32 {
    DEPTH * touch.step.length_unit + touch.step.dt * speed
}

/// The surface nodes of one piece against the triangles of another.
#[inline(never)]
pub(super) fn pair(
    touch: &mut Touch<'_, '_>,
    of: &Surface<'_>,
    other: &Surface<'_>,
    region: &Bounds,
) {
    let reach = reach(touch, region.speed);
    for &node in of.piece.nodes {
        let Some((x, v)) = moving(touch.step, node) else {
            continue;
        };
        if !region.holds(x, v, touch.step.dt) {
            continue;
        }
        if let Some(found) = nearest(touch.step, x, other, reach) {
            touch.pair(
                Side::node(node, of.piece.friction),
                found.side,
                found.normal,
                found.gap,
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tree::around;
    use super::*;

    /// What the pruning of the tree rests on, in f32 as computed: corners at up to 1e4 m, some triangles almost lines.
    #[test]
    fn no_foot_is_nearer_than_the_box() {
        let mut state = 7_u64;
        let mut number = |size: f32| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            ((state >> 40) as f32 / (1 << 23) as f32 - 1.0) * size
        };
        for k in 0..100_000 {
            let at = number([0.0, 1.0, 100.0, 1e4][k % 4]);
            let thin = [1.0, 1e-3, 1e-6, 0.0][k / 4 % 4];
            let mut point =
                |thin: f32| Vec3::new(at + number(1.0), at + number(thin), at + number(1.0));
            let corners = [point(thin), point(thin), point(thin)];
            let p = point(1.0);
            if let Some(foot) = foot(p, corners) {
                let square = around(&corners).square(&Aabb::at(p));
                assert!(
                    foot.square >= square,
                    "{p} {corners:?}: {} {square}",
                    foot.square
                );
            }
        }
    }
}
