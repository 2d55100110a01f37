//! A scene whose every value has been checked, with its bodies placed and rounded to f32:
//! all that a simulation needs.

use std::collections::HashMap;
use std::fmt::Debug;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use femto_bake::Kind;
use glam::DVec3;

use crate::colliders::{self, Collider};
use crate::coupled::{self, Coupled};
use crate::error::Error;
use crate::loads::{self, Carried, Load};
use crate::material::{Laws, Substances};
use crate::mesh::{self, Mesh, check};
use crate::place;
use crate::scene_file::{self as file, MeshSource, SceneFile, Vector};

#[derive(Clone, Debug)]
pub struct Scene {
    /// The file's name, for messages and headings.
    pub file: String,
    pub gravity: [f32; 3],
    pub dt: f64,
    pub steps: u32,
    pub theta: f32,
    /// dt / substeps, in f64; the solver takes it rounded once.
    pub substep: f64,
    pub budget: file::Budget,
    /// As written in the file, for the report.
    pub solver: file::Solver,
    pub preconditioner: Preconditioner,
    pub start: Start,
    pub layout: Layout,
    pub bodies: Vec<Body>,
    pub colliders: Vec<Collider>,
    pub loads: Vec<Load>,
    /// Where all bodies are one system; rigid bodies are then the last of `bodies`.
    pub coupled: Option<Coupled>,
}

impl Scene {
    /// Bodies before the rigid ones.
    pub fn soft_bodies(&self) -> usize {
        let rigid = self.coupled.as_ref().map_or(0, |c| c.rigid.len());
        self.bodies.len() - rigid
    }

    /// Whether any body is not isotropic.
    pub fn has_fibres(&self) -> bool {
        self.bodies.iter().any(|body| body.substances.has_fibres())
    }

    /// Systems that are solved: one of all bodies, or each.
    pub fn systems(&self) -> usize {
        if self.coupled.is_some() {
            1
        } else {
            self.bodies.len()
        }
    }

    /// Node numbers and velocities of all pins, nodes counted through all bodies.
    pub fn all_pins(&self) -> impl Iterator<Item = (u32, [f32; 3])> {
        let mut first = 0;
        self.bodies.iter().flat_map(move |body| {
            let base = first;
            first += body.x.len() as u32;
            body.pins.iter().map(move |&(node, v)| (base + node, v))
        })
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Preconditioner {
    Identity,
    Mass,
    Jacobi,
    BlockJacobi,
    TwoLevel,
    /// A factor of the rest matrix, made when the scene is loaded.
    Factored(Kind),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    Zero,
    Velocity,
    VelocityForce,
    Galerkin(u8),
    Rigid(u8),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Layout {
    Factored,
    Dense,
}

#[derive(Clone, Debug)]
pub struct Body {
    /// `mesh = "..."` as written, for messages of the solver.
    pub source: String,
    pub young: f32,
    pub poisson: f32,
    pub density: f32,
    pub alpha: f32,
    pub beta: f32,
    pub substances: Substances,
    pub laws: Laws,
    pub rest: Vec<[f32; 3]>,
    pub tets: Vec<[u32; 4]>,
    /// Start positions and velocities.
    pub x: Vec<[f32; 3]>,
    pub v: Vec<[f32; 3]>,
    /// Node and prescribed velocity, by rising node; a later pin overrules an earlier one.
    pub pins: Vec<(u32, [f32; 3])>,
    /// Pins whose velocity is that of a frame that turns.
    pub carried: Vec<Carried>,
    /// What is drawn instead of the mesh.
    pub shown: Option<Shown>,
}

/// A shape that moves with four nodes.
#[derive(Clone, Debug)]
pub struct Shown {
    /// Of the nodes at each point; they sum to 1.
    pub weights: Vec<[f64; 4]>,
    pub tets: Vec<[u32; 4]>,
}

impl Body {
    /// The tetrahedra to draw, over the points of [`Self::show`].
    pub fn shown_tets(&self) -> &[[u32; 4]] {
        self.shown.as_ref().map_or(&self.tets, |shown| &shown.tets)
    }

    /// Node vectors at the points that are drawn.
    pub fn show(&self, nodes: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let Some(shown) = &self.shown else {
            return nodes.to_vec();
        };
        let at = |w: &[f64; 4]| {
            let mean = |axis: usize| {
                w.iter()
                    .zip(nodes)
                    .map(|(w, x)| w * f64::from(x[axis]))
                    .sum::<f64>()
            };
            [0, 1, 2].map(|axis| mean(axis) as f32)
        };
        shown.weights.iter().map(at).collect()
    }
}

/// Where meshes come from: a folder, or the ones built into the tool.
pub trait Meshes {
    fn load(&mut self, name: &str) -> Result<Mesh, String>;
}

impl Meshes for PathBuf {
    fn load(&mut self, name: &str) -> Result<Mesh, String> {
        mesh::load(&self.join(name))
    }
}

/// Bytes of a scene file; devices and pipes may never end.
const LONGEST: u64 = 64 << 20;

/// Reads a scene file and everything that it names.
pub fn load(path: &Path) -> Result<Scene, Error> {
    let name = path.display().to_string();
    let mut bytes = Vec::new();
    let file = File::open(path).and_then(|file| file.take(LONGEST + 1).read_to_end(&mut bytes));
    file.map_err(|source| Error::Read {
        path: path.into(),
        source,
    })?;
    if bytes.len() as u64 > LONGEST {
        return Err(Error::Scene {
            file: name,
            what: format!("has more than {} MB", LONGEST >> 20),
        });
    }
    let text = String::from_utf8(bytes).map_err(|_| Error::Scene {
        file: name.clone(),
        what: "is not UTF-8 text".into(),
    })?;
    let mut folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
    parse(&name, &text, &mut folder)
}

pub fn parse(name: &str, text: &str, meshes: &mut dyn Meshes) -> Result<Scene, Error> {
    check(name, file::parse(name, text)?, meshes)
}

/// Checks a scene that was read, or put together otherwise; `name` is its name for messages.
pub fn check(name: &str, raw: SceneFile, meshes: &mut dyn Meshes) -> Result<Scene, Error> {
    Checker { file: name }.scene(raw, meshes)
}

/// Writes errors: it knows the file's name.
pub struct Checker<'a> {
    pub file: &'a str,
}

impl Checker<'_> {
    pub fn wrong(&self, key: &str, value: &dyn Debug, why: impl Into<String>) -> Error {
        Error::Value {
            file: self.file.into(),
            key: key.into(),
            value: format!("{value:?}"),
            why: why.into(),
        }
    }

    /// Rounds to f32, once; the rounded value has to be finite and to keep the rule too.
    pub fn number(
        &self,
        key: &str,
        value: f64,
        rule: &str,
        ok: fn(f64) -> bool,
    ) -> Result<f32, Error> {
        if !value.is_finite() {
            return Err(self.wrong(key, &value, "must be finite"));
        }
        if !ok(value) {
            return Err(self.wrong(key, &value, rule));
        }
        let rounded = value as f32;
        if !rounded.is_finite() {
            return Err(self.wrong(key, &value, "is too large for f32"));
        }
        if !ok(f64::from(rounded)) {
            return Err(self.wrong(key, &value, format!("rounds to {rounded:?} in f32: {rule}")));
        }
        Ok(rounded)
    }

    pub fn any(&self, key: &str, value: f64) -> Result<f32, Error> {
        self.number(key, value, "", |_| true)
    }

    pub fn positive(&self, key: &str, value: f64) -> Result<f32, Error> {
        self.number(key, value, "must be above 0", |x| x > 0.0)
    }

    pub fn not_negative(&self, key: &str, value: f64) -> Result<f32, Error> {
        self.number(key, value, "must not be negative", |x| x >= 0.0)
    }

    pub fn vector(&self, key: &str, value: Vector) -> Result<[f32; 3], Error> {
        let Vector(v) = value;
        if v.iter().any(|x| !x.is_finite()) {
            return Err(self.wrong(key, &v, "must be finite"));
        }
        let rounded = v.map(|x| x as f32);
        if rounded.iter().any(|x| !x.is_finite()) {
            return Err(self.wrong(key, &v, "is too large for f32"));
        }
        Ok(rounded)
    }

    /// A direction of length 1, and the length that it had.
    pub fn direction(&self, key: &str, value: Vector) -> Result<(DVec3, f64), Error> {
        self.vector(key, value)?;
        let v = DVec3::from(value.0);
        let length = v.length();
        if length == 0.0 {
            return Err(self.wrong(key, &value.0, "must not be zero"));
        }
        Ok((v / length, length))
    }

    fn scene(&self, raw: SceneFile, meshes: &mut dyn Meshes) -> Result<Scene, Error> {
        self.positive("time.dt", raw.time.dt)?;
        let theta = self.number("time.theta", raw.time.theta, "must be from 0.5 to 1", |t| {
            (0.5..=1.0).contains(&t)
        })?;
        if raw.budget.substeps == 0 {
            return Err(self.wrong("budget.substeps", &0, "must be at least 1"));
        }
        let substep = raw.time.dt / f64::from(raw.budget.substeps);
        let normal = |h: f64| h >= f64::from(f32::MIN_POSITIVE);
        self.number(
            "time.dt / budget.substeps",
            substep,
            "must be at least 1.2e-38",
            normal,
        )?;
        let gravity = self.vector("gravity", raw.gravity)?;
        let preconditioner = self.preconditioner(&raw.solver.preconditioner)?;
        let start = self.start(&raw.solver.start)?;
        let layout = match raw.solver.layout.as_str() {
            "factored" => Layout::Factored,
            "dense" => Layout::Dense,
            other => return Err(self.wrong("solver.layout", &other, "must be factored or dense")),
        };
        let mut solids = Vec::new();
        for (i, collider) in raw.collider.iter().enumerate() {
            solids.push(colliders::check(self, &format!("collider[{i}]"), collider)?);
        }
        if raw.body.is_empty() && raw.rigid.is_empty() {
            return Err(Error::Scene {
                file: self.file.into(),
                what: "body: there is none: at least one [[body]] is needed".into(),
            });
        }
        let mut loaded = HashMap::new();
        let mut bodies = Vec::new();
        for (i, body) in raw.body.iter().enumerate() {
            bodies.push(self.body(&format!("body[{i}]"), body, meshes, &mut loaded)?);
        }
        let coupled = match coupled::wanted(&raw) {
            true => Some(coupled::check(self, &raw, &mut bodies)?),
            false => None,
        };
        if let (None, Some(i)) = (&coupled, raw.body.iter().position(|b| b.friction.is_some())) {
            let (key, friction) = (format!("body[{i}].friction"), raw.body[i].friction);
            return Err(self.wrong(
                &key,
                &friction.unwrap_or_default(),
                "bodies touch only in a scene with [contact]; friction with a collider is the collider's",
            ));
        }
        Ok(Scene {
            file: self.file.into(),
            gravity,
            dt: raw.time.dt,
            steps: raw.time.steps,
            theta,
            substep,
            budget: raw.budget,
            solver: raw.solver,
            preconditioner,
            start,
            layout,
            loads: loads::check(self, &raw.pressure, &raw.wind, &bodies[..raw.body.len()])?,
            bodies,
            colliders: solids,
            coupled,
        })
    }

    fn preconditioner(&self, name: &str) -> Result<Preconditioner, Error> {
        let why = match name {
            "identity" => return Ok(Preconditioner::Identity),
            "mass" => return Ok(Preconditioner::Mass),
            "jacobi" => return Ok(Preconditioner::Jacobi),
            "block-jacobi" => return Ok(Preconditioner::BlockJacobi),
            "two-level" => return Ok(Preconditioner::TwoLevel),
            "laplacian" => return Ok(Preconditioner::Factored(Kind::Laplacian)),
            "warped" => return Ok(Preconditioner::Factored(Kind::Warped)),
            _ => "must be identity, mass, jacobi, block-jacobi, two-level, laplacian or warped",
        };
        Err(self.wrong("solver.preconditioner", &name, why))
    }

    fn start(&self, name: &str) -> Result<Start, Error> {
        // "galerkin-01" and "galerkin-+1" parse as numbers too: compare what was written.
        let history = |prefix: &str| {
            let m: u8 = name.strip_prefix(prefix)?.parse().ok()?;
            (format!("{prefix}{m}") == name).then_some(m)
        };
        match name {
            "zero" => Ok(Start::Zero),
            "velocity" => Ok(Start::Velocity),
            "velocity-force" => Ok(Start::VelocityForce),
            _ => {
                let galerkin = history("galerkin-").map(Start::Galerkin);
                galerkin.or(history("rigid-").map(Start::Rigid)).ok_or_else(|| {
                    let why =
                        "must be zero, velocity, velocity-force, galerkin-m or rigid-m with m = 0, 1, 2, ...";
                    self.wrong("solver.start", &name, why)
                })
            }
        }
    }

    pub fn sphere(&self, key: &str, raw: &file::Sphere) -> Result<(DVec3, f64), Error> {
        self.vector(&format!("{key}.centre"), raw.centre)?;
        self.positive(&format!("{key}.radius"), raw.radius)?;
        Ok((DVec3::from(raw.centre.0), raw.radius))
    }

    fn body(
        &self,
        key: &str,
        raw: &file::Body,
        meshes: &mut dyn Meshes,
        loaded: &mut HashMap<String, Mesh>,
    ) -> Result<Body, Error> {
        let at = |name: &str| format!("{key}.{name}");
        let young = self.positive(&at("young"), raw.young)?;
        let poisson = self.number(
            &at("poisson"),
            raw.poisson,
            "must be below 0.5 and above -1",
            |p| p > -1.0 && p < 0.5,
        )?;
        let density = self.positive(&at("density"), raw.density)?;
        let alpha = self.not_negative(&at("alpha"), raw.alpha)?;
        let beta = self.not_negative(&at("beta"), raw.beta)?;
        let placing = place::Placing::new(self, key, raw)?;

        let source = match &raw.mesh {
            MeshSource::File(name) => format!("{name:?}"),
            MeshSource::Box(b) => format!("{{ box = {:?}, cells = {:?} }}", b.size.0, b.cells.0),
        };
        let bad_mesh = |why: String| Error::Value {
            file: self.file.into(),
            key: at("mesh"),
            value: source.clone(),
            why,
        };
        let mesh = match loaded.get(&source) {
            Some(mesh) => mesh,
            None => {
                let mesh = match &raw.mesh {
                    MeshSource::File(name) => meshes.load(name).map_err(bad_mesh)?,
                    MeshSource::Box(b) => {
                        for size in b.size.0 {
                            self.positive(&at("mesh.box"), size)?;
                        }
                        if b.cells.0.contains(&0) {
                            return Err(self.wrong(
                                &at("mesh.cells"),
                                &b.cells.0,
                                "must be at least 1",
                            ));
                        }
                        mesh::grid::mesh(b.size.0, b.cells.0).map_err(bad_mesh)?
                    }
                };
                if let Some(why) = check::first_of(&check::problems(&mesh)) {
                    return Err(bad_mesh(why));
                }
                loaded.entry(source.clone()).or_insert(mesh)
            }
        };

        let placed = placing.rest(&mesh.nodes);
        let rest = placing
            .round(&placed)
            .map_err(|why| bad_mesh(format!("placed {why}")))?;
        let substances = Substances::new(self, key, raw, mesh, &placing, &placed)?;
        let laws = Laws::new(self, key, raw, mesh.tets.len())?;
        let (pins, carried) = place::pins(self, key, raw, &placed)?;
        let (x, v) = placing.start(&placed);
        let x = placing
            .round(&x)
            .map_err(|why| bad_mesh(format!("stretched {why}")))?;
        let v = placing
            .round(&v)
            .map_err(|why| bad_mesh(format!("velocity of {why}")))?;
        Ok(Body {
            source,
            young,
            poisson,
            density,
            alpha,
            beta,
            substances,
            laws,
            rest,
            tets: mesh.tets.clone(),
            x,
            v,
            pins,
            carried,
            shown: None,
        })
    }
}
