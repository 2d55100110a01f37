//! `femto run` on good scenes: every file, and that the numbers in them agree.

use crate::support::{BEAM, Folder, free_beam, table};
use serde_json::Value;

fn hash(folder: &Folder) -> String {
    folder.report()["state_hash"]
        .as_str()
        .expect("text")
        .to_owned()
}

/// FNV-1a over x, then v, of each body in turn, from the numbers in final.csv.
fn hash_of_final(folder: &Folder) -> String {
    let (_, rows) = table(&folder.read("out/final.csv"));
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let bodies = rows.last().map_or(0, |r| r[0] as usize + 1);
    for body in 0..bodies {
        for columns in [2..5, 5..8] {
            for row in rows.iter().filter(|r| r[0] as usize == body) {
                for byte in row[columns.clone()]
                    .iter()
                    .flat_map(|x| (*x as f32).to_le_bytes())
                {
                    hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
                }
            }
        }
    }
    format!("{hash:016x}")
}

#[test]
fn a_run_writes_all_its_files() {
    let folder = Folder::new();
    let run = folder.run(BEAM, &[]).succeeds();
    assert!(
        run.out.contains("20 nodes, 24 tets, 10 steps"),
        "{}",
        run.out
    );

    let text = folder.read("out/final.csv");
    let (head, rows) = table(&text);
    assert_eq!(head.join(","), "body,node,x,y,z,vx,vy,vz");
    assert_eq!(rows.len(), 20);
    for (node, row) in rows.iter().enumerate() {
        assert_eq!((row[0], row[1]), (0.0, node as f64));
    }
    // Nine significant digits: d.dddddddde±x.
    for field in text
        .lines()
        .skip(1)
        .flat_map(|line| line.split(',').skip(2))
    {
        let digits = field
            .split('e')
            .next()
            .expect("a mantissa")
            .trim_start_matches('-');
        assert_eq!(digits.len(), 10, "{field}");
    }
    // The pinned end is where it was, the other has fallen.
    assert_eq!(rows[0][2..5], [0.0, 0.0, 0.0]);
    assert!(rows[16][3] < -1e-3, "{:?}", rows[16]);

    let (head, rows) = table(&folder.read("out/trace.csv"));
    assert_eq!(
        head.join(","),
        "step,time,kinetic,elastic,potential,residual,px,py,pz,lx,ly,lz,min_det,contacts"
    );
    assert_eq!(rows.len(), 10);
    for (i, row) in rows.iter().enumerate() {
        let step = (i + 1) as f64;
        assert_eq!((row[0], row[1]), (step, step * 0.01));
        assert!(row[5] > 0.0 && row[5] < 1.0, "residual {}", row[5]);
        assert!(row[12] > 0.5 && row[12] <= 1.1, "min_det {}", row[12]);
        assert_eq!(row[13], 0.0);
    }

    let report = folder.report();
    assert_eq!(report["nodes"], 20);
    assert_eq!(report["tets"], 24);
    assert_eq!(report["steps_run"], 10);
    assert_eq!(report["ended"], "completed");
    assert_eq!(report["budget"]["iterations"], 5);
    assert_eq!(report["budget"]["polar_sweeps"], 2);
    assert_eq!(report["budget"]["substeps"], 1);
    assert_eq!(report["solver"]["preconditioner"], "jacobi");
    assert_eq!(report["solver"]["start"], "galerkin-1");
    assert_eq!(report["solver"]["layout"], "factored");
    assert_eq!(report["crate_version"], env!("CARGO_PKG_VERSION"));
    for part in ["rest", "state", "workspace"] {
        assert!(report["bytes"][part].as_u64().expect("bytes") > 0, "{part}");
    }
    let last = &report["energy"]["last"];
    let row = &rows[9];
    for (name, column) in [("kinetic", 2), ("elastic", 3), ("potential", 4)] {
        assert_eq!(last[name].as_f64(), Some(row[column]), "{name}");
    }
    assert_eq!(last["total"].as_f64(), Some(row[2] + row[3] + row[4]));
    assert_eq!(report["energy"]["first"]["kinetic"], 0.0);
    let seconds = &report["seconds_per_step"];
    assert!(
        seconds["min"].as_f64() > Some(0.0)
            && seconds["median"].as_f64() >= seconds["min"].as_f64()
    );

    let svg = folder.read("out/preview.svg");
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
    for label in [
        "kinetic",
        "elastic",
        "potential",
        "total",
        "t = 0 s",
        "t = 0.1 s",
        "scene.toml",
    ] {
        assert!(svg.contains(label), "{label}");
    }
    assert!(!folder.path("out/frames").exists());
}

#[test]
fn the_hash_is_that_of_the_final_state_and_repeats() {
    let folder = Folder::new();
    let two = format!(
        "{BEAM}{}",
        BEAM.split_once("[[body]]")
            .expect("a body")
            .1
            .replacen("mesh", "[[body]]\nmesh", 1)
    );
    folder.run(&two, &["--quiet"]).succeeds();
    let first = hash(&folder);
    assert_eq!(first.len(), 16);
    assert_eq!(first, hash_of_final(&folder));
    let text = folder.read("out/final.csv");
    folder.run(&two, &["--quiet"]).succeeds();
    assert_eq!(hash(&folder), first);
    assert_eq!(folder.read("out/final.csv"), text);
}

#[test]
fn quiet_prints_nothing() {
    let folder = Folder::new();
    assert_eq!(folder.run(BEAM, &["--quiet"]).succeeds().out, "");
}

#[test]
fn no_steps_gives_the_start() {
    let folder = Folder::new();
    folder
        .run(&BEAM.replace("steps = 10", "steps = 0"), &["--frames", "1"])
        .succeeds();
    let (head, rows) = table(&folder.read("out/trace.csv"));
    assert_eq!((head.len(), rows.len()), (14, 0));
    let (_, rows) = table(&folder.read("out/final.csv"));
    assert_eq!(rows[19][2..8], [1.0, 0.25, 0.25, 0.0, 0.0, 0.0]);
    let report = folder.report();
    assert_eq!(report["seconds_per_step"]["median"], Value::Null);
    assert_eq!(report["energy"]["first"], report["energy"]["last"]);
}

#[test]
fn frames_are_numbered_and_listed_with_their_times() {
    let folder = Folder::new();
    folder.run(BEAM, &["--frames", "11"]).succeeds();
    folder.run(BEAM, &["--frames", "3"]).succeeds(); // takes the old ones away
    let mut names: Vec<String> = folder
        .path("out/frames")
        .read_dir()
        .expect("a folder")
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .into_string()
                .expect("UTF-8")
        })
        .collect();
    names.sort();
    assert_eq!(
        names,
        [
            "frame-00000.vtu",
            "frame-00001.vtu",
            "frame-00002.vtu",
            "frames.pvd"
        ]
    );
    let list = folder.read("out/frames/frames.pvd");
    for (time, file) in [
        ("0", "frame-00000.vtu"),
        ("0.05", "frame-00001.vtu"),
        ("0.1", "frame-00002.vtu"),
    ] {
        assert!(
            list.contains(&format!("timestep=\"{time}\" part=\"0\" file=\"{file}\"")),
            "{list}"
        );
    }

    // The last frame is the final state.
    let frame = folder.read("out/frames/frame-00002.vtu");
    assert!(frame.contains("NumberOfPoints=\"20\" NumberOfCells=\"24\""));
    let array = |name: &str| -> Vec<f64> {
        let from = frame.find(&format!("Name=\"{name}\"")).expect(name);
        let text = frame[from..]
            .split_once('>')
            .expect("a tag")
            .1
            .split_once('<')
            .expect("an end")
            .0;
        text.split_whitespace()
            .map(|number| number.parse().expect("a number"))
            .collect()
    };
    let (_, rows) = table(&folder.read("out/final.csv"));
    let column = |range: std::ops::Range<usize>| -> Vec<f32> {
        rows.iter()
            .flat_map(|r| r[range.clone()].iter().map(|x| *x as f32))
            .collect()
    };
    let single = |numbers: Vec<f64>| numbers.into_iter().map(|x| x as f32).collect::<Vec<_>>();
    assert_eq!(single(array("position")), column(2..5));
    assert_eq!(single(array("velocity")), column(5..8));
    assert_eq!(array("connectivity").len(), 4 * 24);
    assert_eq!(array("offsets").last(), Some(&96.0));
    assert!(array("types").iter().all(|t| *t == 10.0));
}

#[test]
fn both_layouts_and_all_starts_run() {
    let folder = Folder::new();
    for layout in ["factored", "dense"] {
        for start in [
            "zero",
            "velocity",
            "galerkin-0",
            "galerkin-3",
            "rigid-0",
            "rigid-2",
        ] {
            for preconditioner in ["identity", "mass", "jacobi", "block-jacobi", "two-level"] {
                let solver = format!(
                    "[solver]\nlayout = \"{layout}\"\nstart = \"{start}\"\npreconditioner = \"{preconditioner}\"\n"
                );
                folder.run(&(solver + BEAM), &["--quiet"]).succeeds();
            }
        }
    }
}

#[test]
fn substeps_divide_a_step() {
    let folder = Folder::new();
    folder
        .run(&format!("[budget]\nsubsteps = 4\n{BEAM}"), &[])
        .succeeds();
    let split = folder.read("out/final.csv");
    let (_, rows) = table(&folder.read("out/trace.csv"));
    assert_eq!(rows.len(), 10);
    // The same as steps of a quarter (0.01/4 and 0.0025 are the same f64).
    folder
        .run(
            &BEAM
                .replace("dt = 0.01", "dt = 0.0025")
                .replace("steps = 10", "steps = 40"),
            &[],
        )
        .succeeds();
    assert_eq!(folder.read("out/final.csv"), split);
}

/// One free body in free flight: it falls by ½gt² (as backward Euler counts it), turns, and keeps
/// its momentum.
#[test]
fn placing_and_start_are_as_written() {
    let folder = Folder::new();
    let scene = r#"
gravity = [0, 0, 0]
[time]
dt = 0.01
steps = 0
[[body]]
mesh = { box = [1.0, 1.0, 1.0], cells = [1, 1, 1] }
young = 1e5
poisson = 0.3
density = 500.0
scale = 2.0
rotate = { axis = [0, 0, 3], degrees = 90.0 }
translate = [10.0, 0.0, 0.0]
stretch = [1.0, 3.0, 1.0]
velocity = [0.0, 0.0, 7.0]
angular_velocity = [0.0, 0.0, 2.0]
"#;
    folder.run(scene, &[]).succeeds();
    let (_, rows) = table(&folder.read("out/final.csv"));
    // Node 4 is (1, 0, 0): scaled (2, 0, 0), turned (0, 2, 0), moved (10, 2, 0); the centroid is
    // (9, 1, 1), so y is stretched to 4; v = 7 ẑ + 2 ẑ × (1, 3, −1) = (−6, 2, 7).
    let expected = [10.0, 4.0, 0.0, -6.0, 2.0, 7.0];
    for (found, expected) in rows[4][2..8].iter().zip(expected) {
        assert!((found - expected).abs() < 1e-6, "{:?}", rows[4]);
    }
}

#[test]
fn ground_stops_a_fall_and_is_counted() {
    let folder = Folder::new();
    let falling = free_beam().replace("steps = 10", "steps = 60");
    let scene = format!(
        "{falling}translate = [0, 0.05, 0]\n[[collider]]\nplane = {{ normal = [0, 2, 0], offset = -0.1 }}\n"
    );
    folder.run(&scene, &[]).succeeds();
    let (_, rows) = table(&folder.read("out/final.csv"));
    let lowest = rows.iter().map(|r| r[3]).fold(f64::INFINITY, f64::min);
    // 2y ≥ −0.1
    assert!((-0.06..-0.04).contains(&lowest), "{lowest}");
    let (_, rows) = table(&folder.read("out/trace.csv"));
    assert_eq!(rows[0][13], 0.0);
    assert!(rows[59][13] >= 4.0, "{:?}", rows[59]);
}

/// A stiff cube bounces with three iterations a step: contact adds no energy, unless the guard is switched off.
#[test]
fn contact_adds_no_energy() {
    let folder = Folder::new();
    let cube = r#"
[time]
dt = 0.006666667
steps = 150
[budget]
iterations = 3
[[body]]
mesh = { box = [0.5, 0.5, 0.5], cells = [3, 3, 3] }
young = 1e8
poisson = 0.4
density = 1000.0
rotate = { axis = [1, 0, 2], degrees = 30 }
translate = [0.0, 0.5, 0.0]
[[collider]]
plane = { normal = [0, 1, 0], offset = 0.0 }
friction = 0.5
"#;
    let most = |solver: &str| {
        folder.run(&format!("{solver}{cube}"), &[]).succeeds();
        let (_, rows) = table(&folder.read("out/trace.csv"));
        let total: Vec<f64> = rows.iter().map(|r| r[2] + r[3] + r[4]).collect();
        let rises = total.windows(2).map(|two| (two[1] - two[0]) / total[0]);
        rises.fold(f64::MIN, f64::max)
    };
    assert!(most("") <= 0.0);
    assert_eq!(folder.report()["solver"]["energy_guard"], true);
    assert!(most("[solver]\nenergy_guard = false\n") > 1e-3);
}

#[test]
fn a_moving_sphere_pushes_a_body() {
    let folder = Folder::new();
    let free = free_beam().replace("steps = 10", "steps = 50");
    let scene = format!(
        "gravity = [0, 0, 0]\n{free}[[collider]]\nsphere = {{ centre = [-0.6, 0.125, 0.125], radius = 0.5 }}\nvelocity = [1, 0, 0]\nfriction = 0.5\n"
    );
    folder.run(&scene, &[]).succeeds();
    let (_, rows) = table(&folder.read("out/trace.csv"));
    assert!(
        rows[49][6] > 10.0,
        "it has momentum along x: {:?}",
        rows[49]
    );
    let (_, rows) = table(&folder.read("out/final.csv"));
    // The sphere's front has come to −0.1 + 0.5.
    assert!(rows.iter().all(|r| r[2] > 0.2), "{rows:?}");
}

#[test]
fn a_refused_step_keeps_the_last_good_state() {
    let folder = Folder::new();
    for budget in ["", "[budget]\nsubsteps = 2\n"] {
        let scene = format!(
            "{budget}{}",
            BEAM.replace(
                "poisson = 0.4",
                "poisson = 0.4\nvelocity = [1e38, 0.0, 0.0]"
            )
        );
        // Two steps at most, until positions leave the range of f32.
        let scene = scene
            .replace("dt = 0.01", "dt = 2.0")
            .split_once("[[body.pin]]")
            .expect("a pin")
            .0
            .to_owned();
        let run = folder.run(&scene, &["--frames", "2"]);
        assert_eq!(run.status, 3, "{}", run.err);
        assert_eq!(run.err.lines().count(), 1, "{}", run.err);
        assert!(run.err.contains("scene.toml: step"), "{}", run.err);
        let report = folder.report();
        assert!(
            report["ended"]
                .as_str()
                .expect("text")
                .starts_with("refused: "),
            "{report}"
        );
        let steps = report["steps_run"].as_u64().expect("a number");
        assert!(steps < 10);
        assert_eq!(table(&folder.read("out/trace.csv")).1.len() as u64, steps);
        let (_, rows) = table(&folder.read("out/final.csv"));
        assert!(rows.iter().flatten().all(|x| (*x as f32).is_finite()));
        assert_eq!(hash(&folder), hash_of_final(&folder));
        assert!(folder.path("out/preview.svg").exists());
    }
}

#[test]
fn several_bodies_of_one_mesh_file() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("meshes")).expect("a folder");
    folder.write(
        "meshes/tet.node",
        "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n",
    );
    folder.write("meshes/tet.ele", "1 4 0\n1 1 2 3 4\n");
    let body = "[[body]]\nmesh = \"meshes/tet.node\"\nyoung = 1e4\npoisson = 0.3\ndensity = 1e3\n";
    let scene = format!("[time]\ndt = 0.01\nsteps = 3\n{body}{body}translate = [2, 0, 0]\n");
    folder.run(&scene, &["--frames", "1"]).succeeds();
    let (_, rows) = table(&folder.read("out/final.csv"));
    assert_eq!(rows.len(), 8);
    assert_eq!((rows[4][0], rows[4][1], rows[4][2]), (1.0, 0.0, 2.0));
    let frame = folder.read("out/frames/frame-00000.vtu");
    assert!(frame.contains("4 5 6 7"), "the second body's tet counts on");
}

/// Where a result cannot be written, there is one line and status 2.
#[test]
fn a_folder_that_cannot_be_filled_is_named() {
    for name in ["trace.csv", "final.csv", "preview.svg", "report.json"] {
        let folder = Folder::new();
        std::fs::create_dir_all(folder.path("out").join(name)).expect("a folder");
        let run = folder.run(BEAM, &[]);
        let begin = format!("error: out/{name}: cannot be written: ");
        assert!(run.err.starts_with(&begin), "{}", run.err);
        assert_eq!((run.status, run.err.lines().count()), (2, 1));
    }
}

#[cfg(unix)]
#[test]
fn half_a_result_is_none() {
    let folder = Folder::new();
    folder.write("scene.toml", BEAM);
    let run = folder.femto_on_a_full_disk(&["run", "scene.toml", "--out", "out"]);
    let line = "error: out/preview.svg: cannot be written: ";
    assert!(run.err.starts_with(line), "{}", run.err);
    assert_eq!((run.status, run.err.lines().count()), (2, 1));
    assert!(folder.path("out/trace.csv").exists() && !folder.path("out/preview.svg").exists());
}
