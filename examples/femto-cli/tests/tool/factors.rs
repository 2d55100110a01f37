//! Scenes that are solved with factors.

use crate::support::{BEAM, Folder, table};
use serde_json::Value;

/// The beam with two iterations a step: its largest residual, and the report.
fn run(preconditioner: &str, more: &str) -> (f64, Value) {
    let solver = format!(
        "[budget]\niterations = 2\n[solver]\npreconditioner = \"{preconditioner}\"\n{more}\n[time]"
    );
    let folder = Folder::new();
    folder.run(&BEAM.replace("[time]", &solver), &[]).succeeds();
    let (_, rows) = table(&folder.read("out/trace.csv"));
    let worst = rows.iter().map(|row| row[5]).fold(0.0, f64::max);
    (worst, folder.report())
}

/// The beam hardly turns and its pins are known to the factor: warped, two iterations leave what the
/// strain and rounding leave.
#[test]
fn factors_solve_in_two_iterations_what_jacobi_does_not() {
    let (jacobi, plain) = run("jacobi", "");
    let (laplacian, small) = run("laplacian", "");
    let (warped, large) = run("warped", "");
    let (dense, _) = run("warped", "layout = \"dense\"");
    assert!(laplacian < jacobi, "{laplacian} {jacobi}");
    assert!(warped < 1e-3 * jacobi, "{warped} {jacobi}");
    assert!(dense < 1e-3 * jacobi, "{dense} {jacobi}");
    let bytes = |report: &Value| report["bytes"]["factor"].as_u64().expect("bytes");
    assert_eq!(bytes(&plain), 0);
    assert!(0 < bytes(&small) && bytes(&small) < bytes(&large));
}

#[test]
fn every_body_has_its_own_factor() {
    let second = r#"
        [[body]]
        mesh = { box = [0.5, 0.5, 0.5], cells = [2, 2, 2] }
        young = 1e6
        poisson = 0.3
        density = 500.0
        translate = [3, 0, 0]
    "#;
    let scene = BEAM.replace("[time]", "[solver]\npreconditioner = \"warped\"\n[time]");
    let (alone, both) = (Folder::new(), Folder::new());
    alone.run(&scene, &[]).succeeds();
    both.run(&(scene + second), &[]).succeeds();
    let first: Vec<String> = both
        .read("out/final.csv")
        .lines()
        .take(21)
        .map(str::to_owned)
        .collect();
    let expected: Vec<String> = alone
        .read("out/final.csv")
        .lines()
        .map(str::to_owned)
        .collect();
    assert_eq!(first, expected);
}
