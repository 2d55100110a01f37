//! `report.json`.

use std::time::Duration;

use serde::Serialize;

use crate::scene_file::{Budget, Solver};
use crate::sim::{Damage, Energies, Memory};

#[derive(Serialize)]
pub struct Report<'a> {
    pub crate_version: &'a str,
    pub scene: &'a str,
    pub nodes: usize,
    pub tets: usize,
    pub bytes: Memory,
    pub budget: Budget,
    pub solver: &'a Solver,
    /// FNV-1a over all x, then all v, body by body: 16 hex digits.
    pub state_hash: String,
    pub energy: FirstAndLast,
    pub seconds_per_step: StepTimes,
    pub steps_run: u32,
    /// Of scenes whose bodies yield or break.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damage: Option<Damage>,
    /// Contacts between bodies that found no room; only where bodies touch.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contacts_dropped: Option<u64>,
    /// "completed", or "refused: " and why.
    pub ended: String,
}

/// At the start and after the last step that was made.
#[derive(Serialize)]
pub struct FirstAndLast {
    pub first: EnergyReport,
    pub last: EnergyReport,
}

#[derive(Serialize)]
pub struct EnergyReport {
    pub kinetic: f64,
    pub elastic: f64,
    pub potential: f64,
    pub total: f64,
}

impl From<Energies> for EnergyReport {
    fn from(e: Energies) -> Self {
        EnergyReport {
            kinetic: e.kinetic,
            elastic: e.elastic,
            potential: e.potential,
            total: e.total(),
        }
    }
}

/// Seconds of the solver alone, without measuring and writing; null when no step was made.
#[derive(Clone, Copy, Default, Serialize)]
pub struct StepTimes {
    pub min: Option<f64>,
    pub median: Option<f64>,
}

impl StepTimes {
    pub fn new(times: &mut [Duration]) -> Self {
        times.sort_unstable();
        let seconds = |i: usize| times.get(i).map(Duration::as_secs_f64);
        StepTimes {
            min: seconds(0),
            median: seconds(times.len() / 2),
        }
    }
}
