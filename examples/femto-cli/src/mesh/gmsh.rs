//! Gmsh `.msh` files, format 4.1 in ASCII, read by `mshio`.
//!
//! Of the elements, the 4-node tets are taken and all others are left out. Nodes that no
//! tet uses (points and curves of the geometry have some) are left out too; the others
//! keep the order of the file.

use std::collections::HashMap;
use std::ops::Range;

use glam::DVec3;
use mshio::{ElementType, MshFile, MshParserError};

use super::check::Problem;
use super::{LIMIT, Mesh, NOWHERE};

pub fn parse(bytes: &[u8]) -> Result<Mesh, String> {
    check_format(bytes)?;
    let bytes = with_sparse_tags(bytes)?;
    let file = mshio::parse_msh_bytes(&bytes).map_err(|e| describe(&e, &bytes))?;
    build(&file)
}

/// Refuses what `mshio` refuses unclearly or with a panic: other versions, binary files.
fn check_format(bytes: &[u8]) -> Result<(), String> {
    let head = section(bytes, "$MeshFormat")
        .ok_or("not a Gmsh file: it does not begin with $MeshFormat")?;
    let head = String::from_utf8_lossy(&bytes[head]).into_owned();
    let fields: Vec<&str> = head.split_whitespace().collect();
    match fields[..] {
        ["4.1", "0", "8"] => Ok(()),
        ["4.1", "1", _] => Err(
            "a binary Gmsh file: only ASCII is supported (gmsh -format msh41 without -bin)".into(),
        ),
        ["4.1", ..] => Err(format!("Gmsh format line `{head}`: expected `4.1 0 8`")),
        [version, ..] => Err(format!(
            "Gmsh format {version}: only 4.1 (ASCII) is supported (gmsh FILE -save -format msh41)"
        )),
        [] => Err("Gmsh format line is empty".into()),
    }
}

/// The line after a section's start tag.
fn section(bytes: &[u8], tag: &str) -> Option<Range<usize>> {
    let mut start = 0;
    let mut found = false;
    for line in bytes.split_inclusive(|&b| b == b'\n') {
        let text = line.trim_ascii();
        if found {
            return Some(start..start + line.len() - usize::from(line.ends_with(b"\n")));
        }
        found = text == tag.as_bytes();
        start += line.len();
    }
    None
}

/// `mshio` gives the tags of nodes only where their range has gaps, and drops them where
/// it has none, also when they are not in order. So the head of the nodes is made to say
/// that the range is wide: then the tags are always there.
///
/// Heads that say 0 nodes or 0 elements make it panic, and are refused here; so is a tag that stands twice, since `mshio`
/// may begin at the other one.
fn with_sparse_tags(bytes: &[u8]) -> Result<Vec<u8>, String> {
    for (tag, what) in [("$Nodes", "nodes"), ("$Elements", "elements")] {
        let head = section(bytes, tag).ok_or_else(|| format!("has no {what} ({tag})"))?;
        let tags = bytes.windows(tag.len()).filter(|w| *w == tag.as_bytes());
        if tags.count() > 1 {
            return Err(format!("{tag} is given twice"));
        }
        let text = String::from_utf8_lossy(&bytes[head]);
        match text.split_whitespace().nth(1).map(str::parse::<usize>) {
            Some(Ok(0)) => return Err(format!("has 0 {what}")),
            Some(Ok(n)) if n <= LIMIT => {}
            _ => {
                return Err(format!(
                    "{tag}: its head `{text}` does not hold a number of {what} that fits"
                ));
            }
        }
    }
    let head = section(bytes, "$Nodes").unwrap_or(0..0);
    let text = String::from_utf8_lossy(&bytes[head.clone()]).into_owned();
    let fields: Vec<&str> = text.split_whitespace().collect();
    let [blocks, count, _, _] = fields[..] else {
        return Err(format!(
            "$Nodes: its head `{text}` does not hold four numbers"
        ));
    };
    let mut wide = bytes[..head.start].to_vec();
    wide.extend_from_slice(format!("{blocks} {count} 1 {}", u64::MAX).as_bytes());
    wide.extend_from_slice(&bytes[head.end..]);
    Ok(wide)
}

fn build(file: &MshFile<u64, i32, f64>) -> Result<Mesh, String> {
    let mut mesh = Mesh {
        format: "Gmsh 4.1 ASCII".into(),
        ..Mesh::default()
    };
    let mut index_of = HashMap::new();
    for block in file.data.nodes.iter().flat_map(|n| &n.node_blocks) {
        let mut tags: Vec<(usize, u64)> = block
            .node_tags
            .iter()
            .flatten()
            .map(|(&tag, &i)| (i, tag))
            .collect();
        tags.sort_unstable();
        if tags.len() != block.nodes.len() {
            return Err("$Nodes: a node tag is given twice".into());
        }
        for ((_, tag), node) in tags.into_iter().zip(&block.nodes) {
            if index_of.insert(tag, mesh.nodes.len() as u32).is_some() {
                mesh.problems.push(Problem::NodeTwice { node: tag });
            }
            mesh.nodes.push(DVec3::new(node.x, node.y, node.z));
            mesh.node_names.push(tag);
        }
    }

    let mut others = 0;
    let mut quadratic = 0;
    for block in file.data.elements.iter().flat_map(|e| &e.element_blocks) {
        match block.element_type {
            ElementType::Tet4 => {}
            ElementType::Tet10 => {
                quadratic += block.elements.len();
                continue;
            }
            _ => {
                others += usize::from(block.entity_dim == 3) * block.elements.len();
                continue;
            }
        }
        for element in &block.elements {
            let mut tet = [NOWHERE; 4];
            for (corner, tag) in tet.iter_mut().zip(&element.nodes) {
                match index_of.get(tag) {
                    Some(&index) => *corner = index,
                    None => mesh.problems.push(Problem::NoSuchNode {
                        tet: element.element_tag,
                        node: (*tag).into(),
                        known: "no node has this tag".into(),
                    }),
                }
            }
            mesh.tets.push(tet);
            mesh.tet_names.push(element.element_tag);
            mesh.volumes.push(block.entity_tag);
        }
    }
    if mesh.tets.is_empty() && quadratic > 0 {
        return Err(format!(
            "has {quadratic} 10-node tets and no 4-node tets, which alone are supported"
        ));
    }
    if others + quadratic > 0 {
        mesh.notes.push(format!(
            "{} volume elements that are not 4-node tets were left out",
            others + quadratic
        ));
    }
    drop_unused_nodes(&mut mesh);
    Ok(mesh)
}

fn drop_unused_nodes(mesh: &mut Mesh) {
    let mut new_index = vec![NOWHERE; mesh.nodes.len()];
    for node in mesh.tets.iter().flatten().filter(|&&n| n != NOWHERE) {
        new_index[*node as usize] = 0;
    }
    let used: Vec<bool> = new_index.iter().map(|&i| i != NOWHERE).collect();
    let left_out = used.iter().filter(|&&u| !u).count();
    if left_out == 0 || mesh.tets.is_empty() {
        return;
    }
    mesh.notes
        .push(format!("{left_out} nodes that no tet uses were left out"));
    let mut next = 0;
    for (index, &used) in new_index.iter_mut().zip(&used) {
        if used {
            *index = next;
            next += 1;
        }
    }
    for node in mesh.tets.iter_mut().flatten().filter(|n| **n != NOWHERE) {
        *node = new_index[*node as usize];
    }
    let mut keep = used.iter();
    mesh.nodes.retain(|_| keep.next() == Some(&true));
    let mut keep = used.iter();
    mesh.node_names.retain(|_| keep.next() == Some(&true));
}

/// The line where reading stopped, what was wrong, and the innermost thing being read there.
fn describe(error: &MshParserError<&[u8]>, bytes: &[u8]) -> String {
    let rest = error.backtrace.first().map_or(0, |(rest, _)| rest.len());
    let read = &bytes[..bytes.len() - rest.min(bytes.len())];
    let mut what = match rest {
        0 => "the file ends too early".into(),
        _ => format!("line {}", 1 + read.iter().filter(|&&b| b == b'\n').count()),
    };
    let steps = error.filtered_backtrace();
    let kind = steps.iter().find(|(_, kind)| kind.context().is_none());
    if let Some((_, kind)) = kind {
        what += &format!(": {}", kind.to_string().trim_end_matches('.'));
    }
    if let Some(place) = steps.iter().find_map(|(_, kind)| kind.context()) {
        what += &format!(" ({place})");
    }
    what
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two blocks of nodes whose tags have no gap and are not in order; a triangle; a
    /// node (tag 5) that only the triangle uses.
    const FILE: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
        $PhysicalNames\n1\n3 1 \"body\"\n$EndPhysicalNames\n\
        $Nodes\n2 5 1 5\n2 1 0 2\n5\n4\n9 9 9\n0 0 1\n3 1 0 3\n2\n1\n3\n1 0 0\n0 0 0\n0 1 0\n$EndNodes\n\
        $Elements\n2 2 1 2\n2 1 2 1\n1 5 4 3\n3 1 4 1\n2 1 2 3 4\n$EndElements\n";

    fn fails(from: &str, to: &str) -> String {
        assert!(FILE.contains(from));
        parse(FILE.replacen(from, to, 1).as_bytes()).unwrap_err()
    }

    #[test]
    fn tags_out_of_order_find_their_nodes() {
        let mesh = parse(FILE.as_bytes()).unwrap();
        assert_eq!(mesh.node_names, [4, 2, 1, 3]);
        assert_eq!(mesh.nodes, [DVec3::Z, DVec3::X, DVec3::ZERO, DVec3::Y]);
        assert_eq!(mesh.tets, [[2, 1, 3, 0]]);
        assert_eq!(mesh.tet_names, [2]);
        assert_eq!(mesh.volumes, [1]);
        assert_eq!(mesh.problems, []);
        assert_eq!(mesh.notes, ["1 nodes that no tet uses were left out"]);
    }

    #[test]
    fn windows_line_ends() {
        let mesh = parse(FILE.replace('\n', "\r\n").as_bytes()).unwrap();
        assert_eq!(mesh.tets, [[2, 1, 3, 0]]);
    }

    #[test]
    fn numbers_are_read_to_the_last_bit() {
        for text in [
            "0.1",
            "1.7976931348623157e308",
            "-5e-324",
            "0.30000000000000004",
            "123456789.123456789",
            "2.2250738585072011e-308",
        ] {
            let mesh = parse(
                FILE.replacen("0 0 1\n3", &format!("0 0 {text}\n3"), 1)
                    .as_bytes(),
            )
            .unwrap();
            assert_eq!(
                mesh.nodes[0].z.to_bits(),
                text.parse::<f64>().unwrap().to_bits(),
                "{text}"
            );
        }
    }

    #[test]
    fn a_missing_tag_is_a_problem() {
        let mesh = parse(FILE.replacen("2 1 2 3 4\n", "2 1 2 3 77\n", 1).as_bytes()).unwrap();
        assert_eq!(
            mesh.problems[0].to_string(),
            "tet 2: node 77 is out of range (no node has this tag)"
        );
    }

    #[test]
    fn other_formats_are_refused() {
        assert!(fails("4.1 0 8", "2.2 0 8").starts_with("Gmsh format 2.2: only 4.1"));
        assert!(fails("4.1 0 8", "4.1 1 8").starts_with("a binary Gmsh file"));
        assert!(fails("4.1 0 8", "4.1 0 5").contains("expected `4.1 0 8`"));
        assert!(fails("$MeshFormat", "$Mesh").starts_with("not a Gmsh file"));
        assert!(parse(b"").unwrap_err().starts_with("not a Gmsh file"));
    }

    #[test]
    fn damage_is_an_error_and_never_a_panic() {
        assert_eq!(fails("2 5 1 5", "2 0 1 5"), "has 0 nodes");
        assert_eq!(fails("2 2 1 2", "2 0 1 2"), "has 0 elements");
        assert!(
            fails("2 2 1 2", "2 99999999999999999999 1 2")
                .contains("does not hold a number of elements")
        );
        assert!(fails("2 5 1 5", "2 5 1").contains("four numbers"));
        assert!(fails("2\n1\n3\n1 0 0", "2\n2\n3\n1 0 0").contains("given twice"));
        assert_eq!(
            fails("0 1 0\n$End", "0 one 0\n$End"),
            "line 21: An invalid node definition was encountered (y coordinate)"
        );
        // Not the section that is read, but the one that is found.
        for (tag, head, none) in [
            ("$Nodes", "2 5 1 5", "2 0 1 5"),
            ("$Elements", "2 2 1 2", "2 0 1 2"),
        ] {
            let twice = format!("$Comments\n{tag}\n1 1 1 1\n$EndComments\n$PhysicalNames");
            let file = FILE.replacen("$PhysicalNames", &twice, 1);
            let file = file.replacen(head, none, 1);
            let error = parse(file.as_bytes()).unwrap_err();
            assert_eq!(error, format!("{tag} is given twice"));
        }
        for end in 0..FILE.len() - 1 {
            let _ = parse(&FILE.as_bytes()[..end]);
        }
        // Any byte replaced by any of some trouble makers.
        for at in 0..FILE.len() {
            for byte in *b"0$\n-e\xff" {
                let mut bytes = FILE.as_bytes().to_vec();
                bytes[at] = byte;
                let _ = parse(&bytes);
            }
        }
    }
}
