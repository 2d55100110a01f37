//! The folder that a run writes: report.md, CSV files, plots.

use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use crate::plot::Plot;

pub type Done = Result<(), Box<dyn Error>>;

/// Collects the report, writes data and plots as they come.
pub struct Output {
    dir: PathBuf,
    /// Report and SVGs alone, to be kept in the tree.
    small: bool,
    report: String,
}

impl Output {
    pub fn new(dir: &Path, small: bool) -> Result<Self, Box<dyn Error>> {
        fs::create_dir_all(dir).map_err(|e| format!("{}: {e}", dir.display()))?;
        Ok(Self {
            dir: dir.to_path_buf(),
            small,
            report: String::new(),
        })
    }

    /// A paragraph.
    pub fn text(&mut self, text: &str) {
        let _ = writeln!(self.report, "{text}\n");
    }

    /// A table in the report.
    pub fn table(&mut self, header: &[&str], rows: &[Vec<String>]) {
        let mut line = |cells: &[String]| {
            let _ = writeln!(self.report, "| {} |", cells.join(" | "));
        };
        line(&header.iter().map(ToString::to_string).collect::<Vec<_>>());
        line(&vec!["---".to_string(); header.len()]);
        rows.iter().for_each(|row| line(row));
        self.report.push('\n');
    }

    /// Data for other programs.
    pub fn csv(&self, name: &str, header: &[&str], rows: &[Vec<String>]) -> Done {
        if self.small {
            return Ok(());
        }
        let mut file = csv::Writer::from_path(self.dir.join(format!("{name}.csv")))?;
        file.write_record(header)?;
        for row in rows {
            file.write_record(row)?;
        }
        Ok(file.flush()?)
    }

    /// A plot, as SVG in the report and as PNG beside it.
    pub fn plot(&mut self, name: &str, plot: &Plot) -> Done {
        plot.write(&self.dir.join(name), !self.small)?;
        self.text(&format!("![{}]({name}.svg)", plot.title));
        Ok(())
    }

    /// Writes the report as it stands.
    pub fn save(&self) -> Done {
        Ok(fs::write(
            self.dir.join("report.md"),
            self.report.trim_end().to_owned() + "\n",
        )?)
    }
}

/// Two significant digits, as people read them.
pub fn short(x: f64) -> String {
    match x.abs() {
        _ if !x.is_finite() => "lost".into(),
        0.0 => "0".into(),
        a if !(1e-3..1e5).contains(&a) => format!("{x:.1e}"),
        a if a >= 9.95 => format!("{x:.0}"),
        a if a >= 0.995 => format!("{x:.1}"),
        a if a >= 0.0995 => format!("{x:.2}"),
        a if a >= 0.00995 => format!("{x:.3}"),
        _ => format!("{x:.4}"),
    }
}

/// All digits that matter, for CSV.
pub fn exact(x: f64) -> String {
    format!("{x:.6e}")
}
