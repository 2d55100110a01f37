//! Meshes: what is accepted gives rest data that can be computed with, and what is refused changes
//! nothing.

use femto::element::{Dense, DenseBlocks, Factored, Layout};
use femto::mesh::{MeshError, problems};
use femto::owned::OwnedRest;
use femto::rest::{Rest, RestBuffer};
use femto::{Material, Mesh, blocks};

use super::bytes::Bytes;
use super::inputs;

/// Room for some bodies and too little for others.
const NODES: usize = 16;
const BLOCKS: usize = 1;

pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let (nodes, tets) = inputs::body(&mut bytes);
    let mut first = None;
    problems(&nodes, &tets, |problem| {
        assert!(!problem.to_string().is_empty());
        first.get_or_insert(problem);
    });
    let mesh = Mesh::new(&nodes, &tets);
    assert_eq!(mesh.err(), first);
    let (Ok(mesh), Some(material)) = (mesh, inputs::material(&mut bytes)) else {
        return;
    };
    fill::<Factored>(&mesh, &material, |()| Vec::new());
    fill::<Dense>(&mesh, &material, |DenseBlocks(k)| {
        k.iter().flatten().flatten().flatten().copied().collect()
    });
}

fn fill<L: Layout>(mesh: &Mesh<'_>, material: &Material, stiffness: fn(&L::Stiffness) -> Vec<f32>) {
    let owned = OwnedRest::<L>::new(mesh, material);
    if let Ok(rest) = &owned {
        check(mesh, &rest.view(), stiffness);
    }

    let mut buffer = RestBuffer::<NODES, BLOCKS, L>::new();
    let nodes = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
    ];
    let one = Mesh::new(&nodes, &[[0, 1, 2, 3]]).expect("a tetrahedron");
    let steel = Material::new(2e11, 0.3, 7.8e3).expect("steel");
    buffer.fill(&one, &steel).expect("room for one");
    let before = bits(&buffer.view(), stiffness);

    let filled = buffer.fill(mesh, material);
    let after = bits(&buffer.view(), stiffness);
    match (filled, owned) {
        (Ok(()), Ok(owned)) => assert_eq!(after, bits(&owned.view(), stiffness)),
        (Err(refusal), owned) => {
            assert_eq!(
                after, before,
                "a refused mesh must leave the buffer as it was"
            );
            assert_eq!(refusal, expected_refusal(mesh, owned.err()));
        }
        (Ok(()), Err(refusal)) => panic!("in a buffer, but not in vectors: {refusal:?}"),
    }
}

/// Too large for the buffer, or what vectors refuse too.
fn expected_refusal(mesh: &Mesh<'_>, owned: Option<MeshError>) -> MeshError {
    let (nodes, tets) = (mesh.nodes().len(), mesh.tets().len());
    if nodes > NODES {
        MeshError::TooManyNodes {
            needed: nodes,
            capacity: NODES,
        }
    } else if blocks(tets) > BLOCKS {
        MeshError::TooManyTets {
            needed: tets,
            capacity: 8 * BLOCKS,
        }
    } else {
        let refusal = owned.expect("refused without a reason");
        assert!(
            matches!(refusal, MeshError::OutOfScale { .. }),
            "{refusal:?}"
        );
        refusal
    }
}

/// Finite numbers, positive masses and units, and room for every tetrahedron.
fn check<L: Layout>(mesh: &Mesh<'_>, rest: &Rest<'_, L>, stiffness: fn(&L::Stiffness) -> Vec<f32>) {
    assert_eq!(rest.nodes, mesh.nodes());
    assert_eq!(rest.blocks.len(), blocks(mesh.tets().len()));
    assert_eq!(rest.header.tets as usize, mesh.tets().len());
    let header = [
        rest.header.length_unit,
        rest.header.mass_unit,
        rest.header.total_mass,
    ];
    for x in rest.masses.iter().chain(&header) {
        assert!(
            *x > 0.0 && x.is_finite(),
            "{:?} {:?}",
            rest.masses,
            rest.header
        );
    }
    for block in rest.blocks {
        let gradients = block.gradients.as_flattened().as_flattened();
        for x in gradients.iter().chain(&block.lambda_v).chain(&block.mu_v) {
            assert!(x.is_finite(), "{block:?}");
        }
    }
    for x in rest.stiffness.iter().flat_map(stiffness) {
        assert!(x.is_finite(), "dense stiffness {x}");
    }
}

/// Every bit of rest data.
fn bits<L: Layout>(rest: &Rest<'_, L>, stiffness: fn(&L::Stiffness) -> Vec<f32>) -> Vec<u32> {
    let h = rest.header;
    let mut bits = vec![h.tets];
    let mut add = |numbers: &[f32]| bits.extend(numbers.iter().map(|x| x.to_bits()));
    add(&[h.alpha, h.beta, h.length_unit, h.mass_unit, h.total_mass]);
    add(rest.nodes.as_flattened());
    add(rest.masses);
    for block in rest.blocks {
        add(block.gradients.as_flattened().as_flattened());
        add(&block.lambda_v);
        add(&block.mu_v);
    }
    for block in rest.stiffness {
        add(&stiffness(block));
    }
    bits.extend(rest.blocks.iter().flat_map(|block| block.corners).flatten());
    bits
}
