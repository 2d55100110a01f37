//! Which nodes move together in the coarse space.

use core::fmt;

use crate::element::Layout;
use crate::lane::BLOCK;
use crate::rest::{Rest, TetBlock};

/// No aggregate: the coarse space leaves the node alone.
pub const NONE: u8 = u8::MAX;
/// The most aggregates there can be.
pub const MAX_AGGREGATES: usize = 16;
/// Aggregates of a body of no special kind.
pub const DEFAULT_AGGREGATES: usize = 8;

/// The aggregate of every node, borrowed: what the coarse space of [`coarse`](super::coarse) is made of.
///
/// Any choice is safe; a good one has compact, connected aggregates of like size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Aggregates<'a> {
    of: &'a [u8],
    count: usize,
}

/// What is wrong with a choice of aggregates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AggregatesError {
    /// More than [`MAX_AGGREGATES`].
    TooMany {
        /// How many.
        count: usize,
    },
    /// This node is in an aggregate that there is not.
    Unknown {
        /// The first such node.
        node: usize,
    },
    /// There is not one entry for each node.
    Length {
        /// Entries that are needed.
        nodes: usize,
    },
}

impl fmt::Display for AggregatesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooMany { count } => {
                write!(f, "{count} aggregates, {MAX_AGGREGATES} are the most")
            }
            Self::Unknown { node } => write!(f, "node {node} is in an aggregate that there is not"),
            Self::Length { nodes } => write!(f, "there is not one entry for each of {nodes} nodes"),
        }
    }
}

impl core::error::Error for AggregatesError {}

impl<'a> Aggregates<'a> {
    /// Takes the aggregate of every node: 0 to `count` − 1, or [`NONE`]. Some may be empty.
    ///
    /// # Errors
    /// [`AggregatesError::TooMany`] and [`AggregatesError::Unknown`].
    pub fn new(of: &'a [u8], count: usize) -> Result<Self, AggregatesError> {
        if count > MAX_AGGREGATES {
            return Err(AggregatesError::TooMany { count });
        }
        let known = |&aggregate: &u8| aggregate == NONE || usize::from(aggregate) < count;
        of.iter()
            .position(|aggregate| !known(aggregate))
            .map_or(Ok(Self { of, count }), |node| {
                Err(AggregatesError::Unknown { node })
            })
    }

    /// Divides a body at load: `count` centres, each as far from the others as can be, and every node with
    /// the nearest of them; then twice more from the middles of the aggregates. Distances are along edges
    /// of the mesh, so that limbs which only lie side by side stay apart, and pieces that hang on nothing
    /// get centres first. A piece for which no centre is left is in no aggregate.
    ///
    /// It looks at the mesh alone: the coarse matrix knows what is held. Takes no memory, and some passes over
    /// the mesh for every centre and layer of elements.
    ///
    /// # Errors
    /// [`AggregatesError::Length`] and [`AggregatesError::TooMany`].
    pub fn divide<L: Layout>(
        rest: &Rest<'_, L>,
        count: usize,
        out: &'a mut [u8],
    ) -> Result<Self, AggregatesError> {
        let nodes = rest.nodes.len();
        if out.len() != nodes {
            return Err(AggregatesError::Length { nodes });
        }
        let mut centres = [0; MAX_AGGREGATES];
        let Some(centres) = centres.get_mut(..count) else {
            return Err(AggregatesError::TooMany { count });
        };
        // The node that is reached last from any one is at an end of the body.
        let mut next = grow(rest, &[0], out);
        for known in 0..count {
            if let Some(centre) = centres.get_mut(known) {
                *centre = next.unwrap_or(0);
            }
            next = grow(rest, centres.get(..=known).unwrap_or_default(), out);
        }
        for _ in 0..ROUNDS {
            recentre(rest, out, centres);
            grow(rest, centres, out);
        }
        for of in out.iter_mut().filter(|of| **of >= FRESH) {
            *of = NONE;
        }
        Ok(Self { of: out, count })
    }

    /// The aggregate of every node.
    #[must_use]
    pub const fn of(&self) -> &'a [u8] {
        self.of
    }

    /// How many there are.
    #[must_use]
    pub const fn count(&self) -> usize {
        self.count
    }
}

/// Times that centres move to the middles.
const ROUNDS: usize = 2;
/// Added to the number of an aggregate that has reached a node in the present pass.
const FRESH: u8 = 64;
/// No aggregate has reached the node.
const UNSEEN: u8 = 128;

/// Gives every node to the centre that is nearest along edges, layer by layer; the nodes that none reaches
/// stay [`UNSEEN`]. Returns a node that is not reached, or else one that was reached last.
fn grow<L: Layout>(rest: &Rest<'_, L>, centres: &[usize], out: &mut [u8]) -> Option<usize> {
    out.fill(UNSEEN);
    for (aggregate, &centre) in (0..).zip(centres) {
        match out.get_mut(centre) {
            Some(of) if *of == UNSEEN => *of = aggregate,
            _ => {}
        }
    }
    let mut last = None;
    loop {
        for block in rest.blocks {
            for lane in 0..BLOCK {
                spread(corners(block, lane), out);
            }
        }
        let Some(reached) = out.iter().position(|of| (FRESH..UNSEEN).contains(of)) else {
            break;
        };
        last = Some(reached);
        for of in out.iter_mut().filter(|of| (FRESH..UNSEEN).contains(*of)) {
            *of -= FRESH;
        }
    }
    out.iter().position(|&of| of == UNSEEN).or(last)
}

/// The corners of one tetrahedron.
fn corners(block: &TetBlock, lane: usize) -> [u32; 4] {
    block.corners.map(|corner| corner[lane % BLOCK])
}

/// One tetrahedron: its corners that are not reached go to the first aggregate that reached one before.
fn spread(corners: [u32; 4], out: &mut [u8]) {
    let settled = |&node: &u32| out.get(node as usize).copied().filter(|&of| of < FRESH);
    if let Some(aggregate) = corners.iter().find_map(settled) {
        for node in corners {
            if let Some(of) = out.get_mut(node as usize).filter(|of| **of == UNSEEN) {
                *of = aggregate + FRESH;
            }
        }
    }
}

/// Moves each centre to the node of its aggregate that is nearest to the mean position.
fn recentre<L: Layout>(rest: &Rest<'_, L>, out: &[u8], centres: &mut [usize]) {
    for (aggregate, centre) in (0..).zip(centres) {
        let members = || {
            let all = rest.nodes.iter().zip(out).enumerate();
            all.filter(move |(_, (_, of))| **of == aggregate)
        };
        let (mut sum, mut count) = ([0.0_f64; 3], 0.0);
        for (_, (x, _)) in members() {
            for axis in 0..3 {
                sum[axis] += f64::from(x[axis]);
            }
            count += 1.0;
        }
        let distance = |x: &[f32; 3]| {
            let d: [f64; 3] = core::array::from_fn(|axis| f64::from(x[axis]) - sum[axis] / count);
            d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
        };
        let mut nearest = f64::INFINITY;
        for (node, (x, _)) in members() {
            let distance = distance(x);
            if distance < nearest {
                (nearest, *centre) = (distance, node);
            }
        }
    }
}
