//! Tetrahedra and meshes of them: stiffness, materials, rotations, surfaces, order; and the f64 oracle itself.

#[path = "../support/mod.rs"]
mod support;

mod elasticity;
mod materials;
mod order;
mod polar;
mod reference;
mod stiffness;
mod surface;
