//! Measures of tets and meshes: volume, quality, surface, connected pieces.

use std::collections::HashMap;

use glam::DVec3;

/// The four faces of a tet of positive volume, each counter-clockwise seen from outside.
const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Signed: positive where (b−a, c−a, d−a) is right-handed.
pub fn volume([a, b, c, d]: [DVec3; 4]) -> f64 {
    (b - a).cross(c - a).dot(d - a) / 6.0
}

/// 12 (3V)^⅔ / Σ l²: 1 for a regular tet, 0 for a flat one, negative for one inside out.
pub fn mean_ratio(corners: [DVec3; 4]) -> f64 {
    let mut squares = 0.0;
    for i in 0..4 {
        for j in 0..i {
            squares += corners[i].distance_squared(corners[j]);
        }
    }
    let v = volume(corners);
    if squares == 0.0 {
        return 0.0;
    }
    12.0 * libm::pow(3.0 * v.abs(), 2.0 / 3.0) / squares * v.signum()
}

pub fn triangle_area([a, b, c]: [DVec3; 3]) -> f64 {
    (b - a).cross(c - a).length() / 2.0
}

/// How many tets each face has, by its sorted nodes, and the face as its first tet sees it.
fn faces(tets: &[[u32; 4]]) -> HashMap<[u32; 3], (u32, usize, [u32; 3])> {
    let mut faces = HashMap::with_capacity(tets.len() * 5 / 2);
    for (t, tet) in tets.iter().enumerate() {
        for (f, corners) in FACES.iter().enumerate() {
            let face = corners.map(|c| tet[c]);
            let mut key = face;
            key.sort_unstable();
            faces.entry(key).or_insert((0, 4 * t + f, face)).0 += 1;
        }
    }
    faces
}

/// The triangles that belong to one tet only, outward, in the order of the tets.
pub fn surface(tets: &[[u32; 4]]) -> Vec<[u32; 3]> {
    let mut outer: Vec<_> = faces(tets)
        .into_values()
        .filter(|&(uses, ..)| uses == 1)
        .map(|(_, order, face)| (order, face))
        .collect();
    outer.sort_unstable();
    outer.into_iter().map(|(_, face)| face).collect()
}

/// Faces that more than two tets share: a mesh that overlaps itself.
pub fn crowded_faces(tets: &[[u32; 4]]) -> usize {
    faces(tets).values().filter(|&&(uses, ..)| uses > 2).count()
}

/// In how many pieces the nodes hang together by tets; nodes without a tet do not count.
pub fn pieces(nodes: usize, tets: &[[u32; 4]]) -> usize {
    let mut parent: Vec<u32> = (0..nodes as u32).collect();
    fn root(parent: &mut [u32], mut node: u32) -> u32 {
        while parent[node as usize] != node {
            parent[node as usize] = parent[parent[node as usize] as usize];
            node = parent[node as usize];
        }
        node
    }
    let mut used = vec![false; nodes];
    for tet in tets {
        for &node in tet {
            used[node as usize] = true;
            let (a, b) = (root(&mut parent, tet[0]), root(&mut parent, node));
            parent[a.max(b) as usize] = a.min(b);
        }
    }
    (0..nodes as u32)
        .filter(|&n| used[n as usize] && parent[n as usize] == n)
        .count()
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: [DVec3; 4] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];

    #[test]
    fn volume_has_a_sign() {
        assert_eq!(volume(UNIT), 1.0 / 6.0);
        assert_eq!(volume([UNIT[1], UNIT[0], UNIT[2], UNIT[3]]), -1.0 / 6.0);
    }

    #[test]
    fn regular_tet_has_mean_ratio_one() {
        let regular = [
            DVec3::new(1.0, 1.0, 1.0),
            DVec3::new(-1.0, 1.0, -1.0),
            DVec3::new(1.0, -1.0, -1.0),
            DVec3::new(-1.0, -1.0, 1.0),
        ];
        assert!((mean_ratio(regular) - 1.0).abs() < 1e-15);
        assert_eq!(mean_ratio([DVec3::ZERO; 4]), 0.0);
    }

    #[test]
    fn surface_points_outward() {
        let out: f64 = surface(&[[0, 1, 2, 3]])
            .iter()
            .map(|f| f.map(|n| UNIT[n as usize]))
            .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
            .sum();
        assert!((out - 1.0 / 6.0).abs() < 1e-15); // the divergence theorem gives the volume
    }

    #[test]
    fn shared_faces_are_inside_and_pieces_are_counted() {
        let tets = [[0, 1, 2, 3], [1, 2, 3, 4], [5, 6, 7, 8]];
        assert_eq!(surface(&tets).len(), 3 + 3 + 4);
        assert_eq!(pieces(10, &tets), 2); // node 9 is in no tet
        assert_eq!(
            crowded_faces(&[[0, 1, 2, 3], [0, 1, 2, 4], [0, 1, 2, 5]]),
            1
        );
    }
}
