//! Meshes as gmsh writes them.

/// Nodes and tetrahedra.
pub type Tetrahedra = (Vec<[f32; 3]>, Vec<[u32; 4]>);

/// Reads a good file.
pub fn load(file: &str) -> Tetrahedra {
    let bytes = std::fs::read(file).unwrap_or_else(|e| panic!("{file}: {e}"));
    let msh = mshio::parse_msh_bytes(&bytes).unwrap_or_else(|e| panic!("{file}: {e:?}"));
    let nodes = msh.data.nodes.expect("nodes");
    let mut numbers = std::collections::HashMap::new();
    let mut out = Vec::new();
    for block in &nodes.node_blocks {
        for (k, node) in block.nodes.iter().enumerate() {
            let tag = block
                .node_tags
                .as_ref()
                .map_or(out.len() as u64 + 1, |tags| {
                    *tags.iter().find(|(_, at)| **at == k).expect("a tag").0
                });
            numbers.insert(tag, out.len() as u32);
            out.push([node.x as f32, node.y as f32, node.z as f32]);
        }
    }
    let mut tets = Vec::new();
    for block in &msh.data.elements.expect("elements").element_blocks {
        if block.element_type == mshio::ElementType::Tet4 {
            for element in &block.elements {
                tets.push(std::array::from_fn(|c| numbers[&element.nodes[c]]));
            }
        }
    }
    (out, tets)
}
