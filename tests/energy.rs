//! The energy theorem of the front page: where v⁺ is a Galerkin solution (starts `zero`,
//! `galerkin-m`, `rigid-m`; backward Euler, constant forces, pins that hold, frozen rotations)
//!
//! ```text
//! E(v⁺, x⁺) ≤ E(v, x) − ½‖v⁺ − v‖²_M − ½h²‖v⁺‖²_K − h‖v⁺‖²_D
//! ```
//!
//! at *every* iteration count. Energies are the oracle's, in f64, with the rotations that the crate
//! froze in the step.

mod support;

use femto::body::StateRef;
use femto::owned::OwnedBody;
use femto::settings::{Preconditioner, Settings, Start};
use nalgebra::{DVector, Matrix3, Quaternion, UnitQuaternion};
use proptest::prelude::*;
use support::factors;
use support::meshes::{TetMesh, box_mesh, chain, jitter, noise, single_tet, two_pieces};
use support::reference::{Reference, stack};
use support::scenes::{self, Setup};

const EPS: f64 = f32::EPSILON as f64;

/// The rotations that a state holds, as matrices in f64, tetrahedron by tetrahedron.
fn frozen_rotations(state: &StateRef<'_>, tets: usize) -> Vec<Matrix3<f64>> {
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
struct Account {
    /// E⁺ − E
    rise: f64,
    /// What the theorem says must go: ½‖v⁺ − v‖²_M + ½h²‖v⁺‖²_K + h‖v⁺‖²_D
    loss: f64,
    /// What rounding can do to either.
    rounding: f64,
    /// Kinetic and elastic energy before.
    energy: f64,
}

/// Takes a step and draws up its account. The oracle's x and v are overwritten.
fn account(setup: &Setup, body: &mut OwnedBody, settings: &Settings) -> Account {
    let mut oracle = setup.reference();
    let (h, pins) = (oracle.h, setup.pin_list());
    let q = frozen_rotations(&body.state().view(), setup.mesh.tets.len());
    let (x, v) = (stack(body.positions()), stack(body.velocities()));
    let before = energy(&oracle, &x, &v, &q);
    let net = oracle.elastic_forces(&x, &q) + oracle.external_forces();
    let edge = longest_edge(setup, body.positions());
    let report = body.step(&setup.scene(&pins), settings);
    assert!(report.advanced(), "{report:?}");
    let (v_old, x_old) = (v, x);
    let (x, v) = (stack(body.positions()), stack(body.velocities()));

    let (k, mass) = (oracle.stiffness(&q), oracle.mass());
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
    let held = rows(&v) * (h * h + h * oracle.beta);
    let fallen = rows(&DVector::repeat(k.nrows(), edge)) * h;
    let inertia =
        (v.map(f64::abs) + v_old.map(f64::abs)).component_mul(&mass) * (1.0 + h * oracle.alpha);
    let pushed = oracle.external_forces() * h;
    let solved = [held, fallen, inertia, pushed]
        .iter()
        .map(|noise| noise.component_mul(&v).norm())
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

fn mesh() -> impl Strategy<Value = TetMesh> {
    let kind = prop_oneof![
        Just(single_tet()),
        (1..5_usize, 1..4_usize).prop_map(|(n, shared)| chain(n, shared)),
        Just(two_pieces()),
        (1..4_usize, 1..3_usize).prop_map(|(nx, ny)| box_mesh([1.0, 0.3, 0.2], [nx, ny, 1])),
    ];
    (kind, 0.0..0.1_f64, any::<u64>()).prop_map(|(mesh, amount, seed)| jitter(&mesh, amount, seed))
}

fn start() -> impl Strategy<Value = Start> {
    prop_oneof![
        Just(Start::Zero),
        (0..5_u8).prop_map(Start::Galerkin),
        (0..4_u8).prop_map(Start::Rigid)
    ]
}

fn setup() -> impl Strategy<Value = Setup> {
    let material = (
        3.0..8.0_f64,
        -0.5..0.499_f32,
        prop_oneof![Just(0.0_f32), 0.0..2.0_f32],
        prop_oneof![Just(0.0_f32), 0.0..0.02_f32],
    );
    let state = (
        any::<u64>(),
        0.0..0.5_f64,
        -3.0..2.0_f64,
        1e-3..0.03_f32,
        0..4_usize,
    );
    (mesh(), material, state).prop_map(
        |(mesh, (young, poisson, alpha, beta), (seed, deformation, speed, h, pins))| {
            let nodes = mesh.nodes.len();
            let mut setup = Setup::new("random", mesh);
            (setup.young, setup.poisson, setup.alpha, setup.beta, setup.h) =
                (10_f64.powf(young) as f32, poisson, alpha, beta, h);
            setup.gravity = [1.0, -9.81, 0.5];
            for (x, d) in setup
                .x
                .iter_mut()
                .zip(noise(nodes, 0.1 * deformation, seed))
            {
                *x = std::array::from_fn(|a| x[a] + d[a]);
            }
            setup.v = noise(nodes, 10_f64.powf(speed), seed ^ 1);
            setup.pins = (0..pins.min(nodes))
                .map(|node| (node as u32, [0.0; 3]))
                .collect();
            for &(node, _) in &setup.pins {
                setup.v[node as usize] = [0.0; 3];
            }
            setup
        },
    )
}

/// Multiples of the rounding that one step's sums over some dozen terms can add up to.
const ALLOWED: f64 = 16.0;
/// Up to here the bound itself holds to rounding, from rest at every count (its last line search makes
/// v⁺ ⟂ r). Elsewhere CG in f32 loses conjugacy later where the system is ill-conditioned, v⁺ ⟂ r
/// becomes approximate, and only what follows from it is asked: E never rises.
const CONJUGATE: u32 = 1;

fn check(account: &Account, start: Start, iterations: u32) -> Result<(), String> {
    let Account {
        rise,
        loss,
        rounding,
        ..
    } = *account;
    if rise > ALLOWED * rounding {
        Err(format!(
            "{iterations} iterations: the energy rises by {rise:e}, rounding is {rounding:e}"
        ))
    } else if (start == Start::Zero || iterations <= CONJUGATE) && rise + loss > ALLOWED * rounding
    {
        Err(format!(
            "{iterations} iterations: {rise:e} instead of {:e}, rounding is {rounding:e}",
            -loss
        ))
    } else {
        Ok(())
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    /// Random states; the history may be anything: noise, or parallel to v(t).
    #[test]
    fn energy_never_rises(
        setup in setup(), start in start(), which in 0..factors::COUNT,
        seed in any::<u64>(), parallel in any::<bool>(),
    ) {
        let preconditioner = factors::preconditioner(&setup, which);
        for iterations in [0, 1, 2, 3, 5, 10, 30] {
            let settings = setup.solver(start, preconditioner, iterations);
            let mut body = setup.body(&settings);
            let slots = body.state_mut().view_mut().history.chunks_mut(setup.x.len());
            for (past, i) in slots.zip(0_u64..) {
                past.copy_from_slice(&if parallel { setup.v.clone() } else { noise(past.len(), 1.0, seed ^ i) });
            }
            let account = account(&setup, &mut body, &settings);
            let checked = check(&account, start, iterations);
            prop_assert!(checked.is_ok(), "{}: {}", factors::name(which), checked.unwrap_err());
        }
    }
}

/// The free, spinning bar, at another stiffness.
fn bar(young: f32) -> Setup {
    Setup {
        young,
        ..scenes::free_spin()
    }
}

#[test]
fn energy_never_rises_along_truncated_runs() {
    let setups = [
        bar(1e5),
        bar(1e7),
        bar(1e9),
        scenes::cantilever(),
        scenes::two(),
    ];
    let starts = [
        Start::Zero,
        Start::Galerkin(0),
        Start::Galerkin(1),
        Start::Galerkin(2),
        Start::Galerkin(4),
        Start::Rigid(1),
    ];
    for setup in &setups {
        for start in starts {
            for iterations in [0, 1, 2, 5, 20] {
                let mut body = setup.body(start);
                for step in 0..30 {
                    let account = account(
                        setup,
                        &mut body,
                        &setup.solver(start, Preconditioner::Jacobi, iterations),
                    );
                    if let Err(why) = check(&account, start, iterations) {
                        panic!(
                            "{} (E = {:e}), {start:?}, step {step}: {why}",
                            setup.name, setup.young
                        );
                    }
                }
            }
        }
    }
}

/// The paper's start raises the energy when stopped early. Here within one step of a free
/// bar at E = 1e7, with up to the paper's own 10 iterations.
#[test]
fn the_velocity_start_violates_it() {
    let mut worst: f64 = 0.0;
    for iterations in [1, 2, 5, 10] {
        let setup = bar(1e7);
        let mut body = setup.body(Start::Velocity);
        for _ in 0..100 {
            let settings = setup.solver(Start::Velocity, Preconditioner::Jacobi, iterations);
            let account = account(&setup, &mut body, &settings);
            println!(
                "V {iterations} {} {} {}",
                account.rise / account.energy,
                account.rise / account.rounding,
                account.energy
            );
            worst = worst.max(account.rise / account.energy);
        }
    }
    println!(
        "velocity: the energy rises to {:.2} times itself in a step",
        1.0 + worst
    );
    assert!(worst > 0.1, "the energy rose by {worst} in a step");
}
