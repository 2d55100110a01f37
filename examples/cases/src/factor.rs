//! Factors for the checks: right in shape, made up in value. Bits and cost do not ask how good a factor is,
//! and one that needs no host's arithmetic is the same everywhere.

use femto::element::Sym3;
use femto::preconditioner::factor::{Entries, Factor, FactorError};

/// Arrays of a factor in the natural order, with an entry for each edge of the mesh (no fill). All bits zero.
#[derive(Debug)]
pub struct FactorRoom<const NODES: usize, const ENTRIES: usize> {
    nodes: usize,
    entries: usize,
    order: [u16; NODES],
    ends: [u32; NODES],
    rows: [u16; ENTRIES],
    blocks: [Sym3<f32>; NODES],
    numbers: [f32; NODES],
    warped: [[f32; 9]; ENTRIES],
    warped_half: [[u16; 9]; ENTRIES],
    laplacian: [f32; ENTRIES],
    laplacian_half: [u16; ENTRIES],
}

/// Which of a room's factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// 3×3 blocks.
    Warped,
    /// … in half precision.
    WarpedHalf,
    /// Numbers.
    Laplacian,
    /// … in half precision.
    LaplacianHalf,
}

/// A few negative numbers that half precision has exactly, and their bits there.
const VALUES: [(f32, u16); 4] = [
    (-0.125, 0xb000),
    (-0.0625, 0xac00),
    (-0.1875, 0xb200),
    (-0.03125, 0xa800),
];

impl<const NODES: usize, const ENTRIES: usize> FactorRoom<NODES, ENTRIES> {
    /// Empty.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            nodes: 0,
            entries: 0,
            order: [0; NODES],
            ends: [0; NODES],
            rows: [0; ENTRIES],
            blocks: [[0.0; 6]; NODES],
            numbers: [0.0; NODES],
            warped: [[0.0; 9]; ENTRIES],
            warped_half: [[0; 9]; ENTRIES],
            laplacian: [0.0; ENTRIES],
            laplacian_half: [0; ENTRIES],
        }
    }

    /// Makes the factors of a mesh.
    pub fn fill(&mut self, nodes: usize, tets: &[[u32; 4]]) {
        (self.nodes, self.entries) = (nodes, 0);
        for node in 0..nodes {
            let mut neighbour = [false; NODES];
            for tet in tets.iter().filter(|tet| tet.contains(&(node as u32))) {
                tet.iter()
                    .for_each(|&corner| neighbour[corner as usize] = true);
            }
            for row in (node + 1..nodes).filter(|&row| neighbour[row]) {
                self.add(row, VALUES[(node + row) % VALUES.len()]);
            }
            self.order[node] = node as u16;
            self.ends[node] = self.entries as u32;
            self.numbers[node] = 0.5 + 0.25 * (node % 3) as f32;
            self.blocks[node] = [1.0, 0.25, -0.125, 0.75, 0.0625, self.numbers[node]];
        }
    }

    fn add(&mut self, row: usize, (value, half): (f32, u16)) {
        let at = self.entries;
        self.rows[at] = row as u16;
        (self.laplacian[at], self.laplacian_half[at]) = (value, half);
        for diagonal in [0, 4, 8] {
            (self.warped[at][diagonal], self.warped_half[at][diagonal]) = (value, half);
        }
        (
            self.warped[at][1 + row % 3],
            self.warped_half[at][1 + row % 3],
        ) = VALUES[3];
        self.entries = at + 1;
    }

    /// One of them, for the mesh of this fingerprint.
    ///
    /// # Errors
    /// [`FactorError`]: a defect of this program.
    pub fn factor(&self, kind: Kind, fingerprint: u64) -> Result<Factor<'_>, FactorError> {
        let blocks = &self.blocks[..self.nodes];
        let numbers = &self.numbers[..self.nodes];
        let entries = match kind {
            Kind::Warped => Entries::Warped {
                pivots: blocks,
                lower: &self.warped[..self.entries],
            },
            Kind::WarpedHalf => Entries::WarpedHalf {
                pivots: blocks,
                lower: &self.warped_half[..self.entries],
            },
            Kind::Laplacian => Entries::Laplacian {
                pivots: numbers,
                lower: &self.laplacian[..self.entries],
            },
            Kind::LaplacianHalf => Entries::LaplacianHalf {
                pivots: numbers,
                lower: &self.laplacian_half[..self.entries],
            },
        };
        Factor::new(
            fingerprint,
            &self.order[..self.nodes],
            &self.ends[..self.nodes],
            &self.rows[..self.entries],
            entries,
        )
    }

    /// Entries of L.
    #[must_use]
    pub fn entries(&self) -> usize {
        self.entries
    }
}

impl<const NODES: usize, const ENTRIES: usize> Default for FactorRoom<NODES, ENTRIES> {
    fn default() -> Self {
        Self::new()
    }
}
