//! What programs that measure femto share: the usual corotated pipeline, its matrix, and a clock.

pub mod baseline;
pub mod clock;
pub mod csr;
