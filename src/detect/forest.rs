//! The trees of all pieces, in one memory.

use core::ops::Range;

use super::tree::{Aabb, Tree, boxes, fit};
use crate::coupling::{CoupleStep, Piece};

/// Pieces, and the boxes around their triangles and edges, fitted where a search has asked for them.
#[derive(Debug)]
pub(super) struct Forest<'a> {
    pub pieces: &'a [Piece<'a>],
    boxes: &'a mut [Aabb],
    /// A bit a piece.
    fitted: u64,
}

/// A piece with its trees.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface<'a> {
    pub piece: &'a Piece<'a>,
    pub triangles: Tree<'a, 3>,
    pub edges: Tree<'a, 4>,
}

impl<'a> Forest<'a> {
    pub fn new(pieces: &'a [Piece<'a>], boxes: &'a mut [Aabb]) -> Self {
        Self {
            pieces,
            boxes,
            fitted: 0,
        }
    }

    /// The boxes of a piece: each has what is left by those before it, and no more than it needs.
    fn shares(&self, index: usize) -> [Range<usize>; 2] {
        let room = self.boxes.len();
        let mut used = 0;
        let mut take = |items: usize| {
            let first = used;
            let most = first + boxes(items);
            used = if most < room { most } else { room };
            first..used
        };
        let mut shares = [0..0, 0..0];
        for piece in self.pieces.iter().take(index + 1) {
            shares = [take(piece.triangles.len()), take(piece.edges.len())];
        }
        shares
    }

    /// Fits the boxes of a piece, once a step.
    pub fn fit(&mut self, index: usize, step: &CoupleStep<'_>) {
        // No more than 64 pass `check`.
        let bit = 1_u64.wrapping_shl(index as u32);
        if self.fitted & bit != 0 {
            return;
        }
        self.fitted |= bit;
        let [triangles, edges] = self.shares(index);
        let Some(piece) = self.pieces.get(index) else {
            return;
        };
        fit(
            self.boxes.get_mut(triangles).unwrap_or_default(),
            piece.triangles,
            step,
        );
        fit(
            self.boxes.get_mut(edges).unwrap_or_default(),
            piece.edges,
            step,
        );
    }

    /// A piece whose boxes are fitted.
    pub fn surface(&self, index: usize) -> Option<Surface<'_>> {
        let piece = self.pieces.get(index)?;
        let [triangles, edges] = self.shares(index);
        Some(Surface {
            piece,
            triangles: Tree {
                items: piece.triangles,
                boxes: self.boxes.get(triangles).unwrap_or_default(),
            },
            edges: Tree {
                items: piece.edges,
                boxes: self.boxes.get(edges).unwrap_or_default(),
            },
        })
    }
}
