//! Bytes of a body, as the README's tables have them: by the crate's own `const fn`s, and of factors
//! that are made here (E = 1e5 Pa, ν = 0.4, 1000 kg/m³, h = 1/150 s, nothing held).

#[path = "../mesh.rs"]
#[allow(dead_code, reason = "the benchmark uses more of it")]
mod mesh;

use femto::asset::{Asset, Metadata};
use femto::body::{rest_bytes, state_bytes, workspace_bytes};
use femto::element::{Dense, Factored, Layout};
use femto::owned::OwnedRest;
use femto::{Material, Mesh, Settings, Start, blocks};
use femto_bake::{FactorOptions, Kind, Precision, factor};
use femto_bench::mesh_file;

fn main() -> Result<(), String> {
    let cells = |cells| {
        let scene = mesh::box_scene(cells);
        (scene.nodes, scene.tets)
    };
    let meshes = [
        cells([3, 3, 3]),
        cells([12, 3, 3]),
        mesh_file::load(mesh_file::SNOWMAN)?,
        cells([16, 16, 16]),
    ];
    println!("| nodes | tetrahedra | layout | start | rest | state | workspace |");
    println!("|---|---|---|---|---|---|---|");
    for (nodes, tets) in &meshes {
        let (nodes, tets) = (nodes.len(), tets.len());
        row::<Factored>(nodes, tets, "factored", Start::Galerkin(1));
        row::<Factored>(nodes, tets, "factored", Start::Rigid(1));
        row::<Dense>(nodes, tets, "dense", Start::Galerkin(1));
    }
    println!();
    println!("| nodes | factor | numbers | in f32 | in f16 | asset, f32 | asset, f16 |");
    println!("|---|---|---|---|---|---|---|");
    for (nodes, tets) in &meshes {
        for (name, kind) in [("Laplacian", Kind::Laplacian), ("warped", Kind::Warped)] {
            factors(nodes, tets, name, kind);
        }
    }
    Ok(())
}

fn row<L: Layout>(nodes: usize, tets: usize, layout: &str, start: Start) {
    let blocks = blocks(tets);
    let name = match start {
        Start::Rigid(m) => format!("rigid-{m}"),
        Start::Galerkin(m) => format!("galerkin-{m}"),
        _ => "other".to_string(),
    };
    println!(
        "| {nodes} | {tets} | {layout} | {name} | {} | {} | {} |",
        rest_bytes::<L>(nodes, blocks),
        state_bytes(nodes, blocks, start.history()),
        workspace_bytes::<L>(nodes, blocks, start.vectors()),
    );
}

/// Bytes of a factor by itself, and of the whole asset with it.
fn factors(nodes: &[[f32; 3]], tets: &[[u32; 4]], name: &str, kind: Kind) {
    let mesh = Mesh::new(nodes, tets).expect("a good mesh");
    let material = Material::new(1e5, 0.4, 1000.0).expect("a good material");
    let rest = OwnedRest::new(&mesh, &material).expect("in range");
    let settings = Settings::new(1.0 / 150.0).expect("a good time step");
    let [single, half] = [Precision::Single, Precision::Half].map(|precision| {
        let options = FactorOptions {
            kind,
            precision,
            ..FactorOptions::default()
        };
        let owned = factor(&rest.view(), &settings, &options).expect("a positive definite matrix");
        let factor = owned.view();
        let metadata = Metadata {
            source: "",
            material,
            settings,
        };
        let asset = Asset {
            rest: rest.view(),
            factor: Some(factor),
            pins: &[],
            metadata,
        };
        let bytes = asset.to_bytes().expect("a good asset").len();
        (factor.scalars(), factor.bytes(), bytes)
    });
    println!(
        "| {} | {name} | {} | {} | {} | {} | {} |",
        nodes.len(),
        single.0,
        single.1,
        half.1,
        single.2,
        half.2
    );
}
