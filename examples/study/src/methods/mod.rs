//! The methods, one file each.

pub mod direct;
pub mod explicit;
pub mod forces;
pub mod ours;
pub mod pipeline;
pub mod projective;
pub mod rapier;
pub mod xpbd;
