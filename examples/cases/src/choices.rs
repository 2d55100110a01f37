//! Every preconditioner and every kind of start. What the checks run, the cost table has, and the programs print.

use femto::element::Layout;
use femto::preconditioner::aggregate::{Aggregates, DEFAULT_AGGREGATES, MAX_AGGREGATES};
use femto::preconditioner::coarse::coarse_length;
use femto::rest::Rest;
use femto::{Factor, Preconditioner, Start};

use crate::factor::{FactorRoom, Kind};

/// A preconditioner by what it needs.
#[derive(Clone, Copy, Debug)]
pub enum Choice {
    /// One that has all it needs.
    Local(Preconditioner<'static>),
    /// One with a factor, which the program holds.
    Factored(Kind),
    /// Two-level, with so many aggregates, which the program holds.
    TwoLevel(usize),
}

/// Why a step or a scene was not run: its own numbers are refused. A defect of this program.
#[derive(Clone, Copy, Debug)]
pub struct BadCase;

/// What a preconditioner refers to, for a body of up to `NODES` nodes.
#[derive(Debug)]
pub struct Held<'a, const NODES: usize> {
    factor: Option<Factor<'a>>,
    of: [u8; NODES],
}

impl<const NODES: usize> Held<'_, NODES> {
    /// Nothing yet.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            factor: None,
            of: [0; NODES],
        }
    }
}

impl<const NODES: usize> Default for Held<'_, NODES> {
    fn default() -> Self {
        Self::new()
    }
}

impl Choice {
    /// The preconditioner for a body; what it refers to is put in `held`.
    ///
    /// # Errors
    /// [`BadCase`].
    pub fn prepare<'a, L: Layout, const NODES: usize, const FILL: usize>(
        self,
        rest: &Rest<'_, L>,
        factors: &'a FactorRoom<NODES, FILL>,
        held: &'a mut Held<'a, NODES>,
    ) -> Result<Preconditioner<'a>, BadCase> {
        match self {
            Self::Local(preconditioner) => Ok(preconditioner),
            Self::Factored(kind) => {
                let made = factors.factor(kind, rest.header.fingerprint);
                let factor = held.factor.insert(made.map_err(|_| BadCase)?);
                Ok(Preconditioner::Factored(factor))
            }
            Self::TwoLevel(count) => {
                let of = held.of.get_mut(..rest.nodes.len()).ok_or(BadCase)?;
                let made = Aggregates::divide(rest, count, of).map_err(|_| BadCase)?;
                Ok(Preconditioner::TwoLevel(made))
            }
        }
    }
}

/// All of them, by name.
pub const PRECONDITIONERS: [(&str, Choice); 9] = [
    ("identity", Choice::Local(Preconditioner::Identity)),
    ("mass", Choice::Local(Preconditioner::Mass)),
    ("jacobi", Choice::Local(Preconditioner::Jacobi)),
    ("block-jacobi", Choice::Local(Preconditioner::BlockJacobi)),
    ("warped", Choice::Factored(Kind::Warped)),
    ("warped-half", Choice::Factored(Kind::WarpedHalf)),
    ("laplacian", Choice::Factored(Kind::Laplacian)),
    ("laplacian-half", Choice::Factored(Kind::LaplacianHalf)),
    ("two-level", Choice::TwoLevel(DEFAULT_AGGREGATES)),
];

/// More, which the cost table needs to tell its terms apart.
pub const MORE_PRECONDITIONERS: [(&str, Choice); 4] = [
    ("two-level", Choice::TwoLevel(1)),
    ("two-level", Choice::TwoLevel(3)),
    ("two-level", Choice::TwoLevel(12)),
    ("two-level", Choice::TwoLevel(MAX_AGGREGATES)),
];

/// Capacity for the coarse half of any of them.
pub const COARSE: usize = coarse_length(MAX_AGGREGATES);

/// The one of [`PRECONDITIONERS`] that is the default.
pub const JACOBI: (&str, Choice) = PRECONDITIONERS[2];

/// All kinds, by name, with and without history.
pub const STARTS: [(&str, Start); 6] = [
    ("zero", Start::Zero),
    ("velocity", Start::Velocity),
    ("velocity-force", Start::VelocityForce),
    ("galerkin-1", Start::Galerkin(1)),
    ("galerkin-3", Start::Galerkin(3)),
    ("rigid-2", Start::Rigid(2)),
];

/// Those between, which the cost table needs to tell its terms apart.
pub const MORE_STARTS: [(&str, Start); 2] = [
    ("galerkin-2", Start::Galerkin(2)),
    ("rigid-1", Start::Rigid(1)),
];

/// Capacity for the history of any of [`STARTS`].
pub const HISTORY: usize = CAPACITIES[0];
/// Capacity for the vectors of any of [`STARTS`].
pub const VECTORS: usize = CAPACITIES[1];

const fn largest_of(a: usize, b: usize) -> usize {
    if a > b { a } else { b }
}

const CAPACITIES: [usize; 2] = {
    let (mut history, mut vectors, mut k) = (0, 0, 0);
    while k < STARTS.len() {
        history = largest_of(history, STARTS[k].1.history());
        vectors = largest_of(vectors, STARTS[k].1.vectors());
        k += 1;
    }
    [history, vectors]
};
