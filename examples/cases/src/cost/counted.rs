//! One step between the marks, in a world of its own.

use core::fmt::Arguments;
use core::hint::black_box;

use femto::collider::{Capsule, Cuboid, HeightField, Placed, SignedDistance};
use femto::cost::Load;
use femto::glam::{Mat3, Vec3};
use femto::{Body, Collider, Frame, Material, Mesh, Pin, Scene, Settings, StepReport, blocks};

use super::Counter;
use super::design::{Case, NODES, Rest, TETS};
use crate::choices::{BadCase, COARSE, HISTORY, Held, VECTORS};
use crate::factor::FactorRoom;
use crate::states::{REFUSED, State};

/// Room for the largest mesh, any start and any preconditioner; all bits zero, to be a `static`.
#[derive(Debug, Default)]
pub struct Room {
    body: AnyBody,
    factors: FactorRoom<NODES, { 7 * NODES }>,
}

const BLOCKS: usize = blocks(TETS);
/// Blocks that can flow and break.
const DAMAGE: usize = if cfg!(feature = "inelastic") {
    BLOCKS
} else {
    0
};

type AnyBody = Body<NODES, BLOCKS, HISTORY, VECTORS, femto::element::Factored, COARSE, DAMAGE>;

impl Room {
    /// Empty.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            body: Body::new(),
            factors: FactorRoom::new(),
        }
    }
}

pub(super) fn fill(room: &mut Room, (nodes, tets): Rest) -> Result<(), BadCase> {
    let mesh = Mesh::new(nodes, tets).map_err(|_| BadCase)?;
    let material = Material::new(1e6, 0.4, 1000.0).map_err(|_| BadCase)?;
    room.factors.fill(nodes.len(), tets);
    room.body.fill(&mesh, &material).map_err(|_| BadCase)
}

/// A borrowed shape with friction.
fn rough(shape: &dyn SignedDistance) -> Result<Collider<'_>, BadCase> {
    let collider = Collider::shape(shape).with_friction(0.3);
    collider.map_err(|_| BadCase)
}

/// Takes one step from a state between the marks, after `label` has said what it is.
pub(super) fn counted(
    room: &mut Room,
    (nodes, _): Rest,
    case: &Case,
    (name, change): (&str, State),
    label: impl FnOnce(Load, &mut dyn FnMut(Arguments<'_>)),
    counter: &mut Counter<impl FnMut(Arguments<'_>)>,
) -> Result<(), BadCase> {
    let (mut x, mut v, force) = (
        [[0.0; 3]; NODES],
        [[0.0; 3]; NODES],
        [[0.5, 1.0, -0.25]; NODES],
    );
    let (x, v) = (&mut x[..nodes.len()], &mut v[..nodes.len()]);
    x.copy_from_slice(nodes);
    change(x, v);
    let Room { body, factors } = room;
    body.place(x, v).map_err(|_| BadCase)?;

    let velocity = if case.moving {
        Vec3::new(0.1, 0.0, 0.2)
    } else {
        Vec3::ZERO
    };
    let ground = Collider::half_space(Vec3::Y, 0.0)
        .and_then(|c| c.with_friction(0.5))
        .and_then(|c| c.with_velocity(velocity));
    let ball =
        Collider::sphere(Vec3::new(0.5, -0.5, 0.5), 0.51).and_then(|c| c.with_velocity(velocity));
    // All other shapes, in the way of the body, too; one of them in a frame that spins.
    let frame = Frame::new(Vec3::new(0.2, -0.1, 0.2), Mat3::IDENTITY)
        .and_then(|f| f.with_spin(Vec3::new(1.0, 2.0, 3.0)))
        .map_err(|_| BadCase)?;
    let slab = Cuboid::new(Vec3::ZERO, Vec3::new(0.3, 0.2, 0.4)).map_err(|_| BadCase)?;
    let slab = Placed::new(slab, frame);
    let log = Capsule::new(Vec3::ZERO, Vec3::new(0.5, 0.1, 0.3), 0.1).map_err(|_| BadCase)?;
    let heights = [0.0, 0.1, -0.1, 0.05, 0.2, 0.0, 0.1, -0.2, 0.15];
    let field = HeightField::new(&heights, [3, 3], [0.2, 0.25]).map_err(|_| BadCase)?;
    let colliders = [
        ground.map_err(|_| BadCase)?,
        ball.map_err(|_| BadCase)?,
        rough(&slab)?,
        rough(&log)?,
        rough(&field)?,
    ];
    let pins = [0, 1, 2].map(|node| Pin { node, velocity });
    let scene = Scene {
        gravity: Vec3::new(0.0, case.gravity, 0.0),
        forces: if case.forces {
            &force[..nodes.len()]
        } else {
            &[]
        },
        pins: &pins[..case.pins],
        colliders: &colliders[..case.colliders],
    };
    let mut held = Held::<NODES>::new();
    let choice = case.preconditioner.1;
    let preconditioner = choice.prepare(&body.rest(), factors, &mut held)?;
    let settings = Settings::new(case.dt)
        .and_then(|s| s.with_theta(case.theta))
        .map_err(|_| BadCase)?
        .with_start(case.start.1)
        .with_preconditioner(preconditioner)
        .with_budget(case.budget);
    let settings = if case.inelastic {
        inelastic(settings)?
    } else {
        settings
    };
    if name == REFUSED {
        if body.step(&scene, &settings).advanced() {
            return Err(BadCase);
        }
        v.fill([0.0; 3]);
        body.place(x, v).map_err(|_| BadCase)?;
    }
    label(Load::of(&body.rest(), &scene, &settings), &mut counter.say);
    (counter.begin)();
    let mut report = step(body, &scene, &settings);
    if counter.early_exit {
        for _ in 0..8 {
            if report.relative_residual() < 0.1 {
                break;
            }
            report = step(body, &scene, &settings);
        }
    }
    (counter.end)();
    if report.advanced() {
        Ok(())
    } else {
        Err(BadCase)
    }
}

/// Some of it yields and breaks in most states, none in others.
#[cfg(feature = "inelastic")]
fn inelastic(settings: Settings<'_>) -> Result<Settings<'_>, BadCase> {
    use femto::{Fracture, Plasticity};
    let plasticity = Plasticity::new(0.01, 0.1).and_then(|law| law.with_relaxation(0.1));
    let fracture = Fracture::new(1e5, 4, 10).map_err(|_| BadCase)?;
    let settings = settings.with_plasticity(plasticity.map_err(|_| BadCase)?);
    Ok(settings.with_fracture(fracture))
}

#[cfg(not(feature = "inelastic"))]
fn inelastic(settings: Settings<'_>) -> Result<Settings<'_>, BadCase> {
    Ok(settings)
}

/// The step as firmware would call it: neither its settings nor its scene are known to the compiler.
#[inline(never)]
fn step(body: &mut AnyBody, scene: &Scene<'_>, settings: &Settings<'_>) -> StepReport {
    black_box(body).step(black_box(scene), black_box(settings))
}
