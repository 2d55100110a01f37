//! Fits the table of `femto::cost` to counted steps, or compares it with them.
//!
//! ```text
//! cost measure | fit table MACHINE      prints the table as Rust source, for src/cost/table.rs
//! cost measure | fit check MACHINE      compares the crate's own formula with the counts; 1 % is allowed, with the guard 2 %
//! ```
//!
//! The lines are those of [`femto_cases::cost::measure`]. `examples/firmware/fit` runs all of it.

use std::error::Error;
use std::io::{self, BufRead};
use std::process::ExitCode;

use femto::Budget;
use femto::cost::{Coarse, Coupled, Kind, Load, Machine, ROWS, SIZES, Shapes, terms};
use femto_cases::choices::{MORE_STARTS, STARTS};
use nalgebra::{DMatrix, DVector};

/// A counted step.
struct Counted {
    /// Whether the fit may see it.
    fitted: bool,
    load: Load,
    budget: Budget,
    instructions: u64,
}

impl Counted {
    /// 2 for what the guard makes longer, 1 for what other features do, or shapes that are no spheres.
    fn stage(&self) -> u32 {
        let load = &self.load;
        let spheres = load.shapes.spheres;
        let shapes = Shapes {
            spheres,
            ..Shapes::default()
        };
        let more = load.shapes != shapes
            || load.flows
            || load.tears > 0
            || load.coupled != Coupled::default();
        match (load.guarded, more) {
            (true, _) => 2,
            (false, more) => u32::from(more),
        }
    }
}

/// Largest error that is allowed, and with the guard, for which the settings around it were not all measured.
const ALLOWED: [f64; 2] = [0.01, 0.02];

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [mode, name] = arguments.as_slice() else {
        return Err("usage: fit table|check MACHINE < LINES".into());
    };
    let machine = Machine::ALL.iter().find(|(known, _)| known == name);
    let &(_, machine) = machine.ok_or_else(|| format!("no machine is called {name}"))?;
    let lines: Vec<String> = io::stdin().lock().lines().collect::<Result<_, _>>()?;
    let counted: Vec<Counted> = lines
        .iter()
        .map(|line| parse(line).ok_or_else(|| format!("not a counted step: {line}")))
        .collect::<Result<_, _>>()?;
    if !counted.iter().any(|step| step.fitted) || counted.iter().all(|step| step.fitted) {
        return Err("steps to fit and steps to check are needed".into());
    }
    let holds = match mode.as_str() {
        "table" => {
            // First what every build has, then what features add to it, and then the guard to all of that.
            let of_stage = |stage| counted.iter().filter(move |step| step.stage() == stage);
            let mut table = vec![[0; SIZES]; ROWS.len()];
            for steps in [0, 1, 2].map(|stage| of_stage(stage).collect::<Vec<_>>()) {
                let added = fit(&table, &steps)?;
                for (sum, row) in table.iter_mut().flatten().zip(added.iter().flatten()) {
                    *sum += row;
                }
            }
            let constant = name.to_uppercase().replace('-', "_");
            println!("pub(super) const {constant}: Table = [");
            for (row, (name, _)) in table.iter().zip(ROWS) {
                println!("    {row:?}, // {name}");
            }
            println!("];");
            report(name, &counted, |step| of(&table, step))
        }
        "check" => report(name, &counted, |step| {
            step.budget.cost(&step.load, machine) as f64
        }),
        _ => return Err(format!("no such mode: {mode}").into()),
    };
    Ok(ExitCode::from(u8::from(!holds)))
}

/// Says how far a formula is off, and whether that is allowed on steps that were not fitted.
fn report(name: &str, counted: &[Counted], formula: impl Fn(&Counted) -> f64) -> bool {
    let mut holds = true;
    for (what, guarded, allowed) in [
        ("", false, ALLOWED[0]),
        (", with the guard", true, ALLOWED[1]),
    ] {
        let [mut seen, mut unseen] = [(0.0_f64, 0); 2];
        for step in counted.iter().filter(|step| step.load.guarded == guarded) {
            let instructions = step.instructions as f64;
            let error = (formula(step) - instructions).abs() / instructions;
            if error > allowed {
                let percent = 100.0 * error;
                eprintln!("{percent:.2} % off: {:?} {:?}", step.load, step.budget);
            }
            let (worst, steps) = if step.fitted { &mut seen } else { &mut unseen };
            *worst = worst.max(error);
            *steps += 1;
        }
        if guarded && seen.1 + unseen.1 == 0 {
            continue;
        }
        eprintln!(
            "{name}{what}: at most {:.2} % off on {} fitted steps, {:.2} % on {} steps of other meshes",
            100.0 * seen.0,
            seen.1,
            100.0 * unseen.0,
            unseen.1,
        );
        holds &= unseen.0 <= allowed && unseen.1 > 0;
    }
    holds
}

/// What is missing in `table`, in rows that have nothing yet: least squares of the relative error, the smallest
/// coefficients where several sets are as good.
fn fit(table: &[[i32; SIZES]], counted: &[&Counted]) -> Result<Vec<[i32; SIZES]>, Box<dyn Error>> {
    let steps: Vec<&Counted> = counted.iter().filter(|step| step.fitted).copied().collect();
    let open: Vec<bool> = table.iter().map(|row| *row == [0; SIZES]).collect();
    let mut factors = DMatrix::<f64>::zeros(steps.len(), SIZES * ROWS.len());
    for (i, step) in steps.iter().enumerate() {
        let rows = terms(&step.load, step.budget);
        for (row, (factor, (_, depends))) in rows.iter().zip(ROWS).enumerate() {
            for (k, size) in step.load.sizes().into_iter().enumerate() {
                let part = if depends[k] && open[row] {
                    factor * size
                } else {
                    0
                };
                factors[(i, SIZES * row + k)] = part as f64 / step.instructions as f64;
            }
        }
    }
    // Columns that any step has, of one size, so that small ones are not taken for rounding.
    let scales: Vec<f64> = factors.column_iter().map(|c| c.amax()).collect();
    let used: Vec<usize> = (0..scales.len()).filter(|&k| scales[k] > 0.0).collect();
    let mut factors = factors.select_columns(&used);
    for (mut column, &k) in factors.column_iter_mut().zip(&used) {
        column /= scales[k];
    }
    let missing = steps
        .iter()
        .map(|step| 1.0 - of(table, step) / step.instructions as f64);
    let missing = DVector::from_iterator(steps.len(), missing);
    // Relative to the largest singular value; sweeps that do not end would say nothing.
    let svd = factors.try_svd(true, true, 1e-12, 10_000);
    let solution = svd
        .ok_or("the fit does not converge")?
        .solve(&missing, 1e-9)?;
    let mut coefficients = vec![0; scales.len()];
    for (x, &k) in solution.iter().zip(&used) {
        coefficients[k] = (16.0 * x / scales[k]).round() as i32;
    }
    Ok(coefficients.as_chunks().0.to_vec())
}

/// The formula with a table that is not yet the crate's.
fn of(table: &[[i32; SIZES]], step: &Counted) -> f64 {
    let sizes = step.load.sizes();
    let rows = terms(&step.load, step.budget).into_iter().zip(table);
    let parts = rows.flat_map(|(row, coefficients)| {
        let sizes = sizes.into_iter().zip(coefficients);
        sizes.map(move |(size, c)| (row * size) as f64 * f64::from(*c))
    });
    parts.sum::<f64>() / 16.0
}

fn parse(line: &str) -> Option<Counted> {
    let mut words = line.split_ascii_whitespace();
    let fitted = match words.next()? {
        "fit" => true,
        "check" => false,
        _ => return None,
    };
    let mut numbers = [0; 8];
    for number in &mut numbers {
        *number = words.next()?.parse().ok()?;
    }
    let [
        nodes,
        tets,
        fans,
        entries,
        aggregates,
        cut_blocks,
        products,
        sums,
    ] = numbers;
    let [kind, start] = [words.next()?, words.next()?];
    let mut numbers = [0; 20];
    for number in &mut numbers {
        *number = words.next()?.parse().ok()?;
    }
    let [
        k,
        sweeps,
        pins,
        colliders,
        moving,
        forces,
        newmark,
        guarded,
        ..,
    ] = numbers;
    let [
        ..,
        spheres,
        capsules,
        boxes,
        height_fields,
        placed,
        flows,
        tears,
        pieces,
        rigids,
        links,
        slots,
        count,
    ] = numbers;
    let (_, preconditioner) = Kind::ALL.into_iter().find(|(name, _)| *name == kind)?;
    let mut starts = STARTS.iter().chain(&MORE_STARTS);
    let &(_, start) = starts.find(|(name, _)| *name == start)?;
    Some(Counted {
        fitted,
        load: Load {
            fans,
            start,
            preconditioner,
            entries,
            coarse: Coarse {
                aggregates,
                cut_blocks,
                products,
                sums,
            },
            pins,
            colliders,
            moving: moving == 1,
            forces: forces == 1,
            newmark: newmark == 1,
            guarded: guarded == 1,
            shapes: Shapes {
                spheres,
                capsules,
                boxes,
                height_fields,
                placed,
                others: 0,
            },
            flows: flows == 1,
            tears: tears as u32,
            coupled: Coupled {
                pieces,
                rigids,
                links,
                slots,
            },
            ..Load::new(nodes, tets)
        },
        budget: Budget {
            iterations: k as u32,
            polar_sweeps: sweeps as u32,
        },
        instructions: count as u64,
    })
}
