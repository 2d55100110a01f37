//! The command line `femto`, and the readers of meshes that other programs of this workspace share.

// The letters of the papers: X at rest, x now.
#![allow(non_snake_case)]

mod asset_info;
mod bake;
mod colliders;
pub mod contact_cost;
mod coupled;
mod demo;
pub mod endurance;
mod error;
mod info;
mod loads;
mod material;
pub mod mesh;
mod place;
mod prepare;
mod preview;
pub mod rehearsal;
mod report;
mod run;
mod scene;
mod scene_file;
mod sim;
mod suggest;
mod tables;
mod vtu;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Simulates soft bodies made of tetrahedra.
///
/// Without a command: drops a snowman, writes femto-out/, and says what it cost and how
/// exact it was.
#[derive(Parser)]
#[command(
    version,
    after_help = "Exit status: 0 done, 2 bad command line, scene, mesh or folder, 3 a step was refused."
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    /// Simulate a scene and write final.csv, trace.csv, report.json and preview.svg
    Run(run::Args),
    /// Make an asset for a program to embed: a mesh with its material, pins and factor
    Bake(Box<bake::Args>),
    /// Measure which solver and budget a scene should take, and print it
    Suggest(suggest::Args),
    /// Say how large and how good a mesh is, and everything that is wrong with it; or what an asset holds
    Info {
        /// Gmsh .msh (4.1 ASCII), TetGen .node with its .ele beside it, or an asset .femto
        mesh: PathBuf,
    },
}

/// What `femto` does; its arguments are the process's.
#[must_use]
pub fn main() -> ExitCode {
    let done = match Cli::parse().command {
        Some(Command::Run(args)) => run::command(&args),
        Some(Command::Bake(args)) => bake::command(&args),
        Some(Command::Suggest(args)) => suggest::command(&args),
        Some(Command::Info { mesh }) => info::command(&mesh),
        None => demo::command(),
    };
    match done {
        Ok(status) => ExitCode::from(status),
        Err(error) => {
            eprintln!("error: {}", error::one_line(&error.to_string()));
            ExitCode::from(error::EXIT_STATUS)
        }
    }
}

/// Prints to stdout; nobody reading it any more is no error.
fn print(text: &str) {
    let _ = std::io::stdout().lock().write_all(text.as_bytes());
}
