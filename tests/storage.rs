//! The step as a transaction, snapshots, and the two forms of storage.

mod support;

use femto::Pin;
use femto::body::{
    Body, State, Workspace, WorkspaceMut, rest_bytes, state_bytes, workspace_bytes,
    workspace_numbers,
};
use femto::collider::Collider;
use femto::element::{Dense, Factored, Layout};
use femto::energy::StateHash;
use femto::glam::Vec3;
use femto::lane::{Native, blocks};
use femto::material::Material;
use femto::mesh::{Mesh, MeshError};
use femto::owned::{OwnedBody, OwnedRest, OwnedState, OwnedWorkspace};
use femto::rest::{Header, Rest, RestBuffer, RestMut, TetBlock};
use femto::settings::{Budget, Settings, Start};
use femto::step::{Refusal, Scene, step};
use support::meshes::{box_mesh, jitter};
use support::scenes::{self, Setup};

const START: Start = Start::Rigid(3);

fn setup() -> Setup {
    let mut setup = scenes::free_spin();
    for x in &mut setup.x {
        x[1] += 0.3;
    }
    setup
}

fn colliders() -> [Collider<'static>; 1] {
    [Collider::half_space(Vec3::new(0.1, 1.0, 0.0), 0.0)
        .unwrap()
        .with_friction(0.3)
        .unwrap()]
}

fn settings(setup: &Setup) -> Settings<'static> {
    setup.settings().with_start(START)
}

fn hash(body: &OwnedBody) -> u64 {
    StateHash::new()
        .with(body.positions(), body.velocities())
        .value()
}

#[test]
fn a_hundred_steps_equal_fifty_snapshot_restore_fifty() {
    let (setup, colliders) = (setup(), colliders());
    let scene = Scene {
        colliders: &colliders,
        ..setup.scene(&[])
    };
    let run = |body: &mut OwnedBody, steps| {
        for _ in 0..steps {
            assert!(body.step(&scene, &settings(&setup)).advanced());
        }
    };
    let mut straight = setup.body(START);
    run(&mut straight, 100);

    let mut first = setup.body(START);
    run(&mut first, 50);
    let snapshot = first.state().clone();
    run(&mut first, 7);
    assert_ne!(*first.state(), snapshot);
    *first.state_mut() = snapshot.clone();
    run(&mut first, 50);
    assert_eq!(first.state(), straight.state());

    // In another body, with a workspace that never saw the first half.
    let mut other = setup.body(START);
    *other.state_mut() = snapshot;
    run(&mut other, 50);
    assert_eq!(other.state(), straight.state());
}

#[test]
fn a_refused_step_leaves_the_state_as_it_was() {
    let setup = setup();
    let mut body = setup.body(START);
    for _ in 0..5 {
        assert!(body.step(&setup.scene(&[]), &settings(&setup)).advanced());
    }
    let before = body.state().clone();
    let nodes = setup.x.len();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX] {
        let mut forces = vec![[0.0; 3]; nodes];
        forces[nodes / 2][1] = bad;
        let report = body.step(
            &Scene {
                forces: &forces,
                ..setup.scene(&[])
            },
            &settings(&setup),
        );
        let expected = if bad.is_finite() {
            Refusal::OutOfRange
        } else {
            Refusal::NonFinite { node: 0 }
        };
        assert_eq!(report.refusal, Some(expected), "{bad}");
        assert_eq!(*body.state(), before);
    }
    let report = body.step(
        &Scene {
            gravity: Vec3::NAN,
            ..setup.scene(&[])
        },
        &settings(&setup),
    );
    assert!(
        matches!(report.refusal, Some(Refusal::NonFinite { node: 0 })),
        "{report:?}"
    );
    assert_eq!(*body.state(), before);
    // And it goes on as if nothing had been.
    let mut other = setup.body(START);
    *other.state_mut() = before;
    for body in [&mut body, &mut other] {
        assert!(body.step(&setup.scene(&[]), &settings(&setup)).advanced());
    }
    assert_eq!(hash(&body), hash(&other));
}

#[test]
fn what_a_step_refuses_by_name() {
    let setup = setup();
    let mut body: OwnedBody = setup.body(Start::Galerkin(1));
    let before = body.state().clone();
    let nodes = setup.x.len();
    let pins = [
        femto::constraint::Pin::held(0),
        femto::constraint::Pin::held(nodes as u32),
    ];
    let forces = vec![[0.0; 3]; nodes - 1];
    let plain = setup.scene(&[]);
    let cases = [
        (
            Scene {
                pins: &pins,
                ..plain
            },
            Start::Galerkin(1),
            Refusal::Pin { pin: 1 },
        ),
        (
            Scene {
                forces: &forces,
                ..plain
            },
            Start::Galerkin(1),
            Refusal::Forces,
        ),
        (plain, Start::Galerkin(2), Refusal::History),
        (plain, Start::Rigid(1), Refusal::Vectors),
    ];
    for (scene, start, refusal) in cases {
        let report = body.step(&scene, &setup.settings().with_start(start));
        assert_eq!(report.refusal, Some(refusal));
        assert_eq!(*body.state(), before);
    }
    // A workspace or state of another size.
    let rest = body.rest();
    let (small, mut state) = (box_mesh([1.0; 3], [1; 3]), body.state().clone());
    let small = OwnedRest::<Factored>::new(
        &Mesh::new(&small.nodes, &small.tets).unwrap(),
        &setup.material(),
    )
    .unwrap();
    let mut work = OwnedWorkspace::new(&small.view(), Start::Galerkin(1));
    let report = step::<Native, _>(
        &rest,
        &mut state.view_mut(),
        &mut work.view_mut(&rest),
        &plain,
        &setup.settings(),
    );
    assert_eq!(report.refusal, Some(Refusal::Storage));
    assert_eq!(
        Body::<8, 1>::new().step(&plain, &setup.settings()).refusal,
        Some(Refusal::Storage)
    );
}

const NODES: usize = 63;
const BLOCKS: usize = blocks(144);
type Fixed = Body<NODES, BLOCKS, { START.history() }, { START.vectors() }>;

#[test]
fn fixed_and_run_time_storage_give_the_same_bits() {
    let (setup, colliders) = (setup(), colliders());
    let scene = Scene {
        colliders: &colliders,
        ..setup.scene(&[])
    };
    let mesh = Mesh::new(&setup.mesh.nodes, &setup.mesh.tets).unwrap();
    let mut fixed = Box::new(Fixed::new());
    fixed.fill(&mesh, &setup.material()).unwrap();
    fixed.place(&setup.x, &setup.v).unwrap();
    let mut owned: OwnedBody = setup.body(START);
    let mut saved = State::new();
    for step in 0..40 {
        if step == 20 {
            saved.copy_from(fixed.state());
        }
        assert_eq!(
            fixed.step(&scene, &settings(&setup)),
            owned.step(&scene, &settings(&setup))
        );
    }
    assert_eq!(fixed.positions(), owned.positions());
    assert_eq!(fixed.energies(Vec3::Y), owned.energies(Vec3::Y));
    let end = fixed.positions().to_vec();
    fixed.state_mut().copy_from(&saved);
    for _ in 20..40 {
        assert!(fixed.step(&scene, &settings(&setup)).advanced());
    }
    assert_eq!(fixed.positions(), end);
}

/// Several bodies over one rest shape and one workspace, as firmware would keep them.
#[test]
fn rest_data_and_workspace_are_shared() {
    let setup = setup();
    let mesh = Mesh::new(&setup.mesh.nodes, &setup.mesh.tets).unwrap();
    let mut rest = Box::new(RestBuffer::<NODES, BLOCKS>::new());
    rest.fill(&mesh, &setup.material()).unwrap();
    let rest = rest.view();
    let mut work = Box::new(Workspace::<NODES, BLOCKS, 1>::new());
    let mut states = [State::<NODES, BLOCKS>::new(), State::new()];
    let mut alone: OwnedBody = setup.body(Start::Galerkin(1));
    for (i, state) in states.iter_mut().enumerate() {
        state.reset(&rest).unwrap();
        let v = if i == 0 {
            setup.v.clone()
        } else {
            vec![[0.0, 1.0, 0.0]; setup.v.len()]
        };
        state.view_mut().place(&rest, &setup.x, &v).unwrap();
    }
    for _ in 0..10 {
        for state in &mut states {
            let report = step::<Native, _>(
                &rest,
                &mut state.view_mut(),
                &mut work.view_mut(&rest),
                &setup.scene(&[]),
                &setup.settings(),
            );
            assert!(report.advanced());
        }
        assert!(alone.step(&setup.scene(&[]), &setup.settings()).advanced());
    }
    assert_eq!(states[0].view().x, alone.positions());
    assert_ne!(states[1].view().x, alone.positions());
}

#[test]
fn bytes_are_known_at_compile_time() {
    const STATE: usize = state_bytes(NODES, BLOCKS, START.history());
    const WORK: usize = workspace_bytes::<Factored>(NODES, BLOCKS, START.vectors());
    const REST: usize = rest_bytes::<Factored>(NODES, BLOCKS);
    // The storage types add lengths and padding to 32 bytes, nothing more.
    let overhead =
        |whole: usize, parts: usize| whole.checked_sub(parts).is_some_and(|rest| rest < 128);
    assert!(
        overhead(Fixed::STATE_BYTES, STATE),
        "{} {STATE}",
        Fixed::STATE_BYTES
    );
    assert!(
        overhead(Fixed::WORKSPACE_BYTES, WORK),
        "{} {WORK}",
        Fixed::WORKSPACE_BYTES
    );
    assert!(
        overhead(Fixed::REST_BYTES, REST),
        "{} {REST}",
        Fixed::REST_BYTES
    );
    assert_eq!(
        workspace_bytes::<Dense>(NODES, BLOCKS, 0) - workspace_bytes::<Factored>(NODES, BLOCKS, 0),
        BLOCKS * 8 * (216 - 36)
    );
}

#[test]
fn a_mesh_that_does_not_fit_changes_nothing() {
    let setup = setup();
    let mesh = Mesh::new(&setup.mesh.nodes, &setup.mesh.tets).unwrap();
    let material = setup.material();
    let mut body = Body::<NODES, 1>::new();
    assert_eq!(
        body.fill(&mesh, &material),
        Err(MeshError::TooManyTets {
            needed: 144,
            capacity: 8
        })
    );
    let mut body = Body::<62, BLOCKS>::new();
    assert_eq!(
        body.fill(&mesh, &material),
        Err(MeshError::TooManyNodes {
            needed: 63,
            capacity: 62
        })
    );
    let small = box_mesh([1.0; 3], [1; 3]);
    let small = Mesh::new(&small.nodes, &small.tets).unwrap();
    body.fill(&small, &material).unwrap();
    let before = body.positions().to_vec();
    assert!(body.fill(&mesh, &material).is_err());
    assert_eq!(body.positions(), before);
    let heavy = Material::new(1e6, 0.3, 1e38).unwrap();
    let mut large = box_mesh([1e4; 3], [1; 3]);
    large.nodes[0][0] -= 1.0;
    let large = Mesh::new(&large.nodes, &large.tets).unwrap();
    assert_eq!(
        body.fill(&large, &heavy),
        Err(MeshError::OutOfScale { tet: 0 })
    );
    assert_eq!(body.positions(), before);
}

/// A body in a `static`, as firmware has it: nothing passes over the stack.
#[test]
fn a_body_lives_in_a_static() {
    use std::sync::Mutex;
    static BODY: Mutex<Fixed> = Mutex::new(Fixed::new());
    let setup = setup();
    let mut body = BODY.lock().unwrap();
    body.fill(
        &Mesh::new(&setup.mesh.nodes, &setup.mesh.tets).unwrap(),
        &setup.material(),
    )
    .unwrap();
    let settings = settings(&setup).with_budget(Budget {
        iterations: 3,
        polar_sweeps: 1,
    });
    assert!(body.step(&setup.scene(&[]), &settings).advanced());
}

#[test]
fn memory_of_the_callers_gives_the_same_bits() {
    let grid = jitter(&box_mesh([0.4, 0.3, 0.2], [2, 2, 1]), 0.02, 5);
    let mesh = Mesh::new(&grid.nodes, &grid.tets).unwrap();
    let material = Material::new(1e5, 0.3, 1000.0).unwrap();
    let (nodes, count) = (grid.nodes.len(), blocks(grid.tets.len()));
    let mut header = Header::EMPTY;
    let (mut x, mut masses) = (vec![[0.0; 3]; nodes], vec![0.0; nodes]);
    let (mut tets, mut stiffness) = (vec![TetBlock::ZERO; count], vec![(); count]);
    let mut out: RestMut<'_, Factored> = RestMut {
        nodes: &mut x,
        masses: &mut masses,
        blocks: &mut tets,
        stiffness: &mut stiffness,
        header: &mut header,
    };
    out.fill(&mesh, &material).unwrap();
    out.masses = &mut [];
    assert!(matches!(
        out.fill(&mesh, &material),
        Err(MeshError::TooManyNodes { capacity: 0, .. })
    ));
    let rest = Rest::<Factored> {
        nodes: &x,
        masses: &masses,
        blocks: &tets,
        stiffness: &stiffness,
        fans: &[],
        header,
    };

    let settings = Settings::new(0.01).unwrap();
    let scene = Scene {
        gravity: Vec3::new(0.0, -9.81, 0.0),
        pins: &[Pin::held(0)],
        ..Scene::default()
    };
    let mut body: OwnedBody = OwnedBody::new(&mesh, &material, settings.start).unwrap();
    let mut state = OwnedState::new(&rest, settings.start);
    let vectors = settings.start.vectors();
    let mut rotated = vec![Factored::ZERO_ROTATED; count];
    let mut numbers = vec![0.0; workspace_numbers(nodes, count, vectors)];
    assert_eq!(
        size_of_val(&*rotated) + size_of_val(&*numbers),
        workspace_bytes::<Factored>(nodes, count, vectors)
    );
    for _ in 0..20 {
        assert!(body.step(&scene, &settings).advanced());
        let mut work = WorkspaceMut::over(&rest, vectors, &mut rotated, &mut numbers);
        let report =
            step::<Native, Factored>(&rest, &mut state.view_mut(), &mut work, &scene, &settings);
        assert!(report.advanced());
        assert_eq!(&state, body.state());
    }
    // A number too little, and the step is refused.
    let short = numbers.len() - 1;
    let mut work = WorkspaceMut::over(&rest, vectors, &mut rotated, &mut numbers[..short]);
    let report =
        step::<Native, Factored>(&rest, &mut state.view_mut(), &mut work, &scene, &settings);
    assert_eq!(report.refusal, Some(Refusal::Vectors));
}
