//! A folder of its own for each test, and the built binary run in it.

#![allow(dead_code, reason = "each test file uses a part of it")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

/// A small beam, held at one end, that falls.
pub const BEAM: &str = r#"
[time]
dt = 0.01
steps = 10

[[body]]
mesh = { box = [1.0, 0.25, 0.25], cells = [4, 1, 1] }
young = 1e5
poisson = 0.4
density = 1000.0

[[body.pin]]
box = [[-1e-6, -1.0, -1.0], [1e-6, 1.0, 1.0]]
"#;

/// The beam, free.
pub fn free_beam() -> &'static str {
    BEAM.split_once("[[body.pin]]").expect("a pin").0
}

pub struct Folder(TempDir);

impl Folder {
    pub fn new() -> Self {
        Folder(tempfile::tempdir().expect("a temporary folder"))
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).expect("a file can be written");
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub fn femto(&self, arguments: &[&str]) -> Run {
        let output = Command::new(env!("CARGO_BIN_EXE_femto"))
            .args(arguments)
            .current_dir(self.0.path())
            .output()
            .expect("the binary runs");
        Run::new(output)
    }

    /// With files of at most 4 KB, as on a disk that is full.
    #[cfg(unix)]
    pub fn femto_on_a_full_disk(&self, arguments: &[&str]) -> Run {
        let output = Command::new("sh")
            .args(["-c", "trap '' XFSZ; ulimit -f 8; exec \"$@\"", "sh"])
            .arg(env!("CARGO_BIN_EXE_femto"))
            .args(arguments)
            .current_dir(self.0.path())
            .output()
            .expect("the binary runs");
        Run::new(output)
    }

    /// Runs a scene into `out`.
    pub fn run(&self, scene: &str, arguments: &[&str]) -> Run {
        self.write("scene.toml", scene);
        let all = [&["run", "scene.toml", "--out", "out"], arguments].concat();
        self.femto(&all)
    }

    /// `report.json` of what [`Self::run`] ran.
    pub fn report(&self) -> Value {
        serde_json::from_str(&self.read("out/report.json")).expect("JSON")
    }

    pub fn root(&self) -> &Path {
        self.0.path()
    }
}

pub struct Run {
    pub status: i32,
    pub out: String,
    pub err: String,
}

impl Run {
    fn new(output: Output) -> Self {
        Run {
            status: output.status.code().expect("ends by itself"),
            out: String::from_utf8(output.stdout).expect("UTF-8"),
            err: String::from_utf8(output.stderr).expect("UTF-8"),
        }
    }

    pub fn succeeds(self) -> Self {
        assert_eq!((self.status, self.err.as_str()), (0, ""));
        self
    }
}

/// The rows of a table without its head, and the head.
pub fn table(csv: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let head = reader
        .headers()
        .expect("a head")
        .iter()
        .map(str::to_owned)
        .collect();
    let number = |field: &str| {
        field
            .parse()
            .unwrap_or_else(|_| panic!("`{field}` is a number"))
    };
    let rows = reader
        .records()
        .map(|r| r.expect("a row").iter().map(number).collect())
        .collect();
    (head, rows)
}
