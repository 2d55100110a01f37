//! The rotation of a node: what turns a factor of the rest matrix with the body.

use crate::algebra::{add3, dot3, scale3, sub3};
use crate::element::{Layout, Sym3};
use crate::fan::{Sums, fans, lanes, last};
use crate::lane::{BLOCK, Lanes, Real};
use crate::math::Mask;
use crate::operator::RotationBlock;
use crate::polar;
use crate::rest::Rest;

/// The first two rows of a node's rotation; the third is their cross product.
type Rows = Sym3<f32>;

/// No rotation.
const UPRIGHT: Rows = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0];

/// Writes, for every node, the average of its tetrahedra's rotations, weighted with their stiffness μV.
///
/// Only two rows are averaged and made orthonormal, evenly (Löwdin); the third follows. It differs from
/// the nearest rotation in the second order of the rotations' differences, and needs no iteration.
pub(super) fn average_rotations<R: Lanes, L: Layout>(
    rest: &Rest<'_, L>,
    rotations: &[RotationBlock],
    out: &mut [Rows],
) {
    out.fill([0.0; 6]);
    let mut rotations = rotations.iter();
    for fan in fans(rest) {
        let mut sums = Sums::<R, 6>::open();
        for (tet, rotation) in fan.iter().zip(rotations.by_ref()) {
            for (sums, at) in sums.as_mut().iter_mut().zip(lanes::<R>()) {
                let weight = R::load(&tet.mu_v, at);
                let [[a, b, c], [d, e, f], _] = polar::matrix(&rotation.load::<R>(at));
                let rows = [
                    a * weight,
                    b * weight,
                    c * weight,
                    d * weight,
                    e * weight,
                    f * weight,
                ];
                sums.add(&[rows; 4], out, &tet.corners, at);
            }
        }
        Sums::<R, 6>::close(&sums, out, last(fan));
    }
    if R::WIDTH == 1 {
        for rows in out {
            *rows = orthonormal(rows, unit_once);
        }
    } else {
        for nodes in out.chunks_mut(BLOCK) {
            side_by_side::<R::Wide>(nodes);
        }
    }
}

/// [`orthonormal`] of a block of nodes.
#[inline(always)]
fn side_by_side<R: Lanes>(nodes: &mut [Rows]) {
    let mut block = [[0.0; BLOCK]; 6];
    for (lane, rows) in (0..BLOCK).zip(&*nodes) {
        for (numbers, x) in block.iter_mut().zip(rows) {
            numbers[lane] = *x;
        }
    }
    for at in lanes::<R>() {
        let rows = core::array::from_fn(|k| R::load(&block[k], at));
        for (x, numbers) in orthonormal(&rows, unit).iter().zip(&mut block) {
            x.store(numbers, at);
        }
    }
    for (lane, rows) in (0..BLOCK).zip(nodes) {
        *rows = core::array::from_fn(|k| block[k][lane]);
    }
}

/// The nearest two orthonormal rows; [`UPRIGHT`] where the average says nothing.
#[inline(always)]
fn orthonormal<R: Real>(rows: &Sym3<R>, unit: impl Fn(&[R; 3]) -> ([R; 3], R::Mask)) -> Sym3<R> {
    let &[a, b, c, d, e, f] = rows;
    let (first, one) = unit(&[a, b, c]);
    let (second, two) = unit(&[d, e, f]);
    // Of two unit vectors, sum and difference are orthogonal; they halve the angle between the rows.
    let (sum, three) = unit(&add3(&first, &second));
    let (difference, four) = unit(&sub3(&first, &second));
    let half = R::splat(HALF_SQRT);
    let [x, y, z] = scale3(&add3(&sum, &difference), half);
    let [u, v, w] = scale3(&sub3(&sum, &difference), half);
    let usable = R::both(R::both(one, two), R::both(three, four));
    let mut out = [x, y, z, u, v, w];
    for (x, upright) in out.iter_mut().zip(UPRIGHT) {
        *x = R::pick(usable, *x, R::splat(upright));
    }
    out
}

/// 1/√2
const HALF_SQRT: f32 = core::f32::consts::FRAC_1_SQRT_2;

/// u over its length, and whether it has one (in f32's range, squared).
#[inline(always)]
fn unit<R: Real>(u: &[R; 3]) -> ([R; 3], R::Mask) {
    let one = R::splat(1.0);
    // By the sum of magnitudes first: squares of stiffnesses can leave the range of f32.
    let size = u[0].abs() + u[1].abs() + u[2].abs();
    let usable = R::both(
        R::splat(f32::MIN_POSITIVE * 16.0).below(size),
        size.below(R::splat(f32::INFINITY)),
    );
    let u = scale3(u, one / R::pick(usable, size, one));
    let square = dot3(&u, &u);
    let inverse = one / R::pick(usable, square, one).sqrt();
    (scale3(&u, inverse), usable)
}

/// [`unit`] of numbers, of which a binary needs one.
#[inline(never)]
fn unit_once(u: &[f32; 3]) -> ([f32; 3], Mask) {
    unit(u)
}

/// R u
#[inline]
pub(super) fn turn(&[a, b, c, d, e, f]: &Rows, u: &[f32; 3]) -> [f32; 3] {
    let third = [b * f - c * e, c * d - a * f, a * e - b * d];
    [
        a * u[0] + b * u[1] + c * u[2],
        d * u[0] + e * u[1] + f * u[2],
        third[0] * u[0] + third[1] * u[1] + third[2] * u[2],
    ]
}

/// Rᵀ u
#[inline]
pub(super) fn unturn(&[a, b, c, d, e, f]: &Rows, u: &[f32; 3]) -> [f32; 3] {
    let third = [b * f - c * e, c * d - a * f, a * e - b * d];
    [
        a * u[0] + d * u[1] + third[0] * u[2],
        b * u[0] + e * u[1] + third[1] * u[2],
        c * u[0] + f * u[1] + third[2] * u[2],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_become_orthonormal() {
        let noisy = [0.9, 0.1, -0.2, 0.3, 1.4, 0.1];
        for scale in [1.0, 1e-30, 1e35] {
            let rows = orthonormal(&noisy.map(|x| x * scale), unit_once);
            let [a, b, c, d, e, f] = rows.map(f64::from);
            for off in [
                a * a + b * b + c * c - 1.0,
                d * d + e * e + f * f - 1.0,
                a * d + b * e + c * f,
            ] {
                assert!(off.abs() < 4.0 * f64::from(f32::EPSILON), "{rows:?}");
            }
        }
    }

    #[test]
    fn what_says_nothing_stays_upright() {
        for rows in [
            [0.0; 6],
            [f32::NAN; 6],
            [1.0, 0.0, 0.0, 1.0, 0.0, 0.0],
            [f32::INFINITY, 0.0, 0.0, 0.0, 1.0, 0.0],
        ] {
            assert_eq!(orthonormal(&rows, unit_once), UPRIGHT);
        }
    }

    #[test]
    fn turning_back_is_the_transpose() {
        let rows = orthonormal(&[0.9, 0.1, -0.2, 0.3, 1.4, 0.1], unit_once);
        let u = [0.3, -2.0, 0.7];
        let back = unturn(&rows, &turn(&rows, &u));
        for axis in 0..3 {
            assert!((back[axis] - u[axis]).abs() < 8.0 * f32::EPSILON);
        }
    }
}
