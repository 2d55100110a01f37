//! Polar decomposition: what the sweeps give is a rotation for every F, no sweep lowers tr(QᵀF), a
//! cold start reaches the nearest rotation also past saddles, sweeps converge as fast as measured
//! before the crate was written, and ten million warm starts do not drift.
//!
//! The oracle's rotation comes from an SVD. Q is compared where it is well determined; everywhere
//! tr(QᵀF) is, the quantity that the nearest rotation maximises. With singular values s₁ ≥ s₂ ≥ s₃,
//! s₃ negative where F is inverted, the greatest trace is s₁ + s₂ + s₃, and
//!
//! ```text
//! tr(QᵀF) falls by ½ ω·(tr(S) I − S) ω when Q turns by a small ω: by ½ (s₂ + s₃) |ω|² at least
//! ```
//!
//! so `gap` = s₂ + s₃ says how well Q is determined, and κ = (s₁ + s₂)/(s₂ + s₃) how unevenly.

use crate::support::meshes::Lcg;
use crate::support::reference::nearest_rotation;
use femto::polar;
use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use proptest::prelude::*;

const EPS: f64 = f32::EPSILON as f64;

/// | |q|² − 1 |: four squares and three sums 2 ε, halved by the root; root, reciprocal and product
/// ½ ε each: 5/2 ε a component, twice that squared.
const UNIT: f64 = 5.0 * EPS;

/// ‖QᵀQ − I‖ and |det Q − 1|. QᵀQ = I − 4V²δ with δ = |q|² − 1, V = [xyz]×, ‖V²‖ ≤ √2; and every
/// entry of Q carries 5/2 ε of its own (two products and two sums of at most 1 and 2), ‖ΔQ‖ ≤ 15/2 ε.
const ROTATION: f64 = 4.0 * std::f64::consts::SQRT_2 * UNIT + 15.0 * EPS;

/// An entry of B = QᵀF: 5/2 ε from Q, ½ ε from the scaling of F, and 3/2 ε from the product, over
/// √3 since a row of |Q| is that long at most; times ‖F‖.
const ENTRY: f64 = 8.0 * EPS;

/// How much a sweep may lower tr(QᵀF)/‖F‖. A pair takes the best (c, s) for its a and d, which are
/// two entries each: what is truly the best is at most 2 √2 · 2 ENTRY away, three times; and turning
/// q rounds as much again as B.
const FALL: f64 = 3.0 * (2.0 * std::f64::consts::SQRT_2 * 2.0 * ENTRY + ENTRY);

/// ‖Q − Q*‖ gap/‖F‖ at a fixed point: (tr(S) I − S) ω = axial(ΔB), ‖Q − Q*‖ = √2 |ω|.
const TURN: f64 = 2.0 * ENTRY;

fn narrowed(f: &Matrix3<f64>) -> [[f32; 3]; 3] {
    core::array::from_fn(|i| core::array::from_fn(|j| f[(i, j)] as f32))
}

fn matrix<T: Copy + Into<f64>>(f: &[[T; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| f[i][j].into())
}

fn rows(f: &Matrix3<f64>) -> [[f64; 3]; 3] {
    core::array::from_fn(|i| core::array::from_fn(|j| f[(i, j)]))
}

/// The rotation that a quaternion stands for, without the rounding of its length.
fn turn<T: Copy + Into<f64>>(q: &[T; 4]) -> Matrix3<f64> {
    let [w, x, y, z] = q.map(Into::into);
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
        .to_rotation_matrix()
        .into_inner()
}

fn quaternion(r: &Rotation3<f64>) -> [f64; 4] {
    let q = UnitQuaternion::from_rotation_matrix(r);
    [q.w, q.i, q.j, q.k]
}

/// tr(QᵀF)/‖F‖ for an F that may be as small as f32 holds.
fn trace(q: &Matrix3<f64>, f: &Matrix3<f64>) -> f64 {
    q.dot(f) / f.norm()
}

/// s₁ ≥ s₂ ≥ |s₃|, s₃ with the sign of det F, over ‖F‖.
fn stretches(f: &Matrix3<f64>) -> [f64; 3] {
    let f = f / f.norm();
    let mut s: [f64; 3] = f.singular_values().into();
    s.sort_by(|a, b| b.total_cmp(a));
    [s[0], s[1], s[2].copysign(f.determinant())]
}

fn gap(f: &Matrix3<f64>) -> f64 {
    let [_, s2, s3] = stretches(f);
    s2 + s3
}

/// The greatest |B_ij − B_ji| of B = QᵀF.
fn asymmetry(b: &[[f64; 3]; 3]) -> f64 {
    [(0, 1), (0, 2), (1, 2)]
        .iter()
        .map(|&(i, j)| (b[i][j] - b[j][i]).abs())
        .fold(0.0, f64::max)
}

fn assert_rotation(q: &[f32; 4]) -> Result<(), TestCaseError> {
    let square = q.iter().map(|&c| f64::from(c).powi(2)).sum::<f64>();
    prop_assert!(
        (square - 1.0).abs() <= UNIT,
        "|q|² − 1 = {:e}",
        square - 1.0
    );
    let m = matrix(&polar::matrix(q));
    let error = (m.transpose() * m - Matrix3::identity()).norm();
    prop_assert!(error <= ROTATION, "QᵀQ − I = {error:e}");
    prop_assert!(
        (m.determinant() - 1.0).abs() <= ROTATION,
        "det Q = {}",
        m.determinant()
    );
    Ok(())
}

/// Rotations by uniformly spread angles.
fn any_rotation() -> impl Strategy<Value = Rotation3<f64>> {
    let axis = prop::array::uniform3(-1.0..1.0_f64).prop_map(Vector3::from);
    (
        axis.prop_filter("a direction", |a| a.norm() > 0.1),
        -3.2..3.2_f64,
    )
        .prop_map(|(axis, angle)| Rotation3::new(axis.normalize() * angle))
}

/// Principal stretches from the kind ones to every sort of trouble.
fn any_stretches() -> impl Strategy<Value = Vector3<f64>> {
    let kind = prop::array::uniform3(0.1..2.0_f64).prop_map(Vector3::from);
    let small = (-6.0..0.0_f64).prop_map(|e| 10_f64.powf(e));
    (kind, small, 0..10_usize).prop_map(|(s, small, kind)| match kind {
        0 => s,
        1 => Vector3::new(s.x, s.y, -s.z), // inverted
        2 => -s,                           // through a point
        3 => Vector3::new(s.x, s.y, 0.0),  // flat
        4 => Vector3::new(s.x, 0.0, 0.0),  // a line: rank one
        5 => Vector3::new(s.x, s.y, small * (s.z - 1.0)), // a sliver, either way out
        6 => Vector3::new(s.x, small, small * s.z), // a needle
        7 => Vector3::new(s.x, small, small * (s.z - 1.0)), // a needle, either way out
        8 => Vector3::new(s.x, s.y, -s.y * (1.0 + small)), // near a tie
        _ => Vector3::repeat(s.x),
    })
}

/// F = U diag(s) Vᵀ, or symmetric: then Q = I is a fixed point, and a saddle where two of the
/// eigenvalues have a negative sum.
fn any_matrix() -> impl Strategy<Value = Matrix3<f64>> {
    (
        any_stretches(),
        any_rotation(),
        any_rotation(),
        any::<bool>(),
    )
        .prop_map(|(s, u, v, symmetric)| {
            let v = if symmetric { u } else { v };
            u * Matrix3::from_diagonal(&s) * v.transpose()
        })
}

/// From 1e−35 to 1e37.
fn any_size() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(1.0),
        Just(1e-34),
        Just(1e37),
        (-34.0..37.0_f64).prop_map(|e| 10_f64.powf(e))
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn every_matrix_gives_a_rotation(
        f in any_matrix(), size in any_size(), start in any_rotation(), sweeps in 0..5_u32,
    ) {
        let q = quaternion(&start).map(|c| c as f32);
        for f in [narrowed(&(f * size)), [[0.0; 3]; 3]] {
            assert_rotation(&polar::sweeps(&q, &f, sweeps))?;
            assert_rotation(&polar::nearest_rotation(&f))?;
        }
    }

    /// Edges of finite length times finite gradients can overflow.
    #[test]
    fn an_infinite_matrix_gives_a_rotation(start in any_rotation(), entries in prop::array::uniform9(0..4_usize)) {
        let entries = entries.map(|kind| [0.0, 1.0, f32::INFINITY, f32::NEG_INFINITY][kind]);
        let f = core::array::from_fn(|i| core::array::from_fn(|j| entries[3 * i + j]));
        assert_rotation(&polar::sweeps(&quaternion(&start).map(|c| c as f32), &f, 2))?;
        assert_rotation(&polar::nearest_rotation(&f))?;
    }

    #[test]
    fn no_sweep_lowers_the_trace(f in any_matrix(), size in any_size(), start in any_rotation()) {
        let narrow = narrowed(&(f * size));
        let f = matrix(&narrow);
        let mut q = quaternion(&start).map(|c| c as f32);
        let mut before = trace(&turn(&q), &f);
        for _ in 0..6 {
            q = polar::sweeps(&q, &narrow, 1);
            let after = trace(&turn(&q), &f);
            prop_assert!(after >= before - FALL, "from {before} to {after}");
            before = after;
        }
    }

    /// A zero F turns nothing.
    #[test]
    fn nothing_keeps_the_rotation(start in any_rotation(), sweeps in 0..20_u32) {
        let q = polar::sweeps(&quaternion(&start).map(|c| c as f32), &[[0.0; 3]; 3], sweeps);
        // Three doublings are exact; the division by the length rounds as in UNIT, once a sweep.
        let error = (turn(&q) - start.matrix()).norm();
        prop_assert!(error <= f64::from(sweeps + 1) * UNIT, "{error:e}");
    }
}

/// From cold, tr(QᵀF) is that of the oracle, and Q is, where it is determined.
fn check_nearest(narrow: &[[f32; 3]; 3]) -> Result<(), TestCaseError> {
    let f = matrix(narrow);
    let (q, best) = (turn(&polar::nearest_rotation(narrow)), nearest_rotation(&f));
    let deficit = trace(&best, &f) - trace(&q, &f);
    prop_assert!(
        deficit.abs() <= FALL,
        "tr(QᵀF) {deficit:e} ‖F‖ below the best"
    );
    let error = (q - best).norm();
    let gap = gap(&f);
    // Where rounding would turn Q by more than this, it is a tie.
    if gap > 100.0 * TURN {
        prop_assert!(
            error <= TURN / gap,
            "Q is off by {error:e}, {} of what rounding does",
            error * gap / TURN
        );
    }
    Ok(())
}

/// Symmetric, with two eigenvalues of negative sum, in any frame: sweeps leave Q = I as it is, but for
/// rounding.
fn saddle() -> impl Strategy<Value = Matrix3<f64>> {
    let eigenvalues = (0.5..2.0_f64, -0.5..-0.2_f64, -0.5..0.1_f64);
    (any_rotation(), eigenvalues).prop_map(|(u, (a, b, c))| {
        u * Matrix3::from_diagonal(&Vector3::new(a, b, c)) * u.transpose()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10_000))]

    #[test]
    fn cold_starts_reach_the_nearest_rotation(f in any_matrix(), size in any_size()) {
        check_nearest(&narrowed(&(f * size)))?;
    }

    #[test]
    fn cold_starts_leave_saddles(f in saddle()) {
        check_nearest(&narrowed(&f))?;
    }

    /// As energies have it. (The SVD finds directions to ε s₁/s₂ only, so that it may be the lesser.)
    #[test]
    fn cold_starts_in_f64_do_too(f in any_matrix()) {
        let (q, best) = (turn(&polar::nearest_rotation(&rows(&f))), nearest_rotation(&f));
        let deficit = trace(&best, &f) - trace(&q, &f);
        prop_assert!(deficit <= FALL * f64::EPSILON / EPS, "{deficit:e}");
    }
}

/// Q = I stays at trace 1.5; the best is 3.1.
#[test]
fn the_known_saddle() {
    let saddle = [[0.5, 0.9, 0.9], [0.9, 0.5, 0.9], [0.9, 0.9, 0.5_f32]];
    let f = matrix(&saddle);
    let stuck = polar::sweeps(&polar::identity(), &saddle, 100);
    assert!((turn(&stuck).dot(&f) - 1.5).abs() < FALL * f.norm());
    let left = polar::nearest_rotation(&saddle);
    assert!((turn(&left).dot(&f) - 3.1).abs() < FALL * f.norm());
    check_nearest(&saddle).unwrap();
}

/// A half turn about an axis of a pair, or nearly: one sweep takes it back.
#[test]
fn half_turns_are_undone() {
    let stretch = Vector3::new(1.0, 0.8, 0.6);
    let f = Matrix3::from_diagonal(&stretch);
    for axis in 0..3 {
        for off in [0.0, 1e-8, -1e-7, 1e-6, -1e-5, 1e-4, -1e-3] {
            let half = Vector3::ith(axis, std::f64::consts::PI + off);
            let start = quaternion(&Rotation3::new(half)).map(|c| c as f32);
            let q = polar::sweeps(&start, &narrowed(&f), 1);
            let missing = stretch.sum() / f.norm() - trace(&turn(&q), &f);
            assert!(missing <= FALL, "axis {axis}, {off:e}: {missing:e}");
        }
    }
}

fn normal(random: &mut Lcg) -> f64 {
    (0..12).map(|_| random.signed()).sum::<f64>() / 2.0 // a sum of twelve uniforms has variance 4
}

fn direction(random: &mut Lcg) -> Vector3<f64> {
    Vector3::from_fn(|_, _| normal(random)).normalize()
}

/// A symmetric stretch with principal stretches of 0.5 to 2, in a random frame.
fn random_stretch(random: &mut Lcg) -> Matrix3<f64> {
    let u = UnitQuaternion::from_quaternion(Quaternion::new(
        normal(random),
        normal(random),
        normal(random),
        normal(random),
    ))
    .to_rotation_matrix();
    let stretches = Vector3::from_fn(|_, _| 2_f64.powf(random.signed()));
    u * Matrix3::from_diagonal(&stretches) * u.transpose()
}

/// Median and worst asymmetry of 20,000 random elements after 0 to 4 sweeps, in f64, as measured
/// with other random numbers before the crate was written.
const WARM: [[f64; 2]; 5] = [
    [3.5e-2, 7.5e-2],
    [1.9e-3, 1.3e-2],
    [4.1e-5, 3.0e-3],
    [5.7e-7, 5.6e-4],
    [7e-9, 1.2e-4],
];
const COLD: [[f64; 2]; 5] = [
    [1.2, 3.6],
    [0.28, 3.8],
    [4.8e-3, 1.5],
    [6.9e-5, 0.53],
    [9e-7, 0.1],
];
/// The tables do not say how stretches and axes were drawn. Another spread changes the rate of
/// convergence, which enters to the power of the sweeps.
const SAME: f64 = 1.25;

#[test]
fn sweeps_converge_as_measured() {
    for (warm, table) in [(true, WARM), (false, COLD)] {
        let mut random = Lcg(1);
        let mut columns = vec![Vec::new(); table.len()];
        for _ in 0..20_000 {
            let angle = std::f64::consts::PI * random.signed();
            let r = Rotation3::new(direction(&mut random) * angle);
            let f = rows(&(r * random_stretch(&mut random)));
            let off = Rotation3::new(direction(&mut random) * 0.02);
            let start = if warm {
                quaternion(&(r * off))
            } else {
                polar::identity()
            };
            for (sweeps, column) in (0..).zip(&mut columns) {
                column.push(asymmetry(&polar::unrotated(
                    &polar::sweeps(&start, &f, sweeps),
                    &f,
                )));
            }
        }
        for (sweeps, (column, expected)) in columns.iter_mut().zip(table).enumerate() {
            column.sort_by(f64::total_cmp);
            let found = [column[column.len() / 2], column[column.len() - 1]];
            let [median, most] = found;
            println!("warm {warm}, {sweeps} sweeps: {median:.1e}, {most:.1e}");
            let factor = SAME.powi(sweeps as i32 + 1);
            for (found, expected) in found.into_iter().zip(expected) {
                assert!(
                    found < factor * expected && expected < factor * found,
                    "{found:e}, not {expected:e}"
                );
            }
        }
    }
}

/// Warm starts of the drift test, a sweep each.
const STEPS: u32 = 10_000_000;
/// Radians a step at most.
const STEP: f64 = 0.02;

/// An element that turns by up to 0.02 rad a step about a wandering axis while its stretch wanders
/// too. A step adds at most `STEP` (s_i + s_j) ≤ 4 `STEP` of asymmetry, a sweep leaves a quarter at most (the
/// table above: 0.17 to 0.21), so it stays below 4 `STEP` (¼ + 1/16 + …) = 4/3 `STEP`.
#[test]
fn ten_million_warm_starts_do_not_drift() {
    let mut random = Lcg(3);
    let (from, to) = (random_stretch(&mut random), random_stretch(&mut random));
    let mut r = UnitQuaternion::identity();
    let mut rate = Vector3::zeros();
    let (mut q, mut worst, mut longest) = (polar::identity::<f32>(), 0.0, 0.0);
    for step in 0..STEPS {
        rate += Vector3::from_fn(|_, _| 0.1 * STEP * random.signed());
        rate *= (STEP / rate.norm()).min(1.0);
        // A small turn, renormalised: its angle is below |rate|.
        let half = rate * 0.5;
        r = UnitQuaternion::new_normalize(
            r.into_inner() * Quaternion::new(1.0, half.x, half.y, half.z),
        );
        let mix = f64::from(step % 1000) / 1000.0;
        let mix = if step / 1000 % 2 == 0 { mix } else { 1.0 - mix };
        let f = narrowed(&(r.to_rotation_matrix() * (from * (1.0 - mix) + to * mix)));
        q = polar::sweeps(&q, &f, 1);
        let b = polar::unrotated(&q, &f).map(|row| row.map(f64::from));
        worst = asymmetry(&b).max(worst);
        longest = (q.iter().map(|&c| f64::from(c).powi(2)).sum::<f64>() - 1.0)
            .abs()
            .max(longest);
        if step % 1000 == 999 {
            assert_rotation(&q).unwrap();
        }
    }
    println!("asymmetry {worst:e}, |q|² − 1 {longest:e}");
    assert!(worst < 4.0 / 3.0 * STEP, "{worst:e}");
    assert!(longest <= UNIT, "{longest:e}");
}
