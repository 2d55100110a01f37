//! The system matrix, never assembled: gather, element product, scatter-add.
//!
//! A = c_M M + c_K K + Γ in the body's units, with c_M and c_K from the time step
//! (A = M + θ²h²K + θhD with D = αM + βK, so c_M = 1 + θhα and c_K = θ²h² + θhβ), and a diagonal Γ
//! from sliding friction.

use crate::algebra::{each4, zero3};
use crate::element::{Bite, Layout, Sym3, Unit, deformation, gradients};
use crate::fan::{Edges, Sums, fans, lanes, last};
use crate::inelastic::Share;
use crate::lane::{BLOCK, Lanes, Real};
use crate::pair::Pair;
use crate::polar::{self, Quaternion};
use crate::rest::{Rest, TetBlock};
use crate::stages::{Block, Matrix, deformations};

/// Rotations of eight tetrahedra as quaternions, `[component][lane]`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct RotationBlock(pub [[f32; BLOCK]; 4]);

impl RotationBlock {
    /// Before a body is placed. All bits zero.
    pub const ZERO: Self = Self([[0.0; BLOCK]; 4]);

    #[inline(always)]
    pub(crate) fn load<R: Lanes>(&self, at: usize) -> Quaternion<R> {
        core::array::from_fn(|c| R::load(&self.0[c], at))
    }

    #[inline(always)]
    fn store<R: Lanes>(&mut self, q: Quaternion<R>, at: usize) {
        for (component, out) in q.iter().zip(&mut self.0) {
            component.store(out, at);
        }
    }
}

/// A, applied matrix-free.
#[derive(Debug)]
pub struct Operator<'a, L: Layout> {
    /// Rest data of the body.
    pub rest: Rest<'a, L>,
    /// The rotated stiffness of this step, one a block of tetrahedra.
    pub rotated: &'a [L::Rotated],
    /// c_M m_i + γ_i of every node, per mass unit.
    pub inertia: &'a [f32],
    /// c_K, per mass unit and squared length unit.
    pub stiffness: f32,
}

impl<L: Layout> Clone for Operator<'_, L> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<L: Layout> Copy for Operator<'_, L> {}

impl<L: Layout> Operator<'_, L> {
    /// `out` = A u
    #[inline(never)]
    pub fn apply<R: Lanes>(&self, u: &[[f32; 3]], out: &mut [[f32; 3]]) {
        for ((out, u), m) in out.iter_mut().zip(u).zip(self.inertia) {
            *out = [m * u[0], m * u[1], m * u[2]];
        }
        self.add_stiffness::<R>(u, out);
    }

    /// `out` += c_K K u
    pub fn add_stiffness<R: Lanes>(&self, u: &[[f32; 3]], out: &mut [[f32; 3]]) {
        // Of one length, so that a node number is checked once.
        let nodes = u.len().min(out.len());
        let (Some(u), Some(out)) = (u.get(..nodes), out.get_mut(..nodes)) else {
            return;
        };
        let scale = R::splat(self.stiffness);
        let mut rotated = self.rotated.iter();
        let mut h = R::bites(|_| [zero3(); 3]);
        for fan in fans(&self.rest) {
            let mut edges = Edges::<R>::open(u, fan);
            let mut sums = Sums::<R>::open();
            for (tet, rotated) in fan.iter().zip(rotated.by_ref()) {
                if R::STAGES {
                    let (h, sums) = (h.as_mut(), sums.as_mut());
                    L::add_products((tet, rotated), scale, u, h, sums, out);
                    continue;
                }
                let bites = edges.as_mut().iter_mut().zip(sums.as_mut());
                for ((edges, sums), at) in bites.zip(lanes::<R>()) {
                    let Some(edges) = edges.advance(u, &tet.corners, at) else {
                        continue;
                    };
                    let f = L::product(tet, rotated, at, scale, &edges);
                    sums.add_balanced(&f, out, &tet.corners, at);
                }
            }
            Sums::<R>::close_balanced(&sums, out, last(fan));
        }
    }

    /// Writes the diagonal of A: half the work of [`Self::diagonal`].
    pub fn diagonal_entries<R: Lanes>(&self, out: &mut [[f32; 3]]) {
        for (out, &m) in out.iter_mut().zip(self.inertia) {
            *out = [m; 3];
        }
        let scale = R::splat(self.stiffness);
        let mut rotated = self.rotated.iter();
        for fan in fans(&self.rest) {
            let mut sums = Sums::<R>::open();
            for (tet, rotated) in fan.iter().zip(rotated.by_ref()) {
                for (sums, at) in sums.as_mut().iter_mut().zip(lanes::<R>()) {
                    let blocks = L::diagonal(tet, rotated, at, scale);
                    let entries = each4(blocks, |[x, _, _, y, _, z]| [x, y, z]);
                    sums.add(&entries, out, &tet.corners, at);
                }
            }
            Sums::<R>::close(&sums, out, last(fan));
        }
    }

    /// Writes the 3×3 diagonal blocks of A.
    pub fn diagonal<R: Lanes>(&self, out: &mut [Sym3<f32>]) {
        for (out, &m) in out.iter_mut().zip(self.inertia) {
            *out = [m, 0.0, 0.0, m, 0.0, m];
        }
        let scale = R::splat(self.stiffness);
        let mut rotated = self.rotated.iter();
        for fan in fans(&self.rest) {
            let mut sums = Sums::<R, 6>::open();
            for (tet, rotated) in fan.iter().zip(rotated.by_ref()) {
                for (sums, at) in sums.as_mut().iter_mut().zip(lanes::<R>()) {
                    let blocks = L::diagonal(tet, rotated, at, scale);
                    sums.add(&blocks, out, &tet.corners, at);
                }
            }
            Sums::<R, 6>::close(&sums, out, last(fan));
        }
    }
}

/// Rotates the stiffness of every tetrahedron and adds `scale` times the elastic forces at `x`
/// (metres; forces in newtons) to `out`.
pub fn rotate<R: Lanes, L: Layout>(
    rest: &Rest<'_, L>,
    x: &[[f32; 3]],
    rotations: &[RotationBlock],
    scale: f32,
    rotated: &mut [L::Rotated],
    out: &mut [[f32; 3]],
) {
    let whole = core::iter::repeat(());
    rotate_shares::<R, L, ()>(rest, x, rotations, whole, scale, rotated, out);
}

/// [`rotate`] of those tetrahedra that are there.
#[inline(always)]
pub(crate) fn rotate_shares<R: Lanes, L: Layout, S: Share>(
    rest: &Rest<'_, L>,
    x: &[[f32; 3]],
    rotations: &[RotationBlock],
    shares: impl Iterator<Item = S>,
    scale: f32,
    rotated: &mut [L::Rotated],
    out: &mut [[f32; 3]],
) {
    let length = rest.header.length_unit;
    let (scale, length) = (R::splat(-scale / (length * length)), R::splat(length));
    let unit = |share: S, at| Unit {
        length,
        share: share.of(length, at),
    };
    let blocks = rest.stiffness.iter().zip(rotations).zip(rotated);
    let mut blocks = blocks.zip(shares);
    let mut h = R::bites(|_| [zero3(); 3]);
    for fan in fans(rest) {
        let mut edges = Edges::<R>::open(x, fan);
        // Dead code where the layout does not ask for them.
        let mut rest_edges = Edges::<R>::open(rest.nodes, fan);
        let mut sums = Sums::<R>::open();
        for (tet, (((stiffness, rotation), rotated), share)) in fan.iter().zip(blocks.by_ref()) {
            if R::STAGES {
                let block = Block {
                    tet,
                    stiffness,
                    rest: rest.nodes,
                    x,
                    rotation,
                };
                let unit = |at| unit(share, at);
                let (h, sums) = (h.as_mut(), sums.as_mut());
                L::add_forces(&block, unit, scale, rotated, h, sums, out);
                continue;
            }
            let edges = edges.as_mut().iter_mut().zip(rest_edges.as_mut());
            let bites = edges.zip(sums.as_mut());
            for (((edges, rest_edges), sums), at) in bites.zip(lanes::<R>()) {
                let Some(edges) = edges.advance(x, &tet.corners, at) else {
                    continue;
                };
                let rest_edges = rest_edges.advance(rest.nodes, &tet.corners, at);
                let bite = Bite {
                    tet,
                    stiffness,
                    at,
                    edges,
                    rest_edges: rest_edges.unwrap_or([zero3(); 3]),
                };
                let q = polar::matrix(&rotation.load::<R>(at));
                let f = L::rotate(&bite, &q, unit(share, at), scale, rotated);
                sums.add_balanced(&f, out, &tet.corners, at);
            }
        }
        Sums::<R>::close_balanced(&sums, out, last(fan));
    }
}

/// How [`fit_rotations`] finds the rotations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// So many Jacobi sweeps from the rotations that are there.
    Warm(u32),
    /// From nothing, to convergence: after positions were set.
    Cold,
}

/// Fits the rotation of every tetrahedron to the positions `x`.
///
/// Inlined, so that a step, whose fit is always warm, does not link the cold one.
#[inline(always)]
pub fn fit_rotations<R: Lanes, L: Layout>(
    rest: &Rest<'_, L>,
    x: &[[f32; 3]],
    fit: Fit,
    rotations: &mut [RotationBlock],
) {
    let mut rotations = rotations.iter_mut();
    let mut fits = R::bites(|_| polar::Fit::<R>::still());
    let mut f = R::bites(|_| [zero3::<R>(); 3]);
    for fan in fans(rest) {
        let mut edges = Edges::<R>::open(x, fan);
        let none: &[[TetBlock; 2]] = &[];
        let (twos, ones) = if R::TWO { fan.as_chunks() } else { (none, fan) };
        for ([one, two], (first, second)) in twos.iter().zip(core::iter::from_fn(|| {
            rotations.next().zip(rotations.next())
        })) {
            for (edges, at) in edges.as_mut().iter_mut().zip(lanes::<R>()) {
                let f = deformed(edges, x, one, at).zip(deformed(edges, x, two, at));
                let Some((f, g)) = f else {
                    continue;
                };
                let f = core::array::from_fn(|i| core::array::from_fn(|j| Pair(f[i][j], g[i][j])));
                let (p, q) = (first.load::<R>(at), second.load::<R>(at));
                let q = fitted(&core::array::from_fn(|k| Pair(p[k], q[k])), &f, fit);
                first.store(q.map(|q| q.0), at);
                second.store(q.map(|q| q.1), at);
            }
        }
        for (tet, rotation) in ones.iter().zip(rotations.by_ref()) {
            if let Fit::Warm(sweeps) = fit
                && R::STAGES
            {
                fit_in_stages(fits.as_mut(), f.as_mut(), x, tet, sweeps, rotation);
                continue;
            }
            for (edges, at) in edges.as_mut().iter_mut().zip(lanes::<R>()) {
                let Some(f) = deformed(edges, x, tet, at) else {
                    continue;
                };
                rotation.store(fitted(&rotation.load::<R>(at), &f, fit), at);
            }
        }
    }
}

/// The next block's fit by sweeps, for [`Lanes::STAGES`]. A function of its own, for size.
#[inline(never)]
fn fit_in_stages<R: Lanes>(
    fits: &mut [polar::Fit<R>],
    f: &mut [Matrix<R>],
    x: &[[f32; 3]],
    tet: &TetBlock,
    sweeps: u32,
    rotation: &mut RotationBlock,
) {
    deformations(x, &tet.corners, &tet.gradients, f);
    for (fit, f) in fits.iter_mut().zip(&*f) {
        fit.measure(f);
    }
    for ((fit, f), at) in fits.iter_mut().zip(&*f).zip(lanes::<R>()) {
        fit.start(&rotation.load::<R>(at), f);
    }
    for sweep in 1..=sweeps {
        polar::sweep(fits, sweep == sweeps);
    }
    for (fit, at) in fits.iter().zip(lanes::<R>()) {
        let q = fit.end(&rotation.load::<R>(at));
        rotation.store(q, at);
    }
}

/// F of the next tetrahedra.
#[inline(always)]
fn deformed<R: Lanes>(
    edges: &mut Edges<R>,
    x: &[[f32; 3]],
    tet: &TetBlock,
    at: usize,
) -> Option<[[R; 3]; 3]> {
    let edges = edges.advance(x, &tet.corners, at)?;
    Some(deformation(&edges, &gradients::<R>(tet, at)))
}

/// `q` fitted to F.
#[inline(always)]
fn fitted<R: Real>(q: &Quaternion<R>, f: &[[R; 3]; 3], fit: Fit) -> Quaternion<R> {
    match fit {
        Fit::Warm(sweeps) => polar::sweeps(q, f, sweeps),
        Fit::Cold => polar::nearest_rotation(f),
    }
}

/// [`fit_rotations`] from nothing, of which a binary needs one.
#[inline(never)]
pub(crate) fn fit_cold<R: Lanes, L: Layout>(
    rest: &Rest<'_, L>,
    x: &[[f32; 3]],
    rotations: &mut [RotationBlock],
) {
    fit_rotations::<R, L>(rest, x, Fit::Cold, rotations);
}
