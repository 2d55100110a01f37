//! Plastic flow (feature `plasticity`): a body that keeps part of its deformation.
//!
//! Each tetrahedron stores a plastic strain ε_p, symmetric and without trace, in its unrotated frame, so that only
//! the rest of its strain is elastic. With the isotropic part of the material (λ, μ):
//!
//! ```text
//! (1)  ε = sym(QᵀF) − I = ε_e + ε_p                             additive split, in rotated form
//! (2)  W = V [μ |ε|² + λ/2 tr(ε)²] − 2μV ε_p : ε + μV |ε_p|²     = V [μ |ε − ε_p|² + λ/2 tr(ε)²]
//! (3)  f_i = −V Q σ(ε) g_i + 2μV Q ε_p g_i                       a second force; K as without
//! (4)  e  = dev(ε) − ε_p;   |e| > γ₁:  Δε_p = a (|e| − γ₁)/|e| e,   a = h/(h + τ)
//! (5)  ε_p ← (ε_p + Δε_p) min(1, γ₂/|ε_p + Δε_p|)
//! (6)  D  = μV (|e|² − |e⁺|²) ≥ 0                                dissipated
//! ```
//!
//! |·| is Frobenius' norm. (1), (4) and (5) are O'Brien, Bargteil and Hodgins, "Graphical Modeling and Animation of
//! Ductile Fracture" (SIGGRAPH 2002, Eqs. 1 to 5), whose deviator keeps the volume; the rate is that of Müller
//! and Gross, "Interactive Virtual Materials" (GI 2004, section 5), who let a part h·c of the elastic strain flow. We
//! let the part a of what is beyond the yield point flow: backward Euler of ε̇_p = (e − γ₁ e/|e|)/τ, which is stable
//! at every h; τ = 0 returns to the yield surface at once. Metals yield at a von Mises stress of σ_y: γ₁ = σ_y/(√6 μ).
//!
//! (2) is quadratic while Q and ε_p are held, so what the front page says of a step's energy stands with (2) in
//! place of the elastic energy. The flow comes behind the step, at its end's positions and rotations, and is one
//! step of projected gradient descent of (2) in ε_p, whose length a ≤ 1 is within what makes that descend: so D
//! is never negative, beyond rounding, and E + ΣD never rises where E would not.
//!
//! An anisotropic body of the dense layout has μ from its isotropic material: that part of it flows (the matrix), and
//! the rest (the fibres) stays elastic.
//!
//! One law holds for a body, or one of several for each tetrahedron
//! ([`LawRegions`]).
//!
//! (3) sums to zero over the corners: linear momentum stays exact. Angular momentum of a free body is
//! changed where ε_p and ε have other axes, by V·2μ (ε_p ε − ε ε_p) a tetrahedron and second: as with every
//! anisotropic stress, σ and S do not commute. (A bar that was stretched by a tenth and thrown, spinning, has lost
//! 3.5 % of it after 200 steps with `rigid-2` and 20 iterations, and 2.2 % without flow: `tests/physics/plasticity`.)

use core::fmt;

use crate::algebra::{dot3, each3, mul_vec, scale3};
use crate::element::{Layout, Sym3, deformation, gradients};
use crate::fan::{Edges, Sums, fans, lanes, last};
use crate::inelastic::Share;
use crate::lane::{BLOCK, Lanes, Real};
use crate::operator::RotationBlock;
use crate::polar;
use crate::rest::Rest;
use crate::settings::LawRegions;

/// When, how fast and how far a body flows, validated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plasticity {
    yield_strain: f32,
    limit: f32,
    relaxation: f32,
}

/// Which parameter is out of its range; it carries the value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PlasticityError {
    /// The yield strain must be finite and not negative.
    YieldStrain(f32),
    /// The limit must be finite and at least 1e-18: below, squares of strains vanish in f32.
    Limit(f32),
    /// The relaxation time must be finite and not negative (s).
    RelaxationTime(f32),
}

impl fmt::Display for PlasticityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::YieldStrain(x) => write!(f, "yield strain {x} must be finite and not negative"),
            Self::Limit(x) => write!(f, "plastic limit {x} must be finite and at least 1e-18"),
            Self::RelaxationTime(x) => {
                write!(f, "relaxation time {x} must be finite and not negative")
            }
        }
    }
}

impl core::error::Error for PlasticityError {}

impl Plasticity {
    /// Flow at once beyond a yield strain γ₁, up to a plastic strain of γ₂.
    ///
    /// # Errors
    /// [`PlasticityError::YieldStrain`], [`PlasticityError::Limit`].
    pub const fn new(yield_strain: f32, limit: f32) -> Result<Self, PlasticityError> {
        if !(yield_strain >= 0.0 && yield_strain.is_finite()) {
            Err(PlasticityError::YieldStrain(yield_strain))
        } else if !(limit >= 1e-18 && limit.is_finite()) {
            Err(PlasticityError::Limit(limit))
        } else {
            Ok(Self {
                yield_strain,
                limit,
                relaxation: 0.0,
            })
        }
    }

    /// Flow that takes a time τ (s): creep.
    ///
    /// # Errors
    /// [`PlasticityError::RelaxationTime`].
    pub const fn with_relaxation(self, relaxation: f32) -> Result<Self, PlasticityError> {
        if relaxation >= 0.0 && relaxation.is_finite() {
            Ok(Self { relaxation, ..self })
        } else {
            Err(PlasticityError::RelaxationTime(relaxation))
        }
    }

    /// γ₁: the elastic shear strain, as Frobenius' norm, that a body holds.
    #[must_use]
    pub fn yield_strain(&self) -> f32 {
        self.yield_strain
    }

    /// γ₂: the greatest norm of a plastic strain.
    #[must_use]
    pub fn limit(&self) -> f32 {
        self.limit
    }

    /// τ, seconds.
    #[must_use]
    pub fn relaxation(&self) -> f32 {
        self.relaxation
    }
}

/// Plastic strain ε_p of eight tetrahedra, `[xx, xy, xz, yy, yz, zz][lane]`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct PlasticBlock(pub [[f32; BLOCK]; 6]);

impl PlasticBlock {
    /// No plastic strain. All bits zero.
    pub const ZERO: Self = Self([[0.0; BLOCK]; 6]);

    /// Frobenius' norm of lane `at`.
    #[must_use]
    pub fn norm(&self, at: usize) -> f32 {
        let strain = self.load::<f32>(at);
        inner(&strain, &strain).sqrt()
    }

    #[inline(always)]
    pub(crate) fn load<R: Lanes>(&self, at: usize) -> Sym3<R> {
        core::array::from_fn(|c| R::load(&self.0[c], at))
    }
}

/// S v
#[inline(always)]
fn sym_vec<R: Real>([xx, xy, xz, yy, yz, zz]: &Sym3<R>, v: &[R; 3]) -> [R; 3] {
    [
        dot3(&[*xx, *xy, *xz], v),
        dot3(&[*xy, *yy, *yz], v),
        dot3(&[*xz, *yz, *zz], v),
    ]
}

/// S : T
#[inline(always)]
fn inner<R: Real>(s: &Sym3<R>, t: &Sym3<R>) -> R {
    let [xx, xy, xz, yy, yz, zz] = core::array::from_fn(|c| s[c] * t[c]);
    let shear = xy + xz + yz;
    xx + yy + zz + (shear + shear)
}

/// sym(QᵀF) without its trace.
#[inline(always)]
fn deviator<R: Real>(b: &[[R; 3]; 3]) -> Sym3<R> {
    let half = R::splat(0.5);
    let mean = (b[0][0] + b[1][1] + b[2][2]) / R::splat(3.0);
    [
        b[0][0] - mean,
        half * (b[0][1] + b[1][0]),
        half * (b[0][2] + b[2][0]),
        b[1][1] - mean,
        half * (b[1][2] + b[2][1]),
        b[2][2] - mean,
    ]
}

/// Adds `scale` times the forces 2μV Q ε_p g_i to `out`. (3)
#[inline(never)]
pub(crate) fn add_forces<R: Lanes, L: Layout, S: Share>(
    rest: &Rest<'_, L>,
    rotations: &[RotationBlock],
    plastic: &[PlasticBlock],
    shares: impl Iterator<Item = S>,
    scale: f32,
    out: &mut [[f32; 3]],
) {
    let twice = R::splat(scale + scale);
    let mut blocks = rotations.iter().zip(plastic).zip(shares);
    for fan in fans(rest) {
        let mut sums = Sums::<R>::open();
        for (tet, ((rotation, plastic), share)) in fan.iter().zip(blocks.by_ref()) {
            for (sums, at) in sums.as_mut().iter_mut().zip(lanes::<R>()) {
                let q = polar::matrix(&rotation.load::<R>(at));
                let strain = plastic.load::<R>(at);
                let stress = share.of(twice, at) * R::load(&tet.mu_v, at);
                let f = each3(gradients::<R>(tet, at), |g| {
                    mul_vec(&q, &scale3(&sym_vec(&strain, &g), stress))
                });
                sums.add_balanced(&f, out, &tet.corners, at);
            }
        }
        Sums::<R>::close_balanced(&sums, out, last(fan));
    }
}

/// (γ₁, γ₂, a) of eight tetrahedra.
struct Laws([[f32; BLOCK]; 3]);

impl Laws {
    /// Of those that do not flow.
    const NEVER: [f32; 3] = [f32::MAX, f32::MAX, 0.0];

    fn numbers(law: &Plasticity, h: f32) -> [f32; 3] {
        [law.yield_strain, law.limit, h / (h + law.relaxation)]
    }

    fn all(law: &Plasticity, h: f32) -> Self {
        Self(Self::numbers(law, h).map(|x| [x; BLOCK]))
    }

    /// Those of a block, by its first tetrahedron.
    fn of(regions: &LawRegions<'_>, first: usize, h: f32) -> Self {
        let mut out = Self([[0.0; BLOCK]; 3]);
        for lane in 0..BLOCK {
            let region = regions.of.get(first + lane).copied().unwrap_or(u16::MAX);
            let law = regions.plasticity.get(usize::from(region));
            let law = law.copied().flatten();
            let numbers = law.map_or(Self::NEVER, |law| Self::numbers(&law, h));
            for (out, x) in out.0.iter_mut().zip(numbers) {
                out[lane] = x;
            }
        }
        out
    }
}

/// Strains beyond this would overflow when squared: they do not flow.
const LARGEST: f32 = 1e15;

/// Lets every tetrahedron flow for `h` seconds; returns the work that it took, in joules. (4), (5), (6)
#[inline(never)]
pub(crate) fn flow<R: Lanes, L: Layout, S: Share>(
    rest: &Rest<'_, L>,
    x: &[[f32; 3]],
    rotations: &[RotationBlock],
    shares: impl Iterator<Item = S>,
    (h, law, regions): (f32, &Plasticity, Option<&LawRegions<'_>>),
    plastic: &mut [PlasticBlock],
) -> f32 {
    let (zero, one) = (R::splat(0.0), R::splat(1.0));
    let mut laws = Laws::all(law, h);
    let mut first = (0..).step_by(BLOCK);
    let mut total = 0.0;
    let mut blocks = rotations.iter().zip(plastic).zip(shares);
    for fan in fans(rest) {
        let mut edges = Edges::<R>::open(x, fan);
        for (tet, ((rotation, plastic), share)) in fan.iter().zip(blocks.by_ref()) {
            if let (Some(regions), Some(first)) = (regions, first.next()) {
                laws = Laws::of(regions, first, h);
            }
            let mut work = [0.0; BLOCK];
            for (edges, at) in edges.as_mut().iter_mut().zip(lanes::<R>()) {
                let Some(edges) = edges.advance(x, &tet.corners, at) else {
                    continue;
                };
                let [yields, limit, part] = laws.0.each_ref().map(|x| R::load(x, at));
                let f = deformation(&edges, &gradients::<R>(tet, at));
                let strain = deviator(&polar::unrotated(&rotation.load::<R>(at), &f));
                let before = plastic.load::<R>(at);
                // What is not finite, or too large, is taken for nothing.
                let elastic: Sym3<R> = core::array::from_fn(|c| {
                    let e = strain[c] - before[c];
                    e.abs().where_below(R::splat(LARGEST), e, zero)
                });
                let size = inner(&elastic, &elastic).sqrt();
                let beyond = yields.where_below(size, (size - yields) / size, zero);
                let part = share.of(part * beyond, at);
                let flown: Sym3<R> = core::array::from_fn(|c| before[c] + part * elastic[c]);
                let size = inner(&flown, &flown).sqrt();
                let kept = limit.where_below(size, limit / size, one);
                let after: Sym3<R> = flown.map(|c| c * kept);
                // |e|² − |e − δ|² = δ : (2e − δ)
                let change: Sym3<R> = core::array::from_fn(|c| after[c] - before[c]);
                let twice: Sym3<R> = core::array::from_fn(|c| elastic[c] + elastic[c] - change[c]);
                let done = inner(&change, &twice) * R::load(&tet.mu_v, at);
                zero.where_below(done, done, zero).store(&mut work, at);
                for (c, out) in after.iter().zip(&mut plastic.0) {
                    c.store(out, at);
                }
            }
            for joules in work {
                total += joules;
            }
        }
    }
    // Work beyond f32 is as much as f32 can say.
    if total < f32::MAX { total } else { f32::MAX }
}

/// −2μV ε_p : ε + μV |ε_p|², of one tetrahedron, in joules. (2)
pub(crate) fn energy(mu_v: f64, plastic: &Sym3<f64>, b: &[[f64; 3]; 3]) -> f64 {
    // ε_p has no trace to speak of, but what it has meets ε's.
    let mut strain = deviator(b);
    let mean = (b[0][0] + b[1][1] + b[2][2]) / 3.0 - 1.0;
    for diagonal in [0, 3, 5] {
        strain[diagonal] += mean;
    }
    mu_v * (inner(plastic, plastic) - 2.0 * inner(plastic, &strain))
}
