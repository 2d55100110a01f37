//! What `femto run` and `femto info` do, without the process around them, and scenes cut to a size that takes no time:
//! for fuzzing.

use std::path::Path;

use crate::error::{EXIT_STATUS, Error, one_line};
use crate::info;
use crate::mesh::{Mesh, check};
use crate::prepare::Factors;
use crate::scene::{self, Meshes};
use crate::scene_file::{self as file, MeshSource, SceneFile};
use crate::sim::Sim;

/// No mesh files: a scene has boxes here.
struct NoFiles;

impl Meshes for NoFiles {
    fn load(&mut self, _: &str) -> Result<Mesh, String> {
        Err("there are no files here".into())
    }
}

/// Reads, checks and simulates a few steps of a small scene, into `out` where it is given. Returns the exit status of
/// `femto run`, and what it would print of an error.
#[must_use]
pub fn rehearse(text: &str, out: Option<&Path>) -> (u8, String) {
    match simulate(text, out) {
        Ok(None) => (0, String::new()),
        Ok(Some(refused)) => (3, refused),
        Err(error) => (EXIT_STATUS, one_line(&error.to_string())),
    }
}

/// What `femto info` says of a mesh that was read, or of why it was not: its exit status, and its text.
#[must_use]
pub fn look_over(read: Result<Mesh, String>) -> (u8, String) {
    let mesh = match read {
        Ok(mesh) => mesh,
        Err(why) => return (EXIT_STATUS, one_line(&why)),
    };
    let problems = check::problems(&mesh);
    let status = if problems.is_empty() { 0 } else { EXIT_STATUS };
    (status, info::look_over("mesh", &mesh, &problems))
}

fn simulate(text: &str, out: Option<&Path>) -> Result<Option<String>, Error> {
    let mut raw = file::parse("scene.toml", text)?;
    cut(&mut raw);
    let scene = scene::check("scene.toml", raw, &mut NoFiles)?;
    let factors = Factors::new(&scene)?;
    let mut sim = Sim::new(&scene, &factors)?;
    if let Some(out) = out {
        let frames = [0, scene.steps];
        return crate::run::run(&scene, &mut sim, out, &frames, true, |_| {}).map(|s| s.refused);
    }
    for _ in 0..scene.steps {
        if let Err(refused) = sim.step() {
            return Ok(Some(refused));
        }
        _ = sim.measure();
    }
    Ok(None)
}

/// At most three steps of two substeps, a few iterations, boxes of few cells, and little room for contacts.
fn cut(raw: &mut SceneFile) {
    raw.time.steps = raw.time.steps.min(3);
    raw.budget.iterations = raw.budget.iterations.min(8);
    raw.budget.polar_sweeps = raw.budget.polar_sweeps.min(4);
    raw.budget.substeps = raw.budget.substeps.min(2);
    if let Some(contact) = &mut raw.contact {
        contact.capacity = contact.capacity.min(64);
    }
    for body in &mut raw.body {
        if let MeshSource::Box(mesh) = &mut body.mesh {
            mesh.cells.0 = mesh.cells.0.map(|n| n.min(4));
        }
    }
    raw.body.truncate(70);
    raw.rigid.truncate(70);
}
