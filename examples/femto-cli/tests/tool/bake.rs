//! `femto bake`, and `femto info` of what it made.

use crate::support::{BEAM, Folder};
use femto::asset::{Asset, AssetBytes};

/// As `femto bake --rust` wrote it; that this compiles is a part of the test.
#[path = "../golden/cube.rs"]
mod cube;

const CUBE: &str = r#"
[time]
dt = 0.006666666666666667
steps = 1
[solver]
preconditioner = "laplacian"
[[body]]
mesh = { box = [1.0, 1.0, 1.0], cells = [1, 1, 1] }
young = 1e5
poisson = 0.4
density = 1000.0
beta = 0.001
[[body.pin]]
box = [[-1e-6, -1.0, -1.0], [1e-6, 2.0, 2.0]]
"#;

/// The corner tetrahedron of the unit cube.
const NODE: &str = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
const ELE: &str = "1 4 0\n1 1 2 3 4\n";
const MATERIAL: [&str; 8] = [
    "--young",
    "1e6",
    "--poisson",
    "0.3",
    "--density",
    "900",
    "--dt",
    "0.01",
];

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("one.node", NODE);
    folder.write("one.ele", ELE);
    folder
}

fn read(folder: &Folder, name: &str) -> AssetBytes {
    AssetBytes::copy_from(&std::fs::read(folder.path(name)).expect("an asset"))
}

#[test]
fn the_golden_cube_as_bytes_and_as_source() {
    let folder = Folder::new();
    folder.write("cube.toml", CUBE);
    let bake = [
        "bake",
        "--scene",
        "cube.toml",
        "-o",
        "cube.femto",
        "--rust",
        "cube.rs",
    ];
    let run = folder.femto(&bake).succeeds();
    let golden = include_bytes!("../../../../tests/golden/cube.femto");
    assert_eq!(*read(&folder, "cube.femto"), *golden);
    assert_eq!(folder.read("cube.rs"), include_str!("../golden/cube.rs"));

    assert_eq!(cube::BYTES, golden);
    let asset = Asset::new(cube::BYTES).expect("aligned and whole");
    assert_eq!(
        (asset.rest.nodes.len(), asset.rest.blocks.len()),
        (cube::NODES, cube::BLOCKS)
    );
    assert_eq!(
        folder.femto(&["info", "cube.femto"]).succeeds().out,
        run.out
    );
    for part in [
        "femto asset, version 1",
        "nodes         8",
        "tets          6",
        "pins          4",
        "E = 1e5 Pa, ν = 0.4, 1000 kg/m³; α = 0 1/s, β = 0.001 s",
        "dt = 0.006666667 s, theta = 1",
        "laplacian, f32: 5 scalars, 110 bytes",
        "1,088 bytes",
        // 8 nodes of x and v; eight quaternions
        "state 320",
        &format!("{:016x}", asset.rest.header.fingerprint),
    ] {
        assert!(run.out.contains(part), "{part}: {}", run.out);
    }
}

#[test]
fn a_mesh_is_placed_and_pinned_as_in_a_scene() {
    let folder = folder();
    let place = [
        "--scale",
        "2",
        "--rotate",
        "0,0,1,90",
        "--translate",
        "-1,0,0.5",
        "--pin-box",
        "-2,-1,-1,0,1,1",
        "--pin-sphere",
        "-1,2,0.5,0.1",
        "--preconditioner",
        "warped",
        "--precision",
        "f16",
        "--start",
        "rigid-2",
        "--iterations",
        "7",
        "--polar-sweeps",
        "3",
        "--theta",
        "0.5",
        "--alpha",
        "0.25",
    ];
    let bake = [
        &["bake", "one.node", "-o", "one.femto"],
        &MATERIAL[..],
        &place,
    ]
    .concat();
    folder.femto(&bake).succeeds();
    let scene = r#"
        [time]
        dt = 0.01
        steps = 1
        theta = 0.5
        [budget]
        iterations = 7
        polar_sweeps = 3
        [solver]
        preconditioner = "warped"
        start = "rigid-2"
        [[body]]
        mesh = { box = [1.0, 1.0, 1.0], cells = [1, 1, 1] }
        young = 1.0
        poisson = 0.0
        density = 1.0
        [[body]]
        mesh = "one.node"
        young = 1e6
        poisson = 0.3
        density = 900
        alpha = 0.25
        scale = 2
        rotate = { axis = [0, 0, 1], degrees = 90 }
        translate = [-1, 0, 0.5]
        [[body.pin]]
        box = [[-2, -1, -1], [0, 1, 1]]
        [[body.pin]]
        sphere = { centre = [-1, 2, 0.5], radius = 0.1 }
    "#;
    folder.write("two.toml", scene);
    let bake = [
        "bake",
        "--scene",
        "two.toml",
        "--body",
        "1",
        "--precision",
        "f16",
        "-o",
        "two.femto",
    ];
    folder.femto(&bake).succeeds();
    let bytes = read(&folder, "one.femto");
    assert_eq!(*bytes, *read(&folder, "two.femto"));
    let asset = Asset::new(&bytes).expect("an asset");
    // 2 X turned to Y, and moved.
    let node = asset.rest.nodes[1];
    assert_eq!([node[0].round(), node[1], node[2]], [-1.0, 2.0, 0.5]);
    let held: Vec<u32> = asset.pins.iter().map(|pin| pin.node).collect();
    assert_eq!(held, [0, 1]);
    assert_eq!(asset.metadata.source, "one.node");
}

#[test]
fn a_factor_is_thinned() {
    let folder = Folder::new();
    folder.write("cube.toml", CUBE);
    let bytes = |arguments: &[&str]| {
        let bake = [
            "bake",
            "--scene",
            "cube.toml",
            "-o",
            "a.femto",
            "--preconditioner",
            "laplacian",
        ];
        folder.femto(&[&bake[..], arguments].concat()).succeeds();
        let bytes = read(&folder, "a.femto");
        let asset = Asset::new(&bytes).expect("an asset");
        asset.factor.expect("a factor").bytes()
    };
    let all = bytes(&[]);
    assert!(bytes(&["--fill", "2"]) < all);
    assert!(bytes(&["--drop", "0.5"]) < all);
    assert!(bytes(&["--precision", "f16"]) < all);
}

/// What follows a good command, and the line that comes of it.
#[rustfmt::skip] // a row stays a row
const ROWS: &[(&[&str], &str)] = &[
    (&["--theta", "0.3"], "command line: --theta = 0.3: must be from 0.5 to 1"),
    (&["--alpha", "-1"], "command line: --alpha = -1.0: must not be negative"),
    (&["--scale", "0"], "command line: --scale = 0.0: must be above 0"),
    (&["--rotate", "0,0,0,5"], "command line: --rotate = [0.0, 0.0, 0.0]: must not be zero"),
    (&["--translate", "nan,0,0"], "command line: --translate = [NaN, 0.0, 0.0]: must be finite"),
    (&["--translate", "1e30,0,0"], "command line: MESH = \"one.node\": placed and rounded to f32: tetrahedron 0"),
    (&["--start", "rest"], "command line: --start = \"rest\": must be zero, velocity,"),
    (&["--pin-box", "5,5,5,6,6,6"], "command line: --pin-box = [[5.0, 5.0, 5.0], [6.0, 6.0, 6.0]]: holds no node of"),
    (&["--pin-sphere", "0,0,0,-1"], "command line: --pin-sphere = -1.0: must be above 0"),
    (&["--drop", "0.1"], "--drop 0.1: there is no factor without --preconditioner"),
    (&["--drop", "-1", "--preconditioner", "warped"], "--drop -1: must be finite and not negative"),
    (&["--body", "1"], "--body 1: there are no bodies without --scene"),
    (&["--rust", "nowhere/a.rs"], "--rust nowhere/a.rs: cannot be written: "),
];

#[test]
fn bad_input_is_one_line_and_writes_nothing() {
    let folder = folder();
    let fails = |bake: &[&str], line: &str| {
        let run = folder.femto(bake);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{}", run.err);
        assert!(
            run.err.starts_with(&format!("error: {line}")),
            "{}",
            run.err
        );
        assert!(!folder.path("a.femto").exists(), "{line}");
        run.err.lines().count()
    };
    let good = [&["bake", "one.node", "-o", "a.femto"], &MATERIAL[..]].concat();
    for (arguments, line) in ROWS {
        assert_eq!(fails(&[&good, *arguments].concat(), line), 1);
    }
    let no_mesh = [&["bake", "two.node", "-o", "a.femto"], &MATERIAL[..]].concat();
    fails(
        &no_mesh,
        "command line: MESH = \"two.node\": cannot be read",
    );
    folder.write("cube.toml", CUBE);
    let scene = ["bake", "--scene", "cube.toml", "-o", "a.femto"];
    let body = [&scene[..], &["--body", "1"]].concat();
    fails(&body, "--body 1: the scene has one body, 0");
    folder.write(
        "cube.toml",
        CUBE.replace("[solver]", "[solver]\nlayout = \"dense\""),
    );
    fails(
        &scene,
        "cube.toml: solver.layout = \"dense\": assets have the factored layout",
    );
    // What clap finds has more lines.
    for arguments in [
        &["--pin-box", "1,2"][..],
        &["--precision", "f64"],
        &["--scene", "cube.toml"],
    ] {
        fails(&[&good, arguments].concat(), "");
    }
}

#[test]
fn a_damaged_asset_is_named() {
    let folder = folder();
    let mut bytes = include_bytes!("../../../../tests/golden/cube.femto").to_vec();
    bytes[700] ^= 4;
    folder.write("bad.femto", &bytes);
    let run = folder.femto(&["info", "bad.femto"]);
    assert_eq!(run.status, 2);
    let line = "error: bad.femto: was changed: its checksum is ";
    assert!(run.err.starts_with(line), "{}", run.err);
}

#[cfg(unix)]
#[test]
fn half_an_asset_is_none() {
    let folder = Folder::new();
    folder.write("beam.toml", BEAM.replace("[4, 1, 1]", "[8, 2, 2]"));
    for option in ["--out", "--rust"] {
        let run = folder.femto_on_a_full_disk(&["bake", "--scene", "beam.toml", option, "half"]);
        let line = format!("error: {option} half: cannot be written: ");
        assert!(run.err.starts_with(&line), "{}", run.err);
        assert_eq!((run.status, run.err.lines().count()), (2, 1));
        assert!(!folder.path("half").exists());
    }
}
