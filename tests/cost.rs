//! The cost formula as a whole; that its coefficients are right is shown by counts (`examples/firmware/fit check`).

use femto::cost::{Kind, Load, Machine, ROWS, terms};
use femto::glam::Vec3;
use femto::{
    Budget, Collider, Material, Mesh, OwnedBody, Pin, Preconditioner, Scene, Settings, Start,
};

const TET: ([[f32; 3]; 4], [[u32; 4]; 1]) = (
    [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [[0, 1, 2, 3]],
);

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
        ] {
            assert!(
                budget.cost(&more, machine) > budget.cost(&plain, machine),
                "{name}: {more:?}"
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
    let load = Load::of(&body.rest(), &scene, &settings);
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
