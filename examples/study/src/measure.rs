//! References, errors and times.

use femto_bench::baseline::Stop;
use femto_bench::clock;

use crate::method::{Contender, Method};
use crate::methods::explicit;
use crate::problem::{H, Problem};

/// Positions after every step.
pub type Track = Vec<Vec<[f64; 3]>>;

/// What a problem's runs are compared with.
pub struct References {
    /// Explicit integration in f64 at a small fraction of its stable step.
    pub truth: Track,
    /// The same step size, every linear system solved: what a truncated solve aims at.
    pub converged: Track,
    diagonal: f64,
}

impl References {
    pub fn new(problem: &Problem) -> Self {
        std::thread::scope(|scope| {
            let converged = scope.spawn(|| converged(problem, H));
            Self {
                truth: explicit::truth(problem),
                converged: converged.join().expect("a reference"),
                diagonal: problem.diagonal(),
            }
        })
    }
}

/// The usual pipeline in f64, solved to r·r ≤ 1e-20 b·b.
fn converged(problem: &Problem, h: f64) -> Track {
    let mut body = problem.baseline::<f64>(h);
    let steps = 0..problem.steps;
    steps
        .map(|_| {
            body.step(Stop::At(1e-20));
            body.x.clone()
        })
        .collect()
}

/// What a run came to.
#[derive(Clone)]
pub struct Outcome {
    pub family: String,
    pub budget: String,
    /// Seconds a step of the problem.
    pub seconds: f64,
    /// Mean over the steps of the RMS distance of the nodes, over the bounding box's diagonal.
    pub to_truth: f64,
    pub to_converged: f64,
    /// RMS over the run of the tip's distance to the converged one, over its travel.
    pub tip: f64,
}

impl Outcome {
    pub fn name(&self) -> String {
        format!("{}, {}", self.family, self.budget)
    }
}

/// Runs a contender. On a machine that others use, the fastest time counts: of all steps where each does the same
/// work; else of each step among three runs, averaged over the steps.
pub fn run(problem: &Problem, to: &References, contender: &Contender) -> Outcome {
    let repeats = if contender.steady { 1 } else { 3 };
    let mut times = vec![f64::INFINITY; problem.steps];
    let mut track = Vec::new();
    lap(problem, contender, &mut times, |method| {
        track.push(method.positions());
    });
    for _ in 1..repeats {
        lap(problem, contender, &mut times, |_| {});
    }
    Outcome {
        family: contender.family.clone(),
        budget: contender.budget.clone(),
        seconds: match contender.steady {
            true => times.iter().copied().fold(f64::INFINITY, f64::min),
            false => mean(&times),
        },
        to_truth: error(&track, &to.truth, to.diagonal),
        to_converged: error(&track, &to.converged, to.diagonal),
        tip: tip_error(problem, &track, &to.converged),
    }
}

/// Seconds a step of each contender, all by one measure: they take turns, and of each step the fastest of the rounds
/// counts, averaged over the steps.
pub fn race(problem: &Problem, contenders: &[&Contender], rounds: usize) -> Vec<f64> {
    let mut times = vec![vec![f64::INFINITY; problem.steps]; contenders.len()];
    for _ in 0..rounds {
        for (contender, times) in contenders.iter().zip(&mut times) {
            lap(problem, contender, times, |_| {});
        }
    }
    times.iter().map(|times| mean(times)).collect()
}

/// A run from the start that lowers the `times` of its steps where it is faster.
fn lap(
    problem: &Problem,
    contender: &Contender,
    times: &mut [f64],
    mut after: impl FnMut(&dyn Method),
) {
    let mut method = (contender.build)(problem, H / f64::from(contender.substeps));
    for time in times {
        let begin = clock::now();
        for _ in 0..contender.substeps {
            method.step();
        }
        *time = time.min((clock::now() - begin).as_secs_f64());
        after(&*method);
    }
}

fn mean(times: &[f64]) -> f64 {
    times.iter().sum::<f64>() / times.len() as f64
}

/// The tip is where x is largest at rest.
fn tip_error(problem: &Problem, track: &Track, reference: &Track) -> f64 {
    let nodes = &problem.nodes;
    let far = nodes.iter().map(|x| x[0]).fold(f32::MIN, f32::max);
    let tip: Vec<usize> = (0..nodes.len())
        .filter(|&i| nodes[i][0] > far - 1e-4)
        .collect();
    let at = |x: &Vec<[f64; 3]>| {
        [0, 1, 2].map(|a| tip.iter().map(|&i| x[i][a]).sum::<f64>() / tip.len() as f64)
    };
    let start = at(&crate::method::widened(nodes));
    let minus = |a: [f64; 3], b: [f64; 3]| square([0, 1, 2].map(|k| a[k] - b[k]));
    let travel = reference
        .iter()
        .map(|x| minus(at(x), start))
        .fold(0.0, f64::max);
    let squares: f64 = track
        .iter()
        .zip(reference)
        .map(|(x, y)| minus(at(x), at(y)))
        .sum();
    let error = (squares / track.len() as f64 / travel).sqrt();
    if error.is_finite() {
        error
    } else {
        f64::INFINITY
    }
}

/// Mean over time of the RMS distance over the diagonal; infinite where it ever is.
pub fn error(track: &[Vec<[f64; 3]>], reference: &[Vec<[f64; 3]>], diagonal: f64) -> f64 {
    let frames = track.iter().zip(reference);
    let sum: f64 = frames.map(|(a, b)| distance(a, b) / diagonal).sum();
    let mean = sum / track.len() as f64;
    if mean.is_finite() {
        mean
    } else {
        f64::INFINITY
    }
}

/// RMS distance of the nodes, metres.
pub fn distance(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let squares = a
        .iter()
        .zip(b)
        .map(|(a, b)| square([0, 1, 2].map(|k| a[k] - b[k])));
    (squares.sum::<f64>() / a.len() as f64).sqrt()
}

pub fn square(u: [f64; 3]) -> f64 {
    u[0] * u[0] + u[1] * u[1] + u[2] * u[2]
}

/// ½ Σ m v²
pub fn kinetic(masses: &[f32], method: &dyn Method) -> f64 {
    let v = method.velocities();
    let each = masses
        .iter()
        .zip(&v)
        .map(|(m, v)| 0.5 * f64::from(*m) * square(*v));
    each.sum()
}
