//! Steps for the cost table.

use core::fmt::Arguments;

use femto::Budget;
use femto::cost::Load;

use super::{BadCase, Case, Counter, PLAIN, Rest, Room, counted, fill, step};
use crate::choices::{Choice, MORE_PRECONDITIONERS, MORE_STARTS, PRECONDITIONERS, STARTS};
use crate::fans;
use crate::mesh::Grid;
use crate::states::STATES;

static SMALL: Grid<27, 48> = Grid::new([2, 2, 2]);
static FLAT: Grid<48, 90> = Grid::new([5, 3, 1]);
static LONG: Grid<90, 216> = Grid::new([9, 2, 2]);
static THICK: Grid<180, 600> = Grid::new([5, 5, 4]);
static THREE: Grid<64, 162> = Grid::new([3, 3, 3]);
static BAR: Grid<208, 648> = Grid::new([12, 3, 3]);
static LARGE: Grid<480, 1800> = Grid::new([15, 5, 4]);

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
    CUBE,
    (&BAR.nodes, &fans::BAR),
    (&LARGE.nodes, &fans::LARGE),
    (&THREE.nodes, &THREE.tets),
    (&BAR.nodes, &BAR.tets),
    (&LARGE.nodes, &LARGE.tets),
];

/// The cube of the README, in fans.
pub(super) const CUBE: Rest = (&THREE.nodes, &fans::CUBE);

/// Steps of several meshes in enough different settings to fit the cost table (`fit`) and to compare it
/// (`check`). A line is: fit or check, nodes, tetrahedra, fans, entries of the factor, the four numbers of the coarse
/// half, preconditioner, start, iterations, sweeps, pins, colliders, moving, forces, newmark, guarded, spheres, capsules, boxes, height
/// fields, shapes in frames, flow, places of fracture, pieces, rigid bodies, links, slots, count.
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
    fill(room, CUBE)?;
    line(room, CUBE, &PLAIN, "check", counter)
}

pub(super) const fn budget(iterations: u32, polar_sweeps: u32) -> Budget {
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
        // The second by itself.
        Case {
            first: 1,
            colliders: 1,
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
    let label =
        |load: Load, say: &mut dyn FnMut(Arguments<'_>)| describe(purpose, case, &load, say);
    counted(room, mesh.0, case, STATES[1], label, step, counter)
}

/// A line but for its count.
pub(super) fn describe(
    purpose: &str,
    case: &Case,
    load: &Load,
    say: &mut dyn FnMut(Arguments<'_>),
) {
    let (coarse, shapes, coupled) = (load.coarse, load.shapes, load.coupled);
    say(format_args!(
        "{purpose} {} {} {} {} {} {} {} {} ",
        load.nodes,
        load.tets,
        load.fans,
        load.entries,
        coarse.aggregates,
        coarse.cut_blocks,
        coarse.products,
        coarse.sums,
    ));
    say(format_args!(
        "{} {} {} {} {} {} {} {} {} {} ",
        case.preconditioner.0,
        case.start.0,
        case.budget.iterations,
        case.budget.polar_sweeps,
        load.pins,
        load.colliders,
        u8::from(load.moving),
        u8::from(load.forces),
        u8::from(load.newmark),
        u8::from(load.guarded),
    ));
    say(format_args!(
        "{} {} {} {} {} {} {} {} {} {} {} ",
        shapes.spheres,
        shapes.capsules,
        shapes.boxes,
        shapes.height_fields,
        shapes.placed,
        u8::from(load.flows),
        load.tears,
        coupled.pieces,
        coupled.rigids,
        coupled.links,
        coupled.slots,
    ));
}

/// [`measure`] for what the features add: shapes of colliders and couplings (with `contact`), flow and fracture; with
/// `guard` colliders under the guard of their energy.
///
/// # Errors
/// [`BadCase`].
#[cfg(any(
    feature = "contact",
    feature = "plasticity",
    feature = "fracture",
    feature = "guard"
))]
pub fn measure_more(
    room: &mut Room,
    counter: &mut Counter<impl FnMut(Arguments<'_>)>,
) -> Result<(), BadCase> {
    let inelastic = cfg!(any(feature = "plasticity", feature = "fracture"));
    let guarded = cfg!(feature = "guard");
    let fitted = FITTED.into_iter().map(|mesh| ("fit", mesh));
    for (purpose, mesh) in fitted.chain(OTHERS.map(|mesh| ("check", mesh))) {
        fill(room, mesh)?;
        // Of [`counted`]'s list.
        let shapes: &[(usize, usize)] = match purpose {
            _ if inelastic => &[],
            "fit" if guarded => &[(0, 1), (0, 2), (1, 1), (2, 1), (3, 1), (4, 1), (5, 1)],
            "fit" => &[(2, 1), (3, 1), (4, 1), (5, 1)],
            _ => &[(2, 3), (0, 6)],
        };
        for &(first, colliders) in shapes {
            let case = Case {
                first,
                colliders,
                ..PLAIN
            };
            line(room, mesh, &case, purpose, counter)?;
        }
        let starts = STARTS.into_iter().chain(MORE_STARTS);
        for (j, start) in starts.filter(|_| guarded).enumerate() {
            for pins in 0..2 {
                let case = Case {
                    start,
                    pins,
                    preconditioner: PRECONDITIONERS[(2 * j + pins) % PRECONDITIONERS.len()],
                    budget: budget(3 + pins as u32, 1),
                    colliders: 1 + (j + pins) % 2,
                    ..PLAIN
                };
                line(room, mesh, &case, purpose, counter)?;
            }
        }
        let tears: &[u32] = match purpose {
            _ if !inelastic => &[],
            "fit" => &[1, 8, 16],
            _ => &[4],
        };
        for &tears in tears {
            line(room, mesh, &Case { tears, ..PLAIN }, purpose, counter)?;
        }
    }
    #[cfg(feature = "contact")]
    if !inelastic {
        super::coupled::measure(room, counter)?;
    }
    Ok(())
}
