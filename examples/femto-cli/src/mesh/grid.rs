//! The box mesh of scene files: nx × ny × nz cells of six tets, one corner at the origin.

use glam::DVec3;

use super::{LIMIT, Mesh};

/// The axes in the order in which a tet walks from the low to the high corner of a cell,
/// and whether its last two nodes are swapped to make the volume positive (odd orders).
const WALKS: [([usize; 3], bool); 6] = [
    ([0, 1, 2], false),
    ([0, 2, 1], true),
    ([1, 0, 2], true),
    ([1, 2, 0], false),
    ([2, 0, 1], false),
    ([2, 1, 0], true),
];

/// Node (i, j, k) has index (i·(ny+1) + j)·(nz+1) + k.
pub fn mesh(size: [f64; 3], cells: [u32; 3]) -> Result<Mesh, String> {
    let [nx, ny, nz] = cells.map(|n| n as usize);
    let tets = cells.iter().map(|&n| u128::from(n)).product::<u128>() * 6;
    let nodes = cells.iter().map(|&n| u128::from(n) + 1).product::<u128>();
    if nodes > LIMIT as u128 || tets > LIMIT as u128 {
        return Err(format!(
            "{nodes} nodes and {tets} tets are more than {LIMIT}"
        ));
    }

    let mut mesh = Mesh {
        format: "box".into(),
        ..Mesh::default()
    };
    for i in 0..=nx {
        for j in 0..=ny {
            for k in 0..=nz {
                mesh.nodes.push(DVec3::new(
                    size[0] * i as f64 / nx as f64,
                    size[1] * j as f64 / ny as f64,
                    size[2] * k as f64 / nz as f64,
                ));
            }
        }
    }
    let index = |[i, j, k]: [usize; 3]| ((i * (ny + 1) + j) * (nz + 1) + k) as u32;
    for i in 0..nx {
        for j in 0..ny {
            for k in 0..nz {
                for (axes, swap) in WALKS {
                    let mut at = [i, j, k];
                    let mut tet = [index(at); 4];
                    for (corner, axis) in tet[1..].iter_mut().zip(axes) {
                        at[axis] += 1;
                        *corner = index(at);
                    }
                    if swap {
                        tet.swap(2, 3);
                    }
                    mesh.tets.push(tet);
                }
            }
        }
    }
    mesh.node_names = (0..mesh.nodes.len() as u64).collect();
    mesh.tet_names = (0..mesh.tets.len() as u64).collect();
    Ok(mesh)
}

#[cfg(test)]
mod tests {
    use crate::mesh::{check, shape};

    #[test]
    fn two_cells_by_hand() {
        let mesh = super::mesh([2.0, 1.0, 1.0], [2, 1, 1]).unwrap();
        assert_eq!(mesh.nodes.len(), 12);
        assert_eq!(mesh.tets.len(), 12);
        // Node (1, 0, 1) is (1·2 + 0)·2 + 1 = 5.
        assert_eq!(mesh.nodes[5].to_array(), [1.0, 0.0, 1.0]);
        assert_eq!(mesh.tets[0], [0, 4, 6, 7]); // xyz
        assert_eq!(mesh.tets[1], [0, 4, 7, 5]); // xzy, last two swapped
        assert_eq!(mesh.tets[11], [4, 5, 11, 7]); // zyx of the second cell, swapped
    }

    #[test]
    fn fills_the_box_with_positive_tets() {
        let mesh = super::mesh([1.0, 0.25, 0.5], [3, 2, 4]).unwrap();
        assert!(check::problems(&mesh).is_empty());
        let total: f64 = mesh
            .tets
            .iter()
            .filter_map(|&t| mesh.corners(t))
            .map(shape::volume)
            .sum();
        assert!((total - 0.125).abs() < 1e-15);
        assert_eq!(
            femto::surface::boundary_triangles(&mesh.tets).len(),
            2 * 2 * (6 + 12 + 8)
        );
    }

    #[test]
    fn too_many_cells_is_an_error_not_a_crash() {
        assert!(super::mesh([1.0; 3], [u32::MAX; 3]).is_err());
    }
}
