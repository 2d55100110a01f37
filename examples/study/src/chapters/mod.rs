//! The chapters of the report, one file each.

pub mod paper;
pub mod parts;
pub mod peers;
pub mod spin;
