//! The linker's map of each board, and the demonstration's body for flash.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs};

use femto::asset::{Asset, Metadata};
use femto::element::Factored;
use femto::energy::StateHash;
use femto::owned::{OwnedBody, OwnedRest};
use femto::{Material, Mesh};
use femto_cases::mesh::Grid;

#[path = "src/scene.rs"]
mod scene;
use scene::{NODES, TETS};

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    let riscv = env::var("CARGO_CFG_TARGET_ARCH")? == "riscv32";
    // The demonstration gets the 20 KB that it is meant for, the proofs what they like.
    for (ram, binaries) in [
        ("20K", &["firmware"][..]),
        ("4M", &["bits", "code", "cost"]),
    ] {
        let map = if riscv {
            RISCV.to_string()
        } else {
            format!(
                "MEMORY {{ FLASH : ORIGIN = 0x00000000, LENGTH = 1M\n RAM : ORIGIN = 0x20000000, LENGTH = {ram} }}\n"
            )
        };
        let folder = out.join(ram);
        fs::create_dir_all(&folder)?;
        fs::write(folder.join("memory.x"), map)?;
        // No interrupts have names.
        fs::write(folder.join("device.x"), "")?;
        for binary in binaries {
            println!("cargo:rustc-link-arg-bin={binary}=-L{}", folder.display());
        }
    }
    let hash = bake(&out.join("cube.femto"))?;
    fs::write(out.join("hash"), format!("{hash:#x}"))?;
    println!("cargo:rerun-if-changed=build.rs\ncargo:rerun-if-changed=src/scene.rs");
    Ok(())
}

/// Writes the demonstration's body to `file`, and returns the hash that its run must end with, from the same run on
/// this host.
fn bake(file: &Path) -> Result<u64, Box<dyn Error>> {
    let grid: Grid<NODES, TETS> = Grid::new([3, 3, 3]);
    // In the order that is fastest.
    let tets = femto::order::fans(&grid.tets).tets;
    let mesh = Mesh::new(&grid.nodes, &tets)?;
    let material = Material::new(2e4, 0.4, 1000.0)?.with_damping(0.0, 1e-3)?;
    let rest: OwnedRest<Factored> = OwnedRest::new(&mesh, &material)?;
    let asset = Asset {
        rest: rest.view(),
        factor: None,
        pins: scene::SCENE.pins,
        metadata: Metadata {
            source: "a box of 3 x 3 x 3 cells",
            material,
            settings: scene::SETTINGS,
        },
    };
    fs::write(file, &*asset.to_bytes()?)?;

    let mut body = OwnedBody::from_rest(rest, scene::SETTINGS.start);
    for _ in 0..scene::STEPS {
        if !body.step(&scene::SCENE, &scene::SETTINGS).advanced() {
            return Err("the demonstration is refused on the host".into());
        }
    }
    let hash = StateHash::new().with(body.positions(), body.velocities());
    Ok(hash.value())
}

/// QEMU's `virt` has RAM alone.
const RISCV: &str =
    "MEMORY { FLASH : ORIGIN = 0x80000000, LENGTH = 1M\n RAM : ORIGIN = 0x80100000, LENGTH = 1M }
REGION_ALIAS(\"REGION_TEXT\", FLASH);
REGION_ALIAS(\"REGION_RODATA\", FLASH);
REGION_ALIAS(\"REGION_DATA\", RAM);
REGION_ALIAS(\"REGION_BSS\", RAM);
REGION_ALIAS(\"REGION_HEAP\", RAM);
REGION_ALIAS(\"REGION_STACK\", RAM);
";
