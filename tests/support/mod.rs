//! What the integration tests share.

// Each test file compiles its own copy of this module and uses a part of it.
#![allow(dead_code)]

pub mod account;
pub mod factors;
pub mod ground;
pub mod meshes;
pub mod reference;
pub mod scenes;

/// Compares entry by entry, each with its own bound.
#[track_caller]
pub fn assert_within<'a>(
    found: impl IntoIterator<Item = &'a f64>,
    expected: impl IntoIterator<Item = &'a f64>,
    bound: impl IntoIterator<Item = &'a f64>,
) {
    for (k, ((found, expected), bound)) in found.into_iter().zip(expected).zip(bound).enumerate() {
        let error = (found - expected).abs();
        assert!(
            error <= *bound,
            "entry {k}: {found:e}, not {expected:e}; bound {bound:e}"
        );
    }
}
