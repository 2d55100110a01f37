//! Bodies in motion: momentum, energy, paths, contact, loads; what yields and what breaks.

#[path = "../support/mod.rs"]
mod support;

mod arrays;
mod contact;
mod energy;
mod fracture;
mod load;
mod momentum;
mod motion;
mod plasticity;
mod trajectory;
