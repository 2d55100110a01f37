//! Colliders, loads and turning pins of scene files: what they do, seen in the results.

use crate::support::{BEAM, Folder, table};

/// A cube of side 0.5 above the origin.
const CUBE: &str = r#"
[time]
dt = 0.01
steps = 60
[[body]]
mesh = { box = [0.5, 0.5, 0.5], cells = [2, 2, 2] }
young = 1e5
poisson = 0.3
density = 500.0
translate = [-0.25, 0.05, -0.25]
"#;

fn last_rows(folder: &Folder) -> Vec<Vec<f64>> {
    table(&folder.read("out/final.csv")).1
}

fn mean(rows: &[Vec<f64>], column: usize) -> f64 {
    rows.iter().map(|row| row[column]).sum::<f64>() / rows.len() as f64
}

/// Every solid holds the cube, whose weight it would fall by 1.7 m with, and is drawn.
#[test]
fn every_shape_holds_a_body_up() {
    for shape in [
        "box = { centre = [0, -1, 0], size = [4, 2, 4] }",
        "box = { centre = [0, -1, 0], size = [2, 4, 4], rotate = { axis = [0, 0, 1], degrees = 90 } }",
        "capsule = { from = [-0.1, -1, -0.2], to = [0.1, -1, 0.2], radius = 1 }",
        "height_field = { corner = [-2, 0, -2], spacing = [2, 2], heights = [[0, 0, 0], [0, 0, 0], [0, 0, 0]] }",
        "sphere = { centre = [0, -2, 0], radius = 2 }\nangular_velocity = [0, 0.5, 0]",
        "plane = { normal = [0, 1, 0] }\nangular_velocity = [0, 0.5, 0]",
    ] {
        let folder = Folder::new();
        let scene = format!("{CUBE}[[collider]]\n{shape}\nfriction = 0.8\n");
        folder.run(&scene, &[]).succeeds();
        let rows = last_rows(&folder);
        let lowest = rows.iter().fold(f64::INFINITY, |y, row| y.min(row[3]));
        assert!(lowest > -0.1, "{shape}: {lowest}");
        let (_, trace) = table(&folder.read("out/trace.csv"));
        assert!(trace.last().is_some_and(|row| row[13] > 0.0), "{shape}");
        let drawn = folder
            .read("out/preview.svg")
            .matches("class=\"c6-")
            .count();
        assert_eq!(drawn > 0, !shape.contains("plane"), "{shape}: {drawn}");
    }
}

/// A table that turns takes the cube round; a box moved under it takes it along.
#[test]
fn motion_of_colliders_is_felt() {
    for (motion, column, speed) in [
        (
            "angular_velocity = [0, 1.0, 0]\npivot = [-1, 0, 0]",
            7,
            -1.0,
        ),
        ("velocity = [0.5, 0, 0]", 5, 0.5),
    ] {
        let folder = Folder::new();
        let scene = CUBE.replace("steps = 60", "steps = 45");
        let scene = format!(
            "{scene}[[collider]]\nbox = {{ centre = [0, -1, 0], size = [9, 2, 9] }}\nfriction = 1.0\n{motion}\n"
        );
        folder.run(&scene, &[]).succeeds();
        let found = mean(&last_rows(&folder), column);
        assert!((found - speed).abs() < 0.25, "{motion}: {found}");
    }
}

#[test]
fn loads_act() {
    let calm = CUBE.replacen("[time]", "gravity = [0, 0, 0]\n[time]", 1);
    let width = |rows: &[Vec<f64>]| {
        let xs = || rows.iter().map(|row| row[2]);
        xs().fold(f64::NEG_INFINITY, f64::max) - xs().fold(f64::INFINITY, f64::min)
    };
    // ε = p (1 − 2ν)/E; the gas gives up 3ε of its pressure.
    for (load, expected) in [
        ("[[pressure]]\npascals = 2000\n", 0.008),
        ("[[pressure]]\npascals = 2000\noutside = 4000\n", -0.008),
        (
            "[[pressure]]\npascals = 1e5\ngas = true\noutside = 9.8e4\n",
            0.008 / 2.2,
        ),
    ] {
        let folder = Folder::new();
        let damped = calm.replace("density = 500.0", "density = 500.0\nalpha = 30.0");
        folder.run(&format!("{damped}{load}"), &[]).succeeds();
        let rows = last_rows(&folder);
        let strain = width(&rows) / 0.5 - 1.0;
        assert!(
            (strain / expected - 1.0).abs() < 0.03,
            "{load}: {strain} of {expected}"
        );
        assert!(mean(&rows, 5).abs() < 1e-4);
    }
    let folder = Folder::new();
    folder
        .run(&format!("{calm}[[wind]]\nvelocity = [20, 0, 0]\n"), &[])
        .succeeds();
    // ρ A u² t / m
    let exact = 1.2 * 0.25 * 400.0 * 0.6 / 62.5;
    let found = mean(&last_rows(&folder), 5);
    assert!((found / exact - 1.0).abs() < 0.15, "{found} of {exact}");
}

/// One end held by pins that turn: after a quarter turn its nodes are there.
#[test]
fn pins_follow_a_turning_frame() {
    let folder = Folder::new();
    let rate = std::f64::consts::FRAC_PI_2 / 0.6;
    let scene = CUBE
        .replacen("[time]", "gravity = [0, 0, 0]\n[time]", 1)
        .replace("young = 1e5", "young = 1e4");
    let pin = format!(
        "[[body.pin]]\nbox = [[-0.3, -1, -1], [-0.24, 1, 1]]\nangular_velocity = [0, {rate:?}, 0]\npivot = [0, 0, 0]\n"
    );
    folder.run(&format!("{scene}{pin}"), &[]).succeeds();
    // About y by 90°: (x, z) goes to (z, −x).
    let pinned: Vec<_> = last_rows(&folder).into_iter().take(9).collect();
    for (node, row) in pinned.iter().enumerate() {
        let z = -0.25 + 0.25 * (node % 3) as f64;
        assert!(
            (row[2] - z).abs() < 1e-5 && (row[4] - 0.25).abs() < 1e-5,
            "{row:?}"
        );
    }
}

/// However many colliders there are, a picture shows a number of them that can be drawn, and says so.
#[test]
fn a_picture_of_many_colliders_has_some() {
    let folder = Folder::new();
    let far =
        |i: usize| format!("[[collider]]\nbox = {{ centre = [{i}, -9, 0], size = [1, 1, 1] }}\n");
    let many: String = (0..501).map(far).collect();
    let scene = BEAM.replace("steps = 10", "steps = 0");
    folder.run(&format!("{scene}\n{many}"), &[]).succeeds();
    let picture = folder.read("out/preview.svg");
    assert!(picture.contains("only 500 of 501 colliders"));
}
