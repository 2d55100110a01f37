//! Steps and runs with the two-level preconditioner: what it buys, what is refused, where it is stored.

use crate::support::meshes::box_mesh;
use crate::support::scenes::{Setup, bar, bent};
use femto::body::Body;
use femto::collider::Collider;
use femto::element::Factored;
use femto::glam::Vec3;
use femto::lane::blocks;
use femto::mesh::Mesh;
use femto::owned::OwnedBody;
use femto::preconditioner::aggregate::{AggregatesError, MAX_AGGREGATES, NONE};
use femto::preconditioner::coarse::coarse_length;
use femto::preconditioner::{Aggregates, Preconditioner};
use femto::settings::Start;
use femto::step::{Refusal, Scene};

/// Without aggregates it is block Jacobi, bit for bit.
#[test]
fn without_aggregates_it_is_block_jacobi() {
    let setup = gravity(bent(bar()));
    let run = |preconditioner| {
        let settings = setup.solver(Start::Galerkin(1), preconditioner, 3);
        let mut body: OwnedBody = setup.body(&settings);
        assert!(body.step(&setup.scene(&[]), &settings).advanced());
        body.velocities().to_vec()
    };
    let jacobi = run(Preconditioner::BlockJacobi);
    assert_eq!(jacobi, run(setup.two_level(0)));
    assert_ne!(jacobi, run(setup.two_level(1)));
}

#[test]
fn what_does_not_fit_is_refused() {
    let setup = gravity(bar());
    let of = vec![0; setup.x.len()];
    let settings = |of| {
        let aggregates = Aggregates::new(of, 2).unwrap();
        setup.solver(Start::Galerkin(1), Preconditioner::TwoLevel(aggregates), 2)
    };
    let mut body: OwnedBody = setup.body(Start::Galerkin(1));
    let refusal = |body: &mut OwnedBody, of| body.step(&setup.scene(&[]), &settings(of)).refusal;
    assert_eq!(refusal(&mut body, &of), Some(Refusal::Coarse));
    assert_eq!(refusal(&mut body, &of[1..]), Some(Refusal::Aggregates));
    let mut roomy: OwnedBody = setup.body(&settings(&of));
    assert_eq!(refusal(&mut roomy, &of[1..]), Some(Refusal::Aggregates));
    assert_eq!(refusal(&mut roomy, &of), None);

    let unknown = Aggregates::new(&[0, NONE, 1, 2], 2);
    assert_eq!(unknown, Err(AggregatesError::Unknown { node: 3 }));
    let count = MAX_AGGREGATES + 1;
    let many = Err(AggregatesError::TooMany { count });
    assert_eq!(Aggregates::new(&of, count), many);
    let (rest, mut out) = (setup.rest::<Factored>(), of.clone());
    let nodes = of.len();
    assert_eq!(Aggregates::divide(&rest.view(), count, &mut out), many);
    let short = Aggregates::divide(&rest.view(), 2, &mut out[1..]);
    assert_eq!(short, Err(AggregatesError::Length { nodes }));
}

/// A body in a `static` does what one in `Vec`s does.
#[test]
fn fixed_storage_has_a_capacity_for_it() {
    let setup = gravity(Setup::new("cube", box_mesh([0.3, 0.3, 0.3], [3, 3, 3])));
    let settings = setup.solver(Start::Galerkin(1), setup.two_level(8), 3);
    let mut owned: OwnedBody = setup.body(&settings);
    let mesh = Mesh::new(&setup.mesh.nodes, &setup.mesh.tets).unwrap();
    type Fixed = Body<64, { blocks(162) }, 0, 1, Factored, { coarse_length(8) }>;
    let mut fixed = Box::new(Fixed::new());
    fixed.fill(&mesh, &setup.material()).unwrap();
    for _ in 0..5 {
        assert!(owned.step(&setup.scene(&[]), &settings).advanced());
        assert!(fixed.step(&setup.scene(&[]), &settings).advanced());
    }
    assert_eq!(owned.positions(), fixed.positions());
    let mut bare = Box::new(Body::<64, { blocks(162) }>::new());
    bare.fill(&mesh, &setup.material()).unwrap();
    let report = bare.step(&setup.scene(&[]), &settings);
    assert_eq!(report.refusal, Some(Refusal::Coarse));
}

fn gravity(mut setup: Setup) -> Setup {
    setup.gravity = [0.0, -9.81, 0.0];
    setup
}

/// The bar of 1 × 0.25 × 0.25 m, 208 nodes, at E = 1e7.
fn beam() -> Setup {
    let mut setup = gravity(Setup::new("beam", box_mesh([1.0, 0.25, 0.25], [12, 3, 3])));
    setup.young = 1e7;
    setup
}

/// Heights of the last node over a second.
fn run(setup: &Setup, colliders: &[Collider], p: Preconditioner, iterations: u32) -> Vec<f64> {
    let settings = setup.solver(Start::Galerkin(1), p, iterations);
    let mut body: OwnedBody = setup.body(&settings);
    let pins = setup.pin_list();
    let scene = Scene {
        colliders,
        ..setup.scene(&pins)
    };
    let mut step = || {
        assert!(body.step(&scene, &settings).advanced());
        f64::from(body.positions()[setup.x.len() - 1][1])
    };
    (0..150).map(|_| step()).collect()
}

/// Mean distance of two runs over the travel of the second.
fn error(found: &[f64], exact: &[f64], rest: f64) -> f64 {
    let travel = exact.iter().map(|x| (x - rest).abs()).fold(0.0, f64::max);
    let off: f64 = found.iter().zip(exact).map(|(a, b)| (a - b).abs()).sum();
    off / exact.len() as f64 / travel
}

/// Tip of a cantilever, in closed loop.
#[test]
fn a_few_iterations_bend_a_beam() {
    let setup = beam().pinned(|x| x[0] < 1e-6, |_| [0.0; 3]);
    let exact = run(&setup, &[], Preconditioner::Jacobi, 500);
    let two_level = setup.two_level(8);
    // What a prototype in f64 reached when the method was chosen.
    for (iterations, expected) in [(1, 0.13), (2, 0.024), (3, 0.007), (5, 0.001)] {
        let of = |p| error(&run(&setup, &[], p, iterations), &exact, 0.25);
        let (jacobi, found) = (of(Preconditioner::Jacobi), of(two_level));
        println!("cantilever, {iterations} iterations: Jacobi {jacobi:.4}, two-level {found:.4}");
        assert!(found < expected && jacobi > 0.1, "{found}, {jacobi}");
    }
}

/// The same beam falls on a ball: contact comes and goes, and the aggregates do not know.
#[test]
fn a_few_iterations_bounce_a_beam() {
    let setup = beam();
    let ball = Collider::sphere(Vec3::new(0.3, -0.35, 0.1), 0.3).unwrap();
    let colliders = [ball.with_friction(0.5).unwrap()];
    let two_level = setup.two_level(8);
    let exact = run(&setup, &colliders, Preconditioner::Jacobi, 500);
    for iterations in [2, 3, 5, 10] {
        let of = |p| error(&run(&setup, &colliders, p, iterations), &exact, 0.25);
        let (jacobi, found) = (of(Preconditioner::Jacobi), of(two_level));
        println!("on a ball, {iterations} iterations: Jacobi {jacobi:.4}, two-level {found:.4}");
        assert!(found < 0.25 * jacobi, "{found}, {jacobi}");
    }
}
