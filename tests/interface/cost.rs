//! The cost formula as a whole; that its coefficients are right is shown by counts (`examples/firmware/fit check`).

use femto::collider::{Capsule, Cuboid, HeightField, Placed, SignedDistance};
use femto::cost::{Coarse, Coupled, Kind, Load, Machine, ROWS, Search, Shapes, terms};
use femto::coupling::{Link, Piece};
use femto::glam::Vec3;
use femto::order::fans;
use femto::preconditioner::Aggregates;
use femto::rigid::{Rigid, Shape};
use femto::{
    Budget, Collider, Coupling, Couplings, Fracture, Frame, Material, Mesh, OwnedBody, Pin,
    Plasticity, Preconditioner, Scene, Settings, Start,
};

const TET: ([[f32; 3]; 4], [[u32; 4]; 1]) = (
    [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [[0, 1, 2, 3]],
);

const COARSE: Coarse = Coarse {
    aggregates: 8,
    cut_blocks: 30,
    products: 90,
    sums: 240,
};

#[test]
fn fit_gives_the_largest_budget_within_a_limit() {
    for (_, machine) in Machine::ALL {
        for load in [Load::new(64, 162), Load::new(208, 648), Load::new(4, 1)] {
            for step in 1..200_u64 {
                let limit = step * step * 997;
                let Some(budget) = Budget::fit(limit, &load, machine) else {
                    let least = Budget {
                        iterations: 1,
                        polar_sweeps: 1,
                    };
                    assert!(least.cost(&load, machine) > limit);
                    continue;
                };
                let more = Budget {
                    iterations: budget.iterations + 1,
                    ..budget
                };
                assert!(budget.iterations > 0 && budget.cost(&load, machine) <= limit);
                // Costs are rounded down to whole instructions.
                assert!(more.cost(&load, machine) >= limit, "{budget:?} at {limit}");
            }
            let least = Budget {
                iterations: 1,
                polar_sweeps: 1,
            };
            let limit = least.cost(&load, machine) + 1;
            assert_eq!(Budget::fit(limit, &load, machine), Some(least));
        }
    }
}

#[test]
fn every_part_of_a_scene_costs() {
    for (name, machine) in Machine::ALL {
        let budget = Budget::default();
        let plain = Load::new(100, 400);
        for more in [
            Load {
                nodes: 120,
                ..plain
            },
            Load { tets: 500, ..plain },
            Load {
                colliders: 1,
                ..plain
            },
            Load {
                moving: true,
                ..plain
            },
            Load {
                forces: true,
                ..plain
            },
            Load {
                newmark: true,
                ..plain
            },
            Load {
                start: Start::Galerkin(2),
                ..plain
            },
            Load {
                start: Start::Rigid(1),
                ..plain
            },
            Load {
                preconditioner: Kind::BlockJacobi,
                ..plain
            },
            Load {
                preconditioner: Kind::Warped,
                entries: 600,
                ..plain
            },
            Load {
                preconditioner: Kind::TwoLevel,
                coarse: COARSE,
                ..plain
            },
        ] {
            assert!(
                budget.cost(&more, machine) > budget.cost(&plain, machine),
                "{name}: {more:?}"
            );
        }
        // What fans share is saved: a load without a count of them is the most it can be.
        assert_eq!(plain.fans, 50);
        let ordered = Load { fans: 10, ..plain };
        assert!(
            budget.cost(&ordered, machine) < budget.cost(&plain, machine),
            "{name}"
        );
        let two_level = Load {
            preconditioner: Kind::TwoLevel,
            coarse: COARSE,
            ..plain
        };
        for coarse in [
            Coarse {
                aggregates: 9,
                ..COARSE
            },
            Coarse {
                cut_blocks: 31,
                ..COARSE
            },
            Coarse {
                products: 91,
                ..COARSE
            },
            Coarse {
                sums: 241,
                ..COARSE
            },
        ] {
            let more = Load {
                coarse,
                ..two_level
            };
            assert!(
                budget.cost(&more, machine) > budget.cost(&two_level, machine),
                "{name}: {coarse:?}"
            );
        }
        let huge = Load::new(usize::MAX, usize::MAX);
        assert!(budget.cost(&huge, machine) > 1 << 50);
    }
    // One row for the preparation and one for the iterations of the preconditioner in use, and of no other.
    let rows = terms(&Load::new(10, 10), Budget::default());
    let own = ROWS
        .iter()
        .zip(rows)
        .filter(|((name, _), often)| name.contains(':') && *often > 0);
    assert_eq!(
        own.map(|((name, _), _)| *name).collect::<Vec<_>>(),
        ["jacobi: step", "jacobi: iteration"]
    );
}

#[test]
fn what_features_add_costs() {
    let shapes = Shapes::default();
    let coupled = Coupled {
        pieces: 2,
        rigids: 1,
        links: 3,
        slots: 40,
    };
    let plain = Load {
        colliders: 1,
        ..Load::new(100, 400)
    };
    let joined = Load { coupled, ..plain };
    let shaped = |shapes| Load { shapes, ..plain };
    let with = |coupled| Load { coupled, ..plain };
    let more = [
        (
            plain,
            shaped(Shapes {
                capsules: 1,
                ..shapes
            }),
        ),
        (plain, shaped(Shapes { boxes: 1, ..shapes })),
        (
            plain,
            shaped(Shapes {
                height_fields: 1,
                ..shapes
            }),
        ),
        (
            plain,
            shaped(Shapes {
                placed: 1,
                ..shapes
            }),
        ),
        (
            plain,
            Load {
                flows: true,
                ..plain
            },
        ),
        (
            plain,
            Load {
                guarded: true,
                ..plain
            },
        ),
        (
            joined,
            Load {
                guarded: true,
                ..joined
            },
        ),
        (plain, Load { tears: 1, ..plain }),
        (Load { tears: 1, ..plain }, Load { tears: 9, ..plain }),
        (plain, joined),
        (
            joined,
            with(Coupled {
                pieces: 3,
                ..coupled
            }),
        ),
        (
            joined,
            with(Coupled {
                rigids: 2,
                ..coupled
            }),
        ),
        (
            joined,
            with(Coupled {
                slots: 41,
                ..coupled
            }),
        ),
    ];
    for (name, machine) in Machine::ALL {
        for (less, more) in more {
            let [less, more_cost] = [less, more].map(|load| Budget::default().cost(&load, machine));
            assert!(more_cost > less, "{name}: {more:?}");
        }
    }
}

#[test]
fn the_load_of_what_features_add() {
    let mesh = Mesh::new(&TET.0, &TET.1).unwrap();
    let material = Material::new(1e5, 0.3, 1000.0).unwrap();
    let body: OwnedBody = OwnedBody::new(&mesh, &material, Start::Zero).unwrap();
    let ball = Capsule::new(Vec3::ZERO, Vec3::X, 0.1).unwrap();
    let slab = Placed::new(Cuboid::new(Vec3::ZERO, Vec3::ONE).unwrap(), Frame::WORLD);
    let field = HeightField::new(&[0.0; 4], [2, 2], [1.0; 2]).unwrap();
    let own = |x: Vec3| (x.y, Vec3::Y);
    let shapes: [&dyn SignedDistance; 4] = [&ball, &slab, &field, &own];
    let mut colliders = shapes.map(Collider::shape).to_vec();
    colliders.push(Collider::sphere(Vec3::ZERO, 1.0).unwrap());
    let scene = Scene {
        colliders: &colliders,
        ..Scene::default()
    };
    let settings = Settings::new(0.01)
        .unwrap()
        .with_plasticity(Plasticity::new(0.1, 1.0).unwrap())
        .with_fracture(Fracture::new(1e5, 3, 9).unwrap());
    let load = Load::of(&body.rest(), &scene, &settings);
    let one = Shapes {
        spheres: 1,
        capsules: 1,
        boxes: 1,
        height_fields: 1,
        placed: 1,
        others: 1,
    };
    assert_eq!((load.shapes, load.flows, load.tears), (one, true, 3));
    assert_eq!(load.coupled, Coupled::default());

    // Two pieces of four surface nodes and four triangles each, a ball and a box; two colliders.
    let piece = |range, nodes| Piece {
        range,
        triangles: &[[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]],
        tets: &[],
        edges: &[],
        nodes,
        friction: 0.0,
    };
    let pieces = [piece((0, 4), &[0, 1, 2, 3]), piece((4, 8), &[4, 5, 6, 7])];
    let half = Vec3::splat(0.1);
    let mut rigids = [
        Rigid::new(8, Shape::Ball { radius: 0.1 }, 0.0),
        Rigid::new(12, Shape::Cuboid { half }, 0.0),
    ];
    let mut slots = [Coupling::EMPTY; 9];
    let links = [Link::nodes(0, 4)];
    let couplings = Couplings::new(&pieces, &mut rigids, &links, &mut slots);
    let coupled = Coupled {
        pieces: 2,
        rigids: 2,
        links: 1,
        slots: 9,
    };
    assert_eq!(load.with_couplings(&couplings).coupled, coupled);
    let search = Search::of(&couplings, 2);
    // Node against piece, twice four; nodes and own points against rigid bodies; the boxes' pair; colliders.
    let points = 8 + 2 * (4 + 1) + 2 * (4 + 8) + 16 + 2 * (1 + 8);
    let expected = Search {
        nodes: 8 + 8,
        pairs: 6,
        points,
        looks: 6 * (4 * 4 * 2) + 2 * 8 + 8 * (4 + 4) + 50 * (4 + 4),
        contacts: points,
        slots: 8,
    };
    assert_eq!(search, expected);
    let fewer = Search { looks: 0, ..search };
    assert!(search.most() > fewer.most());
}

#[test]
fn the_load_of_a_step() {
    let mesh = Mesh::new(&TET.0, &TET.1).unwrap();
    let material = Material::new(1e5, 0.3, 1000.0).unwrap();
    let body: OwnedBody = OwnedBody::new(&mesh, &material, Start::Rigid(2)).unwrap();
    let moving = Collider::half_space(Vec3::Y, -1.0)
        .unwrap()
        .with_velocity(Vec3::X)
        .unwrap();
    let scene = Scene {
        forces: &[[0.0; 3]; 4],
        pins: &[Pin::held(1), Pin::held(2)],
        colliders: &[moving],
        ..Scene::default()
    };
    let settings = Settings::new(0.01)
        .and_then(|settings| settings.with_theta(0.5))
        .unwrap()
        .with_start(Start::Rigid(2))
        .with_preconditioner(Preconditioner::Mass);
    // The guard does not act where something moves or θ < 1; beside that it does.
    let load = Load::of(&body.rest(), &scene, &settings.with_energy_guard());
    let resting = [Collider::half_space(Vec3::Y, 0.0).unwrap()];
    let rests = Scene {
        colliders: &resting,
        ..scene
    };
    let guarded = |theta, scene: &Scene<'_>| {
        let settings = Settings::new(0.01).and_then(|settings| settings.with_theta(theta));
        let settings = settings.unwrap().with_energy_guard();
        Load::of(&body.rest(), scene, &settings).guarded
    };
    let empty = Scene::default();
    let [acts, moved, newmark, free] = [
        guarded(1.0, &rests),
        guarded(1.0, &scene),
        guarded(0.5, &rests),
        guarded(1.0, &empty),
    ];
    assert_eq!([acts, moved, newmark, free], [true, false, false, false]);
    let expected = Load {
        start: Start::Rigid(2),
        preconditioner: Kind::Mass,
        pins: 2,
        colliders: 1,
        moving: true,
        forces: true,
        newmark: true,
        ..Load::new(4, 1)
    };
    assert_eq!(load, expected);
    assert_eq!(Budget::fit(1, &load, Machine::CortexM4F), None);
}

#[test]
fn the_load_of_fans_and_aggregates() {
    // Eight rings of four tetrahedra, each around an edge of its own.
    let (mut nodes, mut tets) = (Vec::new(), Vec::new());
    for ring in 0..8_u32 {
        let x = 4.0 * ring as f32;
        let first = 6 * ring;
        nodes.extend([[x, 0.0, 0.0], [x, 0.0, 1.0]]);
        nodes.extend([
            [x + 1.0, 0.0, 0.5],
            [x, 1.0, 0.5],
            [x - 1.0, 0.0, 0.5],
            [x, -1.0, 0.5],
        ]);
        for k in 0..4 {
            tets.push([first, first + 1, first + 2 + k, first + 2 + (k + 1) % 4]);
        }
    }
    let material = Material::new(1e5, 0.3, 1000.0).unwrap();
    let load = |tets: &[[u32; 4]], of: Option<&[u8]>| {
        let mesh = Mesh::new(&nodes, tets).unwrap();
        let body: OwnedBody = OwnedBody::new(&mesh, &material, Start::Zero).unwrap();
        let settings = Settings::new(0.01).unwrap();
        let settings = match of {
            Some(of) => {
                let aggregates = Aggregates::new(of, 3).unwrap();
                settings.with_preconditioner(Preconditioner::TwoLevel(aggregates))
            }
            None => settings,
        };
        Load::of(&body.rest(), &Scene::default(), &settings)
    };
    // As listed, a block is two rings; in fans, all eight side by side.
    assert_eq!(load(&tets, None).fans, 4);
    let ordered = fans(&tets).tets;
    assert_eq!(load(&ordered, None).fans, 1);
    assert_eq!(load(&ordered, None).coarse, Coarse::default());
    // The first ring's ends are aggregate 0, its first two other nodes 1, the others 2; what is left is 2, too.
    let mut of = vec![2; nodes.len()];
    of[..4].copy_from_slice(&[0, 0, 1, 1]);
    let expected = Coarse {
        aggregates: 3,
        // The first ring is half a block: one tetrahedron of {0, 1}, two of {0, 1, 2}, one of {0, 2}.
        cut_blocks: 1,
        products: 6,
        sums: 3 + 6 + 6 + 3,
    };
    assert_eq!(load(&tets, Some(&of)).coarse, expected);
}
