//! The surface of a mesh of tetrahedra (feature `alloc`): where pressure and wind act, and what others touch.
//!
//! A mesh for firmware gets its triangles on the host, as it gets its order.

use alloc::vec::Vec;

use glam::Vec3;

use crate::math::sqrt;

/// The four faces of a positively oriented tetrahedron, each counter-clockwise as seen from outside.
const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// The faces that only one tetrahedron has: three nodes each, counter-clockwise as seen from outside, so that
/// (x₁ − x₀) × (x₂ − x₀) points outward. In the order of their tetrahedra. Those of a mesh are a closed
/// surface; a cavity inside is part of it.
///
/// Time and memory are in proportion to the number of tetrahedra, sorting aside.
#[must_use]
pub fn boundary_triangles(tets: &[[u32; 4]]) -> Vec<[u32; 3]> {
    let boundary = boundary(tets);
    boundary.into_iter().map(|(_, triangle)| triangle).collect()
}

/// [`boundary_triangles`], each behind the place of its tetrahedron.
#[must_use]
pub fn boundary(tets: &[[u32; 4]]) -> Vec<(usize, [u32; 3])> {
    let mut faces = Vec::with_capacity(4 * tets.len());
    for corners in tets {
        for face in FACES {
            let face = face.map(|corner| corners[corner]);
            let mut nodes = face;
            nodes.sort_unstable();
            faces.push((nodes, faces.len(), face));
        }
    }
    faces.sort_unstable();
    let mut outer: Vec<_> = faces
        .chunk_by(|a, b| a.0 == b.0)
        .filter_map(|same| match same {
            &[(_, place, face)] => Some((place, face)),
            _ => None,
        })
        .collect();
    outer.sort_unstable();
    outer
        .into_iter()
        .map(|(place, face)| (place / FACES.len(), face))
        .collect()
}

/// cos 30°
const FLAT: f32 = 0.866_025_4;

/// The edges of a closed surface that stick out: where its two triangles, as the nodes are at rest, turn away from each
/// other by more than 30°. Of each the two ends, and the third nodes of the triangles on its left and its right.
///
/// Time and memory are in proportion to the number of triangles, sorting aside.
#[must_use]
pub fn sharp_edges(nodes: &[[f32; 3]], triangles: &[[u32; 3]]) -> Vec<[u32; 4]> {
    let at = |node: u32| Vec3::from_array(nodes.get(node as usize).copied().unwrap_or_default());
    let normal = |[a, b, c]: [u32; 3]| (at(b) - at(a)).cross(at(c) - at(a));
    let mut halves: Vec<([u32; 2], bool, u32)> = Vec::with_capacity(3 * triangles.len());
    for &[a, b, c] in triangles {
        for (i, j, third) in [(a, b, c), (b, c, a), (c, a, b)] {
            halves.push(([i.min(j), i.max(j)], i > j, third));
        }
    }
    halves.sort_unstable();
    let both = halves.chunk_by(|a, b| a.0 == b.0);
    both.filter_map(|same| {
        // A surface that touches itself along an edge has four.
        let &[([i, j], false, left), (_, true, right)] = same else {
            return None;
        };
        let (n, m) = (normal([i, j, left]), normal([j, i, right]));
        let turn = n.dot(m);
        let lengths = sqrt(n.dot(n)) * sqrt(m.dot(m));
        let sharp = lengths > 0.0 && turn < FLAT * lengths && n.dot(at(right) - at(i)) < 0.0;
        sharp.then_some([i, j, left, right])
    })
    .collect()
}
