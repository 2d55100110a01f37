//! The linker's map of each board, and the demonstration's rest data for flash.

use std::error::Error;
use std::fmt::Write;
use std::path::PathBuf;
use std::{env, fs};

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
        for binary in binaries {
            println!("cargo:rustc-link-arg-bin={binary}=-L{}", folder.display());
        }
    }
    fs::write(out.join("rest.rs"), rest()?)?;
    println!("cargo:rerun-if-changed=build.rs\ncargo:rerun-if-changed=src/scene.rs");
    Ok(())
}

/// Rest data of the demonstration as Rust source, to the bit, and the hash that its run must end with, from
/// the same run on this host.
fn rest() -> Result<String, Box<dyn Error>> {
    let grid: Grid<NODES, TETS> = Grid::new([3, 3, 3]);
    let mesh = Mesh::new(&grid.nodes, &grid.tets)?;
    let material = Material::new(2e4, 0.4, 1000.0)?.with_damping(0.0, 1e-3)?;
    let rest: OwnedRest<Factored> = OwnedRest::new(&mesh, &material)?;
    let view = rest.view();
    let (header, mut text) = (view.header, String::new());
    writeln!(
        text,
        "static NODES: [[f32; 3]; {}] = {:?};",
        view.nodes.len(),
        view.nodes
    )?;
    writeln!(
        text,
        "static MASSES: [f32; {}] = {:?};",
        view.masses.len(),
        view.masses
    )?;
    writeln!(
        text,
        "static BLOCKS: [TetBlock; {}] = {:?};",
        view.blocks.len(),
        view.blocks
    )?;
    writeln!(text, "const HEADER: Header = {header:?};")?;

    let mut body = OwnedBody::from_rest(rest, scene::SETTINGS.start);
    for _ in 0..scene::STEPS {
        if !body.step(&scene::SCENE, &scene::SETTINGS).advanced() {
            return Err("the demonstration is refused on the host".into());
        }
    }
    let hash = StateHash::new().with(body.positions(), body.velocities());
    writeln!(text, "const HASH: u64 = {:#x};", hash.value())?;
    Ok(text)
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
