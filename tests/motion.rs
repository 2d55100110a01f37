//! One step and 200 steps against the oracle.

mod support;

use femto::element::{Dense, Factored, Layout};
use femto::settings::{Budget, Preconditioner, Start};
use support::scenes::{self, Setup, distance};

const CONVERGED: Budget = Budget { iterations: 400, polar_sweeps: 8 };

fn run<L: Layout>(setup: &Setup, start: Start, preconditioner: Preconditioner, steps: usize) -> f64 {
    let mut body = setup.body::<L>(start);
    let mut reference = setup.reference();
    let pins = setup.pin_list();
    let scene = setup.scene(&pins);
    let settings =
        setup.settings().with_budget(CONVERGED).with_start(start).with_preconditioner(preconditioner);
    for step in 0..steps {
        let report = body.step(&scene, &settings);
        assert!(report.advanced(), "{}: {report:?}", setup.name);
        reference.step();
        if step == 0 {
            println!("{} first {:e} {report:?}", setup.name, distance(body.positions(), &reference));
        }
    }
    distance(body.positions(), &reference)
}

#[test]
fn two_hundred_steps_follow_the_oracle() {
    for setup in scenes::all() {
        for start in [Start::Zero, Start::Velocity, Start::Galerkin(1), Start::Galerkin(3), Start::Rigid(2)] {
            let error = run::<Factored>(&setup, start, Preconditioner::Jacobi, 200);
            println!("{} {start:?}: {error:e}", setup.name);
            let error = run::<Dense>(&setup, start, Preconditioner::BlockJacobi, 200);
            println!("{} dense {start:?}: {error:e}", setup.name);
        }
    }
}
