//! The surface of a mesh: closed, outward, around the whole volume and around nothing else.

use crate::support::meshes::{TetMesh, box_mesh, chain, jitter, single_tet, two_pieces};
use femto::surface::boundary_triangles;
use std::collections::HashMap;

use proptest::prelude::*;

/// Checks what holds of every mesh whose tetrahedra do not overlap.
fn check(mesh: &TetMesh) {
    let triangles = boundary_triangles(&mesh.tets);
    // Closed: every directed edge is run through as often as its opposite.
    let mut edges = HashMap::<(u32, u32), i32>::new();
    for &[a, b, c] in &triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *edges.entry((from.min(to), from.max(to))).or_default() +=
                if from < to { 1 } else { -1 };
        }
    }
    assert!(edges.values().all(|&sum| sum == 0));
    // Outward: the divergence theorem gives the sum of the volumes, with its sign.
    let at = |node: u32| mesh.nodes[node as usize].map(f64::from);
    let enclosed: f64 = triangles
        .iter()
        .map(|&[a, b, c]| {
            let ([a, b, c], [d, e, f], [g, h, i]) = (at(a), at(b), at(c));
            (a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)) / 6.0
        })
        .sum();
    let volume: f64 = mesh.tets.iter().map(|&tet| mesh.volume(tet)).sum();
    assert!(
        (enclosed - volume).abs() < 1e-12 * volume,
        "{enclosed} of {volume}"
    );
}

#[test]
fn surfaces_of_known_meshes() {
    for (mesh, triangles) in [
        (single_tet(), 4),
        (box_mesh([1.0, 2.0, 3.0], [2, 3, 4]), 2 * 2 * (6 + 12 + 8)),
        // Three shared nodes: one face of each goes.
        (chain(5, 3), 5 * 4 - 2 * 4),
    ] {
        assert_eq!(boundary_triangles(&mesh.tets).len(), triangles);
        check(&mesh);
    }
    check(&two_pieces());
    assert!(boundary_triangles(&[]).is_empty());
}

/// A box without its middle: the walls of the cavity look into it.
#[test]
fn a_cavity_belongs_to_the_surface() {
    let mut mesh = box_mesh([3.0; 3], [3; 3]);
    let whole = boundary_triangles(&mesh.tets).len();
    let middle = |tet: &[u32; 4]| {
        let sum = |axis: usize| -> f32 {
            tet.iter()
                .map(|&n| mesh.nodes[n as usize][axis])
                .sum::<f32>()
                / 4.0
        };
        (0..3).all(|axis| sum(axis) > 1.0 && sum(axis) < 2.0)
    };
    mesh.tets = mesh
        .tets
        .iter()
        .copied()
        .filter(|tet| !middle(tet))
        .collect();
    assert_eq!(mesh.tets.len(), 6 * 26);
    assert_eq!(boundary_triangles(&mesh.tets).len(), whole + 12);
    check(&mesh);
}

/// A face of three tetrahedra is nobody's outside.
#[test]
fn a_face_of_many_is_inside() {
    let triangles = boundary_triangles(&[[0, 1, 2, 3], [0, 1, 2, 4], [0, 1, 2, 5]]);
    assert_eq!(triangles.len(), 9);
}

proptest! {
    /// Whatever the order of tetrahedra and corners: the same triangles, turned at most.
    #[test]
    fn orders_do_not_matter(cells in [1_usize..4, 1..4, 1..4], seed in any::<u64>(), by in 0_usize..500) {
        let mesh = jitter(&box_mesh([1.0, 0.5, 0.7], cells), 0.02, seed);
        check(&mesh);
        let mut other = mesh.ordered().tets;
        let places = other.len();
        other.rotate_left(by % places);
        let canonical = |tets: &[[u32; 4]]| {
            let mut all: Vec<_> = boundary_triangles(tets)
                .into_iter()
                .map(|mut triangle| {
                    let first = (0..3).min_by_key(|&k| triangle[k]).unwrap();
                    triangle.rotate_left(first);
                    triangle
                })
                .collect();
            all.sort_unstable();
            all
        };
        let again = box_mesh([1.0, 0.5, 0.7], cells);
        prop_assert_eq!(canonical(&other), canonical(&again.tets));
    }
}
