//! Full lists, empty ones, bad ones; links; pieces that are alone; lanes and preconditioners.

use femto::coupling::{Couplings, Link};
use femto::detect::MAX_PIECES;
use femto::glam::Vec3;
use femto::join::Assembly;
use femto::lane::Lanes;
use femto::owned::{OwnedBody, OwnedRest, OwnedState, OwnedWorkspace};
use femto::preconditioner::aggregate::Aggregates;
use femto::report::{CouplingFault, Refusal};
use femto::rigid::{Rigid, Shape};
use femto::settings::{Budget, Needs, Preconditioner, Settings, Start};
use femto::step::step_coupled;
use femto::{Collider, Coupling, Mesh, Pin, Scene};
use femto_bake::{FactorOptions, Kind};
use nalgebra::Vector3;
use wide::{f32x4, f32x8};

use super::world::{AXES, World, ball, cube, soft};

const H: f32 = 1.0 / 150.0;

fn settings(iterations: u32) -> Settings<'static> {
    Settings::new(H)
        .unwrap()
        .with_start(Start::Galerkin(1))
        .with_budget(Budget {
            iterations,
            polar_sweeps: 2,
        })
}

fn stacked(young: f32, gap: f32) -> Assembly {
    let mut parts = Assembly::new();
    for y in [0.0, 0.4 + gap] {
        let mesh = cube(0.4, 3, [0.01 * y, y, 0.02 * y]);
        parts
            .soft(&mesh.nodes, &mesh.tets, soft(young), 0.3)
            .unwrap();
    }
    parts
        .rigid(
            ball(0.1),
            5.0,
            Vec3::new(0.2, 0.9 + 2.0 * gap, 0.2),
            AXES,
            0.3,
            &soft(young),
        )
        .unwrap();
    parts
}

#[test]
fn a_full_list_keeps_the_deepest_and_says_so() {
    let settings = settings(5);
    // They overlap by 10 mm, at different depths.
    let depths = |slots: usize| {
        let mut world = World::new(stacked(1e5, -0.01), &settings, slots);
        world.throw(&[
            (Vec3::ZERO, Vec3::new(0.0, 0.0, 0.5)),
            (Vec3::ZERO, Vec3::ZERO),
            (-Vec3::Y, Vec3::ZERO),
        ]);
        let report = world.step(&Scene::default(), &settings);
        assert!(report.advanced());
        let found = world.slots.iter().filter(|slot| slot.normal() != [0.0; 3]);
        let v: Vec<f32> = found.map(|slot| slot.gap()).collect();
        (v, report.dropped)
    };
    let (mut all, dropped) = depths(256);
    assert!(all.len() >= 18 && dropped == 0, "{}", all.len());
    all.sort_by(f32::total_cmp);
    let (mut kept, dropped) = depths(12);
    kept.sort_by(f32::total_cmp);
    assert_eq!((kept.len(), dropped as usize), (12, all.len() - 12));
    // By the depth at the end of the step; they all move alike to a millimetre.
    for (kept, all) in kept.iter().zip(&all) {
        assert!((kept - all).abs() < 5e-3, "{kept} {all}");
    }
    assert!(kept[11] < all[all.len() - 1] - 1e-3);
    let (none, dropped) = depths(0);
    assert_eq!((none.len(), dropped as usize), (0, all.len()));
}

#[test]
fn bad_couplings_are_refused_and_change_nothing() {
    let good = settings(5);
    let mut world = World::new(stacked(1e5, 0.1), &good, 16);
    let state = world.body.state().clone();
    let pinned = [Pin::held(world.parts.parts[2].nodes.start as u32)];
    let is =
        |world: &mut World, settings: &Settings<'_>, scene: &Scene<'_>, fault: CouplingFault| {
            let report = world.step(scene, settings);
            assert_eq!(report.refusal, Some(Refusal::Coupling(fault)));
            assert_eq!(*world.body.state(), state);
        };
    let none = Scene::default();
    is(
        &mut world,
        &good.with_theta(0.5).unwrap(),
        &none,
        CouplingFault::Theta,
    );
    is(
        &mut world,
        &good,
        &Scene {
            pins: &pinned,
            ..none
        },
        CouplingFault::Pinned,
    );
    world.links = vec![Link::nodes(0, 100_000)];
    is(&mut world, &good, &none, CouplingFault::Link);
    world.links = vec![Link::nodes(0, 1); 17];
    is(&mut world, &good, &none, CouplingFault::Slots);
    world.links.clear();
    let rigids = world.rigids.clone();
    world.rigids = vec![Rigid::new(3, Shape::Ball { radius: 0.1 }, 0.0)];
    is(&mut world, &good, &none, CouplingFault::Rigid);
    world.rigids.clear();
    // The ball's nodes belong to no piece.
    is(&mut world, &good, &none, CouplingFault::Piece);
    world.rigids = rigids;
    let pieces = world.parts.pieces();
    let many = vec![pieces[0]; MAX_PIECES + 1];
    for bad in [&pieces[..1], &many, &[pieces[1], pieces[0]]] {
        let mut couplings = Couplings::new(bad, &mut world.rigids, &[], &mut world.slots);
        let report = world.body.step_coupled(&none, &good, &mut couplings);
        assert_eq!(
            report.refusal,
            Some(Refusal::Coupling(CouplingFault::Piece))
        );
    }
    assert!(world.step(&none, &good).advanced());
}

#[test]
fn empty_slots_change_no_bit() {
    let settings = settings(5);
    let motions = [(Vec3::X, Vec3::Y), (Vec3::Y, Vec3::Z), (Vec3::Z, Vec3::X)];
    let scene = Scene {
        gravity: Vec3::new(0.0, -9.81, 0.0),
        ..Scene::default()
    };
    let run = |slots: usize, steps: usize| {
        let mut world = World::new(stacked(1e5, 0.01), &settings, slots);
        world.throw(&motions);
        let mut contacts = 0;
        for _ in 0..steps {
            contacts += world.step(&scene, &settings).couplings;
        }
        (world.body.state().clone(), contacts)
    };
    // How many slots are left over does not matter, touching or not.
    let (state, contacts) = run(128, 40);
    assert!(contacts > 0);
    assert!(run(200, 40) == (state, contacts));

    // Pieces that touch nothing: the bits of a step without couplings. (A start with W gives each piece its own
    // translations, which a step without couplings does not know of.)
    for start in [Start::Zero, Start::Velocity, Start::VelocityForce] {
        let settings = settings.with_start(start);
        let mut parts = Assembly::new();
        for x in [0.0, 1.0] {
            let mesh = cube(0.4, 3, [x, 0.0, 0.0]);
            parts.soft(&mesh.nodes, &mesh.tets, soft(1e5), 0.3).unwrap();
        }
        let mut world = World::new(parts, &settings, 32);
        world.throw(&motions[..2]);
        let mut alone: OwnedBody = World::new(world.parts.clone(), &settings, 0).body;
        alone
            .place(world.body.positions(), world.body.velocities())
            .unwrap();
        let ground = [Collider::half_space(Vec3::Y, -0.5)
            .unwrap()
            .with_friction(0.4)
            .unwrap()];
        for step in 0..60 {
            let scene = Scene {
                colliders: &ground,
                ..scene
            };
            assert!(world.step(&scene, &settings).advanced());
            assert!(alone.step(&scene, &settings).advanced());
            assert!(
                world.body.state() == alone.state(),
                "{start:?}, step {step}"
            );
        }
    }
}

#[test]
fn a_piece_that_is_alone_flies_as_if_it_were() {
    // A very stiff cube flies, while another lies on the ground: no iteration count may mix them.
    for iterations in [0, 1, 2, 5] {
        let settings = settings(iterations);
        let mut parts = Assembly::new();
        for at in [[0.0, 0.001, 0.0], [5.0, 50.0, 0.0]] {
            let mesh = cube(0.4, 3, at);
            parts.soft(&mesh.nodes, &mesh.tets, soft(1e8), 0.3).unwrap();
        }
        let mut world = World::new(parts, &settings, 32);
        let start = world.centre_of(1);
        world.throw(&[
            (Vec3::ZERO, Vec3::ZERO),
            (Vec3::new(0.5, 2.0, 0.0), Vec3::ZERO),
        ]);
        let ground = [Collider::half_space(Vec3::Y, 0.0).unwrap()];
        let scene = Scene {
            gravity: Vec3::new(0.0, -9.81, 0.0),
            colliders: &ground,
            ..Scene::default()
        };
        for _ in 0..150 {
            assert!(world.step(&scene, &settings).advanced());
        }
        // Σ h v_k with v_k = v_0 + k h g
        let fall = 2.0 - 9.81 * 0.5 * (1.0 + 1.0 / 150.0);
        let error = (world.centre_of(1) - start - Vector3::new(0.5, fall, 0.0)).norm();
        // Coordinates of 50 m, rounded at ε/2 a step, on one side at worst.
        assert!(
            error < 150.0 * 50.0 * f64::from(f32::EPSILON),
            "{iterations}: {error:e}"
        );
        assert!((world.velocity_of(1).y - (2.0 - 9.81)).abs() < 1e-4);
    }
}

#[test]
fn every_preconditioner_finds_the_same_step() {
    let converged = settings(400);
    let motions = [
        (Vec3::Y, Vec3::ZERO),
        (-Vec3::Y, Vec3::Z),
        (-Vec3::Y, Vec3::X),
    ];
    let run = |settings: &Settings<'_>| {
        let mut world = World::new(stacked(2e5, 0.005), settings, 128);
        world.throw(&motions);
        let mut touched = 0;
        for _ in 0..3 {
            let report = world.step(&Scene::default(), settings);
            assert!(report.advanced(), "{report:?}");
            touched += report.couplings;
        }
        assert!(touched > 20);
        world.body.velocities().to_vec()
    };
    let expected = run(&converged);
    let parts = stacked(2e5, 0.005);
    let mesh = Mesh::new(&parts.nodes, &parts.tets).unwrap();
    let rest: OwnedRest = OwnedRest::new(&mesh, &parts.materials[..]).unwrap();
    let factor = |kind| {
        let options = FactorOptions {
            kind,
            ..FactorOptions::default()
        };
        femto_bake::factor(&rest.view(), &converged, &options).unwrap()
    };
    let (warped, laplacian) = (factor(Kind::Warped), factor(Kind::Laplacian));
    let (warped, laplacian) = (warped.view(), laplacian.view());
    let mut of = vec![0; parts.nodes.len()];
    Aggregates::divide(&rest.view(), 6, &mut of).unwrap();
    let aggregates = Aggregates::new(&of, 6).unwrap();
    for preconditioner in [
        Preconditioner::Identity,
        Preconditioner::Mass,
        Preconditioner::BlockJacobi,
        Preconditioner::TwoLevel(aggregates),
        Preconditioner::Factored(&warped),
        Preconditioner::Factored(&laplacian),
    ] {
        let found = run(&converged.with_preconditioner(preconditioner));
        for (found, expected) in found.iter().zip(&expected) {
            for axis in 0..3 {
                // Of 1 m/s; each of three steps is solved to 2e-4, as against the oracle.
                assert!(
                    (found[axis] - expected[axis]).abs() < 1e-3,
                    "{preconditioner:?}"
                );
            }
        }
    }
}

#[test]
fn lanes_have_the_same_bits() {
    fn run<R: Lanes>() -> OwnedState {
        let settings = settings(5);
        let parts = stacked(1e5, 0.01);
        let mesh = Mesh::new(&parts.nodes, &parts.tets).unwrap();
        let rest: OwnedRest = OwnedRest::new(&mesh, &parts.materials[..]).unwrap();
        let rest = rest.view();
        let mut state = OwnedState::new(&rest, Needs::from(&settings));
        let mut work = OwnedWorkspace::new(&rest, Needs::from(&settings));
        let (pieces, mut rigids) = (parts.pieces(), parts.rigids());
        let mut slots = vec![Coupling::EMPTY; 64];
        let scene = Scene {
            gravity: Vec3::new(1.0, -9.81, 0.0),
            ..Scene::default()
        };
        let v: Vec<[f32; 3]> = rest.nodes.iter().map(|x| [0.0, 1.0 - x[1], 0.0]).collect();
        state.view_mut().place(&rest, rest.nodes, &v).unwrap();
        let mut contacts = 0;
        for _ in 0..30 {
            let mut couplings = Couplings::new(&pieces, &mut rigids, &[], &mut slots);
            let report = step_coupled::<R, _>(
                &rest,
                &mut state.view_mut(),
                &mut work.view_mut(&rest),
                &scene,
                &settings,
                &mut couplings,
            );
            assert!(report.advanced());
            contacts += report.couplings;
        }
        assert!(contacts > 50, "{contacts}");
        state
    }
    let one = run::<f32>();
    assert!(one == run::<f32x4>());
    assert!(one == run::<f32x8>());
}

#[test]
fn links_hold_and_springs_draw() {
    let settings = settings(20);
    // A hard chain of a held cube, a cube and a ball under gravity.
    let mut parts = Assembly::new();
    for y in [0.0, -0.5] {
        let mesh = cube(0.4, 2, [0.0, y, 0.0]);
        parts
            .soft(
                &mesh.nodes,
                &mesh.tets,
                soft(1e6).with_damping(2.0, 0.0).unwrap(),
                0.3,
            )
            .unwrap();
    }
    let centre = Vec3::new(0.2, -0.8, 0.2);
    parts
        .rigid(
            ball(0.1),
            5.0,
            centre,
            AXES,
            0.3,
            &soft(1e6).with_damping(2.0, 0.0).unwrap(),
        )
        .unwrap();
    let mut world = World::new(parts, &settings, 64);
    // The middles of the lower and the upper faces, 0.1 m apart; and the ball's top, a weight of 5 kg.
    let (below, above, under) = (10, 27 + 16, 27 + 10);
    let top = Link::point_of(
        &world.rigids[0],
        world.body.positions(),
        centre + Vec3::Y * 0.1,
    );
    world.links = vec![Link::nodes(below, above), Link::points([(under, 1.0)], top)];
    let pins: Vec<Pin> = (0..27)
        .filter(|&i| world.parts.nodes[i as usize][1] > 0.39)
        .map(Pin::held)
        .collect();
    let scene = Scene {
        gravity: Vec3::new(0.0, -9.81, 0.0),
        pins: &pins,
        ..Scene::default()
    };
    for _ in 0..900 {
        assert!(world.step(&scene, &settings).advanced());
    }
    for (link, weight) in world.slots.iter().zip([69.0, 5.0]) {
        // At rest it bears what hangs on it: impulse h m g.
        let expected = weight * 9.81 / 150.0;
        let found = f64::from(link.impulse()[1]);
        assert!(
            (found.abs() / expected - 1.0).abs() < 0.02,
            "{found} {expected}"
        );
    }
    let x = world.body.positions();
    let apart = Vec3::from_array(x[below as usize]) - Vec3::from_array(x[above as usize]);
    assert!(apart.length() < 1e-3, "{apart}");

    // A spring of k draws a free ball to a target that moves, with the damping c at its heels.
    let mut parts = Assembly::new();
    parts
        .rigid(ball(0.1), 2.0, Vec3::ZERO, AXES, 0.3, &soft(1e6))
        .unwrap();
    let mut world = World::new(parts, &settings, 4);
    let x = world.body.positions().to_vec();
    let at = Link::point_of(&world.rigids[0], &x, Vec3::ZERO);
    let velocity = Vec3::new(0.3, 0.0, 0.0);
    for step in 0..1500 {
        let target = Vec3::Y + velocity * (step as f32 * H);
        world.links = vec![Link::to_target(at, target, velocity).soft(200.0, 40.0)];
        assert!(world.step(&Scene::default(), &settings).advanced());
    }
    assert!((world.velocity_of(0) - Vector3::new(0.3, 0.0, 0.0)).norm() < 1e-3);
    let expected = Vector3::new(0.3 * 10.0, 1.0, 0.0);
    assert!(
        (world.centre_of(0) - expected).norm() < 2e-3,
        "{}",
        world.centre_of(0)
    );
}

#[test]
fn fast_balls_are_caught_up_to_a_speed() {
    // A cell of the block is 0.1 m, a length unit 1/32 m, and a step at 40 m/s 0.27 m; the block is 0.4 m thick.
    for speed in [1.0, 5.0, 10.0, 20.0, 40.0] {
        let settings = settings(10);
        let mut parts = Assembly::new();
        let mesh = cube(0.4, 4, [0.0; 3]);
        parts.soft(&mesh.nodes, &mesh.tets, soft(1e6), 0.3).unwrap();
        let centre = Vec3::new(0.21, 1.0, 0.19);
        parts
            .rigid(ball(0.1), 1.0, centre, AXES, 0.3, &soft(1e6))
            .unwrap();
        let mut world = World::new(parts, &settings, 128);
        world.throw(&[(Vec3::ZERO, Vec3::ZERO), (Vec3::NEG_Y * speed, Vec3::ZERO)]);
        let before = world.linear();
        for _ in 0..(150.0 / speed) as usize + 30 {
            assert!(world.step(&Scene::default(), &settings).advanced());
        }
        assert!((world.linear() - before).norm() < 1e-5 * before.norm());
        // It is still outside, and the block (64 kg) moves with it, or it has bounced.
        let (ball, block) = (world.centre_of(1).y, world.centre_of(0).y);
        assert!(ball - block > 0.25, "{speed}: {ball} {block}");
        assert!(world.velocity_of(0).y < -0.9 * f64::from(speed) / 65.0);
    }
}
