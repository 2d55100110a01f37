//! What steps cost on each machine, by the formula of `femto::cost`, as the README's tables have it.

use femto::Budget;
use femto::cost::{Kind, Load, Machine};
use femto_cases::choices::STARTS;

/// Nodes, tetrahedra: boxes of 3×3×3 and 12×3×3 cells, and the snowman.
const MESHES: [(usize, usize); 3] = [(64, 162), (208, 648), (509, 1716)];

fn main() {
    let budget = Budget {
        iterations: 5,
        polar_sweeps: 1,
    };
    println!("Thousands of instructions of a step, 5 iterations, 1 sweep, Jacobi, free body\n");
    println!(
        "| machine | nodes | {} |",
        STARTS.map(|(name, _)| format!("`{name}`")).join(" | ")
    );
    println!("|---|---|{}", "---|".repeat(STARTS.len()));
    for (name, machine) in Machine::ALL {
        for (nodes, tets) in MESHES {
            let costs = STARTS.map(|(_, start)| {
                let load = Load {
                    start,
                    ..Load::new(nodes, tets)
                };
                thousands(budget.cost(&load, machine))
            });
            println!("| {name} | {nodes} | {} |", costs.join(" | "));
        }
    }

    println!(
        "\nThe same for `galerkin-1` by preconditioner; factors with {ENTRIES} entries a node\n"
    );
    println!(
        "| machine | nodes | {} |",
        Kind::ALL.map(|(name, _)| name).join(" | ")
    );
    println!("|---|---|{}", "---|".repeat(Kind::ALL.len()));
    for (name, machine) in Machine::ALL {
        for (nodes, tets) in MESHES {
            let costs = Kind::ALL.map(|(_, preconditioner)| {
                let load = Load {
                    preconditioner,
                    entries: ENTRIES * nodes,
                    ..Load::new(nodes, tets)
                };
                thousands(budget.cost(&load, machine))
            });
            println!("| {name} | {nodes} | {} |", costs.join(" | "));
        }
    }
}

/// Entries of a factor a node: some.
const ENTRIES: usize = 12;

fn thousands(instructions: u64) -> String {
    format!("{}", (instructions + 500) / 1000)
}
