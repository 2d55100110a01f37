//! Fracture: what fails, when and where, how many at most, and what stays exact while it does.

use std::collections::BTreeSet;

use crate::arrays;
use crate::support::account::frozen_rotations;
use crate::support::factors;
use crate::support::meshes::{TetMesh, box_mesh, chain, jitter, noise, single_tet, two_pieces};
use crate::support::reference::{Reference, stack};
use crate::support::scenes::Setup;
use femto::body::StateRef;
use femto::energy::StateHash;
use femto::fracture::{FractureError, MOST_PER_STEP};
use femto::glam::Vec3;
use femto::owned::OwnedBody;
use femto::report::Refusal;
use femto::{Fracture, Pin, Plasticity, Preconditioner, Scene, Settings, Start};
use nalgebra::{DVector, Matrix3};
use wide::{f32x4, f32x8};

fn body_of(setup: &Setup, settings: &Settings<'_>) -> OwnedBody {
    setup.body(settings)
}

fn broken(state: &StateRef<'_>, tets: usize) -> BTreeSet<usize> {
    (0..tets).filter(|&tet| state.is_broken(tet)).collect()
}

/// The greatest principal stress of every tetrahedron, Pa, by nalgebra's eigenvalues.
fn tensions(oracle: &Reference, body: &OwnedBody) -> Vec<f64> {
    let (x, tets) = (stack(body.positions()), oracle.tets.len());
    let q = frozen_rotations(&body.state().view(), tets);
    let one = |e: usize| {
        let strain =
            (q[e].transpose() * oracle.deformation(&x, e)).symmetric_part() - Matrix3::identity();
        let stress =
            Matrix3::identity() * (oracle.lambda * strain.trace()) + strain * (2.0 * oracle.mu);
        stress.symmetric_eigenvalues().max()
    };
    (0..tets).map(one).collect()
}

/// The oracle without what has failed: M stays.
fn torn(oracle: &Reference, gone: &BTreeSet<usize>) -> Reference {
    let mut left = oracle.clone();
    gone.iter().for_each(|&e| left.volumes[e] = 0.0);
    left
}

/// Both ends pulled apart, each with `speed`; ν = 0.
fn pulled(mesh: TetMesh, speed: f32) -> Setup {
    let ends = |x: [f32; 3]| x[0] < 1e-6 || x[0] > 0.999_99;
    let velocity = |x: [f32; 3]| [if x[0] < 0.5 { -speed } else { speed }, 0.0, 0.0];
    Setup {
        poisson: 0.0,
        beta: 0.01,
        h: 0.01,
        ..Setup::new("pulled", mesh)
    }
    .pinned(ends, velocity)
}

/// Evenly stretched with ν = 0, every tetrahedron has the stress E s along the bar and none across: the bar
/// holds up to strength/E and not beyond, whatever its size.
#[test]
fn an_even_bar_holds_up_to_its_strength() {
    const STRENGTH: f32 = 5e4; // E s at s = 0.05
    for size in [1e-6, 1.0, 1e6] {
        let mut mesh = jitter(&box_mesh([1.0, 0.25, 0.25], [5, 2, 2]), 0.02, 4);
        let numbers = mesh.nodes.as_flattened_mut();
        numbers.iter_mut().for_each(|x| *x *= size);
        let setup = Setup {
            poisson: 0.0,
            ..Setup::new("bar", mesh)
        };
        let law = Fracture::new(STRENGTH, 16, 1000).unwrap();
        let (settings, tets) = (setup.settings().with_fracture(law), setup.mesh.tets.len());
        for (strain, fails) in [(0.0499, false), (0.0501, true), (-0.5, false)] {
            let mut body = body_of(&setup, &settings);
            let move_node = |(node, x): (u32, &[f32; 3])| Pin {
                node,
                velocity: Vec3::new(strain * x[0] / setup.h, 0.0, 0.0),
            };
            let pins: Vec<Pin> = (0_u32..).zip(&setup.mesh.nodes).map(move_node).collect();
            let report = body.step(&setup.scene(&pins), &settings);
            assert!(report.advanced());
            let expected = if fails {
                (16, tets as u32 - 16)
            } else {
                (0, 0)
            };
            let found = (report.fracture.broken, report.fracture.spared);
            assert_eq!(found, expected, "{strain} of {size} m");
            assert_eq!(broken(&body.state().view(), tets).len() as u32, found.0);
            assert_eq!(report.fracture.left, 1000 - found.0);
        }
    }
}

/// A bar with a waist of a quarter of its cross section: it tears there, at the load that the waist bears.
#[test]
fn a_bar_tears_at_its_waist() {
    let mut mesh = box_mesh([1.0, 0.2, 0.2], [12, 4, 4]);
    for node in &mut mesh.nodes {
        // Half the width over two cells in the middle, and a slope of one cell to either side.
        let size = (6.0 * (node[0] - 0.5).abs()).clamp(0.5, 1.0);
        for axis in [1, 2] {
            node[axis] = 0.1 + size * (node[axis] - 0.1);
        }
    }
    let setup = pulled(mesh, 0.002);
    let strength = 2e4;
    let settings = setup
        .solver(Start::Galerkin(1), Preconditioner::Jacobi, 40)
        .with_fracture(Fracture::new(strength, 1, 10_000).unwrap());
    let (oracle, pins, tets) = (setup.reference(), setup.pin_list(), setup.mesh.tets.len());
    let middle = |e: usize| {
        setup.mesh.tets[e]
            .iter()
            .map(|&i| setup.mesh.nodes[i as usize][0])
            .sum::<f32>()
            / 4.0
    };
    let mut body = body_of(&setup, &settings);
    // What the left end has to hold back, from the oracle's forces.
    let load = |body: &OwnedBody| {
        let gone = broken(&body.state().view(), tets);
        let forces = torn(&oracle, &gone).elastic_forces(
            &stack(body.positions()),
            &frozen_rotations(&body.state().view(), tets),
        );
        (0..setup.mesh.nodes.len())
            .filter(|&i| setup.mesh.nodes[i][0] < 1e-6)
            .map(|i| forces[3 * i])
            .sum::<f64>()
    };
    let (mut highest, mut first, mut broke) = (0.0_f64, None, Vec::new());
    let mut before = BTreeSet::new();
    for _ in 0..800 {
        let report = body.step(&setup.scene(&pins), &settings);
        assert!(report.advanced());
        let tension = tensions(&oracle, &body);
        let now = broken(&body.state().view(), tets);
        for &e in now.difference(&before) {
            assert!(
                tension[e] > f64::from(strength) * (1.0 - 1e-4),
                "{e} failed at {:e}",
                tension[e]
            );
            first.get_or_insert((load(&body), tension[e]));
            broke.push(middle(e));
        }
        before = now;
        highest = highest.max(load(&body));
    }
    let bears = f64::from(strength) * 0.1 * 0.1;
    let (first, at) = first.expect("it tears");
    println!(
        "first failure at {:.3} of what the waist bears, highest load {:.3}, at {at:e} Pa; {} failed between {:.3} and {:.3}",
        first / bears,
        highest / bears,
        broke.len(),
        broke.iter().copied().fold(1.0, f32::min),
        broke.iter().copied().fold(0.0, f32::max)
    );
    // At corners the stress is above the mean, so the first element fails before; and no load is above it.
    assert!(
        first > 0.5 * bears && first < bears && highest < 1.02 * bears,
        "{first} {highest} {bears}"
    );
    assert!(broke.iter().all(|x| (x - 0.5).abs() < 0.2), "{broke:?}");
    // It is in two: nothing is held any more.
    assert!(load(&body).abs() < 0.05 * highest, "{}", load(&body));
}

/// A free body that spins too fast for its strength. Of its energy: the bound of the front page, of what is whole.
#[test]
fn mass_and_momentum_are_exact_while_it_tears() {
    let mesh = box_mesh([1.0, 0.25, 0.25], [10, 2, 2]);
    let mut setup = Setup {
        h: 0.002,
        ..Setup::new("thrown", mesh)
    }
    .spinning([0.0, 2.0, 25.0]);
    setup.v.iter_mut().for_each(|v| v[1] += 3.0);
    let (oracle, tets) = (setup.reference(), setup.mesh.tets.len());
    let mass = oracle.mass().sum() / 3.0;
    for start in [Start::Galerkin(1), Start::Rigid(1)] {
        let settings = setup
            .solver(start, Preconditioner::Jacobi, 10)
            .with_fracture(Fracture::new(5e4, 2, 10_000).unwrap());
        let mut body = body_of(&setup, &settings);
        let (first, masses) = (body.momenta(), body.rest().masses.to_vec());
        let energy = |body: &OwnedBody, q: &[_], gone: &_| {
            let v = stack(body.velocities());
            let elastic = torn(&oracle, gone).elastic_energy_frozen(&stack(body.positions()), q);
            0.5 * v.component_mul(&oracle.mass()).dot(&v) + elastic
        };
        let mut failed = 0;
        for _ in 0..250 {
            let view = body.state().view();
            let (q, gone) = (frozen_rotations(&view, tets), broken(&view, tets));
            let before = energy(&body, &q, &gone);
            let report = body.step(&setup.scene(&[]), &settings);
            assert!(report.advanced());
            let now = broken(&body.state().view(), tets);
            assert!(energy(&body, &q, &gone) < before * (1.0 + 1e-6));
            assert!(energy(&body, &q, &now) <= energy(&body, &q, &gone));
            failed += report.fracture.broken;
            let momenta = body.momenta();
            for axis in 0..3 {
                let off = (momenta.linear[axis] - first.linear[axis]).abs();
                assert!(off < 2e-6 * 3.0 * mass, "{momenta:?}");
            }
        }
        assert_eq!(body.rest().masses, masses);
        println!("{start:?}: {failed} of {tets} failed");
        assert!(failed > 20 && (failed as usize) < tets);
    }
}

#[test]
fn the_most_stressed_fail_first_and_the_reserve_ends() {
    let setup = Setup {
        x: noise(0, 0.0, 0),
        ..Setup::new(
            "bar",
            jitter(&box_mesh([1.0, 0.5, 0.5], [4, 2, 2]), 0.05, 4),
        )
    };
    let x = setup
        .mesh
        .nodes
        .iter()
        .zip(noise(setup.mesh.nodes.len(), 0.02, 7));
    let setup = Setup {
        x: x.map(|(x, n)| [1.1 * x[0] + n[0], x[1] + n[1], x[2] + n[2]])
            .collect(),
        ..setup
    };
    let (oracle, tets) = (setup.reference(), setup.mesh.tets.len());
    for (per_step, reserve) in [(1, 1000), (5, 1000), (MOST_PER_STEP, 1000), (3, 7), (4, 0)] {
        let law = Fracture::new(3e4, per_step, reserve).unwrap();
        let settings = setup.settings().with_fracture(law);
        let mut body = body_of(&setup, &settings);
        let mut before = BTreeSet::new();
        for _ in 0..12 {
            let report = body.step(&setup.scene(&[]), &settings);
            assert!(report.advanced());
            let now = broken(&body.state().view(), tets);
            let mut above: Vec<(f64, usize)> =
                tensions(&oracle, &body).into_iter().zip(0..).collect();
            above.retain(|&(tension, e)| tension > 3e4 && !before.contains(&e));
            above.sort_by(|a, b| b.0.total_cmp(&a.0));
            let places = (per_step as usize).min(reserve as usize - before.len());
            let expected: BTreeSet<usize> = above.iter().take(places).map(|a| a.1).collect();
            assert_eq!(
                now.difference(&before).copied().collect::<BTreeSet<_>>(),
                expected
            );
            assert_eq!(report.fracture.broken as usize, expected.len());
            assert_eq!(
                report.fracture.spared as usize,
                above.len() - expected.len()
            );
            assert_eq!(report.fracture.left as usize, reserve as usize - now.len());
            before = now;
        }
        if reserve < 10 {
            assert_eq!(before.len(), reserve as usize);
        } else {
            assert!(before.len() > 3);
        }
    }
}

/// A node without whole tetrahedra is a free mass point: it flies on, in a straight line or a parabola.
#[test]
fn nodes_without_tetrahedra_fly() {
    let mut setup = Setup {
        gravity: [0.0, -9.81, 0.0],
        ..Setup::new("tet", single_tet())
    };
    setup.x = setup
        .mesh
        .nodes
        .iter()
        .map(|x| x.map(|c| 1.5 * c))
        .collect();
    setup.v = noise(4, 1.0, 3);
    for which in [0, 2, 3, 4, 6, 8] {
        let preconditioner = factors::preconditioner(&setup, which);
        let settings = setup
            .solver(Start::Galerkin(1), preconditioner, 20)
            .with_fracture(Fracture::new(1e3, 1, 1).unwrap());
        let mut body = body_of(&setup, &settings);
        assert_eq!(body.step(&setup.scene(&[]), &settings).fracture.broken, 1);
        let (x, v) = (stack(body.positions()), stack(body.velocities()));
        let h = f64::from(setup.h);
        for n in 1..=60 {
            assert!(body.step(&setup.scene(&[]), &settings).advanced());
            let n = f64::from(n);
            let mut expected: DVector<f64> = &x + &v * (n * h);
            expected
                .iter_mut()
                .skip(1)
                .step_by(3)
                .for_each(|y| *y -= 9.81 * h * h * n * (n + 1.0) / 2.0);
            let off = (stack(body.positions()) - &expected).amax();
            assert!(
                off < 2e-4 * expected.amax(),
                "{}: {off:e}",
                factors::name(which)
            );
        }
        assert_eq!(body.energies(Vec3::ZERO).elastic, 0.0);
    }
}

/// Factors are of the whole body. For a torn one they are of another matrix: slower, as stable, and the same answer.
#[test]
fn preconditioners_made_before_it_tore_still_solve() {
    let mesh = jitter(&box_mesh([1.0, 0.4, 0.3], [5, 2, 2]), 0.03, 5);
    let setup = Setup {
        beta: 0.002,
        alpha: 0.3,
        ..Setup::new("torn", mesh)
    }
    .spinning([3.0, 20.0, 30.0]);
    let tets = setup.mesh.tets.len();
    let tearing = setup
        .solver(Start::Galerkin(1), Preconditioner::Jacobi, 20)
        .with_fracture(Fracture::new(3e4, 4, 40).unwrap());
    let mut body = body_of(&setup, &tearing);
    for _ in 0..40 {
        assert!(body.step(&setup.scene(&[]), &tearing).advanced());
    }
    let gone = broken(&body.state().view(), tets);
    assert_eq!(gone.len(), 40);
    let state = body.state().clone();
    let whole = tearing.with_fracture(Fracture::new(3e4, 4, 0).unwrap());
    // The exact step, by Cholesky in f64.
    let mut oracle = torn(&setup.reference(), &gone);
    (oracle.x, oracle.v) = (stack(body.positions()), stack(body.velocities()));
    let q = frozen_rotations(&state.view(), tets);
    let (a, b) = oracle.system(&q);
    let exact = oracle.solve(&a, &b);
    let energy = |body: &OwnedBody| {
        let v = stack(body.velocities());
        0.5 * v.component_mul(&oracle.mass()).dot(&v)
            + oracle.elastic_energy_frozen(&stack(body.positions()), &q)
    };
    let before = energy(&body);
    for which in 0..factors::COUNT {
        let mut off = Vec::new();
        for iterations in [0, 1, 2, 5, 20, 80] {
            let budget = femto::Budget {
                iterations,
                polar_sweeps: 2,
            };
            let settings = whole
                .with_budget(budget)
                .with_preconditioner(factors::preconditioner(&setup, which));
            let mut body = body_of(&setup, &settings);
            body.state_mut().clone_from(&state);
            assert!(body.step(&setup.scene(&[]), &settings).advanced());
            assert!(
                energy(&body) < before * (1.0 + 1e-5),
                "{}, {iterations}",
                factors::name(which)
            );
            off.push((stack(body.velocities()) - &exact).norm() / exact.norm());
        }
        println!("{}: {off:?}", factors::name(which));
        // f32: 1e-7 times the condition's root.
        assert!(
            off[5] < 1e-4 && off[5] < off[1],
            "{}: {off:?}",
            factors::name(which)
        );
    }
}

#[test]
fn all_lanes_and_both_storages_give_the_same_bits() {
    for mesh in [two_pieces(), chain(9, 3)] {
        let setup = Setup {
            v: noise(mesh.nodes.len(), 4.0, 8),
            ..Setup::new("pieces", mesh)
        };
        let law = Plasticity::new(0.02, 0.2).unwrap();
        let settings = setup
            .settings()
            .with_plasticity(law)
            .with_fracture(Fracture::new(4e4, 3, 9).unwrap());
        let one = setup.run::<f32>(&settings, 30);
        let failed: u32 = one.1.iter().map(|report| report.fracture.broken).sum();
        assert!(failed > 2, "{failed}");
        assert_eq!(one, setup.run::<f32x4>(&settings, 30));
        assert_eq!(one, setup.run::<f32x8>(&settings, 30));

        let hash = |state: &StateRef<'_>| StateHash::new().with_state(state).value();
        let expected = hash(&one.0.view());
        arrays::run_twice(&setup, &settings, (30, 3), |state| {
            assert_eq!(hash(state), expected);
        });
    }
}

#[test]
fn what_is_refused() {
    for bad in [f32::NAN, f32::INFINITY, 0.0, -1.0] {
        let error = Fracture::new(bad, 1, 1).unwrap_err();
        assert!(matches!(error, FractureError::Strength(x) if x.to_bits() == bad.to_bits()));
    }
    for bad in [0, MOST_PER_STEP + 1] {
        assert_eq!(Fracture::new(1.0, bad, 1), Err(FractureError::PerStep(bad)));
    }
    let setup = Setup {
        v: noise(4, 50.0, 4),
        ..Setup::new("tet", single_tet())
    };
    let settings = setup
        .settings()
        .with_fracture(Fracture::new(1.0, 1, 1).unwrap());
    let mut bare: OwnedBody = setup.body(Start::default());
    assert_eq!(
        bare.step(&setup.scene(&[]), &settings).refusal,
        Some(Refusal::Fracture)
    );
    // A refused step breaks nothing.
    let mut body = body_of(&setup, &settings);
    let before = body.state().clone();
    let forces = [[f32::NAN; 3]; 4];
    let report = body.step(
        &Scene {
            forces: &forces,
            ..setup.scene(&[])
        },
        &settings,
    );
    assert!(!report.advanced() && report.fracture.broken == 0);
    assert_eq!(*body.state(), before);
    assert_eq!(body.step(&setup.scene(&[]), &settings).fracture.broken, 1);
    body.place(&setup.x, &setup.v).unwrap();
    assert!(broken(&body.state().view(), 1).is_empty());
}
