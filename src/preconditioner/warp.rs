//! The rotation of a node: what turns a factor of the rest matrix with the body.

use crate::element::{Layout, Sym3};
use crate::fan::{Sums, fans, lanes, last};
use crate::lane::Lanes;
use crate::math::{Mask, sqrt};
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
                let rows = [a, b, c, d, e, f].map(|x| x * weight);
                sums.add(&[rows; 4], out, &tet.corners, at);
            }
        }
        Sums::<R, 6>::close(&sums, out, last(fan));
    }
    for rows in out {
        *rows = orthonormal(rows);
    }
}

/// The nearest two orthonormal rows; [`UPRIGHT`] where the average says nothing.
#[inline]
fn orthonormal(rows: &Rows) -> Rows {
    let &[a, b, c, d, e, f] = rows;
    let (first, one) = unit(&[a, b, c]);
    let (second, two) = unit(&[d, e, f]);
    // Of two unit vectors, sum and difference are orthogonal; they halve the angle between the rows.
    let (sum, three) = unit(&core::array::from_fn(|k| first[k] + second[k]));
    let (difference, four) = unit(&core::array::from_fn(|k| first[k] - second[k]));
    let [x, y, z] = core::array::from_fn(|k| HALF_SQRT * (sum[k] + difference[k]));
    let [u, v, w] = core::array::from_fn(|k| HALF_SQRT * (sum[k] - difference[k]));
    let usable = Mask::of(one & two & three & four);
    let mut out = [x, y, z, u, v, w];
    for (x, upright) in out.iter_mut().zip(UPRIGHT) {
        *x = usable.pick(*x, upright);
    }
    out
}

/// 1/√2
const HALF_SQRT: f32 = core::f32::consts::FRAC_1_SQRT_2;

/// u over its length, and whether it has one (in f32's range, squared).
#[inline(never)]
fn unit(u: &[f32; 3]) -> ([f32; 3], bool) {
    // By the sum of magnitudes first: squares of stiffnesses can leave the range of f32.
    let size = u[0].abs() + u[1].abs() + u[2].abs();
    let usable = (size > f32::MIN_POSITIVE * 16.0) & size.is_finite();
    let inverse = 1.0 / Mask::of(usable).pick(size, 1.0);
    let u = u.map(|x| x * inverse);
    let square = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    let inverse = 1.0 / sqrt(Mask::of(usable).pick(square, 1.0));
    (u.map(|x| x * inverse), usable)
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
            let rows = orthonormal(&noisy.map(|x| x * scale));
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
            assert_eq!(orthonormal(&rows), UPRIGHT);
        }
    }

    #[test]
    fn turning_back_is_the_transpose() {
        let rows = orthonormal(&[0.9, 0.1, -0.2, 0.3, 1.4, 0.1]);
        let u = [0.3, -2.0, 0.7];
        let back = unturn(&rows, &turn(&rows, &u));
        for axis in 0..3 {
            assert!((back[axis] - u[axis]).abs() < 8.0 * f32::EPSILON);
        }
    }
}
