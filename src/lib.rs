//! front page to come
#![no_std]
#![deny(unsafe_code)]
#![warn(missing_docs)]

#[cfg(feature = "alloc")]
extern crate alloc;

pub use glam;

pub mod body;
mod cg;
pub mod collider;
pub mod constraint;
pub mod element;
pub mod energy;
pub mod lane;
pub mod material;
pub mod math;
pub mod mesh;
pub mod operator;
#[cfg(feature = "alloc")]
pub mod owned;
pub mod polar;
mod preconditioner;
pub mod rest;
pub mod settings;
pub mod step;
pub mod vector;
