//! The assembled matrix that femto does without: 3×3 blocks, rows sorted, both triangles.

use femto::operator::RotationBlock;
use femto::polar;
use femto::rest::Rest;
use nalgebra::RealField;
use wide::f32x4;

/// The numbers of a matrix, and the fastest product that there is for them.
pub trait Scalar: RealField + Copy + Default {
    /// `out` = A u
    fn product(matrix: &BlockCsr<Self>, u: &[[Self; 3]], out: &mut [[Self; 3]]);
}

impl Scalar for f32 {
    fn product(matrix: &BlockCsr<Self>, u: &[[Self; 3]], out: &mut [[Self; 3]]) {
        matrix.product_in_lanes(u, out);
    }
}

impl Scalar for f64 {
    fn product(matrix: &BlockCsr<Self>, u: &[[Self; 3]], out: &mut [[Self; 3]]) {
        matrix.product(u, out);
    }
}

/// The sparsity pattern of a mesh, and a matrix in it.
pub struct BlockCsr<T = f32> {
    /// First entry of each row, and the end of the last.
    starts: Vec<u32>,
    columns: Vec<u32>,
    /// Nine floats a block, by columns, and three more: the last block can be read as twelve.
    values: Vec<T>,
    /// Entry of each node's diagonal block.
    diagonal: Vec<u32>,
    /// Entries of each tetrahedron's blocks, `[row corner][column corner]`.
    slots: Vec<[[u32; 4]; 4]>,
}

/// Rotated gradients of all four corners, and λV and μV times the stiffness factor.
#[derive(Clone, Copy)]
pub struct Element {
    pub gradients: [[f32; 3]; 4],
    pub lambda: f32,
    pub mu: f32,
}

impl<T: Scalar> BlockCsr<T> {
    /// The pattern of a mesh, all zeros.
    pub fn new(nodes: usize, tets: &[[u32; 4]]) -> Self {
        let mut neighbours: Vec<Vec<u32>> = (0..nodes as u32).map(|node| vec![node]).collect();
        for tet in tets {
            for &node in tet {
                neighbours[node as usize].extend(tet);
            }
        }
        let (mut starts, mut columns, mut diagonal) = (vec![0], Vec::new(), Vec::new());
        for (node, row) in (0_u32..).zip(&mut neighbours) {
            row.sort_unstable();
            row.dedup();
            diagonal.push((columns.len() + row.partition_point(|&column| column < node)) as u32);
            columns.extend_from_slice(row);
            starts.push(columns.len() as u32);
        }
        let entry = |i: u32, j: u32| {
            starts[i as usize] + neighbours[i as usize].partition_point(|&column| column < j) as u32
        };
        let slots = tets
            .iter()
            .map(|tet| tet.map(|i| tet.map(|j| entry(i, j))))
            .collect();
        let values = vec![T::zero(); 9 * columns.len() + 3];
        Self {
            starts,
            columns,
            values,
            diagonal,
            slots,
        }
    }

    /// Zero but for the masses on the diagonal.
    pub fn clear(&mut self, masses: impl Iterator<Item = T>) {
        self.values.fill(T::zero());
        for (&entry, mass) in self.diagonal.iter().zip(masses) {
            for axis in 0..3 {
                self.values[9 * entry as usize + 4 * axis] = mass;
            }
        }
    }

    /// Adds the blocks of one tetrahedron, by columns.
    #[inline]
    pub fn add(&mut self, tet: usize, block: impl Fn(usize, usize) -> [T; 9]) {
        let slots = self.slots[tet];
        for (i, row) in slots.iter().enumerate() {
            for (j, &entry) in row.iter().enumerate() {
                let at = 9 * entry as usize;
                for (sum, k) in self.values[at..at + 9].iter_mut().zip(block(i, j)) {
                    *sum += k;
                }
            }
        }
    }

    /// `out` = A u, as one writes it.
    pub fn product(&self, u: &[[T; 3]], out: &mut [[T; 3]]) {
        let (blocks, _) = self.values.as_chunks::<9>();
        for (out, row) in out.iter_mut().zip(self.starts.windows(2)) {
            let row = row[0] as usize..row[1] as usize;
            let mut sum = [T::zero(); 3];
            for (k, &column) in blocks[row.clone()].iter().zip(&self.columns[row]) {
                let [x, y, z] = u[column as usize];
                for axis in 0..3 {
                    sum[axis] += k[axis] * x + k[3 + axis] * y + k[6 + axis] * z;
                }
            }
            *out = sum;
        }
    }

    /// Row, column and entries (by columns) of every block.
    pub fn blocks(&self) -> impl Iterator<Item = (usize, usize, &[T])> {
        let rows = self.starts.windows(2).enumerate();
        let places = rows.flat_map(|(i, row)| (row[0]..row[1]).map(move |entry| (i, entry)));
        places.map(|(i, entry)| {
            let (j, at) = (self.columns[entry as usize], 9 * entry as usize);
            (i, j as usize, &self.values[at..at + 9])
        })
    }

    /// The diagonal.
    pub fn diagonal(&self) -> impl Iterator<Item = [T; 3]> {
        self.diagonal
            .iter()
            .map(|&entry| [0, 4, 8].map(|k| self.values[9 * entry as usize + k]))
    }
}

impl BlockCsr {
    /// Assembles M + K anew: K_ij = λ G_i G_jᵀ + μ (G_i·G_j) I + μ G_j G_iᵀ.
    pub fn refill(&mut self, inertia: &[f32], elements: &[Element]) {
        self.clear(inertia.iter().copied());
        for (tet, element) in elements.iter().enumerate() {
            let Element {
                gradients,
                lambda,
                mu,
            } = element;
            let scaled = gradients.map(|g| g.map(|g| lambda * g));
            let halved = gradients.map(|g| g.map(|g| mu * g));
            self.add(tet, |i, j| {
                let (g, h) = (gradients[i], gradients[j]);
                let dot = halved[i][0] * h[0] + halved[i][1] * h[1] + halved[i][2] * h[2];
                core::array::from_fn(|k| {
                    let (row, column) = (k % 3, k / 3);
                    let sum = g[row] * scaled[j][column] + h[row] * halved[i][column];
                    if row == column { sum + dot } else { sum }
                })
            });
        }
    }

    /// `out` = A u, a column of three in four lanes.
    pub fn product_in_lanes(&self, u: &[[f32; 3]], out: &mut [[f32; 3]]) {
        for (out, row) in out.iter_mut().zip(self.starts.windows(2)) {
            let (start, end) = (row[0] as usize, row[1] as usize);
            let blocks = self.values[9 * start..9 * end + 3].windows(12).step_by(9);
            let mut sums = [f32x4::ZERO; 3];
            for (k, &column) in blocks.zip(&self.columns[start..end]) {
                let u = u[column as usize];
                for axis in 0..3 {
                    let k = [0, 1, 2, 3].map(|row| k[3 * axis + row]);
                    sums[axis] += f32x4::new(k) * f32x4::splat(u[axis]);
                }
            }
            let [x, y, z, _] = (sums[0] + sums[1] + sums[2]).to_array();
            *out = [x, y, z];
        }
    }
}

/// The rotated gradients of a body, tetrahedron by tetrahedron, in the units of femto's operator.
pub fn elements(rest: &Rest<'_>, rotations: &[RotationBlock], stiffness: f32) -> Vec<Element> {
    let unit = rest.header.length_unit;
    let tets = 0..rest.header.tets as usize;
    tets.map(|tet| {
        let (block, lane) = (&rest.blocks[tet / 8], tet % 8);
        let q = polar::matrix(&rotations[tet / 8].0.map(|component| component[lane]));
        let g: [[f32; 3]; 3] = block.gradients.map(|g| {
            let g = g.map(|axis| axis[lane]);
            q.map(|row| unit * (row[0] * g[0] + row[1] * g[1] + row[2] * g[2]))
        });
        let first = [0, 1, 2].map(|axis| -(g[0][axis] + g[1][axis] + g[2][axis]));
        Element {
            gradients: [first, g[0], g[1], g[2]],
            lambda: stiffness * block.lambda_v[lane],
            mu: stiffness * block.mu_v[lane],
        }
    })
    .collect()
}
