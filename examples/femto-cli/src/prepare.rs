//! What is made of a scene before its first step: settings, rest data, factors.

use femto::element::{Factored, Layout};
use femto::material::{Material, MaterialError};
use femto::mesh::{Mesh, MeshError};
use femto::order::fans;
use femto::owned::OwnedRest;
use femto::settings::{Budget, Preconditioner, Settings, SettingsError, Start};
use femto_bake::{FactorOptions, Kind, OwnedFactor, factor};

use crate::error::Error;
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
    Ok(settings
        .with_budget(budget)
        .with_start(start)
        .with_preconditioner(preconditioner))
}

pub fn material(body: &Body) -> Result<Material, MaterialError> {
    Material::new(body.young, body.poisson, body.density)?.with_damping(body.alpha, body.beta)
}

/// The rest data of a body of the scene.
pub fn rest<L: Layout>(scene: &Scene, index: usize) -> Result<OwnedRest<L>, Error> {
    let body = &scene.bodies[index];
    let wrong = |key: &str, value: String, why: String| Error::Value {
        file: scene.file.clone(),
        key: format!("body[{index}].{key}"),
        value,
        why,
    };
    let material = material(body).map_err(|e| {
        let (key, value) = match e {
            MaterialError::Young(x) => ("young", x),
            MaterialError::Poisson(x) => ("poisson", x),
            MaterialError::Alpha(x) => ("alpha", x),
            MaterialError::Beta(x) => ("beta", x),
            MaterialError::Density(x) => ("density", x),
            _ => ("young", body.young),
        };
        wrong(key, format!("{value:?}"), e.to_string())
    })?;
    let mesh = |e: MeshError| wrong("mesh", body.source.clone(), e.to_string());
    Mesh::new(&body.rest, &body.tets).map_err(mesh)?;
    let ordered = fans(&body.tets);
    let checked = Mesh::new(&body.rest, &ordered.tets).map_err(mesh)?;
    OwnedRest::new(&checked, &material).map_err(|e| match e {
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
pub fn factor_of(
    scene: &Scene,
    index: usize,
    rest: &OwnedRest<Factored>,
    options: FactorOptions,
) -> Result<OwnedFactor, Error> {
    let held = scene.bodies[index].pins.iter().map(|pin| pin.0).collect();
    let options = FactorOptions { held, ..options };
    let name = match options.kind {
        Kind::Warped => "warped",
        Kind::Laplacian => "laplacian",
    };
    factor(&rest.view(), &settings(scene)?, &options).map_err(|e| Error::Value {
        file: scene.file.clone(),
        key: "solver.preconditioner".into(),
        value: format!("{name:?}"),
        why: format!("body[{index}] cannot be factored: {e}"),
    })
}

/// The factors of a scene's bodies; none where it asks for none.
pub struct Factors(pub Vec<Option<OwnedFactor>>);

impl Factors {
    /// In single precision, all entries kept.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        let scene::Preconditioner::Factored(kind) = scene.preconditioner else {
            return Ok(Self(scene.bodies.iter().map(|_| None).collect()));
        };
        let one = |index| {
            let options = FactorOptions {
                kind,
                ..FactorOptions::default()
            };
            factor_of(scene, index, &rest(scene, index)?, options).map(Some)
        };
        (0..scene.bodies.len())
            .map(one)
            .collect::<Result<_, _>>()
            .map(Self)
    }
}
