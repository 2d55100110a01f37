//! What a step costs, before it is taken: a formula in the sizes of the mesh, the parts of the scene and the budget.
//!
//! ```text
//! instructions = Σ_rows factor · (c₁ + c_n nodes + c_r remainder + c_b blocks + c_f fans + c_e entries)
//! ```
//!
//! The factors are products of what the settings say ([`terms`]): 1 for the step itself, k for its iterations, k·w for
//! iterations with w stored vectors, and so on. The coefficients of a [`Machine`] were fitted to counts of an
//! emulator (`examples/firmware/fit`; `.ci/run cost` counts anew, and says how far the formula is off on meshes that it was
//! not fitted to: at most 1 %, with the energy guard 2 %, which it counts on the M4F alone). They hold for the compiler and the profile that stand in the README, with lanes of the
//! target's width and rest data in the factored layout. Of couplings between bodies it has all but the search for
//! contacts, whose cost depends on the state: [`Search`] bounds that.
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
mod rows;
mod search;
mod table;

pub use load::{Coarse, Coupled, Kind, Load, SIZES, Shapes};
pub use rows::{ROWS, terms};
pub use search::Search;

use crate::settings::Budget;

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
            let with = |iterations| Self {
                iterations,
                polar_sweeps,
            };
            let fits = |iterations| with(iterations).sixteenths(load, machine) <= limit;
            // Couplings are switched more often in longer solves: the cost is not quite linear. Bit by bit, then.
            let iterations = (0..u32::BITS).rev().fold(0, |found, bit| {
                let more = found | 1 << bit;
                if fits(more) { more } else { found }
            });
            (iterations > 0).then(|| with(iterations))
        })
    }
}
