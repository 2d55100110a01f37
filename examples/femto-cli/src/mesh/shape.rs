//! Measures of tets and meshes: volume, quality, crowded faces, connected pieces.

use std::collections::HashMap;

use glam::DVec3;

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

/// Faces that more than two tets share: a mesh that overlaps itself.
pub fn crowded_faces(tets: &[[u32; 4]]) -> usize {
    let mut uses = HashMap::<[u32; 3], u32>::with_capacity(tets.len() * 5 / 2);
    for tet in tets {
        for left_out in 0..4 {
            let mut face = [1, 2, 3].map(|k| tet[(left_out + k) % 4]);
            face.sort_unstable();
            *uses.entry(face).or_default() += 1;
        }
    }
    uses.values().filter(|&&uses| uses > 2).count()
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
    fn pieces_and_crowded_faces_are_counted() {
        let tets = [[0, 1, 2, 3], [1, 2, 3, 4], [5, 6, 7, 8]];
        assert_eq!(pieces(10, &tets), 2); // node 9 is in no tet
        assert_eq!(
            crowded_faces(&[[0, 1, 2, 3], [0, 1, 2, 4], [0, 1, 2, 5]]),
            1
        );
    }
}
