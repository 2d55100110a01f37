//! Makes factors: orders, factors in f64, drops what is asked, and rounds.

use std::fmt;

use femto::element::Sym3;
use femto::preconditioner::factor::{Entries, Factor, FactorError};
use femto::rest::Rest;
use femto::settings::Settings;
use half::f16;

use crate::cholesky::{self, BlockCholesky, Failure};
use crate::matrix::{self, Block, RestStiffness, Scales, add};

/// What is factored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// The whole matrix, in 3×3 blocks.
    #[default]
    Warped,
    /// One number a pair of nodes.
    Laplacian,
}

/// How the numbers below the diagonal are stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// f32
    #[default]
    Single,
    /// binary16
    Half,
}

/// What factor to make.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FactorOptions {
    /// Warped or Laplacian.
    pub kind: Kind,
    /// Single or half.
    pub precision: Precision,
    /// Nodes that will be held; the factor then knows of it. Others can be held as well, at the price
    /// of some iterations.
    pub held: Vec<u32>,
    /// Entries smaller than this part of what they couple, ‖C_ii⁻¹ C_ij‖ of A = C Cᵀ, are dropped: less
    /// flash and time, less gained by an iteration. 0 keeps all. 0.005 drops most of a large body's at little loss.
    pub drop: f64,
    /// At most so many entries (blocks, or numbers of a Laplacian) are kept, the largest.
    pub fill: Option<usize>,
}

/// Why there is no factor.
#[derive(Debug, PartialEq)]
#[non_exhaustive]
pub enum HostFactorError {
    /// More nodes than a factor can name: 65,535.
    TooManyNodes {
        /// Nodes of the mesh.
        nodes: usize,
    },
    /// A held node that the mesh does not have.
    Held {
        /// The node.
        node: u32,
    },
    /// The matrix is not positive definite.
    NotPositiveDefinite {
        /// The node of the first pivot that is not.
        node: usize,
    },
    /// An entry is too large to be stored in half precision.
    HalfRange {
        /// The entry.
        value: f64,
    },
    /// What was rounded is no factor.
    Rounded(FactorError),
    /// The solver's library gave up.
    Library(String),
}

impl fmt::Display for HostFactorError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManyNodes { nodes } => {
                write!(f, "{nodes} nodes are more than a factor can name (65535)")
            }
            Self::Held { node } => write!(f, "held node {node} does not exist"),
            Self::NotPositiveDefinite { node } => {
                write!(f, "the matrix is not positive definite at node {node}")
            }
            Self::HalfRange { value } => {
                write!(
                    f,
                    "entry {value:e} of the factor is too large for half precision"
                )
            }
            Self::Rounded(e) => write!(f, "after rounding: {e}"),
            Self::Library(e) => write!(f, "sparse factorisation: {e}"),
        }
    }
}

impl std::error::Error for HostFactorError {}

impl From<Failure> for HostFactorError {
    fn from(failure: Failure) -> Self {
        match failure {
            Failure::NotPositiveDefinite { node } => Self::NotPositiveDefinite { node },
            Failure::Library(e) => Self::Library(e),
        }
    }
}

/// A factor in `Vec`s.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnedFactor {
    fingerprint: u64,
    order: Vec<u16>,
    ends: Vec<u32>,
    rows: Vec<u16>,
    entries: OwnedEntries,
}

#[derive(Clone, Debug, PartialEq)]
enum OwnedEntries {
    Warped(Vec<Sym3<f32>>, Vec<[f32; 9]>),
    WarpedHalf(Vec<Sym3<f32>>, Vec<[u16; 9]>),
    Laplacian(Vec<f32>, Vec<f32>),
    LaplacianHalf(Vec<f32>, Vec<u16>),
}

impl OwnedFactor {
    /// The factor, borrowed.
    #[must_use]
    pub fn view(&self) -> Factor<'_> {
        // Checked when it was made.
        self.checked().expect("a checked factor")
    }

    fn checked(&self) -> Result<Factor<'_>, FactorError> {
        let entries = match &self.entries {
            OwnedEntries::Warped(pivots, lower) => Entries::Warped { pivots, lower },
            OwnedEntries::WarpedHalf(pivots, lower) => Entries::WarpedHalf { pivots, lower },
            OwnedEntries::Laplacian(pivots, lower) => Entries::Laplacian { pivots, lower },
            OwnedEntries::LaplacianHalf(pivots, lower) => Entries::LaplacianHalf { pivots, lower },
        };
        Factor::new(
            self.fingerprint,
            &self.order,
            &self.ends,
            &self.rows,
            entries,
        )
    }
}

/// Factors the rest matrix of a body for the time step and θ of `settings`.
///
/// # Errors
/// [`HostFactorError`].
pub fn factor<L: RestStiffness>(
    rest: &Rest<'_, L>,
    settings: &Settings<'_>,
    options: &FactorOptions,
) -> Result<OwnedFactor, HostFactorError> {
    let nodes = rest.nodes.len();
    if nodes > usize::from(u16::MAX) {
        return Err(HostFactorError::TooManyNodes { nodes });
    }
    let mut held = vec![false; nodes];
    for &node in &options.held {
        *held
            .get_mut(node as usize)
            .ok_or(HostFactorError::Held { node })? = true;
    }
    // A = (1 + θhα) M + (θ²h² + θhβ) K
    let (damped, header) = (
        f64::from(settings.theta()) * f64::from(settings.dt()),
        rest.header,
    );
    let scales = Scales {
        mass: 1.0 + damped * f64::from(header.alpha),
        stiffness: damped * damped + damped * f64::from(header.beta),
    };
    let (matrix, dof) = match options.kind {
        Kind::Warped => (matrix::elastic(rest, scales, &held), 3),
        Kind::Laplacian => (matrix::laplacian(rest, scales, &held), 1),
    };
    let mut cholesky = cholesky::factor(&matrix, dof)?;
    thin(&mut cholesky, options, rest.nodes);
    let owned = store(&cholesky, header.fingerprint, options)?;
    owned.checked().map_err(HostFactorError::Rounded)?;
    Ok(owned)
}

/// Drops the blocks that couple least, and adds each to the one of its column that is kept for the nearest node:
/// the columns still sum to the same, so that L D Lᵀ acts on a motion that hardly differs between neighbours as it did.
/// (Modified incomplete factors, Gustafsson 1978, add what they drop to the diagonal instead. Here the unit
/// triangular L keeps its diagonal, so that L D Lᵀ stays positive definite whatever is dropped.)
fn thin(cholesky: &mut BlockCholesky, options: &FactorOptions, nodes: &[[f32; 3]]) {
    let entries: usize = cholesky.columns.iter().map(Vec::len).sum();
    let few = options.fill.filter(|&fill| fill < entries);
    if options.drop <= 0.0 && few.is_none() {
        return;
    }
    let weight = |i: usize, block: &Block| norm(&forward(&cholesky.diagonal[i], block));
    let mut weights: Vec<Vec<f64>> = Vec::new();
    for column in &cholesky.columns {
        weights.push(column.iter().map(|(i, block)| weight(*i, block)).collect());
    }
    let mut least = options.drop;
    if let Some(fill) = few {
        let mut all: Vec<f64> = weights.iter().flatten().copied().collect();
        all.sort_unstable_by(|a, b| b.total_cmp(a));
        // The first that no longer fits, and all of its weight.
        least = least.max(all[fill].next_up());
    }
    let at: Vec<[f64; 3]> = cholesky
        .order
        .iter()
        .map(|&node| nodes[node].map(f64::from))
        .collect();
    for (column, weights) in cholesky.columns.iter_mut().zip(weights) {
        let weighed = column.drain(..).zip(weights);
        let (mut kept, dropped): (Vec<_>, Vec<_>) = weighed.partition(|(_, w)| *w >= least);
        for ((i, block), _) in dropped {
            let near = kept.iter_mut().min_by(|((a, _), _), ((b, _), _)| {
                square(&at[*a], &at[i]).total_cmp(&square(&at[*b], &at[i]))
            });
            if let Some(((_, near), _)) = near {
                add(near, &block);
            }
        }
        column.extend(kept.into_iter().map(|(entry, _)| entry));
    }
}

/// |a − b|²
fn square(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum()
}

/// Frobenius
fn norm(block: &Block) -> f64 {
    block.iter().flatten().map(|x| x * x).sum::<f64>().sqrt()
}

/// C⁻¹ B for lower triangular C.
fn forward(c: &Block, b: &Block) -> Block {
    let mut x = *b;
    for column in 0..3 {
        for row in 0..3 {
            let known: f64 = (0..row).map(|k| c[row][k] * x[k][column]).sum();
            x[row][column] = (x[row][column] - known) / c[row][row];
        }
    }
    x
}

/// B C⁻¹ for lower triangular C.
fn divided(b: &Block, c: &Block) -> Block {
    let mut x = *b;
    for row in &mut x {
        for column in (0..3).rev() {
            let known: f64 = (column + 1..3).map(|k| row[k] * c[k][column]).sum();
            row[column] = (row[column] - known) / c[column][column];
        }
    }
    x
}

/// L_ij = C_ij C_jj⁻¹ and D_j⁻¹ = (C_jj C_jjᵀ)⁻¹, rounded.
fn store(
    cholesky: &BlockCholesky,
    fingerprint: u64,
    options: &FactorOptions,
) -> Result<OwnedFactor, HostFactorError> {
    let narrow = |i: usize| u16::try_from(i).expect("at most 65,535 nodes");
    let order: Vec<u16> = cholesky.order.iter().map(|&node| narrow(node)).collect();
    let (mut ends, mut rows, mut blocks) = (Vec::new(), Vec::new(), Vec::new());
    let mut pivots = vec![Block::default(); order.len()];
    for ((&node, c), column) in order.iter().zip(&cholesky.diagonal).zip(&cholesky.columns) {
        for (place, block) in column {
            rows.push(order[*place]);
            blocks.push(divided(block, c));
        }
        ends.push(u32::try_from(rows.len()).expect("at most 65,535² entries"));
        // C⁻ᵀ C⁻¹
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let inverse = forward(c, &identity);
        pivots[usize::from(node)] = std::array::from_fn(|a| {
            std::array::from_fn(|b| (0..3).map(|k| inverse[k][a] * inverse[k][b]).sum())
        });
    }
    let by_columns = |b: &Block| std::array::from_fn(|k| b[k % 3][k / 3]);
    let symmetric =
        |p: &Block| [p[0][0], p[0][1], p[0][2], p[1][1], p[1][2], p[2][2]].map(|x| x as f32);
    let blocks = blocks.iter();
    let pivots = pivots.iter();
    let entries = match (options.kind, options.precision) {
        (Kind::Warped, Precision::Single) => OwnedEntries::Warped(
            pivots.map(symmetric).collect(),
            blocks
                .map(|b| by_columns(b).map(|x: f64| x as f32))
                .collect(),
        ),
        (Kind::Warped, Precision::Half) => {
            let mut lower = Vec::new();
            for block in blocks {
                let mut halves = [0; 9];
                for (half, x) in halves.iter_mut().zip(by_columns(block)) {
                    *half = to_half(x)?;
                }
                lower.push(halves);
            }
            OwnedEntries::WarpedHalf(pivots.map(symmetric).collect(), lower)
        }
        (Kind::Laplacian, Precision::Single) => OwnedEntries::Laplacian(
            pivots.map(|p| p[0][0] as f32).collect(),
            blocks.map(|b| b[0][0] as f32).collect(),
        ),
        (Kind::Laplacian, Precision::Half) => OwnedEntries::LaplacianHalf(
            pivots.map(|p| p[0][0] as f32).collect(),
            blocks.map(|b| to_half(b[0][0])).collect::<Result<_, _>>()?,
        ),
    };
    Ok(OwnedFactor {
        fingerprint,
        order,
        ends,
        rows,
        entries,
    })
}

/// The bits of the nearest binary16. Subnormals become zero: they would cost more to read than they say.
fn to_half(x: f64) -> Result<u16, HostFactorError> {
    let half = f16::from_f64(x);
    if !half.is_finite() {
        return Err(HostFactorError::HalfRange { value: x });
    }
    Ok(if half.is_normal() { half.to_bits() } else { 0 })
}
