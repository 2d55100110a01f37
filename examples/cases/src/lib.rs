//! What the checks of bits, cost and size have in common, on every target: a hosted one, WASM, or firmware.
//!
//! * [`mesh`]: small irregular meshes, computed at compile time;
//! * [`fans`]: the tetrahedra of some of them in the order that firmware gets them in;
//! * [`factor`]: made-up factors for the factored preconditioners;
//! * [`choices`]: every preconditioner and every start, by name. **A new one is added there, and only there**;
//! * [`scenes`]: the scenes whose bits are compared, and their golden hashes;
//! * [`states`] and [`cost`]: the states in which a step must cost the same, and steps to be counted.
#![no_std]

pub mod choices;
pub mod cost;
pub mod factor;
/// Tetrahedra in fans, by the name of their mesh; written by the build script.
#[rustfmt::skip]
pub mod fans {
    include!(concat!(env!("OUT_DIR"), "/fans.rs"));
}
/// Worlds of several bodies, by name; written by the build script.
#[cfg(feature = "contact")]
#[rustfmt::skip]
mod worlds {
    use super::cost::coupled::{Surface, World};
    use femto::glam::Vec3;
    use femto::rigid::Shape;
    include!(concat!(env!("OUT_DIR"), "/worlds.rs"));
}
pub mod mesh;
pub mod scenes;
pub mod states;
