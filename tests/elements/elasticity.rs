//! Materials with directions: against compliances inverted elsewhere, closed forms, and in bodies that are pulled.

use crate::support::meshes::{TetMesh, box_mesh};
use crate::support::reference::{Reference, stack};
use femto::elasticity::{Elasticity, ElasticityError, Fibres, Orthotropic};
use femto::element::Dense;
use femto::glam::Vec3;
use femto::owned::OwnedRest;
use femto::{Budget, Material, Mesh, OwnedBody, Pin, Scene, Settings, Start};
use nalgebra::{Matrix3, Rotation3, SMatrix, Vector3};
use proptest::prelude::*;

type Matrix6 = SMatrix<f64, 6, 6>;

fn matrix(c: &Elasticity) -> Matrix6 {
    Matrix6::from_fn(|i, j| c[i][j])
}

/// Strains of stresses, as the engineering constants say.
fn compliance(m: &Orthotropic) -> Matrix6 {
    let [e1, e2, e3] = m.young;
    let [n23, n13, n12] = m.poisson;
    let mut s = Matrix6::zeros();
    s.fixed_view_mut::<3, 3>(0, 0).copy_from(&Matrix3::new(
        1.0 / e1,
        -n12 / e1,
        -n13 / e1,
        -n12 / e1,
        1.0 / e2,
        -n23 / e2,
        -n13 / e1,
        -n23 / e2,
        1.0 / e3,
    ));
    (0..3).for_each(|k| s[(k + 3, k + 3)] = 1.0 / m.shear[k]);
    s
}

fn any_constants() -> impl Strategy<Value = Orthotropic> {
    let modulus = || (3.0..9.0_f64).prop_map(|e| 10_f64.powf(e));
    let three = || prop::array::uniform3(modulus());
    (three(), prop::array::uniform3(-1.2..1.2_f64), three()).prop_map(|(young, poisson, shear)| {
        Orthotropic {
            young,
            poisson,
            shear,
        }
    })
}

const WOOD: Fibres = Fibres {
    along: 1e6,
    across: 1e5,
    poisson_along: 0.35,
    poisson_across: 0.45,
    shear: 4e4,
};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// The elasticity is the inverse of the compliance; what is refused has a compliance that is not definite.
    #[test]
    fn constants_are_inverted_or_refused(m in any_constants()) {
        let s = compliance(&m);
        // Scaled to ones on the diagonal, which keeps signs.
        let d = Matrix6::from_diagonal(&s.diagonal().map(|x| 1.0 / x.sqrt()));
        let least = (d * s * d).symmetric_eigenvalues().min();
        match m.elasticity() {
            Ok(c) => {
                prop_assert!(least > -1e-12);
                let d = Matrix6::from_diagonal(&s.diagonal().map(f64::sqrt));
                let scaled = d * matrix(&c) * d;
                let inverse = d * s.try_inverse().unwrap() * d;
                prop_assert!((scaled - inverse).norm() <= 1e-9 * inverse.norm() / least.max(1e-6));
            }
            Err(e) => {
                prop_assert_eq!(e, ElasticityError::Poisson);
                prop_assert!(least < 1e-12);
            }
        }
    }

    /// Uniaxial stiffness at an angle θ to the fibres: 1/E = c⁴/E₁ + (1/G − 2ν₁₂/E₁) s²c² + s⁴/E₂.
    #[test]
    fn stiffness_at_an_angle(
        fibre in prop::array::uniform3(-1.0..1.0_f64),
        pull in prop::array::uniform3(-1.0..1.0_f64),
        size in -150.0..150.0_f64,
    ) {
        let (fibre, pull) = (Vector3::from(fibre), Vector3::from(pull).normalize());
        prop_assume!(fibre.norm() > 1e-3);
        let c = WOOD.elasticity((fibre * 10_f64.powf(size)).into()).unwrap();
        prop_assert!((matrix(&c) - matrix(&c).transpose()).norm() < 1e-6);
        let s = matrix(&c).try_inverse().unwrap();
        let n = pull;
        let stress = SMatrix::<f64, 6, 1>::from([n.x * n.x, n.y * n.y, n.z * n.z, n.y * n.z, n.x * n.z, n.x * n.y]);
        // Engineering shear strains: the work of σ is σᵀ S σ, and of the stress nnᵀ it is 1/E.
        let found = (stress.transpose() * s * stress)[0];
        let cos2 = fibre.normalize().dot(&n).powi(2);
        let sin2 = 1.0 - cos2;
        let expected = cos2 * cos2 / WOOD.along
            + (1.0 / WOOD.shear - 2.0 * WOOD.poisson_along / WOOD.along) * cos2 * sin2
            + sin2 * sin2 / WOOD.across;
        prop_assert!((found - expected).abs() < 1e-9 * expected, "{found:e} {expected:e}");
    }

    /// Turned axes: rotating a strain into the material, and its stress back.
    #[test]
    fn turned_materials_answer_turned_strains(
        axis in prop::array::uniform3(-1.0..1.0_f64), angle in 0.0..6.3_f64, entries in prop::array::uniform6(-1.0..1.0_f64),
    ) {
        let m = Orthotropic { young: [3e5, 2e6, 7e5], poisson: [0.2, 0.1, 0.05], shear: [1e5, 2e5, 3e5] };
        prop_assume!(Vector3::from(axis).norm() > 1e-3);
        let r = *Rotation3::new(Vector3::from(axis).normalize() * angle).matrix();
        let axes = core::array::from_fn(|a| core::array::from_fn(|i| r[(i, a)]));
        let (own, turned) = (m.elasticity().unwrap(), m.along(&axes).unwrap());
        let [a, b, c, d, e, f] = entries;
        let strain = Matrix3::new(a, b, c, b, d, e, c, e, f);
        let stress = |c: &Elasticity, strain: &Matrix3<f64>| {
            let voigt = SMatrix::<f64, 6, 1>::from([
                strain[(0, 0)], strain[(1, 1)], strain[(2, 2)], 2.0 * strain[(1, 2)], 2.0 * strain[(0, 2)], 2.0 * strain[(0, 1)],
            ]);
            let s = matrix(c) * voigt;
            Matrix3::new(s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2])
        };
        let expected = r * stress(&own, &(r.transpose() * strain * r)) * r.transpose();
        prop_assert!((stress(&turned, &strain) - expected).norm() < 1e-9 * expected.norm());
    }
}

#[test]
fn constants_out_of_range_are_named() {
    let good = Orthotropic {
        young: [1e5; 3],
        poisson: [0.3; 3],
        shear: [4e4; 3],
    };
    assert!(good.elasticity().is_ok());
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for axis in 0..3 {
            let (mut e, mut g) = (good, good);
            (e.young[axis], g.shear[axis]) = (bad, bad);
            let named = |error| match error {
                ElasticityError::Young { axis, value } => ("E", axis, value.to_bits()),
                ElasticityError::Shear { axis, value } => ("G", axis, value.to_bits()),
                _ => ("", 9, 0),
            };
            assert_eq!(
                named(e.elasticity().unwrap_err()),
                ("E", axis, bad.to_bits())
            );
            assert_eq!(
                named(g.elasticity().unwrap_err()),
                ("G", axis, bad.to_bits())
            );
        }
        let p = Orthotropic {
            poisson: [f64::NAN, 0.3, 0.3],
            ..good
        };
        assert_eq!(p.elasticity(), Err(ElasticityError::Poisson));
    }
    // An isotropic material ends at −1 and ½.
    for (poisson, fits) in [(0.4999, true), (0.5, false), (-0.9999, true), (-1.0, false)] {
        assert_eq!(
            Orthotropic {
                poisson: [poisson; 3],
                ..good
            }
            .elasticity()
            .is_ok(),
            fits
        );
    }
    for bad in [[0.0; 3], [f64::NAN, 1.0, 0.0], [f64::INFINITY, 0.0, 0.0]] {
        assert!(matches!(
            WOOD.elasticity(bad),
            Err(ElasticityError::Direction(_))
        ));
    }
    assert_eq!(
        Fibres {
            poisson_across: -1.0,
            ..WOOD
        }
        .elasticity([1.0, 0.0, 0.0]),
        Err(ElasticityError::Poisson)
    );
}

/// Traction in Pa over the ends of a bar along x, as its triangles share it.
fn traction(mesh: &TetMesh, length: f32, pascals: f64) -> Vec<[f32; 3]> {
    let mut forces = vec![[0.0_f32; 3]; mesh.nodes.len()];
    for (end, sign) in [(0.0, -1.0), (length, 1.0)] {
        for tet in &mesh.tets {
            let face: Vec<u32> = tet
                .iter()
                .copied()
                .filter(|&i| mesh.nodes[i as usize][0] == end)
                .collect();
            if let [a, b, c] = face[..] {
                let [a3, b3, c3] =
                    [a, b, c].map(|i| Vector3::from(mesh.nodes[i as usize].map(f64::from)));
                let area = (b3 - a3).cross(&(c3 - a3)).norm() / 2.0;
                [a, b, c]
                    .iter()
                    .for_each(|&i| forces[i as usize][0] += (sign * pascals * area / 3.0) as f32);
            }
        }
    }
    forces
}

/// Pulled on both ends until it is at rest, with the fibres as `direction` says of the middle of each tetrahedron.
fn pulled(
    mesh: &TetMesh,
    pascals: f64,
    pins: &[Pin],
    direction: impl Fn(Vector3<f64>) -> Vector3<f64>,
) -> OwnedBody<Dense> {
    let material = Material::new(1e5, 0.3, 1000.0)
        .unwrap()
        .with_damping(1.0, 0.05)
        .unwrap();
    let checked = Mesh::new(&mesh.nodes, &mesh.tets).unwrap();
    let middle = |tet: usize| {
        mesh.tets[tet]
            .iter()
            .map(|&i| Vector3::from(mesh.nodes[i as usize].map(f64::from)))
            .sum::<Vector3<f64>>()
            / 4.0
    };
    let of = |tet| WOOD.elasticity(direction(middle(tet)).into()).unwrap();
    let rest = OwnedRest::anisotropic(&checked, &material, of).unwrap();
    let mut body = OwnedBody::from_rest(rest, Start::Galerkin(1));
    let budget = Budget {
        iterations: 80,
        polar_sweeps: 3,
    };
    let settings = Settings::new(0.05).unwrap().with_budget(budget);
    let forces = traction(mesh, 1.0, pascals);
    let scene = Scene {
        forces: &forces,
        pins,
        gravity: Vec3::ZERO,
        ..Scene::default()
    };
    for _ in 0..300 {
        assert!(body.step(&scene, &settings).advanced());
    }
    body
}

/// A free bar under an even traction has an even strain, that of the compliance: along, across and slanting.
#[test]
fn bars_stretch_as_their_fibres_say() {
    let mesh = box_mesh([1.0, 0.4, 0.4], [4, 2, 2]);
    let oracle = Reference::new(&mesh.nodes, &mesh.tets, 1.0, 0.0, 1.0);
    let pascals = 500.0;
    for (x, y) in [(1.0, 0.0), (0.0, 1.0), (0.8, 0.6)] {
        let fibre = Vector3::new(x, y, 0.0);
        let body = pulled(&mesh, pascals, &[], |_| fibre);
        let s = matrix(&WOOD.elasticity(fibre.into()).unwrap())
            .try_inverse()
            .unwrap()
            * pascals;
        let expected = Matrix3::new(
            s[(0, 0)],
            s[(5, 0)] / 2.0,
            0.0,
            s[(5, 0)] / 2.0,
            s[(1, 0)],
            0.0,
            0.0,
            0.0,
            s[(2, 0)],
        );
        let positions = stack(body.positions());
        let mut worst = 0.0_f64;
        for e in 0..mesh.tets.len() {
            let f = oracle.deformation(&positions, e);
            let stretch = (f.transpose() * f - Matrix3::identity()) / 2.0;
            worst = worst.max((stretch - expected).norm() / expected.norm());
        }
        println!(
            "fibres along ({x}, {y}): stretch {:.5}, off {worst:.1e}",
            expected[(0, 0)]
        );
        // Half the square of a strain of 5e-3 is left out.
        assert!(worst < 4e-3, "{worst:e}");
    }
}

/// Helical fibres straighten when pulled, and turn the end against their winding.
#[test]
fn a_wound_bar_turns_when_it_is_pulled() {
    let mesh = box_mesh([1.0, 0.3, 0.3], [8, 3, 3]);
    let held: Vec<Pin> = (0_u32..)
        .zip(&mesh.nodes)
        .filter(|(_, x)| x[0] == 0.0)
        .map(|(i, _)| Pin::held(i))
        .collect();
    let turn = |winding: f64| {
        let body = pulled(&mesh, 2e3, &held, |x| {
            let (y, z) = (x.y - 0.15, x.z - 0.15);
            Vector3::new(1.0, -winding * z, winding * y)
        });
        let end = mesh
            .nodes
            .iter()
            .zip(body.positions())
            .filter(|(rest, _)| rest[0] == 1.0);
        let mut sums = (0.0, 0.0);
        for (rest, x) in end {
            let (y, z) = (f64::from(rest[1]) - 0.15, f64::from(rest[2]) - 0.15);
            let (u, v) = (f64::from(x[1]) - 0.15, f64::from(x[2]) - 0.15);
            sums = (sums.0 + (y * v - z * u), sums.1 + y * y + z * z);
        }
        sums.0 / sums.1
    };
    let (right, left, straight) = (turn(5.0), turn(-5.0), turn(0.0));
    println!("right {right:.5}, left {left:.5}, straight {straight:.6} rad");
    assert!(right < -1e-3 && left > 1e-3);
    assert!((right + left).abs() < 0.2 * left && straight.abs() < 0.05 * left);
}
