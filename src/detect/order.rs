//! The order of a surface's triangles and edges in which the boxes of their tree are small.

use core::cmp::Ordering;

use glam::Vec3;

use super::tree::{Aabb, run};

/// Sorts triangles, or edges, so that those of each half, quarter, ... of the list are near each other: cut at the
/// median of their centroids along the longest side of the box around these, down to single ones.
///
/// For the triangles and edges of a [`Piece`](crate::coupling::Piece), from where its nodes are at rest; once, on the host
/// where a body is baked for firmware. One list, one order, on every target. Time O(t log t), no memory.
pub fn spatial_order<const N: usize>(nodes: &[[f32; 3]], items: &mut [[u32; N]]) {
    let centre = |item: &[u32; N]| {
        item.iter().fold(Vec3::ZERO, |sum, &n| {
            sum + Vec3::from_array(nodes.get(n as usize).copied().unwrap_or_default())
        })
    };
    let count = items.len();
    let mut level = 0;
    while 1 << level < count {
        for i in 0..1 << level {
            let whole = run(i, level, count);
            let middle = run(2 * i, level + 1, count).len();
            let part = items.get_mut(whole).unwrap_or_default();
            let mut around = Aabb::NONE;
            for item in &*part {
                around.add(centre(item));
            }
            let axis = longest(around.high - around.low);
            let along = |item: &[u32; N]| centre(item).to_array()[axis];
            let before = |a: &[u32; N], b: &[u32; N]| -> Ordering {
                along(a).total_cmp(&along(b)).then_with(|| a.cmp(b))
            };
            if middle < part.len() {
                part.select_nth_unstable_by(middle, before);
            }
        }
        level += 1;
    }
}

fn longest(sides: Vec3) -> usize {
    let [x, y, z] = sides.to_array();
    if x >= y && x >= z {
        0
    } else if y >= z {
        1
    } else {
        2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_of_halves_are_apart() {
        // A row of 13 triangles, shuffled: sorted again, wherever it began.
        let nodes: [[f32; 3]; 15] = core::array::from_fn(|i| [i as f32, (i % 2) as f32, 0.0]);
        let row: [[u32; 3]; 13] = core::array::from_fn(|i| [0, 1, 2].map(|k| i as u32 + k));
        for stride in [1, 2, 5, 11] {
            let mut triangles = core::array::from_fn(|i| row[i * stride % 13]);
            spatial_order(&nodes, &mut triangles);
            assert_eq!(triangles, row);
        }
        spatial_order::<3>(&nodes, &mut []);
    }
}
