//! Preconditioners: what the solver multiplies a residual with before it takes it for a direction.
//!
//! All are symmetric and positive semidefinite, with the filter P of pins and contact on both sides,
//! so that none can break the energy bound; a good one only needs fewer iterations:
//!
//! * *local* ones ([`Preconditioner::Identity`] to [`Preconditioner::BlockJacobi`]): one block a node, from
//!   the step's own matrix; the choice between them costs nothing in the iteration;
//! * *factored* ones ([`factor`]): the rest matrix, factored once on a host, turned with the body;
//! * *two-level* ([`coarse`]): block Jacobi, and a solve in the rigid motions of a few aggregates, made anew in
//!   each step: where no host can prepare anything, where topology or material changes, and for large meshes.

pub mod aggregate;
pub mod coarse;
pub mod factor;
pub mod fold;
mod local;
mod warp;

pub use aggregate::Aggregates;
pub use factor::Factor;

use crate::element::{Layout, Sym3};
use crate::lane::Lanes;
use crate::operator::{Operator, RotationBlock};
use crate::vector::{multiply_blocks, multiply_in_place};
use coarse::Coarse;
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
    /// Two-level: block Jacobi, and a solve in the rigid motions of aggregates ([`coarse`]).
    TwoLevel(Aggregates<'a>),
}

impl<'a> Preconditioner<'a> {
    fn local(self) -> Option<Local> {
        match self {
            Self::Identity => Some(Local::Identity),
            Self::Mass => Some(Local::Mass),
            Self::Jacobi => Some(Local::Jacobi),
            Self::BlockJacobi | Self::TwoLevel(_) => Some(Local::BlockJacobi),
            Self::Factored(_) => None,
        }
    }

    /// Whether [`Self::prepare`] reads the diagonal blocks of A.
    pub(crate) fn needs_blocks(self) -> bool {
        matches!(self, Self::BlockJacobi | Self::TwoLevel(_))
    }

    /// Whether it reads the diagonal of A.
    pub(crate) fn needs_diagonal(self) -> bool {
        matches!(self, Self::Jacobi)
    }

    /// Numbers of coarse workspace that it needs: the capacity `COARSE`.
    #[must_use]
    pub const fn coarse_length(&self) -> usize {
        match self {
            Self::TwoLevel(aggregates) => coarse::coarse_length(aggregates.count()),
            _ => 0,
        }
    }

    /// Makes it ready for a step at `x` (metres) with the matrix A = `operator`, and with P: pins alone, or, if so said, any
    /// that may also change until it is applied. `scratch` is one vector a node.
    pub fn prepare<R: Lanes, L: Layout>(
        self,
        operator: &Operator<'_, L>,
        x: &'a [[f32; 3]],
        rotations: &[RotationBlock],
        (filter, touches): (&[Sym3<f32>], bool),
        room: Room<'a>,
        scratch: &mut [[f32; 3]],
    ) -> Prepared<'a> {
        let Room { blocks, coarse } = room;
        let coarse = match self {
            Self::TwoLevel(aggregates) if cfg!(feature = "two-level") => Some(Coarse::new::<R, L>(
                aggregates, operator, x, filter, blocks, scratch, coarse,
            )),
            _ => None,
        };
        match self {
            Self::Factored(factor) => {
                if cfg!(feature = "factored") && factor.is_warped() {
                    warp::average_rotations::<R, L>(&operator.rest, rotations, blocks);
                }
            }
            _ => {
                if let Some(local) = self.local() {
                    local.prepare(operator.inertia, filter, touches, blocks);
                }
            }
        }
        Prepared {
            preconditioner: self,
            touches,
            blocks,
            coarse,
        }
    }
}

/// Where [`Preconditioner::prepare`] puts what a step's iterations read.
#[derive(Debug)]
pub struct Room<'a> {
    /// The diagonal blocks of A; overwritten.
    pub blocks: &'a mut [Sym3<f32>],
    /// [`Preconditioner::coarse_length`] numbers.
    pub coarse: &'a mut [f32],
}

/// A preconditioner, ready for this step.
#[derive(Clone, Copy, Debug)]
pub struct Prepared<'a> {
    preconditioner: Preconditioner<'a>,
    /// Whether P may change.
    touches: bool,
    /// P B P of a local one (B where contacts may let go), the rows of the nodes' rotations of a warped one.
    blocks: &'a [Sym3<f32>],
    coarse: Option<Coarse<'a>>,
}

impl Prepared<'_> {
    /// `z` = P B P r. Inlined, so that firmware whose choice is a constant links no other.
    #[inline(always)]
    pub fn apply(&self, filter: &[Sym3<f32>], r: &[[f32; 3]], z: &mut [[f32; 3]]) {
        match self.preconditioner {
            Preconditioner::Factored(factor) if cfg!(feature = "factored") => {
                solve(factor, filter, self.blocks, r, z);
            }
            _ if self.touches => {
                multiply_blocks(z, filter, r);
                multiply_in_place(z, self.blocks);
                multiply_in_place(z, filter);
            }
            _ => multiply_blocks(z, self.blocks, r),
        }
        if let Some(coarse) = &self.coarse
            && cfg!(feature = "two-level")
        {
            coarse.add(filter, r, z);
        }
    }

    /// Whether an application costs little beside one of A (two-level: a half at most, from 3 k tetrahedra on).
    pub(crate) fn is_cheap(&self) -> bool {
        !matches!(self.preconditioner, Preconditioner::Factored(_))
    }
}

/// `z` = P R (L D Lᵀ)⁻¹ Rᵀ P r, where R are the nodes' rotations of a warped factor, else 1.
#[inline]
fn solve(
    factor: &Factor<'_>,
    filter: &[Sym3<f32>],
    rotations: &[Sym3<f32>],
    r: &[[f32; 3]],
    z: &mut [[f32; 3]],
) {
    let rotations = if factor.is_warped() { rotations } else { &[] };
    multiply_blocks(z, filter, r);
    for (z, rows) in z.iter_mut().zip(rotations) {
        *z = warp::unturn(rows, z);
    }
    factor.solve(z);
    for (z, rows) in z.iter_mut().zip(rotations) {
        *z = warp::turn(rows, z);
    }
    multiply_in_place(z, filter);
}
