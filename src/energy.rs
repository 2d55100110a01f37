//! What a state is worth: energies, momenta, the worst element, a hash. In f64, computed only when
//! asked; none of it is part of a step.

use glam::Vec3;

use crate::body::StateRef;
use crate::element::{Bite, Layout, deformation, edges};
use crate::lane::BLOCK;
#[cfg(feature = "plasticity")]
use crate::plasticity;
use crate::polar;
use crate::rest::Rest;

/// Energies in joules.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// ½ Σ m v²
    pub kinetic: f64,
    /// Σ V (μ |ε|² + λ/2 tr(ε)²), over what has not broken; of plastic bodies, with the elastic part of ε's deviator.
    pub elastic: f64,
    /// −Σ m g·x, from the origin
    pub potential: f64,
}

impl Energies {
    /// Their sum.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic + self.elastic + self.potential
    }
}

/// Momenta about the origin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Momenta {
    /// Σ m v, in N·s
    pub linear: [f64; 3],
    /// Σ m x × v, in N·m·s
    pub angular: [f64; 3],
}

/// Which rotations the elastic energy is measured with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rotations {
    /// The nearest ones to the positions: the corotated energy.
    Converged,
    /// Those of the state.
    Stored,
}

/// Kinetic, elastic (with converged rotations) and gravitational energy.
#[must_use]
pub fn energies<L: Layout>(rest: &Rest<'_, L>, state: &StateRef<'_>, gravity: Vec3) -> Energies {
    let (mut kinetic, mut potential) = (0.0, 0.0);
    let g = gravity.to_array().map(f64::from);
    for ((m, x), v) in rest.masses.iter().zip(state.x).zip(state.v) {
        let (m, x, v) = (f64::from(*m), x.map(f64::from), v.map(f64::from));
        kinetic += 0.5 * m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        potential -= m * (g[0] * x[0] + g[1] * x[1] + g[2] * x[2]);
    }
    Energies {
        kinetic,
        elastic: elastic(rest, state, Rotations::Converged),
        potential,
    }
}

/// Elastic energy in joules, with the nearest rotations or with those of the state.
#[must_use]
pub fn elastic<L: Layout>(rest: &Rest<'_, L>, state: &StateRef<'_>, rotations: Rotations) -> f64 {
    let mut sum = 0.0;
    each_tet(
        rest,
        state,
        |Tet {
             bite,
             f,
             stored,
             block,
         }| {
            let q = match rotations {
                Rotations::Converged => polar::nearest_rotation(f),
                Rotations::Stored => *stored,
            };
            sum += L::energy(bite, &polar::matrix(&q)) + plastic(state, *block, bite, &q, f);
        },
    );
    sum
}

/// What plastic strain adds to a tetrahedron's elastic energy.
#[cfg(feature = "plasticity")]
fn plastic<L: Layout>(
    state: &StateRef<'_>,
    block: usize,
    bite: &Bite<'_, L, f64>,
    q: &polar::Quaternion<f64>,
    f: &[[f64; 3]; 3],
) -> f64 {
    let lane = bite.at % BLOCK;
    let strain = state
        .plastic
        .get(block)
        .map(|p| p.0.map(|c| f64::from(c[lane])));
    let mu_v = f64::from(bite.tet.mu_v[lane]);
    strain.map_or(0.0, |p| {
        plasticity::energy(mu_v, &p, &polar::unrotated(q, f))
    })
}

#[cfg(not(feature = "plasticity"))]
fn plastic<L: Layout>(
    _: &StateRef<'_>,
    _: usize,
    _: &Bite<'_, L, f64>,
    _: &polar::Quaternion<f64>,
    _: &[[f64; 3]; 3],
) -> f64 {
    0.0
}

/// Whether a tetrahedron has failed.
fn is_broken(state: &StateRef<'_>, block: usize, lane: usize) -> bool {
    #[cfg(feature = "fracture")]
    return state.is_broken(block * BLOCK + lane);
    #[cfg(not(feature = "fracture"))]
    {
        _ = (state, block, lane);
        false
    }
}

/// Linear and angular momentum about the origin.
#[must_use]
pub fn momenta<L: Layout>(rest: &Rest<'_, L>, state: &StateRef<'_>) -> Momenta {
    let mut sum = Momenta::default();
    for ((m, x), v) in rest.masses.iter().zip(state.x).zip(state.v) {
        let (m, x, v) = (f64::from(*m), x.map(f64::from), v.map(f64::from));
        for axis in 0..3 {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            sum.linear[axis] += m * v[axis];
            sum.angular[axis] += m * (x[next] * v[last] - x[last] * v[next]);
        }
    }
    sum
}

/// The smallest det F of all tetrahedra that have not broken: 1 at rest, negative where one is inverted. Infinite for a
/// body without any.
#[must_use]
pub fn min_det<L: Layout>(rest: &Rest<'_, L>, state: &StateRef<'_>) -> f64 {
    let mut least = f64::INFINITY;
    each_tet(rest, state, |Tet { f, .. }| {
        let det = f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1])
            + f[0][1] * (f[1][2] * f[2][0] - f[1][0] * f[2][2])
            + f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
        if det < least {
            least = det;
        }
    });
    least
}

/// A tetrahedron in f64: its edges, F, its stored rotation, and its block.
struct Tet<'a, L: Layout> {
    bite: Bite<'a, L, f64>,
    f: [[f64; 3]; 3],
    stored: polar::Quaternion<f64>,
    block: usize,
}

/// Visits every tetrahedron: no padding, and none that has failed.
fn each_tet<L: Layout>(
    rest: &Rest<'_, L>,
    state: &StateRef<'_>,
    mut visit: impl FnMut(&Tet<'_, L>),
) {
    let mut left = rest.header.tets as usize;
    let blocks = rest.blocks.iter().zip(rest.stiffness).zip(state.rotations);
    for (block, ((tet, stiffness), rotation)) in blocks.enumerate() {
        for lane in (0..BLOCK.min(left)).filter(|&lane| !is_broken(state, block, lane)) {
            let corner_edges = |positions: &[[f32; 3]]| {
                edges(&tet.corners.map(|corner| {
                    positions
                        .get(corner[lane] as usize)
                        .copied()
                        .unwrap_or_default()
                        .map(f64::from)
                }))
            };
            let bite = Bite {
                tet,
                stiffness,
                at: lane,
                edges: corner_edges(state.x),
                rest_edges: corner_edges(rest.nodes),
            };
            let g = tet.gradients.map(|g| g.map(|axis| f64::from(axis[lane])));
            visit(&Tet {
                f: deformation(&bite.edges, &g),
                stored: rotation.0.map(|c| f64::from(c[lane])),
                bite,
                block,
            });
        }
        left = left.saturating_sub(BLOCK);
    }
}

/// FNV-1a, 64 bit, over the little-endian bytes of all x, then all v, body by body: equal on every
/// target for equal states.
///
/// Positions and velocities of an accepted state are finite, so no NaN payload can differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StateHash(u64);

impl StateHash {
    /// The hash of no body.
    #[must_use]
    pub const fn new() -> Self {
        Self(FNV_START)
    }

    /// With one more body.
    #[must_use]
    pub fn with(mut self, x: &[[f32; 3]], v: &[[f32; 3]]) -> Self {
        for numbers in [x, v] {
            self.0 = fnv1a_of(self.0, numbers.as_flattened());
        }
        self
    }

    /// With one more body: [`Self::with`], and then, where it has them, its plastic strain (six numbers a
    /// tetrahedron: xx, xy, xz, yy, yz, zz) and what has broken (1.0, or 0.0 where whole), block by block.
    #[must_use]
    pub fn with_state(self, state: &StateRef<'_>) -> Self {
        #[allow(unused_mut, reason = "not without features")]
        let mut hash = self.with(state.x, state.v);
        #[cfg(feature = "plasticity")]
        for block in state.plastic {
            let numbers = block.0.as_flattened().iter();
            hash.0 = fnv1a(hash.0, numbers.flat_map(|c| c.to_le_bytes()));
        }
        #[cfg(feature = "fracture")]
        for block in state.broken {
            hash.0 = fnv1a(hash.0, block.0.iter().flat_map(|c| c.to_le_bytes()));
        }
        hash
    }

    /// Its value, to be printed as 16 hex digits.
    #[must_use]
    pub const fn value(self) -> u64 {
        self.0
    }
}

impl Default for StateHash {
    fn default() -> Self {
        Self::new()
    }
}

/// FNV-1a's value before the first byte.
pub(crate) const FNV_START: u64 = 0xcbf2_9ce4_8422_2325;

/// 64-bit FNV-1a, gone on with.
pub(crate) fn fnv1a(start: u64, bytes: impl IntoIterator<Item = u8>) -> u64 {
    bytes.into_iter().fold(start, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// The same over the little-endian bytes of a word. In a binary once: written out wherever it is used, it would be long.
#[inline(never)]
pub(crate) fn fnv1a_word(start: u64, word: u32) -> u64 {
    fnv1a(start, word.to_le_bytes())
}

/// The same over the little-endian bytes of numbers. (Flattened iterators would be longer code.)
pub(crate) fn fnv1a_of(start: u64, numbers: &[f32]) -> u64 {
    numbers
        .iter()
        .fold(start, |hash, x| fnv1a_word(hash, x.to_bits()))
}
