//! What steps cost on each machine, by the formula of `femto::cost`, as the README's tables have it.

use std::error::Error;

use femto::cost::{Kind, Load, Machine};
use femto::preconditioner::Aggregates;
use femto::preconditioner::aggregate::DEFAULT_AGGREGATES;
use femto::{Budget, Material, Mesh, OwnedBody, Preconditioner, Scene, Settings};
use femto_cases::choices::STARTS;
use femto_cases::fans;
use femto_cases::mesh::Grid;

/// Boxes of 3×3×3, 12×3×3 and 15×5×4 cells, their tetrahedra in fans.
static CUBE: Grid<64, 162> = Grid::new([3, 3, 3]);
static BAR: Grid<208, 648> = Grid::new([12, 3, 3]);
static LARGE: Grid<480, 1800> = Grid::new([15, 5, 4]);

/// Entries of a factor a node: some.
const ENTRIES: usize = 12;

fn main() -> Result<(), Box<dyn Error>> {
    let budget = Budget {
        iterations: 5,
        polar_sweeps: 1,
    };
    let loads = [
        loads(&CUBE.nodes, &fans::CUBE)?,
        loads(&BAR.nodes, &fans::BAR)?,
        loads(&LARGE.nodes, &fans::LARGE)?,
    ];
    let [in_cells, _] = self::loads(&CUBE.nodes, &CUBE.tets)?;
    println!("Thousands of instructions of a step, 5 iterations, 1 sweep, Jacobi, free body\n");
    println!(
        "| machine | nodes | {} |",
        STARTS.map(|(name, _)| format!("`{name}`")).join(" | ")
    );
    println!("|---|---|{}", "---|".repeat(STARTS.len()));
    for (name, machine) in Machine::ALL {
        for [plain, _] in loads {
            let costs =
                STARTS.map(|(_, start)| thousands(budget.cost(&Load { start, ..plain }, machine)));
            println!("| {name} | {} | {} |", plain.nodes, costs.join(" | "));
        }
    }

    println!(
        "\nThe first mesh in the order of its cells, `galerkin-1`: times what it takes in fans\n"
    );
    for (name, machine) in Machine::ALL {
        let [cells, fans] = [in_cells, loads[0][0]].map(|load| budget.cost(&load, machine) as f64);
        println!("{name}: {:.2}", cells / fans);
    }
    println!(
        "\nThe same for `galerkin-1` by preconditioner; factors with {ENTRIES} entries a node, {DEFAULT_AGGREGATES} aggregates\n"
    );
    println!(
        "| machine | nodes | {} |",
        Kind::ALL.map(|(name, _)| name).join(" | ")
    );
    println!("|---|---|{}", "---|".repeat(Kind::ALL.len()));
    for (name, machine) in Machine::ALL {
        for [plain, two_level] in loads {
            let costs = Kind::ALL.map(|(_, preconditioner)| {
                let load = match preconditioner {
                    Kind::TwoLevel => two_level,
                    _ => Load {
                        preconditioner,
                        entries: ENTRIES * plain.nodes,
                        ..plain
                    },
                };
                thousands(budget.cost(&load, machine))
            });
            println!("| {name} | {} | {} |", plain.nodes, costs.join(" | "));
        }
    }
    Ok(())
}

/// With Jacobi and with the two-level preconditioner.
fn loads(nodes: &[[f32; 3]], tets: &[[u32; 4]]) -> Result<[Load; 2], Box<dyn Error>> {
    let settings = Settings::new(0.01)?;
    let body: OwnedBody = OwnedBody::new(
        &Mesh::new(nodes, tets)?,
        &Material::new(1e6, 0.4, 1000.0)?,
        settings.start,
    )?;
    let mut of = vec![0; nodes.len()];
    let aggregates = Aggregates::divide(&body.rest(), DEFAULT_AGGREGATES, &mut of)?;
    let two_level = settings.with_preconditioner(Preconditioner::TwoLevel(aggregates));
    Ok([settings, two_level].map(|settings| Load::of(&body.rest(), &Scene::default(), &settings)))
}

fn thousands(instructions: u64) -> String {
    format!("{}", (instructions + 500) / 1000)
}
