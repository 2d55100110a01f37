//! What the fuzz targets check, as plain functions of bytes that panic where something is wrong.

pub mod asset;
mod bytes;
pub mod coupled;
mod guard;
mod inputs;
pub mod mesh;
pub mod parts;
pub mod polar;
mod scene;
mod settings;
mod state;
pub mod step;
mod world;
