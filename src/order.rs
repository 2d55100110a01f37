//! The order of the tetrahedra that is fastest (feature `alloc`): fans, eight side by side.
//!
//! Tetrahedra around a common edge share the reading and writing of its nodes where the mesh lists them
//! in this order: tetrahedron i of a fan has the corners (a, b, n_i, n_{i+1}) with the common edge ab,
//! and the fans of eight lanes advance together, one block of eight at a time. Fans are taken greedily,
//! longest first. What does not fill eight lanes is cut in halves, single tetrahedra come last.
//!
//! An order changes the rounding of sums and nothing else. A mesh for firmware is ordered once, on the
//! host.

use alloc::vec;
use alloc::vec::Vec;

use crate::lane::BLOCK;

/// Longer fans are cut: they gain little, and eight as long are rare.
const LONGEST: usize = 8;

/// Tetrahedra that are looked at around one edge.
const MOST: usize = 64;

/// The tetrahedra of a mesh in another order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ordered {
    /// Four corners a tetrahedron, as an even permutation of those it came with.
    pub tets: Vec<[u32; 4]>,
    /// Where each was before.
    pub original: Vec<usize>,
}

/// A tetrahedron with an edge of it in front: (a, b, n, m) with a < b.
#[derive(Clone, Copy)]
struct Spoke {
    corners: [u32; 4],
    tet: usize,
}

impl Spoke {
    fn edge(&self) -> (u32, u32) {
        let [a, b, ..] = self.corners;
        (a, b)
    }

    fn from(&self) -> u32 {
        let [.., from, _] = self.corners;
        from
    }

    fn to(&self) -> u32 {
        let [.., to] = self.corners;
        to
    }
}

/// Orders tetrahedra into fans. Time and memory are in proportion to their number, sorting aside.
#[must_use]
pub fn fans(tets: &[[u32; 4]]) -> Ordered {
    let spokes = spokes(tets);
    let mut used = vec![false; tets.len()];
    // Fans by length, the longest first.
    let mut found: Vec<Vec<Vec<Spoke>>> = Vec::new();
    for length in (2..=LONGEST).rev() {
        let mut fans = Vec::new();
        for around in spokes.chunk_by(|a, b| a.edge() == b.edge()) {
            let free = |spoke: &&Spoke| used.get(spoke.tet) == Some(&false);
            if around.len() < length || around.iter().filter(free).count() < length {
                continue;
            }
            let mut fan = longest_fan(around.iter().filter(free).take(MOST).copied().collect());
            if fan.len() >= length {
                fan.truncate(length);
                for spoke in &fan {
                    used.get_mut(spoke.tet).into_iter().for_each(|u| *u = true);
                }
                fans.push(fan);
            }
        }
        found.push(fans);
    }
    let all = tets.iter().copied().enumerate().zip(used);
    let single = all.filter(|(_, used)| !used);
    let single = single.map(|((tet, corners), _)| vec![Spoke { corners, tet }]);
    found.push(single.collect());
    found.reverse();
    lay_out(found)
}

/// The six edges of every tetrahedron, edge by edge.
fn spokes(tets: &[[u32; 4]]) -> Vec<Spoke> {
    let mut spokes = Vec::with_capacity(6 * tets.len());
    for (tet, &[p, q, r, s]) in tets.iter().enumerate() {
        // Even permutations.
        for [a, b, n, m] in [
            [p, q, r, s],
            [p, r, s, q],
            [p, s, q, r],
            [q, r, p, s],
            [q, s, r, p],
            [r, s, p, q],
        ] {
            let corners = if a < b { [a, b, n, m] } else { [b, a, m, n] };
            spokes.push(Spoke { corners, tet });
        }
    }
    spokes.sort_unstable_by_key(|spoke| (spoke.edge(), spoke.tet));
    // A tetrahedron that names a node twice has an edge twice.
    spokes.dedup_by_key(|spoke| (spoke.edge(), spoke.tet));
    spokes
}

/// The longest way around an edge from tetrahedron to tetrahedron.
fn longest_fan(mut left: Vec<Spoke>) -> Vec<Spoke> {
    let mut longest = Vec::new();
    while !left.is_empty() {
        // From where none leads to; on a closed ring from anywhere.
        let begins = |spoke: &Spoke| left.iter().all(|other| other.to() != spoke.from());
        let mut next = left.iter().position(begins).or(Some(0));
        let mut fan = Vec::new();
        while let Some(at) = next {
            let spoke = left.swap_remove(at);
            next = left.iter().position(|other| other.from() == spoke.to());
            fan.push(spoke);
        }
        if fan.len() > longest.len() {
            longest = fan;
        }
    }
    longest
}

/// Lists fans eight by eight: their first tetrahedra, their second, and so on. `found` has the fans of one
/// tetrahedron first, then those of two, ...
fn lay_out(mut found: Vec<Vec<Vec<Spoke>>>) -> Ordered {
    let mut ordered = Ordered {
        tets: Vec::new(),
        original: Vec::new(),
    };
    while let Some(mut fans) = found.pop() {
        let length = found.len() + 1;
        // As near to each other as they were in the mesh.
        fans.sort_by_key(|fan| fan.iter().map(|spoke| spoke.tet).min());
        if length > 1 {
            for mut fan in fans.split_off(fans.len() / BLOCK * BLOCK) {
                let tail = fan.split_off(length.div_ceil(2));
                for half in [fan, tail] {
                    if let Some(fans) = found.get_mut(half.len() - 1) {
                        fans.push(half);
                    }
                }
            }
        }
        for eight in fans.chunks(BLOCK) {
            for step in 0..length {
                for spoke in eight.iter().filter_map(|fan| fan.get(step)) {
                    ordered.tets.push(spoke.corners);
                    ordered.original.push(spoke.tet);
                }
            }
        }
    }
    ordered
}
