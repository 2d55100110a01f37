//! What a step costs, before it is taken: a formula in the sizes of the mesh, the parts of the scene and the budget.
//!
//! ```text
//! instructions = Σ_rows factor · (c₁ + c_n nodes + c_r remainder + c_b blocks + c_f fans + c_e entries)
//! ```
//!
//! The factors are products of what the settings say ([`terms`]): 1 for the step itself, k for its iterations, k·w for
//! iterations with w stored vectors, and so on. The coefficients of a [`Machine`] were fitted to counts of an
//! emulator (`.ci/run cost` makes them anew, and says how far the formula is off on meshes that it was not
//! fitted to: less than 1 %). They hold for the compiler and the profile that stand in the README, with lanes of the
//! target's width and rest data in the factored layout. Plastic flow and fracture are not part of it: what they take
//! besides stands with them.
//!
//! ```
//! use femto::cost::{Load, Machine};
//! use femto::{Budget, Start};
//!
//! let cube = Load::new(64, 162);
//! let limit = 500_000;
//! let budget = Budget::fit(limit, &cube, Machine::CortexM4F).ok_or("a step does not fit")?;
//! assert!(budget.cost(&cube, Machine::CortexM4F) <= limit);
//! # Ok::<(), &str>(())
//! ```

mod load;
mod table;

pub use load::{Coarse, Kind, Load, SIZES};

use crate::settings::{Budget, Start};

/// Whose instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Machine {
    /// thumbv7em-none-eabihf, one lane.
    CortexM4F,
    /// x86-64 with SSE2, four lanes.
    X86_64,
    /// AArch64 with NEON, four lanes.
    Aarch64,
}

impl Machine {
    /// All, by name.
    pub const ALL: [(&str, Self); 3] = [
        ("cortex-m4f", Self::CortexM4F),
        ("x86-64", Self::X86_64),
        ("aarch64", Self::Aarch64),
    ];

    fn table(self) -> &'static Table {
        match self {
            Self::CortexM4F => &table::CORTEX_M4F,
            Self::X86_64 => &table::X86_64,
            Self::Aarch64 => &table::AARCH64,
        }
    }
}

/// Sixteenths of an instruction, by row ([`ROWS`]) and size ([`Load::sizes`]).
type Table = [[i32; SIZES]; ROWS.len()];

/// The rows of a table that no preconditioner has for itself, and after them, for each of [`Kind::ALL`], its
/// preparation without and with colliders, and its iteration; and which of the sizes a row depends on.
pub const ROWS: [(&str, [bool; SIZES]); 57] = [
    ("any sweeps", BLOCKS),
    ("a sweep", BLOCKS),
    ("a stored vector", ALL),
    ("a pair of them", NODES),
    ("a vector and iteration", NODES),
    ("translations", NODES),
    ("translations, a vector", NODES),
    ("translations, an iteration", NODES),
    ("colliders, a vector", NODES),
    ("colliders, an iteration", NODES),
    ("a collider", NODES),
    ("a pin", ONCE),
    ("pins or colliders that move", ALL),
    ("newmark", ALL),
    ("forces", NODES),
    ("start from velocity", ALL),
    ("start from velocity and force", ALL),
    ("start from rest", ALL),
    ("a past velocity", NODES),
    ("rotations", NODES),
    ("held by pins", NODES),
    ("coarse: an application more", NODES),
    ("coarse: an aggregate", ONCE),
    ("coarse: its square", ONCE),
    ("coarse: its cube", ONCE),
    ("coarse: a cut block", ONCE),
    ("coarse: a product", ONCE),
    ("coarse: a sum", ONCE),
    ("coarse: an aggregate, an application", ONCE),
    ("coarse: its square, an application", ONCE),
    ("identity: step", ALL),
    ("identity: step with colliders", ALL),
    ("identity: iteration", ALL),
    ("mass: step", ALL),
    ("mass: step with colliders", ALL),
    ("mass: iteration", ALL),
    ("jacobi: step", ALL),
    ("jacobi: step with colliders", ALL),
    ("jacobi: iteration", ALL),
    ("block-jacobi: step", ALL),
    ("block-jacobi: step with colliders", ALL),
    ("block-jacobi: iteration", ALL),
    ("warped: step", ALL),
    ("warped: step with colliders", ALL),
    ("warped: iteration", FACTOR),
    ("warped-half: step", ALL),
    ("warped-half: step with colliders", ALL),
    ("warped-half: iteration", FACTOR),
    ("laplacian: step", ALL),
    ("laplacian: step with colliders", ALL),
    ("laplacian: iteration", FACTOR),
    ("laplacian-half: step", ALL),
    ("laplacian-half: step with colliders", ALL),
    ("laplacian-half: iteration", FACTOR),
    ("two-level: step", ALL),
    ("two-level: step with colliders", ALL),
    ("two-level: iteration", ALL),
];

const ONCE: [bool; SIZES] = [true, false, false, false, false, false];
const NODES: [bool; SIZES] = [true, true, true, false, false, false];
const BLOCKS: [bool; SIZES] = [true, false, false, true, true, false];
const ALL: [bool; SIZES] = [true, true, true, true, true, false];
const FACTOR: [bool; SIZES] = [true; SIZES];

/// The row where those of the preconditioners begin, and how many each has.
const OWN: (usize, usize) = (30, 3);

/// How often a step pays each of [`ROWS`].
#[must_use]
pub fn terms(load: &Load, budget: Budget) -> [u64; ROWS.len()] {
    let (k, w) = (u64::from(budget.iterations), load.start.vectors() as u64);
    let free = u64::from(load.start.is_augmented() && load.pins == 0);
    let touching = u64::from(load.colliders > 0);
    let is = |start| u64::from(load.start == start);
    let guessed = is(Start::Velocity) + is(Start::VelocityForce);
    // Of the right-hand side and in every iteration; and of the residual of a start that is not zero.
    let more = u64::from(guessed > 0 || load.moving) * u64::from(load.coarse.aggregates > 0);
    let (aggregates, applications) = (load.coarse.aggregates as u64, 1 + k + more);
    let square = aggregates.saturating_mul(aggregates);
    let common = [
        u64::from(budget.polar_sweeps > 0),
        u64::from(budget.polar_sweeps),
        w,
        w * w.saturating_sub(1) / 2,
        w * k,
        free,
        free * w,
        free * k,
        touching * w,
        touching * k,
        load.colliders as u64,
        load.pins as u64,
        u64::from(load.moving) * (1 - guessed),
        u64::from(load.newmark),
        u64::from(load.forces),
        is(Start::Velocity),
        is(Start::VelocityForce),
        is(Start::Zero),
        load.start.history() as u64,
        u64::from(matches!(load.start, Start::Rigid(_))),
        u64::from(load.pins > 0),
        more,
        aggregates,
        square,
        square.saturating_mul(aggregates),
        load.coarse.cut_blocks as u64,
        load.coarse.products as u64,
        load.coarse.sums as u64,
        aggregates.saturating_mul(applications),
        square.saturating_mul(applications),
    ];
    let own = [1 - touching, touching, k];
    let at = OWN.0 + OWN.1 * load.preconditioner as usize;
    core::array::from_fn(|row| {
        let of_kind = row.checked_sub(at).and_then(|row| own.get(row));
        *common.get(row).or(of_kind).unwrap_or(&0)
    })
}

impl Budget {
    /// Instructions of one step.
    #[must_use]
    pub fn cost(self, load: &Load, machine: Machine) -> u64 {
        u64::try_from(self.sixteenths(load, machine) / 16).unwrap_or(0)
    }

    fn sixteenths(self, load: &Load, machine: Machine) -> i64 {
        let sizes = load.sizes();
        let mut sum = 0_i64;
        for (factor, coefficients) in terms(load, self).into_iter().zip(machine.table()) {
            for (size, coefficient) in sizes.into_iter().zip(coefficients) {
                let often = i64::try_from(factor.saturating_mul(size)).unwrap_or(i64::MAX);
                sum = sum.saturating_add(often.saturating_mul(i64::from(*coefficient)));
            }
        }
        sum
    }

    /// The largest budget whose step takes at most `limit` instructions: two sweeps, or one where two leave no
    /// iteration, and then all the iterations that fit. `None` where one sweep and one iteration do not.
    #[must_use]
    pub fn fit(limit: u64, load: &Load, machine: Machine) -> Option<Self> {
        let limit = i64::try_from(limit).unwrap_or(i64::MAX).saturating_mul(16);
        [2, 1].into_iter().find_map(|polar_sweeps| {
            let [none, one] = [0, 1].map(|iterations| {
                let budget = Self {
                    iterations,
                    polar_sweeps,
                };
                budget.sixteenths(load, machine)
            });
            let iterations = limit
                .checked_sub(none)?
                .checked_div(one.checked_sub(none)?)?;
            (iterations > 0).then(|| Self {
                iterations: u32::try_from(iterations).unwrap_or(u32::MAX),
                polar_sweeps,
            })
        })
    }
}

// Names, kinds and rows are in one order.
const _: () = assert!(OWN.0 + OWN.1 * Kind::ALL.len() == ROWS.len());
