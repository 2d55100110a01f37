//! Kernels of one lane in an engine, a block of tetrahedra at a time: see [`Lanes::STAGES`].
//!
//! An engine's compiler brings a straight run of code into an order of its own (seen in V8): all reads come first, then
//! arithmetic level by level, and what exceeds fifteen registers goes to the stack and back. Processors take about two reads
//! a cycle where they take four operations, so that those trips are what they wait for. But nothing is read before a store that it comes
//! after. So a kernel here is several loops over the eight tetrahedra of a block; each step of one reads little, and writes
//! what comes of it. Numbers and order of sums are the same as elsewhere.

use crate::algebra::{dot3, mul_vec, zero3};
use crate::element::{Bite, Dense, Factored, Layout, RotatedGradients, Unit, edges};
use crate::fan::{AXIS, NEXT, Nodes, RING, Sums, lanes};
use crate::lane::{BLOCK, Lanes};
use crate::operator::RotationBlock;
use crate::polar;
use crate::rest::TetBlock;

/// A 3×3 matrix of lanes, by rows.
pub(crate) type Matrix<R> = [[R; 3]; 3];

/// Eight tetrahedra in some state.
#[derive(Debug)]
pub struct Block<'a, L: Layout> {
    pub tet: &'a TetBlock,
    pub stiffness: &'a L::Stiffness,
    /// X of all nodes.
    pub rest: &'a [[f32; 3]],
    /// x of all nodes.
    pub x: &'a [[f32; 3]],
    pub rotation: &'a RotationBlock,
}

/// How a layout takes a block in stages.
pub trait Stages: Sized {
    /// [`Layout::rotate`] of a block, its forces added to `sums` and `out`. `h` is scratch, a matrix a bite.
    fn add_forces<R: Lanes>(
        block: &Block<'_, Self>,
        unit: impl Fn(usize) -> Unit<R>,
        scale: R,
        rotated: &mut <Self as Layout>::Rotated,
        _h: &mut [Matrix<R>],
        sums: &mut [Sums<R>],
        out: &mut [[f32; 3]],
    ) where
        Self: Layout,
    {
        for (sums, at) in sums.iter_mut().zip(lanes::<R>()) {
            let edges = |x: &[[f32; 3]]| edges(&corners(x, &block.tet.corners, at));
            let bite = Bite {
                tet: block.tet,
                stiffness: block.stiffness,
                at,
                edges: edges(block.x),
                rest_edges: edges(block.rest),
            };
            let q = polar::matrix(&block.rotation.load::<R>(at));
            let f = Self::rotate(&bite, &q, unit(at), scale, rotated);
            sums.add_balanced(&f, out, &block.tet.corners, at);
        }
    }

    /// [`Layout::product`] of a block with the node vectors `u`, added to `sums` and `out`. `h` is scratch, a matrix a bite.
    fn add_products<R: Lanes>(
        (tet, rotated): (&TetBlock, &<Self as Layout>::Rotated),
        scale: R,
        u: &[[f32; 3]],
        _h: &mut [Matrix<R>],
        sums: &mut [Sums<R>],
        out: &mut [[f32; 3]],
    ) where
        Self: Layout,
    {
        for (sums, at) in sums.iter_mut().zip(lanes::<R>()) {
            let edges = edges(&corners(u, &tet.corners, at));
            let f = Self::product(tet, rotated, at, scale, &edges);
            sums.add_balanced(&f, out, &tet.corners, at);
        }
    }
}

impl Stages for Dense {}

impl Stages for Factored {
    #[inline(always)]
    fn add_forces<R: Lanes>(
        block: &Block<'_, Self>,
        unit: impl Fn(usize) -> Unit<R>,
        scale: R,
        rotated: &mut RotatedGradients,
        h: &mut [Matrix<R>],
        sums: &mut [Sums<R>],
        out: &mut [[f32; 3]],
    ) {
        for at in lanes::<R>() {
            let q = polar::matrix(&block.rotation.load::<R>(at));
            Self::rotate_gradients(block.tet, &q, unit(at), at, rotated);
        }
        deformations(block.x, &block.tet.corners, &rotated.0, h);
        for (h, at) in h.iter_mut().zip(lanes::<R>()) {
            for axis in 0..3 {
                h[axis][axis] = h[axis][axis] - unit(at).length;
            }
        }
        add_stresses((block.tet, rotated), scale, h, sums, out);
    }

    #[inline(always)]
    fn add_products<R: Lanes>(
        (tet, rotated): (&TetBlock, &<Self as Layout>::Rotated),
        scale: R,
        u: &[[f32; 3]],
        h: &mut [Matrix<R>],
        sums: &mut [Sums<R>],
        out: &mut [[f32; 3]],
    ) {
        deformations(u, &tet.corners, &rotated.0, h);
        add_stresses((tet, rotated), scale, h, sums, out);
    }
}

/// Adds `scale` · V S G of a block's tetrahedra, with S from H.
#[inline(never)]
fn add_stresses<R: Lanes>(
    (tet, rotated): (&TetBlock, &RotatedGradients),
    scale: R,
    h: &[Matrix<R>],
    sums: &mut [Sums<R>],
    out: &mut [[f32; 3]],
) {
    for ((h, sums), at) in h.iter().zip(sums).zip(lanes::<R>()) {
        let s = Factored::scaled_stress(tet, at, scale, h);
        // Gradients are not read before this either.
        fence();
        if !R::has(out, &tet.corners[RING], at) {
            continue;
        }
        for corner in [RING, AXIS, NEXT] {
            let f = mul_vec(&s, &rotated.of(corner, at));
            sums.add_corner(corner, &f, out, &tet.corners, at);
        }
    }
}

/// Vectors of the four corners.
#[inline(always)]
fn corners<R: Lanes>(x: &[[f32; 3]], nodes: &Nodes, at: usize) -> [[R; 3]; 4] {
    core::array::from_fn(|corner| R::gather(x, &nodes[corner], at).unwrap_or(zero3()))
}

/// What stands before is read before, as far as the compiler goes: an engine keeps to the order that it finds.
#[inline(always)]
pub(crate) fn fence() {
    core::hint::black_box(());
}

/// Σ_j (x_j − x_0) g_jᵀ of a block's tetrahedra: F with their gradients at rest, H with the rotated ones. Zero where there is no such
/// node.
#[inline(never)]
pub(crate) fn deformations<R: Lanes>(
    x: &[[f32; 3]],
    nodes: &Nodes,
    gradients: &[[[f32; BLOCK]; 3]; 3],
    out: &mut [Matrix<R>],
) {
    for (out, at) in out.iter_mut().zip(lanes::<R>()) {
        let g: Matrix<R> = core::array::from_fn(|column| {
            core::array::from_fn(|j| R::load(&gradients[j][column], at))
        });
        for axis in 0..3 {
            // One axis is read when the one before is done with.
            let corner = |corner: usize| R::gather(x, &nodes[corner], at).map(|x| x[axis]);
            let (Some(a), Some(b), Some(c), Some(d)) = (corner(0), corner(1), corner(2), corner(3))
            else {
                *out = [zero3(); 3];
                break;
            };
            let edges = [b - a, c - a, d - a];
            for (out, g) in out[axis].iter_mut().zip(&g) {
                *out = dot3(&edges, g);
            }
        }
    }
}
