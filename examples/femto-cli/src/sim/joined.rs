//! All bodies of a scene in one system.

use femto::constraint::Pin;
use femto::element::{Dense, Factored};
use femto::glam::Vec3;
use femto::owned::OwnedBody;
use femto::preconditioner::aggregate::{Aggregates, DEFAULT_AGGREGATES};
use femto::settings::{Needs, Settings};
use femto_bake::OwnedFactor;

use super::{Body, Damage, Kind, own_settings};
use crate::coupled::{self, Joint};
use crate::error::Error;
use crate::loads::Acting;
use crate::material::Laws;
use crate::prepare::Factors;
use crate::scene::{self, Scene};

/// The system, and what joins its bodies.
pub(super) fn joined<'a>(
    scene: &Scene,
    coupled: &coupled::Coupled,
    settings: &Settings<'static>,
    factors: &'a Factors,
) -> Result<(Joint, Body<'a>), Error> {
    let mut of = vec![0; scene.bodies.iter().map(|b| b.x.len()).sum()];
    let aggregated = scene.preconditioner == scene::Preconditioner::TwoLevel;
    let wrong = |why: String| Error::Value {
        file: scene.file.clone(),
        key: "body".into(),
        value: format!("{} in one system", scene.bodies.len()),
        why,
    };
    macro_rules! make {
        ($layout:ty, $kind:path) => {{
            let (joint, rest) = coupled::joint::<$layout>(scene, coupled)?;
            let needs = match aggregated {
                true => {
                    Aggregates::divide(&rest.view(), DEFAULT_AGGREGATES, &mut of)
                        .map_err(|e| wrong(e.to_string()))?;
                    Needs::from(&own_settings(settings, None, Some(&of), Laws::default()))
                }
                false => Needs::from(settings),
            };
            (joint, $kind(Box::new(OwnedBody::from_rest(rest, needs))))
        }};
    }
    // Fibres anywhere take the dense layout.
    let dense = scene.layout == scene::Layout::Dense || scene.has_fibres();
    let (joint, mut kind) = match dense {
        false => make!(Factored, Kind::Factored),
        true => make!(Dense, Kind::Dense),
    };
    let all = |of: fn(&scene::Body) -> &Vec<[f32; 3]>| {
        scene
            .bodies
            .iter()
            .flat_map(of)
            .copied()
            .collect::<Vec<_>>()
    };
    let (x, v) = (all(|b| &b.x), all(|b| &b.v));
    with!(&mut kind, built => built.place(&x, &v)).map_err(|e| wrong(e.to_string()))?;
    let pins = scene.all_pins().map(|(node, v)| Pin {
        node,
        velocity: Vec3::from_array(v),
    });
    let body = Body {
        kind,
        pins: pins.collect(),
        factor: factors
            .0
            .first()
            .and_then(Option::as_ref)
            .map(OwnedFactor::view),
        aggregates: aggregated.then_some(of),
        acting: Acting::new(&scene.loads, scene.bodies.iter().enumerate()).map_err(wrong)?,
        laws: Laws::default(),
        original: Vec::new(),
        damage: Damage::default(),
    };
    Ok((joint, body))
}
