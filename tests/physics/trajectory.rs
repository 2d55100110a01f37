//! Whole runs at a fixed budget against exact solves in f64: two iterations with a warped factor stay on the
//! path, where ten with the paper's start and preconditioner leave it.

use crate::support::factors::factor;
use crate::support::ground::Grounded;
use crate::support::meshes::box_mesh;
use crate::support::reference::node;
use crate::support::scenes::Setup;
use femto::collider::Collider;
use femto::element::Factored;
use femto::glam::Vec3;
use femto::owned::OwnedBody;
use femto::settings::{Preconditioner, Settings, Start};
use femto::step::Scene;
use femto_bake::{Kind, Precision};

/// A second of motion.
fn steps(setup: &Setup) -> u32 {
    (1.0 / setup.h).round() as u32
}

/// 1 m × 0.25 m × 0.25 m, 208 nodes, ν = 0.4, h = 1/150.
fn bar(name: &'static str, young: f32) -> Setup {
    Setup {
        young,
        ..Setup::new(name, box_mesh([1.0, 0.25, 0.25], [12, 3, 3]))
    }
}

fn spin(young: f32) -> Setup {
    bar("spin", young).spinning([0.5, 1.0, 3.0])
}

fn cantilever(young: f32) -> Setup {
    Setup {
        gravity: [0.0, -9.81, 0.0],
        ..bar("cantilever", young).pinned(|x| x[0] < 1e-6, |_| [0.0; 3])
    }
}

/// Tilted, 5 cm above the ground.
fn drop(young: f32) -> Setup {
    let mut setup = bar("drop", young);
    for x in &mut setup.x {
        *x = [
            0.96 * x[0] - 0.28 * x[1],
            0.28 * x[0] + 0.96 * x[1] + 0.05,
            x[2],
        ];
    }
    setup.gravity = [0.0, -9.81, 0.0];
    setup
}

fn stiff(setup: Setup) -> Setup {
    Setup {
        young: 1e9,
        poisson: 0.49,
        h: 1.0 / 60.0,
        ..setup
    }
}

fn path(setup: &Setup, settings: &Settings<'_>) -> Vec<Vec<[f32; 3]>> {
    let mut body: OwnedBody = setup.body::<Factored>(settings.start);
    let pins = setup.pin_list();
    let ground = [Collider::half_space(Vec3::Y, 0.0).unwrap()];
    let scene = Scene {
        colliders: if setup.name == "drop" { &ground } else { &[] },
        ..setup.scene(&pins)
    };
    let step = |_| {
        let report = body.step(&scene, settings);
        assert!(report.advanced(), "{}: {report:?}", setup.name);
        body.positions().to_vec()
    };
    (0..steps(setup)).map(step).collect()
}

/// The oracle's path, with two velocities in W. (At E = 1e9 converged runs in f32 are up to 2e-3 from it, by rounding
/// in the impact: no reference.)
fn exact_path(setup: &Setup) -> Vec<Vec<[f32; 3]>> {
    let unit = setup.rest::<Factored>().view().header.length_unit;
    let mut oracle = Grounded::new(setup.reference(), 2, f64::from(unit) / 4096.0);
    let step = |_| {
        if setup.name == "drop" {
            oracle.step();
        } else {
            oracle.body.step();
        }
        let place = |i| -> [f32; 3] { node(&oracle.body.x, i).map(|x| x as f32).into() };
        (0..setup.x.len()).map(place).collect()
    };
    (0..steps(setup)).map(step).collect()
}

/// Root mean square over the nodes, mean over the steps, over the bounding box's diagonal.
fn distance(setup: &Setup, a: &[Vec<[f32; 3]>], b: &[Vec<[f32; 3]>]) -> f64 {
    let mut sum = 0.0;
    for (a, b) in a.iter().zip(b) {
        let square = |a: &[f32; 3], b: &[f32; 3]| -> f64 {
            let axis = |k: usize| (f64::from(a[k]) - f64::from(b[k])).powi(2);
            axis(0) + axis(1) + axis(2)
        };
        let squares: f64 = a.iter().zip(b).map(|(a, b)| square(a, b)).sum();
        sum += (squares / a.len() as f64).sqrt();
    }
    sum / a.len() as f64 / setup.reference().bbox_diagonal()
}

/// The oracle on the ground and the crate, converged, decide the same and move alike.
#[test]
fn the_oracle_lands_as_the_crate_does() {
    for young in [1e6, 1e7, 1e9] {
        let setup = drop(young);
        let settings = setup.solver(Start::Galerkin(2), Preconditioner::BlockJacobi, 600);
        let apart = distance(&setup, &path(&setup, &settings), &exact_path(&setup));
        println!("drop, E = {young:e}: {apart:.1e} apart");
        assert!(apart < 1e-5 || young > 1e8, "{apart:e}");
    }
}

/// Two iterations with a factor stay on the path, at three stiffnesses.
fn stays_on_the_path(body: fn(f32) -> Setup, allowed: [f64; 3]) {
    let mut missed = Vec::new();
    for (setup, allowed) in [body(1e6), body(1e7), stiff(body(0.0))]
        .into_iter()
        .zip(allowed)
    {
        let converged = exact_path(&setup);
        let warped = Preconditioner::Factored(factor(&setup, Kind::Warped, Precision::Single));
        let ours = path(&setup, &setup.solver(Start::Galerkin(2), warped, 2));
        let papers = path(
            &setup,
            &setup.solver(Start::Velocity, Preconditioner::Jacobi, 10),
        );
        let (ours, papers) = (
            distance(&setup, &ours, &converged),
            distance(&setup, &papers, &converged),
        );
        println!(
            "{}, E = {:e}: warped, galerkin-2, 2 iterations {ours:.1e}; Jacobi, velocity, 10 iterations {papers:.1e}",
            setup.name, setup.young
        );
        if !(ours < allowed && papers > 2.0 * ours) {
            missed.push((setup.name, setup.young));
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}

#[test]
fn a_spinning_bar_stays_on_the_path() {
    stays_on_the_path(spin, [1e-3; 3]);
}

#[test]
fn a_cantilever_stays_on_the_path() {
    stays_on_the_path(cantilever, [1e-3; 3]);
}

/// At E = 1e9 what comes after the impact is a matter of its roundings: six drops from heights 10 μm apart are 1.1e-3 to
/// 4.2e-3 off the path, 2.3e-3 in the mean.
#[test]
fn a_dropped_bar_stays_on_the_path() {
    stays_on_the_path(drop, [5e-4, 5e-4, 5e-3]);
}
