//! What is made of a scene before its first step: settings, rest data, factors.

use femto::element::{Dense, Factored};
use femto::material::{Material, MaterialError, Regions};
use femto::mesh::{Mesh, MeshError};
use femto::order::fans;
use femto::owned::OwnedRest;
use femto::settings::{Budget, Preconditioner, Settings, SettingsError, Start};

use femto_bake::{FactorOptions, Kind, OwnedFactor, RestStiffness, factor};

use crate::coupled;
use crate::error::Error;
use crate::material::{Substance, Substances};
use crate::scene::{self, Body, Scene};

/// The settings, but for factors.
pub fn settings(scene: &Scene) -> Result<Settings<'static>, Error> {
    let start = match scene.start {
        scene::Start::Zero => Start::Zero,
        scene::Start::Velocity => Start::Velocity,
        scene::Start::VelocityForce => Start::VelocityForce,
        scene::Start::Galerkin(m) => Start::Galerkin(m),
        scene::Start::Rigid(m) => Start::Rigid(m),
    };
    let preconditioner = match scene.preconditioner {
        scene::Preconditioner::Identity => Preconditioner::Identity,
        scene::Preconditioner::Mass => Preconditioner::Mass,
        // With aggregates, body by body.
        scene::Preconditioner::BlockJacobi | scene::Preconditioner::TwoLevel => {
            Preconditioner::BlockJacobi
        }
        // A body's factor takes the place of it.
        scene::Preconditioner::Jacobi | scene::Preconditioner::Factored(_) => {
            Preconditioner::Jacobi
        }
    };
    let budget = Budget {
        iterations: scene.budget.iterations,
        polar_sweeps: scene.budget.polar_sweeps,
    };
    let settings = Settings::new(scene.substep as f32).and_then(|s| s.with_theta(scene.theta));
    let settings = settings.map_err(|e| {
        let key = match e {
            SettingsError::Theta(_) => "time.theta",
            _ => "time.dt / budget.substeps",
        };
        Error::Value {
            file: scene.file.clone(),
            key: key.into(),
            value: format!("{:?}", scene.substep),
            why: e.to_string(),
        }
    })?;
    let settings = settings
        .with_budget(budget)
        .with_start(start)
        .with_preconditioner(preconditioner);
    Ok(if scene.solver.energy_guard {
        settings.with_energy_guard()
    } else {
        settings
    })
}

pub fn material(body: &Body) -> Result<Material, MaterialError> {
    Material::new(body.young, body.poisson, body.density)?.with_damping(body.alpha, body.beta)
}

/// A layout that a body can be built in.
pub trait Build: RestStiffness {
    /// Rest data of a mesh whose tets are in the order that `original` numbers in the body's.
    fn build(
        mesh: &Mesh<'_>,
        materials: &Regions<'_>,
        substances: &Substances,
        original: &[usize],
    ) -> Result<OwnedRest<Self>, MeshError>;
}

/// Of bodies without fibres.
impl Build for Factored {
    fn build(
        mesh: &Mesh<'_>,
        materials: &Regions<'_>,
        _: &Substances,
        _: &[usize],
    ) -> Result<OwnedRest<Self>, MeshError> {
        OwnedRest::new(mesh, materials)
    }
}

impl Build for Dense {
    fn build(
        mesh: &Mesh<'_>,
        materials: &Regions<'_>,
        substances: &Substances,
        original: &[usize],
    ) -> Result<OwnedRest<Self>, MeshError> {
        if substances.has_fibres() {
            let elasticity = |tet: usize| substances.elasticity(original[tet]);
            OwnedRest::anisotropic(mesh, materials, elasticity)
        } else {
            OwnedRest::new(mesh, materials)
        }
    }
}

/// The materials of a body.
pub fn materials(scene: &Scene, body: &Body) -> Result<Vec<Material>, Error> {
    let of = |part: &Substance| {
        let material = Material::new(part.young, part.poisson, part.density)
            .and_then(|material| material.with_damping(body.alpha, body.beta));
        material.map_err(|e| {
            let (key, value) = match e {
                MaterialError::Young(x) => ("young", x),
                MaterialError::Poisson(x) => ("poisson", x),
                MaterialError::Alpha(x) => ("alpha", x),
                MaterialError::Beta(x) => ("beta", x),
                MaterialError::Density(x) => ("density", x),
                _ => ("young", part.young),
            };
            Error::Value {
                file: scene.file.clone(),
                key: format!("{}.{key}", part.key),
                value: format!("{value:?}"),
                why: e.to_string(),
            }
        })
    };
    body.substances.list.iter().map(of).collect()
}

/// Says which body's mesh is wrong.
pub fn bad_mesh(scene: &Scene, index: usize, how: &str, error: MeshError) -> Error {
    Error::Value {
        file: scene.file.clone(),
        key: format!("body[{index}].mesh"),
        value: scene.bodies[index].source.clone(),
        why: format!("{how}{error}"),
    }
}

/// The mesh itself has been checked: what is wrong here, its place has done.
pub fn check_placed(scene: &Scene, index: usize) -> Result<(), Error> {
    let body = &scene.bodies[index];
    let placed = Mesh::new(&body.rest, &body.tets);
    placed.map_err(|e| bad_mesh(scene, index, "placed and rounded to f32: ", e))?;
    Ok(())
}

/// The rest data of a body of the scene.
pub fn rest<L: Build>(scene: &Scene, index: usize) -> Result<OwnedRest<L>, Error> {
    let body = &scene.bodies[index];
    let materials = materials(scene, body)?;
    let mesh = |e: MeshError| bad_mesh(scene, index, "", e);
    check_placed(scene, index)?;
    let ordered = fans(&body.tets);
    let checked = Mesh::new(&body.rest, &ordered.tets).map_err(mesh)?;
    let of: Vec<u16> = ordered
        .original
        .iter()
        .map(|&tet| body.substances.of[tet])
        .collect();
    let regions = Regions {
        materials: &materials,
        of: &of,
    };
    let built = L::build(&checked, &regions, &body.substances, &ordered.original);
    built.map_err(|e| match e {
        // As the file counts.
        MeshError::OutOfScale { tet } => mesh(MeshError::OutOfScale {
            tet: ordered
                .original
                .get(tet as usize)
                .map_or(tet, |&t| t as u32),
        }),
        _ => mesh(e),
    })
}

/// Factors a body of the scene, with its pinned nodes held, for a substep of the scene.
pub fn factor_of<L: RestStiffness>(
    scene: &Scene,
    index: usize,
    rest: &OwnedRest<L>,
    options: FactorOptions,
) -> Result<OwnedFactor, Error> {
    let held = scene.bodies[index].pins.iter().map(|pin| pin.0).collect();
    factored(scene, &format!("body[{index}]"), rest, held, options)
}

fn factored<L: RestStiffness>(
    scene: &Scene,
    what: &str,
    rest: &OwnedRest<L>,
    held: Vec<u32>,
    options: FactorOptions,
) -> Result<OwnedFactor, Error> {
    let options = FactorOptions { held, ..options };
    let name = match options.kind {
        Kind::Warped => "warped",
        Kind::Laplacian => "laplacian",
    };
    factor(&rest.view(), &settings(scene)?, &options).map_err(|e| Error::Value {
        file: scene.file.clone(),
        key: "solver.preconditioner".into(),
        value: format!("{name:?}"),
        why: format!("{what} cannot be factored: {e}"),
    })
}

/// The factors of a scene's bodies, or of the one system that they are; none where it asks for none.
pub struct Factors(pub Vec<Option<OwnedFactor>>);

impl Factors {
    /// In single precision, all entries kept.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        let scene::Preconditioner::Factored(kind) = scene.preconditioner else {
            return Ok(Self((0..scene.systems()).map(|_| None).collect()));
        };
        let options = || FactorOptions {
            kind,
            ..FactorOptions::default()
        };
        if let Some(coupled) = &scene.coupled {
            let held = scene.all_pins().map(|pin| pin.0).collect();
            let what = "the system of all bodies";
            let factor = if scene.has_fibres() {
                let (_, rest) = coupled::joint::<Dense>(scene, coupled)?;
                factored(scene, what, &rest, held, options())?
            } else {
                let (_, rest) = coupled::joint::<Factored>(scene, coupled)?;
                factored(scene, what, &rest, held, options())?
            };
            return Ok(Self(vec![Some(factor)]));
        }
        let one = |index: usize| {
            let made = if scene.bodies[index].substances.has_fibres() {
                factor_of(scene, index, &rest::<Dense>(scene, index)?, options())
            } else {
                factor_of(scene, index, &rest::<Factored>(scene, index)?, options())
            };
            made.map(Some)
        };
        (0..scene.bodies.len())
            .map(one)
            .collect::<Result<_, _>>()
            .map(Self)
    }
}
