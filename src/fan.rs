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

use crate::algebra::{each3, sub3, zero3};
use crate::element::Layout;
use crate::lane::{BLOCK, Lanes};
use crate::rest::{Rest, TetBlock};

const APEX: usize = 0;
pub(crate) const AXIS: usize = 1;
pub(crate) const RING: usize = 2;
pub(crate) const NEXT: usize = 3;

/// Node numbers, `[corner][lane]`.
pub(crate) type Nodes = [[u32; BLOCK]; 4];

/// The blocks, eight fans at a time. None is empty.
#[inline(always)]
pub(crate) fn fans<'a, L: Layout>(rest: &Rest<'a, L>) -> impl Iterator<Item = &'a [TetBlock]> {
    let (mut left, mut known) = (rest.blocks, rest.fans);
    core::iter::from_fn(move || {
        let length = match known.first() {
            Some(&length) => length.max(1) as usize,
            None => length(left),
        };
        known = known.get(length..).unwrap_or_default();
        // No more than are left, but for none of none.
        let (fan, others) = left.split_at_checked(length)?;
        left = others;
        Some(fan)
    })
}

/// Writes what [`Rest::fans`] says.
pub(crate) fn find(blocks: &[TetBlock], out: &mut [u32]) {
    let (mut left, mut out) = (blocks, out);
    while let Some((first, _)) = out.split_first_mut() {
        let length = length(left).max(1);
        *first = u32::try_from(length).unwrap_or(1);
        left = left.get(length..).unwrap_or_default();
        out = out.get_mut(length..).unwrap_or_default();
    }
}

/// Blocks of the first eight fans; 1 where there is none.
#[inline(never)]
fn length(blocks: &[TetBlock]) -> usize {
    let pairs = blocks.iter().zip(blocks.iter().skip(1));
    let goes_on = |(TetBlock { corners: a, .. }, TetBlock { corners: b, .. }): &(&_, &_)| {
        same(&a[APEX], &b[APEX]) && same(&a[AXIS], &b[AXIS]) && same(&a[NEXT], &b[RING])
    };
    1 + pairs.take_while(goes_on).count()
}

/// `==` would call a routine that compares byte by byte on a Cortex-M. For WASM, size counts for more.
#[cfg_attr(target_arch = "wasm32", inline(never))]
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn same(a: &[u32; BLOCK], b: &[u32; BLOCK]) -> bool {
    let both = a.iter().zip(b);
    both.fold(0, |different, (a, b)| different | (a ^ b)) == 0
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

/// Reads node vectors along some fans side by side. One lane keeps nothing, and reads all four of a tetrahedron: what
/// eight fans share would be in memory, too, not in registers.
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
            let [apex, axis, next] = if R::WIDTH == 1 {
                [zero3(); 3]
            } else {
                let corner = |corner: usize| R::gather(u, &nodes[corner], at);
                each3([APEX, AXIS, RING], |node| corner(node).unwrap_or(zero3()))
            };
            Self {
                apex,
                axis: sub3(&axis, &apex),
                next: sub3(&next, &apex),
            }
        })
    }

    /// u_j − u_0 for j = 1, 2, 3 of the next tetrahedra. `None` where there is no such node.
    #[inline(always)]
    pub fn advance(&mut self, u: &[[f32; 3]], nodes: &Nodes, at: usize) -> Option<[[R; 3]; 3]> {
        let corner = |corner: usize| R::gather(u, &nodes[corner], at);
        if R::WIDTH == 1 {
            let apex = corner(APEX)?;
            // The ring's last: what is added there need not be checked again.
            let [axis, next, ring] = [corner(AXIS)?, corner(NEXT)?, corner(RING)?];
            return Some([sub3(&axis, &apex), sub3(&ring, &apex), sub3(&next, &apex)]);
        }
        let ring = self.next;
        self.next = sub3(&corner(NEXT)?, &self.apex);
        Some([self.axis, ring, self.next])
    }
}

/// Sums values at the corners along some fans side by side, and adds each sum to its node once: `N` numbers a node.
#[derive(Clone, Copy)]
pub struct Sums<R, const N: usize = 3> {
    apex: [R; N],
    axis: [R; N],
    next: [R; N],
}

impl<R: Lanes, const N: usize> Sums<R, N> {
    /// At the beginning of eight fans.
    #[inline(always)]
    pub fn open() -> R::Bites<Self> {
        let zero = [R::splat(0.0); N];
        R::bites(|_| Self {
            apex: zero,
            axis: zero,
            next: zero,
        })
    }

    /// Values at corners 1, 2, 3 of the next tetrahedra. Corner 0 is to balance them
    /// ([`Self::close_balanced`]).
    #[inline(always)]
    pub fn add_balanced(
        &mut self,
        [axis, ring, next]: &[[R; N]; 3],
        out: &mut [[f32; N]],
        nodes: &Nodes,
        at: usize,
    ) {
        self.add_corner(RING, ring, out, nodes, at);
        self.add_corner(AXIS, axis, out, nodes, at);
        self.add_corner(NEXT, next, out, nodes, at);
    }

    /// One of the values of [`Self::add_balanced`], which come in this order: at the ring's corner, the axis's, the next one's.
    #[inline(always)]
    pub fn add_corner(
        &mut self,
        corner: usize,
        value: &[R; N],
        out: &mut [[f32; N]],
        nodes: &Nodes,
        at: usize,
    ) {
        match corner {
            RING => {
                let Self { apex, next, .. } = self;
                let ring = |k: usize| {
                    let ring = next[k] + value[k];
                    apex[k] = apex[k] - ring;
                    ring
                };
                R::scatter_add_each(ring, out, &nodes[RING], at);
            }
            AXIS => self.axis = plus(&self.axis, value),
            _ => self.next = *value,
        }
    }

    /// Values at all four corners of the next tetrahedra.
    #[inline(always)]
    pub fn add(
        &mut self,
        [apex, axis, ring, next]: &[[R; N]; 4],
        out: &mut [[f32; N]],
        nodes: &Nodes,
        at: usize,
    ) {
        R::scatter_add(&plus(&self.next, ring), out, &nodes[RING], at);
        self.apex = plus(&self.apex, apex);
        self.axis = plus(&self.axis, axis);
        self.next = *next;
    }

    /// At the end of the fans, whose last block has these nodes.
    #[inline(always)]
    pub fn close(sums: &R::Bites<Self>, out: &mut [[f32; N]], nodes: &Nodes) {
        if R::WIDTH == 1 {
            Self::scatter_lanes(sums.as_ref(), out, nodes, false);
        } else {
            Self::scatter(sums.as_ref(), out, nodes, false);
        }
    }

    /// The same after [`Self::add_balanced`]: all that a fan adds sums to zero.
    #[inline(always)]
    pub fn close_balanced(sums: &R::Bites<Self>, out: &mut [[f32; N]], nodes: &Nodes) {
        if R::WIDTH == 1 {
            Self::scatter_lanes(sums.as_ref(), out, nodes, true);
        } else {
            Self::scatter(sums.as_ref(), out, nodes, true);
        }
    }

    /// [`Self::scatter`] once in the binary: a lane's sums are in memory anyway. Eight copies of each loop would be
    /// much flash (`.ci/run size`), so the compiler is not to know that there are eight.
    #[inline(never)]
    fn scatter_lanes(sums: &[Self], out: &mut [[f32; N]], nodes: &Nodes, balanced: bool) {
        Self::scatter(core::hint::black_box(sums), out, nodes, balanced);
    }

    #[inline(always)]
    fn scatter(sums: &[Self], out: &mut [[f32; N]], nodes: &Nodes, balanced: bool) {
        for (bite, sum) in sums.iter().enumerate() {
            R::scatter_add(&sum.next, out, &nodes[NEXT], bite * R::WIDTH);
        }
        for (bite, sum) in sums.iter().enumerate() {
            R::scatter_add(&sum.axis, out, &nodes[AXIS], bite * R::WIDTH);
        }
        for (bite, sum) in sums.iter().enumerate() {
            let apex = if balanced {
                minus(&minus(&sum.apex, &sum.next), &sum.axis)
            } else {
                sum.apex
            };
            R::scatter_add(&apex, out, &nodes[APEX], bite * R::WIDTH);
        }
    }
}

#[inline(always)]
fn plus<R: Lanes, const N: usize>(a: &[R; N], b: &[R; N]) -> [R; N] {
    core::array::from_fn(|k| a[k] + b[k])
}

#[inline(always)]
fn minus<R: Lanes, const N: usize>(a: &[R; N], b: &[R; N]) -> [R; N] {
    core::array::from_fn(|k| a[k] - b[k])
}
