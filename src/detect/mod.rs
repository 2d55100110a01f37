//! Where pieces of a mesh touch: the search, without allocation.
//!
//! *Broad phase*: every pair of pieces, by boxes around their surface nodes now and after h v: P(P−1)/2 comparisons
//! for P soft pieces and rigid bodies. *Narrow phase*, for pairs whose boxes meet:
//!
//! * soft–soft: each surface node in the boxes' intersection against the triangles of the other piece, both ways: the
//!   nearest point, with the sign of the nearest triangle; then, where both pieces list sharp edges, each of these against
//!   that of the other piece to which it is nearest (normal and sign: file `edge.rs`);
//! * soft–ball, soft–box: each surface node against the shape, analytically; the ball's centre, or the box's corners,
//!   against the triangles, for shapes smaller than these;
//! * ball–ball, ball–box: analytically; box–box: along the face normal that separates them most, the corners of
//!   each within the other's face;
//! * ball–collider by its centre; box–collider by its eight corners.
//!
//! Found is what would come closer than a 64th of the length unit within the step at v(t). **Left out**: edges of
//! boxes, and of pieces that list none, against edges (soft meshes catch it at the next node; two boxes when a corner goes
//! in), edges within 7° of parallel (their ends touch), contact of a piece with itself, and faces of boxes against
//! spheres smaller than they.
//!
//! # Cost and bounds
//!
//! The search is the one part of a step whose cost depends on the state. Two pieces whose boxes are apart cost that
//! comparison. Else, once a step for each such piece of t triangles, a binary tree of [`boxes`]\(t\) < t boxes around them is
//! fitted to where they are; then each surface node, and each point of a rigid body, where the two boxes meet asks it for
//! the nearest triangle, in two passes: how far that is, and which of the triangles as near as that faces it most. Near
//! boxes come first, and what is farther than the nearest so far is left out. With triangles in
//! [`spatial_order`] that is some log₂ t boxes and a dozen triangles; at most, where all are equally near, a pass
//! looks twice at each box and once at each triangle, so that a point costs less than 6 t looks:
//!
//! | pair, n surface nodes, t triangles, e sharp edges | looks, fewer than | contacts, at most |
//! |---|---|---|
//! | two pieces | 6 (n₁t₂ + n₂t₁) + 2 (t₁ + t₂) | n₁ + n₂ |
//! | their edges | e₁(3e₂ + 6t₂) + e₂(3e₁ + 6t₁ + 3e₂ + 6t₂) + 2 (e₁ + e₂) | e₁ + e₂ |
//! | piece and ball | n + 8 t | n + 1 |
//! | piece and box | n + 50 t | n + 8 |
//! | box and box; box and collider; ball and any | 32; 8; 1 | 16; 8; 1 |
//!
//! In the scene `cars`, two bodies of 4,739 nodes that collide, the median step takes 1.3 times as long as without contact,
//! the slowest 2.2 times (`cargo run --release -p femto-bench --bin contact`).
//!
//! Why a tree and not a grid: its topology is that of the surface, which never changes, so it has no capacity
//! to overflow, needs no cell size, cannot degrade by more than the bound above when bodies are stretched or
//! crushed, and its pruning is exact. Its memory is the caller's
//! ([`Couplings::with_boxes`](crate::coupling::Couplings::with_boxes)), 24 bytes a box or 12 to 24 a triangle; with fewer boxes
//! the tree is less deep, with none every triangle is looked at, and **the contacts are the same to the bit**, in one
//! order: that of pieces, their nodes and edges. So small bodies on a microcontroller can do without.
//!
//! Where there are more contacts than slots, those that would be deepest at the end of the step are kept, as a
//! heap: log₂(slots) moves a contact. The others are counted in
//! [`StepReport::dropped`](crate::report::StepReport::dropped).
//!
//! **Fast bodies.** A node is looked for as far as it may travel in the step, and four length units (about two thirds of a
//! cell's edge) besides: what approaches is slowed before it is inside, at any speed at which the nearest surface now is
//! the one that it will hit. (`tests/contact_bodies/limits.rs`: a ball hits a block at up to 40 m/s and 150 steps a second,
//! 1.3 times its diameter a step.) What is already deeper than that is not seen any more, nor is what passes
//! through a whole body, or past an edge, within a step.

mod edge;
mod forest;
mod order;
mod point;
mod rigid;
mod slots;
mod surface;
mod tree;

pub use order::spatial_order;
pub use tree::{Aabb, boxes, boxes_bytes};

pub(crate) use slots::Slots;

use forest::Forest;
use glam::Vec3;

use crate::coupling::{CoupleStep, Coupling, Piece, SOFT};
use crate::math::sqrt;
use crate::rigid::{Rigid, Shape};

/// Most soft pieces.
pub const MAX_PIECES: usize = 64;

/// Most rigid bodies.
pub const MAX_RIGIDS: usize = 64;

/// What comes closer than this part of the length unit is a contact to decide on.
const MARGIN: f32 = 1.0 / 64.0;
/// How deep a node is seen, in length units.
const DEPTH: f32 = 4.0;

/// What two points at a contact have in common.
struct Touch<'s, 'a> {
    step: &'s CoupleStep<'s>,
    margin: f32,
    slots: &'s mut Slots<'a>,
}

/// One side of a contact.
#[derive(Clone, Copy)]
struct Side {
    nodes: [u32; 4],
    weights: [f32; 4],
    rigid: u16,
    friction: f32,
}

impl Side {
    const NONE: Self = Self {
        nodes: [0; 4],
        weights: [0.0; 4],
        rigid: SOFT,
        friction: 0.0,
    };

    fn node(node: u32, friction: f32) -> Self {
        Self {
            nodes: [node, 0, 0, 0],
            weights: [1.0, 0.0, 0.0, 0.0],
            friction,
            ..Self::NONE
        }
    }

    #[inline(never)]
    fn of_rigid(index: u16, rigid: &Rigid, point: Vec3) -> Self {
        Self {
            nodes: [0, 1, 2, 3].map(|k| rigid.first.wrapping_add(k)),
            weights: rigid.weights(point),
            rigid: index,
            friction: rigid.friction,
        }
    }
}

impl Touch<'_, '_> {
    /// Takes a contact between two sides.
    fn pair(&mut self, a: Side, b: Side, normal: Vec3, gap: f32) {
        let friction = sqrt(a.friction * b.friction);
        self.contact(a, b, normal, gap, friction, Vec3::ZERO);
    }

    #[inline(never)]
    fn contact(&mut self, a: Side, b: Side, normal: Vec3, gap: f32, friction: f32, drift: Vec3) {
        let join = |a: [u32; 4], b: [u32; 4]| [a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]];
        let [p, q, r, s] = a.weights;
        let [t, u, v, w] = b.weights;
        let mut contact = Coupling {
            nodes: join(a.nodes, b.nodes),
            weights: [p, q, r, s, -t, -u, -v, -w],
            rigid: [a.rigid, b.rigid],
            normal: normal.to_array(),
            gap,
            friction,
            drift: drift.to_array(),
            ..Coupling::EMPTY
        };
        let speed = Vec3::from_array(contact.relative(self.step.v)) - drift;
        contact.predicted = gap + self.step.dt * normal.dot(speed);
        if contact.predicted < self.margin {
            self.slots.push(&contact);
        }
    }
}

/// Around where a body is and will be, and the greatest speed in it.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    around: Aabb,
    speed: f32,
}

impl Bounds {
    #[inline(never)]
    fn of_piece(piece: &Piece<'_>, step: &CoupleStep<'_>) -> Self {
        let mut around = Aabb::NONE;
        let mut square = 0.0;
        for (x, v) in piece.nodes.iter().filter_map(|&node| moving(step, node)) {
            around.add(x);
            around.add(x + v * step.dt);
            let s = v.dot(v);
            square = if s > square { s } else { square };
        }
        let speed = sqrt(square);
        Self { around, speed }
    }

    #[inline(never)]
    fn of_rigid(rigid: &Rigid, step: &CoupleStep<'_>) -> Self {
        let mut square = 0.0;
        for (_, v) in (0..4).filter_map(|k| moving(step, rigid.first.wrapping_add(k))) {
            let s = v.dot(v);
            square = if s > square { s } else { square };
        }
        // No point of a box is √3 times as far from the centre as its nodes, of a ball √5.
        let speed = 2.5 * sqrt(square);
        let size = match rigid.shape {
            Shape::Ball { radius } => Vec3::splat(radius),
            Shape::Cuboid { half } => {
                let [a, b, c] = rigid.frame.axes;
                a.abs() * half.x + b.abs() * half.y + c.abs() * half.z
            }
        };
        let size = size + Vec3::splat(step.dt * speed);
        let around = Aabb {
            low: rigid.frame.centre - size,
            high: rigid.frame.centre + size,
        };
        Self { around, speed }
    }

    /// What both have in common, `margin` wider; nothing where they are apart.
    fn meet(&self, other: &Self, margin: f32) -> Option<Self> {
        let around = self.around.meet(&other.around, margin)?;
        let speed = self.speed + other.speed;
        Some(Self { around, speed })
    }

    /// Whether a node may touch something there in the step.
    fn holds(&self, x: Vec3, v: Vec3, dt: f32) -> bool {
        self.around.holds(x) || self.around.holds(x + v * dt)
    }
}

/// Place and velocity of a node.
fn moving(step: &CoupleStep<'_>, node: u32) -> Option<(Vec3, Vec3)> {
    let node = node as usize;
    let (x, v) = (step.x.get(node)?, step.v.get(node)?);
    Some((Vec3::from_array(*x), Vec3::from_array(*v)))
}

/// Finds all contacts, in the order of the pieces, their nodes and edges.
#[inline(never)]
pub(crate) fn find(
    pieces: &[Piece<'_>],
    boxes: &mut [Aabb],
    rigids: &[Rigid],
    step: &CoupleStep<'_>,
    slots: &mut Slots<'_>,
) {
    let margin = MARGIN * step.length_unit;
    let mut touch = Touch {
        step,
        margin,
        slots,
    };
    let mut forest = Forest::new(pieces, boxes);
    let mut bounds = heapless::Vec::<Bounds, MAX_PIECES>::new();
    for (index, piece) in pieces.iter().enumerate() {
        let own = Bounds::of_piece(piece, step);
        for (other, theirs) in bounds.iter().enumerate() {
            let Some(region) = own.meet(theirs, margin) else {
                continue;
            };
            forest.fit(other, step);
            forest.fit(index, step);
            if let (Some(a), Some(b)) = (forest.surface(other), forest.surface(index)) {
                surface::pair(&mut touch, &a, &b, &region);
                surface::pair(&mut touch, &b, &a, &region);
                edge::pair(&mut touch, &a, &b, &region);
            }
        }
        // As many fit as `check` lets pass.
        let _ = bounds.push(own);
    }
    for (index, rigid) in (1_u16..).zip(rigids) {
        let own = Bounds::of_rigid(rigid, step);
        for (piece, theirs) in bounds.iter().enumerate() {
            let Some(region) = own.meet(theirs, margin) else {
                continue;
            };
            forest.fit(piece, step);
            if let Some(surface) = forest.surface(piece) {
                rigid::against_piece(&mut touch, index, rigid, &surface, &region);
            }
        }
        for (other_index, other) in (1..index).zip(rigids) {
            if own.meet(&Bounds::of_rigid(other, step), margin).is_some() {
                rigid::pair(&mut touch, (other_index, other), (index, rigid));
            }
        }
        rigid::against_colliders(&mut touch, index, rigid);
    }
}
