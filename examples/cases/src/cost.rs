//! Steps whose instructions an emulator counts, between two marker functions.
//!
//! A program calls [`prove`], [`measure`], [`cube`] or what the features add; before every counted step they say what it is, and the emulator's
//! plugin (`examples/firmware/counter.c`) finishes the line with the count.

use core::fmt::Arguments;
use core::hint::black_box;

use femto::collider::{Capsule, Cuboid, HeightField, Placed, SignedDistance};
use femto::cost::Load;
use femto::glam::{Mat3, Vec3};
use femto::{
    Body, Budget, Collider, Frame, Material, Mesh, Pin, Scene, Settings, Start, StepReport, blocks,
};

pub use crate::choices::BadCase;
use crate::choices::{COARSE, Choice, HISTORY, Held, JACOBI, PRECONDITIONERS, STARTS, VECTORS};
use crate::factor::FactorRoom;
use crate::states::{REFUSED, STATES};

#[cfg(feature = "contact")]
pub mod coupled;
mod measure;

use measure::CUBE;
#[cfg(any(
    feature = "contact",
    feature = "plasticity",
    feature = "fracture",
    feature = "guard"
))]
pub use measure::measure_more;
pub use measure::{cube, measure};

/// Those of the largest mesh.
const NODES: usize = 480;
const TETS: usize = 1800;

/// Room for the largest mesh, any start and any preconditioner; all bits zero, to be a `static`.
#[derive(Debug, Default)]
pub struct Room {
    body: AnyBody,
    factors: FactorRoom<NODES, { 7 * NODES }>,
}

const BLOCKS: usize = blocks(TETS);
/// Blocks that can flow and break.
const DAMAGE: usize = if cfg!(any(feature = "plasticity", feature = "fracture")) {
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

/// A mesh, borrowed.
type Rest = (&'static [[f32; 3]], &'static [[u32; 4]]);

/// What the program does around a counted step.
pub struct Counter<Say> {
    /// Prints what is counted, without ending the line.
    pub say: Say,
    /// The marker functions.
    pub begin: fn(),
    /// …
    pub end: fn(),
    /// Stops at a tolerance instead of the budget, to show that a count would tell.
    pub early_exit: bool,
}

/// One step.
#[derive(Clone, Copy, Debug)]
struct Case {
    preconditioner: (&'static str, Choice),
    start: (&'static str, Start),
    budget: Budget,
    pins: usize,
    /// The first of [`counted`]'s colliders, and how many.
    first: usize,
    colliders: usize,
    moving: bool,
    forces: bool,
    theta: f32,
    gravity: f32,
    dt: f32,
    /// Flows, and breaks at so many places in a step, with the features for it; 0 for neither.
    tears: u32,
}

const PLAIN: Case = Case {
    preconditioner: JACOBI,
    start: ("galerkin-1", Start::Galerkin(1)),
    budget: Budget {
        iterations: 5,
        polar_sweeps: 1,
    },
    pins: 0,
    first: 0,
    colliders: 0,
    moving: false,
    forces: false,
    theta: 1.0,
    gravity: -9.81,
    dt: 1.0 / 60.0,
    tears: 0,
};

/// Steps of the 64-node cube in every state: with colliders of all shapes; for every preconditioner and start free and
/// touching two colliders, and held.
///
/// # Errors
/// [`BadCase`].
pub fn prove(
    room: &mut Room,
    counter: &mut Counter<impl FnMut(Arguments<'_>)>,
) -> Result<(), BadCase> {
    let cube = CUBE;
    fill(room, cube)?;
    for state in STATES {
        let case = Case {
            colliders: 5,
            ..PLAIN
        };
        let label = |_, say: &mut dyn FnMut(Arguments<'_>)| {
            say(format_args!(
                "{} {} shapes {} ",
                PLAIN.preconditioner.0, PLAIN.start.0, state.0
            ));
        };
        counted(room, cube.0, &case, state, label, step, counter)?;
    }
    for preconditioner in PRECONDITIONERS {
        for start in STARTS {
            // In a very short step without gravity the solver has soon nothing to do, and in a body at
            // rest from the start: a solver that stops there is seen.
            for (world, pins, colliders, gravity, dt) in [
                ("touching", 0, 2, -9.81, 1.0 / 60.0),
                ("held", 1, 0, 0.0, 1e-7),
            ] {
                let case = Case {
                    preconditioner,
                    start,
                    pins,
                    colliders,
                    gravity,
                    dt,
                    tears: 4,
                    ..PLAIN
                };
                for state in STATES {
                    let label = |_, say: &mut dyn FnMut(Arguments<'_>)| {
                        say(format_args!(
                            "{} {} {world} {} ",
                            preconditioner.0, start.0, state.0
                        ));
                    };
                    counted(room, cube.0, &case, state, label, step, counter)?;
                }
            }
        }
    }
    Ok(())
}

/// A body of one material.
fn fill(room: &mut Room, (nodes, tets): Rest) -> Result<(), BadCase> {
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
fn counted(
    room: &mut Room,
    nodes: &[[f32; 3]],
    case: &Case,
    (name, change): (&str, impl Fn(&mut [[f32; 3]], &mut [[f32; 3]])),
    label: impl FnOnce(Load, &mut dyn FnMut(Arguments<'_>)),
    mut step: impl FnMut(&mut AnyBody, &Scene<'_>, &Settings<'_>) -> StepReport,
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
    // The guard acts where nothing moves.
    let spin = if cfg!(feature = "guard") {
        Vec3::ZERO
    } else {
        Vec3::new(1.0, 2.0, 3.0)
    };
    let frame = Frame::new(Vec3::new(0.2, -0.1, 0.2), Mat3::IDENTITY)
        .and_then(|f| f.with_spin(spin))
        .map_err(|_| BadCase)?;
    let slab = Cuboid::new(Vec3::ZERO, Vec3::new(0.3, 0.2, 0.4)).map_err(|_| BadCase)?;
    let placed = Placed::new(slab, frame);
    let log = Capsule::new(Vec3::ZERO, Vec3::new(0.5, 0.1, 0.3), 0.1).map_err(|_| BadCase)?;
    let heights = [0.0, 0.1, -0.1, 0.05, 0.2, 0.0, 0.1, -0.2, 0.15];
    let field = HeightField::new(&heights, [3, 3], [0.2, 0.25]).map_err(|_| BadCase)?;
    let colliders = [
        ground.map_err(|_| BadCase)?,
        ball.map_err(|_| BadCase)?,
        rough(&placed)?,
        rough(&log)?,
        rough(&field)?,
        rough(&slab)?,
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
        colliders: &colliders[case.first..][..case.colliders],
    };
    let mut held = Held::new();
    let preconditioner = case.preconditioner.1;
    let preconditioner = preconditioner.prepare(&body.rest(), factors, &mut held)?;
    let settings = Settings::new(case.dt)
        .and_then(|s| s.with_theta(case.theta))
        .map_err(|_| BadCase)?
        .with_start(case.start.1)
        .with_preconditioner(preconditioner)
        .with_budget(case.budget);
    #[cfg(feature = "guard")]
    let settings = settings.with_energy_guard();
    let settings = if case.tears > 0 {
        inelastic(settings, case.tears)?
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
#[cfg_attr(
    not(any(feature = "plasticity", feature = "fracture")),
    expect(clippy::unnecessary_wraps, reason = "nothing to do")
)]
fn inelastic(settings: Settings<'_>, _tears: u32) -> Result<Settings<'_>, BadCase> {
    #[cfg(feature = "plasticity")]
    let settings = {
        let law = femto::Plasticity::new(0.01, 0.1).and_then(|law| law.with_relaxation(0.1));
        settings.with_plasticity(law.map_err(|_| BadCase)?)
    };
    #[cfg(feature = "fracture")]
    let settings = {
        let law = femto::Fracture::new(1e5, _tears, 10);
        settings.with_fracture(law.map_err(|_| BadCase)?)
    };
    Ok(settings)
}

/// The step as firmware would call it: neither its settings nor its scene are known to the compiler.
#[inline(never)]
fn step(body: &mut AnyBody, scene: &Scene<'_>, settings: &Settings<'_>) -> StepReport {
    black_box(body).step(black_box(scene), black_box(settings))
}
