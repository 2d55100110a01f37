//! Rigid bodies with mass, as four nodes of the mesh.
//!
//! Every rigid body has the same mass, centre of mass and moments of inertia as four equal point masses m/4
//! at the corners of a tetrahedron: with ℓ_i² = ∫ξ_i² dm / m along its principal axes e_i,
//!
//! ```text
//! x_k = c + d_k,   d_k = Σ_i s_ki ℓ_i e_i,   s = (+++), (−+−), (+−−), (−−+)      Σ_k s_k = 0,  Σ_k s_k s_kᵀ = 4 I
//! ball: ℓ = r/√5;   box of half sides a_i: ℓ_i = a_i/√3
//! ```
//!
//! (Equimomental systems: Routh, *Dynamics of a System of Rigid Bodies*, 1905, article 33.) So a rigid body is one
//! tetrahedron without stiffness whose nodes may only move rigidly. The solver's vectors are projected on the six
//! rigid motions, at equal masses an orthogonal projection:
//!
//! ```text
//! (P u)_k = ū + ω × d_k,   ω = J⁻¹ Σ_k d_k × u_k,   J = Σ_k |d_k|² − d_k d_kᵀ = Σ_i 4 (ℓ_j² + ℓ_l²) e_i e_iᵀ
//! ```
//!
//! A point ξ of the body (coordinates along e_i) is x = Σ_k w_k x_k with w_k = (1 + Σ_i s_ki ξ_i/ℓ_i)/4.
//!
//! After the solve the nodes are put back on the turned shape: the centre moves on by h v̄, the axes turn by the
//! Cayley map of hω, ω taken midway (two fixed-point passes), and ω⁺ = J(t+h)⁻¹ L with the angular momentum L that
//! the solve found: linear and angular momentum are kept to rounding, a ball's energy, too. A box that tumbles
//! freely may gain or lose energy within what its L allows, ½L²/J_max to ½L²/J_min.

use glam::Vec3;

use crate::element::Sym3;
use crate::math::{ratio_or_zero, sqrt};
use crate::vector::sym_mul;

/// Corners of the tetrahedron, in the signs of its coordinates; positively oriented.
const SIGNS: [[f32; 3]; 4] = [
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, -1.0],
    [1.0, -1.0, -1.0],
    [-1.0, -1.0, 1.0],
];

/// What a rigid body looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A ball.
    Ball {
        /// Its radius, metres.
        radius: f32,
    },
    /// A box, centred.
    Cuboid {
        /// Half its sides, metres.
        half: Vec3,
    },
}

impl Shape {
    /// ℓ, metres: the roots of the mean squares of the coordinates.
    #[must_use]
    pub fn lengths(&self) -> Vec3 {
        match *self {
            Self::Ball { radius } => Vec3::splat(radius * sqrt(0.2)),
            Self::Cuboid { half } => half * sqrt(1.0 / 3.0),
        }
    }

    /// The four nodes of such a body with its centre and its principal axes at these places.
    #[must_use]
    pub fn nodes(&self, centre: Vec3, axes: [Vec3; 3]) -> [[f32; 3]; 4] {
        arms(&axes, self.lengths()).map(|d| (centre + d).to_array())
    }
}

/// A rigid body among the pieces of a mesh: its four nodes come one after the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid {
    pub(crate) first: u32,
    pub(crate) shape: Shape,
    pub(crate) friction: f32,
    pub(crate) frame: Frame,
}

/// Where a rigid body is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    pub centre: Vec3,
    pub axes: [Vec3; 3],
    /// ℓ, by now for any shape at the same cost.
    pub lengths: Vec3,
    /// J⁻¹ for nodes of mass 1, 1/m²
    pub inverse: Sym3<f32>,
}

impl Rigid {
    /// The body whose first node is `first`, with Coulomb's coefficient of friction.
    #[must_use]
    pub const fn new(first: u32, shape: Shape, friction: f32) -> Self {
        Self {
            first,
            shape,
            friction,
            frame: Frame::NONE,
        }
    }

    /// The shape.
    #[must_use]
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// Its first node.
    #[must_use]
    pub fn first(&self) -> u32 {
        self.first
    }

    /// Centre of mass and principal axes of the body at node positions `x`.
    #[must_use]
    pub fn pose(&self, x: &[[f32; 3]]) -> Option<(Vec3, [Vec3; 3])> {
        let frame = Frame::of(four(x, self.first)?, self.shape.lengths());
        Some((frame.centre, frame.axes))
    }

    /// Reads off its frame.
    #[inline(never)]
    pub(crate) fn locate(&mut self, x: &[[f32; 3]]) {
        if let Some(x) = four(x, self.first) {
            self.frame = Frame::of(x, self.shape.lengths());
        }
    }

    #[inline(never)]
    pub(crate) fn arms(&self) -> [Vec3; 4] {
        arms(&self.frame.axes, self.frame.lengths)
    }

    /// Coordinates along the axes.
    pub(crate) fn local(&self, point: Vec3) -> Vec3 {
        let from = point - self.frame.centre;
        Vec3::from_array(self.frame.axes.map(|e| e.dot(from)))
    }

    /// The way along the axes.
    pub(crate) fn world(&self, local: Vec3) -> Vec3 {
        let [a, b, c] = self.frame.axes;
        a * local.x + b * local.y + c * local.z
    }

    /// Weights of the four nodes at a point, in metres.
    #[inline(never)]
    pub(crate) fn weights(&self, point: Vec3) -> [f32; 4] {
        let at = self.local(point) / self.shape.lengths();
        SIGNS.map(|s| 0.25 * (1.0 + (s[0] * at.x + s[1] * at.y + s[2] * at.z)))
    }

    /// n·(1 + [r]×ᵀ J⁻¹ [r]×)·n of nodes of mass 1: how a push along `n` at the point moves it along `n`.
    #[inline(never)]
    pub(crate) fn compliance(&self, point: Vec3, n: Vec3) -> f32 {
        let arm = (point - self.frame.centre).cross(n);
        0.25 * n.dot(n) + arm.dot(times(&self.frame.inverse, arm))
    }

    /// P u
    #[inline(never)]
    pub(crate) fn project(&self, u: &mut [[f32; 3]]) {
        if let Some(u) = four_mut(u, self.first) {
            self.project_four(u);
        }
    }

    /// P of its own nodes.
    #[inline(never)]
    pub(crate) fn project_four(&self, u: &mut [[f32; 3]; 4]) {
        let d = self.arms();
        let (mean, spin) = self.motion(u);
        for (u, d) in u.iter_mut().zip(d) {
            *u = (mean + spin.cross(d)).to_array();
        }
    }

    /// Mean velocity and spin of its nodes.
    #[inline(never)]
    fn motion(&self, u: &[[f32; 3]; 4]) -> (Vec3, Vec3) {
        let u = u.map(Vec3::from_array);
        let mean = ((u[0] + u[1]) + (u[2] + u[3])) * 0.25;
        let mut turn = Vec3::ZERO;
        for (d, u) in self.arms().into_iter().zip(u) {
            turn += d.cross(u - mean);
        }
        (mean, times(&self.frame.inverse, turn))
    }

    /// Puts the nodes, which the step has moved to `x` at velocities `v`, back on the turned shape.
    #[inline(never)]
    pub(crate) fn turn(&mut self, h: f32, x: &mut [[f32; 3]], v: &mut [[f32; 3]]) {
        let (Some(x), Some(v)) = (four_mut(x, self.first), four_mut(v, self.first)) else {
            return;
        };
        let lengths = self.frame.lengths;
        let (mean, spin) = self.motion(v);
        let d = self.arms();
        let mut momentum = Vec3::ZERO;
        for d in d {
            momentum += d.cross(spin.cross(d));
        }
        let [a, b, c, e] = x.map(Vec3::from_array);
        let mut turned = Frame {
            centre: ((a + b) + (c + e)) * 0.25,
            ..self.frame
        };
        let mut later = spin;
        for _ in 0..2 {
            let midway = (spin + later) * 0.5;
            turned.axes = orthonormal(self.frame.axes.map(|e| cayley(midway * h, e)));
            turned.inverse = inverse_inertia(&turned.axes, lengths);
            later = times(&turned.inverse, momentum);
        }
        self.frame = turned;
        for ((x, v), d) in x.iter_mut().zip(v).zip(self.arms()) {
            *x = (turned.centre + d).to_array();
            *v = (mean + later.cross(d)).to_array();
        }
    }
}

impl Frame {
    const NONE: Self = Self {
        centre: Vec3::ZERO,
        axes: [Vec3::ZERO; 3],
        lengths: Vec3::ZERO,
        inverse: [0.0; 6],
    };

    #[inline(never)]
    fn of(x: &[[f32; 3]; 4], lengths: Vec3) -> Self {
        let x = x.map(Vec3::from_array);
        let centre = ((x[0] + x[1]) + (x[2] + x[3])) * 0.25;
        let axes = core::array::from_fn(|axis| {
            let mut sum = Vec3::ZERO;
            for (signs, x) in SIGNS.iter().zip(x) {
                sum += (x - centre) * signs[axis];
            }
            sum * ratio_or_zero(0.25, lengths.to_array()[axis], 0.0)
        });
        let axes = orthonormal(axes);
        Self {
            centre,
            axes,
            lengths,
            inverse: inverse_inertia(&axes, lengths),
        }
    }
}

fn arms([a, b, c]: &[Vec3; 3], lengths: Vec3) -> [Vec3; 4] {
    let (a, b, c) = (*a * lengths.x, *b * lengths.y, *c * lengths.z);
    SIGNS.map(|s| a * s[0] + b * s[1] + c * s[2])
}

/// J⁻¹ = Σ e_i e_iᵀ / (4 (ℓ_j² + ℓ_l²))
#[inline(never)]
fn inverse_inertia(axes: &[Vec3; 3], lengths: Vec3) -> Sym3<f32> {
    let square = lengths * lengths;
    let sums = [
        square.y + square.z,
        square.z + square.x,
        square.x + square.y,
    ];
    let mut out = [0.0; 6];
    for (e, sum) in axes.iter().zip(sums) {
        let scale = ratio_or_zero(0.25, sum, 0.0);
        let products = [
            e.x * e.x,
            e.x * e.y,
            e.x * e.z,
            e.y * e.y,
            e.y * e.z,
            e.z * e.z,
        ];
        for (out, product) in out.iter_mut().zip(products) {
            *out += scale * product;
        }
    }
    out
}

fn times(s: &Sym3<f32>, v: Vec3) -> Vec3 {
    Vec3::from_array(sym_mul(s, &v.to_array()))
}

/// Turns `e` by 2 atan(|w|/2) about w: (1 − [w/2]×)⁻¹ (1 + [w/2]×) e.
fn cayley(w: Vec3, e: Vec3) -> Vec3 {
    let half = w * 0.5;
    let once = half.cross(e);
    e + (once + half.cross(once)) * (2.0 / (1.0 + half.dot(half)))
}

/// One Newton–Schulz step, E + E (1 − EᵀE)/2: from rounding errors to the last digit.
#[inline(never)]
fn orthonormal([a, b, c]: [Vec3; 3]) -> [Vec3; 3] {
    let (ab, ac, bc) = (a.dot(b), a.dot(c), b.dot(c));
    let own = |e: Vec3| 1.0 - e.dot(e);
    [
        a + (a * own(a) - b * ab - c * ac) * 0.5,
        b + (b * own(b) - a * ab - c * bc) * 0.5,
        c + (c * own(c) - a * ac - b * bc) * 0.5,
    ]
}

fn four(x: &[[f32; 3]], first: u32) -> Option<&[[f32; 3]; 4]> {
    x.get(first as usize..)?.first_chunk()
}

fn four_mut(x: &mut [[f32; 3]], first: u32) -> Option<&mut [[f32; 3]; 4]> {
    x.get_mut(first as usize..)?.first_chunk_mut()
}
