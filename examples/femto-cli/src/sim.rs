//! The only module that runs the library's solver: a scene, step by step.

use std::fmt::Display;
use std::ops::Range;
use std::time::{Duration, Instant};

use femto::coupling::Couplings;
use femto::glam::Vec3;
use femto::owned::OwnedState;
use femto::settings::Settings;
use femto::step::{Scene as StepScene, StepReport};

use crate::colliders::Solid;
use crate::coupled::Joint;
use crate::error::Error;
use crate::prepare::{self, Factors};
use crate::scene::Scene;
use body::{Body, own_settings, with};

mod body;
mod joined;
mod memory;
mod state;
mod values;

pub use memory::memory_of_mesh;
pub use values::{Damage, Energies, Measure, Memory, StepInfo};

/// The step by step life of a scene.
pub struct Sim<'a> {
    /// One a body, or one of them all.
    bodies: Vec<Body<'a>>,
    /// What joins them then, and the nodes of each body.
    joint: Option<Joint>,
    ranges: Vec<Range<usize>>,
    gravity: Vec3,
    settings: Settings<'static>,
    substeps: u32,
    /// In f64, for the places of moving colliders.
    substep: f64,
    colliders: Vec<Solid<'a>>,
    /// Substeps made so far.
    made: u64,
}

impl<'a> Sim<'a> {
    pub fn new(scene: &'a Scene, factors: &'a Factors) -> Result<Self, Error> {
        let settings = prepare::settings(scene)?;
        let (bodies, joint) = match &scene.coupled {
            Some(coupled) => {
                let (joint, body) = joined::joined(scene, coupled, &settings, factors)?;
                (vec![body], Some(joint))
            }
            None => {
                let own = factors.0.iter().take(scene.bodies.len()).enumerate();
                let bodies = own.map(|(i, own)| Body::new(scene, i, &settings, own.as_ref()));
                (bodies.collect::<Result<_, _>>()?, None)
            }
        };
        let mut colliders = Vec::new();
        for (i, collider) in scene.colliders.iter().enumerate() {
            let solid = Solid::new(collider).map_err(|why| Error::Value {
                file: scene.file.clone(),
                key: format!("collider[{i}]"),
                value: format!("{:?}", collider.shape),
                why,
            });
            colliders.push(solid?);
        }
        let mut ranges = Vec::new();
        let mut first = 0;
        for body in &scene.bodies {
            ranges.push(first..first + body.x.len());
            first += body.x.len();
        }
        Ok(Sim {
            bodies,
            joint,
            ranges,
            gravity: Vec3::from_array(scene.gravity),
            settings,
            substeps: scene.budget.substeps,
            substep: scene.substep,
            colliders,
            made: 0,
        })
    }

    /// Makes one step of dt. When it is refused, all bodies are as they were before it, and
    /// the text says why.
    pub fn step(&mut self) -> Result<StepInfo, String> {
        // One substep of one body is undone by the library itself.
        let undo = self.substeps > 1 || self.bodies.len() > 1;
        let before: Vec<(OwnedState, Damage)> = match undo {
            true => self
                .bodies
                .iter()
                .map(|b| (with!(&b.kind, body => body.state().clone()), b.damage))
                .collect(),
            false => Vec::new(),
        };
        let made = self.made;
        let result = self.substeps();
        if result.is_err() {
            self.made = made;
            for (body, (state, damage)) in self.bodies.iter_mut().zip(before) {
                body.damage = damage;
                with!(&mut body.kind, body => *body.state_mut() = state);
            }
        }
        result
    }

    fn substeps(&mut self) -> Result<StepInfo, String> {
        let mut info = StepInfo {
            residual: 0.0,
            contacts: 0,
            dropped: 0,
            took: Duration::ZERO,
        };
        for substep in 0..self.substeps {
            let time = self.made as f64 * self.substep;
            let too_far = |e: &dyn Display| format!("a collider has moved too far: {e}");
            for solid in &mut self.colliders {
                solid.move_to(time).map_err(|e| too_far(&e))?;
            }
            let colliders: Result<Vec<_>, _> = self.colliders.iter().map(|c| c.at(time)).collect();
            let colliders = colliders.map_err(|e| too_far(&e))?;
            let (mut residual, mut rhs) = (0.0, 0.0);
            info.contacts = 0;
            for (i, body) in self.bodies.iter_mut().enumerate() {
                let (x, v) = with!(&body.kind, body => (body.positions(), body.velocities()));
                body.acting
                    .carry(time, self.settings.dt(), x, &mut body.pins)?;
                let scene = StepScene {
                    gravity: self.gravity,
                    forces: body.acting.forces(x, v),
                    pins: &body.pins,
                    colliders: &colliders,
                };
                let mut settings = own_settings(
                    &self.settings,
                    body.factor.as_ref(),
                    body.aggregates.as_deref(),
                    body.laws,
                );
                settings.regions = body.regions.as_ref().map(joined::Regions::view);
                let begin = Instant::now();
                let report: StepReport = match &mut self.joint {
                    None => with!(&mut body.kind, body => body.step(&scene, &settings)),
                    Some(joint) => {
                        joint.move_targets(time);
                        let pieces = joint.parts.pieces();
                        let mut couplings = Couplings::new(
                            &pieces,
                            &mut joint.rigids,
                            &joint.links,
                            &mut joint.slots,
                        )
                        .with_boxes(&mut joint.boxes);
                        with!(&mut body.kind, body => body.step_coupled(&scene, &settings, &mut couplings))
                    }
                };
                info.took += begin.elapsed();
                if let Some(refusal) = report.refusal {
                    return Err(match (self.bodies.len(), self.substeps) {
                        (1, 1) => refusal.to_string(),
                        _ => format!("body {i}, substep {}: {refusal}", substep + 1),
                    });
                }
                residual += f64::from(report.residual_after) * f64::from(report.residual_after);
                rhs += f64::from(report.rhs) * f64::from(report.rhs);
                body.damage.add(&report);
                info.contacts += report.contacts + report.couplings;
                info.dropped += report.dropped;
            }
            info.residual = if rhs > 0.0 {
                (residual / rhs).sqrt()
            } else {
                0.0
            };
            self.made += 1;
        }
        Ok(info)
    }

    /// Takes the boxes from the search for contacts, which then finds the same among all triangles.
    pub fn search_without_boxes(&mut self) {
        if let Some(joint) = &mut self.joint {
            joint.boxes.clear();
        }
    }
}
