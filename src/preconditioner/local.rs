//! Preconditioners that need nothing but the step's own matrix.
//!
//! All four are one symmetric 3×3 block B_i per node, with the filter on both sides: z_i = P_i B_i P_i r_i.
//! So they share one buffer and one loop, and the choice between them costs nothing in the iteration.

use crate::element::Sym3;
use crate::math::{Mask, ratio};

/// The block B_i of node i: see the variants of the same names of
/// [`Preconditioner`](super::Preconditioner).
#[derive(Clone, Copy, Debug)]
pub(super) enum Local {
    Identity,
    Mass,
    Jacobi,
    BlockJacobi,
}

impl Local {
    /// Writes P_i B_i P_i for every node over the diagonal blocks of A; B_i where P `may_change`.
    pub fn prepare(
        self,
        inertia: &[f32],
        filter: &[Sym3<f32>],
        may_change: bool,
        blocks: &mut [Sym3<f32>],
    ) {
        for ((block, p), m) in blocks.iter_mut().zip(filter).zip(inertia) {
            // Pins leave all or nothing.
            let part = if may_change { 1.0 } else { p[0] };
            let diagonal = |x: f32, y: f32, z: f32| [x, 0.0, 0.0, y, 0.0, z];
            let local = match self {
                Self::Identity => diagonal(1.0, 1.0, 1.0),
                Self::Mass => {
                    let inverse = 1.0 / m;
                    diagonal(inverse, inverse, inverse)
                }
                Self::Jacobi | Self::BlockJacobi => {
                    let per = |x: f32| ratio(1.0, x, 0.0);
                    let (x, y, z) = (per(block[0]), per(block[3]), per(block[5]));
                    if matches!(self, Self::Jacobi) {
                        diagonal(x, y, z)
                    } else {
                        inverse(block, [x, y, z])
                    }
                }
            };
            *block = local.map(|x| x * part);
        }
    }
}

/// Inverse of a symmetric positive definite block by cofactors. Where rounding has made the
/// determinant useless (det ≤ 1e-5 of the product of the diagonal), the inverse of the diagonal, which is given.
#[inline]
fn inverse(a: &Sym3<f32>, [dx, dy, dz]: [f32; 3]) -> Sym3<f32> {
    // Every product carries the diagonal's inverses, which keeps it of order one in any unit.
    let (xy, xz, yz) = (a[1], a[2], a[4]);
    let (sx, sy, sz) = (yz * yz * dy * dz, xz * xz * dx * dz, xy * xy * dx * dy);
    let det = 1.0 - sx - sy - sz + 2.0 * (xy * dx) * (yz * dy) * (xz * dz);
    let good = Mask::of(det > 1e-5);
    let scale = 1.0 / det;
    let off = |x: f32| good.keep(x * scale);
    let on = |d: f32, s: f32| good.pick(d * (1.0 - s) * scale, d);
    [
        on(dx, sx),
        off(dx * dy * (xz * yz * dz - xy)),
        off(dx * dz * (xy * yz * dy - xz)),
        on(dy, sy),
        off(dy * dz * (xy * xz * dx - yz)),
        on(dz, sz),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::mul_mat;

    #[test]
    fn inverse_of_a_block() {
        let a = [4.0, 1.0, -0.5, 3.0, 0.25, 2.0];
        let b = inverse(&a, [0.25, 1.0 / 3.0, 0.5]);
        let full = |s: &Sym3<f32>| [[s[0], s[1], s[2]], [s[1], s[3], s[4]], [s[2], s[4], s[5]]];
        let product = mul_mat(&full(&a), &full(&b));
        for (i, row) in product.iter().enumerate() {
            for (j, x) in row.iter().enumerate() {
                // A dozen roundings of numbers of order one.
                assert!(
                    (x - f32::from(i == j)).abs() < 12.0 * f32::EPSILON,
                    "{product:?}"
                );
            }
        }
    }

    #[test]
    fn a_singular_block_falls_back_to_its_diagonal() {
        assert_eq!(inverse(&[1.0; 6], [1.0; 3]), [1.0, 0.0, 0.0, 1.0, 0.0, 1.0]);
        assert_eq!(inverse(&[0.0; 6], [0.0; 3]), [0.0; 6]);
    }
}
