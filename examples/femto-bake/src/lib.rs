//! What [femto] needs of a host before a body can live in firmware: factors of rest matrices
//! ([`factor`]).

mod cholesky;
pub mod factor;
mod matrix;

pub use factor::{FactorOptions, HostFactorError, Kind, OwnedFactor, Precision, factor};
pub use matrix::RestStiffness;
