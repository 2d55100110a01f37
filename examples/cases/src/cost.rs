//! Steps whose instructions an emulator counts, between two marker functions.
//!
//! A program calls [`prove`], [`measure`] or [`cube`]; before every counted step they say what it is, and the emulator's
//! plugin (`examples/firmware/counter.c`) finishes the line with the count.

mod counted;
mod design;

use core::fmt::Arguments;

use femto::cost::Load;

pub use crate::choices::BadCase;
use crate::choices::{MORE_STARTS, PRECONDITIONERS, STARTS};
use crate::states::STATES;
pub use counted::Room;
use counted::{counted, fill};
use design::{Case, FITTED, MORE_CHECKED, OTHERS, PLAIN, Rest, budget, design};

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
