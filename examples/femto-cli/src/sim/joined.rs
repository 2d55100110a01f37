//! All bodies of a scene in one system.

use femto::constraint::Pin;
use femto::element::{Dense, Factored};
use femto::fracture::{Fracture, MOST_PER_STEP};
use femto::glam::Vec3;
use femto::owned::OwnedBody;
use femto::plasticity::Plasticity;
use femto::preconditioner::aggregate::{Aggregates, DEFAULT_AGGREGATES};
use femto::settings::{LawRegions, Needs, Settings};
use femto_bake::OwnedFactor;

use super::body::{Body, Kind, own_settings, with};
use super::values::Damage;
use crate::coupled::{self, Joint};
use crate::error::Error;
use crate::loads::Acting;
use crate::material::Laws;
use crate::prepare::Factors;
use crate::scene::{self, Scene};

/// The laws of the bodies of one system, by body.
pub(super) struct Regions {
    of: Vec<u16>,
    plasticity: Vec<Option<Plasticity>>,
    strength: Vec<f32>,
}

impl Regions {
    pub fn view(&self) -> LawRegions<'_> {
        LawRegions {
            of: &self.of,
            plasticity: &self.plasticity,
            strength: &self.strength,
        }
    }
}

/// What the system has in common, and what each body has of its own: as many tets may break in a step, and in all, as
/// may of the bodies together.
fn laws(scene: &Scene) -> (Laws, Option<Regions>) {
    let own = || scene.bodies.iter().map(|body| body.laws);
    let fractures = || own().filter_map(|laws| laws.fracture);
    let sum =
        |of: fn(&Fracture) -> u32| fractures().map(|law| of(&law)).fold(0, u32::saturating_add);
    let fracture = fractures().next().map(|first| {
        let places = sum(Fracture::per_step).min(MOST_PER_STEP);
        Fracture::new(first.strength(), places, sum(Fracture::reserve)).unwrap_or(first)
    });
    let laws = Laws {
        plasticity: own().find_map(|laws| laws.plasticity),
        fracture,
    };
    let regions = Regions {
        of: Vec::new(),
        plasticity: own().map(|laws| laws.plasticity).collect(),
        strength: own()
            .map(|laws| laws.fracture.map_or(f32::INFINITY, |law| law.strength()))
            .collect(),
    };
    (laws, laws.any().then_some(regions))
}

/// The system, and what joins its bodies.
pub(super) fn joined<'a>(
    scene: &Scene,
    coupled: &coupled::Coupled,
    settings: &Settings<'static>,
    factors: &'a Factors,
) -> Result<(Joint, Body<'a>), Error> {
    let (laws, mut regions) = laws(scene);
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
                    Needs::from(&own_settings(settings, None, Some(&of), laws))
                }
                false => Needs::from(&own_settings(settings, None, None, laws)),
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
    if let Some(regions) = &mut regions {
        let bodies = (0_u16..).zip(&joint.parts.parts);
        let of: Vec<u16> = bodies
            .flat_map(|(i, part)| part.tets.clone().map(move |_| i))
            .collect();
        regions.of = joint.original.iter().map(|&tet| of[tet]).collect();
    }
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
        original: match laws.any() {
            true => joint.original.clone(),
            false => Vec::new(),
        },
        damage: Damage {
            reserve_left: laws.fracture.map(|law| law.reserve()),
            ..Damage::default()
        },
        laws,
        regions,
    };
    Ok((joint, body))
}
