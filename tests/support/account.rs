//! What one step does to the energy, by the f64 oracle, with the rotations that the crate holds at its begin.

use femto::body::StateRef;
use femto::owned::OwnedBody;
use femto::settings::Settings;
use femto::step::Scene;
use nalgebra::{DVector, Matrix3, Quaternion, UnitQuaternion};

use super::reference::{Reference, stack};
use super::scenes::Setup;

const EPS: f64 = f32::EPSILON as f64;

/// The rotations that a state holds, as matrices in f64, tetrahedron by tetrahedron.
pub fn frozen_rotations(state: &StateRef<'_>, tets: usize) -> Vec<Matrix3<f64>> {
    let lanes = state
        .rotations
        .iter()
        .flat_map(|block| (0..8).map(move |l| block.0.map(|c| f64::from(c[l]))));
    lanes
        .take(tets)
        .map(|[w, x, y, z]| {
            *UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
                .to_rotation_matrix()
                .matrix()
        })
        .collect()
}

/// Kinetic, frozen elastic and potential energy, and the potential of the constant forces.
fn energy(oracle: &Reference, x: &DVector<f64>, v: &DVector<f64>, q: &[Matrix3<f64>]) -> f64 {
    let kinetic = 0.5 * v.component_mul(&oracle.mass()).dot(v);
    kinetic + oracle.elastic_energy_frozen(x, q) - oracle.external_forces().dot(x)
}

/// What one step did to the energy.
pub struct Account {
    /// E⁺ − E
    pub rise: f64,
    /// What the theorem says must go: ½‖v⁺ − v‖²_M + ½h²‖v⁺‖²_K + h‖v⁺‖²_D
    pub loss: f64,
    /// What rounding can do to either.
    pub rounding: f64,
    /// Kinetic and elastic energy before.
    pub energy: f64,
}

/// Takes a step and draws up its account. The oracle's x and v are overwritten.
pub fn account(
    setup: &Setup,
    body: &mut OwnedBody,
    scene: &Scene<'_>,
    settings: &Settings,
) -> Account {
    let mut oracle = setup.reference();
    let h = oracle.h;
    let q = frozen_rotations(&body.state().view(), setup.mesh.tets.len());
    let (x, v) = (stack(body.positions()), stack(body.velocities()));
    let before = energy(&oracle, &x, &v, &q);
    let net = oracle.elastic_forces(&x, &q) + oracle.external_forces();
    let edge = longest_edge(setup, body.positions());
    let report = body.step(scene, settings);
    assert!(report.advanced(), "{report:?}");
    let (v_old, x_old) = (v, x);
    let (x, v) = (stack(body.positions()), stack(body.velocities()));

    let (k, mass) = (oracle.stiffness(&q), oracle.mass());
    // What moved it: v⁺, but where a surface is in the way.
    let u = (&x - &x_old) / h;
    let (change, kv, mv) = (&v - &v_old, &k * &v, v.component_mul(&mass));
    let damped = oracle.alpha * mv.dot(&v) + oracle.beta * kv.dot(&v);
    let loss =
        0.5 * change.component_mul(&mass).dot(&change) + 0.5 * h * h * kv.dot(&v) + h * damped;

    // Rounding: a relative ε in every term of v⁺ᵀ(Av⁺ − b), where the errors of a row add up like
    // noise. f_el is a sum of K times edges; x⁺ is rounded where a force acts.
    let rows = |u: &DVector<f64>| {
        DVector::from_fn(k.nrows(), |i, _| {
            k.row(i)
                .iter()
                .zip(u)
                .map(|(k, u)| (k * u).powi(2))
                .sum::<f64>()
                .sqrt()
        })
    };
    let held = rows(&u) * (h * h + h * oracle.beta);
    let fallen = rows(&DVector::repeat(k.nrows(), edge)) * h;
    let inertia =
        (v.map(f64::abs) + v_old.map(f64::abs)).component_mul(&mass) * (1.0 + h * oracle.alpha);
    let pushed = oracle.external_forces() * h;
    let solved = [held, fallen, inertia, pushed]
        .iter()
        .map(|noise| noise.component_mul(&u).norm())
        .sum::<f64>();
    let moved = net.component_mul(&x).norm() + EPS * rows(&x).component_mul(&x).norm();
    oracle.x = x_old;
    Account {
        rise: energy(&oracle, &x, &v, &q) - before,
        loss,
        rounding: EPS * (solved + moved),
        energy: 0.5 * v_old.component_mul(&mass).dot(&v_old)
            + oracle.elastic_energy_frozen(&oracle.x, &q),
    }
}

fn longest_edge(setup: &Setup, x: &[[f32; 3]]) -> f64 {
    let at = |node: u32| nalgebra::Vector3::from(x[node as usize].map(f64::from));
    let pairs = setup
        .mesh
        .tets
        .iter()
        .flat_map(|t| t.iter().flat_map(move |&a| t.iter().map(move |&b| (a, b))));
    pairs
        .map(|(a, b)| (at(a) - at(b)).norm())
        .fold(0.0, f64::max)
}
