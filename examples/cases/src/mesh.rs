//! Boxes of six tetrahedra a cell, their nodes moved a little so that nothing is symmetric.

/// A box at rest, to be a `static`: it costs flash and no start-up code.
#[derive(Debug)]
pub struct Grid<const NODES: usize, const TETS: usize> {
    /// Positions, metres.
    pub nodes: [[f32; 3]; NODES],
    /// Four node numbers a tetrahedron.
    pub tets: [[u32; 4]; TETS],
}

/// Edge of a cell, metres.
pub const CELL: f32 = 0.125;

/// The walks from the low to the high corner of a cell along the axes; the last two corners of an odd walk
/// are swapped, so that all are positively oriented.
const WALKS: [[usize; 3]; 6] = [
    [0, 1, 2],
    [1, 2, 0],
    [2, 0, 1],
    [0, 2, 1],
    [1, 0, 2],
    [2, 1, 0],
];

impl<const NODES: usize, const TETS: usize> Grid<NODES, TETS> {
    /// So many cells along each axis; node (i, j, k) has number (i (ny + 1) + j)(nz + 1) + k. Does not compile
    /// where `NODES` or `TETS` is not the size of the box.
    #[must_use]
    pub const fn new(cells: [usize; 3]) -> Self {
        let [nx, ny, nz] = cells;
        assert!(NODES == (nx + 1) * (ny + 1) * (nz + 1) && TETS == 6 * nx * ny * nz);
        let mut grid = Self {
            nodes: [[0.0; 3]; NODES],
            tets: [[0; 4]; TETS],
        };
        let (mut seed, mut tets) = (1_u32, 0);
        let mut node = 0;
        while node < NODES {
            let at = [
                node / ((ny + 1) * (nz + 1)),
                node / (nz + 1) % (ny + 1),
                node % (nz + 1),
            ];
            let mut axis = 0;
            while axis < 3 {
                // Uniform in [−1, 1), exact in f32.
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let random = (seed >> 8) as f32 / 8_388_608.0 - 1.0;
                grid.nodes[node][axis] = CELL * (at[axis] as f32 + 0.125 * random);
                axis += 1;
            }
            if at[0] < nx && at[1] < ny && at[2] < nz {
                let steps = [(ny + 1) * (nz + 1), nz + 1, 1];
                let mut walk = 0;
                while walk < 6 {
                    let [a, b, c] = WALKS[walk];
                    let first = node + steps[a];
                    let second = first + steps[b];
                    let mut tet = [node, first, second, second + steps[c]];
                    if walk >= 3 {
                        tet = [tet[0], tet[1], tet[3], tet[2]];
                    }
                    grid.tets[tets] = [tet[0] as u32, tet[1] as u32, tet[2] as u32, tet[3] as u32];
                    tets += 1;
                    walk += 1;
                }
            }
            node += 1;
        }
        grid
    }
}
