//! The meshes and the steps that are counted.

use femto::{Budget, Start};

use crate::choices::{Choice, JACOBI, MORE_PRECONDITIONERS, MORE_STARTS, PRECONDITIONERS, STARTS};
use crate::fans;
use crate::mesh::Grid;

static SMALL: Grid<27, 48> = Grid::new([2, 2, 2]);
static FLAT: Grid<48, 90> = Grid::new([5, 3, 1]);
static LONG: Grid<90, 216> = Grid::new([9, 2, 2]);
static THICK: Grid<180, 600> = Grid::new([5, 5, 4]);
static CUBE: Grid<64, 162> = Grid::new([3, 3, 3]);
static BAR: Grid<208, 648> = Grid::new([12, 3, 3]);
static LARGE: Grid<NODES, TETS> = Grid::new([15, 5, 4]);

/// Of the largest mesh.
pub(super) const NODES: usize = 480;
pub(super) const TETS: usize = 1800;

/// A mesh, borrowed.
pub(super) type Rest = (&'static [[f32; 3]], &'static [[u32; 4]]);

/// The meshes that the cost table is fitted to, in the order of their cells and in fans.
pub(super) const FITTED: [Rest; 8] = [
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
pub(super) const OTHERS: [Rest; 6] = [
    (&CUBE.nodes, &fans::CUBE),
    (&BAR.nodes, &fans::BAR),
    (&LARGE.nodes, &fans::LARGE),
    (&CUBE.nodes, &CUBE.tets),
    (&BAR.nodes, &BAR.tets),
    (&LARGE.nodes, &LARGE.tets),
];

/// One step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case {
    pub preconditioner: (&'static str, Choice),
    pub start: (&'static str, Start),
    pub budget: Budget,
    pub pins: usize,
    pub colliders: usize,
    pub moving: bool,
    pub forces: bool,
    pub theta: f32,
    pub gravity: f32,
    pub dt: f32,
    /// Flows and breaks, with the feature `inelastic`.
    pub inelastic: bool,
}

pub(super) const PLAIN: Case = Case {
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

/// With other numbers of aggregates than those that it was fitted to.
pub(super) const MORE_CHECKED: [(&str, Choice); 2] = [
    ("two-level", Choice::TwoLevel(5)),
    ("two-level", Choice::TwoLevel(10)),
];

/// The one of [`PRECONDITIONERS`] with a coarse half.
const TWO_LEVEL: (&str, Choice) = PRECONDITIONERS[8];

pub(super) const fn budget(iterations: u32, polar_sweeps: u32) -> Budget {
    Budget {
        iterations,
        polar_sweeps,
    }
}

/// Every term of the cost with and without the terms that it multiplies.
pub(super) fn design() -> impl Iterator<Item = Case> {
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
