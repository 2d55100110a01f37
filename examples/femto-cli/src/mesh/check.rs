//! Everything that makes a mesh unusable, each offender named.

use std::fmt;

use femto::mesh::MeshError;

use super::{Mesh, shape};

/// One thing wrong. Nodes and tets are named by the numbers that the file uses.
#[derive(Clone, Debug, PartialEq)]
pub enum Problem {
    NoNodes,
    NoTets,
    NotFinite {
        node: u64,
        at: [f64; 3],
    },
    NoSuchNode {
        tet: u64,
        node: i128,
        known: String,
    },
    RepeatedNode {
        tet: u64,
        node: u64,
    },
    Inverted {
        tet: u64,
        volume: f64,
    },
    Flat {
        tet: u64,
        volume: f64,
    },
    Unused {
        node: u64,
    },
    /// With the nodes of another, in any order.
    TetTwice {
        tet: u64,
        other: u64,
    },
    /// A number given twice by the file.
    NodeTwice {
        node: u64,
    },
    /// In the library's words.
    Other(String),
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Problem::NoNodes => write!(f, "the mesh has no nodes"),
            Problem::NoTets => write!(f, "the mesh has no 4-node tets"),
            Problem::NotFinite { node, at } => {
                write!(f, "node {node}: its position {at:?} is not finite in f32")
            }
            Problem::NoSuchNode { tet, node, known } => {
                write!(f, "tet {tet}: node {node} is out of range ({known})")
            }
            Problem::RepeatedNode { tet, node } => {
                write!(f, "tet {tet}: node {node} is repeated")
            }
            Problem::Inverted { tet, volume } => {
                write!(
                    f,
                    "tet {tet}: its volume is negative ({volume:e}): inside out"
                )
            }
            Problem::Flat { tet, volume } => {
                write!(
                    f,
                    "tet {tet}: its volume is zero or too small ({volume:e}): flat"
                )
            }
            Problem::Unused { node } => write!(f, "node {node}: belongs to no tet"),
            Problem::TetTwice { tet, other } => {
                write!(f, "tet {tet}: has the nodes of tet {other}")
            }
            Problem::NodeTwice { node } => write!(f, "node {node}: is given twice"),
            Problem::Other(what) => f.write_str(what),
        }
    }
}

/// All problems: those of the reader, then those that the library finds in the mesh as it
/// sees it, rounded to f32, and tets that are there twice: they would have twice the mass.
pub fn problems(mesh: &Mesh) -> Vec<Problem> {
    let mut found = mesh.problems.clone();
    if mesh.nodes.is_empty() {
        found.push(Problem::NoNodes);
    }
    if mesh.tets.is_empty() {
        found.push(Problem::NoTets);
    }
    let rounded: Vec<[f32; 3]> = mesh
        .nodes
        .iter()
        .map(|p| p.to_array().map(|x| x as f32))
        .collect();
    let node = |index: u32| mesh.node_names[index as usize];
    let tet = |index: u32| mesh.tet_names[index as usize];
    femto::mesh::problems(&rounded, &mesh.tets, |problem| {
        found.push(match problem {
            MeshError::NonFiniteNode { node: n } => Problem::NotFinite {
                node: node(n),
                at: mesh.nodes[n as usize].to_array(),
            },
            MeshError::RepeatedNode { tet: t, node: n } => Problem::RepeatedNode {
                tet: tet(t),
                node: node(n),
            },
            MeshError::BadVolume { tet: t } => {
                let corners = mesh.corners(mesh.tets[t as usize]).unwrap_or_default();
                if !corners.iter().all(|c| c.is_finite()) {
                    return; // the node has been reported
                }
                let (tet, volume) = (tet(t), shape::volume(corners));
                match volume < 0.0 {
                    true => Problem::Inverted { tet, volume },
                    false => Problem::Flat { tet, volume },
                }
            }
            MeshError::UnreferencedNode { node: n } => Problem::Unused { node: node(n) },
            // Reported above, and by the readers.
            MeshError::Empty | MeshError::NodeOutOfRange { .. } => return,
            other => Problem::Other(other.to_string()),
        });
    });
    let mut sorted: Vec<([u32; 4], u32)> = mesh.tets.iter().copied().zip(0..).collect();
    for (nodes, _) in &mut sorted {
        nodes.sort_unstable();
    }
    sorted.sort_unstable();
    let pairs = sorted.windows(2).filter(|pair| pair[0].0 == pair[1].0);
    let known = pairs.filter(|pair| mesh.corners(pair[0].0).is_some());
    found.extend(known.map(|pair| Problem::TetTwice {
        tet: tet(pair[1].1),
        other: tet(pair[0].1),
    }));
    found
}

/// The first problem, and how many more there are: what fits an error line.
pub fn first_of(problems: &[Problem]) -> Option<String> {
    match problems {
        [] => None,
        [only] => Some(only.to_string()),
        [first, rest @ ..] => Some(format!("{first}; and {} more", rest.len())),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::mesh::NOWHERE;

    fn mesh(nodes: &[[f64; 3]], tets: &[[u32; 4]]) -> Mesh {
        Mesh {
            nodes: nodes.iter().map(|&p| DVec3::from(p)).collect(),
            tets: tets.to_vec(),
            node_names: (1..=nodes.len() as u64).collect(),
            tet_names: (1..=tets.len() as u64).collect(),
            ..Mesh::default()
        }
    }

    const UNIT: [[f64; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    #[test]
    fn a_good_tet_has_none() {
        assert_eq!(problems(&mesh(&UNIT, &[[0, 1, 2, 3]])), []);
    }

    #[test]
    fn every_offender_is_named() {
        let nodes = [
            UNIT[0],
            UNIT[1],
            UNIT[2],
            UNIT[3],
            [f64::NAN, 0.0, 0.0],
            [1.0, 1.0, 0.0],
        ];
        let tets = [[0, 2, 1, 3], [0, 0, 1, 2], [0, 1, 2, 5], [0, 1, 2, NOWHERE]];
        let lines: Vec<String> = problems(&mesh(&nodes, &tets))
            .iter()
            .map(|p| p.to_string())
            .collect();
        assert_eq!(
            lines,
            [
                "node 5: its position [NaN, 0.0, 0.0] is not finite in f32",
                "tet 1: its volume is negative (-1.6666666666666666e-1): inside out",
                "tet 2: node 1 is repeated",
                "tet 3: its volume is zero or too small (0e0): flat",
                "node 5: belongs to no tet",
            ]
        );
    }

    #[test]
    fn a_tet_that_is_there_twice_is_named() {
        let found = problems(&mesh(&UNIT, &[[0, 1, 2, 3], [1, 2, 0, 3]]));
        assert_eq!(found, [Problem::TetTwice { tet: 2, other: 1 }]);
    }

    #[test]
    fn a_tet_that_f32_flattens_is_flat() {
        let nodes = [
            [1e6, 0.0, 0.0],
            [1e6 + 1e-3, 0.0, 0.0],
            [1e6, 1.0, 0.0],
            [1e6, 0.0, 1.0],
        ];
        let found = problems(&mesh(&nodes, &[[0, 1, 2, 3]]));
        assert!(
            matches!(found[..], [Problem::Flat { tet: 1, .. }]),
            "{found:?}"
        );
    }

    #[test]
    fn an_empty_mesh_is_a_problem() {
        assert_eq!(
            problems(&mesh(&[], &[])),
            [Problem::NoNodes, Problem::NoTets]
        );
    }
}
