//! Materials that only the dense layout holds, against the strain–displacement matrix of textbooks.

use femto::body::StateRef;
use femto::element::{Dense, Elasticity};
use femto::energy::{self, Rotations};
use femto::glam::Vec3;
use femto::lane::BLOCK;
use femto::mesh::Mesh;
use femto::operator::RotationBlock;
use femto::owned::OwnedRest;
use nalgebra::{DMatrix, DVector, Rotation3, SMatrix};
use proptest::prelude::*;

use super::support::reference::{Reference, stack};
use super::{Body, any_setup, any_turn, any_vector, assert_definite, assert_within, fitted};
use super::{force_rounding, matrix, product_rounding, turned, turned_rotations};

/// λ and μ as σ = C ε.
fn isotropic(lambda: f64, mu: f64) -> Elasticity {
    core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            let normal = if i < 3 && j < 3 { lambda } else { 0.0 };
            let diagonal = if i < 3 { 2.0 * mu } else { mu };
            if i == j { normal + diagonal } else { normal }
        })
    })
}

/// Positive definite, with three planes of symmetry; stiffnesses from 1e3 to 1e7.
fn any_orthotropic() -> impl Strategy<Value = Elasticity> {
    let stiffness = || (3.0..7.0_f64).prop_map(|e| 10_f64.powf(e));
    (
        prop::array::uniform6(stiffness()),
        prop::array::uniform3(-0.45..0.45_f64),
    )
        .prop_map(|(k, coupling)| {
            let mut c = [[0.0; 6]; 6];
            (0..6).for_each(|i| c[i][i] = k[i]);
            for (part, (i, j)) in coupling.into_iter().zip([(0, 1), (0, 2), (1, 2)]) {
                // Below ½ of the geometric mean, so that the three of them cannot outweigh the diagonal.
                c[i][j] = part * (k[i] * k[j]).sqrt();
                c[j][i] = c[i][j];
            }
            c
        })
}

/// K = Σ V B̂ᵀ C B̂ with the strain–displacement matrix B of textbooks, B̂ = B Qᵀ.
fn textbook(
    oracle: &Reference,
    q: &[RotationBlock],
    of: impl Fn(usize) -> Elasticity,
) -> DMatrix<f64> {
    let mut k = DMatrix::zeros(oracle.rest.len(), oracle.rest.len());
    for (e, tet) in oracle.tets.iter().enumerate() {
        let c = SMatrix::<f64, 6, 6>::from_fn(|i, j| of(e)[i][j]);
        let turned = oracle.gradients[e].map(|g| {
            let (x, y, z) = (g.x, g.y, g.z);
            let rows = [
                [x, 0.0, 0.0],
                [0.0, y, 0.0],
                [0.0, 0.0, z],
                [0.0, z, y],
                [z, 0.0, x],
                [y, x, 0.0],
            ];
            SMatrix::<f64, 6, 3>::from_fn(|i, j| rows[i][j]) * matrix(q, e).transpose()
        });
        for (&i, b_i) in tet.iter().zip(&turned) {
            for (&j, b_j) in tet.iter().zip(&turned) {
                let mut block = k.fixed_view_mut::<3, 3>(3 * i, 3 * j);
                block += b_i.transpose() * c * b_j * oracle.volumes[e];
            }
        }
    }
    k
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn isotropy_is_a_case_of_anisotropy(setup in any_setup(), seed in any::<u64>()) {
        let (oracle, q, u) = (setup.reference(), fitted(&setup, &setup.x), any_vector(&setup, seed));
        let mesh = Mesh::new(&setup.mesh.nodes, &setup.mesh.tets).unwrap();
        let c = isotropic(oracle.lambda, oracle.mu);
        let rest = OwnedRest::anisotropic(&mesh, &setup.material(), |_| c).unwrap();
        let (body, expected) = (Body::of(rest, &setup, &setup.x, &q), Body::<Dense>::new(&setup, &setup.x, &q));
        assert_within(&body.f, &expected.f, &(force_rounding(&oracle, &setup.x) * 2.0));
        assert_within(&body.product(&u), &expected.product(&u), &(product_rounding(&oracle, &body, &u) * 2.0));
    }

    #[test]
    fn anisotropic_materials_have_energy_forces_and_stiffness(
        mut setup in any_setup(),
        c in any_orthotropic(),
        other in any_orthotropic(),
        r in any_turn(),
        seed in any::<u64>(),
    ) {
        const STEP: f32 = 1.0 / 4096.0;
        setup.x.as_flattened_mut().iter_mut().for_each(|c| *c = (*c / STEP).round() * STEP);
        let mesh = Mesh::new(&setup.mesh.nodes, &setup.mesh.tets).unwrap();
        // Two materials in one body; the oracle is given what bounds them both.
        let of = |tet: usize| if tet.is_multiple_of(2) { c } else { other };
        let rest = OwnedRest::anisotropic(&mesh, &setup.material(), of).unwrap();
        let mut oracle = setup.reference();
        let norm = |c: &Elasticity| c.as_flattened().iter().map(|c| c * c).sum::<f64>().sqrt();
        (oracle.lambda, oracle.mu) = (0.0, norm(&c).max(norm(&other)) / 2.0);
        let q = fitted(&setup, &setup.x);
        let body = Body::of(rest, &setup, &setup.x, &q);

        let (u, v) = (any_vector(&setup, seed), any_vector(&setup, !seed));
        assert_definite(&oracle, &body, &u, &v);
        let expected = textbook(&oracle, &q, of) * stack(&u) * f64::from(body.stiffness);
        assert_within(&body.product(&u), &expected, &product_rounding(&oracle, &body, &u));

        // The state's energy is quadratic, and a central difference exact.
        let energy = |dof: usize, step: f32| {
            let mut x = setup.x.clone();
            x.as_flattened_mut()[dof] += step;
            let state = StateRef::new(&x, &[], &[], &q);
            energy::elastic(&body.rest.view(), &state, Rotations::Stored)
        };
        let slope = |dof, _| (energy(dof, STEP) - energy(dof, -STEP)) / (2.0 * f64::from(STEP));
        let slope = DVector::from_fn(body.f.len(), slope);
        assert_within(&body.f, &-slope, &force_rounding(&oracle, &setup.x));

        // Turned as a whole: no force, and none against turning on.
        let still = turned(&r, &setup.mesh.nodes);
        let none = DVector::zeros(3 * still.len());
        let identity = vec![RotationBlock([[1.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]]); q.len()];
        let turned_q = turned_rotations(&identity, &Rotation3::from_matrix_unchecked(r));
        let body = Body::of(body.rest, &setup, &still, &turned_q);
        assert_within(&body.f, &none, &force_rounding(&oracle, &still));
        let spin = |x: &[f32; 3]| Vec3::new(1.0, -2.0, 0.5).cross(Vec3::from_array(*x)).to_array();
        let spin: Vec<_> = still.iter().map(spin).collect();
        assert_within(&body.product(&spin), &none, &product_rounding(&oracle, &body, &spin));
    }
}
