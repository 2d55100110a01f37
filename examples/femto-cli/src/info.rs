//! `femto info`: a mesh at a glance, and everything that is wrong with it.

use std::fmt::Write as _;
use std::path::Path;

use femto::surface::boundary_triangles;
use glam::DVec3;

use crate::error::Error;
use crate::mesh::check::{self, Problem};
use crate::mesh::{self, Mesh, shape};
use crate::{asset_info, sim};

/// How many problems are listed one by one.
const LISTED: usize = 20;

/// Returns the exit status, 0 or 2.
pub fn command(path: &Path) -> Result<u8, Error> {
    let wrong = |what: String| Error::Mesh {
        file: path.display().to_string(),
        what,
    };
    if path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("femto"))
    {
        let bytes = std::fs::read(path).map_err(|source| Error::Read {
            path: path.into(),
            source,
        })?;
        let name = path.display().to_string();
        crate::print(&asset_info::describe(&name, &bytes)?);
        return Ok(0);
    }
    let mesh = mesh::load(path).map_err(wrong)?;
    let problems = check::problems(&mesh);
    crate::print(&look_over(&path.display().to_string(), &mesh, &problems));
    check::first_of(&problems).map_or(Ok(0), |first| Err(wrong(first)))
}

/// A mesh at a glance, and what is wrong with it.
pub fn look_over(name: &str, mesh: &Mesh, problems: &[Problem]) -> String {
    let mut text = format!("{name}: {}\n", mesh.format);
    describe(&mut text, mesh);
    if problems.is_empty() {
        text += "nothing wrong\n";
        return text;
    }
    let _ = writeln!(text, "{} wrong:", things(problems.len()));
    for problem in problems.iter().take(LISTED) {
        let _ = writeln!(text, "  {problem}");
    }
    if problems.len() > LISTED {
        let _ = writeln!(text, "  and {} more", problems.len() - LISTED);
    }
    text
}

fn things(count: usize) -> String {
    if count == 1 {
        "1 thing".into()
    } else {
        format!("{} things", thousands(count))
    }
}

fn describe(text: &mut String, mesh: &Mesh) {
    let mut row = |name: &str, value: String| {
        let _ = writeln!(text, "  {name:<14}{value}");
    };
    row("nodes", thousands(mesh.nodes.len()));
    row("tets", thousands(mesh.tets.len()));
    for note in &mesh.notes {
        row("note", note.clone());
    }
    let finite = || mesh.nodes.iter().filter(|p| p.is_finite());
    let low = finite().fold(DVec3::INFINITY, |low, &p| low.min(p));
    let high = finite().fold(DVec3::NEG_INFINITY, |high, &p| high.max(p));
    if low.is_finite() {
        let size = high - low;
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            row(
                name,
                format!(
                    "{} to {}  ({})",
                    digits(low[axis]),
                    digits(high[axis]),
                    digits(size[axis])
                ),
            );
        }
    }

    // Tets whose nodes exist and are somewhere; the others are among the problems.
    let tets: Vec<usize> = (0..mesh.tets.len())
        .filter(|&t| {
            let corners = mesh.corners(mesh.tets[t]);
            corners.is_some_and(|corners| corners.iter().all(|c| c.is_finite()))
        })
        .collect();
    let nodes: Vec<[u32; 4]> = tets.iter().map(|&t| mesh.tets[t]).collect();
    let corners: Vec<[DVec3; 4]> = nodes.iter().filter_map(|&t| mesh.corners(t)).collect();
    if tets.is_empty() {
        return;
    }
    row("pieces", thousands(shape::pieces(mesh.nodes.len(), &nodes)));
    let surface = boundary_triangles(&nodes);
    let area: f64 = surface
        .iter()
        .map(|f| shape::triangle_area(f.map(|n| mesh.nodes[n as usize])))
        .sum();
    row(
        "surface",
        format!(
            "{} triangles, area {}",
            thousands(surface.len()),
            digits(area)
        ),
    );
    let crowded = shape::crowded_faces(&nodes);
    if crowded > 0 {
        row(
            "warning",
            format!(
                "{} faces belong to more than two tets: the mesh overlaps itself",
                thousands(crowded)
            ),
        );
    }

    let mut volumes: Vec<f64> = corners.iter().map(|&c| shape::volume(c)).collect();
    let total: f64 = volumes.iter().sum();
    volumes.sort_by(f64::total_cmp);
    row("volume", format!("{} in all", digits(total)));
    row(
        "  of a tet",
        format!(
            "min {}, median {}, max {}",
            digits(volumes[0]),
            digits(volumes[volumes.len() / 2]),
            digits(volumes[volumes.len() - 1])
        ),
    );
    let mut quality: Vec<(f64, usize)> = corners
        .iter()
        .zip(&tets)
        .map(|(&c, &t)| (shape::mean_ratio(c), t))
        .collect();
    quality.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let median = quality[quality.len() / 2].0;
    row(
        "quality",
        format!(
            "mean ratio, 1 for a regular tet: min {:.3}, median {median:.3}",
            quality[0].0
        ),
    );
    let worst: Vec<String> = quality
        .iter()
        .take(5)
        .map(|(q, t)| format!("tet {} {q:.3}", mesh.tet_names[*t]))
        .collect();
    row("  worst", worst.join(", "));

    let layouts = sim::memory_of_mesh(mesh.nodes.len(), mesh.tets.len());
    for (layout, m) in ["factored", "dense"].into_iter().zip(layouts) {
        let bytes = format!(
            "rest {}, state {}, workspace {} bytes",
            thousands(m.rest),
            thousands(m.state),
            thousands(m.workspace)
        );
        row(layout, bytes);
    }
}

/// 12345 as 12,345.
pub fn thousands(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Six significant digits.
fn digits(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    match value.abs() {
        1e-3..1e6 => {
            let decimals = (5.0 - libm::floor(libm::log10(value.abs()))).clamp(0.0, 8.0) as usize;
            let text = format!("{value:.decimals$}");
            if text.contains('.') {
                text.trim_end_matches('0').trim_end_matches('.').into()
            } else {
                text
            }
        }
        _ => format!("{value:.5e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_for_people() {
        assert_eq!(thousands(0), "0");
        assert_eq!(thousands(999), "999");
        assert_eq!(thousands(1000), "1,000");
        assert_eq!(thousands(1234567), "1,234,567");
        assert_eq!(digits(0.25), "0.25");
        assert_eq!(digits(-123.456789), "-123.457");
        assert_eq!(digits(1.5e-7), "1.50000e-7");
        assert_eq!(digits(999999.7), "1000000");
    }
}
