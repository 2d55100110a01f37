//! Rigid bodies against pieces, each other, and colliders.

use glam::Vec3;

use super::forest::Surface;
use super::point::box_distance;
use super::surface::{nearest, reach};
use super::{Bounds, Side, Touch, moving};
use crate::math::sqrt;
use crate::rigid::{Rigid, Shape};

/// Distance of a point from the body's surface and the normal there.
#[inline(never)]
fn distance(rigid: &Rigid, p: Vec3) -> (f32, Vec3) {
    match rigid.shape {
        Shape::Ball { radius } => {
            let (length, normal) = direction(p - rigid.frame.centre);
            (length - radius, normal)
        }
        Shape::Cuboid { half } => {
            let (gap, normal) = box_distance(rigid.local(p), half);
            (gap, rigid.world(normal))
        }
    }
}

/// Length and direction; some direction where there is none.
fn direction(of: Vec3) -> (f32, Vec3) {
    let length = sqrt(of.dot(of));
    if length > 1e-18 {
        (length, of / length)
    } else {
        (0.0, Vec3::Y)
    }
}

#[inline(never)]
fn corners(rigid: &Rigid, half: Vec3) -> [Vec3; 8] {
    core::array::from_fn(|k| {
        let sign = |bit: usize| if k & bit == 0 { -1.0 } else { 1.0 };
        let local = Vec3::new(sign(1), sign(2), sign(4)) * half;
        rigid.frame.centre + rigid.world(local)
    })
}

/// Nodes of the piece against the shape, and the shape's own points against the piece.
#[inline(never)]
pub(super) fn against_piece(
    touch: &mut Touch<'_, '_>,
    index: u16,
    rigid: &Rigid,
    surface: &Surface<'_>,
    region: &Bounds,
) {
    let piece = surface.piece;
    for &node in piece.nodes {
        let Some((x, v)) = moving(touch.step, node) else {
            continue;
        };
        if !region.holds(x, v, touch.step.dt) {
            continue;
        }
        let (gap, normal) = distance(rigid, x);
        touch.pair(
            Side::node(node, piece.friction),
            Side::of_rigid(index, rigid, x - normal * gap),
            normal,
            gap,
        );
    }
    let reach = reach(touch, region.speed);
    match rigid.shape {
        Shape::Ball { radius } => {
            let centre = rigid.frame.centre;
            if let Some(found) = nearest(touch.step, centre, surface, reach + radius) {
                let at = centre - found.normal * radius;
                touch.pair(
                    Side::of_rigid(index, rigid, at),
                    found.side,
                    found.normal,
                    found.gap - radius,
                );
            }
        }
        Shape::Cuboid { half } => {
            for corner in corners(rigid, half) {
                if let Some(found) = nearest(touch.step, corner, surface, reach) {
                    touch.pair(
                        Side::of_rigid(index, rigid, corner),
                        found.side,
                        found.normal,
                        found.gap,
                    );
                }
            }
        }
    }
}

/// Two rigid bodies.
pub(super) fn pair(touch: &mut Touch<'_, '_>, first: (u16, &Rigid), second: (u16, &Rigid)) {
    match (first.1.shape, second.1.shape) {
        (Shape::Ball { radius }, _) => ball(touch, first, radius, second),
        (_, Shape::Ball { radius }) => ball(touch, second, radius, first),
        (Shape::Cuboid { half: a }, Shape::Cuboid { half: b }) => {
            boxes(touch, (first, a), (second, b));
        }
    }
}

#[inline(never)]
fn ball(
    touch: &mut Touch<'_, '_>,
    (index, ball): (u16, &Rigid),
    radius: f32,
    (other_index, other): (u16, &Rigid),
) {
    let centre = ball.frame.centre;
    let (gap, normal) = distance(other, centre);
    touch.pair(
        Side::of_rigid(index, ball, centre - normal * radius),
        Side::of_rigid(other_index, other, centre - normal * gap),
        normal,
        gap - radius,
    );
}

type Cuboid<'a> = ((u16, &'a Rigid), Vec3);

/// The axis and the sense of the first box along which the second is farthest outside: index, sign, gap.
#[inline(never)]
fn face((a, half): (&Rigid, Vec3), (b, other): (&Rigid, Vec3)) -> (usize, f32, f32) {
    let centre = a.local(b.frame.centre).to_array();
    let mut best = (0, 1.0, f32::NEG_INFINITY);
    for (axis, (c, half)) in centre.into_iter().zip(half.to_array()).enumerate() {
        let n = a.frame.axes[axis % 3];
        let size: f32 = {
            let [p, q, r] = b.frame.axes.map(|e| e.dot(n).abs());
            p * other.x + q * other.y + r * other.z
        };
        let gap = c.abs() - half - size;
        if gap > best.2 {
            best = (axis, if c < 0.0 { -1.0 } else { 1.0 }, gap);
        }
    }
    best
}

/// Corners of `b` over the face `axis` of `a`, whose outward side is `sign`.
#[inline(never)]
fn over(
    touch: &mut Touch<'_, '_>,
    ((index, a), half): Cuboid<'_>,
    (axis, sign): (usize, f32),
    ((other_index, b), other): Cuboid<'_>,
) {
    let n = a.frame.axes[axis % 3] * sign;
    for corner in corners(b, other) {
        let local = (a.local(corner)).to_array();
        let mut within = true;
        for (k, (x, half)) in local.into_iter().zip(half.to_array()).enumerate() {
            within &= k == axis || x.abs() <= half + touch.margin;
        }
        let gap = local[axis % 3] * sign - half.to_array()[axis % 3];
        // The corners of the far side are no contacts.
        let near = n.dot(corner - b.frame.centre) < 0.0;
        if within && near {
            touch.pair(
                Side::of_rigid(other_index, b, corner),
                Side::of_rigid(index, a, corner - n * gap),
                n,
                gap,
            );
        }
    }
}

#[inline(never)]
fn boxes(touch: &mut Touch<'_, '_>, first: Cuboid<'_>, second: Cuboid<'_>) {
    let one = face((first.0.1, first.1), (second.0.1, second.1));
    let two = face((second.0.1, second.1), (first.0.1, first.1));
    let (a, b, (axis, sign, _)) = if one.2 >= two.2 {
        (first, second, one)
    } else {
        (second, first, two)
    };
    over(touch, a, (axis, sign), b);
    // The face of the other box that looks at that one most.
    let n = a.0.1.frame.axes[axis % 3] * sign;
    let along = b.0.1.frame.axes.map(|e| e.dot(n));
    let mut most = 0;
    for k in 1..3 {
        if along[k].abs() > along[most % 3].abs() {
            most = k;
        }
    }
    let sign = if along[most % 3] > 0.0 { -1.0 } else { 1.0 };
    over(touch, b, (most, sign), a);
}

/// The ball's centre, or the corners of the box, against what nodes cannot enter.
#[inline(never)]
pub(super) fn against_colliders(touch: &mut Touch<'_, '_>, index: u16, rigid: &Rigid) {
    let colliders = touch.step.scene.colliders;
    for collider in colliders {
        let mut point = |p: Vec3, radius: f32| {
            let (distance, normal) = collider.distance(p);
            let at = p - normal * radius;
            touch.contact(
                Side::of_rigid(index, rigid, at),
                Side::NONE,
                normal,
                distance - radius,
                collider.friction(),
                collider.over(at, touch.step.dt).velocity,
            );
        };
        match rigid.shape {
            Shape::Ball { radius } => point(rigid.frame.centre, radius),
            Shape::Cuboid { half } => {
                for corner in corners(rigid, half) {
                    point(corner, 0.0);
                }
            }
        }
    }
}
