//! Every malformed mesh, material, setting and collider gets the error that names it.

use femto::body::StateError;
use femto::collider::{Collider, ColliderError};
use femto::glam::Vec3;
use femto::material::{Material, MaterialError};
use femto::mesh::{Mesh, MeshError, problems};
use femto::owned::OwnedBody;
use femto::settings::{Settings, SettingsError, Start};

const NODES: [[f32; 3]; 5] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
];
const TETS: [[u32; 4]; 2] = [[0, 1, 2, 3], [1, 2, 3, 4]];

fn with_node(node: usize, x: [f32; 3]) -> Vec<[f32; 3]> {
    let mut nodes = NODES.to_vec();
    nodes[node] = x;
    nodes
}

#[test]
fn meshes() {
    assert!(Mesh::new(&NODES, &TETS).is_ok());
    let flat = with_node(3, [0.5, 0.5, 0.0]);
    let tiny: Vec<_> = NODES.iter().map(|x| x.map(|c| c * 1e-14)).collect();
    type Case<'a> = (&'a [[f32; 3]], &'a [[u32; 4]], MeshError);
    let cases: [Case; 15] = [
        (&[], &[], MeshError::Empty),
        (&NODES, &[], MeshError::Empty),
        (&[], &TETS, MeshError::Empty),
        (
            &with_node(4, [f32::NAN, 0.0, 0.0]),
            &TETS,
            MeshError::NonFiniteNode { node: 4 },
        ),
        (
            &with_node(2, [0.0, f32::INFINITY, 0.0]),
            &TETS,
            MeshError::NonFiniteNode { node: 2 },
        ),
        (
            &with_node(0, [0.0, 0.0, f32::NEG_INFINITY]),
            &TETS,
            MeshError::NonFiniteNode { node: 0 },
        ),
        (
            &NODES,
            &[TETS[0], [1, 2, 3, 5]],
            MeshError::NodeOutOfRange { tet: 1, node: 5 },
        ),
        (
            &NODES,
            &[[0, 1, 2, u32::MAX], TETS[1]],
            MeshError::NodeOutOfRange {
                tet: 0,
                node: u32::MAX,
            },
        ),
        (
            &NODES,
            &[TETS[0], [1, 4, 3, 1]],
            MeshError::RepeatedNode { tet: 1, node: 1 },
        ),
        (
            &NODES,
            &[[3, 1, 2, 2], TETS[1]],
            MeshError::RepeatedNode { tet: 0, node: 2 },
        ),
        (
            &NODES,
            &[TETS[0], [2, 1, 3, 4]],
            MeshError::BadVolume { tet: 1 },
        ),
        (&flat, &TETS, MeshError::BadVolume { tet: 0 }),
        (&tiny, &TETS, MeshError::BadVolume { tet: 0 }),
        (&NODES, &TETS[..1], MeshError::UnreferencedNode { node: 4 }),
        (&NODES, &TETS[1..], MeshError::UnreferencedNode { node: 0 }),
    ];
    for (nodes, tets, error) in cases {
        assert_eq!(Mesh::new(nodes, tets).err(), Some(error));
    }
}

#[test]
fn all_problems_of_a_mesh_are_listed() {
    let mut found = Vec::new();
    let nodes = with_node(4, [f32::NAN, 0.0, 0.0]);
    problems(&nodes, &[[0, 1, 2, 9], [1, 1, 2, 3], [1, 0, 2, 3]], |p| {
        found.push(p)
    });
    assert_eq!(
        found,
        [
            MeshError::NonFiniteNode { node: 4 },
            MeshError::NodeOutOfRange { tet: 0, node: 9 },
            MeshError::RepeatedNode { tet: 1, node: 1 },
            MeshError::BadVolume { tet: 2 },
            MeshError::UnreferencedNode { node: 4 },
        ]
    );
}

/// Nodes without a tetrahedron are found across the windows in which they are looked for.
#[test]
fn unreferenced_nodes_of_a_large_mesh() {
    let mut nodes = Vec::new();
    let mut tets = Vec::new();
    for i in 0..1500_u32 {
        let at = |x: [f32; 3]| [x[0] + 2.0 * i as f32, x[1], x[2]];
        nodes.extend(NODES[..4].iter().map(|x| at(*x)));
        tets.push([4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3]);
    }
    assert!(Mesh::new(&nodes, &tets).is_ok());
    let mut found = Vec::new();
    tets.remove(1100);
    tets.remove(511);
    nodes.push([0.0; 3]);
    problems(&nodes, &tets, |p| found.push(p));
    let expected = (2044..2048).chain(4400..4404).chain(6000..6001);
    assert_eq!(
        found,
        expected
            .map(|node| MeshError::UnreferencedNode { node })
            .collect::<Vec<_>>()
    );
}

#[test]
fn materials() {
    assert!(
        Material::new(1e6, 0.4, 1000.0)
            .unwrap()
            .with_damping(0.0, 0.0)
            .is_ok()
    );
    for young in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(
            matches!(Material::new(young, 0.3, 1.0), Err(MaterialError::Young(_))),
            "{young}"
        );
    }
    for poisson in [0.5, 0.6, -1.0, -2.0, f32::NAN, f32::INFINITY] {
        assert!(
            matches!(
                Material::new(1.0, poisson, 1.0),
                Err(MaterialError::Poisson(_))
            ),
            "{poisson}"
        );
    }
    assert!(Material::new(1.0, 0.499_999, 1.0).is_ok() && Material::new(1.0, -0.999, 1.0).is_ok());
    for density in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(
            matches!(
                Material::new(1.0, 0.3, density),
                Err(MaterialError::Density(_))
            ),
            "{density}"
        );
    }
    let material = Material::new(1.0, 0.3, 1.0).unwrap();
    for bad in [-1e-9, f32::NAN, f32::INFINITY] {
        assert!(
            matches!(
                material.with_damping(bad, 0.0),
                Err(MaterialError::Alpha(_))
            ),
            "{bad}"
        );
        assert!(
            matches!(material.with_damping(0.0, bad), Err(MaterialError::Beta(_))),
            "{bad}"
        );
    }
    assert_eq!(
        Material::new(1.0, 0.5, 1.0).unwrap_err().to_string(),
        "Poisson's ratio 0.5 must be above -1 and below 0.5"
    );
}

#[test]
fn settings() {
    for dt in [0.0, -0.01, f32::NAN, f32::INFINITY, 1e-40] {
        assert!(
            matches!(Settings::new(dt), Err(SettingsError::Dt(_))),
            "{dt}"
        );
    }
    let settings = Settings::new(0.01).unwrap();
    for theta in [0.499, 1.001, -1.0, f32::NAN] {
        assert!(
            matches!(settings.with_theta(theta), Err(SettingsError::Theta(_))),
            "{theta}"
        );
    }
    assert!(settings.with_theta(0.5).is_ok() && settings.with_theta(1.0).is_ok());
}

#[test]
fn colliders() {
    for normal in [Vec3::ZERO, Vec3::NAN, Vec3::splat(f32::INFINITY)] {
        assert_eq!(
            Collider::half_space(normal, 0.0),
            Err(ColliderError::Normal),
            "{normal}"
        );
    }
    assert_eq!(
        Collider::half_space(Vec3::Y, f32::NAN),
        Err(ColliderError::Place)
    );
    assert_eq!(Collider::sphere(Vec3::NAN, 1.0), Err(ColliderError::Place));
    for radius in [0.0, -1.0, 1e20, f32::NAN, f32::INFINITY] {
        assert_eq!(
            Collider::sphere(Vec3::ZERO, radius),
            Err(ColliderError::Radius),
            "{radius}"
        );
    }
    let plane = Collider::half_space(Vec3::new(0.0, 2.0, 0.0), 1.0).unwrap();
    assert_eq!(plane.distance(Vec3::new(5.0, 3.0, 0.0)), (2.0, Vec3::Y));
    for friction in [-0.1, f32::NAN, f32::INFINITY] {
        assert_eq!(
            plane.with_friction(friction),
            Err(ColliderError::Friction),
            "{friction}"
        );
    }
    assert_eq!(plane.with_velocity(Vec3::NAN), Err(ColliderError::Velocity));
}

#[test]
fn placing() {
    let mesh = Mesh::new(&NODES, &TETS).unwrap();
    let material = Material::new(1e6, 0.3, 1000.0).unwrap();
    let mut body: OwnedBody = OwnedBody::new(&mesh, &material, Start::default()).unwrap();
    let before = body.state().clone();
    let bad = with_node(3, [0.0, f32::NAN, 0.0]);
    assert_eq!(
        body.place(&NODES[..4], &NODES),
        Err(StateError::Length { given: 4, nodes: 5 })
    );
    assert_eq!(
        body.place(&NODES, &NODES[..1]),
        Err(StateError::Length { given: 1, nodes: 5 })
    );
    assert_eq!(
        body.place(&bad, &NODES),
        Err(StateError::NonFinite { node: 3 })
    );
    assert_eq!(
        body.place(&NODES, &bad),
        Err(StateError::NonFinite { node: 3 })
    );
    assert_eq!(*body.state(), before);
}

/// Found by fuzzing: squares that vanish or overflow on the way to a unit normal.
#[test]
fn normals_are_unit_length_at_any_scale() {
    for size in [1e-35, 1e-20, 1.0, 1e20, 1e38] {
        let plane = Collider::half_space(Vec3::new(size, -size, 0.5 * size), 0.0).unwrap();
        let (_, n) = plane.distance(Vec3::ZERO);
        assert!(
            (n.length() - 1.0).abs() < 4.0 * f32::EPSILON,
            "{size:e}: {n}"
        );
        let ball = Collider::sphere(Vec3::ZERO, 1.0).unwrap();
        let (d, n) = ball.distance(Vec3::new(size, 0.0, size));
        assert!(
            (n.length() - 1.0).abs() < 4.0 * f32::EPSILON || !d.is_finite(),
            "{size:e}: {n}"
        );
    }
}

/// Found by fuzzing: edges between finite positions can overflow.
#[test]
fn rotations_stay_rotations_wherever_a_body_is_placed() {
    let mesh = Mesh::new(&NODES, &TETS).unwrap();
    let material = Material::new(1e6, 0.3, 1000.0).unwrap();
    let mut body: OwnedBody = OwnedBody::new(&mesh, &material, Start::default()).unwrap();
    let far = NODES.map(|x| x.map(|c| 6e38_f64 * (f64::from(c) - 0.5)).map(|c| c as f32));
    body.place(&far, &NODES).unwrap();
    for block in body.state().view().rotations {
        for lane in 0..8 {
            let square: f32 = block.0.iter().map(|c| c[lane] * c[lane]).sum();
            assert!((square - 1.0).abs() < 8.0 * f32::EPSILON);
        }
    }
}
