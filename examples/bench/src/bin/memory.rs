//! Bytes of a body, by the crate's own `const fn`s, as the README's table has them.

use femto::body::{rest_bytes, state_bytes, workspace_bytes};
use femto::element::{Dense, Factored, Layout};
use femto::{Start, blocks};

/// Nodes and tetrahedra: boxes of 3×3×3 and 12×3×3 cells, the snowman, a box of 16×16×16 cells.
const MESHES: [(usize, usize); 4] = [(64, 162), (208, 648), (509, 1716), (4913, 24576)];

fn main() {
    println!("| nodes | tetrahedra | layout | start | rest | state | workspace |");
    println!("|---|---|---|---|---|---|---|");
    for (nodes, tets) in MESHES {
        row::<Factored>(nodes, tets, "factored", Start::Galerkin(1));
        row::<Factored>(nodes, tets, "factored", Start::Rigid(1));
        row::<Dense>(nodes, tets, "dense", Start::Galerkin(1));
    }
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
