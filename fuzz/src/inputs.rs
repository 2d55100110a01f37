//! Small bodies that are mostly valid, and materials.

use femto::Material;

use super::bytes::Bytes;

/// The most nodes and tetrahedra that [`body`] makes.
pub const NODES: usize = 48;
pub const TETS: usize = 12;

/// A chain, a box, or a soup of tetrahedra; with a few edits, in any size.
pub fn body(bytes: &mut Bytes<'_>) -> (Vec<[f32; 3]>, Vec<[u32; 4]>) {
    let (mut nodes, mut tets) = match bytes.below(3) {
        0 => chain(1 + bytes.below(TETS), 1 + bytes.below(4)),
        1 => tower(1 + bytes.below(2)),
        _ => soup(bytes),
    };
    for _ in 0..bytes.below(8) {
        edit(bytes, &mut nodes, &mut tets);
    }
    let size = bytes.usual(&[1.0, 1.0, 1e-6, 1e6]);
    for x in nodes.as_flattened_mut() {
        *x *= size;
    }
    if !bytes.flag() {
        orient(&nodes, &mut tets);
    }
    (nodes, tets)
}

/// Node k lies on axis k mod 3, so that any four in a row span a tetrahedron. One tetrahedron
/// starts `stride` nodes after the other: they share a face, an edge, a node, or nothing.
fn chain(count: usize, stride: usize) -> (Vec<[f32; 3]>, Vec<[u32; 4]>) {
    let mut nodes = vec![[0.0; 3]; stride * (count - 1) + 4];
    for (k, node) in nodes.iter_mut().enumerate() {
        node[k % 3] = (1 + k / 3) as f32;
    }
    let tets = (0..count).map(|tet| [0, 1, 2, 3].map(|corner| (stride * tet + corner) as u32));
    (nodes, tets.collect())
}

/// Unit cubes, one on the other, of six tetrahedra each. Node (x, y, z) has the number x + 2y + 4z.
fn tower(cubes: usize) -> (Vec<[f32; 3]>, Vec<[u32; 4]>) {
    let nodes = (0..4 * (cubes + 1)).map(|k| [k % 2, k / 2 % 2, k / 4].map(|x| x as f32));
    let walks = [[1, 2], [1, 4], [2, 1], [2, 4], [4, 1], [4, 2]];
    let tets = (0..cubes as u32).map(|cube| 4 * cube).flat_map(|low| {
        walks.map(|[first, second]| [low, low + first, low + first + second, low + 7])
    });
    (nodes.collect(), tets.collect())
}

fn soup(bytes: &mut Bytes<'_>) -> (Vec<[f32; 3]>, Vec<[u32; 4]>) {
    let nodes: Vec<_> = (0..bytes.below(NODES)).map(|_| bytes.vector()).collect();
    let mut corner = || bytes.below(nodes.len() + 1) as u32;
    let count = corner() as usize % (TETS + 1);
    let tets = (0..count)
        .map(|_| [corner(), corner(), corner(), corner()])
        .collect();
    (nodes, tets)
}

/// Moves a node, or hangs a tetrahedron on another.
fn edit(bytes: &mut Bytes<'_>, nodes: &mut [[f32; 3]], tets: &mut [[u32; 4]]) {
    let kind = bytes.below(4);
    let place = usize::from(bytes.byte());
    if kind == 3 {
        let corner = if bytes.flag() {
            bytes.word()
        } else {
            bytes.byte().into()
        };
        let count = tets.len().max(1);
        if let Some(tet) = tets.get_mut(place % count) {
            tet[place % 4] = corner;
        }
    } else {
        let count = (3 * nodes.len()).max(1);
        if let Some(x) = nodes.as_flattened_mut().get_mut(place % count) {
            *x = if kind == 2 {
                bytes.number()
            } else {
                *x + bytes.number()
            };
        }
    }
}

/// Swaps two corners of every tetrahedron of negative volume.
fn orient(nodes: &[[f32; 3]], tets: &mut [[u32; 4]]) {
    for tet in tets {
        let [Some(a), Some(b), Some(c), Some(d)] = tet.map(|corner| nodes.get(corner as usize))
        else {
            continue;
        };
        let edge = |x: &[f32; 3]| [0, 1, 2].map(|axis| f64::from(x[axis]) - f64::from(a[axis]));
        if det(&[edge(b), edge(c), edge(d)]) < 0.0 {
            tet.swap(2, 3);
        }
    }
}

pub fn det([a, b, c]: &[[f64; 3]; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

pub fn material(bytes: &mut Bytes<'_>) -> Option<Material> {
    let young = bytes.usual(&[1e6, 1e3, 1e10]).abs();
    let poisson = bytes.usual(&[0.3, 0.0, 0.499, -0.9]);
    let density = bytes.usual(&[1e3, 1.0, 1e6]).abs();
    let (alpha, beta) = (
        bytes.usual(&[0.0, 1.0]).abs(),
        bytes.usual(&[0.0, 0.01]).abs(),
    );
    Material::new(young, poisson, density)
        .ok()?
        .with_damping(alpha, beta)
        .ok()
}
