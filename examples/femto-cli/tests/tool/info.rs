//! `femto info` on good and bad meshes.

use crate::support::Folder;

const NODE: &str = "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n";
const ELE: &str = "2 4 0\n1 1 2 3 4\n2 2 3 4 5\n";

#[test]
fn a_good_mesh() {
    let folder = Folder::new();
    folder.write("two.node", NODE);
    folder.write("two.ele", ELE);
    let run = folder.femto(&["info", "two.node"]).succeeds();
    for part in [
        "two.node: TetGen",
        "nodes         5",
        "tets          2",
        "pieces        1",
        "6 triangles",
        "0.5 in all", // 1/6 + 1/3
        "x             0 to 1  (1)",
        "min 0.166667, median 0.333333, max 0.333333",
        "mean ratio",
        "tet 1 0.840",
        "factored",
        "dense",
        "nothing wrong",
    ] {
        assert!(run.out.contains(part), "{part}: {}", run.out);
    }
}

#[test]
fn everything_wrong_is_listed() {
    let folder = Folder::new();
    folder.write(
        "bad.node",
        NODE.replace("5 3 0 0", "6 3 0 0") + "6 2 2 nan\n",
    );
    folder.write(
        "bad.ele",
        "4 4 0\n1 1 3 2 4\n2 2 3 4 9\n3 1 1 2 3\n4 1 2 3 3\n",
    );
    let run = folder.femto(&["info", "bad.node"]);
    assert_eq!(run.status, 2);
    assert_eq!(
        run.err,
        "error: bad.node: tet 2: node 9 is out of range (nodes go from 1 to 6); and 6 more\n"
    );
    let list = run
        .out
        .split_once("7 things wrong:\n")
        .unwrap_or_else(|| panic!("{}", run.out))
        .1;
    assert_eq!(
        list.lines().collect::<Vec<_>>(),
        [
            "  tet 2: node 9 is out of range (nodes go from 1 to 6)",
            "  node 6: its position [2.0, 2.0, NaN] is not finite in f32",
            "  tet 1: its volume is negative (-1.6666666666666666e-1): inside out",
            "  tet 3: node 1 is repeated",
            "  tet 4: node 3 is repeated",
            "  node 5: belongs to no tet",
            "  node 6: belongs to no tet",
        ]
    );
}

/// A node at no place has no part in sizes and shapes.
#[test]
fn what_is_not_finite_is_not_measured() {
    let folder = Folder::new();
    folder.write("nan.node", NODE.replace("5 1 1 1", "5 1 nan 1"));
    folder.write("nan.ele", ELE);
    let run = folder.femto(&["info", "nan.node"]);
    assert_eq!(run.status, 2);
    let (measured, wrong) = run.out.split_once("thing wrong").expect("a list");
    assert!(measured.contains("tet 1 0.840") && !measured.contains("NaN"));
    assert!(wrong.contains("node 5: its position [1.0, NaN, 1.0] is not finite"));
}

#[test]
fn a_long_list_is_cut() {
    let folder = Folder::new();
    let nodes: String = (0..104)
        .map(|i| format!("{i} {} {} {}\n", i == 1, i == 2, i == 3))
        .collect();
    let nodes = nodes.replace("true", "1").replace("false", "0");
    folder.write("many.node", format!("104 3 0 0\n{nodes}"));
    folder.write("many.ele", "1 4 0\n0 0 1 2 3\n");
    let run = folder.femto(&["info", "many.node"]);
    assert_eq!(run.status, 2);
    assert!(
        run.out.contains("100 things wrong:") && run.out.contains("  and 80 more\n"),
        "{}",
        run.out
    );
}

#[test]
fn the_built_in_snowman_is_good() {
    let mesh = concat!(env!("CARGO_MANIFEST_DIR"), "/meshes/snowman.msh");
    let run = Folder::new().femto(&["info", mesh]).succeeds();
    assert!(run.out.contains("nothing wrong"), "{}", run.out);
}

#[test]
fn files_that_cannot_be_read() {
    let folder = Folder::new();
    folder.write("lonely.node", NODE);
    folder.write("garbage.msh", [0, 159, 146, 150, 10, 13, 255]);
    folder.write("mesh.stl", "");
    for (name, error) in [
        ("none.msh", "error: none.msh: cannot be read: No such file"),
        (
            "lonely.node",
            "error: lonely.node: lonely.ele beside it cannot be read: No such file",
        ),
        (
            "garbage.msh",
            "error: garbage.msh: not a Gmsh file: it does not begin with $MeshFormat\n",
        ),
        (
            "mesh.stl",
            "error: mesh.stl: not a mesh format known here (.msh, or .node with its .ele)\n",
        ),
    ] {
        let run = folder.femto(&["info", name]);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{name}");
        assert!(
            run.err.starts_with(error) && run.err.lines().count() == 1,
            "{}",
            run.err
        );
    }
}
