//! `femto info` of an asset.

use std::fmt::Write as _;

use femto::asset::{Asset, AssetBytes, VERSION};
use femto::preconditioner::factor::Entries;
use femto::{Factor, Start};

use crate::error::Error;
use crate::info::thousands;

/// What is in an asset, line by line, under its name.
pub fn describe(name: &str, bytes: &[u8]) -> Result<String, Error> {
    let aligned = AssetBytes::copy_from(bytes);
    let asset = Asset::new(&aligned).map_err(|e| Error::Mesh {
        file: name.into(),
        what: e.to_string(),
    })?;
    let mut text = format!("{name}: femto asset, version {VERSION}\n");
    let mut row = |name: &str, value: String| {
        let _ = writeln!(text, "  {name:<14}{value}");
    };
    let (header, metadata) = (asset.rest.header, asset.metadata);
    row("source", crate::error::one_line(metadata.source));
    row("nodes", thousands(asset.rest.nodes.len()));
    row("tets", thousands(header.tets as usize));
    row("pins", thousands(asset.pins.len()));
    let material = metadata.material;
    row(
        "material",
        format!(
            "E = {:e} Pa, ν = {}, {} kg/m³; α = {} 1/s, β = {} s",
            material.young(),
            material.poisson(),
            material.density(),
            material.alpha(),
            material.beta()
        ),
    );
    row("mass", format!("{} kg", header.total_mass));
    row(
        "units",
        format!("{} m, {} kg", header.length_unit, header.mass_unit),
    );
    let settings = metadata.settings;
    row(
        "step",
        format!("dt = {} s, theta = {}", settings.dt(), settings.theta()),
    );
    row(
        "budget",
        format!(
            "{} iterations, {} polar sweeps, start {}",
            settings.budget.iterations,
            settings.budget.polar_sweeps,
            start_name(settings.start)
        ),
    );
    row(
        "factor",
        asset.factor.as_ref().map_or("none".into(), factor),
    );
    let (state, workspace) = asset.ram(settings.start);
    row("flash", format!("{} bytes", thousands(bytes.len())));
    row(
        "RAM",
        format!(
            "state {}, workspace {} bytes",
            thousands(state),
            thousands(workspace)
        ),
    );
    row("fingerprint", format!("{:016x}", header.fingerprint));
    row("checksum", format!("{:016x}", asset_checksum(bytes)));
    Ok(text)
}

/// Where the format has it.
fn asset_checksum(bytes: &[u8]) -> u64 {
    let stored = bytes.get(16..24).and_then(|bytes| bytes.first_chunk());
    stored.map_or(0, |bytes| u64::from_le_bytes(*bytes))
}

fn factor(factor: &Factor<'_>) -> String {
    let kind = match factor.entries() {
        Entries::Warped { .. } => "warped, f32",
        Entries::WarpedHalf { .. } => "warped, f16",
        Entries::Laplacian { .. } => "laplacian, f32",
        Entries::LaplacianHalf { .. } => "laplacian, f16",
        _ => "of an unknown kind",
    };
    format!(
        "{kind}: {} scalars, {} bytes",
        thousands(factor.scalars()),
        thousands(factor.bytes())
    )
}

fn start_name(start: Start) -> String {
    match start {
        Start::Zero => "zero".into(),
        Start::Velocity => "velocity".into(),
        Start::VelocityForce => "velocity-force".into(),
        Start::Galerkin(m) => format!("galerkin-{m}"),
        Start::Rigid(m) => format!("rigid-{m}"),
        _ => "unknown".into(),
    }
}
