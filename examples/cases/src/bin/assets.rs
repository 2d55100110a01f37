//! Prints the body of the scenes as assets, one with each factor and one without, as arrays for a C program.

use std::error::Error;
use std::fmt::Write;

use femto::asset::{Asset, Metadata};
use femto::owned::OwnedRest;
use femto::{Material, Mesh, Settings, Start};
use femto_cases::choices::{Choice, PRECONDITIONERS};
use femto_cases::factor::FactorRoom;
use femto_cases::scenes::{DAMPING, MATERIAL, MESH};

fn main() -> Result<(), Box<dyn Error>> {
    let mesh = Mesh::new(&MESH.nodes, &MESH.tets)?;
    let [young, poisson, density] = MATERIAL;
    let material = Material::new(young, poisson, density)?.with_damping(DAMPING[0], DAMPING[1])?;
    let rest = OwnedRest::new(&mesh, &material)?;
    let settings = Settings::new(1.0 / 150.0)?.with_start(Start::Galerkin(1));
    let mut factors = FactorRoom::<16, 108>::new();
    factors.fill(MESH.nodes.len(), &MESH.tets);
    let kinds = PRECONDITIONERS
        .into_iter()
        .filter_map(|(name, choice)| match choice {
            Choice::Factored(kind) => Some((name, Some(kind))),
            _ => None,
        });
    let mut out = String::from("/* Written by femto-cases: assets. */\n");
    for (name, kind) in kinds.chain([("none", None)]) {
        let fingerprint = rest.view().header.fingerprint;
        let factor = kind.map(|kind| factors.factor(kind, fingerprint));
        let asset = Asset {
            rest: rest.view(),
            factor: factor.transpose()?,
            pins: &[],
            metadata: Metadata {
                source: "the box of the scenes",
                material,
                settings,
            },
        };
        let bytes = asset.to_bytes()?;
        let name = name.replace('-', "_").to_uppercase();
        write!(
            out,
            "static const _Alignas(FEMTO_ALIGNMENT) unsigned char ASSET_{name}[{}] = {{",
            bytes.len()
        )?;
        for byte in &*bytes {
            write!(out, "{byte},")?;
        }
        out.push_str("};\n");
    }
    print!("{out}");
    Ok(())
}
