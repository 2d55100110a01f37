//! What bodies are made of: materials by region, fibres, plastic flow and fracture, checked.

use femto::elasticity::{Elasticity, ElasticityError, Fibres, Orthotropic};
use femto::fracture::{Fracture, FractureError, MOST_PER_STEP};
use femto::plasticity::{Plasticity, PlasticityError};
use glam::DVec3;

use crate::error::Error;
use crate::mesh::Mesh;
use crate::place::{Placing, region};
use crate::scene::Checker;
use crate::scene_file as file;

/// A material, where it is written, and its elasticity where it has fibres.
#[derive(Clone, Debug)]
pub struct Substance {
    /// `body[0]`, or `body[0].material[1]`.
    pub key: String,
    pub young: f32,
    pub poisson: f32,
    pub density: f32,
    pub fibres: Option<Elasticity>,
}

/// The materials of a body, and which of them each tet is made of. The first is the body's own.
#[derive(Clone, Debug)]
pub struct Substances {
    pub list: Vec<Substance>,
    pub of: Vec<u16>,
}

impl Substances {
    pub fn new(
        check: &Checker,
        key: &str,
        raw: &file::Body,
        mesh: &Mesh,
        placing: &Placing,
        placed: &[DVec3],
    ) -> Result<Self, Error> {
        let own = substance(
            check,
            key,
            placing,
            (raw.young, raw.poisson, raw.density),
            raw.fibre.as_ref(),
        )?;
        let mut list = vec![own];
        let mut of = vec![0; mesh.tets.len()];
        for (i, part) in raw.material.iter().enumerate() {
            let key = format!("{key}.material[{i}]");
            let constants = (
                part.young.unwrap_or(raw.young),
                part.poisson.unwrap_or(raw.poisson),
                part.density.unwrap_or(raw.density),
            );
            let fibre = part.fibre.as_ref().or(raw.fibre.as_ref());
            list.push(substance(check, &key, placing, constants, fibre)?);
            let place = u16::try_from(i + 1)
                .map_err(|_| check.wrong(&key, &i, "a body has at most 65535 of them"))?;
            let chosen = chosen(check, &key, part, mesh, placed)?;
            chosen.into_iter().for_each(|tet| of[tet] = place);
        }
        Ok(Self { list, of })
    }

    /// Appends those of another body.
    pub fn add(&mut self, other: &Self) {
        let first = u16::try_from(self.list.len()).unwrap_or(u16::MAX);
        self.list.extend(other.list.iter().cloned());
        self.of
            .extend(other.of.iter().map(|&of| of.saturating_add(first)));
    }

    /// Whether any part of it is not isotropic: that takes the dense layout.
    pub fn has_fibres(&self) -> bool {
        self.list.iter().any(|substance| substance.fibres.is_some())
    }

    /// Of one tet, for a body that has fibres somewhere.
    pub fn elasticity(&self, tet: usize) -> Elasticity {
        let substance = &self.list[usize::from(self.of[tet])];
        substance.fibres.unwrap_or_else(|| {
            let [young, poisson] = [substance.young, substance.poisson].map(f64::from);
            let isotropic = Orthotropic {
                young: [young; 3],
                poisson: [poisson; 3],
                shear: [young / (2.0 * (1.0 + poisson)); 3],
            };
            isotropic.elasticity().expect("Poisson's ratio was checked")
        })
    }
}

/// The tets whose middle lies in a region, bounds included, or that belong to a volume of the mesh.
fn chosen(
    check: &Checker,
    key: &str,
    part: &file::Material,
    mesh: &Mesh,
    placed: &[DVec3],
) -> Result<Vec<usize>, Error> {
    let tets = 0..mesh.tets.len();
    let (key, value, tets): (_, _, Vec<usize>) = match (part.volume, &part.corners, &part.sphere) {
        (Some(volume), None, None) => {
            let here = |&tet: &usize| mesh.volumes.get(tet) == Some(&volume);
            (
                format!("{key}.volume"),
                volume.to_string(),
                tets.filter(here).collect(),
            )
        }
        (None, corners, sphere) if corners.is_some() != sphere.is_some() => {
            let (key, value, region) = region(check, key, corners.as_ref(), sphere.as_ref())?;
            let middle = |tet: usize| {
                let corners = mesh.tets[tet].iter().map(|&node| placed[node as usize]);
                corners.sum::<DVec3>() / 4.0
            };
            (
                key,
                value,
                tets.filter(|&tet| region.holds(middle(tet))).collect(),
            )
        }
        _ => {
            return Err(Error::Scene {
                file: check.file.into(),
                what: format!("{key}: must have exactly one of box, sphere and volume"),
            });
        }
    };
    if tets.is_empty() {
        let why = match part.volume {
            Some(_) => "no tet of the mesh is in this volume",
            None => "holds the middle of no tet of the placed rest shape",
        };
        return Err(Error::Value {
            file: check.file.into(),
            key,
            value,
            why: why.into(),
        });
    }
    Ok(tets)
}

fn substance(
    check: &Checker,
    key: &str,
    placing: &Placing,
    (young, poisson, density): (f64, f64, f64),
    fibre: Option<&file::Fibre>,
) -> Result<Substance, Error> {
    let at = |name: &str| format!("{key}.{name}");
    let substance = Substance {
        key: key.into(),
        young: check.positive(&at("young"), young)?,
        poisson: check.number(
            &at("poisson"),
            poisson,
            "must be below 0.5 and above -1",
            |p| p > -1.0 && p < 0.5,
        )?,
        density: check.positive(&at("density"), density)?,
        fibres: None,
    };
    let Some(fibre) = fibre else {
        return Ok(substance);
    };
    let (direction, _) = check.direction(&at("fibre.direction"), fibre.direction)?;
    let [across, poisson] = [substance.young, substance.poisson].map(f64::from);
    let shear = fibre.shear.unwrap_or(across / (2.0 * (1.0 + poisson)));
    let fibres = Fibres {
        along: check.positive(&at("fibre.young"), fibre.young)?.into(),
        across,
        poisson_along: poisson,
        poisson_across: poisson,
        shear: check.positive(&at("fibre.shear"), shear)?.into(),
    };
    let turned = placing.turn(direction);
    let elasticity = fibres.elasticity(turned.to_array()).map_err(|e| {
        let why = match e {
            ElasticityError::Poisson => {
                format!("too soft along the fibres for poisson = {poisson:?}: {e}")
            }
            _ => e.to_string(),
        };
        check.wrong(&at("fibre.young"), &fibre.young, why)
    })?;
    Ok(Substance {
        fibres: Some(elasticity),
        ..substance
    })
}

/// How a body yields and breaks, if it does.
#[derive(Clone, Copy, Debug, Default)]
pub struct Laws {
    pub plasticity: Option<Plasticity>,
    pub fracture: Option<Fracture>,
}

impl Laws {
    pub fn new(check: &Checker, key: &str, raw: &file::Body, tets: usize) -> Result<Self, Error> {
        let plasticity = match &raw.plasticity {
            None => None,
            Some(raw) => Some(plasticity(check, &format!("{key}.plasticity"), raw)?),
        };
        let fracture = match &raw.fracture {
            None => None,
            Some(raw) => Some(fracture(check, &format!("{key}.fracture"), raw, tets)?),
        };
        Ok(Self {
            plasticity,
            fracture,
        })
    }

    pub fn any(&self) -> bool {
        self.plasticity.is_some() || self.fracture.is_some()
    }
}

fn plasticity(check: &Checker, key: &str, raw: &file::Plasticity) -> Result<Plasticity, Error> {
    let at = |name: &str| format!("{key}.{name}");
    let yields = check.not_negative(&at("yield_strain"), raw.yield_strain)?;
    let limit = check.positive(&at("limit"), raw.limit)?;
    let relaxation = check.not_negative(&at("relaxation"), raw.relaxation)?;
    let law = Plasticity::new(yields, limit).and_then(|law| law.with_relaxation(relaxation));
    law.map_err(|e| {
        let (name, value) = match e {
            PlasticityError::Limit(_) => ("limit", raw.limit),
            PlasticityError::RelaxationTime(_) => ("relaxation", raw.relaxation),
            _ => ("yield_strain", raw.yield_strain),
        };
        check.wrong(&at(name), &value, e.to_string())
    })
}

fn fracture(
    check: &Checker,
    key: &str,
    raw: &file::Fracture,
    tets: usize,
) -> Result<Fracture, Error> {
    let at = |name: &str| format!("{key}.{name}");
    let strength = check.positive(&at("strength"), raw.strength)?;
    let reserve = raw
        .reserve
        .unwrap_or(u32::try_from(tets).unwrap_or(u32::MAX));
    Fracture::new(strength, raw.per_step, reserve).map_err(|e| match e {
        FractureError::PerStep(found) => {
            let why = format!("must be from 1 to {MOST_PER_STEP}");
            check.wrong(&at("per_step"), &found, why)
        }
        _ => check.wrong(&at("strength"), &raw.strength, e.to_string()),
    })
}
