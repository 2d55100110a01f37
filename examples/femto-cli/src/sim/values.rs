//! What a simulation says of itself.

use std::time::Duration;

use femto::StepReport;
use serde::Serialize;

#[derive(Clone, Copy, Debug, Default)]
pub struct Energies {
    pub kinetic: f64,
    pub elastic: f64,
    pub potential: f64,
}

impl Energies {
    pub fn total(&self) -> f64 {
        self.kinetic + self.elastic + self.potential
    }
}

/// What a state is worth, summed over the bodies.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    pub energy: Energies,
    pub linear: [f64; 3],
    pub angular: [f64; 3],
    pub min_det: f64,
}

/// What a step says of itself.
#[derive(Clone, Copy, Debug)]
pub struct StepInfo {
    /// ‖b − Av‖/‖b‖ of the last substep, all bodies stacked; 0 where ‖b‖ = 0.
    pub residual: f64,
    pub contacts: u32,
    /// Contacts of all substeps that found no room.
    pub dropped: u32,
    /// Time in the solver.
    pub took: Duration,
}

/// Bytes.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Memory {
    pub rest: usize,
    pub factor: usize,
    pub state: usize,
    pub workspace: usize,
}

/// What plastic flow and fracture have done, summed over the bodies.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Damage {
    pub dissipated_joules: f64,
    pub broken_tets: u32,
    /// How many tets may still break; `null` where none of the bodies breaks.
    pub reserve_left: Option<u32>,
}

impl Damage {
    pub(super) fn add(&mut self, report: &StepReport) {
        self.dissipated_joules += f64::from(report.dissipated);
        self.broken_tets += report.fracture.broken;
        if let Some(left) = &mut self.reserve_left {
            *left = report.fracture.left;
        }
    }
}
