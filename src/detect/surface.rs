//! Points against the triangles of a piece.

use glam::Vec3;

use super::point::on_triangle;
use super::{Bounds, DEPTH, Side, Touch, moving};
use crate::coupling::Piece;
use crate::math::sqrt;

/// Distances that differ by less than this part are the same: of two triangles that meet there, the one that
/// faces the point more says on which side it is.
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

/// The point of a piece's surface that is nearest to `p`, no farther than `reach`.
#[inline(never)]
pub(super) fn nearest(
    touch: &Touch<'_, '_>,
    p: Vec3,
    piece: &Piece<'_>,
    reach: f32,
) -> Option<Nearest> {
    let mut best: Option<Nearest> = None;
    let (mut least, mut facing) = (reach * reach, 0.0);
    let tiny = 1e-5 * touch.step.length_unit;
    for nodes in piece.triangles {
        let [Some((a, _)), Some((b, _)), Some((c, _))] = nodes.map(|n| moving(touch.step, n))
        else {
            continue;
        };
        let mut around = Bounds::NONE;
        for corner in [a, b, c] {
            around.add(corner);
        }
        around.low -= Vec3::splat(reach);
        around.high += Vec3::splat(reach);
        if !around.holds(p) {
            continue;
        }
        let weights = on_triangle(p, [a, b, c]);
        let q = a * weights[0] + b * weights[1] + c * weights[2];
        let apart = p - q;
        let square = apart.dot(apart);
        let area = (b - a).cross(c - a);
        let length = sqrt(area.dot(area));
        if length <= 0.0 || square > least * (1.0 + SAME) + tiny * tiny {
            continue;
        }
        let distance = sqrt(square);
        let height = apart.dot(area) / length;
        let facing_here = if distance > tiny {
            height.abs() / distance
        } else {
            1.0
        };
        let nearer = square < least * (1.0 - SAME) - tiny * tiny;
        if best.is_some() && !nearer && facing_here <= facing {
            continue;
        }
        let (normal, gap) = if distance > tiny {
            let signed = if height < 0.0 { -distance } else { distance };
            (apart / signed, signed)
        } else {
            (area / length, height)
        };
        if square < least {
            least = square;
        }
        facing = facing_here;
        let [i, j, k] = *nodes;
        let [u, v, w] = weights;
        best = Some(Nearest {
            side: Side {
                nodes: [i, j, k, i],
                weights: [u, v, w, 0.0],
                friction: piece.friction,
                ..Side::NONE
            },
            normal,
            gap,
        });
    }
    best
}

/// How far a point is to be looked for, that meets others at up to `speed`.
pub(super) fn reach(touch: &Touch<'_, '_>, speed: f32) -> f32 {
    DEPTH * touch.step.length_unit + touch.step.dt * speed
}

/// The surface nodes of one piece against the triangles of another.
#[inline(never)]
pub(super) fn pair(touch: &mut Touch<'_, '_>, of: &Piece<'_>, other: &Piece<'_>, region: &Bounds) {
    let reach = reach(touch, region.speed);
    for &node in of.nodes {
        let Some((x, v)) = moving(touch.step, node) else {
            continue;
        };
        if !(region.holds(x) || region.holds(x + v * touch.step.dt)) {
            continue;
        }
        if let Some(found) = nearest(touch, x, other, reach) {
            touch.pair(
                Side::node(node, of.friction),
                found.side,
                found.normal,
                found.gap,
            );
        }
    }
}
