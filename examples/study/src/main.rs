//! Speed against error, in one command:
//!
//! ```text
//! cargo run --release -p femto-study [-- [--quick] [--out DIR] [--only CHAPTER]... [--scene NAME]... | --publish]
//! ```
//!
//! writes a folder with report.md, its plots (SVG and PNG) and its data (CSV); `--publish` renews the copy in
//! the tree (`examples/study/report/`).

mod chapters;
mod measure;
mod method;
mod methods;
mod output;
mod pareto;
mod plot;
mod problem;
mod statics;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;

use chapters::{budget, closed, hard, models, paper, peers, relative, spin};
use output::{Done, Output};
use problem::Problem;

/// Speed against error: the study of Dahl and Bargteil redone, other methods at equal time, closed
/// forms, hard cases.
#[derive(Parser)]
struct Args {
    /// Smaller bodies and fewer budgets: under a minute.
    #[arg(long)]
    quick: bool,
    /// Where the report goes.
    #[arg(long, default_value = "femto-study-out")]
    out: PathBuf,
    /// Writes the report (without data and PNGs) into the tree instead, and the library's page on budgets.
    #[arg(long, conflicts_with_all = ["quick", "out", "only", "scene"])]
    publish: bool,
    /// Only these chapters.
    #[arg(long)]
    only: Vec<String>,
    /// Of the paper's bodies only these (snowman, bowling pin, car).
    #[arg(long)]
    scene: Vec<String>,
}

/// How much to do, and where progress is told.
pub struct Run {
    pub quick: bool,
    /// Where the library's page on budgets goes.
    pub page: PathBuf,
    scenes: Vec<String>,
    begin: Instant,
}

impl Run {
    /// Those of the paper's bodies that are asked for.
    pub fn bodies(&self) -> Result<Vec<Problem>, Box<dyn std::error::Error>> {
        let mut all = problem::three()?;
        let asked = |name| self.scenes.is_empty() || self.scenes.iter().any(|s| s == name);
        if let Some(unknown) = self
            .scenes
            .iter()
            .find(|s| all.iter().all(|p| p.name != **s))
        {
            return Err(format!("no scene {unknown}").into());
        }
        all.retain(|problem| asked(problem.name));
        Ok(all)
    }

    /// Tells where the run is.
    pub fn progress(&self, what: &str) {
        eprintln!("{:6.1} s  {what}", self.begin.elapsed().as_secs_f64());
    }
}

type Chapter = fn(&Run, &mut Output) -> Done;

const CHAPTERS: &[(&str, Chapter)] = &[
    ("paper", paper::chapter),
    ("peers", peers::chapter),
    ("relative", relative::chapter),
    ("spin", spin::chapter),
    ("closed", closed::chapter),
    ("models", models::chapter),
    ("hard", hard::chapter),
    ("budget", budget::chapter),
];

fn main() -> ExitCode {
    match study(&Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn study(args: &Args) -> Done {
    if let Some(unknown) = args
        .only
        .iter()
        .find(|name| CHAPTERS.iter().all(|(c, _)| c != name))
    {
        let known: Vec<_> = CHAPTERS.iter().map(|(name, _)| *name).collect();
        return Err(format!("no chapter {unknown}; there are {}", known.join(", ")).into());
    }
    plot::register_font()?;
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let dir = if args.publish {
        here.join("report")
    } else {
        args.out.clone()
    };
    let mut out = Output::new(&dir, args.publish)?;
    let run = Run {
        quick: args.quick,
        page: if args.publish {
            here.join("../../src/choosing.md")
        } else {
            dir.join("choosing.md")
        },
        scenes: args.scene.clone(),
        begin: Instant::now(),
    };
    out.text("# Speed against error");
    out.text(&format!(
        "Written by `cargo run --release -p femto-study`{} on {}, {} lanes of f32. Times are of this run, on one thread.",
        if args.quick { " with `--quick`: smaller bodies and fewer budgets, no figures to quote" } else { "" },
        std::env::consts::ARCH,
        <femto::lane::Native as femto::lane::Lanes>::WIDTH,
    ));
    for (name, chapter) in CHAPTERS {
        if args.only.is_empty() || args.only.iter().any(|only| only == name) {
            run.progress(&format!("chapter {name}"));
            chapter(&run, &mut out)?;
            out.save()?;
        }
    }
    run.progress(&format!("written: {}", dir.join("report.md").display()));
    Ok(())
}
