//! Fits the table of `femto::cost` to counted steps, or compares it with them.
//!
//! ```text
//! cost measure | fit table MACHINE      prints the table as Rust source, for src/cost/table.rs
//! cost measure | fit check MACHINE      compares the crate's own formula with the counts; 1 % is allowed
//! ```
//!
//! The lines are those of [`femto_cases::cost::measure`]. `examples/firmware/fit` runs all of it.

use std::error::Error;
use std::io::{self, BufRead};
use std::process::ExitCode;

use femto::Budget;
use femto::cost::{Coarse, Kind, Load, Machine, ROWS, SIZES, terms};
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

/// Largest error that is allowed.
const ALLOWED: f64 = 0.01;

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
    let worst = match mode.as_str() {
        "table" => {
            let table = fit(&counted)?;
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
    Ok(ExitCode::from(u8::from(worst > ALLOWED)))
}

/// Says how far a formula is off, and returns the largest relative error on steps that were not fitted.
fn report(name: &str, counted: &[Counted], formula: impl Fn(&Counted) -> f64) -> f64 {
    let error = |step: &Counted| {
        let instructions = step.instructions as f64;
        (formula(step) - instructions).abs() / instructions
    };
    let [mut seen, mut unseen] = [0.0_f64; 2];
    for step in counted {
        let worst = if step.fitted { &mut seen } else { &mut unseen };
        if error(step) > ALLOWED {
            eprintln!(
                "{:.2} % off: {:?} {:?}",
                100.0 * error(step),
                step.load,
                step.budget
            );
        }
        *worst = worst.max(error(step));
    }
    let steps = counted.iter().filter(|step| !step.fitted).count();
    eprintln!(
        "{name}: at most {:.2} % off on {} fitted steps, {:.2} % on {steps} steps of other meshes",
        100.0 * seen,
        counted.len() - steps,
        100.0 * unseen,
    );
    unseen
}

/// Least squares of the relative error, the smallest coefficients where several sets are as good.
fn fit(counted: &[Counted]) -> Result<Vec<[i32; SIZES]>, Box<dyn Error>> {
    let steps: Vec<&Counted> = counted.iter().filter(|step| step.fitted).collect();
    let mut factors = DMatrix::zeros(steps.len(), SIZES * ROWS.len());
    for (i, step) in steps.iter().enumerate() {
        let rows = terms(&step.load, step.budget);
        for (row, (factor, (_, depends))) in rows.iter().zip(ROWS).enumerate() {
            for (k, size) in step.load.sizes().into_iter().enumerate() {
                let part = if depends[k] { factor * size } else { 0 };
                factors[(i, SIZES * row + k)] = part as f64 / step.instructions as f64;
            }
        }
    }
    // Columns of one size, so that small ones are not taken for rounding.
    let scales: Vec<f64> = factors
        .column_iter()
        .map(|c| if c.amax() > 0.0 { c.amax() } else { 1.0 })
        .collect();
    for (mut column, scale) in factors.column_iter_mut().zip(&scales) {
        column /= *scale;
    }
    let ones = DVector::from_element(steps.len(), 1.0);
    let solution = factors.svd(true, true).solve(&ones, 1e-9)?;
    let coefficients: Vec<i32> = solution
        .iter()
        .zip(&scales)
        .map(|(x, scale)| (16.0 * x / scale).round() as i32)
        .collect();
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
    let mut numbers = [0; 8];
    for number in &mut numbers {
        *number = words.next()?.parse().ok()?;
    }
    let [k, sweeps, pins, colliders, moving, forces, newmark, count] = numbers;
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
            ..Load::new(nodes, tets)
        },
        budget: Budget {
            iterations: k as u32,
            polar_sweeps: sweeps as u32,
        },
        instructions: count as u64,
    })
}
