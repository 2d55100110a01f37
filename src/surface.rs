//! The surface of a mesh of tetrahedra (feature `alloc`): where pressure and wind act, and what others touch.
//!
//! A mesh for firmware gets its triangles on the host, as it gets its order.

use alloc::vec::Vec;

/// The four faces of a positively oriented tetrahedron, each counter-clockwise as seen from outside.
const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// The faces that only one tetrahedron has: three nodes each, counter-clockwise as seen from outside, so that
/// (x₁ − x₀) × (x₂ − x₀) points outward. In the order of their tetrahedra. Those of a mesh are a closed
/// surface; a cavity inside is part of it.
///
/// Time and memory are in proportion to the number of tetrahedra, sorting aside.
#[must_use]
pub fn boundary_triangles(tets: &[[u32; 4]]) -> Vec<[u32; 3]> {
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
    outer.into_iter().map(|(_, face)| face).collect()
}
