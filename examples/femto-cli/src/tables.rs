//! `final.csv` and `trace.csv`.

use std::fs::File;
use std::path::Path;

use csv::Writer;
use serde::Serialize;

use crate::sim::{Measure, Sim, StepInfo};

/// A row of `trace.csv`: the state after a step. Numbers are written so that they read
/// back to the same bits.
#[derive(Serialize)]
pub struct TraceRow {
    pub step: u32,
    pub time: f64,
    pub kinetic: f64,
    pub elastic: f64,
    pub potential: f64,
    pub residual: f64,
    pub px: f64,
    pub py: f64,
    pub pz: f64,
    pub lx: f64,
    pub ly: f64,
    pub lz: f64,
    /// Of the tets that have not broken; empty where all have.
    pub min_det: Option<f64>,
    pub contacts: u32,
}

impl TraceRow {
    pub fn new(step: u32, time: f64, info: StepInfo, after: &Measure) -> Self {
        let [px, py, pz] = after.linear;
        let [lx, ly, lz] = after.angular;
        TraceRow {
            step,
            time,
            kinetic: after.energy.kinetic,
            elastic: after.energy.elastic,
            potential: after.energy.potential,
            residual: info.residual,
            px,
            py,
            pz,
            lx,
            ly,
            lz,
            min_det: after.min_det.is_finite().then_some(after.min_det),
            contacts: info.contacts,
        }
    }
}

/// The head, for a run without steps; with steps it comes from the first row.
pub const TRACE_HEAD: [&str; 14] = [
    "step",
    "time",
    "kinetic",
    "elastic",
    "potential",
    "residual",
    "px",
    "py",
    "pz",
    "lx",
    "ly",
    "lz",
    "min_det",
    "contacts",
];

pub fn trace(path: &Path) -> csv::Result<Writer<File>> {
    let mut writer = csv::WriterBuilder::new()
        .has_headers(false)
        .from_path(path)?;
    writer.write_record(TRACE_HEAD)?;
    Ok(writer)
}

/// One row a node; nine significant digits give each f32 back exactly.
pub fn write_final(path: &Path, sim: &Sim) -> csv::Result<()> {
    let mut writer = Writer::from_path(path)?;
    writer.write_record(["body", "node", "x", "y", "z", "vx", "vy", "vz"])?;
    for body in 0..sim.bodies() {
        for (node, (x, v)) in sim
            .positions(body)
            .iter()
            .zip(sim.velocities(body))
            .enumerate()
        {
            let mut row = vec![body.to_string(), node.to_string()];
            row.extend(x.iter().chain(v).map(|value| format!("{value:.8e}")));
            writer.write_record(&row)?;
        }
    }
    writer.flush()?;
    Ok(())
}

/// Of the bounding box, metres.
pub fn diagonal(nodes: &[[f32; 3]]) -> f64 {
    let fold = |start: f32, pick: fn(f32, f32) -> f32| {
        let all = nodes.iter();
        all.fold([start; 3], |a, b| std::array::from_fn(|i| pick(a[i], b[i])))
    };
    let low = fold(f32::INFINITY, f32::min);
    let high = fold(f32::NEG_INFINITY, f32::max);
    squared_distance(&low, &high).sqrt()
}

/// RMS distance of the nodes, metres.
pub fn rms(a: &[[f32; 3]], b: &[[f32; 3]]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| squared_distance(a, b));
    (squares.sum::<f64>() / a.len() as f64).sqrt()
}

fn squared_distance(a: &[f32; 3], b: &[f32; 3]) -> f64 {
    let pairs = a.iter().zip(b);
    pairs
        .map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2))
        .sum()
}
