//! Every preconditioner and every kind of start. What the checks run, the cost table has, and the programs print.

use femto::{Preconditioner, Start};

/// All of them, by name.
pub const PRECONDITIONERS: [(&str, Preconditioner); 4] = [
    ("identity", Preconditioner::Identity),
    ("mass", Preconditioner::Mass),
    ("jacobi", Preconditioner::Jacobi),
    ("block-jacobi", Preconditioner::BlockJacobi),
];

/// All kinds, by name, with and without history.
pub const STARTS: [(&str, Start); 6] = [
    ("zero", Start::Zero),
    ("velocity", Start::Velocity),
    ("velocity-force", Start::VelocityForce),
    ("galerkin-1", Start::Galerkin(1)),
    ("galerkin-3", Start::Galerkin(3)),
    ("rigid-2", Start::Rigid(2)),
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
