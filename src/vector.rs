//! Sums and updates over node vectors.
//!
//! Sums run in one order for every lane width: eight running sums over the flat array, folded in a
//! fixed tree. Eight sums keep rounding low, and let the compiler use whatever lanes it has.

use crate::element::Sym3;
use crate::lane::{Lanes, Native};
use crate::math::Mask;

/// Running sums of a dot product.
pub(crate) const SUMS: usize = 8;

#[inline]
fn fold(s: [f32; SUMS]) -> f32 {
    ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]))
}

/// Running sums of one pass: where there are sixteen registers for single numbers, eight sums and what goes into them are
/// too many.
const PASS: usize = if Native::STAGES { SUMS / 2 } else { SUMS };

/// a · b
#[inline]
#[must_use]
pub fn dot(a: &[[f32; 3]], b: &[[f32; 3]]) -> f32 {
    dot_numbers(a.as_flattened(), b.as_flattened())
}

/// [`dot`] of plain numbers.
#[inline(never)]
#[must_use]
pub fn dot_numbers(a: &[f32], b: &[f32]) -> f32 {
    // Of one length, so that it is checked once.
    let length = a.len().min(b.len());
    let (a, b) = (a.get(..length), b.get(..length));
    let (a, b) = (a.unwrap_or_default(), b.unwrap_or_default());
    let (a, a_rest) = a.as_chunks::<SUMS>();
    let (b, b_rest) = b.as_chunks::<SUMS>();
    let mut sums = [0.0; SUMS];
    for (pass, sums) in sums.as_chunks_mut::<PASS>().0.iter_mut().enumerate() {
        for (a, b) in a.iter().zip(b) {
            for (k, sum) in sums.iter_mut().enumerate() {
                let k = (pass * PASS + k) % SUMS;
                *sum += a[k] * b[k];
            }
        }
    }
    for ((sum, a), b) in sums.iter_mut().zip(a_rest).zip(b_rest) {
        *sum += a * b;
    }
    fold(sums)
}

/// Numbers in one round of a loop: with one lane, several spare counting; with more, compilers see to it.
const ROUND: usize = if Native::WIDTH == 1 { SUMS } else { 1 };

/// The same for what a step does rarely, where a microcontroller's flash counts for more.
const RARE_ROUND: usize = if Native::STAGES { SUMS } else { 1 };

/// `change` of each number of `y` and its partner in `x`.
#[inline(always)]
fn pairs(y: &mut [[f32; 3]], x: &[[f32; 3]], change: impl Fn(&mut f32, f32)) {
    let (y, y_rest) = y.as_flattened_mut().as_chunks_mut::<ROUND>();
    let (x, x_rest) = x.as_flattened().as_chunks::<ROUND>();
    for (y, x) in y.iter_mut().zip(x) {
        for k in 0..ROUND {
            change(&mut y[k], x[k]);
        }
    }
    for (y, x) in y_rest.iter_mut().zip(x_rest) {
        change(y, *x);
    }
}

/// v += a p and r −= a q
#[inline(always)]
pub fn advance(v: &mut [[f32; 3]], r: &mut [[f32; 3]], a: f32, p: &[[f32; 3]], q: &[[f32; 3]]) {
    add_scaled(v, a, p);
    add_scaled(r, -a, q);
}

/// y = x, as far as both go: a length that differs is no panic.
#[inline]
pub fn copy<T: Copy>(y: &mut [T], x: &[T]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y = *x;
    }
}

/// y += a x
#[inline(never)]
pub fn add_scaled(y: &mut [[f32; 3]], a: f32, x: &[[f32; 3]]) {
    pairs(y, x, |y, x| *y += a * x);
}

/// y += a x; returns b · y, the [`dot`] of what y is then. For one lane in an engine: one trip to memory less.
#[inline(never)]
pub fn add_scaled_dot(y: &mut [[f32; 3]], a: f32, x: &[[f32; 3]], b: &[[f32; 3]]) -> f32 {
    let (y, x, b) = (y.as_flattened_mut(), x.as_flattened(), b.as_flattened());
    // Of one length, so that it is checked once.
    let (Some(x), Some(b)) = (x.get(..y.len()), b.get(..y.len())) else {
        return 0.0;
    };
    let (y, y_rest) = y.as_chunks_mut::<SUMS>();
    let (x, x_rest) = x.as_chunks::<SUMS>();
    let (b, b_rest) = b.as_chunks::<SUMS>();
    let mut sums = [0.0; SUMS];
    for (pass, sums) in sums.as_chunks_mut::<PASS>().0.iter_mut().enumerate() {
        for ((y, x), b) in y.iter_mut().zip(x).zip(b) {
            for (k, sum) in sums.iter_mut().enumerate() {
                let k = (pass * PASS + k) % SUMS;
                y[k] += a * x[k];
                *sum += b[k] * y[k];
            }
        }
    }
    for (((sum, y), x), b) in sums.iter_mut().zip(y_rest).zip(x_rest).zip(b_rest) {
        *y += a * x;
        *sum += b * *y;
    }
    fold(sums)
}

/// y = x + b y
#[inline(never)]
pub fn scale_and_add(y: &mut [[f32; 3]], b: f32, x: &[[f32; 3]]) {
    pairs(y, x, |y, x| *y = x + b * *y);
}

/// y *= a where `usable`, else y = 0, whatever it was
#[inline(never)]
pub(crate) fn scale_or_clear(y: &mut [[f32; 3]], a: f32, usable: Mask) {
    let (rounds, left) = y.as_flattened_mut().as_chunks_mut::<RARE_ROUND>();
    for y in rounds {
        for y in y {
            *y = usable.keep(*y * a);
        }
    }
    for y in left {
        *y = usable.keep(*y * a);
    }
}

/// y = x, unless y is to `stay`
#[inline(never)]
pub(crate) fn keep_or_take(y: &mut [[f32; 3]], stay: Mask, x: &[[f32; 3]]) {
    for (y, x) in y.as_flattened_mut().iter_mut().zip(x.as_flattened()) {
        *y = stay.pick(*y, *x);
    }
}

/// S v
#[inline]
#[must_use]
pub fn sym_mul(s: &Sym3<f32>, v: &[f32; 3]) -> [f32; 3] {
    [
        s[0] * v[0] + s[1] * v[1] + s[2] * v[2],
        s[1] * v[0] + s[3] * v[1] + s[4] * v[2],
        s[2] * v[0] + s[4] * v[1] + s[5] * v[2],
    ]
}

/// [`sym_mul`], where it is called so rarely that its size counts.
#[inline(never)]
pub(crate) fn project(s: &Sym3<f32>, v: &[f32; 3]) -> [f32; 3] {
    sym_mul(s, v)
}

/// y_i = S_i x_i
#[inline(never)]
pub fn multiply_blocks(y: &mut [[f32; 3]], blocks: &[Sym3<f32>], x: &[[f32; 3]]) {
    for ((y, s), x) in y.iter_mut().zip(blocks).zip(x) {
        *y = sym_mul(s, x);
    }
}

/// y_i = S_i y_i
#[inline(never)]
pub fn multiply_in_place(y: &mut [[f32; 3]], blocks: &[Sym3<f32>]) {
    for (y, s) in y.iter_mut().zip(blocks) {
        *y = sym_mul(s, y);
    }
}

/// Σ m_i u_i, each axis with a running compensation (Neumaier 1974): the sum's error does not grow
/// with the number of nodes.
#[inline(never)]
#[must_use]
pub fn momentum(masses: &[f32], u: &[[f32; 3]]) -> [f32; 3] {
    let (mut sum, mut lost) = ([0.0_f32; 3], [0.0_f32; 3]);
    for (m, u) in masses.iter().zip(u) {
        for axis in 0..3 {
            let (a, b) = (sum[axis], m * u[axis]);
            let s = a + b;
            // Knuth's two-sum: exact without a comparison of magnitudes.
            let t = s - a;
            lost[axis] += (a - (s - t)) + (b - t);
            sum[axis] = s;
        }
    }
    core::array::from_fn(|axis| sum[axis] + lost[axis])
}
