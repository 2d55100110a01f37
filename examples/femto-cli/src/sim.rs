//! The only file that runs the library's solver.

use std::fmt::Display;
use std::ops::Range;
use std::time::{Duration, Instant};

use femto::body::{rest_bytes, state_bytes, workspace_bytes};
use femto::constraint::Pin;
use femto::coupling::{Coupling, Couplings};
use femto::detect::Aabb;
use femto::element::{Dense, Factored, Layout};
use femto::energy::StateHash;
use femto::glam::Vec3;
use femto::lane::blocks;
use femto::order::fans;
use femto::owned::{OwnedBody, OwnedState};
use femto::preconditioner::Factor;
use femto::preconditioner::aggregate::{Aggregates, DEFAULT_AGGREGATES};
use femto::settings::{Needs, Preconditioner, Settings, Start};
use femto::state::{StateRef, broken_bytes, plastic_bytes};
use femto::step::{Scene as StepScene, StepReport};
use femto_bake::OwnedFactor;

use crate::colliders::Solid;
use crate::coupled::Joint;
use crate::error::Error;
use crate::loads::Acting;
use crate::material::Laws;
use crate::prepare::{self, Build, Factors};
use crate::scene::{self, Scene};

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

/// One body in one of the two layouts.
struct Body<'a> {
    kind: Kind,
    pins: Vec<Pin>,
    acting: Acting,
    factor: Option<Factor<'a>>,
    /// The aggregate of each node, for the two-level preconditioner.
    aggregates: Option<Vec<u8>>,
    laws: Laws,
    /// Those of the bodies of one system.
    regions: Option<joined::Regions>,
    /// Of bodies that yield or break: the scene's number of every tet of the library's.
    original: Vec<usize>,
    /// What plastic flow took so far, J, and what broke.
    damage: Damage,
}

/// The scene's settings with what is a body's own of the preconditioner.
fn own_settings<'a>(
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

enum Kind {
    Factored(Box<OwnedBody<Factored>>),
    Dense(Box<OwnedBody<Dense>>),
}

/// Calls a method of the body, whatever its layout.
macro_rules! with {
    ($kind:expr, $body:ident => $call:expr) => {
        match $kind {
            Kind::Factored($body) => $call,
            Kind::Dense($body) => $call,
        }
    };
}

mod joined;
mod values;

pub use values::{Damage, Energies, Measure, Memory, StepInfo};

impl<'a> Sim<'a> {
    pub fn new(scene: &'a Scene, factors: &'a Factors) -> Result<Self, Error> {
        let wrong = |key: &str, value: String, why: String| Error::Value {
            file: scene.file.clone(),
            key: key.into(),
            value,
            why,
        };
        let settings = prepare::settings(scene)?;
        let mut bodies = Vec::new();
        let mut joint = None;
        if let Some(coupled) = &scene.coupled {
            let (made, body) = joined::joined(scene, coupled, &settings, factors)?;
            bodies.push(body);
            joint = Some(made);
        }
        let separate = scene.systems().min(scene.bodies.len());
        let separate = if joint.is_some() { 0 } else { separate };
        for (i, (body, factor)) in scene
            .bodies
            .iter()
            .zip(&factors.0)
            .take(separate)
            .enumerate()
        {
            let aggregated = scene.preconditioner == scene::Preconditioner::TwoLevel;
            let mut aggregates = aggregated.then(|| vec![0; body.rest.len()]);
            let of = aggregates.as_deref_mut();
            // Fibres take the dense layout.
            let dense = scene.layout == scene::Layout::Dense || body.substances.has_fibres();
            let mut kind = match dense {
                false => Kind::Factored(built(scene, i, &settings, of)?),
                true => Kind::Dense(built(scene, i, &settings, of)?),
            };
            with!(&mut kind, built => built.place(&body.x, &body.v)).map_err(|e| {
                wrong(
                    &format!("body[{i}].mesh"),
                    body.source.clone(),
                    e.to_string(),
                )
            })?;
            let pin = |&(node, v): &(u32, [f32; 3])| Pin {
                node,
                velocity: Vec3::from_array(v),
            };
            bodies.push(Body {
                kind,
                pins: body.pins.iter().map(pin).collect(),
                acting: Acting::new(&scene.loads, [(i, body)].into_iter())
                    .map_err(|why| wrong(&format!("body[{i}]"), body.source.clone(), why))?,
                factor: factor.as_ref().map(OwnedFactor::view),
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
            });
        }
        let mut colliders = Vec::new();
        for (i, collider) in scene.colliders.iter().enumerate() {
            let shape = format!("{:?}", collider.shape);
            let solid = Solid::new(collider);
            colliders.push(solid.map_err(|why| wrong(&format!("collider[{i}]"), shape, why))?);
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
                        .with_boxes(if std::env::var("NOBOX").is_ok() {
                            &mut []
                        } else {
                            &mut joint.boxes
                        });
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

    pub fn measure(&self) -> Measure {
        let mut sum = Measure {
            energy: Energies::default(),
            linear: [0.0; 3],
            angular: [0.0; 3],
            min_det: f64::INFINITY,
        };
        for body in &self.bodies {
            let (energy, momenta, min_det) = with!(&body.kind, body => (body.energies(self.gravity), body.momenta(), body.min_det()));
            sum.energy.kinetic += energy.kinetic;
            sum.energy.elastic += energy.elastic;
            sum.energy.potential += energy.potential;
            for axis in 0..3 {
                sum.linear[axis] += momenta.linear[axis];
                sum.angular[axis] += momenta.angular[axis];
            }
            sum.min_det = sum.min_det.min(min_det);
        }
        sum
    }

    pub fn bodies(&self) -> usize {
        self.ranges.len()
    }

    pub fn positions(&self, body: usize) -> &[[f32; 3]] {
        match self.joint {
            None => with!(&self.bodies[body].kind, body => body.positions()),
            Some(_) => {
                let all = with!(&self.bodies[0].kind, body => body.positions());
                &all[self.ranges[body].clone()]
            }
        }
    }

    pub fn velocities(&self, body: usize) -> &[[f32; 3]] {
        match self.joint {
            None => with!(&self.bodies[body].kind, body => body.velocities()),
            Some(_) => {
                let all = with!(&self.bodies[0].kind, body => body.velocities());
                &all[self.ranges[body].clone()]
            }
        }
    }

    /// Attachments, springs and contacts between bodies, as the last step left them; empty slots weigh nothing.
    pub fn contacts(&self) -> &[Coupling] {
        self.joint.as_ref().map_or(&[], |joint| &joint.slots)
    }

    /// Takes the boxes from the search for contacts, which then finds the same among all triangles.
    pub fn search_without_boxes(&mut self) {
        if let Some(joint) = &mut self.joint {
            joint.boxes.clear();
        }
    }

    /// Whose a node of the one system is.
    pub fn body_of(&self, node: usize) -> usize {
        self.ranges.partition_point(|range| range.end <= node)
    }

    /// FNV-1a over the bits of all x, then all v, then plastic strain and what has broken, if any, body by body.
    pub fn hash(&self) -> u64 {
        if self.joint.is_some() {
            let bodies = 0..self.bodies();
            let one = |hash: StateHash, b| hash.with(self.positions(b), self.velocities(b));
            let hash = bodies.fold(StateHash::new(), one);
            let body = &self.bodies[0];
            return match body.laws.any() {
                true => with!(&body.kind, body => hash.with_state(&body.state().view())).value(),
                false => hash.value(),
            };
        }
        self.bodies
            .iter()
            .fold(
                StateHash::new(),
                |hash, body| with!(&body.kind, body => hash.with_state(&body.state().view())),
            )
            .value()
    }

    /// What has yielded and broken; `None` where no body does either.
    pub fn damage(&self) -> Option<Damage> {
        let damaged = self.bodies.iter().filter(|body| body.laws.any());
        damaged.map(|body| body.damage).reduce(|a, b| Damage {
            dissipated_joules: a.dissipated_joules + b.dissipated_joules,
            broken_tets: a.broken_tets + b.broken_tets,
            reserve_left: match (a.reserve_left, b.reserve_left) {
                (Some(a), Some(b)) => Some(a.saturating_add(b)),
                (a, b) => a.or(b),
            },
        })
    }

    /// Calls `f` with the state that a body is in and, for each of its tets, the state's number and the scene's.
    fn each_tet(&self, body: usize, mut f: impl FnMut(&StateRef<'_>, usize, usize)) {
        let (own, range) = match &self.joint {
            None => (&self.bodies[body], 0..usize::MAX),
            Some(joint) => (&self.bodies[0], joint.parts.parts[body].tets.clone()),
        };
        with!(&own.kind, built => {
            let state = built.state().view();
            for (tet, original) in own.original.iter().enumerate() {
                if range.contains(original) {
                    f(&state, tet, original - range.start);
                }
            }
        });
    }

    /// Which tets of a body are whole, as the scene counts them.
    pub fn whole(&self, body: usize, tets: usize) -> Vec<bool> {
        let mut whole = vec![true; tets];
        self.each_tet(body, |state, tet, original| {
            whole[original] = !state.is_broken(tet)
        });
        whole
    }

    /// Norm of the plastic strain of a body's tets, as the scene counts them; 0 for those of bodies that do not yield.
    pub fn plastic_strain(&self, body: usize, tets: usize) -> Vec<f32> {
        let mut norms = vec![0.0; tets];
        self.each_tet(body, |state, tet, original| {
            norms[original] = state.plastic_strain(tet)
        });
        norms
    }

    /// Whether any body yields.
    pub fn yields(&self) -> bool {
        self.bodies
            .iter()
            .any(|body| body.laws.plasticity.is_some())
    }

    /// Rest and state of all bodies; the workspace serves one body at a time, so that of the
    /// largest is enough.
    pub fn memory(&self) -> Memory {
        let mut sum = Memory::default();
        for body in &self.bodies {
            let settings =
                own_settings(&self.settings, None, body.aggregates.as_deref(), body.laws);
            let needs = Needs::from(&settings);
            let one = with!(&body.kind, body => memory_of(body, needs));
            sum.rest += one.rest;
            sum.factor += body.factor.as_ref().map_or(0, Factor::bytes);
            sum.state += one.state;
            sum.workspace = sum.workspace.max(one.workspace);
        }
        if let Some(joint) = &self.joint {
            sum.workspace += joint.slots.len() * size_of::<Coupling>();
            sum.workspace += joint.boxes.len() * size_of::<Aabb>();
        }
        sum
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

fn memory_of<L: Layout>(body: &OwnedBody<L>, needs: Needs) -> Memory {
    let rest = body.rest();
    needed::<L>(rest.nodes.len(), rest.header.tets as usize, needs)
}

fn needed<L: Layout>(nodes: usize, tets: usize, needs: Needs) -> Memory {
    let blocks = blocks(tets);
    Memory {
        rest: rest_bytes::<L>(nodes, blocks),
        factor: 0,
        state: state_bytes(nodes, blocks, needs.history)
            + if needs.plastic {
                plastic_bytes(blocks)
            } else {
                0
            }
            + if needs.broken {
                broken_bytes(blocks)
            } else {
                0
            },
        workspace: workspace_bytes::<L>(nodes, blocks, needs.vectors)
            + needs.coarse * size_of::<f32>(),
    }
}

/// What a body of this size takes with the default start, factored and dense.
pub fn memory_of_mesh(nodes: usize, tets: usize) -> [Memory; 2] {
    let needs = Needs::from(Start::default());
    [
        needed::<Factored>(nodes, tets, needs),
        needed::<Dense>(nodes, tets, needs),
    ]
}
