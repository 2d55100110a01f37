//! What every state and report must satisfy, and their bits.

use femto::state::StateRef;
use femto::{Settings, StepReport};

use super::polar;

/// Finite; rotations are rotations, and what has broken is whole or not.
pub fn check_state(state: &StateRef<'_>) {
    let vectors = state.x.iter().chain(state.v).chain(state.history);
    assert!(vectors.flatten().all(|x| x.is_finite()), "{state:?}");
    for block in state.rotations {
        for lane in 0..block.0[0].len() {
            polar::check_unit(block.0.map(|x| x[lane]));
        }
    }
    let strain = state.plastic.iter().flat_map(|block| block.0).flatten();
    assert!(strain.into_iter().all(|x| x.is_finite()), "{state:?}");
    let flags = state.broken.iter().flat_map(|block| block.0);
    assert!(flags.into_iter().all(|x| x == 0.0 || x == 1.0), "{state:?}");
}

/// Accepted and finite, or refused and untouched.
pub fn check_step(
    before: &StateRef<'_>,
    after: &StateRef<'_>,
    report: &StepReport,
    settings: &Settings,
) {
    if let Some(refusal) = report.refusal {
        assert!(!refusal.to_string().is_empty());
        assert_eq!(
            bits(before),
            bits(after),
            "a refused step must leave the state as it was"
        );
        return;
    }
    check_state(after);
    let numbers = [
        report.rhs,
        report.residual_before,
        report.residual_after,
        report.dissipated,
    ];
    let finite = numbers.iter().all(|x| x.is_finite());
    assert!(finite && !report.relative_residual().is_nan(), "{report:?}");
    // One more where there are colliders.
    let most = settings.budget.iterations.saturating_add(1);
    assert!(report.updates <= most, "{report:?}");
    check_plasticity(after, report, settings);
    check_fracture(before, after, report, settings);
}

/// Flow takes energy, and ends at its limit.
fn check_plasticity(after: &StateRef<'_>, report: &StepReport, settings: &Settings) {
    assert!(report.dissipated >= 0.0, "{report:?}");
    let Some(law) = settings.plasticity else {
        return assert_eq!(report.dissipated, 0.0, "{report:?}");
    };
    for block in after.plastic {
        for lane in 0..block.0[0].len() {
            let [xx, xy, xz, yy, yz, zz] = block.0.map(|x| f64::from(x[lane]));
            let square = xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + xz * xz + yz * yz);
            // A root, a quotient and a product after nine roundings of the square.
            let limit = f64::from(law.limit()) * (1.0 + 8.0 * f64::from(f32::EPSILON));
            let tiny = f64::from(f32::MIN_POSITIVE);
            assert!(square.sqrt() <= limit + tiny, "{law:?} {block:?}");
        }
    }
}

/// What has broken stays so; no more breaks than a step and the reserve allow, and the report says how many.
fn check_fracture(
    before: &StateRef<'_>,
    after: &StateRef<'_>,
    report: &StepReport,
    settings: &Settings,
) {
    let fracture = report.fracture;
    let broken = |state: &StateRef<'_>| {
        let flags = state.broken.iter().flat_map(|block| block.0);
        flags.into_iter().map(|x| x > 0.5).collect::<Vec<_>>()
    };
    let (before, after) = (broken(before), broken(after));
    let healed = before.iter().zip(&after).any(|(was, is)| *was && !is);
    assert!(!healed, "{report:?}");
    let count = |flags: &[bool]| flags.iter().filter(|x| **x).count() as u32;
    let (before, after) = (count(&before), count(&after));
    assert_eq!(after - before, fracture.broken, "{report:?}");
    let Some(law) = settings.fracture else {
        return assert_eq!(fracture, Default::default());
    };
    assert!(fracture.broken <= law.per_step(), "{report:?}");
    assert!(fracture.broken == 0 || after <= law.reserve(), "{report:?}");
    assert_eq!(fracture.left, law.reserve().saturating_sub(after));
}

/// Every bit of a state.
pub fn bits(state: &StateRef<'_>) -> Vec<u32> {
    let vectors = state.x.iter().chain(state.v).chain(state.history).flatten();
    let rotations = state
        .rotations
        .iter()
        .flat_map(|block| block.0.as_flattened());
    let plastic = state.plastic.iter().flat_map(|b| b.0.as_flattened());
    let broken = state.broken.iter().flat_map(|block| &block.0);
    let numbers = vectors.chain(rotations).chain(plastic).chain(broken);
    numbers.map(|x| x.to_bits()).collect()
}

/// A report that equals itself; the payload of a NaN is the machine's.
pub fn report_bits(report: &StepReport) -> impl PartialEq + std::fmt::Debug + use<> {
    let bits = |x: f32| if x.is_nan() { u32::MAX } else { x.to_bits() };
    let numbers = [
        report.rhs,
        report.residual_before,
        report.residual_after,
        report.dissipated,
    ];
    let counts = [
        report.updates,
        report.contacts,
        report.couplings,
        report.dropped,
    ];
    (report.refusal, numbers.map(bits), counts, report.fracture)
}
