//! Mesh files of any bytes, and good ones with damage: read or refused in one line, never a panic.

use femto_cli::mesh::{Mesh, gmsh, tetgen};
use femto_cli::rehearsal::look_over;

use super::bytes::Bytes;

const GMSH: &str = include_str!("two_tets.msh");
const NODE: &str = "5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 1 1 1 # the last\n";
const ELE: &str = "2 4 0\n0 0 1 2 3\n1 1 2 3 4\n";

/// The first byte chooses: a Gmsh file, a pair of TetGen's; as it is, or as edits of a good one.
pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let choice = bytes.byte();
    let rest = data.get(1..).unwrap_or_default();
    match choice % 4 {
        0 => read(gmsh::parse(rest)),
        1 => {
            // A zero byte parts the two files.
            let mut files = rest.splitn(2, |&byte| byte == 0);
            let (node, ele) = (files.next().unwrap_or_default(), files.next());
            read(tetgen::parse(node, ele.unwrap_or(ELE.as_bytes())));
        }
        2 => read(gmsh::parse(&damaged(GMSH, &mut bytes))),
        _ => {
            let node = damaged(NODE, &mut bytes);
            read(tetgen::parse(&node, &damaged(ELE, &mut bytes)));
        }
    }
}

/// Some fields become other numbers, some bytes others.
fn damaged(text: &str, bytes: &mut Bytes<'_>) -> Vec<u8> {
    const FIELDS: [&str; 12] = [
        "0",
        "1",
        "-1",
        "2",
        "4294967296",
        "18446744073709551615",
        "99999999999999999999",
        "67108864",
        "1e400",
        "nan",
        "0x1",
        "",
    ];
    let mut fields: Vec<String> = text
        .split_inclusive([' ', '\n'])
        .map(str::to_owned)
        .collect();
    for _ in 0..bytes.below(4) {
        let at = bytes.below(fields.len());
        let end = fields[at].pop().unwrap_or(' ');
        fields[at] = format!("{}{end}", FIELDS[bytes.below(FIELDS.len())]);
    }
    let mut out = fields.concat().into_bytes();
    for _ in 0..bytes.below(4) {
        let at = usize::from(bytes.byte()) | usize::from(bytes.byte()) << 8;
        let at = at % out.len();
        match bytes.byte() {
            0 => out.truncate(at),
            byte => out[at] = byte,
        }
        if out.is_empty() {
            break;
        }
    }
    out
}

fn read(mesh: Result<Mesh, String>) {
    if let Ok(mesh) = &mesh {
        assert_eq!(mesh.nodes.len(), mesh.node_names.len());
        assert_eq!(mesh.tets.len(), mesh.tet_names.len());
    }
    let (status, text) = look_over(mesh);
    assert!(status == 0 || status == 2);
    text.lines().for_each(super::check_line);
}
