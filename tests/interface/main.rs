//! What is refused, what an asset holds, what a step costs.

#[path = "../support/mod.rs"]
mod support;

mod asset;
mod cost;
mod errors;
