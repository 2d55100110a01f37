use super::Table;

pub(super) const CORTEX_M4F: Table = [[0; 4]; 43];
pub(super) const X86_64: Table = [[0; 4]; 43];
pub(super) const AARCH64: Table = [[0; 4]; 43];
