//! Bodies of several materials: what is stored, how they bend, what is refused, and that factors and assets hold them.

use crate::support::meshes::{TetMesh, box_mesh, jitter, noise};
use crate::support::reference::{Reference, stack};
use femto::asset::{Asset, Metadata};
use femto::element::{Dense, Factored, Layout};
use femto::glam::Vec3;
use femto::lane::{BLOCK, blocks};
use femto::material::{Materials, Regions};
use femto::mesh::MeshError;
use femto::owned::OwnedRest;
use femto::rest::{Header, Rest, RestBuffer, RestMut, TetBlock};
use femto::{Budget, Material, Mesh, OwnedBody, Pin, Preconditioner, Scene, Settings, Start};
use femto_bake::{FactorOptions, Kind, factor};
use nalgebra::{DMatrix, DVector};

const STIFF: (f32, f32, f32) = (1e6, 0.4, 1000.0);
const SOFT: (f32, f32, f32) = (3e4, 0.2, 200.0);
const DAMPING: (f32, f32) = (0.3, 0.002);

fn materials() -> [Material; 2] {
    [STIFF, SOFT].map(|(young, poisson, density)| {
        let material = Material::new(young, poisson, density).unwrap();
        material.with_damping(DAMPING.0, DAMPING.1).unwrap()
    })
}

fn bar() -> TetMesh {
    jitter(&box_mesh([1.0, 0.4, 0.3], [5, 2, 2]), 0.03, 5)
}

/// Which of the two: the half of greater x is soft.
fn regions(mesh: &TetMesh) -> Vec<u16> {
    let middle = |tet: &[u32; 4]| tet.iter().map(|&i| mesh.nodes[i as usize][0]).sum::<f32>();
    let soft = |tet| u16::from(middle(tet) > 2.0);
    mesh.tets.iter().map(soft).collect()
}

/// Masses, λV and μV, f32 as stored.
fn stored<L: Layout>(rest: &Rest<'_, L>) -> (Vec<f32>, Vec<[f32; 2]>) {
    let lanes = |b: &TetBlock| {
        (0..BLOCK)
            .map(|i| [b.lambda_v[i], b.mu_v[i]])
            .collect::<Vec<_>>()
    };
    (
        rest.masses.to_vec(),
        rest.blocks.iter().flat_map(lanes).collect(),
    )
}

/// The oracle: one reference for each material, over its own tetrahedra and all nodes. M, K and forces add.
fn references(mesh: &TetMesh, of: &[u16], h: f64) -> [Reference; 2] {
    [STIFF, SOFT].map(|material| {
        let which = u16::from(material == SOFT);
        let mine = mesh.tets.iter().zip(of).filter(|(_, of)| **of == which);
        let tets: Vec<_> = mine.map(|(tet, _)| *tet).collect();
        let [young, poisson, density] = [material.0, material.1, material.2].map(f64::from);
        let mut reference = Reference::new(&mesh.nodes, &tets, young, poisson, density);
        (reference.alpha, reference.beta) = (f64::from(DAMPING.0), f64::from(DAMPING.1));
        reference.h = h;
        reference
    })
}

#[test]
fn every_tetrahedron_has_its_own_material() {
    let mesh = bar();
    let of = regions(&mesh);
    assert!(of.contains(&0) && of.contains(&1));
    let [stiff, soft] = materials();
    let checked = Mesh::new(&mesh.nodes, &mesh.tets).unwrap();
    let regions = Regions {
        materials: &[stiff, soft],
        of: &of,
    };
    let rest = OwnedRest::<Factored>::new(&checked, &regions).unwrap();
    let (masses, lame) = stored(&rest.view());

    let oracle = Reference::new(&mesh.nodes, &mesh.tets, 1.0, 0.0, 1.0);
    let near = |found: f32, expected: f64| (f64::from(found) - expected).abs() <= 1e-6 * expected;
    for ((&of, volume), [lambda, mu]) in of.iter().zip(&oracle.volumes).zip(&lame) {
        let (e, nu, _) = if of == 1 { SOFT } else { STIFF };
        let (e, nu) = (f64::from(e), f64::from(nu));
        assert!(near(*mu, volume * e / (2.0 + 2.0 * nu)));
        assert!(near(*lambda, volume * e * nu / (1.0 - nu - 2.0 * nu * nu)));
    }
    let [a, b] = references(&mesh, &of, 0.01);
    for ((found, a), b) in masses.iter().zip(&a.masses).zip(&b.masses) {
        assert!(near(*found, a + b));
    }
    let total: f64 = a.masses.iter().chain(&b.masses).sum();
    assert!(near(rest.view().header.total_mass, total));
    let header = rest.view().header;
    assert_eq!((header.alpha, header.beta), DAMPING);
}

#[test]
fn all_ways_to_say_it_give_the_same_bits() {
    const BLOCKS: usize = blocks(120);
    let mesh = bar();
    assert_eq!((mesh.nodes.len(), mesh.tets.len()), (54, 120));
    let of = regions(&mesh);
    let [stiff, soft] = materials();
    let checked = Mesh::new(&mesh.nodes, &mesh.tets).unwrap();
    let of_tet = |&of: &u16| if of == 1 { soft } else { stiff };
    let each: Vec<Material> = of.iter().map(of_tet).collect();
    let regions = Regions {
        materials: &[stiff, soft],
        of: &of,
    };

    let expected = OwnedRest::<Factored>::new(&checked, &regions).unwrap();
    let expected = (stored(&expected.view()), expected.view().header);
    let same = |rest: Rest<'_>| assert_eq!((stored(&rest), rest.header), expected);
    same(OwnedRest::new(&checked, each.as_slice()).unwrap().view());
    let mut buffer = RestBuffer::<54, BLOCKS>::new();
    buffer.fill(&checked, &regions).unwrap();
    same(buffer.view());
    let (mut header, mut nodes, mut masses) = (Header::EMPTY, [[0.0; 3]; 54], [0.0; 54]);
    let mut tets = [TetBlock::ZERO; BLOCKS];
    let mut borrowed = RestMut::<Factored> {
        nodes: &mut nodes,
        masses: &mut masses,
        blocks: &mut tets,
        stiffness: &mut [(); BLOCKS],
        header: &mut header,
    };
    borrowed.fill(&checked, each.as_slice()).unwrap();
    same(Rest {
        nodes: &nodes,
        masses: &masses,
        blocks: &tets,
        stiffness: &[(); BLOCKS],
        fans: &[],
        header,
    });
    // And one for all is one for each.
    let one = OwnedRest::<Dense>::new(&checked, &stiff).unwrap();
    let many = OwnedRest::<Dense>::new(&checked, vec![stiff; 120].as_slice()).unwrap();
    assert_eq!(stored(&one.view()), stored(&many.view()));
}

#[test]
fn what_is_wrong_with_materials_is_named() {
    let mesh = bar();
    let checked = Mesh::new(&mesh.nodes, &mesh.tets).unwrap();
    let [stiff, soft] = materials();
    let mut of = regions(&mesh);
    let refused = |materials: &dyn Materials| {
        let mut buffer = RestBuffer::<54, { blocks(120) }>::new();
        let error = buffer.fill(&checked, materials).unwrap_err();
        assert!(buffer.view().nodes.is_empty() && buffer.view().header == Header::EMPTY);
        assert_eq!(
            OwnedRest::<Dense>::new(&checked, materials).unwrap_err(),
            error
        );
        error
    };
    let given = |given| MeshError::Materials { given, tets: 120 };
    assert_eq!(
        refused(&Regions {
            materials: &[stiff],
            of: &of[1..]
        }),
        given(119)
    );
    assert_eq!(
        refused(&Regions {
            materials: &[stiff],
            of: &[0; 121]
        }),
        given(121)
    );
    assert_eq!(
        refused(&Regions {
            materials: &[],
            of: &of
        }),
        MeshError::NoMaterial { tet: 0 }
    );
    let first = of.iter().position(|of| *of == 1).unwrap() as u32;
    assert_eq!(
        refused(&Regions {
            materials: &[stiff],
            of: &of
        }),
        MeshError::NoMaterial { tet: first }
    );
    for (alpha, beta) in [(0.3, 0.0), (0.0, 0.002)] {
        let other = [stiff, soft.with_damping(alpha, beta).unwrap()];
        let error = refused(&Regions {
            materials: &other,
            of: &of,
        });
        assert_eq!(error, MeshError::Damping { tet: first });
    }
    let light = Material::new(1e6, 0.4, f32::MIN_POSITIVE)
        .unwrap()
        .with_damping(0.3, 0.002)
        .unwrap();
    of.fill(0);
    of[77] = 1;
    let error = refused(&Regions {
        materials: &[stiff, light],
        of: &of,
    });
    assert_eq!(error, MeshError::OutOfScale { tet: 77 });
}

/// Two bars in series, ν = 0: a force F at the end moves it by F (L₁/E₁ + L₂/E₂)/A.
#[test]
fn bars_in_series_add_their_give() {
    let mesh = box_mesh([1.0, 0.25, 0.25], [4, 1, 1]);
    let of = regions(&mesh);
    let material = |young| {
        Material::new(young, 0.0, 1000.0)
            .unwrap()
            .with_damping(0.0, 0.1)
            .unwrap()
    };
    let materials = [material(1e6), material(2.5e5)];
    let checked = Mesh::new(&mesh.nodes, &mesh.tets).unwrap();
    let regions = Regions {
        materials: &materials,
        of: &of,
    };
    // The traction 1 kPa over the end, shared as its triangles share it.
    let mut forces = vec![[0.0; 3]; mesh.nodes.len()];
    for tet in &mesh.tets {
        let face: Vec<u32> = tet
            .iter()
            .copied()
            .filter(|&i| mesh.nodes[i as usize][0] == 1.0)
            .collect();
        if face.len() == 3 {
            face.iter()
                .for_each(|&i| forces[i as usize][0] += 1e3 * 0.25 * 0.25 / 2.0 / 3.0);
        }
    }
    let held = (0_u32..).zip(&mesh.nodes).filter(|(_, x)| x[0] == 0.0);
    let pins: Vec<Pin> = held.map(|(i, _)| Pin::held(i)).collect();
    let mut body = OwnedBody::<Factored>::new(&checked, &regions, Start::Galerkin(1)).unwrap();
    let scene = Scene {
        forces: &forces,
        pins: &pins,
        ..Scene::default()
    };
    let budget = Budget {
        iterations: 60,
        polar_sweeps: 2,
    };
    let settings = Settings::new(0.02).unwrap().with_budget(budget);
    for _ in 0..400 {
        assert!(body.step(&scene, &settings).advanced());
    }
    for (x, rest) in body.positions().iter().zip(&mesh.nodes) {
        let [stiff, soft] = [rest[0].min(0.5), (rest[0] - 0.5).max(0.0)];
        let expected = f64::from(rest[0]) + 1e3 * f64::from(stiff / 1e6 + soft / 2.5e5);
        assert!(
            (f64::from(x[0]) - expected).abs() < 1e-6,
            "{x:?}, {expected}"
        );
        assert!((x[1] - rest[1]).abs() < 1e-6 && (x[2] - rest[2]).abs() < 1e-6);
    }
}

/// A factor reads λV, μV and the masses: at rest it is the inverse, so one iteration solves.
#[test]
fn factors_hold_bodies_of_two_materials() {
    let mesh = bar();
    let of = regions(&mesh);
    let checked = Mesh::new(&mesh.nodes, &mesh.tets).unwrap();
    let regions = Regions {
        materials: &materials(),
        of: &of,
    };
    let rest = OwnedRest::<Factored>::new(&checked, &regions).unwrap();
    let settings = Settings::new(0.01).unwrap();
    let v = noise(mesh.nodes.len(), 0.1, 3);

    let systems = references(&mesh, &of, f64::from(0.01_f32)).map(|mut reference| {
        reference.v = stack(&v);
        reference.gravity = [0.0, f64::from(-9.81_f32), 0.0];
        let upright = vec![nalgebra::Matrix3::identity(); reference.tets.len()];
        reference.system(&upright)
    });
    let [(a, b), (a_soft, b_soft)] = systems;
    let (a, b): (DMatrix<f64>, DVector<f64>) = (a + a_soft, b + b_soft);
    let eigenvalues = a.symmetric_eigenvalues();
    let bound = f64::from(f32::EPSILON) * eigenvalues.max() / eigenvalues.min();
    let exact = a.cholesky().unwrap().solve(&b);

    let off = |preconditioner: Preconditioner<'_>| {
        let mut body = OwnedBody::from_rest(rest.clone(), Start::Zero);
        body.place(&mesh.nodes, &v).unwrap();
        let budget = Budget {
            iterations: 1,
            polar_sweeps: 2,
        };
        let settings = settings.with_budget(budget).with_start(Start::Zero);
        let scene = Scene {
            gravity: Vec3::new(0.0, -9.81, 0.0),
            ..Scene::default()
        };
        let report = body.step(&scene, &settings.with_preconditioner(preconditioner));
        assert!(report.advanced());
        (stack(body.velocities()) - &exact).norm() / exact.norm()
    };
    let options = FactorOptions {
        kind: Kind::Warped,
        ..FactorOptions::default()
    };
    let right = factor(&rest.view(), &settings, &options).unwrap();
    let found = off(Preconditioner::Factored(&right.view()));
    // A factor that takes all of the body for stiff is one of another matrix.
    let uniform = OwnedRest::<Factored>::new(&checked, &materials()[0]).unwrap();
    let wrong = factor(&uniform.view(), &settings, &options).unwrap();
    let (wrong, jacobi) = (
        off(Preconditioner::Factored(&wrong.view())),
        off(Preconditioner::Jacobi),
    );
    println!("factor {found:e} of {bound:e}; of one material {wrong:e}; Jacobi {jacobi:e}");
    assert!(found < bound, "{found:e} of {bound:e}");
    assert!(wrong > 100.0 * found && jacobi > 100.0 * found);
}

#[test]
fn assets_keep_both_materials() {
    let mesh = bar();
    let of = regions(&mesh);
    let checked = Mesh::new(&mesh.nodes, &mesh.tets).unwrap();
    let regions = Regions {
        materials: &materials(),
        of: &of,
    };
    let rest = OwnedRest::<Factored>::new(&checked, &regions).unwrap();
    let settings = Settings::new(0.01).unwrap();
    let options = FactorOptions {
        kind: Kind::Laplacian,
        ..FactorOptions::default()
    };
    let made = factor(&rest.view(), &settings, &options).unwrap();
    let asset = Asset {
        rest: rest.view(),
        factor: Some(made.view()),
        pins: &[],
        metadata: Metadata {
            source: "two",
            material: materials()[0],
            settings,
        },
    };
    let bytes = asset.to_bytes().unwrap();
    let read = Asset::new(&bytes).unwrap();
    assert_eq!(stored(&read.rest), stored(&rest.view()));
    assert_eq!(read.rest.header, rest.view().header);
    assert_eq!(read.factor, asset.factor);
}
