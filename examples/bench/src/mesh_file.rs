//! Meshes of users, and those of the scenes.

use std::path::Path;

use femto_cli::mesh::{check, load as read};

/// Nodes and tetrahedra.
pub type Tetrahedra = (Vec<[f32; 3]>, Vec<[u32; 4]>);

/// The snowman of the built-in scene.
pub const SNOWMAN: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../femto-cli/meshes/snowman.msh"
);

/// Reads a mesh as the tool does.
///
/// # Errors
/// One line that names the file.
pub fn load(file: &str) -> Result<Tetrahedra, String> {
    let mesh = read(Path::new(file)).map_err(|why| format!("{file}: {why}"))?;
    if let Some(why) = check::first_of(&check::problems(&mesh)) {
        return Err(format!("{file}: {why}"));
    }
    let nodes = mesh.nodes.iter().map(|x| x.to_array().map(|x| x as f32));
    Ok((nodes.collect(), mesh.tets))
}
