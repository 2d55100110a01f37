//! TetGen's `.node` and `.ele`: text, `#` starts a comment, indices count from 0 or 1.
//! Attributes and boundary markers are ignored.

use std::str::FromStr;

use glam::DVec3;

use super::check::Problem;
use super::{LIMIT, Mesh, NOWHERE};

pub fn parse(node: &[u8], ele: &[u8]) -> Result<Mesh, String> {
    let mut mesh = Mesh {
        format: "TetGen .node and .ele".into(),
        ..Mesh::default()
    };
    let first = nodes(node, &mut mesh).map_err(|e| format!(".node {e}"))?;
    elements(ele, first, &mut mesh).map_err(|e| format!(".ele {e}"))?;
    Ok(mesh)
}

/// `count 3 attributes markers`, then `index x y z ...`. Returns the first index.
fn nodes(text: &[u8], mesh: &mut Mesh) -> Result<u64, String> {
    let mut rows = Rows::new(text)?;
    let head = rows.next("its head, the number of nodes")?;
    let count = head.count(0, "the number of nodes")?;
    match head.get::<u64>(1, "the dimension")? {
        3 => {}
        d => return Err(head.at(&format!("dimension {d}: must be 3"))),
    }
    let mut first = 0;
    for i in 0..count as u64 {
        let row = rows.next(&format!("node {} of {count}", i + 1))?;
        let name: u64 = row.get(0, "a node's index")?;
        if i == 0 {
            first = first_index(&row, name)?;
        }
        in_order(&row, name, first + i)?;
        mesh.nodes.push(DVec3::new(
            row.get(1, "x")?,
            row.get(2, "y")?,
            row.get(3, "z")?,
        ));
        mesh.node_names.push(name);
    }
    rows.end("nodes")?;
    Ok(first)
}

/// `count 4 attributes`, then `index n n n n ...`.
fn elements(text: &[u8], first: u64, mesh: &mut Mesh) -> Result<(), String> {
    let mut rows = Rows::new(text)?;
    let head = rows.next("its head, the number of tets")?;
    let count = head.count(0, "the number of tets")?;
    match head.get::<u64>(1, "the nodes of a tet")? {
        4 => {}
        10 => return Err(head.at("10-node tets are not supported, only 4-node tets")),
        n => return Err(head.at(&format!("{n} nodes a tet: must be 4"))),
    }
    let nodes = mesh.nodes.len() as u64;
    let known = match nodes {
        0 => "there are none".into(),
        _ => format!("nodes go from {first} to {}", first + (nodes - 1)),
    };
    for i in 0..count as u64 {
        let row = rows.next(&format!("tet {} of {count}", i + 1))?;
        let name: u64 = row.get(0, "a tet's index")?;
        let start = if i == 0 {
            first_index(&row, name)?
        } else {
            mesh.tet_names[0]
        };
        in_order(&row, name, start + i)?;
        let mut tet = [NOWHERE; 4];
        for (c, corner) in tet.iter_mut().enumerate() {
            let node: i64 = row.get(c + 1, "a node's index")?;
            match node.checked_sub(first as i64).map(u64::try_from) {
                Some(Ok(index)) if index < nodes => *corner = index as u32,
                _ => mesh.problems.push(Problem::NoSuchNode {
                    tet: name,
                    node: node.into(),
                    known: known.clone(),
                }),
            }
        }
        mesh.tets.push(tet);
        mesh.tet_names.push(name);
    }
    rows.end("tets")
}

fn first_index(row: &Row, name: u64) -> Result<u64, String> {
    match name {
        0 | 1 => Ok(name),
        _ => Err(row.at(&format!("the first index is {name}: must be 0 or 1"))),
    }
}

fn in_order(row: &Row, name: u64, expected: u64) -> Result<(), String> {
    if name == expected {
        return Ok(());
    }
    Err(row.at(&format!("index {name}: expected {expected}")))
}

/// The lines that hold something, comments taken off.
struct Rows<'a> {
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
}

impl<'a> Rows<'a> {
    fn new(text: &'a [u8]) -> Result<Self, String> {
        let text = std::str::from_utf8(text).map_err(|_| "is not text")?;
        Ok(Rows {
            lines: text.lines().enumerate(),
        })
    }

    fn find(&mut self) -> Option<Row<'a>> {
        self.lines.find_map(|(number, line)| {
            let line = line.split('#').next().unwrap_or("");
            let fields: Vec<&str> = line
                .split([' ', '\t', ',', '\r'])
                .filter(|f| !f.is_empty())
                .collect();
            (!fields.is_empty()).then_some(Row {
                number: number + 1,
                fields,
            })
        })
    }

    fn next(&mut self, what: &str) -> Result<Row<'a>, String> {
        self.find().ok_or_else(|| format!("ends before {what}"))
    }

    fn end(&mut self, what: &str) -> Result<(), String> {
        match self.find() {
            None => Ok(()),
            Some(row) => Err(row.at(&format!("more {what} than the head says"))),
        }
    }
}

struct Row<'a> {
    number: usize,
    fields: Vec<&'a str>,
}

impl Row<'_> {
    fn at(&self, what: &str) -> String {
        format!("line {}: {what}", self.number)
    }

    fn get<T: FromStr>(&self, field: usize, what: &str) -> Result<T, String> {
        let text = self
            .fields
            .get(field)
            .ok_or_else(|| self.at(&format!("{what} is missing")))?;
        text.parse()
            .map_err(|_| self.at(&format!("{what} is `{text}`, not a number that fits")))
    }

    fn count(&self, field: usize, what: &str) -> Result<usize, String> {
        match self.get(field, what)? {
            n if n <= LIMIT => Ok(n),
            n => Err(self.at(&format!("{what} is {n}, more than {LIMIT}"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NODE: &str =
        "# a tet\n4 3 1 1\n\n0 0 0 0 9 1\n1 1 0 0 9 1 # x\n2 0 1e0 0 9 1\n3 0 0 1 9 1\n";
    const ELE: &str = "1 4 1\n0 0 1 2 3 7\n";

    fn fails(node: &str, ele: &str) -> String {
        parse(node.as_bytes(), ele.as_bytes()).unwrap_err()
    }

    #[test]
    fn from_zero() {
        let mesh = parse(NODE.as_bytes(), ELE.as_bytes()).unwrap();
        assert_eq!(mesh.nodes[2], DVec3::Y);
        assert_eq!(mesh.tets, [[0, 1, 2, 3]]);
        assert_eq!(mesh.problems, []);
    }

    #[test]
    fn from_one() {
        let node = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
        let mesh = parse(node.as_bytes(), b"1 4 0\n1 1 2 3 4\n").unwrap();
        assert_eq!(mesh.tets, [[0, 1, 2, 3]]);
        assert_eq!(mesh.node_names, [1, 2, 3, 4]);
    }

    #[test]
    fn out_of_range_is_a_problem_with_the_files_numbers() {
        let node = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
        let mesh = parse(node.as_bytes(), b"1 4 0\n1 0 2 3 5\n").unwrap();
        let lines: Vec<String> = mesh.problems.iter().map(|p| p.to_string()).collect();
        assert_eq!(
            lines,
            [
                "tet 1: node 0 is out of range (nodes go from 1 to 4)",
                "tet 1: node 5 is out of range (nodes go from 1 to 4)",
            ]
        );
    }

    #[test]
    fn errors_name_the_line() {
        assert_eq!(
            fails("", ELE),
            ".node ends before its head, the number of nodes"
        );
        assert_eq!(
            fails("4 2 0 0\n", ELE),
            ".node line 1: dimension 2: must be 3"
        );
        assert_eq!(
            fails("1 3\n5 0 0 0\n", ELE),
            ".node line 2: the first index is 5: must be 0 or 1"
        );
        assert_eq!(
            fails("2 3\n0 0 0 0\n2 0 0 0\n", ELE),
            ".node line 3: index 2: expected 1"
        );
        assert_eq!(
            fails("1 3\n0 0 zero 0\n", ELE),
            ".node line 2: y is `zero`, not a number that fits"
        );
        assert_eq!(fails("1 3\n0 0 0\n", ELE), ".node line 2: z is missing");
        assert_eq!(
            fails("99999999999999 3\n", ELE),
            ".node line 1: the number of nodes is 99999999999999, more than 67108864"
        );
        assert_eq!(
            fails("2 3\n0 0 0 0\n", ELE),
            ".node ends before node 2 of 2"
        );
        assert_eq!(
            fails("0 3\n0 0 0 0\n", ELE),
            ".node line 2: more nodes than the head says"
        );
        assert_eq!(
            fails(NODE, "1 10 0\n"),
            ".ele line 1: 10-node tets are not supported, only 4-node tets"
        );
        assert_eq!(
            fails(NODE, "1 4 0\n0 0 1 2\n"),
            ".ele line 2: a node's index is missing"
        );
        assert_eq!(parse(b"\xff\xfe", b"").unwrap_err(), ".node is not text");
    }
}
