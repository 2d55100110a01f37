//! Scenes of several materials, with fibres, that yield and that break.

use crate::support::{Folder, table};
use serde_json::Value;

const BAR: &str = r#"
gravity = [0, 0, 0]
[time]
dt = 0.01
steps = 60
[budget]
iterations = 30

[[body]]
mesh = { box = [1.0, 0.25, 0.25], cells = [8, 1, 1] }
young = 1e5
poisson = 0.0
density = 100.0
beta = 0.02

[[body.pin]]
box = [[-1e-6, -1.0, -1.0], [1e-6, 1.0, 1.0]]
[[body.pin]]
box = [[0.999, -1.0, -1.0], [1.001, 1.0, 1.0]]
velocity = [0.1, 0.0, 0.0]
"#;

/// Final x of the nodes at a rest x, which the pins have stretched evenly where the material is even.
fn middle(folder: &Folder) -> f64 {
    let (_, rows) = table(&folder.read("out/final.csv"));
    // Node (i, j, k) of 9 × 2 × 2: i = 4 is the middle.
    rows[16..20].iter().map(|row| row[2]).sum::<f64>() / 4.0
}

fn with(part: &str) -> String {
    BAR.replacen("\n[[body.pin]]", &format!("\n{part}\n[[body.pin]]"), 1)
}

#[test]
fn regions_have_their_own_materials() {
    let folder = Folder::new();
    folder.run(BAR, &[]).succeeds();
    assert!((middle(&folder) - 0.53).abs() < 1e-3, "{}", middle(&folder));
    // The far half is three times as stiff: of 0.06 m, three quarters in the near one.
    let half = "[[body.material]]\nbox = [[0.5, -1, -1], [2, 1, 1]]\nyoung = 3e5";
    folder.run(&with(half), &[]).succeeds();
    assert!(
        (middle(&folder) - 0.545).abs() < 1e-3,
        "{}",
        middle(&folder)
    );
    // Of two, the later counts; this one takes all of it back.
    let both =
        format!("{half}\n[[body.material]]\nsphere = {{ centre = [0.5, 0, 0], radius = 5 }}");
    folder.run(&with(&both), &[]).succeeds();
    assert!((middle(&folder) - 0.53).abs() < 1e-3, "{}", middle(&folder));
    // Fibres along the far half do the same, in the dense layout, and with factors.
    let fibres = half.replace(
        "young = 3e5",
        "fibre = { direction = [2, 0, 0], young = 3e5 }",
    );
    for solver in ["jacobi", "warped", "laplacian", "two-level"] {
        let solver = format!("[solver]\npreconditioner = \"{solver}\"\n[budget]");
        folder
            .run(&with(&fibres).replace("[budget]", &solver), &[])
            .succeeds();
        assert!(
            (middle(&folder) - 0.545).abs() < 1e-3,
            "{}",
            middle(&folder)
        );
    }
    // Turned with the body: along y of a mesh that is turned onto x.
    let turned = fibres.replace("[2, 0, 0]", "[0, -2, 0]");
    let turned = with(&turned)
        .replace(
            "box = [1.0, 0.25, 0.25], cells = [8, 1, 1]",
            "box = [0.25, 1.0, 0.25], cells = [1, 8, 1]",
        )
        .replace(
            "beta = 0.02",
            "beta = 0.02\nrotate = { axis = [0, 0, 1], degrees = -90 }",
        );
    folder.run(&turned, &[]).succeeds();
    let (_, rows) = table(&folder.read("out/final.csv"));
    // Nodes (i, 4, k) of 2 × 9 × 2.
    let x = (rows[8][2] + rows[9][2] + rows[26][2] + rows[27][2]) / 4.0;
    assert!((x - 0.545).abs() < 1e-3, "{x}");
}

#[test]
fn volumes_of_a_mesh_are_regions() {
    let folder = Folder::new();
    // Two tets that share a face, in the volumes 7 and 9.
    folder.write(
        "two.msh",
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
        $Nodes\n1 5 1 5\n3 7 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n\
        $Elements\n2 2 1 2\n3 7 4 1\n1 1 2 3 4\n3 9 4 1\n2 2 3 4 5\n$EndElements\n",
    );
    let scene = |volume: &str| {
        format!(
            "[time]\ndt = 0.01\nsteps = 1\n[[body]]\nmesh = \"two.msh\"\nyoung = 1e5\npoisson = 0.3\n\
        density = 600.0\n[[body.material]]\nvolume = {volume}\ndensity = 6.0\n"
        )
    };
    folder.run(&scene("9"), &[]).succeeds();
    let potential = |folder: &Folder| {
        folder.report()["energy"]["first"]["potential"]
            .as_f64()
            .unwrap()
    };
    // m g y: volumes 1/6 and 1/3, centres of mass at y = 1/4 and 1/2.
    let heavy = 9.81 * 600.0 / 24.0;
    assert!((potential(&folder) - heavy - 9.81).abs() < 1e-3);
    folder.run(&scene("7"), &[]).succeeds();
    assert!((potential(&folder) - heavy / 100.0 - 981.0).abs() < 1e-2);
    let line = refused(&folder, &scene("8"));
    assert_eq!(
        line,
        "scene.toml: body[0].material[0].volume = 8: no tet of the mesh is in this volume"
    );
}

fn refused(folder: &Folder, scene: &str) -> String {
    let run = folder.run(scene, &[]);
    assert_eq!(run.status, 2, "{}", run.err);
    run.err.trim_end().trim_start_matches("error: ").to_owned()
}

#[test]
fn what_yields_stays_and_is_reported() {
    let folder = Folder::new();
    let law = "[body.plasticity]\nyield_strain = 0.02\nlimit = 0.5";
    folder.run(&with(law), &["--frames", "2"]).succeeds();
    let first = folder.report();
    assert!(first["damage"]["dissipated_joules"].as_f64().unwrap() > 0.1);
    assert_eq!(first["damage"]["broken_tets"], 0);
    assert_eq!(first["damage"]["reserve_left"], Value::Null);
    assert!(
        folder
            .read("out/frames/frame-00001.vtu")
            .contains("\"plastic_strain\"")
    );
    // Without it, neither.
    folder.run(BAR, &["--frames", "2"]).succeeds();
    assert!(folder.report().get("damage").is_none());
    assert!(
        !folder
            .read("out/frames/frame-00001.vtu")
            .contains("\"plastic_strain\"")
    );
}

#[test]
fn what_breaks_is_counted_and_left_out() {
    let folder = Folder::new();
    let law = "[body.fracture]\nstrength = 5e3\nper_step = 3\nreserve = 20";
    folder.run(&with(law), &["--frames", "2"]).succeeds();
    // One cell of six tets goes, and holds nothing any more.
    let damage = folder.report()["damage"].clone();
    assert_eq!(
        (
            damage["broken_tets"].as_u64(),
            damage["reserve_left"].as_u64()
        ),
        (Some(6), Some(14))
    );
    assert!(
        folder
            .read("out/frames/frame-00000.vtu")
            .contains("NumberOfCells=\"48\"")
    );
    assert!(
        folder
            .read("out/frames/frame-00001.vtu")
            .contains("NumberOfCells=\"42\"")
    );
    // Run again, the same bits.
    let hash = folder.report()["state_hash"].clone();
    folder.run(&with(law), &[]).succeeds();
    assert_eq!(folder.report()["state_hash"], hash);
}

/// The scenes that come with the tool.
#[test]
fn clay_stays_flat_and_the_strip_is_torn_in_two() {
    let folder = Folder::new();
    let scene = |name: &str| format!("{}/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    folder
        .femto(&["run", &scene("clay"), "--out", "out"])
        .succeeds();
    let (_, rows) = table(&folder.read("out/final.csv"));
    let top = rows.iter().map(|row| row[3]).fold(0.0, f64::max);
    let speed = rows
        .iter()
        .flat_map(|row| &row[5..8])
        .fold(0.0_f64, |most, v| most.max(v.abs()));
    // A ball of 0.6 m, at rest, long after what pressed it has gone.
    assert!(top < 0.45 && speed < 0.02, "{top} {speed}");
    assert!(folder.report()["damage"]["dissipated_joules"].as_f64() > Some(100.0));

    folder
        .femto(&["run", &scene("tear"), "--out", "out"])
        .succeeds();
    let damage = folder.report()["damage"].clone();
    assert!(damage["broken_tets"].as_u64() > Some(20) && damage["reserve_left"].as_u64() > Some(0));
    // Nothing pulls any more.
    assert!(folder.report()["energy"]["last"]["elastic"].as_f64() < Some(0.1));
}

#[test]
fn assets_have_no_fibres() {
    let folder = Folder::new();
    folder.write(
        "scene.toml",
        with("[body.fibre]\ndirection = [1, 0, 0]\nyoung = 3e5"),
    );
    let run = folder.femto(&["bake", "--scene", "scene.toml", "--out", "bar.femto"]);
    assert_eq!(run.status, 2);
    assert!(
        run.err
            .contains("body[0]: has fibres, and assets have the factored layout"),
        "{}",
        run.err
    );
    // Several materials are fine.
    folder.write(
        "scene.toml",
        with("[[body.material]]\nbox = [[0.5, -1, -1], [2, 1, 1]]\nyoung = 3e5"),
    );
    folder
        .femto(&["bake", "--scene", "scene.toml", "--out", "bar.femto"])
        .succeeds();
}

/// What has failed has no det F; where all has, there is none to write.
#[test]
fn a_body_that_is_all_in_pieces_has_no_det() {
    let folder = Folder::new();
    let law = "[body.fracture]\nstrength = 1.0\nper_step = 16";
    folder.run(&with(law), &[]).succeeds();
    let trace = folder.read("out/trace.csv");
    let dets: Vec<&str> = trace
        .lines()
        .filter_map(|row| row.split(',').nth(12))
        .collect();
    let (first, last) = (dets[1], dets[dets.len() - 1]);
    assert!(first.parse::<f64>().is_ok_and(f64::is_finite), "{first}");
    assert_eq!(last, "");
}
