//! A system that the library steps as one: a body of the scene, or all of them joined.

use femto::constraint::Pin;
use femto::element::{Dense, Factored};
use femto::glam::Vec3;
use femto::order::fans;
use femto::owned::OwnedBody;
use femto::preconditioner::Factor;
use femto::preconditioner::aggregate::{Aggregates, DEFAULT_AGGREGATES};
use femto::settings::{Needs, Preconditioner, Settings};
use femto_bake::OwnedFactor;

use super::joined::Regions;
use super::values::Damage;
use crate::error::Error;
use crate::loads::Acting;
use crate::material::Laws;
use crate::prepare::{self, Build};
use crate::scene::{self, Scene};

pub(super) struct Body<'a> {
    pub kind: Kind,
    pub pins: Vec<Pin>,
    pub acting: Acting,
    pub factor: Option<Factor<'a>>,
    /// The aggregate of each node, for the two-level preconditioner.
    pub aggregates: Option<Vec<u8>>,
    pub laws: Laws,
    /// Those of the bodies of one system.
    pub regions: Option<Regions>,
    /// Of bodies that yield or break: the scene's number of every tet of the library's.
    pub original: Vec<usize>,
    /// What plastic flow took so far, J, and what broke.
    pub damage: Damage,
}

/// One of the two layouts.
pub(super) enum Kind {
    Factored(Box<OwnedBody<Factored>>),
    Dense(Box<OwnedBody<Dense>>),
}

/// Calls a method of the library's body, whatever its layout.
macro_rules! with {
    ($kind:expr, $body:ident => $call:expr) => {
        match $kind {
            $crate::sim::body::Kind::Factored($body) => $call,
            $crate::sim::body::Kind::Dense($body) => $call,
        }
    };
}
pub(super) use with;

impl<'a> Body<'a> {
    /// Body `i` of the scene, by itself.
    pub fn new(
        scene: &Scene,
        i: usize,
        settings: &Settings<'static>,
        factor: Option<&'a OwnedFactor>,
    ) -> Result<Self, Error> {
        let body = &scene.bodies[i];
        let wrong = |key: &str, why: String| Error::Value {
            file: scene.file.clone(),
            key: key.into(),
            value: body.source.clone(),
            why,
        };
        let aggregated = scene.preconditioner == scene::Preconditioner::TwoLevel;
        let mut aggregates = aggregated.then(|| vec![0; body.rest.len()]);
        let of = aggregates.as_deref_mut();
        // Fibres take the dense layout.
        let dense = scene.layout == scene::Layout::Dense || body.substances.has_fibres();
        let mut kind = match dense {
            false => Kind::Factored(built(scene, i, settings, of)?),
            true => Kind::Dense(built(scene, i, settings, of)?),
        };
        with!(&mut kind, built => built.place(&body.x, &body.v))
            .map_err(|e| wrong(&format!("body[{i}].mesh"), e.to_string()))?;
        let pin = |&(node, v): &(u32, [f32; 3])| Pin {
            node,
            velocity: Vec3::from_array(v),
        };
        Ok(Body {
            kind,
            pins: body.pins.iter().map(pin).collect(),
            acting: Acting::new(&scene.loads, [(i, body)].into_iter())
                .map_err(|why| wrong(&format!("body[{i}]"), why))?,
            factor: factor.map(OwnedFactor::view),
            aggregates,
            laws: body.laws,
            regions: None,
            original: match body.laws.any() {
                true => fans(&body.tets).original,
                false => Vec::new(),
            },
            damage: Damage {
                reserve_left: body.laws.fracture.map(|law| law.reserve()),
                ..Damage::default()
            },
        })
    }
}

fn built<L: Build>(
    scene: &Scene,
    body: usize,
    settings: &Settings<'static>,
    aggregates: Option<&mut [u8]>,
) -> Result<Box<OwnedBody<L>>, Error> {
    let rest = prepare::rest::<L>(scene, body)?;
    let laws = scene.bodies[body].laws;
    let needs = match aggregates {
        Some(of) => {
            Aggregates::divide(&rest.view(), DEFAULT_AGGREGATES, of).map_err(|e| Error::Value {
                file: scene.file.clone(),
                key: format!("body[{body}].mesh"),
                value: scene.bodies[body].source.clone(),
                why: e.to_string(),
            })?;
            Needs::from(&own_settings(settings, None, Some(of), laws))
        }
        None => Needs::from(&own_settings(settings, None, None, laws)),
    };
    Ok(Box::new(OwnedBody::from_rest(rest, needs)))
}

/// The scene's settings with what is a body's own of the preconditioner.
pub(super) fn own_settings<'a>(
    settings: &Settings<'static>,
    factor: Option<&'a Factor<'a>>,
    aggregates: Option<&'a [u8]>,
    laws: Laws,
) -> Settings<'a> {
    let mut settings: Settings<'a> = *settings;
    (settings.plasticity, settings.fracture) = (laws.plasticity, laws.fracture);
    let coarse = aggregates.map(|of| {
        let aggregates = Aggregates::new(of, DEFAULT_AGGREGATES);
        Preconditioner::TwoLevel(aggregates.expect("made by the library"))
    });
    let own = factor.map(Preconditioner::Factored).or(coarse);
    settings.with_preconditioner(own.unwrap_or(settings.preconditioner))
}
