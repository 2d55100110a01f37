//! What contact between bodies costs: steps of scenes with it and without, in fastest steps of the snowman.
//!
//! `cargo run --release -p femto-bench --bin contact [SCENE...]`

use femto_bench::clock;
use femto_cli::contact_cost::{Search, step_times};

const RUNS: usize = 5;

fn main() -> Result<(), String> {
    let only: Vec<String> = std::env::args().skip(1).collect();
    const SCENES: [(&str, bool); 3] = [("tower", false), ("bowling", true), ("cars", false)];
    if let Some(unknown) = only
        .iter()
        .find(|one| SCENES.iter().all(|(scene, _)| scene != one))
    {
        return Err(format!("no scene {unknown} here"));
    }
    let snowman = step_times("snowman", Search::None, RUNS, clock::now)?[0];
    println!("the snowman's fastest step: {:.3} ms\n", 1e3 * snowman);
    println!("| scene | search | fastest | median | slowest |\n|---|---|---|---|---|");
    for (scene, rigid) in SCENES {
        if !only.is_empty() && !only.iter().any(|one| one == scene) {
            continue;
        }
        for search in [Search::None, Search::Boxes, Search::EveryTriangle] {
            if rigid && search == Search::None {
                continue;
            }
            let times = step_times(scene, search, RUNS, clock::now)?;
            let [first, middle, last] =
                [0, times.len() / 2, times.len() - 1].map(|k| times[k] / snowman);
            println!("| `{scene}` | {search:?} | {first:.2} | {middle:.2} | {last:.2} |");
        }
    }
    Ok(())
}
