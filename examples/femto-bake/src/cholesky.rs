//! Ordering and sparse Cholesky by faer, and its result by blocks of nodes.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::simplicial;
use faer::sparse::{SparseColMat, SymbolicSparseColMat, Triplet};

use crate::matrix::{Block, NodeMatrix, transpose};

/// C of A = C Cᵀ in elimination order: the diagonal block of every column, and those below it.
pub struct BlockCholesky {
    /// Nodes in order of elimination.
    pub order: Vec<usize>,
    /// C_jj, lower triangular.
    pub diagonal: Vec<Block>,
    /// (place of i in the order, C_ij) of every column j, ascending.
    pub columns: Vec<Vec<(usize, Block)>>,
}

/// Why there is no factor.
#[derive(Debug)]
pub enum Failure {
    /// The pivot of this node is not positive.
    NotPositiveDefinite {
        /// The node.
        node: usize,
    },
    /// The solver's library gave up: out of memory.
    Library(String),
}

/// Factors the matrix; `dof` is 3 for blocks, 1 for multiples of the identity.
pub fn factor(matrix: &NodeMatrix, dof: usize) -> Result<BlockCholesky, Failure> {
    let nodes = matrix.diagonal.len();
    let library = |e: &dyn std::fmt::Debug| Failure::Library(format!("{e:?}"));
    let (order, place) = ordering(matrix).map_err(|e| library(&e))?;

    // The upper triangle of the permuted matrix, number by number.
    let mut entries = Vec::new();
    let mut push = |row: usize, column: usize, block: &Block| {
        let (row, column, block) = if row <= column {
            (row, column, *block)
        } else {
            (column, row, transpose(block))
        };
        for a in 0..dof {
            for b in 0..dof {
                let (row_dof, column_dof) = (dof * row + a, dof * column + b);
                if row_dof <= column_dof {
                    entries.push(Triplet::new(row_dof, column_dof, block[a][b]));
                }
            }
        }
    };
    for (node, block) in matrix.diagonal.iter().enumerate() {
        push(place[node], place[node], block);
    }
    for (i, j, block) in &matrix.pairs {
        push(place[*i], place[*j], block);
    }
    let size = dof * nodes;
    let upper =
        SparseColMat::try_new_from_triplets(size, size, &entries).map_err(|e| library(&e))?;

    let mut stack = MemBuffer::new(StackReq::any_of(&[
        simplicial::prefactorize_symbolic_cholesky_scratch::<usize>(size, entries.len()),
        simplicial::factorize_simplicial_symbolic_cholesky_scratch::<usize>(size),
        simplicial::factorize_simplicial_numeric_llt_scratch::<usize, f64>(size),
    ]));
    let stack = MemStack::new(&mut stack);
    let (mut tree, mut counts) = (vec![0_isize; size], vec![0_usize; size]);
    let tree =
        simplicial::prefactorize_symbolic_cholesky(&mut tree, &mut counts, upper.symbolic(), stack);
    let symbolic =
        simplicial::factorize_simplicial_symbolic_cholesky(upper.symbolic(), tree, &counts, stack)
            .map_err(|e| library(&e))?;
    let mut values = vec![0.0; symbolic.len_val()];
    simplicial::factorize_simplicial_numeric_llt(
        &mut values,
        upper.as_ref(),
        Default::default(),
        &symbolic,
        stack,
    )
    .map_err(|e| match e {
        faer::linalg::cholesky::llt::factor::LltError::NonPositivePivot { index } => {
            Failure::NotPositiveDefinite {
                node: order[(index / dof).min(nodes - 1)],
            }
        }
    })?;
    Ok(by_blocks(
        order,
        dof,
        symbolic.col_ptr(),
        symbolic.row_idx(),
        &values,
    ))
}

/// Approximate minimum degree on the graph of nodes: the order, and each node's place in it.
fn ordering(matrix: &NodeMatrix) -> Result<(Vec<usize>, Vec<usize>), faer::sparse::FaerError> {
    let nodes = matrix.diagonal.len();
    let mut starts = vec![0_usize; nodes + 1];
    let mut by_column: Vec<(usize, usize)> = matrix.pairs.iter().map(|p| (p.1, p.0)).collect();
    by_column.sort_unstable();
    for (column, _) in &by_column {
        starts[column + 1] += 1;
    }
    for column in 0..nodes {
        starts[column + 1] += starts[column];
    }
    let rows: Vec<usize> = by_column.iter().map(|&(_, row)| row).collect();
    let edges = rows.len();
    let graph = SymbolicSparseColMat::new_checked(nodes, nodes, starts, None, rows);
    let (mut order, mut place) = (vec![0_usize; nodes], vec![0_usize; nodes]);
    let mut stack = MemBuffer::new(amd::order_scratch::<usize>(nodes, edges));
    amd::order(
        &mut order,
        &mut place,
        graph.as_ref(),
        amd::Control::default(),
        MemStack::new(&mut stack),
    )?;
    Ok((order, place))
}

/// Gathers the numbers of C into blocks.
fn by_blocks(
    order: Vec<usize>,
    dof: usize,
    starts: &[usize],
    rows: &[usize],
    values: &[f64],
) -> BlockCholesky {
    let (mut diagonal, mut columns) = (Vec::new(), Vec::new());
    for column in 0..order.len() {
        let mut blocks: Vec<(usize, Block)> = Vec::new();
        for b in 0..dof {
            let range = starts[dof * column + b]..starts[dof * column + b + 1];
            for (&row, &value) in rows[range.clone()].iter().zip(&values[range]) {
                let (place, a) = (row / dof, row % dof);
                let at = blocks
                    .binary_search_by_key(&place, |&(p, _)| p)
                    .unwrap_or_else(|at| {
                        blocks.insert(at, (place, Block::default()));
                        at
                    });
                blocks[at].1[a][b] = value;
            }
        }
        // A column begins on the diagonal.
        let mut pivot = blocks.remove(0).1;
        for block in std::iter::once(&mut pivot).chain(blocks.iter_mut().map(|(_, b)| b)) {
            for axis in dof..3 {
                block[axis][axis] = block[0][0];
            }
        }
        diagonal.push(pivot);
        columns.push(blocks);
    }
    BlockCholesky {
        order,
        diagonal,
        columns,
    }
}
