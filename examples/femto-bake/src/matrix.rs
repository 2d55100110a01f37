//! The matrix at rest, A₀ = c_M M + c_K K(rest) over the mass unit, by pairs of nodes, in f64.

use femto::element::{Dense, Factored, Layout, PAIRS};
use femto::lane::BLOCK;
use femto::rest::{Rest, TetBlock};

/// A 3×3 block, or one number of the Laplacian.
pub type Block = [[f64; 3]; 3];

/// Layouts whose rest stiffness a host can read.
pub trait RestStiffness: Layout {
    /// K_ij of one tetrahedron for the six [`PAIRS`].
    fn pairs(tet: &TetBlock, stiffness: &Self::Stiffness, lane: usize) -> [Block; 6];
}

impl RestStiffness for Factored {
    /// V [λ g_i g_jᵀ + μ (g_i·g_j) I + μ g_j g_iᵀ]
    fn pairs(tet: &TetBlock, (): &(), lane: usize) -> [Block; 6] {
        let g = gradients(tet, lane);
        let (lambda, mu) = (f64::from(tet.lambda_v[lane]), f64::from(tet.mu_v[lane]));
        PAIRS.map(|(i, j)| {
            let isotropic = mu * dot(&g[i], &g[j]);
            std::array::from_fn(|a| {
                std::array::from_fn(|b| {
                    let k = lambda * g[i][a] * g[j][b] + mu * g[j][a] * g[i][b];
                    if a == b { k + isotropic } else { k }
                })
            })
        })
    }
}

impl RestStiffness for Dense {
    fn pairs(_: &TetBlock, stiffness: &Self::Stiffness, lane: usize) -> [Block; 6] {
        stiffness
            .0
            .map(|block| block.map(|row| row.map(|k| f64::from(k[lane]))))
    }
}

fn gradients(tet: &TetBlock, lane: usize) -> [[f64; 3]; 4] {
    let [a, b, c] = tet.gradients.map(|g| g.map(|x| f64::from(x[lane])));
    let first = std::array::from_fn(|k| -(a[k] + b[k] + c[k]));
    [first, a, b, c]
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A symmetric matrix over the nodes: diagonal blocks, and one block for each connected pair i < j.
pub struct NodeMatrix {
    pub diagonal: Vec<Block>,
    /// (i, j, A_ij), sorted, each pair once.
    pub pairs: Vec<(usize, usize, Block)>,
}

/// c_M and c_K of A in SI units.
#[derive(Clone, Copy, Debug)]
pub struct Scales {
    pub mass: f64,
    pub stiffness: f64,
}

/// The whole matrix. Rows and columns of held nodes keep their diagonal block only.
pub fn elastic<L: RestStiffness>(rest: &Rest<'_, L>, scales: Scales, held: &[bool]) -> NodeMatrix {
    assemble(rest, scales, held, |tet, stiffness, lane| {
        L::pairs(tet, stiffness, lane)
    })
}

/// The Laplacian c_M M + c_K Σ w V g_i·g_j, as multiples of the identity.
///
/// The weight is that of the stiffness itself, averaged over directions: tr K_ij/3 = (λ + 4μ)/3 V g_i·g_j,
/// with λ held at 2μ: beyond it, it is volume that is stiff, which no scalar can say.
pub fn laplacian<L: RestStiffness>(
    rest: &Rest<'_, L>,
    scales: Scales,
    held: &[bool],
) -> NodeMatrix {
    assemble(rest, scales, held, |tet, _, lane| {
        let g = gradients(tet, lane);
        let (lambda, mu) = (f64::from(tet.lambda_v[lane]), f64::from(tet.mu_v[lane]));
        let weight = (lambda.clamp(0.0, 2.0 * mu) + 4.0 * mu) / 3.0;
        PAIRS.map(|(i, j)| scaled_identity(weight * dot(&g[i], &g[j])))
    })
}

fn scaled_identity(x: f64) -> Block {
    [[x, 0.0, 0.0], [0.0, x, 0.0], [0.0, 0.0, x]]
}

fn assemble<L: Layout>(
    rest: &Rest<'_, L>,
    scales: Scales,
    held: &[bool],
    element: impl Fn(&TetBlock, &L::Stiffness, usize) -> [Block; 6],
) -> NodeMatrix {
    let unit = f64::from(rest.header.mass_unit);
    let (mass, stiffness) = (scales.mass / unit, scales.stiffness / unit);
    let mut diagonal: Vec<Block> = rest
        .masses
        .iter()
        .map(|m| scaled_identity(mass * f64::from(*m)))
        .collect();
    let mut pairs = Vec::new();
    let tets = rest.header.tets as usize;
    for t in 0..tets {
        let (tet, lane) = (&rest.blocks[t / BLOCK], t % BLOCK);
        let k = element(tet, &rest.stiffness[t / BLOCK], lane);
        for ((i, j), k) in PAIRS.into_iter().zip(k) {
            let (a, b) = (tet.corners[i][lane] as usize, tet.corners[j][lane] as usize);
            for row in 0..3 {
                for column in 0..3 {
                    // Rows sum to zero: K_ii = −Σ_j K_ij.
                    diagonal[a][row][column] -= stiffness * k[row][column];
                    diagonal[b][row][column] -= stiffness * k[column][row];
                }
            }
            if !(held[a] || held[b]) {
                let k = k.map(|row| row.map(|x| stiffness * x));
                pairs.push(if a < b {
                    (a, b, k)
                } else {
                    (b, a, transpose(&k))
                });
            }
        }
    }
    for block in &mut diagonal {
        let other = transpose(block);
        for (row, other) in block.iter_mut().zip(other) {
            for (x, y) in row.iter_mut().zip(other) {
                *x = 0.5 * (*x + y);
            }
        }
    }
    pairs.sort_by_key(|&(i, j, _)| (i, j));
    pairs.dedup_by(|next, sum| {
        let same = (next.0, next.1) == (sum.0, sum.1);
        if same {
            add(&mut sum.2, &next.2);
        }
        same
    });
    NodeMatrix { diagonal, pairs }
}

/// a += b
pub fn add(a: &mut Block, b: &Block) {
    for (x, y) in a.as_flattened_mut().iter_mut().zip(b.as_flattened()) {
        *x += y;
    }
}

pub fn transpose(m: &Block) -> Block {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}
