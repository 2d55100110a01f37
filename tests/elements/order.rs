//! An order of the tetrahedra is a permutation, makes fans where a mesh has them, and changes nothing
//! but rounding.

use crate::support::meshes::{
    Lcg, TetMesh, box_mesh, chain, jitter, noise, single_tet, two_pieces,
};
use crate::support::scenes::Setup;
use femto::element::{Factored, Layout};
use femto::lane::{BLOCK, Native};
use femto::mesh::Mesh;
use femto::operator::{Fit, Operator, RotationBlock, fit_rotations, rotate};
use femto::order::fans;
use femto::owned::OwnedRest;
use proptest::prelude::*;

/// Node vectors that are read for a mesh: four a tetrahedron, or one where all eight lanes go on.
fn gathers(tets: &[[u32; 4]]) -> usize {
    let goes_on = |(a, b): (&[u32; 4], &[u32; 4])| a[0] == b[0] && a[1] == b[1] && a[3] == b[2];
    let blocks: Vec<&[[u32; 4]]> = tets.chunks(BLOCK).collect();
    let shared = blocks
        .windows(2)
        .filter(|pair| pair[1].len() == BLOCK && pair[0].iter().zip(pair[1]).all(goes_on))
        .count();
    4 * tets.len() - 3 * BLOCK * shared
}

fn is_even(from: [u32; 4], to: [u32; 4]) -> bool {
    let Some(places) = to
        .iter()
        .map(|n| from.iter().position(|m| m == n))
        .collect::<Option<Vec<_>>>()
    else {
        return false;
    };
    let inversions = (0..4)
        .flat_map(|i| (0..i).map(move |j| (j, i)))
        .filter(|&(j, i)| places[j] > places[i]);
    inversions.count() % 2 == 0
}

/// The same tetrahedra, listed at random.
fn shuffled(mut mesh: TetMesh, seed: u64) -> TetMesh {
    let mut random = Lcg(seed);
    for last in (1..mesh.tets.len()).rev() {
        let other = ((random.signed() * 0.5 + 0.5) * (last + 1) as f64) as usize;
        mesh.tets.swap(last, other.min(last));
    }
    mesh
}

/// Elastic forces and K u.
fn forces(setup: &Setup, u: &[[f32; 3]]) -> [Vec<[f32; 3]>; 2] {
    let mesh = Mesh::new(&setup.mesh.nodes, &setup.mesh.tets).unwrap();
    let rest = OwnedRest::<Factored>::new(&mesh, &setup.material()).unwrap();
    let rest = rest.view();
    let mut q = vec![RotationBlock::ZERO; rest.blocks.len()];
    fit_rotations::<Native, Factored>(&rest, &setup.x, Fit::Cold, &mut q);
    let mut rotated = vec![Factored::ZERO_ROTATED; q.len()];
    let (mut f, mut product) = (vec![[0.0; 3]; u.len()], vec![[0.0; 3]; u.len()]);
    rotate::<Native, Factored>(&rest, &setup.x, &q, 1.0, &mut rotated, &mut f);
    let operator = Operator {
        rest,
        rotated: &rotated,
        inertia: rest.masses,
        stiffness: 1.0,
    };
    operator.add_stiffness::<Native>(u, &mut product);
    [f, product]
}

#[test]
fn a_box_is_all_fans() {
    let mesh = box_mesh([1.0, 1.0, 1.0], [4, 4, 4]);
    assert_eq!(gathers(&mesh.tets), 4 * 384);
    // Rings of six around the diagonals of the cells: nine nodes.
    assert_eq!(gathers(&fans(&mesh.tets).tets), 9 * 64);
    // However it was listed, it is not far from that.
    for seed in 0..8 {
        let mesh = shuffled(mesh.clone(), seed);
        let ordered = fans(&mesh.tets);
        assert!(
            gathers(&ordered.tets) <= 2 * 384,
            "{}",
            gathers(&ordered.tets)
        );
    }
}

#[test]
fn no_mesh_and_no_sense() {
    assert!(fans(&[]).tets.is_empty());
    let odd = [[0, 0, 0, 0], [7, 7, 1, 2], [u32::MAX, 0, 1, 2]];
    assert_eq!(fans(&odd).original.len(), 3);
}

proptest! {
    #[test]
    fn an_order_is_a_permutation_and_changes_rounding_only(
        mesh in prop_oneof![
            Just(single_tet()),
            Just(two_pieces()),
            (1..30_usize, 1..4_usize).prop_map(|(n, shared)| chain(n, shared)),
            prop::array::uniform3(1..5_usize).prop_map(|cells| box_mesh([1.0, 0.7, 0.5], cells)),
        ],
        seed in any::<u64>(),
    ) {
        let mesh = jitter(&shuffled(mesh, seed), 0.02, seed);
        let ordered = fans(&mesh.tets);
        let mut seen = ordered.original.clone();
        seen.sort_unstable();
        prop_assert!(seen.into_iter().eq(0..mesh.tets.len()));
        for (&tet, &original) in ordered.tets.iter().zip(&ordered.original) {
            prop_assert!(is_even(mesh.tets[original], tet));
        }
        prop_assert!(gathers(&ordered.tets) <= 4 * mesh.tets.len());

        let mut setup = Setup::new("order", mesh);
        for (x, noise) in setup.x.iter_mut().zip(noise(setup.mesh.nodes.len(), 0.01, seed)) {
            (0..3).for_each(|axis| x[axis] += noise[axis]);
        }
        let u = noise(setup.x.len(), 1.0, seed.rotate_left(17));
        let before = forces(&setup, &u);
        setup.mesh.tets = ordered.tets;
        for (before, after) in before.iter().zip(forces(&setup, &u)) {
            let most = before.as_flattened().iter().fold(0.0_f32, |m, c| m.max(c.abs()));
            for (a, b) in before.as_flattened().iter().zip(after.as_flattened()) {
                // Some 24 tetrahedra meet in a node, each of some 70 roundings.
                prop_assert!((a - b).abs() <= 24.0 * 70.0 * f32::EPSILON * most, "{} {} {}", a, b, most);
            }
        }
    }
}
