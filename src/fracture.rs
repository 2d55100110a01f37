//! Fracture (feature `fracture`): tetrahedra that are switched off where the tension in them is too great.
//!
//! After a step, and after plastic flow, every tetrahedron has a stress by its isotropic material,
//!
//! ```text
//! σ = λ tr(ε) I + 2μ (ε − ε_p),   ε = sym(QᵀF) − I,   1/V = 6 g₁·(g₂ × g₃)
//! ```
//!
//! and fails where the greatest principal stress is above the strength: Rankine's criterion, which O'Brien and Hodgins,
//! "Graphical Modeling and Animation of Brittle Fracture" (SIGGRAPH 1999), apply to nodes. Here elements fail:
//! crude next to cutting them, but nothing is remeshed, so that the cost of a step stays fixed. A
//! tetrahedron that has failed has no stiffness and no force from the next step on; its mass stays with its nodes, so
//! mass and momentum are exact. Cracks follow the mesh, and their width is an element.
//!
//! Of those above the strength, at most [`Fracture::per_step`] fail in a step, the most stressed first (of equals
//! the first in the mesh): tension has time to go elsewhere. In all, at most [`Fracture::reserve`] do; the report
//! says what is left, and how many tetrahedra were above the strength and stayed.
//!
//! The strength may differ by region ([`LawRegions`]); places and reserve are the body's.
//!
//! Switching off takes elastic energy away and adds none, so the bound on a step's energy stands. A factored
//! preconditioner is made of the whole body: symmetric and positive definite all the same, it is only the factor
//! of another matrix then, and gives the right answer in more iterations. A node whose tetrahedra have all
//! failed flies on by itself: its diagonal of A is its mass.
//!
//! With fracture (4 a step) and plastic flow, a tetrahedron takes some 740 instructions a step more on x86-64, and 2,630 on a
//! Cortex-M4F, in every state: `examples/firmware/count MACHINE prove` with and without `FEATURES=inelastic`. It is
//! 32 bytes of state a block of eight, and 192 for plastic flow.

use core::fmt;

use crate::algebra::dot3;
use crate::element::{Layout, deformation, gradients, stress};
use crate::fan::{Edges, fans, lanes};
use crate::inelastic::{PlasticStrain, Share};
use crate::lane::{BLOCK, Lanes, Real};
use crate::math::{Mask, select};
use crate::operator::RotationBlock;
use crate::polar::{self, direction, half_angle};
use crate::rest::Rest;
use crate::settings::LawRegions;

/// The most that [`Fracture::per_step`] may be.
pub const MOST_PER_STEP: u32 = 16;

/// When and how fast a body breaks, validated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fracture {
    strength: f32,
    per_step: u32,
    reserve: u32,
}

/// Which parameter is out of its range; it carries the value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum FractureError {
    /// The strength must be positive and finite (Pa).
    Strength(f32),
    /// So many in a step: from 1 to [`MOST_PER_STEP`].
    PerStep(u32),
}

impl fmt::Display for FractureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Strength(x) => write!(f, "strength {x} must be positive and finite"),
            Self::PerStep(x) => write!(f, "{x} a step must be from 1 to {MOST_PER_STEP}"),
        }
    }
}

impl core::error::Error for FractureError {}

impl Fracture {
    /// Tetrahedra fail above a principal stress of `strength` (Pa): at most `per_step` in a step, whose cost grows with
    /// it, and `reserve` in all.
    ///
    /// # Errors
    /// [`FractureError`].
    pub const fn new(strength: f32, per_step: u32, reserve: u32) -> Result<Self, FractureError> {
        if !(strength > 0.0 && strength.is_finite()) {
            Err(FractureError::Strength(strength))
        } else if per_step == 0 || per_step > MOST_PER_STEP {
            Err(FractureError::PerStep(per_step))
        } else {
            Ok(Self {
                strength,
                per_step,
                reserve,
            })
        }
    }

    /// Pa
    #[must_use]
    pub fn strength(&self) -> f32 {
        self.strength
    }

    /// At most so many fail in a step.
    #[must_use]
    pub fn per_step(&self) -> u32 {
        self.per_step
    }

    /// At most so many fail in all.
    #[must_use]
    pub fn reserve(&self) -> u32 {
        self.reserve
    }
}

/// Whether a tetrahedron has failed.
pub(crate) fn has_failed(broken: &[BrokenBlock], tet: usize) -> bool {
    broken
        .get(tet / BLOCK)
        .is_some_and(|block| block.0[tet % BLOCK] > 0.5)
}

/// Which of eight tetrahedra have failed: 1, or 0 where whole.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct BrokenBlock(pub [f32; BLOCK]);

impl BrokenBlock {
    /// All whole. All bits zero.
    pub const ZERO: Self = Self([0.0; BLOCK]);
}

/// What a step says of fracture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FractureReport {
    /// Tetrahedra that failed in this step.
    pub broken: u32,
    /// Tetrahedra above the strength that stayed, for want of a place in this step or in the reserve.
    pub spared: u32,
    /// How many may still fail. At 0 the reserve is exhausted.
    pub left: u32,
}

impl FractureReport {
    /// Nothing broke, and nothing may.
    pub const NOTHING: Self = Self {
        broken: 0,
        spared: 0,
        left: 0,
    };
}

/// The most stressed so far: (stress over strength, place in the mesh), greatest first.
type Ranking = [(f32, u32); MOST_PER_STEP as usize];

/// Switches tetrahedra off.
#[inline(never)]
pub(crate) fn tear<R: Lanes, L: Layout, P: PlasticStrain>(
    rest: &Rest<'_, L>,
    x: &[[f32; 3]],
    rotations: &[RotationBlock],
    plastic: impl Iterator<Item = P>,
    (law, regions): (&Fracture, Option<&LawRegions<'_>>),
    broken: &mut [BrokenBlock],
) -> FractureReport {
    let unit = rest.header.length_unit;
    // 1/(strength V) in length units, but for g₁·(g₂ × g₃).
    let per = |strength: f32| 6.0 / strength / unit / unit / unit;
    let mut each = [per(law.strength); BLOCK];
    let mut first = (0..).step_by(BLOCK);
    let unit = R::splat(unit);
    let places = law.per_step as usize;
    let mut ranking: Ranking = [(1.0, u32::MAX); MOST_PER_STEP as usize];
    let (mut above, mut before, mut tets) = (0, 0, 0_u32..);
    let mut blocks = rotations.iter().zip(plastic).zip(&*broken);
    for fan in fans(rest) {
        let mut edges = Edges::<R>::open(x, fan);
        for (tet, ((rotation, plastic), broken)) in fan.iter().zip(blocks.by_ref()) {
            if let (Some(regions), Some(first)) = (regions, first.next()) {
                each =
                    core::array::from_fn(|lane| strength(regions, first + lane).map_or(0.0, per));
            }
            let mut ratios = [0.0; BLOCK];
            for (edges, at) in edges.as_mut().iter_mut().zip(lanes::<R>()) {
                let Some(edges) = edges.advance(x, &tet.corners, at) else {
                    continue;
                };
                let g = gradients::<R>(tet, at);
                let f = deformation(&edges, &g);
                let mut h = polar::unrotated(&rotation.load::<R>(at), &f);
                for axis in 0..3 {
                    h[axis][axis] = h[axis][axis] - R::splat(1.0);
                }
                let scale = R::load(&each, at) * volume_form(&g, unit);
                let (lambda, mu) = (
                    scale * R::load(&tet.lambda_v, at),
                    scale * R::load(&tet.mu_v, at),
                );
                let s = plastic.relieve(stress(&h, lambda, mu), mu, at);
                let ratio = greatest_eigenvalue(&s);
                broken.of(ratio, at).store(&mut ratios, at);
            }
            for (ratio, (flag, place)) in ratios.into_iter().zip(broken.0.iter().zip(&mut tets)) {
                above += u32::from(ratio > 1.0);
                before += u32::from(*flag > 0.5);
                rank(&mut ranking, places, (ratio, place));
            }
        }
    }
    let left = law.reserve.saturating_sub(before);
    let mut report = FractureReport {
        broken: 0,
        spared: above,
        left,
    };
    for (rank, (_, place)) in (0..law.per_step).zip(ranking) {
        let fails = (place != u32::MAX) & (rank < left);
        switch_off(broken, fails, place);
        report.broken += u32::from(fails);
    }
    report.spared -= report.broken;
    report.left -= report.broken;
    report
}

/// That of a tetrahedron, where it can fail.
fn strength(regions: &LawRegions<'_>, tet: usize) -> Option<f32> {
    let strength = *regions.strength.get(usize::from(*regions.of.get(tet)?))?;
    (strength > 0.0).then_some(strength)
}

/// Inserts a tetrahedron where it belongs in the ranking; the last is pushed out.
#[inline(always)]
fn rank(ranking: &mut Ranking, places: usize, (mut ratio, mut place): (f32, u32)) {
    for slot in ranking.iter_mut().take(places) {
        let higher = Mask::of(ratio > slot.0);
        let (lower, other) = (higher.pick(slot.0, ratio), higher.pick_u32(slot.1, place));
        *slot = (higher.pick(ratio, slot.0), higher.pick_u32(place, slot.1));
        (ratio, place) = (lower, other);
    }
}

/// At the same cost where it does not.
#[inline(always)]
fn switch_off(broken: &mut [BrokenBlock], fails: bool, place: u32) {
    let place = Mask::of(fails).pick_u32(place, 0) as usize;
    if let Some(BrokenBlock(block)) = broken.get_mut(place / BLOCK) {
        let flag = &mut block[place % BLOCK];
        *flag = select(fails, 1.0, *flag);
    }
}

/// g₁·(g₂ × g₃) in length units: 1/(6V).
#[inline(always)]
fn volume_form<R: Real>(g: &[[R; 3]; 3], unit: R) -> R {
    let [a, b, c] = g.map(|g| g.map(|x| x * unit));
    let cross = [
        b[1] * c[2] - b[2] * c[1],
        b[2] * c[0] - b[0] * c[2],
        b[0] * c[1] - b[1] * c[0],
    ];
    dot3(&a, &cross)
}

/// Enough for f32: Jacobi's method squares its error in a sweep once it is small.
const SWEEPS: u32 = 4;

/// The greatest eigenvalue of a symmetric matrix, by a fixed number of sweeps of Jacobi's method; 0 where an entry is
/// not finite.
#[inline(always)]
pub(crate) fn greatest_eigenvalue<R: Real>(s: &[[R; 3]; 3]) -> R {
    let zero = R::splat(0.0);
    let size = s.iter().flatten().fold(zero, |sum, x| sum + x.abs());
    // Of order one, so that squares neither overflow nor vanish.
    let usable = size.where_below(R::splat(f32::MAX), size, zero);
    let inverse = R::splat(f32::MIN_POSITIVE).where_below(usable, R::splat(1.0) / usable, zero);
    // Diagonal, and off it the entry of the two other axes.
    let mut a = [s[0][0], s[1][1], s[2][2]].map(|x| x * inverse);
    let mut b = [s[1][2], s[0][2], s[0][1]].map(|x| x * inverse);
    let half = R::splat(0.5);
    for _ in 0..SWEEPS {
        for (p, r, k) in [(0, 1, 2), (0, 2, 1), (1, 2, 0)] {
            // tan 2φ = 2 s_pr/(s_pp − s_rr) makes s_pr zero, and (s_pp + s_rr ± √(…))/2 of the diagonal.
            let (sum, difference, twice) = (a[p] + a[r], a[p] - a[r], b[k] + b[k]);
            let (c2, s2) = direction(difference, twice);
            let length = difference * c2 + twice * s2;
            (a[p], a[r], b[k]) = (half * (sum + length), half * (sum - length), zero);
            let (half_c, half_s) = half_angle(c2, s2);
            let (c, s) = direction(half_c, half_s);
            (b[r], b[p]) = (c * b[r] + s * b[p], c * b[p] - s * b[r]);
        }
    }
    let [a, b, c] = a;
    let most = a.where_below(b, b, a);
    let most = most.where_below(c, c, most);
    zero.where_below(inverse, most * usable, zero)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix3;
    use proptest::prelude::*;

    fn compare(s: Matrix3<f64>) {
        let rounded = s.map(|x| x as f32);
        let exact = rounded.map(f64::from).symmetric_eigenvalues().max();
        let rows = core::array::from_fn(|i| core::array::from_fn(|j| rounded[(i, j)]));
        let found = f64::from(greatest_eigenvalue::<f32>(&rows));
        let size = rounded.map(f64::from).norm();
        assert!(
            (found - exact).abs() <= 2e-6 * size,
            "{found:e}, {exact:e}: {rounded}"
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5000))]
        #[test]
        fn the_greatest_eigenvalue_is_found(
            entries in prop::array::uniform6(-1.0..1.0_f64),
            values in prop::array::uniform3(prop::sample::select([-1.0, 0.0, 1e-4, 1.0, 1.0001].as_slice())),
            scale in -30.0..30.0_f64,
        ) {
            let [a, b, c, d, e, f] = entries;
            let s = Matrix3::new(a, b, c, b, d, e, c, e, f);
            compare(s * 10_f64.powf(scale));
            // Equal and nearly equal ones, in any frame.
            let frame = s.symmetric_eigen().eigenvectors;
            compare(frame * Matrix3::from_diagonal(&values.into()) * frame.transpose());
        }
    }

    #[test]
    fn corners_of_its_range() {
        assert_eq!(greatest_eigenvalue::<f32>(&[[0.0; 3]; 3]), 0.0);
        assert_eq!(greatest_eigenvalue::<f32>(&[[f32::NAN; 3]; 3]), 0.0);
        assert_eq!(greatest_eigenvalue::<f32>(&[[f32::MAX; 3]; 3]), 0.0);
        compare(Matrix3::new(0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0));
        compare(Matrix3::from_diagonal_element(-1.0));
    }
}
