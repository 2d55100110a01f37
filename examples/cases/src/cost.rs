//! Steps whose instructions an emulator counts, between two marker functions.
//!
//! A program calls [`prove`], [`measure`] or [`cube`]; before every counted step they say what it is, and the emulator's
//! plugin (`examples/firmware/counter.c`) finishes the line with the count.

use core::fmt::Arguments;
use core::hint::black_box;

use femto::collider::{Capsule, Cuboid, HeightField, Placed, SignedDistance};
use femto::cost::Load;
use femto::glam::{Mat3, Vec3};
use femto::preconditioner::Aggregates;
use femto::{
    Body, Budget, Collider, Frame, Material, Mesh, Pin, Preconditioner, Scene, Settings, Start,
    StepReport, blocks,
};

use crate::choices::{
    COARSE, Choice, HISTORY, JACOBI, MORE_PRECONDITIONERS, MORE_STARTS, PRECONDITIONERS, STARTS,
    VECTORS,
};
use crate::factor::FactorRoom;
use crate::fans;
use crate::mesh::Grid;
use crate::states::{REFUSED, STATES, State};

static SMALL: Grid<27, 48> = Grid::new([2, 2, 2]);
static FLAT: Grid<48, 90> = Grid::new([5, 3, 1]);
static LONG: Grid<90, 216> = Grid::new([9, 2, 2]);
static THICK: Grid<180, 600> = Grid::new([5, 5, 4]);
static CUBE: Grid<64, 162> = Grid::new([3, 3, 3]);
static BAR: Grid<208, 648> = Grid::new([12, 3, 3]);
static LARGE: Grid<NODES, TETS> = Grid::new([15, 5, 4]);

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

/// A mesh, borrowed.
type Rest = (&'static [[f32; 3]], &'static [[u32; 4]]);

/// The meshes that the cost table is fitted to, in the order of their cells and in fans.
const FITTED: [Rest; 8] = [
    (&SMALL.nodes, &SMALL.tets),
    (&FLAT.nodes, &FLAT.tets),
    (&LONG.nodes, &LONG.tets),
    (&THICK.nodes, &THICK.tets),
    (&SMALL.nodes, &fans::SMALL),
    (&FLAT.nodes, &fans::FLAT),
    (&LONG.nodes, &fans::LONG),
    (&THICK.nodes, &fans::THICK),
];
/// Those that it is then compared with.
const OTHERS: [Rest; 6] = [
    (&CUBE.nodes, &fans::CUBE),
    (&BAR.nodes, &fans::BAR),
    (&LARGE.nodes, &fans::LARGE),
    (&CUBE.nodes, &CUBE.tets),
    (&BAR.nodes, &BAR.tets),
    (&LARGE.nodes, &LARGE.tets),
];

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

/// Why a step was not taken: its own numbers are refused. A defect of this program.
#[derive(Clone, Copy, Debug)]
pub struct BadCase;

/// One step.
#[derive(Clone, Copy, Debug)]
struct Case {
    preconditioner: (&'static str, Choice),
    start: (&'static str, Start),
    budget: Budget,
    pins: usize,
    colliders: usize,
    moving: bool,
    forces: bool,
    theta: f32,
    gravity: f32,
    dt: f32,
    /// Flows and breaks, with the feature `inelastic`.
    inelastic: bool,
}

const PLAIN: Case = Case {
    preconditioner: JACOBI,
    start: ("galerkin-1", Start::Galerkin(1)),
    budget: Budget {
        iterations: 5,
        polar_sweeps: 1,
    },
    pins: 0,
    colliders: 0,
    moving: false,
    forces: false,
    theta: 1.0,
    gravity: -9.81,
    dt: 1.0 / 60.0,
    inelastic: false,
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
    let [cube, ..] = OTHERS;
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
        counted(room, cube, &case, state, label, counter)?;
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
                    inelastic: true,
                    ..PLAIN
                };
                for state in STATES {
                    let label = |_, say: &mut dyn FnMut(Arguments<'_>)| {
                        say(format_args!(
                            "{} {} {world} {} ",
                            preconditioner.0, start.0, state.0
                        ));
                    };
                    counted(room, cube, &case, state, label, counter)?;
                }
            }
        }
    }
    Ok(())
}

/// Steps of several meshes in enough different settings to fit the cost table (`fit`) and to compare it
/// (`check`). A line is: fit or check, nodes, tetrahedra, fans, entries of the factor, the four numbers of the coarse
/// half, preconditioner, start, iterations, sweeps, pins, colliders, moving, forces, newmark, count.
///
/// # Errors
/// [`BadCase`].
pub fn measure(
    room: &mut Room,
    counter: &mut Counter<impl FnMut(Arguments<'_>)>,
) -> Result<(), BadCase> {
    for mesh in FITTED {
        fill(room, mesh)?;
        for case in design() {
            line(room, mesh, &case, "fit", counter)?;
        }
    }
    for mesh in OTHERS {
        fill(room, mesh)?;
        let preconditioners = PRECONDITIONERS.into_iter().chain(MORE_CHECKED);
        for (k, preconditioner) in preconditioners.enumerate() {
            for (j, start) in STARTS.into_iter().chain(MORE_STARTS).enumerate() {
                let mixed = Case {
                    preconditioner,
                    start,
                    budget: budget(2 + (3 * k + j) as u32, 1 + (j % 3) as u32),
                    pins: (k + j) % 3,
                    colliders: (k + 2 * j) % 3,
                    moving: k == 2,
                    forces: j == 1,
                    theta: if (k + j) % 4 == 3 { 0.5 } else { 1.0 },
                    ..PLAIN
                };
                line(room, mesh, &mixed, "check", counter)?;
            }
        }
    }
    Ok(())
}

/// With other numbers of aggregates than those that it was fitted to.
const MORE_CHECKED: [(&str, Choice); 2] = [
    ("two-level", Choice::TwoLevel(5)),
    ("two-level", Choice::TwoLevel(10)),
];

/// The one of [`PRECONDITIONERS`] with a coarse half.
const TWO_LEVEL: (&str, Choice) = PRECONDITIONERS[8];

/// The step that the README and CI have a limit for: the 64-node cube in fans, free, Jacobi, 5 iterations, 1 sweep. A
/// line as [`measure`]'s.
///
/// # Errors
/// [`BadCase`].
pub fn cube(
    room: &mut Room,
    counter: &mut Counter<impl FnMut(Arguments<'_>)>,
) -> Result<(), BadCase> {
    let [cube, ..] = OTHERS;
    fill(room, cube)?;
    line(room, cube, &PLAIN, "check", counter)
}

const fn budget(iterations: u32, polar_sweeps: u32) -> Budget {
    Budget {
        iterations,
        polar_sweeps,
    }
}

/// Every term of the cost with and without the terms that it multiplies.
fn design() -> impl Iterator<Item = Case> {
    let preconditioners = PRECONDITIONERS.into_iter().chain(MORE_PRECONDITIONERS);
    let by_preconditioner = preconditioners.flat_map(|preconditioner| {
        [(0, 0), (6, 0), (0, 1), (6, 2)].map(|(iterations, colliders)| Case {
            preconditioner,
            budget: budget(iterations, 1),
            colliders,
            ..PLAIN
        })
    });
    let by_start = STARTS.into_iter().chain(MORE_STARTS).flat_map(|start| {
        [(0, 0, 0), (6, 0, 0), (0, 1, 0), (6, 1, 1), (3, 3, 2)].map(
            |(iterations, pins, colliders)| Case {
                start,
                budget: budget(iterations, 1),
                pins,
                colliders,
                ..PLAIN
            },
        )
    });
    let others = [
        Case {
            budget: budget(0, 0),
            ..PLAIN
        },
        Case {
            budget: budget(0, 4),
            ..PLAIN
        },
        Case {
            forces: true,
            ..PLAIN
        },
        Case {
            theta: 0.5,
            ..PLAIN
        },
        Case {
            pins: 2,
            moving: true,
            ..PLAIN
        },
        Case {
            colliders: 1,
            moving: true,
            ..PLAIN
        },
        Case {
            preconditioner: TWO_LEVEL,
            pins: 1,
            moving: true,
            ..PLAIN
        },
    ];
    by_preconditioner.chain(by_start).chain(others)
}

fn line(
    room: &mut Room,
    mesh: Rest,
    case: &Case,
    purpose: &str,
    counter: &mut Counter<impl FnMut(Arguments<'_>)>,
) -> Result<(), BadCase> {
    let label = |load: Load, say: &mut dyn FnMut(Arguments<'_>)| {
        say(format_args!(
            "{purpose} {} {} {} {} {} {} {} {} ",
            load.nodes,
            load.tets,
            load.fans,
            load.entries,
            load.coarse.aggregates,
            load.coarse.cut_blocks,
            load.coarse.products,
            load.coarse.sums,
        ));
        say(format_args!(
            "{} {} {} {} {} {} {} {} {} ",
            case.preconditioner.0,
            case.start.0,
            case.budget.iterations,
            case.budget.polar_sweeps,
            load.pins,
            load.colliders,
            u8::from(load.moving),
            u8::from(load.forces),
            u8::from(load.newmark),
        ));
    };
    counted(room, mesh, case, STATES[1], label, counter)
}

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
    let (factor, mut of);
    let preconditioner = match case.preconditioner.1 {
        Choice::Local(preconditioner) => preconditioner,
        Choice::Factored(kind) => {
            let made = factors.factor(kind, body.rest().header.fingerprint);
            factor = made.map_err(|_| BadCase)?;
            Preconditioner::Factored(&factor)
        }
        Choice::TwoLevel(count) => {
            of = [0; NODES];
            let of = &mut of[..nodes.len()];
            let made = Aggregates::divide(&body.rest(), count, of);
            Preconditioner::TwoLevel(made.map_err(|_| BadCase)?)
        }
    };
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
