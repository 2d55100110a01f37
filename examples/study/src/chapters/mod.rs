//! The chapters of the report, one file each.

pub mod budget;
pub mod closed;
pub mod hard;
pub mod models;
pub mod paper;
pub mod parts;
pub mod peers;
pub mod relative;
pub mod spin;
