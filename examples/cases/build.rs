//! The meshes of the checks, their tetrahedra in fans: what a host does once for firmware.

use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::{env, fs};

use femto::Material;
use femto::glam::Vec3;
use femto::join::Assembly;
use femto::order::fans;
use femto::rigid::Shape;

#[path = "src/mesh.rs"]
mod mesh;
use mesh::Grid;

type Body<'a> = (&'a [[f32; 3]], &'a [[u32; 4]]);

/// Soft bodies on each other, each a little into the one below, and rigid ones on top: `b`oxes and b`o`ls. As source.
fn world(bodies: &[Body<'_>], rigids: &str) -> Result<String, Box<dyn Error>> {
    let soft = Material::new(1e5, 0.3, 1000.0)?;
    let mut parts = Assembly::new();
    let mut top = 0.0;
    for (nodes, tets) in bodies {
        let placed: Vec<_> = nodes.iter().map(|[x, y, z]| [*x, y + top, *z]).collect();
        parts.soft(&placed, tets, soft, 0.4)?;
        top = placed.iter().map(|x| x[1]).fold(top, f32::max) - 0.02;
    }
    for (k, kind) in (0_u8..).zip(rigids.chars()) {
        let shape = match kind {
            'o' => Shape::Ball { radius: 0.06 },
            _ => Shape::Cuboid {
                half: Vec3::new(0.05, 0.06, 0.04),
            },
        };
        let centre = Vec3::new(0.06 + 0.1 * f32::from(k), top + 0.05, 0.1);
        parts.rigid(shape, 2.0, centre, [Vec3::X, Vec3::Y, Vec3::Z], 0.3, &soft)?;
    }
    let ordered = fans(&parts.tets);
    let materials: Vec<_> = parts
        .materials
        .iter()
        .map(|m| [m.young(), m.poisson(), m.density()])
        .collect();
    let materials: Vec<_> = ordered.original.iter().map(|&tet| materials[tet]).collect();
    let surfaces: Vec<_> = parts
        .pieces()
        .iter()
        .map(|p| {
            format!(
                "Surface {{ range: {:?}, triangles: &{:?}, nodes: &{:?} }}",
                p.range, p.triangles, p.nodes
            )
        })
        .collect();
    let rigids: Vec<_> = parts
        .rigids()
        .iter()
        .map(|r| match r.shape() {
            Shape::Ball { radius } => {
                format!("({}, Shape::Ball {{ radius: {radius:?} }})", r.first())
            }
            Shape::Cuboid { half } => {
                let half = half.to_array();
                format!(
                    "({}, Shape::Cuboid {{ half: Vec3::from_array({half:?}) }})",
                    r.first()
                )
            }
        })
        .collect();
    Ok(format!(
        "World {{ nodes: &{:?}, tets: &{:?}, materials: &{materials:?}, pieces: &[{}], rigids: &[{}] }}",
        parts.nodes,
        ordered.tets,
        surfaces.join(", "),
        rigids.join(", "),
    ))
}

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
    let folder = env::var("OUT_DIR")?;
    fs::write(Path::new(&folder).join("fans.rs"), out)?;
    let small = Grid::<27, 48>::new([2, 2, 2]);
    let flat = Grid::<48, 90>::new([5, 3, 1]);
    let long = Grid::<90, 216>::new([9, 2, 2]);
    let cube = Grid::<64, 162>::new([3, 3, 3]);
    let (small, flat) = (
        (&small.nodes[..], &small.tets[..]),
        (&flat.nodes[..], &flat.tets[..]),
    );
    let (long, cube) = (
        (&long.nodes[..], &long.tets[..]),
        (&cube.nodes[..], &cube.tets[..]),
    );
    let worlds = [
        ("TWO", world(&[small, small], "")?),
        ("FOUR", world(&[small, small], "ob")?),
        ("SMALL", world(&[small], "o")?),
        ("MIXED", world(&[flat, long], "bbo")?),
        ("PILE", world(&[small, flat, small], "")?),
        ("LONG", world(&[long], "bobo")?),
        ("FLAT", world(&[flat], "b")?),
        ("STEEP", world(&[long, flat], "o")?),
        ("THREE", world(&[small, small, small], "bo")?),
        ("SLOPE", world(&[flat, small], "")?),
        ("HEAP", world(&[long, flat, small], "bo")?),
        ("EVEN", world(&[flat, flat], "")?),
        ("CUBES", world(&[cube, cube], "bo")?),
        ("CUBE", world(&[cube, small], "")?),
    ];
    let mut out = String::new();
    for (name, world) in worlds {
        writeln!(out, "pub static {name}: World = {world};")?;
    }
    fs::write(Path::new(&folder).join("worlds.rs"), out)?;
    println!("cargo:rerun-if-changed=build.rs\ncargo:rerun-if-changed=src/mesh.rs");
    Ok(())
}
