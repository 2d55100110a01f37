//! What the integration tests share.

// Each test file compiles its own copy of this module and uses a part of it.
#![allow(dead_code)]

pub mod meshes;
pub mod reference;
pub mod scenes;
