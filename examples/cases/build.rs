//! The meshes of the checks, their tetrahedra in fans: what a host does once for firmware.

use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::{env, fs};

use femto::order::fans;

#[path = "src/mesh.rs"]
mod mesh;
use mesh::Grid;

fn main() -> Result<(), Box<dyn Error>> {
    let mut out = String::new();
    let mut list = |name: &str, tets: &[[u32; 4]]| {
        let tets = fans(tets).tets;
        let count = tets.len();
        writeln!(out, "pub static {name}: [[u32; 4]; {count}] = {tets:?};")
    };
    list("SMALL", &Grid::<27, 48>::new([2, 2, 2]).tets)?;
    list("FLAT", &Grid::<48, 90>::new([5, 3, 1]).tets)?;
    list("LONG", &Grid::<90, 216>::new([9, 2, 2]).tets)?;
    list("THICK", &Grid::<180, 600>::new([5, 5, 4]).tets)?;
    list("CUBE", &Grid::<64, 162>::new([3, 3, 3]).tets)?;
    list("BAR", &Grid::<208, 648>::new([12, 3, 3]).tets)?;
    list("LARGE", &Grid::<480, 1800>::new([15, 5, 4]).tets)?;
    fs::write(Path::new(&env::var("OUT_DIR")?).join("fans.rs"), out)?;
    println!("cargo:rerun-if-changed=build.rs\ncargo:rerun-if-changed=src/mesh.rs");
    Ok(())
}
