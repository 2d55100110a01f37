//! The tables, and the targets that they are held against.

use femto::lane::{Lanes, Native};

use crate::kernels::{FACTORED, TWO_SWEEPS};
use crate::{BASELINE, FACTORS, IN_LANES, PLAIN, REFILL};
use femto_bench::clock::Kernel;

/// Seconds per run on one mesh, by row and lane width.
pub struct Table {
    tets: usize,
    rows: Vec<(&'static str, [Option<f64>; 3])>,
}

const WIDTHS: [usize; 3] = [1, 4, 8];

impl Table {
    pub fn new(tets: usize, kernels: &[Kernel<'_>], seconds: &[f64]) -> Self {
        let mut rows: Vec<(&str, [Option<f64>; 3])> = Vec::new();
        for (kernel, &seconds) in kernels.iter().zip(seconds) {
            let at = rows
                .iter()
                .position(|(name, _)| *name == kernel.row)
                .unwrap_or_else(|| {
                    rows.push((kernel.row, [None; 3]));
                    rows.len() - 1
                });
            let column = WIDTHS.iter().position(|&width| width == kernel.lanes);
            rows[at].1[column.expect("a known width")] = Some(seconds);
        }
        Self { tets, rows }
    }

    /// Seconds of a row at a lane width.
    fn get(&self, row: &str, lanes: usize) -> f64 {
        let found = self.rows.iter().find(|(name, _)| *name == row);
        let column = WIDTHS.iter().position(|&width| width == lanes);
        found
            .zip(column)
            .and_then(|((_, times), column)| times[column])
            .expect("a row that was timed")
    }

    /// The faster of the two block-CSR products.
    fn product(&self) -> f64 {
        self.get(PLAIN, 1).min(self.get(IN_LANES, 1))
    }

    pub fn print(&self) {
        let per_tet = 1e9 / self.tets as f64;
        println!(
            "{:38}{:>24}{:>30}",
            "", "ratio to CSR product", "ns a tetrahedron"
        );
        print!("{:38}", "");
        for _ in 0..2 {
            print!("{:>9}{:>9}{:>9}   ", "f32", "f32x4", "f32x8");
        }
        println!();
        let cell = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.2}"));
        for (name, times) in &self.rows {
            print!("{name:38}");
            for scale in [1.0 / self.product(), per_tet] {
                let [a, b, c] = times.map(|t| cell(t.map(|t| t * scale)));
                print!("{a:>9}{b:>9}{c:>9}   ");
            }
            println!();
        }
        let apply = self.get(FACTORED.apply, Native::WIDTH);
        for (row, _) in FACTORS {
            if self.rows.iter().any(|(name, _)| *name == row) {
                println!("{row:38}{:>9.2} applies", self.get(row, 1) / apply);
            }
        }
        // Assembling pays after so many products.
        print!("{:38}", "break-even iterations, factored");
        for width in WIDTHS {
            let lost = self.get(FACTORED.apply, width) - self.product();
            let text = if lost > 0.0 {
                format!("{:.0}", self.get(REFILL, 1) / lost)
            } else {
                "never".into()
            };
            print!("{text:>9}");
        }
        println!();
    }
}

/// Prints each target with what was measured, and returns whether all were met.
pub fn targets(tables: &[Table]) -> bool {
    println!();
    let mut met = true;
    let mut target = |what: &str, measured: f64, good: bool| {
        met &= good;
        println!(
            "target: {what}; measured {measured:.2}: {}",
            if good { "ok" } else { "MISSED" }
        );
    };
    let [_, small, middle, large] = tables else {
        return false;
    };
    let native = Native::WIDTH;
    let worst = |f: &dyn Fn(&Table) -> f64| tables.iter().map(f).fold(0.0, f64::max);

    // The product as a compiler makes it; one written by hand in lanes is the harder rival.
    let limit = match native {
        8 => 0.9,
        4 => 1.8,
        _ => f64::INFINITY,
    };
    let apply = middle.get(FACTORED.apply, native) / middle.get(PLAIN, 1);
    target(
        &format!(
            "factored apply in {native} lanes at most {limit} plain block-CSR products (25 k)"
        ),
        apply,
        apply <= limit,
    );
    println!(
        "        the same in block-CSR products in lanes: {:.2}",
        middle.get(FACTORED.apply, native) / middle.product()
    );
    let sweeps = worst(&|t| t.get(TWO_SWEEPS, native) / t.get(FACTORED.apply, native));
    target(
        "two polar sweeps at most 8 applies (worst mesh)",
        sweeps,
        sweeps <= 8.0,
    );
    let slower = worst(&|t| t.get(FACTORED.step, native) / t.get(BASELINE, 1));
    target(
        "a step at least 10 times as fast as the baseline's (worst mesh)",
        1.0 / slower,
        slower <= 0.1,
    );
    for (what, row) in [("apply", FACTORED.apply), ("step", FACTORED.step)] {
        let costs = [small, middle, large].map(|t| t.get(row, native) / t.tets as f64);
        let (least, most) = costs
            .iter()
            .fold((f64::MAX, 0.0_f64), |(l, m), &c| (l.min(c), m.max(c)));
        let what = format!("cost of {what} per tetrahedron flat within 1.2 from 3 k to 80 k");
        target(&what, most / least, most / least <= 1.2);
    }
    met
}
