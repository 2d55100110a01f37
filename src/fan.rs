//! Fans: tetrahedra around a common edge, which share the gathering and scattering of their nodes.
//!
//! A fan of k tetrahedra is their common edge, *apex* to *axis*, and the *ring* of k + 1 nodes around
//! it: tetrahedron i has the corners (apex, axis, ring i, ring i + 1). Taken one by one, they read and
//! write 4k node vectors; walked along the ring, k + 3.
//!
//! Fans need no storage of their own: a block of tetrahedra whose corners go on where those of the
//! block before end, in every lane, belongs to the same eight fans. [`order::fans`](crate::order::fans)
//! puts a mesh in such an order. In any other, a fan is a single tetrahedron; only the speed
//! differs.
//!
//! The order of sums is that of the blocks: a ring node after its last tetrahedron, at the end of a fan its
//! last ring node, axis and apex; each lane by lane.

use crate::algebra::{add3, sub3, zero3};
use crate::lane::{BLOCK, Lanes};
use crate::rest::TetBlock;

const APEX: usize = 0;
const AXIS: usize = 1;
const RING: usize = 2;
const NEXT: usize = 3;

/// Node numbers, `[corner][lane]`.
pub(crate) type Nodes = [[u32; BLOCK]; 4];

/// The blocks, eight fans at a time. None is empty.
#[inline(always)]
pub(crate) fn fans(blocks: &[TetBlock]) -> impl Iterator<Item = &[TetBlock]> {
    blocks.chunk_by(|TetBlock { corners: a, .. }, TetBlock { corners: b, .. }| {
        a[APEX] == b[APEX] && a[AXIS] == b[AXIS] && a[NEXT] == b[RING]
    })
}

/// The nodes at the end of some fans.
#[inline(always)]
pub(crate) fn last(fan: &[TetBlock]) -> &Nodes {
    fan.last()
        .map_or(&TetBlock::ZERO.corners, |tet| &tet.corners)
}

/// First lanes of the bites that a block is taken in.
#[inline(always)]
pub(crate) fn lanes<R: Lanes>() -> impl Iterator<Item = usize> {
    (0..BLOCK).step_by(R::WIDTH)
}

/// Reads node vectors along some fans side by side.
#[derive(Clone, Copy)]
pub(crate) struct Edges<R> {
    apex: [R; 3],
    axis: [R; 3],
    next: [R; 3],
}

impl<R: Lanes> Edges<R> {
    /// At the first blocks of eight fans.
    #[inline(always)]
    pub fn open(u: &[[f32; 3]], fan: &[TetBlock]) -> R::Bites<Self> {
        let nodes = fan
            .first()
            .map_or(&TetBlock::ZERO.corners, |tet| &tet.corners);
        R::bites(|at| {
            let apex = R::gather(u, &nodes[APEX], at);
            Self {
                apex,
                axis: sub3(&R::gather(u, &nodes[AXIS], at), &apex),
                next: sub3(&R::gather(u, &nodes[RING], at), &apex),
            }
        })
    }

    /// u_j − u_0 for j = 1, 2, 3 of the next tetrahedra.
    #[inline(always)]
    pub fn advance(&mut self, u: &[[f32; 3]], nodes: &Nodes, at: usize) -> [[R; 3]; 3] {
        let ring = self.next;
        self.next = sub3(&R::gather(u, &nodes[NEXT], at), &self.apex);
        [self.axis, ring, self.next]
    }
}

/// Sums values at the corners along some fans side by side, and adds each sum to its node once.
#[derive(Clone, Copy)]
pub(crate) struct Sums<R> {
    apex: [R; 3],
    axis: [R; 3],
    next: [R; 3],
}

impl<R: Lanes> Sums<R> {
    /// At the beginning of eight fans.
    #[inline(always)]
    pub fn open() -> R::Bites<Self> {
        R::bites(|_| Self {
            apex: zero3(),
            axis: zero3(),
            next: zero3(),
        })
    }

    /// Values at corners 1, 2, 3 of the next tetrahedra. Corner 0 is to balance them
    /// ([`Self::close_balanced`]).
    #[inline(always)]
    pub fn add_balanced(
        &mut self,
        [axis, ring, next]: &[[R; 3]; 3],
        out: &mut [[f32; 3]],
        nodes: &Nodes,
        at: usize,
    ) {
        let ring = add3(&self.next, ring);
        R::scatter_add(&ring, out, &nodes[RING], at);
        self.apex = sub3(&self.apex, &ring);
        self.axis = add3(&self.axis, axis);
        self.next = *next;
    }

    /// Values at all four corners of the next tetrahedra.
    #[inline(always)]
    pub fn add(
        &mut self,
        [apex, axis, ring, next]: &[[R; 3]; 4],
        out: &mut [[f32; 3]],
        nodes: &Nodes,
        at: usize,
    ) {
        R::scatter_add(&add3(&self.next, ring), out, &nodes[RING], at);
        self.apex = add3(&self.apex, apex);
        self.axis = add3(&self.axis, axis);
        self.next = *next;
    }

    /// At the end of the fans, whose last block has these nodes.
    #[inline(always)]
    pub fn close(sums: &R::Bites<Self>, out: &mut [[f32; 3]], nodes: &Nodes) {
        let sums = sums.as_ref();
        for (sum, at) in sums.iter().zip(lanes::<R>()) {
            R::scatter_add(&sum.next, out, &nodes[NEXT], at);
        }
        for (sum, at) in sums.iter().zip(lanes::<R>()) {
            R::scatter_add(&sum.axis, out, &nodes[AXIS], at);
        }
        for (sum, at) in sums.iter().zip(lanes::<R>()) {
            R::scatter_add(&sum.apex, out, &nodes[APEX], at);
        }
    }

    /// The same after [`Self::add_balanced`]: all that a fan adds sums to zero.
    #[inline(always)]
    pub fn close_balanced(sums: &mut R::Bites<Self>, out: &mut [[f32; 3]], nodes: &Nodes) {
        for sum in sums.as_mut() {
            sum.apex = sub3(&sub3(&sum.apex, &sum.next), &sum.axis);
        }
        Self::close(sums, out, nodes);
    }
}
