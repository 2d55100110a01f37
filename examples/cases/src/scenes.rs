//! The scenes whose bits are compared on every target, and the hashes that they must give.
//!
//! One scene of each kind, each preconditioner, each start: 16 nodes, 18 tetrahedra (27 and 48 in fans), 1,000 steps,
//! with a hash of all positions and velocities after steps 1, 20 and 1,000. The hashes are those of `golden.txt`;
//! after a change of the numerics, `cargo run --release -p femto-cases --features guard --bin bits -- --bless` writes them anew.

use femto::body::State;
use femto::element::{Dense, Layout};
use femto::energy::StateHash;
use femto::glam::Vec3;
use femto::{Body, Collider, Material, Mesh, Pin, Scene, Settings, Start, blocks};

pub use crate::choices::BadCase;
use crate::choices::{COARSE, Choice, HISTORY, Held, JACOBI, PRECONDITIONERS, STARTS, VECTORS};
use crate::factor::FactorRoom;
use crate::fans;
use crate::mesh::Grid;

/// Steps after which the state is hashed.
pub const CHECKPOINTS: [u32; 3] = [1, 20, 1000];

/// Steps of a whole run.
pub const STEPS: u32 = 1000;

/// Of the larger mesh.
const NODES: usize = 27;
const TETS: usize = 48;
/// Of all scenes but those in fans.
pub static MESH: Grid<16, 18> = Grid::new([3, 1, 1]);
/// Young's modulus (Pa), Poisson's ratio, density (kg/m³).
pub const MATERIAL: [f32; 3] = [2e4, 0.4, 1000.0];
/// α (1/s) and β (s).
pub const DAMPING: [f32; 2] = [0.05, 1e-4];
/// Large enough for tetrahedra that are listed in fans to make some.
static CUBE: Grid<NODES, TETS> = Grid::new([2, 2, 2]);

/// A body of either layout, with room for any start.
type AnyBody<L> = Body<NODES, { blocks(TETS) }, HISTORY, VECTORS, L, COARSE>;

/// What the scenes run in; all bits zero, to be a `static`.
#[derive(Debug, Default)]
pub struct Bodies {
    factored: AnyBody<femto::element::Factored>,
    dense: AnyBody<Dense>,
    saved: State<NODES, { blocks(TETS) }, HISTORY>,
    factor: FactorRoom<NODES, { 6 * TETS }>,
}

impl Bodies {
    /// Empty.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            factored: Body::new(),
            dense: Body::new(),
            saved: State::new(),
            factor: FactorRoom::new(),
        }
    }
}

/// What holds the body and what it meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum World {
    /// Thrown, spinning.
    Free,
    /// Two nodes held, one moved.
    Pinned,
    /// Thrown on a slope and a moving ball, with friction.
    Contact,
    /// The same with a ball at rest and a stiff body, under the guard of its energy.
    #[cfg(feature = "guard")]
    Guarded,
}

/// One scene.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// First and second part of its name.
    pub name: [&'static str; 2],
    world: World,
    start: Start,
    preconditioner: Choice,
    theta: f32,
    dense: bool,
    fans: bool,
    rolls_back: bool,
}

impl Case {
    const fn new(name: &'static str, world: World) -> Self {
        Self {
            name: ["scene", name],
            world,
            start: Start::Galerkin(1),
            preconditioner: JACOBI.1,
            theta: 1.0,
            dense: false,
            fans: false,
            rolls_back: false,
        }
    }
}

const KINDS: [Case; 7 + cfg!(feature = "guard") as usize] = [
    Case::new("spin", World::Free),
    Case::new("pinned", World::Pinned),
    Case::new("contact", World::Contact),
    Case {
        theta: 0.5,
        ..Case::new("newmark", World::Contact)
    },
    Case {
        dense: true,
        ..Case::new("dense", World::Contact)
    },
    Case {
        fans: true,
        ..Case::new("fans", World::Contact)
    },
    // Must have the hashes of "contact".
    Case {
        rolls_back: true,
        ..Case::new("snapshot", World::Contact)
    },
    #[cfg(feature = "guard")]
    Case::new("guard", World::Guarded),
];

/// How much stiffer the guarded body is, for the guard to act: without it, the hashes are others.
#[cfg(feature = "guard")]
const STIFFER: f32 = 128.0;

/// All scenes: each kind, each preconditioner in contact, each start of a free body.
pub fn cases() -> impl Iterator<Item = Case> {
    let preconditioners = PRECONDITIONERS.iter().map(|&(name, preconditioner)| Case {
        name: ["preconditioner", name],
        preconditioner,
        ..Case::new(name, World::Contact)
    });
    let starts = STARTS.iter().map(|&(name, start)| Case {
        name: ["start", name],
        start,
        ..Case::new(name, World::Free)
    });
    KINDS.into_iter().chain(preconditioners).chain(starts)
}

/// Runs a scene for `steps` steps and hands every checkpoint's hash over.
///
/// # Errors
/// [`BadCase`].
pub fn run(
    case: &Case,
    bodies: &mut Bodies,
    steps: u32,
    checkpoint: impl FnMut(u32, u64),
) -> Result<(), BadCase> {
    let Bodies {
        factored,
        dense,
        saved,
        factor,
    } = bodies;
    factor.fill(MESH.nodes.len(), &MESH.tets);
    if case.dense {
        run_body(case, dense, saved, factor, steps, checkpoint)
    } else {
        run_body(case, factored, saved, factor, steps, checkpoint)
    }
}

fn run_body<L: Layout>(
    case: &Case,
    body: &mut AnyBody<L>,
    saved: &mut State<NODES, { blocks(TETS) }, HISTORY>,
    factors: &FactorRoom<NODES, { 6 * TETS }>,
    steps: u32,
    mut checkpoint: impl FnMut(u32, u64),
) -> Result<(), BadCase> {
    let (nodes, tets): (&[_], &[_]) = if case.fans {
        (&CUBE.nodes, &fans::SMALL)
    } else {
        (&MESH.nodes, &MESH.tets)
    };
    let mesh = Mesh::new(nodes, tets).map_err(|_| BadCase)?;
    let [young, poisson, density] = MATERIAL;
    #[cfg(feature = "guard")]
    let young = if case.world == World::Guarded {
        STIFFER * young
    } else {
        young
    };
    let material = Material::new(young, poisson, density)
        .and_then(|m| m.with_damping(DAMPING[0], DAMPING[1]))
        .map_err(|_| BadCase)?;
    body.fill(&mesh, &material).map_err(|_| BadCase)?;
    let mut v = [[0.0; 3]; NODES];
    let v = &mut v[..nodes.len()];
    if case.world != World::Pinned {
        for (v, x) in v.iter_mut().zip(nodes) {
            // Thrown along x, turning about an axis that is none of the body's.
            *v = [
                1.0 - 4.0 * x[1] + 3.0 * x[2],
                0.5 + 4.0 * x[0],
                -0.25 - 3.0 * x[0],
            ];
        }
    }
    body.place(nodes, v).map_err(|_| BadCase)?;

    let mut held = Held::<NODES>::new();
    let choice = case.preconditioner;
    let preconditioner = choice.prepare(&body.rest(), factors, &mut held)?;
    let settings = Settings::new(1.0 / 150.0)
        .and_then(|s| s.with_theta(case.theta))
        .map_err(|_| BadCase)?
        .with_start(case.start)
        .with_preconditioner(preconditioner);
    #[cfg(feature = "guard")]
    let settings = if case.world == World::Guarded {
        settings.with_energy_guard()
    } else {
        settings
    };
    let pins = [
        Pin::held(0),
        Pin::held(1),
        Pin {
            node: 12,
            velocity: Vec3::new(0.0, 0.01, -0.005),
        },
    ];
    let slope = Collider::half_space(Vec3::new(0.1, 1.0, 0.05), 0.0)
        .and_then(|c| c.with_friction(0.4))
        .map_err(|_| BadCase)?;
    let rolling = if case.world == World::Contact {
        Vec3::new(0.01, 0.0, 0.02)
    } else {
        Vec3::ZERO
    };
    let ball = Collider::sphere(Vec3::new(0.5, -0.5, 0.1), 0.45)
        .and_then(|c| c.with_friction(0.2))
        .and_then(|c| c.with_velocity(rolling))
        .map_err(|_| BadCase)?;
    let mut colliders = [slope, ball];
    for step in 1..=steps {
        let scene = Scene {
            gravity: Vec3::new(0.0, -9.81, 0.0),
            forces: &[],
            pins: if case.world == World::Pinned {
                &pins
            } else {
                &[]
            },
            colliders: match case.world {
                World::Free | World::Pinned => &[],
                _ => &colliders,
            },
        };
        if case.rolls_back && step % 16 == 0 {
            saved.copy_from(body.state());
            for _ in 0..8 {
                _ = body.step(&scene, &settings);
            }
            body.state_mut().copy_from(saved);
        }
        // A refused step is a result, too: the state stays as it is, on every target.
        _ = body.step(&scene, &settings);
        colliders.iter_mut().for_each(|c| c.advance(settings.dt()));
        if CHECKPOINTS.contains(&step) {
            checkpoint(
                step,
                StateHash::new()
                    .with(body.positions(), body.velocities())
                    .value(),
            );
        }
    }
    Ok(())
}

/// The committed hash of a scene after so many steps.
#[must_use]
pub fn golden(case: &Case, step: u32) -> Option<u64> {
    include_str!("../golden.txt").lines().find_map(|line| {
        let mut words = line.split_ascii_whitespace();
        let same = words.next() == Some(case.name[0])
            && words.next() == Some(case.name[1])
            && words.next()?.parse() == Ok(step);
        let hash = words.next()?;
        same.then(|| u64::from_str_radix(hash, 16).ok()).flatten()
    })
}

/// Runs all scenes, each for as many steps as `steps` says, and compares with the golden hashes. `report` hears
/// of every checkpoint: case, step, hash, and whether it is right. Returns how many are wrong, or scenes
/// that did not run.
pub fn check(
    bodies: &mut Bodies,
    steps: impl Fn(&Case) -> u32,
    mut report: impl FnMut(&Case, u32, u64, bool),
) -> u32 {
    let mut wrong = 0;
    for case in cases() {
        let outcome = run(&case, bodies, steps(&case), |step, hash| {
            let right = golden(&case, step) == Some(hash);
            wrong += u32::from(!right);
            report(&case, step, hash, right);
        });
        wrong += u32::from(outcome.is_err());
    }
    wrong
}
