//! The scene file as it is written: TOML tables, keys and defaults, all numbers f64.
//! `scene.rs` checks the values.

use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, MapAccess, Visitor};
use serde::{Deserialize, Serialize};

use crate::error::{Error, one_line};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    #[serde(default = "earth")]
    pub gravity: Vector,
    pub time: Time,
    #[serde(default)]
    pub budget: Budget,
    #[serde(default)]
    pub solver: Solver,
    #[serde(default)]
    pub body: Vec<Body>,
    #[serde(default)]
    pub collider: Vec<Collider>,
    #[serde(default)]
    pub pressure: Vec<Pressure>,
    #[serde(default)]
    pub wind: Vec<Wind>,
    pub contact: Option<Contact>,
    #[serde(default)]
    pub rigid: Vec<RigidBody>,
    #[serde(default)]
    pub attachment: Vec<Attachment>,
    #[serde(default)]
    pub spring: Vec<Spring>,
}

/// Makes one system of all bodies, in which they touch.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Contact {
    pub friction: f64,
    pub capacity: u32,
    pub edges: bool,
}

impl Default for Contact {
    fn default() -> Self {
        Contact {
            friction: 0.0,
            capacity: 256,
            edges: false,
        }
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RigidBody {
    pub ball: Option<Ball>,
    #[serde(rename = "box")]
    pub cuboid: Option<Vector>,
    pub mass: f64,
    pub friction: Option<f64>,
    pub rotate: Option<Rotate>,
    #[serde(default)]
    pub translate: Vector,
    #[serde(default)]
    pub velocity: Vector,
    #[serde(default)]
    pub angular_velocity: Vector,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ball {
    pub radius: f64,
}

/// A place on a soft or a rigid body.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct End {
    pub body: Option<usize>,
    pub rigid: Option<usize>,
    pub point: Vector,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Attachment {
    pub a: End,
    pub b: End,
    pub stiffness: Option<f64>,
    pub damping: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spring {
    pub from: End,
    pub target: Vector,
    #[serde(default)]
    pub velocity: Vector,
    pub stiffness: f64,
    #[serde(default)]
    pub damping: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Time {
    pub dt: f64,
    pub steps: u32,
    #[serde(default = "one")]
    pub theta: f64,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct Budget {
    pub iterations: u32,
    pub polar_sweeps: u32,
    pub substeps: u32,
}

impl Default for Budget {
    fn default() -> Self {
        Budget {
            iterations: 5,
            polar_sweeps: 2,
            substeps: 1,
        }
    }
}

#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct Solver {
    pub preconditioner: String,
    pub start: String,
    pub layout: String,
    pub energy_guard: bool,
}

impl Default for Solver {
    fn default() -> Self {
        Solver {
            preconditioner: "jacobi".into(),
            start: "galerkin-1".into(),
            layout: "factored".into(),
            energy_guard: true,
        }
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Body {
    pub mesh: MeshSource,
    pub young: f64,
    pub poisson: f64,
    pub density: f64,
    #[serde(default)]
    pub alpha: f64,
    #[serde(default)]
    pub beta: f64,
    /// On other bodies; needs `[contact]`.
    pub friction: Option<f64>,
    #[serde(default = "one")]
    pub scale: f64,
    pub rotate: Option<Rotate>,
    #[serde(default)]
    pub translate: Vector,
    #[serde(default = "ones")]
    pub stretch: Vector,
    #[serde(default)]
    pub velocity: Vector,
    #[serde(default)]
    pub angular_velocity: Vector,
    #[serde(default)]
    pub pin: Vec<Pin>,
    pub fibre: Option<Fibre>,
    #[serde(default)]
    pub material: Vec<Material>,
    pub plasticity: Option<Plasticity>,
    pub fracture: Option<Fracture>,
}

/// Of what is not said, the body's.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    #[serde(rename = "box")]
    pub corners: Option<Corners>,
    pub sphere: Option<Sphere>,
    pub volume: Option<i32>,
    pub young: Option<f64>,
    pub poisson: Option<f64>,
    pub density: Option<f64>,
    pub fibre: Option<Fibre>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fibre {
    pub direction: Vector,
    pub young: f64,
    pub shear: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plasticity {
    pub yield_strain: f64,
    #[serde(default = "one")]
    pub limit: f64,
    #[serde(default)]
    pub relaxation: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fracture {
    pub strength: f64,
    #[serde(default = "four")]
    pub per_step: u32,
    pub reserve: Option<u32>,
}

/// A file name, or a box cut into cells.
#[derive(Debug)]
pub enum MeshSource {
    File(String),
    Box(BoxMesh),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoxMesh {
    #[serde(rename = "box")]
    pub size: Vector,
    pub cells: Cells,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rotate {
    pub axis: Vector,
    pub degrees: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pin {
    #[serde(rename = "box")]
    pub corners: Option<Corners>,
    pub sphere: Option<Sphere>,
    #[serde(default)]
    pub velocity: Vector,
    #[serde(default)]
    pub angular_velocity: Vector,
    pub pivot: Option<Vector>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Collider {
    pub plane: Option<Plane>,
    pub sphere: Option<Sphere>,
    pub capsule: Option<Capsule>,
    #[serde(rename = "box")]
    pub cuboid: Option<Cuboid>,
    pub height_field: Option<HeightField>,
    #[serde(default)]
    pub friction: f64,
    #[serde(default)]
    pub velocity: Vector,
    #[serde(default)]
    pub angular_velocity: Vector,
    pub pivot: Option<Vector>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Capsule {
    pub from: Vector,
    pub to: Vector,
    pub radius: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cuboid {
    pub centre: Vector,
    pub size: Vector,
    pub rotate: Option<Rotate>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeightField {
    #[serde(default)]
    pub corner: Vector,
    pub spacing: Pair,
    /// A row has the heights of one x.
    pub heights: Vec<Vec<f64>>,
    pub rotate: Option<Rotate>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pressure {
    /// The body, by its place in the file.
    #[serde(default)]
    pub body: usize,
    pub pascals: f64,
    /// Of gas inside, which the volume changes.
    #[serde(default)]
    pub gas: bool,
    #[serde(default)]
    pub outside: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wind {
    /// All bodies, where it is not there.
    pub body: Option<usize>,
    pub velocity: Vector,
    #[serde(default = "air")]
    pub density: f64,
    #[serde(default = "two")]
    pub normal: f64,
    #[serde(default)]
    pub tangential: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plane {
    pub normal: Vector,
    #[serde(default)]
    pub offset: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    pub centre: Vector,
    pub radius: f64,
}

/// Exactly three numbers. (serde's own arrays take the first three of a longer list.)
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq)]
#[serde(try_from = "Vec<f64>")]
pub struct Vector(pub [f64; 3]);

impl TryFrom<Vec<f64>> for Vector {
    type Error = String;
    fn try_from(list: Vec<f64>) -> Result<Self, String> {
        exactly(list, "numbers").map(Vector)
    }
}

/// Exactly two numbers.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(try_from = "Vec<f64>")]
pub struct Pair(pub [f64; 2]);

impl TryFrom<Vec<f64>> for Pair {
    type Error = String;
    fn try_from(list: Vec<f64>) -> Result<Self, String> {
        exactly(list, "numbers").map(Pair)
    }
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(try_from = "Vec<u32>")]
pub struct Cells(pub [u32; 3]);

impl TryFrom<Vec<u32>> for Cells {
    type Error = String;
    fn try_from(list: Vec<u32>) -> Result<Self, String> {
        exactly(list, "whole numbers").map(Cells)
    }
}

/// The low and the high corner of a box.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(try_from = "Vec<Vector>")]
pub struct Corners(pub [[f64; 3]; 2]);

impl TryFrom<Vec<Vector>> for Corners {
    type Error = String;
    fn try_from(list: Vec<Vector>) -> Result<Self, String> {
        exactly(list, "corners").map(|corners: [Vector; 2]| Corners(corners.map(|c| c.0)))
    }
}

fn exactly<T, const N: usize>(list: Vec<T>, what: &str) -> Result<[T; N], String> {
    <[T; N]>::try_from(list).map_err(|list| format!("expected {N} {what}, found {}", list.len()))
}

impl<'de> Deserialize<'de> for MeshSource {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Source;
        impl<'de> Visitor<'de> for Source {
            type Value = MeshSource;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a file name or { box = [..], cells = [..] }")
            }
            fn visit_str<E>(self, name: &str) -> Result<MeshSource, E> {
                Ok(MeshSource::File(name.into()))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MeshSource, A::Error> {
                BoxMesh::deserialize(MapAccessDeserializer::new(map)).map(MeshSource::Box)
            }
        }
        deserializer.deserialize_any(Source)
    }
}

fn earth() -> Vector {
    Vector([0.0, -9.81, 0.0])
}

fn one() -> f64 {
    1.0
}

fn four() -> u32 {
    4
}

fn two() -> f64 {
    2.0
}

fn air() -> f64 {
    1.2
}

fn ones() -> Vector {
    Vector([1.0; 3])
}

/// Reads the text of a scene file; `file` is its name for messages.
pub fn parse(file: &str, text: &str) -> Result<SceneFile, Error> {
    let wrong = |error: toml::de::Error, key: String| Error::Scene {
        file: file.into(),
        what: describe(&error, &key, text),
    };
    let deserializer = toml::Deserializer::parse(text).map_err(|e| wrong(e, String::new()))?;
    serde_path_to_error::deserialize(deserializer).map_err(|e| {
        let key = key_of(e.path());
        wrong(e.into_inner(), key)
    })
}

/// The path of a key as it is written in messages: `body[0].pin[1].box`.
fn key_of(path: &serde_path_to_error::Path) -> String {
    let key = path.to_string();
    if key == "." { String::new() } else { key }
}

/// Where, the line itself (which holds the key and the value), and what is wrong with it.
fn describe(error: &toml::de::Error, key: &str, text: &str) -> String {
    let mut what = String::new();
    if let Some(span) = error.span() {
        let before = &text[..span.start.min(text.len())];
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
        what += &format!("line {line}, column {column}: ");
        let written = text.lines().nth(line - 1).unwrap_or("").trim();
        if !written.is_empty() {
            what += &format!("`{}`: ", shorten(written, 120));
        }
    }
    if !key.is_empty() {
        what += &format!("{key}: ");
    }
    what + &one_line(error.message())
}

fn shorten(text: &str, limit: usize) -> String {
    if text.chars().count() <= limit {
        return text.into();
    }
    text.chars().take(limit).chain("...".chars()).collect()
}
