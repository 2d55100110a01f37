//! Times of many kernels on a machine that others use too.
//!
//! The kernels take turns, round after round, so that a slow spell of the machine hits all of them;
//! of each the fastest sample counts, since disturbances only ever add time. Where the system tells,
//! time is what this thread spent computing: a kernel that takes longer than the scheduler's slices
//! never runs undisturbed by the clock on the wall.

use std::time::Duration;

/// A point in time, from an arbitrary start.
#[cfg(unix)]
pub fn now() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
}

/// A point in time, from an arbitrary start.
#[cfg(not(unix))]
pub fn now() -> Duration {
    static START: std::sync::LazyLock<std::time::Instant> =
        std::sync::LazyLock::new(std::time::Instant::now);
    START.elapsed()
}

/// Runs so many times and says how long it took.
type Run<'a> = Box<dyn FnMut(u32) -> Duration + 'a>;

/// Something to be timed: a row and a column of the table.
pub struct Kernel<'a> {
    pub row: &'static str,
    /// Lane width.
    pub lanes: usize,
    run: Run<'a>,
}

impl<'a> Kernel<'a> {
    /// A kernel that can run again and again.
    pub fn new(row: &'static str, lanes: usize, mut f: impl FnMut() + 'a) -> Self {
        let run = move |times| {
            let start = now();
            for _ in 0..times {
                f();
            }
            now() - start
        };
        Self {
            row,
            lanes,
            run: Box::new(run),
        }
    }

    /// A kernel that runs on `state` after an untimed `reset`.
    pub fn after<S: 'a>(
        row: &'static str,
        lanes: usize,
        mut state: S,
        reset: impl Fn(&mut S) + 'a,
        f: impl Fn(&mut S) + 'a,
    ) -> Self {
        let run = move |times| {
            let mut total = Duration::ZERO;
            for _ in 0..times {
                reset(&mut state);
                let start = now();
                f(&mut state);
                total += now() - start;
            }
            total
        };
        Self {
            row,
            lanes,
            run: Box::new(run),
        }
    }
}

/// How much time to spend.
#[derive(Clone, Copy)]
pub struct Effort {
    pub rounds: u32,
    /// A sample repeats its kernel until it takes about so long.
    pub sample: Duration,
}

/// Seconds per run of each kernel.
pub fn time(kernels: &mut [Kernel<'_>], effort: Effort) -> Vec<f64> {
    let repeats: Vec<u32> = kernels
        .iter_mut()
        .map(|kernel| calibrated(&mut kernel.run, effort))
        .collect();
    let mut best = vec![f64::INFINITY; kernels.len()];
    for _ in 0..effort.rounds {
        for ((kernel, &repeats), best) in kernels.iter_mut().zip(&repeats).zip(&mut best) {
            // Short kernels find their data in the caches, as they do in a simulation.
            if repeats > 1 {
                (kernel.run)(1);
            }
            let seconds = (kernel.run)(repeats).as_secs_f64() / f64::from(repeats);
            *best = best.min(seconds);
        }
    }
    best
}

fn calibrated(run: &mut Run<'_>, effort: Effort) -> u32 {
    let mut repeats = 1;
    while run(repeats) < effort.sample / 2 {
        repeats *= 2;
    }
    repeats
}
