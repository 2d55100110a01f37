//! Conjugate gradients and what preconditions them.

#[path = "../support/mod.rs"]
mod support;

mod cg;
mod factor;
mod solve_error;
mod two_level;
mod two_level_runs;
mod warp;
