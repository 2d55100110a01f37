//! Preconditioners: what the solver multiplies a residual with before it takes it for a direction.
//!
//! All are symmetric and positive semidefinite, with the filter P of pins and contact on both sides,
//! so that none can break the energy bound; a good one only needs fewer iterations:
//!
//! * *local* ones ([`Preconditioner::Identity`] to [`Preconditioner::BlockJacobi`]): one block a node, from
//!   the step's own matrix; the choice between them costs nothing in the iteration;
//! * *factored* ones ([`factor`]): the rest matrix, factored once on a host, turned with the body.

pub mod factor;
mod local;
mod warp;

pub use factor::Factor;

use crate::element::{Layout, Sym3};
use crate::lane::Lanes;
use crate::operator::RotationBlock;
use crate::rest::Rest;
use crate::vector::{multiply_blocks, sym_mul};
use local::Local;

/// What approximates A⁻¹.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Preconditioner<'a> {
    /// The identity.
    Identity,
    /// The inverse of the lumped mass (and of what damps and rubs at the node).
    Mass,
    /// The inverse of A's diagonal.
    #[default]
    Jacobi,
    /// The inverse of A's 3×3 diagonal blocks.
    BlockJacobi,
    /// A factor of the rest matrix: *warped* where it is of 3×3 blocks, *Laplacian* where it is of numbers.
    Factored(&'a Factor<'a>),
}

impl Preconditioner<'_> {
    fn local(self) -> Option<Local> {
        match self {
            Self::Identity => Some(Local::Identity),
            Self::Mass => Some(Local::Mass),
            Self::Jacobi => Some(Local::Jacobi),
            Self::BlockJacobi => Some(Local::BlockJacobi),
            Self::Factored(_) => None,
        }
    }

    /// Whether [`Self::prepare`] reads the diagonal blocks of A.
    pub(crate) fn needs_blocks(self) -> bool {
        matches!(self, Self::BlockJacobi)
    }

    /// Whether it reads the diagonal of A.
    pub(crate) fn needs_diagonal(self) -> bool {
        matches!(self, Self::Jacobi)
    }

    /// Writes what [`Prepared::apply`] needs of this step over the diagonal blocks of A.
    pub(crate) fn prepare<R: Lanes, L: Layout>(
        self,
        rest: &Rest<'_, L>,
        rotations: &[RotationBlock],
        inertia: &[f32],
        filter: &[Sym3<f32>],
        blocks: &mut [Sym3<f32>],
    ) {
        match self {
            Self::Factored(factor) => {
                if factor.is_warped() {
                    warp::average_rotations::<R, L>(rest, rotations, blocks);
                }
            }
            _ => {
                if let Some(local) = self.local() {
                    local.prepare(inertia, filter, blocks);
                }
            }
        }
    }
}

/// A preconditioner, ready for this step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Prepared<'a> {
    pub preconditioner: Preconditioner<'a>,
    pub filter: &'a [Sym3<f32>],
    /// P B P of a local one, the rows of the nodes' rotations of a warped one.
    pub blocks: &'a [Sym3<f32>],
}

impl Prepared<'_> {
    /// `z` = P B P r
    pub fn apply(&self, r: &[[f32; 3]], z: &mut [[f32; 3]]) {
        match self.preconditioner {
            Preconditioner::Factored(factor) if factor.is_warped() => {
                for (((z, r), p), rows) in z.iter_mut().zip(r).zip(self.filter).zip(self.blocks) {
                    *z = warp::unturn(rows, &sym_mul(p, r));
                }
                factor.solve(z);
                for ((z, p), rows) in z.iter_mut().zip(self.filter).zip(self.blocks) {
                    *z = sym_mul(p, &warp::turn(rows, z));
                }
            }
            Preconditioner::Factored(factor) => {
                multiply_blocks(z, self.filter, r);
                factor.solve(z);
                for (z, p) in z.iter_mut().zip(self.filter) {
                    *z = sym_mul(p, z);
                }
            }
            _ => multiply_blocks(z, self.blocks, r),
        }
    }

    /// Whether an application costs little beside one of A.
    pub fn is_cheap(&self) -> bool {
        !matches!(self.preconditioner, Preconditioner::Factored(_))
    }
}
