//! Tetrahedral meshes as they come from a file or a generator: f64 positions, and what
//! was already found wrong while reading.

pub mod check;
pub mod gmsh;
pub mod grid;
pub mod shape;
pub mod tetgen;

use std::path::Path;

use glam::DVec3;

use check::Problem;

/// The index that stands for a node that does not exist.
pub const NOWHERE: u32 = u32::MAX;

/// The most nodes or tets that a mesh may have here.
pub const LIMIT: usize = 1 << 26;

#[derive(Debug, Default)]
pub struct Mesh {
    /// What kind of file it was, for people.
    pub format: String,
    pub nodes: Vec<DVec3>,
    /// Indices into `nodes`, or `NOWHERE`.
    pub tets: Vec<[u32; 4]>,
    /// The numbers that the file itself uses, for messages.
    pub node_names: Vec<u64>,
    pub tet_names: Vec<u64>,
    /// Gmsh's tag of the volume that each tet is in; empty where the file has none.
    pub volumes: Vec<i32>,
    /// What the reader found wrong with the content; `check` finds the rest.
    pub problems: Vec<Problem>,
    /// What the reader left out.
    pub notes: Vec<String>,
}

impl Mesh {
    /// The four corners of a tet; `None` where one of its nodes does not exist.
    pub fn corners(&self, tet: [u32; 4]) -> Option<[DVec3; 4]> {
        let mut corners = [DVec3::ZERO; 4];
        for (corner, node) in corners.iter_mut().zip(tet) {
            *corner = *self.nodes.get(node as usize)?;
        }
        Some(corners)
    }
}

/// Reads a mesh, its format told by the file's extension. An error says what is wrong,
/// not with which file; `Mesh::problems` holds what is wrong inside a readable file.
pub fn load(path: &Path) -> Result<Mesh, String> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
    match extension.to_ascii_lowercase().as_str() {
        "msh" => gmsh::parse(&read(path, "")?),
        "node" => {
            let elements = path.with_extension(if extension == "NODE" { "ELE" } else { "ele" });
            let name = elements.file_name().unwrap_or_default().to_string_lossy();
            let nodes = read(path, "")?;
            tetgen::parse(&nodes, &read(&elements, &name)?)
        }
        _ => Err("not a mesh format known here (.msh, or .node with its .ele)".into()),
    }
}

fn read(path: &Path, name: &str) -> Result<Vec<u8>, String> {
    std::fs::read(path).map_err(|e| match name {
        "" => format!("cannot be read: {e}"),
        _ => format!("{name} beside it cannot be read: {e}"),
    })
}
