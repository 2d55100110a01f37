//! Scenes whose bodies touch, are joined or rigid: that they run, and what is said of bad ones.

use crate::support::{BEAM, Folder, table};

/// Two cubes and a ball that meet in free space; a box hangs on a cube; a spring draws at the other.
const CROWD: &str = r#"
gravity = [0, 0, 0]
[time]
dt = 0.005
steps = 60

[contact]
friction = 0.3
capacity = 200

[[body]]
mesh = { box = [0.2, 0.2, 0.2], cells = [2, 2, 2] }
young = 1e5
poisson = 0.4
density = 1000.0
velocity = [1.0, 0.0, 0.0]

[[body]]
mesh = { box = [0.2, 0.2, 0.2], cells = [2, 2, 2] }
young = 4e5
poisson = 0.3
density = 500.0
friction = 0.6
translate = [0.25, 0.02, 0.0]
velocity = [-1.0, 0.0, 0.0]

[[rigid]]
ball = { radius = 0.05 }
mass = 2.0
translate = [0.1, 0.4, 0.1]
velocity = [0.0, -2.0, 0.0]

[[rigid]]
box = [0.1, 0.05, 0.08]
mass = 1.0
translate = [0.5, 0.1, 0.1]
rotate = { axis = [1, 1, 0], degrees = 30 }

[[attachment]]
a = { body = 1, point = [0.45, 0.12, 0.1] }
b = { rigid = 1, point = [0.45, 0.1, 0.1] }
"#;

const SPRING: &str = r#"
[[spring]]
from = { rigid = 0, point = [0.1, 0.4, 0.1] }
target = [0.1, 0.6, 0.1]
velocity = [0.1, 0.0, 0.0]
stiffness = 300.0
damping = 5.0
"#;

#[test]
fn bodies_touch_and_keep_their_momentum() {
    let folder = Folder::new();
    folder.run(CROWD, &["--frames", "3"]).succeeds();
    let (head, rows) = table(&folder.read("out/trace.csv"));
    let column = |name: &str| head.iter().position(|h| h == name).expect("a column");
    let largest = rows
        .iter()
        .fold(0.0, |most: f64, row| most.max(row[column("contacts")]));
    assert!(largest > 5.0, "{largest} contacts");
    // 8 kg at 1 m/s, 4 kg at −1; the ball's 2 kg at −2 m/s. Rounded at each of 60 steps.
    let last = rows.last().expect("steps");
    for (name, expected) in [("px", 4.0), ("py", -4.0), ("pz", 0.0)] {
        assert!(
            (last[column(name)] - expected).abs() < 1e-4,
            "{name}: {}",
            last[column(name)]
        );
    }
    let energy = |row: &[f64]| row[column("kinetic")] + row[column("elastic")];
    assert!(energy(last) < 0.9 * energy(&rows[0]), "inelastic");
    let (_, nodes) = table(&folder.read("out/final.csv"));
    assert_eq!(nodes.len(), 27 + 27 + 4 + 4);
    assert_eq!(nodes.last().expect("nodes")[0], 3.0);
    // A frame shows the ball and the box, not their four nodes.
    let frame = folder.read("out/frames/frame-00002.vtu");
    assert!(
        frame.contains("NumberOfCells=\"230\""),
        "48 + 48 + 128 + 6 tets"
    );
    let report = folder.report();
    assert_eq!(report["contacts_dropped"], 0);
    assert!(folder.path("out/preview.svg").exists());
}

#[test]
fn every_solver_runs_them() {
    let folder = Folder::new();
    for solver in [
        "preconditioner = \"two-level\"",
        "preconditioner = \"warped\"",
        "preconditioner = \"laplacian\"",
        "layout = \"dense\"",
        "start = \"rigid-2\"",
    ] {
        let scene = format!("{CROWD}{SPRING}\n[solver]\n{solver}\n[budget]\nsubsteps = 2\n");
        folder.run(&scene, &[]).succeeds();
    }
}

#[test]
fn bodies_of_several_materials_and_with_fibres_touch() {
    let folder = Folder::new();
    let scene = CROWD.replace(
        "density = 500.0",
        "density = 500.0\nfibre = { direction = [0, 1, 0], young = 8e5 }\nmaterial = [{ box = [[0.2, 0, 0], [0.36, 1, 1]], density = 2000.0 }]",
    );
    folder
        .run(&format!("{scene}\n[solver]\nlayout = \"dense\"\n"), &[])
        .succeeds();
    let (head, rows) = table(&folder.read("out/trace.csv"));
    let column = |name: &str| head.iter().position(|h| h == name).expect("a column");
    // Half of the second cube weighs four times as much: 10 kg at −1 m/s.
    let last = rows.last().expect("steps");
    let px = last[column("px")];
    assert!((px + 2.0).abs() < 1e-4, "{px}");
    assert!(rows.iter().any(|row| row[column("contacts")] > 5.0));
}

/// One cube is of clay; the other only breaks, and the ball and the box do neither.
#[test]
fn bodies_that_touch_yield_and_break_by_their_own_laws() {
    let folder = Folder::new();
    let laws = [
        ("density = 1000.0", "plasticity = { yield_strain = 0.01 }"),
        (
            "density = 500.0",
            "fracture = { strength = 4e3, per_step = 2 }",
        ),
    ];
    let mut scene = CROWD.to_string();
    for (key, law) in laws {
        scene = scene.replace(key, &format!("{key}\n{law}"));
    }
    folder.run(&scene, &["--frames", "2"]).succeeds();
    let report = folder.report();
    let damage = &report["damage"];
    assert!(damage["dissipated_joules"].as_f64() > Some(0.1), "{damage}");
    let broken = damage["broken_tets"].as_u64().expect("a count");
    assert!(
        broken > 0 && damage["reserve_left"].as_u64() == Some(48 - broken),
        "{damage}"
    );
    let (head, rows) = table(&folder.read("out/trace.csv"));
    let column = |name: &str| head.iter().position(|h| h == name).expect("a column");
    let last = rows.last().expect("steps");
    assert!((last[column("px")] - 4.0).abs() < 1e-4 && (last[column("py")] + 4.0).abs() < 1e-4);
    // Failed tets are left out of the frame, all of them the second cube's; strain is the first's alone.
    let frame = folder.read("out/frames/frame-00001.vtu");
    assert!(frame.contains(&format!("NumberOfCells=\"{}\"", 230 - broken)));
    let list = |name: &str| -> Vec<f64> {
        let (_, rest) = frame
            .split_once(&format!("Name=\"{name}\""))
            .expect("an array");
        let (_, rest) = rest.split_once('>').expect("its head");
        let (numbers, _) = rest.split_once('<').expect("its end");
        let words = numbers.split_whitespace();
        words.map(|x| x.parse().expect("a number")).collect()
    };
    let (strain, body) = (list("plastic_strain"), list("body"));
    assert!(
        strain
            .iter()
            .zip(&body)
            .any(|(p, b)| *b == 0.0 && *p > 0.005)
    );
    assert!(
        strain
            .iter()
            .zip(&body)
            .all(|(p, b)| *b == 0.0 || *p == 0.0)
    );
    assert_eq!(
        body.iter().filter(|b| **b == 1.0).count() as u64,
        48 - broken
    );
}

#[test]
fn edges_touch_where_the_scene_says_so() {
    let folder = Folder::new();
    // A bar that stands on an edge, along x, and one across it that falls: nodes meet nothing.
    let bar = |size: &str, cells: &str, rest: &str| {
        format!(
            "[[body]]\nmesh = {{ box = {size}, cells = {cells} }}\nyoung = 1e6\npoisson = 0.3\ndensity = 1000.0\n{rest}\n"
        )
    };
    let scene = [
        "gravity = [0, 0, 0]\n[time]\ndt = 0.005\nsteps = 80\n[contact]\nedges = EDGES\n",
        &bar("[1.2, 0.1, 0.1]", "[3, 1, 1]", "rotate = { axis = [1, 0, 0], degrees = 45 }\ntranslate = [-0.6, 0.0, 0.0]"),
        &bar("[0.1, 0.1, 1.2]", "[1, 1, 3]", "rotate = { axis = [0, 0, 1], degrees = 45 }\ntranslate = [0.0, 0.16, -0.6]\nvelocity = [0.0, -1.0, 0.0]"),
    ]
    .concat();
    let contacts = |edges: &str| {
        folder.run(&scene.replace("EDGES", edges), &[]).succeeds();
        let (head, rows) = table(&folder.read("out/trace.csv"));
        let column = head.iter().position(|h| h == "contacts").expect("a column");
        rows.iter().map(|row| row[column]).fold(0.0, f64::max)
    };
    assert_eq!(contacts("false"), 0.0);
    assert!(contacts("true") > 0.0);
}

#[test]
fn contacts_without_room_are_reported() {
    let folder = Folder::new();
    let run = folder
        .run(&CROWD.replace("capacity = 200", "capacity = 4"), &[])
        .succeeds();
    assert!(
        run.out.contains("found no room: raise contact.capacity"),
        "{}",
        run.out
    );
    let report = folder.report();
    assert!(report["contacts_dropped"].as_u64() > Some(0));
}

/// What is replaced in the good scene, by what, and how the line that follows begins.
#[rustfmt::skip] // a row stays a row
const ROWS: &[(&str, &str, &str)] = &[
    ("friction = 0.3", "friction = -0.3", "contact.friction = -0.3: must not be negative"),
    ("capacity = 200", "capacity = 1", "contact.capacity = 1: must be at least 2, one for each attachment and spring"),
    ("capacity = 200", "capacity = -1", "line 9, column 12: `capacity = -1`: contact.capacity: invalid value"),
    ("capacity = 200", "room = 3", "line 9, column 1: `room = 3`: contact.room: unknown field `room`"),
    ("capacity = 200", "edges = 1", "line 9, column 9: `edges = 1`: contact.edges: invalid type"),
    ("dt = 0.005", "dt = 0.005\ntheta = 0.5", "time.theta = 0.5: must be 1 where bodies touch or are joined"),
    ("density = 500.0", "density = 500.0\nbeta = 0.01", "body[1].beta = 0.01: must be body[0]'s 0.0"),
    ("translate = [0.25, 0.02, 0.0]", "translate = [1e30, 0, 0]", "body[1].mesh = { box = [0.2, 0.2, 0.2], cells = [2, 2, 2] }: placed and rounded to f32: tetrahedron 0"),
    ("density = 500.0", "density = 1e38\nscale = 1e3", "body[1].mesh = { box = [0.2, 0.2, 0.2], cells = [2, 2, 2] }: the mass or stiffness of tetrahedron 0 is"),
    ("friction = 0.6", "friction = nan", "body[1].friction = NaN: must be finite"),
    ("ball = { radius = 0.05 }", "ball = { radius = 0.0 }", "rigid[0].ball.radius = 0.0: must be above 0"),
    ("ball = { radius = 0.05 }", "ball = { radius = 1e-30 }", "rigid[0] = Ball { radius: 1e-30 } of 2.0 kg: mass and sizes must be positive, in range, and not lost in rounding where it is"),
    ("ball = { radius = 0.05 }", "", "rigid[0]: must have exactly one of ball and box"),
    ("ball = { radius = 0.05 }", "ball = { radius = 0.05 }\nbox = [1, 1, 1]", "rigid[0]: must have exactly one of ball and box"),
    ("box = [0.1, 0.05, 0.08]", "box = [0.1, -0.05, 0.08]", "rigid[1].box = -0.05: must be above 0"),
    ("mass = 2.0", "mass = 0", "rigid[0].mass = 0.0: must be above 0"),
    ("mass = 2.0", "", "line 27, column 1: `[[rigid]]`: rigid[0]: missing field `mass`"),
    ("axis = [1, 1, 0]", "axis = [0, 0, 0]", "rigid[1].rotate.axis = [0.0, 0.0, 0.0]: must not be zero"),
    ("a = { body = 1,", "a = { body = 2,", "attachment[0].a.body = 2: the scene has 2, from 0"),
    ("b = { rigid = 1,", "b = { rigid = 7,", "attachment[0].b.rigid = 7: the scene has 2, from 0"),
    ("a = { body = 1,", "a = { body = 1, rigid = 0,", "attachment[0].a: must have exactly one of body and rigid"),
    ("a = { body = 1,", "a = {", "attachment[0].a: must have exactly one of body and rigid"),
    ("stiffness = 300.0", "stiffness = 0", "spring[0].stiffness = 0.0: must be above 0"),
    ("damping = 5.0", "damping = -5.0", "spring[0].damping = -5.0: must not be negative"),
    ("target = [0.1, 0.6, 0.1]", "target = [0.1, inf, 0.1]", "spring[0].target = [0.1, inf, 0.1]: must be finite"),
    ("density = 500.0", "density = 500.0\nplasticity = { yield_strain = -0.05 }", "body[1].plasticity.yield_strain = -0.05: must not be negative"),
    ("[[attachment]]", "[[attachment]]\ndamping = 1.0", "attachment[0].damping = 1.0: needs a stiffness"),
];

#[test]
fn every_bad_value_is_named() {
    let good = format!("{CROWD}{SPRING}");
    let folder = Folder::new();
    let mut wrong = Vec::new();
    for (from, to, expected) in ROWS {
        assert!(good.contains(from), "{from}");
        folder.write("scene.toml", good.replacen(from, to, 1).as_bytes());
        let run = folder.femto(&["run", "scene.toml", "--out", "out"]);
        let line = run
            .err
            .strip_prefix("error: scene.toml: ")
            .unwrap_or(&run.err);
        if run.status != 2 || run.err.lines().count() != 1 || !line.starts_with(expected) {
            wrong.push(format!(
                "{to}\n  expected {expected}\n  found    {} {line}",
                run.status
            ));
        }
        assert!(!folder.path("out").exists(), "nothing is written");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn friction_needs_contact() {
    let folder = Folder::new();
    let scene = BEAM.replace("density = 1000.0", "density = 1000.0\nfriction = 0.5");
    folder.write("scene.toml", scene.as_bytes());
    let run = folder.femto(&["run", "scene.toml", "--out", "out"]);
    assert_eq!(run.status, 2);
    assert!(
        run.err
            .starts_with("error: scene.toml: body[0].friction = 0.5: bodies touch only"),
        "{}",
        run.err
    );
}

/// A body with fibres has the dense layout, whatever the file says of it, also where bodies touch.
#[test]
fn fibres_count_in_one_system_too() {
    let second = "density = 500.0\n";
    let fibres = "density = 500.0\nfibre = { direction = [1, 0, 0], young = 1e7 }\n";
    let with_fibres = CROWD.replacen(second, fibres, 1);
    let dense = format!("{with_fibres}\n[solver]\nlayout = \"dense\"\n");
    let hash = |scene: &str| {
        let folder = Folder::new();
        folder.run(scene, &[]).succeeds();
        let report = folder.report();
        report["state_hash"].as_str().expect("a hash").to_owned()
    };
    assert_ne!(hash(&with_fibres), hash(CROWD));
    assert_eq!(hash(&with_fibres), hash(&dense));
}
