//! How far each preconditioner brings a step in so many iterations: ‖v_k − v*‖_A / ‖v*‖_A with v* a dense
//! direct solve of the same system in f64, for free, held, stiff, twisted and touching bodies. The table is kept in
//! `golden/solve_error.txt`; `FEMTO_BLESS=1 cargo test --test solver solve_error` writes it anew.

use crate::support::factors::factor;
use crate::support::meshes::{TetMesh, box_mesh};
use crate::support::reference::stack;
use crate::support::scenes::Setup;
use femto::body::StateRef;
use femto::collider::Collider;
use femto::element::Factored;
use femto::glam::Vec3;
use femto::owned::{OwnedBody, OwnedState};
use femto::settings::{Preconditioner, Start};
use femto::step::Scene;
use femto_bake::{Kind, Precision};
use nalgebra::{DMatrix, DVector};

const ITERATIONS: [u32; 6] = [1, 2, 3, 5, 10, 30];

/// What a scene's state is after some converged steps, and what the step from there has to solve.
struct Case {
    setup: Setup,
    colliders: Vec<Collider<'static>>,
    steps: u32,
}

/// 1 m × 0.25 m × 0.25 m, 208 nodes, ν = 0.4.
fn bar(name: &'static str, young: f32) -> Setup {
    Setup {
        young,
        ..Setup::new(name, box_mesh([1.0, 0.25, 0.25], [12, 3, 3]))
    }
}

fn held(setup: Setup) -> Setup {
    Setup {
        gravity: [0.0, -9.81, 0.0],
        ..setup.pinned(|x| x[0] < 1e-6, |_| [0.0; 3])
    }
}

fn twisted() -> Setup {
    let mut setup = bar("twisted by 360, E = 1e6", 1e6);
    for x in &mut setup.x {
        let (sin, cos) = (f64::from(x[0]) * std::f64::consts::TAU).sin_cos();
        let (y, z) = (f64::from(x[1]) - 0.125, f64::from(x[2]) - 0.125);
        x[1] = (cos * y - sin * z) as f32;
        x[2] = (sin * y + cos * z) as f32;
    }
    setup
}

/// Standing upright on 16 nodes, pushed along.
fn standing() -> Setup {
    let mut setup = bar("16 nodes in contact, E = 1e6", 1e6);
    for (x, v) in setup.x.iter_mut().zip(&mut setup.v) {
        *x = [x[1], x[0], x[2]].map(|c| c);
        *v = [0.5 * x[1], 0.0, 0.2 * x[1]];
    }
    for tet in &mut setup.mesh.tets {
        tet.swap(2, 3);
    }
    setup.mesh.nodes.clone_from(&setup.x);
    setup.gravity = [0.0, -9.81, 0.0];
    setup
}

/// The mesh of the tool's scene, swinging from its head.
fn snowman() -> Setup {
    let bytes = include_bytes!("../../examples/femto-cli/meshes/snowman.msh");
    let msh = mshio::parse_msh_bytes(bytes).unwrap();
    let mut mesh = TetMesh::default();
    for block in msh.data.nodes.unwrap().node_blocks {
        assert!(block.node_tags.is_none(), "tags run from 1");
        let nodes = block.nodes.iter();
        mesh.nodes
            .extend(nodes.map(|x| [x.x as f32, x.y as f32, x.z as f32]));
    }
    for block in msh.data.elements.unwrap().element_blocks {
        let tets = block.elements.iter();
        mesh.tets
            .extend(tets.map(|e| std::array::from_fn(|c| e.nodes[c] as u32 - 1)));
    }
    let top = mesh.nodes.iter().map(|x| x[1]).fold(f32::MIN, f32::max);
    let mut setup = Setup {
        young: 1e5,
        gravity: [0.0, -9.81, 0.0],
        ..Setup::new("snowman hung by its head, E = 1e5", mesh)
    }
    .pinned(|x| x[1] > top - 0.15, |_| [0.0; 3]);
    for (v, x) in setup.v.iter_mut().zip(&setup.x) {
        v[0] = top - x[1];
    }
    setup
}

fn cases() -> Vec<Case> {
    let ground = Collider::half_space(Vec3::Y, 0.0).unwrap();
    let stiff = Setup {
        poisson: 0.49,
        h: 1.0 / 60.0,
        ..held(bar("cantilever, E = 1e9, nu = 0.49, h = 1/60", 1e9))
    };
    let free = |setup, steps| Case {
        setup,
        colliders: Vec::new(),
        steps,
    };
    vec![
        free(bar("spin, E = 1e6", 1e6).spinning([0.5, 2.0, 6.0]), 20),
        free(held(bar("cantilever, E = 1e7", 1e7)), 20),
        free(stiff, 5),
        free(twisted(), 5),
        Case {
            setup: standing(),
            colliders: vec![ground],
            steps: 5,
        },
        free(snowman(), 20),
    ]
}

/// The step's system in f64, without what is held.
struct System {
    a: DMatrix<f64>,
    best: DVector<f64>,
    free: Vec<usize>,
}

impl System {
    /// `still` tells which components contact has fixed (at 0). A is the oracle's; b is the step's own,
    /// rounded as it is, which the first iteration from rest without surfaces tells: v₁ = αb with α = b·b/(b·Ab).
    fn new(setup: &Setup, state: &StateRef<'_>, still: &[bool], v_1: &[[f32; 3]]) -> Self {
        let mut oracle = setup.reference();
        (oracle.x, oracle.v) = (stack(state.x), stack(state.v));
        let q = oracle.rotations(&oracle.x);
        let (a, exact) = oracle.system(&q);
        let mut v_1 = stack(v_1);
        for (dof, v) in v_1.iter_mut().enumerate() {
            if oracle.pins[dof / 3].is_some() {
                *v = 0.0;
            }
        }
        let b = &v_1 * ((&a * &v_1).dot(&v_1) / v_1.dot(&v_1));
        let free: Vec<usize> = (0..exact.len())
            .filter(|&dof| oracle.pins[dof / 3].is_none() && !still[dof])
            .collect();
        let a = a.select_rows(&free).select_columns(&free);
        let b = b.select_rows(&free);
        let best = a.clone().cholesky().unwrap().solve(&b);
        Self { a, best, free }
    }

    fn error(&self, v: &[[f32; 3]]) -> f64 {
        let norm = |v: &DVector<f64>| (&self.a * v).dot(v).sqrt();
        norm(&(stack(v).select_rows(&self.free) - &self.best)) / norm(&self.best)
    }
}

/// Errors of one case, a line for each start and preconditioner.
fn lines(case: &Case) -> Vec<(String, Vec<f64>)> {
    let setup = &case.setup;
    let pins = setup.pin_list();
    let scene = Scene {
        colliders: &case.colliders,
        ..setup.scene(&pins)
    };
    let warped = Preconditioner::Factored(factor(setup, Kind::Warped, Precision::Single));
    let preconditioners = [
        ("Jacobi", Preconditioner::Jacobi),
        ("block Jacobi", Preconditioner::BlockJacobi),
        ("two-level", setup.two_level(8)),
        (
            "Laplacian",
            Preconditioner::Factored(factor(setup, Kind::Laplacian, Precision::Single)),
        ),
        (
            "Laplacian f16",
            Preconditioner::Factored(factor(setup, Kind::Laplacian, Precision::Half)),
        ),
        ("warped", warped),
        (
            "warped f16",
            Preconditioner::Factored(factor(setup, Kind::Warped, Precision::Half)),
        ),
    ];
    let history = Start::Galerkin(2);
    let needs = setup.solver(history, setup.two_level(8), 1);
    let mut body: OwnedBody = setup.body::<Factored>(&needs);
    for _ in 0..case.steps {
        let converged = setup.solver(history, warped, 100);
        assert!(body.step(&scene, &converged).advanced());
    }
    let before: OwnedState = body.state().clone();
    // Without friction contact fixes y alone; which nodes it holds, a converged step tells.
    let report = body.step(&scene, &setup.solver(Start::Zero, warped, 100));
    let still: Vec<bool> = body
        .velocities()
        .as_flattened()
        .iter()
        .enumerate()
        .map(|(dof, v)| report.contacts > 0 && dof % 3 == 1 && *v == 0.0)
        .collect();
    let fixed = still.iter().filter(|still| **still).count();
    assert_eq!(fixed, report.contacts as usize);
    *body.state_mut() = before.clone();
    let first = setup.solver(Start::Zero, Preconditioner::Identity, 1);
    let airborne = Scene {
        colliders: &[],
        ..scene
    };
    assert!(body.step(&airborne, &first).advanced());
    let system = System::new(setup, &before.view(), &still, body.velocities());
    let mut out = Vec::new();
    for start in [Start::Velocity, history] {
        for (name, preconditioner) in preconditioners {
            let errors = ITERATIONS.map(|iterations| {
                *body.state_mut() = before.clone();
                let settings = setup.solver(start, preconditioner, iterations);
                assert!(body.step(&scene, &settings).advanced());
                system.error(body.velocities())
            });
            let start = match start {
                Start::Velocity => "velocity",
                _ => "galerkin-2",
            };
            out.push((
                format!("{} | {start} | {name}", setup.name),
                errors.to_vec(),
            ));
        }
    }
    out
}

/// Errors may be off the table's by this factor, and below this they are rounding.
const FACTOR: f64 = 1.3;
const ROUNDING: f64 = 1e-5;

#[test]
fn errors_are_those_of_the_table() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/solve_error.txt");
    let mut found = Vec::new();
    for case in cases() {
        found.extend(lines(&case));
    }
    if std::env::var_os("FEMTO_BLESS").is_some() {
        let mut text = format!("scene | start | preconditioner | {ITERATIONS:?}\n");
        for (name, errors) in &found {
            let errors: Vec<String> = errors.iter().map(|e| format!("{e:.1e}")).collect();
            text += &format!("{name} | {}\n", errors.join(" "));
        }
        std::fs::write(path, text).unwrap();
    }
    let golden = std::fs::read_to_string(path).unwrap();
    let golden: Vec<&str> = golden.lines().skip(1).collect();
    assert_eq!(golden.len(), found.len());
    for (line, (name, errors)) in golden.iter().zip(&found) {
        let (key, numbers) = line.rsplit_once(" | ").unwrap();
        assert_eq!(key, name);
        for ((expected, error), k) in numbers.split(' ').zip(errors).zip(ITERATIONS) {
            let expected: f64 = expected.parse().unwrap();
            let (low, high) = (expected / FACTOR - ROUNDING, expected * FACTOR + ROUNDING);
            assert!(
                (low..=high).contains(error),
                "{name}, {k} iterations: {error:e}, the table has {expected:e}"
            );
        }
    }
}
