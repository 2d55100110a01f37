//! The body's place, its orientation, and the order of its nodes and tetrahedra are of no account.

use femto::element::{Dense, Factored, Layout};
use femto::lane::BLOCK;
use femto::operator::RotationBlock;
use nalgebra::{DVector, Matrix3, Rotation3};
use proptest::prelude::*;

use super::support::meshes::Lcg;
use super::support::reference::node;
use super::support::scenes::Setup;
use super::{Body, ELEMENT, EPS, any_setup, any_turn, any_vector, assert_within, fitted, matrix};
use super::{force_rounding, product_rounding, rounding, turned, turned_rotations};

/// |ω| gap/‖F‖ of a converged Q, as in the stiffness tests.
const TURN: f64 = 3.0 * 4.25 * 0.5 * EPS;

fn turned_wide(r: &Matrix3<f64>, u: &DVector<f64>) -> DVector<f64> {
    DVector::from_iterator(
        u.len(),
        (0..u.len() / 3).flat_map(|i| <[f64; 3]>::from(r * node(u, i))),
    )
}

/// f(Rx, RQ) = R f(x, Q) and K(RQ) R u = R K(Q) u; and R Q is what a fit to Rx gives.
fn is_equivariant<L: Layout>(setup: &Setup, r: &Matrix3<f64>, u: &[[f32; 3]]) {
    let (oracle, q) = (setup.reference(), fitted(setup, &setup.x));
    let (x, rotation) = (turned(r, &setup.x), Rotation3::from_matrix_unchecked(*r));
    let turned_q = turned_rotations(&q, &rotation);
    let (body, moved) = (
        Body::<L>::new(setup, &setup.x, &q),
        Body::<L>::new(setup, &x, &turned_q),
    );
    // R mixes three axes; and R x and R u are rounded to ½ ε, where the turn is no permutation.
    let over = |tet: &[usize; 4]| {
        tet.iter().map(|&i| node(&oracle.x, i).norm()).sum::<f64>() * EPS / ELEMENT
    };
    let bound = force_rounding(&oracle, &setup.x) * 3.0 + rounding(&oracle, over);
    assert_within(&moved.f, &turned_wide(r, &body.f), &bound);
    let bound = product_rounding(&oracle, &body, u) * 3.0;
    assert_within(
        &moved.product(&turned(r, u)),
        &turned_wide(r, &body.product(u)),
        &bound,
    );
    let refitted = fitted(setup, &x);
    for e in 0..oracle.tets.len() {
        let f = oracle.deformation(&oracle.x, e);
        let mut s: [f64; 3] = f.singular_values().into();
        s.sort_by(|a, b| b.total_cmp(a));
        let gap = s[1] + s[2].copysign(f.determinant());
        let places = oracle.tets[e].iter().zip(&oracle.gradients[e]);
        let spread: f64 = places
            .map(|(&i, g)| node(&oracle.x, i).norm() * g.norm())
            .sum();
        let bound = 3.0 * TURN * spread / gap;
        // Elsewhere it is a tie.
        if bound < 0.01 {
            let error = (matrix(&refitted, e) - r * matrix(&q, e)).norm();
            assert!(error <= bound, "tet {e}: {error:e}, bound {bound:e}");
        }
    }
}

/// Same body, its nodes numbered backwards, its tetrahedra and their corners in another order.
fn reordered(setup: &Setup, q: &[RotationBlock], seed: u64) -> (Setup, Vec<RotationBlock>) {
    const EVEN: [[usize; 4]; 4] = [[0, 1, 2, 3], [1, 2, 0, 3], [3, 2, 1, 0], [3, 0, 2, 1]];
    let mut random = Lcg(seed);
    let mut below = |n: usize| ((random.signed() * 0.5 + 0.5) * n as f64) as usize % n;
    let (mut setup, mut out) = (setup.clone(), q.to_vec());
    let last = setup.mesh.nodes.len() as u32 - 1;
    setup.mesh.nodes.reverse();
    setup.x.reverse();
    for e in (1..setup.mesh.tets.len()).rev() {
        let other = below(e + 1);
        setup.mesh.tets.swap(e, other);
        for c in 0..4 {
            let moved = out[other / BLOCK].0[c][other % BLOCK];
            out[other / BLOCK].0[c][other % BLOCK] = out[e / BLOCK].0[c][e % BLOCK];
            out[e / BLOCK].0[c][e % BLOCK] = moved;
        }
    }
    for tet in &mut setup.mesh.tets {
        *tet = EVEN[below(4)].map(|corner| last - tet[corner]);
    }
    (setup, out)
}

fn backwards(u: &[[f32; 3]]) -> Vec<[f32; 3]> {
    u.iter().rev().copied().collect()
}

fn is_orderless<L: Layout>(setup: &Setup, u: &[[f32; 3]], seed: u64) {
    let q = fitted(setup, &setup.x);
    let (other, other_q) = reordered(setup, &q, seed);
    let (oracles, u) = (
        [setup.reference(), other.reference()],
        [u.to_vec(), backwards(u)],
    );
    let body = [
        Body::<L>::new(setup, &setup.x, &q),
        Body::<L>::new(&other, &other.x, &other_q),
    ];
    let mirrored = |u: &DVector<f64>| {
        DVector::from_fn(u.len(), |dof, _| u[u.len() - 3 - dof / 3 * 3 + dof % 3])
    };
    let bound =
        force_rounding(&oracles[0], &setup.x) + mirrored(&force_rounding(&oracles[1], &other.x));
    assert_within(&mirrored(&body[1].f), &body[0].f, &bound);
    let bound = product_rounding(&oracles[0], &body[0], &u[0])
        + mirrored(&product_rounding(&oracles[1], &body[1], &u[1]));
    assert_within(
        &mirrored(&body[1].product(&u[1])),
        &body[0].product(&u[0]),
        &bound,
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn everything_turns_with_the_body(setup in any_setup(), r in any_turn(), seed in any::<u64>()) {
        let u = any_vector(&setup, seed);
        is_equivariant::<Factored>(&setup, &r, &u);
        is_equivariant::<Dense>(&setup, &r, &u);
    }

    #[test]
    fn the_order_of_nodes_and_tets_is_only_rounding(setup in any_setup(), seed in any::<u64>()) {
        let u = any_vector(&setup, seed);
        is_orderless::<Factored>(&setup, &u, seed);
        is_orderless::<Dense>(&setup, &u, seed);
    }

    /// Coordinates on a grid that the shifted body still resolves: not a bit changes.
    #[test]
    fn place_does_not_matter(mut setup in any_setup(), shift in prop::array::uniform3((-1..2_i8, 0..7_i32))) {
        const GRID: f32 = 1.0 / 16384.0;
        let shift = shift.map(|(sign, power)| f32::from(sign) * 2_f32.powi(power));
        setup.x.as_flattened_mut().iter_mut().for_each(|c| *c = (*c / GRID).round() * GRID);
        let moved: Vec<_> = setup.x.iter().map(|x| core::array::from_fn(|a| x[a] + shift[a])).collect();
        let q = fitted(&setup, &setup.x);
        prop_assert_eq!(&q, &fitted(&setup, &moved));
        let [a, b] = [&setup.x, &moved].map(|x| Body::<Factored>::new(&setup, x, &q).f);
        prop_assert_eq!(a, b);
        let [a, b] = [&setup.x, &moved].map(|x| Body::<Dense>::new(&setup, x, &q).f);
        prop_assert_eq!(a, b);
    }
}
