//! `femto bake`: a mesh with its material and factor, as bytes to embed in a program.

use std::fmt::Write as _;
use std::fs::File;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use femto::Pin;
use femto::asset::{Asset, Metadata};
use femto::element::Factored;
use femto::glam::Vec3;
use femto_bake::{FactorOptions, Kind, OwnedFactor, Precision};

use crate::error::Error;
use crate::scene::{self, Scene};
use crate::scene_file::{self as file, Corners, Vector};
use crate::{asset_info, prepare};

#[derive(clap::Args)]
pub struct Args {
    /// The asset, by custom named .femto
    #[arg(short, long, value_name = "FILE", required_unless_present = "rust")]
    out: Option<PathBuf>,

    /// The same as Rust source: a static, and the constants that storage needs
    #[arg(long, value_name = "FILE.rs")]
    rust: Option<PathBuf>,

    /// Take a body of this scene, with its material, place, pins, time step and solver
    #[arg(long, value_name = "SCENE.toml")]
    scene: Option<PathBuf>,

    /// Which body of the scene, from 0, the default
    #[arg(long, value_name = "N")]
    body: Option<usize>,

    #[command(flatten)]
    direct: Direct,

    /// The factor to make [default: the scene's, or none]
    #[arg(long, value_enum)]
    preconditioner: Option<Choice>,

    /// How the factor's entries are stored [default: f32]
    #[arg(long, value_enum)]
    precision: Option<Stored>,

    /// Leave out entries of the factor that couple less than this; 0.005 suits large bodies
    #[arg(long, value_name = "PART", allow_hyphen_values = true)]
    drop: Option<f64>,

    /// Keep at most so many entries of the factor, the largest
    #[arg(long, value_name = "N")]
    fill: Option<usize>,
}

/// A body without a scene. Keys, units and defaults are the scene file's.
#[derive(clap::Args)]
#[group(conflicts_with = "scene")]
struct Direct {
    /// Gmsh .msh (4.1 ASCII), or TetGen .node with its .ele beside it
    #[arg(required_unless_present = "scene")]
    mesh: Option<String>,
    /// Young's modulus, Pa
    #[arg(long, required_unless_present = "scene", allow_hyphen_values = true)]
    young: Option<f64>,
    /// Poisson's ratio
    #[arg(long, required_unless_present = "scene", allow_hyphen_values = true)]
    poisson: Option<f64>,
    /// Density, kg/m³
    #[arg(long, required_unless_present = "scene", allow_hyphen_values = true)]
    density: Option<f64>,
    /// Mass-proportional damping, 1/s
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    alpha: f64,
    /// Stiffness-proportional damping, s
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    beta: f64,
    /// Time step, s
    #[arg(long, required_unless_present = "scene", allow_hyphen_values = true)]
    dt: Option<f64>,
    /// 1 backward Euler, 0.5 implicit Newmark
    #[arg(long, default_value_t = 1.0, allow_hyphen_values = true)]
    theta: f64,
    /// Iterations a step, as a suggestion to the program
    #[arg(long, default_value_t = file::Budget::default().iterations)]
    iterations: u32,
    /// Polar sweeps a step, as a suggestion to the program
    #[arg(long, default_value_t = file::Budget::default().polar_sweeps)]
    polar_sweeps: u32,
    /// Start of the solver, as a suggestion to the program
    #[arg(long, default_value_t = file::Solver::default().start)]
    start: String,
    /// Scale the mesh
    #[arg(long, default_value_t = 1.0, allow_hyphen_values = true)]
    scale: f64,
    /// Then rotate it about the origin
    #[arg(long, value_name = "X,Y,Z,DEGREES", value_parser = list::<4>, allow_hyphen_values = true)]
    rotate: Option<[f64; 4]>,
    /// Then move it
    #[arg(long, value_name = "X,Y,Z", value_parser = list::<3>, allow_hyphen_values = true)]
    translate: Option<[f64; 3]>,
    /// Hold the nodes in a box; may be given several times
    #[arg(long, value_name = "LOW_X,Y,Z,HIGH_X,Y,Z", value_parser = list::<6>, allow_hyphen_values = true)]
    pin_box: Vec<[f64; 6]>,
    /// Hold the nodes in a sphere; may be given several times
    #[arg(long, value_name = "X,Y,Z,RADIUS", value_parser = list::<4>, allow_hyphen_values = true)]
    pin_sphere: Vec<[f64; 4]>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Choice {
    None,
    Warped,
    Laplacian,
}

#[derive(Clone, Copy, ValueEnum)]
enum Stored {
    F32,
    F16,
}

fn list<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|x| x.trim().parse()).collect();
    let numbers = numbers.map_err(|_| format!("must be {N} numbers with commas between"))?;
    let given = numbers.len();
    <[f64; N]>::try_from(numbers).map_err(|_| format!("must be {N} numbers, found {given}"))
}

/// Returns the exit status.
pub fn command(args: &Args) -> Result<u8, Error> {
    let (scene, body) = match (&args.scene, args.body) {
        (Some(path), body) => (scene::load(path)?, body.unwrap_or(0)),
        (None, None) => (args.direct.scene().map_err(as_option)?, 0),
        (None, Some(body)) => {
            return Err(Error::Option {
                option: "--body",
                value: body.to_string(),
                why: "there are no bodies without --scene".into(),
            });
        }
    };
    let soft = scene.soft_bodies();
    if body >= soft {
        return Err(Error::Option {
            option: "--body",
            value: body.to_string(),
            why: match soft {
                1 => "the scene has one body, 0".into(),
                _ => format!("the scene has {soft} bodies, from 0"),
            },
        });
    }
    if scene.layout != scene::Layout::Factored {
        return Err(Error::Value {
            file: scene.file.clone(),
            key: "solver.layout".into(),
            value: format!("{:?}", scene.solver.layout),
            why: "assets have the factored layout".into(),
        });
    }
    if scene.bodies[body].substances.has_fibres() {
        return Err(Error::Scene {
            file: scene.file.clone(),
            what: format!("body[{body}]: has fibres, and assets have the factored layout"),
        });
    }
    let options = factor_options(args, &scene)?;
    let bytes = bake(&scene, body, options).map_err(|e| match args.scene {
        Some(_) => e,
        None => as_option(e),
    })?;
    let source = args
        .rust
        .as_ref()
        .map(|_| rust_source(&bytes))
        .transpose()?;
    if let (Some(path), Some(source)) = (&args.rust, source) {
        write("--rust", path, source.as_bytes())?;
    }
    if let Some(path) = &args.out {
        write("--out", path, &bytes)?;
    }
    let name = args.out.as_ref().or(args.rust.as_ref());
    let name = name.map(|path| path.display().to_string());
    crate::print(&asset_info::describe(&name.unwrap_or_default(), &bytes)?);
    Ok(0)
}

impl Direct {
    fn scene(&self) -> Result<Scene, Error> {
        let sphere = |&[x, y, z, radius]: &[f64; 4]| file::Pin {
            corners: None,
            sphere: Some(file::Sphere {
                centre: Vector([x, y, z]),
                radius,
            }),
            velocity: Vector::default(),
            angular_velocity: Vector::default(),
            pivot: None,
        };
        let cuboid = |&[a, b, c, d, e, f]: &[f64; 6]| file::Pin {
            corners: Some(Corners([[a, b, c], [d, e, f]])),
            sphere: None,
            velocity: Vector::default(),
            angular_velocity: Vector::default(),
            pivot: None,
        };
        let rotate = |[x, y, z, degrees]: [f64; 4]| file::Rotate {
            axis: Vector([x, y, z]),
            degrees,
        };
        // What is required is there: the command line was checked for it.
        let body = file::Body {
            mesh: file::MeshSource::File(self.mesh.clone().unwrap_or_default()),
            young: self.young.unwrap_or_default(),
            poisson: self.poisson.unwrap_or_default(),
            density: self.density.unwrap_or_default(),
            alpha: self.alpha,
            beta: self.beta,
            friction: None,
            scale: self.scale,
            rotate: self.rotate.map(rotate),
            translate: Vector(self.translate.unwrap_or_default()),
            stretch: Vector([1.0; 3]),
            velocity: Vector::default(),
            angular_velocity: Vector::default(),
            pin: self
                .pin_box
                .iter()
                .map(cuboid)
                .chain(self.pin_sphere.iter().map(sphere))
                .collect(),
            fibre: None,
            material: Vec::new(),
            plasticity: None,
            fracture: None,
        };
        let raw = file::SceneFile {
            gravity: Vector::default(),
            time: file::Time {
                dt: self.dt.unwrap_or_default(),
                steps: 0,
                theta: self.theta,
            },
            budget: file::Budget {
                iterations: self.iterations,
                polar_sweeps: self.polar_sweeps,
                substeps: 1,
            },
            solver: file::Solver {
                start: self.start.clone(),
                ..file::Solver::default()
            },
            body: vec![body],
            pressure: Vec::new(),
            wind: Vec::new(),
            collider: Vec::new(),
            contact: None,
            rigid: Vec::new(),
            attachment: Vec::new(),
            spring: Vec::new(),
        };
        scene::check("command line", raw, &mut PathBuf::new())
    }
}

/// Calls the key of a scene by the option that gave it.
fn as_option(error: Error) -> Error {
    let Error::Value {
        file,
        key,
        value,
        why,
    } = error
    else {
        return error;
    };
    let names: Vec<&str> = key
        .split([' ', '.', '[', ']'])
        .filter(|name| !name.is_empty())
        .collect();
    let key = match names.as_slice() {
        ["body", _, "mesh", ..] => "MESH".into(),
        ["body", _, "pin", _, shape, ..] => format!("--pin-{shape}"),
        ["body", _, name, ..] | [_, name, ..] => format!("--{}", name.replace('_', "-")),
        _ => key,
    };
    Error::Value {
        file,
        key,
        value,
        why,
    }
}

/// What factor to make; `None` for none.
fn factor_options(args: &Args, scene: &Scene) -> Result<Option<FactorOptions>, Error> {
    let kind = match (args.preconditioner, scene.preconditioner) {
        (Some(Choice::Warped), _) => Some(Kind::Warped),
        (Some(Choice::Laplacian), _) => Some(Kind::Laplacian),
        (None, scene::Preconditioner::Factored(kind)) => Some(kind),
        _ => None,
    };
    let wrong = |option, value: String, why: &str| Error::Option {
        option,
        value,
        why: why.into(),
    };
    let precision = args.precision.map(|precision| match precision {
        Stored::F32 => (Precision::Single, "f32"),
        Stored::F16 => (Precision::Half, "f16"),
    });
    if let Some(drop) = args.drop.filter(|drop| !(drop.is_finite() && *drop >= 0.0)) {
        return Err(wrong(
            "--drop",
            drop.to_string(),
            "must be finite and not negative",
        ));
    }
    let Some(kind) = kind else {
        let unused = [
            ("--precision", precision.map(|(_, name)| name.to_string())),
            ("--drop", args.drop.map(|drop| drop.to_string())),
            ("--fill", args.fill.map(|fill| fill.to_string())),
        ];
        let first = unused
            .into_iter()
            .find_map(|(option, value)| Some((option, value?)));
        return first.map_or(Ok(None), |(option, value)| {
            Err(wrong(
                option,
                value,
                "there is no factor without --preconditioner",
            ))
        });
    };
    Ok(Some(FactorOptions {
        kind,
        precision: precision.map_or(Precision::Single, |(precision, _)| precision),
        drop: args.drop.unwrap_or(0.0),
        fill: args.fill,
        ..FactorOptions::default()
    }))
}

/// The bytes of one body of a scene.
fn bake(scene: &Scene, index: usize, options: Option<FactorOptions>) -> Result<Vec<u8>, Error> {
    let body = &scene.bodies[index];
    let rest = prepare::rest::<Factored>(scene, index)?;
    let factor = options
        .map(|options| prepare::factor_of(scene, index, &rest, options))
        .transpose()?;
    let pins: Vec<Pin> = body
        .pins
        .iter()
        .map(|&(node, velocity)| Pin {
            node,
            velocity: Vec3::from_array(velocity),
        })
        .collect();
    let wrong = |why: String| Error::Value {
        file: scene.file.clone(),
        key: format!("body[{index}].mesh"),
        value: body.source.clone(),
        why,
    };
    if !body.carried.is_empty() {
        return Err(wrong(
            "has pins that turn; an asset holds pins with a velocity".into(),
        ));
    }
    let asset = Asset {
        rest: rest.view(),
        factor: factor.as_ref().map(OwnedFactor::view),
        pins: &pins,
        metadata: Metadata {
            source: body.source.trim_matches('"'),
            material: prepare::material(body).map_err(|e| wrong(e.to_string()))?,
            settings: prepare::settings(scene)?,
        },
    };
    let bytes = asset.to_bytes().map_err(|e| wrong(e.to_string()))?;
    Ok(bytes.to_vec())
}

/// All of it or nothing.
fn write(option: &'static str, path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let written = File::create(path).and_then(|mut file| {
        file.write_all(bytes).inspect_err(|_| {
            if path.is_file() {
                // The error to tell is the first.
                let _ = std::fs::remove_file(path);
            }
        })
    });
    written.map_err(|e| Error::Option {
        option,
        value: path.display().to_string(),
        why: format!("cannot be written: {e}"),
    })
}

/// The asset as a module: sizes, and the bytes in an aligned static.
fn rust_source(bytes: &[u8]) -> Result<String, Error> {
    const PER_LINE: usize = 22;
    let version = env!("CARGO_PKG_VERSION");
    let mut text = format!("//! Made by `femto bake` {version}.\n//!\n//! ```text\n");
    for line in asset_info::describe("it holds", bytes)?.lines() {
        let _ = writeln!(text, "//! {}", line.trim_end());
    }
    let size = femto::asset::capacity(bytes);
    let _ = write!(
        text,
        "//! ```\n\n\
         /// Nodes, for the storage of state and workspace.\n\
         pub const NODES: usize = {};\n\
         /// Blocks of eight tetrahedra, for the storage of state and workspace.\n\
         pub const BLOCKS: usize = {};\n\n\
         /// For `femto::Asset::new`.\n\
         pub static BYTES: &[u8] = &ALIGNED.0;\n\n\
         #[rustfmt::skip]\n\
         static ALIGNED: &femto::asset::Aligned<[u8]> = &femto::asset::Aligned(*b\"\\\n",
        size.nodes, size.blocks
    );
    for line in bytes.chunks(PER_LINE) {
        for byte in line {
            let _ = write!(text, "\\x{byte:02x}");
        }
        text += "\\\n";
    }
    text += "\");\n";
    Ok(text)
}
