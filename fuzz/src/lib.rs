//! What the fuzz targets check, as plain functions of bytes that panic where something is wrong.

pub mod asset;
mod bytes;
mod inputs;
pub mod mesh;
pub mod polar;
pub mod step;
