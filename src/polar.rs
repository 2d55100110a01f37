//! Polar decomposition F = Q S by a fixed number of Jacobi sweeps.
//!
//! Q is a rotation (det Q = +1), S symmetric. With B = QᵀF, one *rotation of a pair* (p, r) makes
//! B symmetric in that plane:
//!
//! ```text
//! a = B_pp + B_rr,  d = B_rp − B_pr,  (c, s) = (a, d)/√(a² + d²)
//! B ← RᵀB,  Q ← Q R,  R = [c −s; s c] in the plane (p, r)
//! ```
//!
//! Among all rotations in that plane it gives the greatest tr(QᵀF) (the plane's share grows from a to √(a² + d²)),
//! so sweeps over the pairs (0,1), (0,2), (1,2) climb to the nearest *rotation* of F, also where F
//! is flat or inverted: no sign fix and no SVD. Where a = d = 0 every angle is as good, and the
//! identity is taken. A sweep from a good start squares its error while the stretches s₁ ≥ s₂ ≥ s₃
//! (s₃ < 0 when inverted) keep s₂ + s₃ large; where that nearly vanishes, sweeps gain little.
//!
//! Q is kept as a unit quaternion and renormalised once a fit, so it cannot drift. A warm start
//! comes from the last step; [`nearest_rotation`] starts cold.
//!
//! Source: the pairwise rotations are those of Dahl and Bargteil (MIG 2019, section 3); quaternion
//! storage and scaling are ours.

use crate::algebra::{dot3, each3, mul_mat, scale3, transpose, zero3};
use crate::lane::Real;

/// A unit quaternion, scalar first: (w, x, y, z).
pub type Quaternion<R> = [R; 4];

/// No rotation.
#[inline(always)]
#[must_use]
pub fn identity<R: Real>() -> Quaternion<R> {
    [R::splat(1.0), R::splat(0.0), R::splat(0.0), R::splat(0.0)]
}

/// The rotation matrix of a unit quaternion.
#[inline(always)]
#[must_use]
pub fn matrix<R: Real>(q: &Quaternion<R>) -> [[R; 3]; 3] {
    let &[w, x, y, z] = q;
    let one = R::splat(1.0);
    let (x2, y2, z2) = (x + x, y + y, z + z);
    let (xx, yy, zz) = (x * x2, y * y2, z * z2);
    let (xy, xz, yz) = (x * y2, x * z2, y * z2);
    let (wx, wy, wz) = (w * x2, w * y2, w * z2);
    [
        [one - (yy + zz), xy - wz, xz + wy],
        [xy + wz, one - (xx + zz), yz - wx],
        [xz - wy, yz + wx, one - (xx + yy)],
    ]
}

/// QᵀF.
#[inline(always)]
#[must_use]
pub fn unrotated<R: Real>(q: &Quaternion<R>, f: &[[R; 3]; 3]) -> [[R; 3]; 3] {
    mul_mat(&transpose(&matrix(q)), f)
}

/// What brings F to size one, so that squares neither overflow nor vanish: its polar rotation is the
/// same. A zero or overflowing F becomes zero, and keeps any rotation that it is given.
#[inline(always)]
fn normaliser<R: Real>(f: &[[R; 3]; 3]) -> R {
    // Sixteenths: the sum of nine magnitudes up to f32::MAX stays finite.
    let sixteenth = R::splat(0.0625);
    let size = f
        .iter()
        .flatten()
        .fold(R::splat(0.0), |sum, x| sum + x.abs() * sixteenth);
    let none = size.below(R::splat(f32::MIN_POSITIVE * 16.0));
    R::pick(none, R::splat(0.0), sixteenth / size)
}

/// F times its [`normaliser`].
#[inline(always)]
fn normalised<R: Real>(f: &[[R; 3]; 3]) -> [[R; 3]; 3] {
    let scale = normaliser(f);
    each3(*f, |row| scale3(&row, scale))
}

/// Improves `q` by `sweeps` sweeps towards the nearest rotation of `f`; never lowers tr(QᵀF)
/// beyond rounding. The cost depends on `sweeps` alone.
#[inline(always)]
#[must_use]
pub fn sweeps<R: Real>(q: &Quaternion<R>, f: &[[R; 3]; 3], sweeps: u32) -> Quaternion<R> {
    let start = *q;
    let mut q = start;
    let mut b = unrotated(&q, &normalised(f));
    for _ in 0..sweeps {
        // Written out, so that q and B stay in registers.
        let [first, second, third] = PLANES;
        rotate_pair(&mut q, &mut b, first);
        rotate_pair(&mut q, &mut b, second);
        rotate_pair(&mut q, &mut b, third);
        q = shortened(&q);
    }
    usable(&unit(&q), &start)
}

/// A fit under way, for several side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fit<R> {
    /// Q
    q: Quaternion<R>,
    /// QᵀF
    b: [[R; 3]; 3],
    /// What the next step multiplies by.
    factor: R,
}

impl<R: Real> Fit<R> {
    /// Of nothing.
    #[inline(always)]
    pub fn still() -> Self {
        Self {
            q: identity(),
            b: [zero3(); 3],
            factor: R::splat(0.0),
        }
    }

    /// Towards the rotation of `f`: first, its [`normaliser`].
    #[inline(always)]
    pub fn measure(&mut self, f: &[[R; 3]; 3]) {
        self.factor = normaliser(f);
    }

    /// Then, from `q`.
    #[inline(always)]
    pub fn start(&mut self, q: &Quaternion<R>, f: &[[R; 3]; 3]) {
        let m = matrix(q);
        for j in 0..3 {
            let column = each3(*f, |row| row[j] * self.factor);
            for i in 0..3 {
                self.b[i][j] = dot3(&[m[0][i], m[1][i], m[2][i]], &column);
            }
        }
        self.q = *q;
    }

    /// Q, or `start` where F is infinite.
    #[inline(always)]
    pub fn end(&self, start: &Quaternion<R>) -> Quaternion<R> {
        usable(&unit(&self.q), start)
    }
}

/// One sweep of each, in steps that end with a root and a quotient: while one waits for them, the next goes on. The numbers
/// are those of [`sweeps`], but for B, which nobody needs after the `last`.
#[inline(always)]
pub(crate) fn sweep<R: Real>(fits: &mut [Fit<R>], last: bool) {
    let [first, second, third] = PLANES;
    for fit in fits.iter_mut() {
        fit.factor = inverse_length(&fit.b, first);
    }
    for fit in fits.iter_mut() {
        turn_pair(&mut fit.q, &mut fit.b, first, fit.factor);
        fit.factor = inverse_length(&fit.b, second);
    }
    for fit in fits.iter_mut() {
        turn_pair(&mut fit.q, &mut fit.b, second, fit.factor);
        fit.factor = inverse_length(&fit.b, third);
    }
    for fit in fits.iter_mut() {
        let (c, s) = cosine_and_sine(&fit.b, third, fit.factor);
        if !last {
            turn_matrix(&mut fit.b, third, c, s);
        }
        fit.q = shortened(&turned_pair(&fit.q, third, c, s));
    }
}

/// The plane (p, s), the base vector of its normal, 1 to 3, and the sign of that.
type Plane = (usize, usize, usize, f32);

/// The planes of a sweep.
const PLANES: [Plane; 3] = [(0, 1, 3, 1.0), (0, 2, 2, -1.0), (1, 2, 1, 1.0)];

/// `q` if it is a unit quaternion, else `fallback`: an infinite F leaves the rotation as it was.
#[inline(always)]
fn usable<R: Real>(q: &Quaternion<R>, fallback: &Quaternion<R>) -> Quaternion<R> {
    let off = (square(q) - R::splat(1.0)).abs();
    let near = off.below(R::splat(0.5));
    core::array::from_fn(|k| R::pick(near, q[k], fallback[k]))
}

#[inline(always)]
fn square<R: Real>(&[w, x, y, z]: &Quaternion<R>) -> R {
    w * w + x * x + y * y + z * z
}

/// The rotation of one pair.
#[inline(always)]
fn rotate_pair<R: Real>(q: &mut Quaternion<R>, b: &mut [[R; 3]; 3], plane: Plane) {
    let inverse = inverse_length(b, plane);
    turn_pair(q, b, plane, inverse);
}

/// (a, d) of a pair.
#[inline(always)]
fn pair<R: Real>(b: &[[R; 3]; 3], (p, s, _, _): Plane) -> (R, R) {
    // Only to keep the panic of an index out of the binary.
    let (p, r) = (p % 3, s % 3);
    (b[p][p] + b[r][r], b[r][p] - b[p][r])
}

/// 1/√(a² + d²) of a pair.
#[inline(always)]
fn inverse_length<R: Real>(b: &[[R; 3]; 3], plane: Plane) -> R {
    let (a, d) = pair(b, plane);
    R::splat(1.0) / (a * a + d * d).sqrt()
}

/// [`rotate_pair`], given the [`inverse_length`].
#[inline(always)]
fn turn_pair<R: Real>(q: &mut Quaternion<R>, b: &mut [[R; 3]; 3], plane: Plane, inverse: R) {
    let (c, s) = cosine_and_sine(b, plane, inverse);
    turn_matrix(b, plane, c, s);
    *q = turned_pair(q, plane, c, s);
}

/// (c, s) of a pair, given the [`inverse_length`].
#[inline(always)]
fn cosine_and_sine<R: Real>(b: &[[R; 3]; 3], plane: Plane, inverse: R) -> (R, R) {
    let (a, d) = pair(b, plane);
    direction_by(a, d, inverse)
}

/// B ← RᵀB
#[inline(always)]
fn turn_matrix<R: Real>(b: &mut [[R; 3]; 3], (p, r, _, _): Plane, c: R, s: R) {
    let (p, r) = (p % 3, r % 3);
    for j in 0..3 {
        let (bp, br) = (b[p][j], b[r][j]);
        b[p][j] = c * bp + s * br;
        b[r][j] = c * br - s * bp;
    }
}

/// Q R, longer than Q.
#[inline(always)]
fn turned_pair<R: Real>(q: &Quaternion<R>, (_, _, axis, sign): Plane, c: R, s: R) -> Quaternion<R> {
    let (half_c, half_s) = half_angle(c, s);
    turned(q, half_c, R::splat(sign) * half_s, axis)
}

/// (a, d)/√(a² + d²), or (1, 0) where both vanish. The input is of order one or smaller.
#[inline(always)]
pub(crate) fn direction<R: Real>(a: R, d: R) -> (R, R) {
    direction_by(a, d, R::splat(1.0) / (a * a + d * d).sqrt())
}

/// [`direction`], given 1/√(a² + d²).
#[inline(always)]
fn direction_by<R: Real>(a: R, d: R, inverse: R) -> (R, R) {
    // The infinity of a zero is not picked: nobody waits for the decision before the root.
    let none = (a * a + d * d).below(R::splat(1e-30));
    (
        R::pick(none, R::splat(1.0), a * inverse),
        R::pick(none, R::splat(0.0), d * inverse),
    )
}

/// A vector along (cos φ/2, sin φ/2), of length between √2 and 2. The two forms of the half-angle
/// formula are each exact on one half of the circle.
#[inline(always)]
pub(crate) fn half_angle<R: Real>(c: R, s: R) -> (R, R) {
    R::swap(c.below(R::splat(0.0)), R::splat(1.0) + c.abs(), s)
}

/// q (w, s e_axis): a turn about a base axis, 1 to 3.
#[inline(always)]
fn turned<R: Real>(q: &Quaternion<R>, w: R, s: R, axis: usize) -> Quaternion<R> {
    // The axis, and the two that follow it round.
    let (i, j, k) = (axis % 4, axis % 3 + 1, (axis + 1) % 3 + 1);
    let mut out = *q;
    out[0] = q[0] * w - q[i] * s;
    out[i] = q[i] * w + q[0] * s;
    out[j] = q[j] * w + q[k] * s;
    out[k] = q[k] * w - q[j] * s;
    out
}

/// q after the three turns of a sweep, each of which lengthens it by √2 to 2, and by 2 in the end, when there is nothing left to
/// turn: an eighth, exactly. So the length stays between 0 and 1 without a root. (Hundreds of sweeps of an F whose
/// s₂ + s₃ is nothing but rounding, which turns for ever, can bring its square near f32's least, and Q is then off its unit length.)
#[inline(always)]
fn shortened<R: Real>(q: &Quaternion<R>) -> Quaternion<R> {
    q.map(|c| c * R::splat(0.125))
}

#[inline(always)]
fn unit<R: Real>(q: &Quaternion<R>) -> Quaternion<R> {
    let inverse = R::splat(1.0) / square(q).sqrt();
    let &[w, x, y, z] = q;
    [w * inverse, x * inverse, y * inverse, z * inverse]
}

/// The rotation nearest to `f`, from nothing; for loading, not for a step. Fixed cost. Where the nearest
/// rotation is not unique, one of them; the identity where `f` is not finite, or where its entries are
/// so small that they count as zero (3e-36 in sum, in f32).
///
/// Sweeps can stop at a saddle, so this goes another way (Horn 1987): tr(QᵀF) = qᵀNq for the unit
/// quaternion q of Q, and the greatest is at N's greatest eigenvector, found by Jacobi's method for
/// symmetric matrices. Two sweeps polish what the eigenvector's rounding leaves.
#[must_use]
pub fn nearest_rotation<R: Real>(f: &[[R; 3]; 3]) -> Quaternion<R> {
    let (zero, one) = (R::splat(0.0), R::splat(1.0));
    let f = normalised(f);
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = f;
    let mut n = [
        [xx + yy + zz, zy - yz, xz - zx, yx - xy],
        [zy - yz, xx - yy - zz, xy + yx, xz + zx],
        [xz - zx, xy + yx, yy - xx - zz, yz + zy],
        [yx - xy, xz + zx, yz + zy, zz - xx - yy],
    ];
    // Rows of v become eigenvectors: v N vᵀ is diagonal in the end.
    let mut v: [[R; 4]; 4] =
        core::array::from_fn(|i| core::array::from_fn(|j| if i == j { one } else { zero }));
    for _ in 0..EIGEN_SWEEPS {
        for (p, r) in [(0, 1), (2, 3), (0, 2), (1, 3), (0, 3), (1, 2)] {
            // Only to keep the panic of an index out of the binary.
            let (p, r) = (p % 4, r % 4);
            // tan 2φ = 2 N_pr / (N_pp − N_rr)
            let (c2, s2) = direction(n[p][p] - n[r][r], n[p][r] + n[p][r]);
            let (half_c, half_s) = half_angle(c2, s2);
            let (c, s) = direction(half_c, half_s);
            for row in &mut n {
                let (a, b) = (row[p], row[r]);
                (row[p], row[r]) = (c * a + s * b, c * b - s * a);
            }
            for m in [&mut n, &mut v] {
                for k in 0..4 {
                    let (a, b) = (m[p][k], m[r][k]);
                    (m[p][k], m[r][k]) = (c * a + s * b, c * b - s * a);
                }
            }
        }
    }
    let (mut best, mut most) = (v[0], n[0][0]);
    for k in 1..4 {
        best = core::array::from_fn(|c| most.where_below(n[k][k], v[k][c], best[c]));
        most = most.where_below(n[k][k], n[k][k], most);
    }
    let mut q = unit(&best);
    let mut b = unrotated(&q, &f);
    for _ in 0..2 {
        // The compiler is not to know how many there are, and write them out: speed does not count here.
        for plane in core::hint::black_box(PLANES) {
            rotate_pair(&mut q, &mut b, plane);
        }
        q = unit(&q);
    }
    usable(&q, &identity())
}

/// Jacobi's method squares its error in a sweep once it is small; six bring a 4×4 matrix to f64's end.
const EIGEN_SWEEPS: u32 = 6;
