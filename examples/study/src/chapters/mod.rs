//! The chapters of the report, one file each.

pub mod peers;
