//! A factor that survives rotation.
//!
//! A step's matrix changes almost only by rotation, so that the matrix at rest, A₀ = c_M M + c_K K(rest),
//! is factored once, on a host, in f64, and stored rounded: A₀ ≈ L D Lᵀ with unit lower triangular L, nodes
//! in an order that keeps L sparse. Applying it takes two triangular solves over read-only data. Two kinds:
//!
//! * **warped**: of the whole matrix, in 3×3 blocks; z = R (L D Lᵀ)⁻¹ Rᵀ r with the rotations R of the nodes,
//!   each the average of its tetrahedra's (as Müller et al. 2002 warp the stiffness itself);
//! * **Laplacian**: of c_M M + c_K Σ w V g_i·g_j, one number a pair of nodes and the same for x, y and z, so
//!   that it commutes with rotation: nine times smaller, and weaker on slender, stiff bodies. (It is
//!   the matrix that Projective Dynamics factors, Bouaziz et al. 2014; here it only guides the
//!   solver, and the answer stays the corotated one.)
//!
//! Whatever the numbers in L, the preconditioner is symmetric positive definite, because the backward
//! solve is the transpose of the forward solve, entry for entry: a factor made for another time
//! step, another material, or other pins costs iterations, not stability.
//!
//! Where a body is so stiff for its step that f32 no longer holds its inertia beside its stiffness
//! (h²E/(ρ dx²) beyond 10⁷, with the cell's edge dx), a warped factor, which finds rigid motions at once,
//! amplifies rounding; a local preconditioner does not.
//!
//! Entries may be stored in half precision (IEEE binary16, computed in f32): half the flash.

use core::fmt;
use core::ops::Range;

use crate::element::Sym3;
use crate::vector::sym_mul;

/// L D Lᵀ of a matrix over the nodes, borrowed: from flash, an asset, or a `Vec`.
///
/// L is stored by columns: column j is that of node `order[j]`, and has the entries
/// `ends[j − 1]..ends[j]` of `rows` and of the lower triangle. Rows are node numbers, so that a solve
/// needs no permutation and no scratch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factor<'a> {
    fingerprint: u64,
    order: &'a [u16],
    ends: &'a [u32],
    rows: &'a [u16],
    entries: Entries<'a>,
}

/// The numbers of a factor: D⁻¹ by node, and L's entries below the diagonal.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Entries<'a> {
    /// Warped, in f32: blocks by columns.
    Warped {
        /// D⁻¹, one symmetric block a node.
        pivots: &'a [Sym3<f32>],
        /// L's blocks, each by columns.
        lower: &'a [[f32; 9]],
    },
    /// Warped, in half precision.
    WarpedHalf {
        /// D⁻¹, one symmetric block a node.
        pivots: &'a [Sym3<f32>],
        /// L's blocks, each by columns, as bits of binary16.
        lower: &'a [[u16; 9]],
    },
    /// Laplacian, in f32.
    Laplacian {
        /// D⁻¹, one number a node.
        pivots: &'a [f32],
        /// L's entries.
        lower: &'a [f32],
    },
    /// Laplacian, in half precision.
    LaplacianHalf {
        /// D⁻¹, one number a node.
        pivots: &'a [f32],
        /// L's entries, as bits of binary16.
        lower: &'a [u16],
    },
}

/// What is wrong with the parts of a factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FactorError {
    /// Orders, column ends, pivots, rows or entries are not as many as they should be, or the ends descend.
    Shape,
    /// This column, or this row, names a node that is not there.
    Node {
        /// Its place in `order`, or in `rows`.
        place: usize,
    },
    /// The pivot of this node is not positive definite.
    Pivot {
        /// The node.
        node: usize,
    },
    /// This entry of L is infinite, NaN or, in half precision, subnormal.
    Entry {
        /// Its place in `rows`.
        place: usize,
    },
}

impl fmt::Display for FactorError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shape => f.write_str("the parts of the factor do not fit together"),
            Self::Node { place } => write!(f, "index {place} of the factor names no node"),
            Self::Pivot { node } => write!(f, "the pivot of node {node} is not positive definite"),
            Self::Entry { place } => {
                write!(f, "entry {place} of the factor is not a finite number")
            }
        }
    }
}

impl core::error::Error for FactorError {}

impl<'a> Factor<'a> {
    /// Takes the parts of a factor; `fingerprint` is that of the mesh
    /// ([`Header::fingerprint`](crate::rest::Header::fingerprint)). Meshes of up to 65,535 nodes.
    ///
    /// # Errors
    /// [`FactorError`]. What passes can be applied safely, and is positive definite.
    pub fn new(
        fingerprint: u64,
        order: &'a [u16],
        ends: &'a [u32],
        rows: &'a [u16],
        entries: Entries<'a>,
    ) -> Result<Self, FactorError> {
        let (pivots, lower) = match entries {
            Entries::Warped { pivots, lower } => (pivots.len(), lower.len()),
            Entries::WarpedHalf { pivots, lower } => (pivots.len(), lower.len()),
            Entries::Laplacian { pivots, lower } => (pivots.len(), lower.len()),
            Entries::LaplacianHalf { pivots, lower } => (pivots.len(), lower.len()),
        };
        let nodes = order.len();
        let last = ends.last().copied().unwrap_or(0);
        if ends.len() != nodes
            || pivots != nodes
            || lower != rows.len()
            || usize::try_from(last) != Ok(rows.len())
            || ends.iter().zip(ends.iter().skip(1)).any(|(a, b)| a > b)
        {
            return Err(FactorError::Shape);
        }
        for indices in [order, rows] {
            if let Some(place) = indices.iter().position(|&node| usize::from(node) >= nodes) {
                return Err(FactorError::Node { place });
            }
        }
        let (pivot, entry) = match entries {
            Entries::Warped { pivots, lower } => (bad_block(pivots), bad_entry(lower)),
            Entries::WarpedHalf { pivots, lower } => (bad_block(pivots), bad_entry(lower)),
            Entries::Laplacian { pivots, lower } => (bad_pivot(pivots), bad_entry(lower)),
            Entries::LaplacianHalf { pivots, lower } => (bad_pivot(pivots), bad_entry(lower)),
        };
        match (pivot, entry) {
            (Some(node), _) => Err(FactorError::Pivot { node }),
            (_, Some(place)) => Err(FactorError::Entry { place }),
            _ => Self::trusted(fingerprint, order, ends, rows, entries),
        }
    }

    /// Of parts that passed [`Self::new`] before. Of others it solves nonsense, within its bounds.
    pub(crate) fn trusted(
        fingerprint: u64,
        order: &'a [u16],
        ends: &'a [u32],
        rows: &'a [u16],
        entries: Entries<'a>,
    ) -> Result<Self, FactorError> {
        Ok(Self {
            fingerprint,
            order,
            ends,
            rows,
            entries,
        })
    }

    /// The fingerprint of the mesh that it was made for.
    #[must_use]
    pub const fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// Nodes of the mesh that it was made for.
    #[must_use]
    pub const fn nodes(&self) -> usize {
        self.order.len()
    }

    /// Whether it is of 3×3 blocks, to be turned with the body.
    #[must_use]
    pub const fn is_warped(&self) -> bool {
        matches!(
            self.entries,
            Entries::Warped { .. } | Entries::WarpedHalf { .. }
        )
    }

    /// Nodes in the order of elimination.
    #[must_use]
    pub const fn order(&self) -> &'a [u16] {
        self.order
    }

    /// Where each column ends.
    #[must_use]
    pub const fn ends(&self) -> &'a [u32] {
        self.ends
    }

    /// The node of every entry.
    #[must_use]
    pub const fn rows(&self) -> &'a [u16] {
        self.rows
    }

    /// Pivots and entries.
    #[must_use]
    pub const fn entries(&self) -> Entries<'a> {
        self.entries
    }

    /// Numbers in L below the diagonal.
    #[must_use]
    pub const fn scalars(&self) -> usize {
        self.rows.len() * if self.is_warped() { 9 } else { 1 }
    }

    /// Bytes of all parts.
    #[must_use]
    pub const fn bytes(&self) -> usize {
        let (pivot, entry) = match self.entries {
            Entries::Warped { .. } => (size_of::<Sym3<f32>>(), size_of::<[f32; 9]>()),
            Entries::WarpedHalf { .. } => (size_of::<Sym3<f32>>(), size_of::<[u16; 9]>()),
            Entries::Laplacian { .. } => (size_of::<f32>(), size_of::<f32>()),
            Entries::LaplacianHalf { .. } => (size_of::<f32>(), size_of::<u16>()),
        };
        self.order.len() * (size_of::<u16>() + size_of::<u32>() + pivot)
            + self.rows.len() * (size_of::<u16>() + entry)
    }

    /// z ← (L D Lᵀ)⁻¹ z, for one vector a node.
    #[inline]
    pub fn solve(&self, z: &mut [[f32; 3]]) {
        // L y = r
        let mut start = 0;
        for (&node, &end) in self.order.iter().zip(self.ends) {
            let column = start..end as usize;
            start = column.end;
            if let Some(&y) = z.get(usize::from(node)) {
                self.eliminate(column, &y, z);
            }
        }
        match self.entries {
            Entries::Warped { pivots, .. } | Entries::WarpedHalf { pivots, .. } => {
                for (z, pivot) in z.iter_mut().zip(pivots) {
                    *z = sym_mul(pivot, z);
                }
            }
            Entries::Laplacian { pivots, .. } | Entries::LaplacianHalf { pivots, .. } => {
                for (z, pivot) in z.iter_mut().zip(pivots) {
                    *z = z.map(|z| pivot * z);
                }
            }
        }
        // Lᵀ z = y, the columns from the last to the first
        let mut end = self.rows.len();
        for (place, &node) in self.order.iter().enumerate().rev() {
            let start = place
                .checked_sub(1)
                .and_then(|before| self.ends.get(before))
                .map_or(0, |&end| end as usize);
            let sum = self.product(start..end, z);
            end = start;
            if let Some(z) = z.get_mut(usize::from(node)) {
                *z = core::array::from_fn(|axis| z[axis] - sum[axis]);
            }
        }
    }

    /// z −= ℓ y for every entry ℓ of a column.
    #[inline(always)]
    fn eliminate(&self, column: Range<usize>, y: &[f32; 3], z: &mut [[f32; 3]]) {
        let rows = self.rows.get(column.clone()).unwrap_or_default();
        match self.entries {
            Entries::Warped { lower, .. } => eliminate(rows, lower.get(column), y, z),
            Entries::WarpedHalf { lower, .. } => eliminate(rows, lower.get(column), y, z),
            Entries::Laplacian { lower, .. } => eliminate(rows, lower.get(column), y, z),
            Entries::LaplacianHalf { lower, .. } => eliminate(rows, lower.get(column), y, z),
        }
    }

    /// Σ ℓᵀ z over the entries ℓ of a column.
    #[inline(always)]
    fn product(&self, column: Range<usize>, z: &[[f32; 3]]) -> [f32; 3] {
        let rows = self.rows.get(column.clone()).unwrap_or_default();
        match self.entries {
            Entries::Warped { lower, .. } => product(rows, lower.get(column), z),
            Entries::WarpedHalf { lower, .. } => product(rows, lower.get(column), z),
            Entries::Laplacian { lower, .. } => product(rows, lower.get(column), z),
            Entries::LaplacianHalf { lower, .. } => product(rows, lower.get(column), z),
        }
    }
}

#[inline(always)]
fn eliminate<E: Entry>(rows: &[u16], lower: Option<&[E]>, y: &[f32; 3], z: &mut [[f32; 3]]) {
    for (&row, entry) in rows.iter().zip(lower.unwrap_or_default()) {
        if let Some(z) = z.get_mut(usize::from(row)) {
            entry.eliminate(y, z);
        }
    }
}

#[inline(always)]
fn product<E: Entry>(rows: &[u16], lower: Option<&[E]>, z: &[[f32; 3]]) -> [f32; 3] {
    let mut sums = E::NOTHING;
    for (&row, entry) in rows.iter().zip(lower.unwrap_or_default()) {
        if let Some(z) = z.get(usize::from(row)) {
            entry.gather(z, &mut sums);
        }
    }
    E::total(&sums)
}

/// One entry ℓ of L.
trait Entry: Sized {
    /// Partial sums of a column's product with Lᵀ.
    type Sums;
    const NOTHING: Self::Sums;
    /// z −= ℓ y
    fn eliminate(&self, y: &[f32; 3], z: &mut [f32; 3]);
    /// Adds the products of ℓᵀ z to the sums.
    fn gather(&self, z: &[f32; 3], sums: &mut Self::Sums);
    /// Σ ℓᵀ z
    fn total(sums: &Self::Sums) -> [f32; 3];
    fn is_usable(&self) -> bool;
}

/// A number as it is stored.
trait Stored: Copy {
    fn value(self) -> f32;
    fn is_usable(self) -> bool;
}

impl Stored for f32 {
    #[inline(always)]
    fn value(self) -> f32 {
        self
    }
    fn is_usable(self) -> bool {
        self.is_finite()
    }
}

impl Stored for u16 {
    /// Exact: the bits in the place of f32's, and the difference of the exponents' offsets made good. Extending the
    /// sign brings it to its place.
    #[inline(always)]
    fn value(self) -> f32 {
        let bits = i32::from(self.cast_signed()).cast_unsigned();
        f32::from_bits((bits << 13) & 0x8fff_e000) * f32::from_bits(0x7780_0000) // 2¹¹²
    }
    fn is_usable(self) -> bool {
        let exponent = self & 0x7c00;
        exponent != 0x7c00 && (exponent != 0 || self & 0x03ff == 0)
    }
}

impl<S: Stored> Entry for S {
    type Sums = [f32; 3];
    const NOTHING: [f32; 3] = [0.0; 3];
    #[inline(always)]
    fn eliminate(&self, y: &[f32; 3], z: &mut [f32; 3]) {
        let l = self.value();
        for axis in 0..3 {
            z[axis] -= l * y[axis];
        }
    }
    #[inline(always)]
    fn gather(&self, z: &[f32; 3], sums: &mut [f32; 3]) {
        let l = self.value();
        for axis in 0..3 {
            sums[axis] += l * z[axis];
        }
    }
    #[inline(always)]
    fn total(sums: &[f32; 3]) -> [f32; 3] {
        *sums
    }
    fn is_usable(&self) -> bool {
        Stored::is_usable(*self)
    }
}

impl<S: Stored> Entry for [S; 9] {
    /// One sum for every element of the block, so that columns are independent of each other.
    type Sums = [f32; 9];
    const NOTHING: [f32; 9] = [0.0; 9];
    #[inline(always)]
    fn eliminate(&self, y: &[f32; 3], z: &mut [f32; 3]) {
        let l = self.map(S::value);
        for axis in 0..3 {
            z[axis] -= l[axis] * y[0] + l[3 + axis] * y[1] + l[6 + axis] * y[2];
        }
    }
    #[inline(always)]
    fn gather(&self, z: &[f32; 3], sums: &mut [f32; 9]) {
        let l = self.map(S::value);
        for k in 0..9 {
            sums[k] += l[k] * z[k % 3];
        }
    }
    #[inline(always)]
    fn total(sums: &[f32; 9]) -> [f32; 3] {
        core::array::from_fn(|c| sums[3 * c] + sums[3 * c + 1] + sums[3 * c + 2])
    }
    fn is_usable(&self) -> bool {
        self.iter().all(|l| l.is_usable())
    }
}

fn bad_entry<E: Entry>(lower: &[E]) -> Option<usize> {
    lower.iter().position(|entry| !entry.is_usable())
}

fn bad_pivot(pivots: &[f32]) -> Option<usize> {
    let good = |x: f32| x > 0.0 && x.is_finite();
    pivots.iter().position(|&pivot| !good(pivot))
}

/// Sylvester's criterion.
fn bad_block(pivots: &[Sym3<f32>]) -> Option<usize> {
    let good = |pivot: &Sym3<f32>| {
        let [xx, xy, xz, yy, yz, zz] = pivot.map(f64::from);
        let two = xx * yy - xy * xy;
        let three = two * zz - xx * yz * yz - yy * xz * xz + 2.0 * xy * xz * yz;
        pivot.iter().all(|x| x.is_finite()) && xx > 0.0 && two > 0.0 && three > 0.0
    };
    pivots.iter().position(|pivot| !good(pivot))
}

#[cfg(test)]
mod tests {
    use super::Stored;

    #[test]
    fn halves_are_read_exactly() {
        for (bits, value) in [
            (0x3c00_u16, 1.0),
            (0xc000, -2.0),
            (0x3555, 0.333_251_95),
            (0x7bff, 65504.0),
            (0x0400, 6.103_515_6e-5),
            (0x0000, 0.0),
            (0x8000, -0.0),
        ] {
            let read: f32 = bits.value();
            assert_eq!(read.to_bits(), f32::to_bits(value), "{bits:x}");
        }
    }
}
