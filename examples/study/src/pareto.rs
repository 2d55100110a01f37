//! Errors at equal time.

use crate::measure::Outcome;

/// What an outcome is judged by.
pub type Metric = fn(&Outcome) -> f64;

pub const TO_TRUTH: Metric = |o| o.to_truth;
pub const TO_CONVERGED: Metric = |o| o.to_converged;

/// The best of those that take at most `seconds`; infinite where there is none.
pub fn best_at(outcomes: &[&Outcome], metric: Metric, seconds: f64) -> f64 {
    let fit = outcomes.iter().filter(|o| o.seconds <= seconds);
    fit.map(|o| metric(o)).fold(f64::INFINITY, f64::min)
}

/// Those that no cheaper one beats, by time.
pub fn front(outcomes: &[&Outcome], metric: Metric) -> Vec<(f64, f64)> {
    let mut points: Vec<_> = outcomes.iter().map(|o| (o.seconds, metric(o))).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut best = f64::INFINITY;
    points.retain(|&(_, error)| {
        let better = error < best;
        best = best.min(error);
        better
    });
    points
}

/// Times from the first to the last at which both have something to show, evenly by ratio.
pub fn common_times(a: &[&Outcome], b: &[&Outcome], count: usize) -> Vec<f64> {
    let seconds = |o: &[&Outcome]| o.iter().map(|o| o.seconds).fold(f64::INFINITY, f64::min);
    let last = a.iter().chain(b).map(|o| o.seconds).fold(0.0, f64::max);
    let first = seconds(a).max(seconds(b));
    let ratio = (last / first).powf(1.0 / (count - 1) as f64);
    (0..count)
        .map(|k| first * ratio.powi(k as i32) * (1.0 + 1e-12))
        .collect()
}
