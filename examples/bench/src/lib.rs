//! What programs that measure femto share: the usual corotated pipeline, its matrix, a clock, and meshes from files.

pub mod baseline;
pub mod clock;
pub mod csr;
pub mod mesh_file;
