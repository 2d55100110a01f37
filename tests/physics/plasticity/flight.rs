//! Energy and momenta of bodies that yield in flight.

use femto::glam::Vec3;
use femto::owned::OwnedBody;
use femto::{Plasticity, Preconditioner, Settings, Start};
use nalgebra::Vector3;

use super::{elastic, plastic_body, plastic_strains};
use crate::support::account::frozen_rotations;
use crate::support::meshes::box_mesh;
use crate::support::reference::stack;
use crate::support::scenes::Setup;

/// What became of a body that was stretched and thrown.
struct Flight {
    /// ΣD over the first energy.
    dissipated: f64,
    /// The greatest rise of E + ΣD in a step, over the first energy.
    step: f64,
    /// The greatest E + ΣD, over the first energy.
    most: f64,
    /// Change of the angular momentum, over the first.
    turned: f64,
}

/// Asserts for every step the bound of the front page, with the step's own rotations and plastic strain, and that
/// linear momentum is kept.
fn fly(setup: &Setup, settings: &Settings<'_>) -> Flight {
    let (oracle, tets) = (setup.reference(), setup.mesh.tets.len());
    let mut body = plastic_body(setup, settings);
    let mechanical = |body: &OwnedBody, q: &[_], p: &[_]| {
        let v = stack(body.velocities());
        let kinetic = 0.5 * v.component_mul(&oracle.mass()).dot(&v);
        kinetic + elastic(&oracle, body.positions(), q, p)
    };
    let first = body.energies(Vec3::ZERO).total();
    let (mass, momenta) = (oracle.mass().sum() / 3.0, body.momenta());
    let mut flight = Flight {
        dissipated: 0.0,
        step: 0.0,
        most: 0.0,
        turned: 0.0,
    };
    let mut last = 1.0;
    for _ in 0..200 {
        let view = body.state().view();
        let (q, p) = (frozen_rotations(&view, tets), plastic_strains(&view, tets));
        let before = mechanical(&body, &q, &p);
        let report = body.step(&setup.scene(&[]), settings);
        assert!(report.advanced());
        let after = mechanical(&body, &q, &p);
        assert!(
            after < before + 1e-5 * first,
            "{settings:?}: {before} {after}"
        );
        flight.dissipated += f64::from(report.dissipated) / first;
        let now = body.energies(Vec3::ZERO).total() / first + flight.dissipated;
        flight.step = flight.step.max(now - last);
        flight.most = flight.most.max(now);
        last = now;
    }
    let end = body.momenta();
    for axis in 0..3 {
        assert!((end.linear[axis] - momenta.linear[axis]).abs() < 1e-4 * mass);
    }
    let [a, b] = [end, momenta].map(|m| Vector3::from(m.angular));
    flight.turned = (a - b).norm() / b.norm();
    flight
}

/// E + ΣD rises in no step but by what fitting the rotations anew feeds a body at large strains, which an
/// elastic body gets as well (see the front page).
#[test]
fn energy_and_what_was_dissipated_never_rise() {
    let elastic = Plasticity::new(9.0, 9.0).unwrap();
    let plastic = Plasticity::new(0.03, 0.3)
        .and_then(|law| law.with_relaxation(0.01))
        .unwrap();
    for stretch in [0.1, 0.4] {
        let mut setup = Setup::new("bar", box_mesh([1.0, 0.25, 0.25], [6, 2, 2]));
        let place = |&[x, y, z]: &[f32; 3]| {
            [
                (1.0 + stretch) * x + stretch * y,
                (1.0 - 0.5 * stretch) * y,
                z,
            ]
        };
        setup.x = setup.mesh.nodes.iter().map(place).collect();
        let setup = setup.spinning([0.0, 1.0, 6.0]);
        for (start, iterations) in [
            (Start::Zero, 1),
            (Start::Galerkin(1), 0),
            (Start::Galerkin(1), 5),
            (Start::Rigid(2), 20),
        ] {
            let settings = setup.solver(start, Preconditioner::Jacobi, iterations);
            let [without, with] =
                [elastic, plastic].map(|law| fly(&setup, &settings.with_plasticity(law)));
            println!(
                "stretch {stretch}, {start:?}, {iterations}: dissipated {:.3} of E; rise a step {:.1e}, elastic {:.1e}; \
                 E + D at most {:.5}, elastic {:.5}; angular momentum {:.4} off, elastic {:.4}",
                with.dissipated,
                with.step,
                without.step,
                with.most,
                without.most,
                with.turned,
                without.turned
            );
            assert!(without.dissipated == 0.0 && with.dissipated > 0.01);
            assert!(
                with.step < f64::max(1e-3, 2.0 * without.step),
                "{:e}",
                with.step
            );
            assert!(
                with.most < f64::max(1.0 + 1e-3, 1.0 + 2.0 * (without.most - 1.0)),
                "{}",
                with.most
            );
        }
    }
}
