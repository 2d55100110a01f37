//! Surfaces of colliders, as triangles to draw.

use glam::{DMat3, DVec3};

use crate::colliders::{Grid, Shape};

const RINGS: u32 = 14;
const SECTORS: u32 = 28;

/// Triangles of everything but a plane, outward.
pub fn triangles(shape: &Shape) -> Vec<[DVec3; 3]> {
    match shape {
        Shape::Plane { .. } => Vec::new(),
        &Shape::Sphere { centre, radius } => ball([centre; 2], DVec3::Y, radius),
        &Shape::Capsule { ends, radius } => {
            let axis = (ends[1] - ends[0]).try_normalize().unwrap_or(DVec3::Y);
            ball(ends, axis, radius)
        }
        &Shape::Box { centre, half, axes } => cuboid(centre, half, axes),
        Shape::HeightField { corner, axes, grid } => ground(*corner, *axes, grid),
    }
}

/// A ball about an axis, its halves pulled apart to two centres.
fn ball(ends: [DVec3; 2], axis: DVec3, radius: f64) -> Vec<[DVec3; 3]> {
    let (u, v) = if axis == DVec3::Y {
        (DVec3::Z, DVec3::X)
    } else {
        axis.any_orthonormal_pair()
    };
    let at = |ring: u32, sector: u32| {
        // The equator twice: a side of its own.
        let centre = ends[usize::from(ring <= RINGS / 2)];
        let ring = ring - u32::from(ring > RINGS / 2);
        let (sin, cos) = libm::sincos(std::f64::consts::PI * f64::from(ring) / f64::from(RINGS));
        let (s, c) = libm::sincos(std::f64::consts::TAU * f64::from(sector) / f64::from(SECTORS));
        centre + radius * (axis * cos + (u * c + v * s) * sin)
    };
    let mut triangles = Vec::new();
    for ring in 0..=RINGS {
        for sector in 0..SECTORS {
            let (a, b) = (at(ring, sector), at(ring, sector + 1));
            let (c, d) = (at(ring + 1, sector), at(ring + 1, sector + 1));
            triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
    triangles
}

fn cuboid(centre: DVec3, half: DVec3, axes: DMat3) -> Vec<[DVec3; 3]> {
    const CELLS: u32 = 4;
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            // Small enough that sorting by depth is right.
            let at = |i: u32, k: u32| {
                let part = |n: u32| 2.0 * f64::from(n) / f64::from(CELLS) - 1.0;
                let mut p = [0.0; 3];
                p[axis] = side;
                p[(axis + 1) % 3] = part(i);
                p[(axis + 2) % 3] = side * part(k);
                centre + axes * (DVec3::from(p) * half)
            };
            for (i, k) in (0..CELLS).flat_map(|i| (0..CELLS).map(move |k| (i, k))) {
                let (a, b, c, d) = (at(i, k), at(i + 1, k), at(i, k + 1), at(i + 1, k + 1));
                triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
    }
    triangles
}

fn ground(corner: DVec3, axes: DMat3, grid: &Grid) -> Vec<[DVec3; 3]> {
    let [rows, columns] = grid.samples.map(|n| n as usize);
    let at = |i: usize, k: usize| {
        let height = f64::from(grid.heights[i * columns + k]);
        let [dx, dz] = grid.spacing;
        corner + axes * DVec3::new(i as f64 * dx, height, k as f64 * dz)
    };
    let mut triangles = Vec::new();
    for i in 1..rows {
        for k in 1..columns {
            let (low, high) = (at(i - 1, k - 1), at(i, k));
            triangles.extend([[low, high, at(i, k - 1)], [low, at(i - 1, k), high]]);
        }
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the divergence theorem.
    fn volume(shape: &Shape) -> f64 {
        let six = |[a, b, c]: &[DVec3; 3]| a.dot(b.cross(*c));
        triangles(shape).iter().map(six).sum::<f64>() / 6.0
    }

    #[test]
    fn surfaces_look_outward() {
        let axes = DMat3::from_rotation_z(0.5);
        let centre = DVec3::new(1.0, 2.0, 3.0);
        let cuboid = Shape::Box {
            centre,
            half: DVec3::new(1.0, 2.0, 3.0),
            axes,
        };
        assert!((volume(&cuboid) - 48.0).abs() < 1e-9);
        let ends = [centre, centre + DVec3::new(0.0, 1.0, 2.0)];
        let round = volume(&Shape::Capsule { ends, radius: 0.5 });
        let exact = std::f64::consts::PI * (0.25 * 5_f64.sqrt() + 4.0 / 3.0 * 0.125);
        // Of a polyhedron inside.
        assert!(round < exact && round > 0.96 * exact, "{round} of {exact}");
        assert!(
            volume(&Shape::Sphere {
                centre,
                radius: 1.0
            }) > 4.0
        );
        let grid = Grid {
            heights: vec![0.0, 1.0, 2.0, 5.0],
            samples: [2, 2],
            spacing: [1.0, 2.0],
        };
        let field = Shape::HeightField {
            corner: centre,
            axes: DMat3::IDENTITY,
            grid: grid.into(),
        };
        let up = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a).y;
        assert!(triangles(&field).iter().all(|t| up(t) == 2.0));
    }
}
