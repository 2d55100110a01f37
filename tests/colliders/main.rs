//! Shapes against distances in f64 that are written another way; and bodies that meet them.

#[path = "../support/mod.rs"]
mod support;

mod contact;
mod friction;
mod oracle;
mod reactions;
mod shapes;
