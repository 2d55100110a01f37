//! One step in a state of the caller's choice, for counting its instructions:
//!
//! ```text
//! valgrind --tool=callgrind --toggle-collect=counted_step --callgrind-out-file=/dev/null cost START STATE
//! ```
//!
//! The count depends on START, which is part of the settings, and must not depend on STATE. `cost` alone
//! prints how many of each there are; `cost START drift` takes a step whose cost does depend on the
//! state, on purpose, to show that the comparison would see it.

use std::process::ExitCode;

use femto::glam::Vec3;
use femto::owned::OwnedRest;
use femto::preconditioner::aggregate::{Aggregates, DEFAULT_AGGREGATES, MAX_AGGREGATES};
use femto::{
    Collider, Material, Mesh, OwnedBody, Pin, Preconditioner, Scene, Settings, Start, StepReport,
};

#[path = "../mesh.rs"]
#[allow(dead_code, reason = "the benchmark uses more of it")]
mod mesh;

/// Each with block Jacobi alone, or with so many aggregates.
const STARTS: [(Start, usize); 8] = [
    (Start::Zero, 0),
    (Start::Velocity, 0),
    (Start::VelocityForce, 0),
    (Start::Galerkin(1), 0),
    (Start::Galerkin(3), 0),
    (Start::Rigid(2), 0),
    (Start::Galerkin(1), DEFAULT_AGGREGATES),
    (Start::Galerkin(3), MAX_AGGREGATES),
];

/// x and v of a state, from those of the body at rest.
type State = fn(&mut [[f32; 3]], &mut [[f32; 3]]);

const STATES: [State; 13] = [
    // rest
    |_, _| {},
    // wild spin
    |x, v| {
        x.iter()
            .zip(v)
            .for_each(|(x, v)| *v = [-50.0 * x[1], 50.0 * x[0], 1.0])
    },
    // crushed to a point
    |x, _| x.fill([0.1; 3]),
    // flattened
    |x, _| x.iter_mut().for_each(|x| x[1] = 0.2),
    // mirrored
    |x, _| x.iter_mut().for_each(|x| x[0] = -x[0]),
    // half inverted
    |x, _| {
        x.iter_mut()
            .filter(|x| x[0] > 0.15)
            .for_each(|x| x[1] = -x[1])
    },
    // random
    |x, v| {
        let mut seed = 1_u32;
        for c in x.iter_mut().chain(v).flatten() {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            *c = (seed >> 8) as f32 / 8_388_608.0 - 1.0;
        }
    },
    // deep in contact
    |x, v| {
        x.iter_mut()
            .zip(v)
            .for_each(|(x, v)| (x[1], *v) = (x[1] - 0.3, [1.0, -2.0, 0.5]))
    },
    // just in contact
    |x, _| x.iter_mut().for_each(|x| x[1] -= 0.02),
    // far from contact
    |x, _| x.iter_mut().for_each(|x| x[1] += 5.0),
    // fast
    |_, v| v.fill([1e4, -1e4, 0.0]),
    // subnormal motion
    |_, v| v.fill([1e-39, 1e-41, 0.0]),
    // after a refused step
    |_, v| v.fill([f32::MAX, 0.0, 0.0]),
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [start, state] = arguments.as_slice() else {
        println!("{} {}", STARTS.len(), STATES.len());
        return ExitCode::SUCCESS;
    };
    let drift = state == "drift";
    let chosen = start.parse().ok().and_then(|i: usize| STARTS.get(i));
    let (Some(&(start, aggregates)), Some(state)) = (
        chosen,
        STATES.get(state.parse().unwrap_or(usize::from(drift))),
    ) else {
        eprintln!("no such start or state");
        return ExitCode::from(2);
    };
    let scene = mesh::box_scene([3, 3, 3]);
    let rest = Mesh::new(&scene.nodes, &scene.tets).expect("a valid mesh");
    let material = Material::new(1e6, 0.4, 1000.0).expect("a valid material");
    let rest = OwnedRest::new(&rest, &material).expect("in range");
    let mut of = vec![0; scene.nodes.len()];
    let aggregates =
        Aggregates::divide(&rest.view(), aggregates, &mut of).expect("not too many aggregates");
    let settings = Settings::new(1.0 / 60.0)
        .expect("a valid step")
        .with_start(start)
        .with_preconditioner(match aggregates.count() {
            0 => Preconditioner::BlockJacobi,
            _ => Preconditioner::TwoLevel(aggregates),
        });
    let mut body: OwnedBody = OwnedBody::from_rest(rest, &settings);
    let (mut x, mut v) = (scene.nodes.clone(), vec![[0.0; 3]; scene.nodes.len()]);
    state(&mut x, &mut v);
    body.place(&x, &v).expect("a finite state");
    let ground = Collider::half_space(Vec3::Y, 0.0)
        .and_then(|c| c.with_friction(0.5))
        .expect("valid");
    let ball = Collider::sphere(Vec3::new(0.5, -0.5, 0.5), 0.51).expect("valid");
    let (colliders, pins) = ([ground, ball], [Pin::held(63)]);
    // Held bodies in one half of the starts, free ones in the other.
    let pins: &[Pin] = if start == Start::Galerkin(3) {
        &pins
    } else {
        &[]
    };
    let world = Scene {
        gravity: Vec3::new(0.0, -9.81, 0.0),
        pins,
        colliders: &colliders,
        ..Scene::default()
    };
    if v[0][0] == f32::MAX {
        let refused = body.step(&world, &settings);
        assert!(!refused.advanced(), "{refused:?}");
        v.fill([0.0; 3]);
        body.place(&x, &v).expect("a finite state");
    }
    let report = if drift {
        drifting_step(&mut body, &world, &settings)
    } else {
        counted_step(&mut body, &world, &settings)
    };
    assert!(report.advanced(), "{report:?}");
    ExitCode::SUCCESS
}

#[expect(unsafe_code, reason = "callgrind finds the function by its name")]
#[unsafe(no_mangle)]
#[inline(never)]
fn counted_step(body: &mut OwnedBody, scene: &Scene<'_>, settings: &Settings) -> StepReport {
    body.step(scene, settings)
}

/// Stops at a tolerance, as solvers usually do: the cost depends on the state.
fn drifting_step(body: &mut OwnedBody, scene: &Scene<'_>, settings: &Settings) -> StepReport {
    let saved = body.state().clone();
    let mut settings = *settings;
    loop {
        let report = counted_step(body, scene, &settings);
        settings.budget.iterations += 1;
        if report.relative_residual() < 1e-3 || settings.budget.iterations > 50 {
            return report;
        }
        *body.state_mut() = saved.clone();
    }
}
