//! A body's state: x, v, their history, and the rotations; where a body flows or breaks, its plastic strain and what
//! of it has broken. All that a snapshot must save for a replay that is exact to the bit.

use crate::element::Layout;
#[cfg(feature = "fracture")]
use crate::fracture::{BrokenBlock, has_failed};
use crate::lane::{BLOCK, Native};
use crate::mesh::MeshError;
use crate::operator::{RotationBlock, fit_cold};
#[cfg(feature = "plasticity")]
use crate::plasticity::PlasticBlock;
use crate::rest::Rest;
use crate::vector::copy;

/// A body's state, borrowed for reading.
///
/// More fields come with features; [`StateRef::new`] makes one.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct StateRef<'a> {
    /// Positions, metres.
    pub x: &'a [[f32; 3]],
    /// Velocities, m/s.
    pub v: &'a [[f32; 3]],
    /// Velocities of the last steps, latest first, one body's nodes after the other.
    pub history: &'a [[f32; 3]],
    /// Rotations of the tetrahedra, as unit quaternions, block by block.
    pub rotations: &'a [RotationBlock],
    /// Plastic strain of the tetrahedra, or empty.
    #[cfg(feature = "plasticity")]
    pub plastic: &'a [PlasticBlock],
    /// Which of the tetrahedra have broken, or empty.
    #[cfg(feature = "fracture")]
    pub broken: &'a [BrokenBlock],
}

impl<'a> StateRef<'a> {
    /// The plastic strain of tetrahedron `tet`, as Frobenius' norm; 0 where there is none.
    #[cfg(feature = "plasticity")]
    #[must_use]
    pub fn plastic_strain(&self, tet: usize) -> f32 {
        let block = self.plastic.get(tet / BLOCK);
        block.map_or(0.0, |block| block.norm(tet % BLOCK))
    }

    /// Whether tetrahedron `tet` has failed.
    #[cfg(feature = "fracture")]
    #[must_use]
    pub fn is_broken(&self, tet: usize) -> bool {
        has_failed(self.broken, tet)
    }

    /// Of a body that neither flows nor breaks.
    #[must_use]
    pub const fn new(
        x: &'a [[f32; 3]],
        v: &'a [[f32; 3]],
        history: &'a [[f32; 3]],
        rotations: &'a [RotationBlock],
    ) -> Self {
        Self {
            x,
            v,
            history,
            rotations,
            #[cfg(feature = "plasticity")]
            plastic: &[],
            #[cfg(feature = "fracture")]
            broken: &[],
        }
    }
}

/// A body's state, borrowed for a step.
///
/// More fields come with features; [`StateMut::new`] makes one.
#[derive(Debug)]
#[non_exhaustive]
pub struct StateMut<'a> {
    /// Positions, metres.
    pub x: &'a mut [[f32; 3]],
    /// Velocities, m/s.
    pub v: &'a mut [[f32; 3]],
    /// Velocities of the last steps, latest first, one body's nodes after the other.
    pub history: &'a mut [[f32; 3]],
    /// Rotations of the tetrahedra, as unit quaternions, block by block.
    pub rotations: &'a mut [RotationBlock],
    /// Plastic strain of the tetrahedra, or empty.
    #[cfg(feature = "plasticity")]
    pub plastic: &'a mut [PlasticBlock],
    /// Which of the tetrahedra have broken, or empty.
    #[cfg(feature = "fracture")]
    pub broken: &'a mut [BrokenBlock],
}

impl<'a> StateMut<'a> {
    /// Of a body that neither flows nor breaks.
    #[must_use]
    pub const fn new(
        x: &'a mut [[f32; 3]],
        v: &'a mut [[f32; 3]],
        history: &'a mut [[f32; 3]],
        rotations: &'a mut [RotationBlock],
    ) -> Self {
        Self {
            x,
            v,
            history,
            rotations,
            #[cfg(feature = "plasticity")]
            plastic: &mut [],
            #[cfg(feature = "fracture")]
            broken: &mut [],
        }
    }
}

/// Why a state was not taken over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StateError {
    /// Positions or velocities are not one a node.
    Length {
        /// Entries that were given.
        given: usize,
        /// Nodes of the body.
        nodes: usize,
    },
    /// A node's position or velocity is not finite.
    NonFinite {
        /// The node.
        node: u32,
    },
}

impl core::fmt::Display for StateError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match *self {
            Self::Length { given, nodes } => {
                write!(f, "{given} entries were given for {nodes} nodes")
            }
            Self::NonFinite { node } => {
                write!(f, "the position or velocity of node {node} is not finite")
            }
        }
    }
}

impl core::error::Error for StateError {}

impl StateMut<'_> {
    /// Places the body: positions (metres) and velocities (m/s), one a node. Fits the rotations from
    /// nothing, and forgets the history, plastic strain and what has broken.
    ///
    /// # Errors
    /// [`StateError`]; the state is then as it was.
    pub fn place<L: Layout>(
        &mut self,
        rest: &Rest<'_, L>,
        x: &[[f32; 3]],
        v: &[[f32; 3]],
    ) -> Result<(), StateError> {
        let nodes = self.x.len();
        for given in [x.len(), v.len()] {
            if given != nodes {
                return Err(StateError::Length { given, nodes });
            }
        }
        let finite = |u: &[f32; 3]| u.iter().all(|c| c.is_finite());
        if let Some((node, _)) = (0_u32..)
            .zip(x.iter().zip(v))
            .find(|(_, (x, v))| !(finite(x) && finite(v)))
        {
            return Err(StateError::NonFinite { node });
        }
        copy(self.x, x);
        copy(self.v, v);
        self.renew(rest);
        Ok(())
    }

    /// As if it had always been at x: all but x and v.
    fn renew<L: Layout>(&mut self, rest: &Rest<'_, L>) {
        self.history.fill([0.0; 3]);
        fit_cold::<Native, L>(rest, self.x, self.rotations);
        #[cfg(feature = "plasticity")]
        self.plastic.fill(PlasticBlock::ZERO);
        #[cfg(feature = "fracture")]
        self.broken.fill(BrokenBlock::ZERO);
    }
}

/// Bytes of state: `nodes` nodes, [`blocks`](crate::lane::blocks) blocks of tetrahedra, and so many past velocities
/// ([`Start::history`](crate::settings::Start::history)).
#[must_use]
pub const fn state_bytes(nodes: usize, blocks: usize, history: usize) -> usize {
    (2 + history) * nodes * size_of::<[f32; 3]>() + blocks * size_of::<RotationBlock>()
}

/// Bytes of state that plastic strain takes besides.
#[cfg(feature = "plasticity")]
#[must_use]
pub const fn plastic_bytes(blocks: usize) -> usize {
    blocks * size_of::<PlasticBlock>()
}

/// Bytes of state that fracture takes besides.
#[cfg(feature = "fracture")]
#[must_use]
pub const fn broken_bytes(blocks: usize) -> usize {
    blocks * size_of::<BrokenBlock>()
}

/// State of a body of up to `NODES` nodes and `BLOCKS` blocks of eight tetrahedra, with `HISTORY`
/// past velocities. `DAMAGE` is 0, or `BLOCKS` for a body that flows or breaks (what the features make possible).
///
/// `Clone` is left out so that no copy passes over the stack; [`State::copy_from`] is the snapshot.
#[derive(Debug)]
pub struct State<
    const NODES: usize,
    const BLOCKS: usize,
    const HISTORY: usize = 0,
    const DAMAGE: usize = 0,
> {
    nodes: usize,
    blocks: usize,
    x: [[f32; 3]; NODES],
    v: [[f32; 3]; NODES],
    history: [[[f32; 3]; NODES]; HISTORY],
    rotations: [RotationBlock; BLOCKS],
    #[cfg(feature = "plasticity")]
    plastic: [PlasticBlock; DAMAGE],
    #[cfg(feature = "fracture")]
    broken: [BrokenBlock; DAMAGE],
}

impl<const NODES: usize, const BLOCKS: usize, const HISTORY: usize, const DAMAGE: usize>
    State<NODES, BLOCKS, HISTORY, DAMAGE>
{
    /// Nothing yet. All bits zero.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            nodes: 0,
            blocks: 0,
            x: [[0.0; 3]; NODES],
            v: [[0.0; 3]; NODES],
            history: [[[0.0; 3]; NODES]; HISTORY],
            rotations: [RotationBlock::ZERO; BLOCKS],
            #[cfg(feature = "plasticity")]
            plastic: [PlasticBlock::ZERO; DAMAGE],
            #[cfg(feature = "fracture")]
            broken: [BrokenBlock::ZERO; DAMAGE],
        }
    }

    /// Puts the state at rest in the rest shape.
    ///
    /// # Errors
    /// [`MeshError::TooManyNodes`], [`MeshError::TooManyTets`]; the state is then as it was.
    pub fn reset<L: Layout>(&mut self, rest: &Rest<'_, L>) -> Result<(), MeshError> {
        let (nodes, blocks) = (rest.nodes.len(), rest.blocks.len());
        if nodes > NODES {
            return Err(MeshError::TooManyNodes {
                needed: nodes,
                capacity: NODES,
            });
        }
        if blocks > BLOCKS {
            return Err(MeshError::TooManyTets {
                needed: rest.header.tets as usize,
                capacity: BLOCKS * BLOCK,
            });
        }
        (self.nodes, self.blocks) = (nodes, blocks);
        let mut state = self.view_mut();
        copy(state.x, rest.nodes);
        state.v.fill([0.0; 3]);
        state.renew(rest);
        Ok(())
    }

    /// Takes over another state, bit for bit: a snapshot, or its restoring.
    pub fn copy_from(&mut self, other: &Self) {
        (self.nodes, self.blocks) = (other.nodes, other.blocks);
        self.x.copy_from_slice(&other.x);
        self.v.copy_from_slice(&other.v);
        self.history.copy_from_slice(&other.history);
        self.rotations.copy_from_slice(&other.rotations);
        #[cfg(feature = "plasticity")]
        self.plastic.copy_from_slice(&other.plastic);
        #[cfg(feature = "fracture")]
        self.broken.copy_from_slice(&other.broken);
    }

    /// Borrows it for reading.
    #[must_use]
    pub fn view(&self) -> StateRef<'_> {
        StateRef {
            x: self.x.get(..self.nodes).unwrap_or_default(),
            v: self.v.get(..self.nodes).unwrap_or_default(),
            history: self
                .history
                .as_flattened()
                .get(..HISTORY * self.nodes)
                .unwrap_or_default(),
            rotations: self.rotations.get(..self.blocks).unwrap_or_default(),
            #[cfg(feature = "plasticity")]
            plastic: self.plastic.get(..self.blocks).unwrap_or_default(),
            #[cfg(feature = "fracture")]
            broken: self.broken.get(..self.blocks).unwrap_or_default(),
        }
    }

    /// Borrows it for a step.
    #[must_use]
    pub fn view_mut(&mut self) -> StateMut<'_> {
        StateMut {
            x: self.x.get_mut(..self.nodes).unwrap_or_default(),
            v: self.v.get_mut(..self.nodes).unwrap_or_default(),
            history: self
                .history
                .as_flattened_mut()
                .get_mut(..HISTORY * self.nodes)
                .unwrap_or_default(),
            rotations: self.rotations.get_mut(..self.blocks).unwrap_or_default(),
            #[cfg(feature = "plasticity")]
            plastic: self.plastic.get_mut(..self.blocks).unwrap_or_default(),
            #[cfg(feature = "fracture")]
            broken: self.broken.get_mut(..self.blocks).unwrap_or_default(),
        }
    }
}

impl<const NODES: usize, const BLOCKS: usize, const HISTORY: usize, const DAMAGE: usize> Default
    for State<NODES, BLOCKS, HISTORY, DAMAGE>
{
    fn default() -> Self {
        Self::new()
    }
}
