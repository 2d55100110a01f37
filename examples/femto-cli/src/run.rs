//! `femto run`: simulates a scene and writes what happened.

use std::fmt::Write as _;
use std::fs;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::error::Error;
use crate::prepare::Factors;
use crate::preview::{EnergyLog, Moment, Preview};
use crate::report::{EnergyReport, FirstAndLast, Report, StepTimes};
use crate::scene::{Body, Scene};
use crate::sim::{Energies, Sim};
use crate::{scene, tables, vtu};

/// How a run went.
pub struct Summary {
    pub first: Energies,
    pub last: Energies,
    /// The most that the total energy rose in one step, and in which; 0 when it never rose.
    pub max_rise: (f64, u32),
    pub times: StepTimes,
    pub steps_run: u32,
    /// Contacts between bodies that found no room.
    pub dropped: u64,
    /// Why a step was refused.
    pub refused: Option<String>,
}

#[derive(clap::Args)]
pub struct Args {
    /// The scene file (TOML)
    scene: PathBuf,

    /// The folder for the results; made if it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,

    /// Also write N files frames/*.vtu for ParaView, evenly over the run
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    frames: Option<u32>,

    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

/// Returns the exit status, 0 or 3.
pub fn command(args: &Args) -> Result<u8, Error> {
    let scene = scene::load(&args.scene)?;
    let factors = Factors::new(&scene)?;
    let mut sim = Sim::new(&scene, &factors)?;
    let frames = frame_steps(args.frames, scene.steps)?;
    let summary = run(&scene, &mut sim, &args.out, &frames, args.quiet, |_| {})?;
    if let Some(why) = &summary.refused {
        eprintln!(
            "error: {}: step {} of {} was refused: {why}; the state before it is in {}",
            scene.file,
            summary.steps_run + 1,
            scene.steps,
            args.out.display()
        );
        return Ok(3);
    }
    if !args.quiet {
        crate::print(&describe(&scene, &sim, &summary, &args.out));
    }
    Ok(0)
}

/// The steps after which a frame is written: the first is the start, the last the end.
fn frame_steps(frames: Option<u32>, steps: u32) -> Result<Vec<u32>, Error> {
    let Some(frames) = frames else {
        return Ok(Vec::new());
    };
    if u64::from(frames) > u64::from(steps) + 1 {
        return Err(Error::Option {
            option: "--frames",
            value: frames.to_string(),
            why: format!(
                "the run has only {} states, the start and {steps} steps",
                u64::from(steps) + 1
            ),
        });
    }
    Ok(evenly(frames, steps))
}

/// `count` numbers evenly from 0 to `last`, both included (one: `last`), each once.
fn evenly(count: u32, last: u32) -> Vec<u32> {
    let (count, last) = (u64::from(count), u64::from(last));
    let gaps = (count - 1).max(1);
    let mut steps: Vec<u32> = (0..count)
        .map(|i| {
            if count == 1 {
                last
            } else {
                (2 * i * last + gaps) / (2 * gaps)
            }
        })
        .map(|step| step as u32)
        .collect();
    steps.dedup();
    steps
}

/// Simulates, and fills DIR. The scene is valid by now. `after_step` sees each new state.
pub fn run(
    scene: &Scene,
    sim: &mut Sim,
    out: &Path,
    frames: &[u32],
    quiet: bool,
    mut after_step: impl FnMut(&Sim),
) -> Result<Summary, Error> {
    let mut files = Files::new(out, !frames.is_empty())?;
    let mut trace =
        tables::trace(&out.join("trace.csv")).map_err(|e| files.wrong("trace.csv", e.into()))?;
    let moments = evenly(crate::preview::MOMENTS, scene.steps);
    let mut preview = Preview::new(scene);
    let progress = Progress::new(scene.steps, quiet);

    let first = sim.measure().energy;
    let mut energy = EnergyLog::new(first);
    let mut last = first;
    let mut max_rise = (0.0, 0);
    let mut times = Vec::with_capacity(scene.steps.min(1 << 20) as usize);
    let mut refused = None;
    let mut dropped = 0;
    let mut step = 0;
    loop {
        let time = f64::from(step) * scene.dt;
        if moments.contains(&step) {
            preview.moments.push(Moment::new(time, scene, sim));
        }
        if frames.get(files.frames.len()) == Some(&step) {
            files.frame(time, sim, &scene.bodies)?;
        }
        if step == scene.steps {
            break;
        }
        let info = match sim.step() {
            Ok(info) => info,
            Err(why) => {
                refused = Some(why);
                break;
            }
        };
        times.push(info.took);
        dropped += u64::from(info.dropped);
        step += 1;
        after_step(sim);
        let time = f64::from(step) * scene.dt;
        let after = sim.measure();
        let rise = after.energy.total() - last.total();
        if rise > max_rise.0 {
            max_rise = (rise, step);
        }
        last = after.energy;
        energy.push(time, last);
        let row = tables::TraceRow::new(step, time, info, &after);
        trace
            .serialize(row)
            .map_err(|e| files.wrong("trace.csv", e.into()))?;
        progress.set(step);
    }
    progress.clear();
    trace.flush().map_err(|e| files.wrong("trace.csv", e))?;

    let times = StepTimes::new(&mut times);
    tables::write_final(&out.join("final.csv"), sim)
        .map_err(|e| files.wrong("final.csv", e.into()))?;
    if refused.is_some() {
        // The last good state is shown too.
        let time = f64::from(step) * scene.dt;
        if !moments.contains(&step) {
            preview.moments.push(Moment::new(time, scene, sim));
        }
        if !frames.is_empty() && !frames.contains(&step) {
            files.frame(time, sim, &scene.bodies)?;
        }
    }
    let svg = preview.draw(&energy, refused.is_some());
    fs::write(out.join("preview.svg"), svg).map_err(|e| files.wrong("preview.svg", e))?;
    files.collection()?;
    let report = Report {
        crate_version: env!("CARGO_PKG_VERSION"),
        scene: &scene.file,
        nodes: scene.bodies.iter().map(|b| b.rest.len()).sum(),
        tets: scene.bodies.iter().map(|b| b.tets.len()).sum(),
        bytes: sim.memory(),
        budget: scene.budget,
        solver: &scene.solver,
        state_hash: format!("{:016x}", sim.hash()),
        energy: FirstAndLast {
            first: EnergyReport::from(first),
            last: EnergyReport::from(last),
        },
        seconds_per_step: times,
        steps_run: step,
        damage: sim.damage(),
        contacts_dropped: scene.coupled.as_ref().map(|_| dropped),
        ended: match &refused {
            None => "completed".into(),
            Some(why) => format!("refused: {why}"),
        },
    };
    let json =
        serde_json::to_string_pretty(&report).expect("a report has no keys that are not text");
    fs::write(out.join("report.json"), json + "\n").map_err(|e| files.wrong("report.json", e))?;
    Ok(Summary {
        first,
        last,
        max_rise,
        times,
        steps_run: step,
        dropped,
        refused,
    })
}

/// DIR, and the frames written so far.
struct Files<'a> {
    out: &'a Path,
    frames: Vec<(f64, String)>,
}

impl<'a> Files<'a> {
    /// Makes DIR and takes away what an earlier run left there.
    fn new(out: &'a Path, with_frames: bool) -> Result<Self, Error> {
        let folder = if with_frames {
            out.join("frames")
        } else {
            out.to_path_buf()
        };
        fs::create_dir_all(&folder).map_err(|source| Error::Out {
            path: out.into(),
            source,
        })?;
        let files = Files {
            out,
            frames: Vec::new(),
        };
        for name in [
            "final.csv",
            "report.json",
            "preview.svg",
            "frames/frames.pvd",
        ] {
            files.remove(name)?;
        }
        if let Ok(old) = fs::read_dir(out.join("frames")) {
            for entry in old.flatten() {
                let name = entry.file_name().to_string_lossy().into_owned();
                if name.starts_with("frame-") && name.ends_with(".vtu") {
                    files.remove(&format!("frames/{name}"))?;
                }
            }
        }
        Ok(files)
    }

    fn remove(&self, name: &str) -> Result<(), Error> {
        match fs::remove_file(self.out.join(name)) {
            Err(e)
                if !matches!(
                    e.kind(),
                    io::ErrorKind::NotFound | io::ErrorKind::NotADirectory
                ) =>
            {
                Err(self.wrong(name, e))
            }
            _ => Ok(()),
        }
    }

    /// Takes away what is half written, too.
    fn wrong(&self, name: &str, source: io::Error) -> Error {
        let path = self.out.join(name);
        if path.is_file() {
            // The error to tell is the first.
            let _ = fs::remove_file(&path);
        }
        Error::Write { path, source }
    }

    fn frame(&mut self, time: f64, sim: &Sim, bodies: &[Body]) -> Result<(), Error> {
        let name = format!("frame-{:05}.vtu", self.frames.len());
        let file = format!("frames/{name}");
        vtu::write_frame(&self.out.join(&file), sim, bodies).map_err(|e| self.wrong(&file, e))?;
        self.frames.push((time, name));
        Ok(())
    }

    fn collection(&self) -> Result<(), Error> {
        if self.frames.is_empty() {
            return Ok(());
        }
        let file = "frames/frames.pvd";
        vtu::write_collection(&self.out.join(file), &self.frames).map_err(|e| self.wrong(file, e))
    }
}

/// A bar on stderr, once a run has taken a second, and only where someone can see it.
pub struct Progress {
    bar: ProgressBar,
    begin: Instant,
}

impl Progress {
    pub fn new(steps: u32, quiet: bool) -> Self {
        let bar = ProgressBar::with_draw_target(Some(steps.into()), ProgressDrawTarget::hidden());
        let style = "{bar:40} step {pos} of {len}, {eta} left";
        bar.set_style(ProgressStyle::with_template(style).expect("a valid template"));
        let begin = Instant::now();
        if !quiet && io::stderr().is_terminal() {
            return Progress { bar, begin };
        }
        Progress {
            bar: ProgressBar::hidden(),
            begin,
        }
    }

    pub fn set(&self, step: u32) {
        if self.bar.length().is_none() {
            return;
        }
        if self.bar.is_hidden() && self.begin.elapsed() > Duration::from_secs(1) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        self.bar.set_position(step.into());
    }

    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

fn describe(scene: &Scene, sim: &Sim, summary: &Summary, out: &Path) -> String {
    let mut text = String::new();
    let nodes: usize = scene.bodies.iter().map(|b| b.rest.len()).sum();
    let tets: usize = scene.bodies.iter().map(|b| b.tets.len()).sum();
    let _ = writeln!(
        text,
        "{}: {nodes} nodes, {tets} tets, {} steps of {} s",
        scene.file, summary.steps_run, scene.dt
    );
    if let (Some(min), Some(median)) = (summary.times.min, summary.times.median) {
        let _ = writeln!(
            text,
            "a step    {:.0} µs (median; fastest {:.0})",
            median * 1e6,
            min * 1e6
        );
    }
    let _ = writeln!(
        text,
        "energy    {:.6e} J at the start, {:.6e} J at the end",
        summary.first.total(),
        summary.last.total()
    );
    if summary.dropped > 0 {
        let _ = writeln!(
            text,
            "contacts  {} found no room: raise contact.capacity",
            summary.dropped
        );
    }
    let _ = writeln!(text, "state     {:016x}", sim.hash());
    let _ = writeln!(text, "written   {}", out.display());
    text
}

#[cfg(test)]
mod tests {
    use super::evenly;

    #[test]
    fn frames_are_even_and_hold_both_ends() {
        assert_eq!(evenly(5, 300), [0, 75, 150, 225, 300]);
        assert_eq!(evenly(4, 10), [0, 3, 7, 10]);
        assert_eq!(evenly(1, 10), [10]);
        assert_eq!(evenly(11, 10), (0..=10).collect::<Vec<_>>());
        assert_eq!(evenly(5, 2), [0, 1, 2]);
        assert_eq!(evenly(5, 0), [0]);
        assert_eq!(evenly(3, u32::MAX), [0, u32::MAX / 2 + 1, u32::MAX]);
    }
}
