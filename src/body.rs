//! Storage. Five kinds of data are kept apart because they live in different places:
//!
//! * [`Rest`]: never changes; flash; shared by copies of a body,
//! * [`State`]: x, v, their history, and the rotations: all that a snapshot must save,
//! * [`Workspace`]: scratch, shared by any number of bodies,
//! * [`Settings`]: what the user chooses,
//! * [`StepReport`]: what a step says of itself.
//!
//! Kernels take slices ([`StateMut`], [`WorkspaceMut`]); const generics stop here. Everything is made
//! by a `const fn new` of all-zero bits, to be placed in a `static` and filled in place.

use glam::Vec3;

use crate::element::{Factored, Layout, Sym3};
use crate::energy::{self, Energies, Momenta};
use crate::lane::Native;
use crate::material::Material;
use crate::mesh::{Mesh, MeshError};
use crate::operator::{Fit, RotationBlock, fit_rotations};
use crate::rest::{Rest, RestBuffer};
use crate::settings::Settings;
use crate::step::{Scene, StepReport, step};

/// A body's state, borrowed for reading.
#[derive(Clone, Copy, Debug)]
pub struct StateRef<'a> {
    /// Positions, metres.
    pub x: &'a [[f32; 3]],
    /// Velocities, m/s.
    pub v: &'a [[f32; 3]],
    /// Velocities of the last steps, latest first, one body's nodes after the other.
    pub history: &'a [[f32; 3]],
    /// Rotations of the tetrahedra.
    pub rotations: &'a [RotationBlock],
}

/// A body's state, borrowed for a step.
#[derive(Debug)]
pub struct StateMut<'a> {
    /// Positions, metres.
    pub x: &'a mut [[f32; 3]],
    /// Velocities, m/s.
    pub v: &'a mut [[f32; 3]],
    /// Velocities of the last steps, latest first, one body's nodes after the other.
    pub history: &'a mut [[f32; 3]],
    /// Rotations of the tetrahedra.
    pub rotations: &'a mut [RotationBlock],
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
    /// nothing, and forgets the history.
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
        self.x.copy_from_slice(x);
        self.v.copy_from_slice(v);
        self.history.fill([0.0; 3]);
        fit_rotations::<Native, L>(rest, self.x, Fit::Cold, self.rotations);
        Ok(())
    }
}

/// Scratch of a step, borrowed.
#[derive(Debug)]
pub struct WorkspaceMut<'a, L: Layout = Factored> {
    pub(crate) rotated: &'a mut [L::Rotated],
    pub(crate) filter: &'a mut [Sym3<f32>],
    pub(crate) blocks: &'a mut [Sym3<f32>],
    pub(crate) inertia: &'a mut [f32],
    pub(crate) v: &'a mut [[f32; 3]],
    pub(crate) r: &'a mut [[f32; 3]],
    pub(crate) p: &'a mut [[f32; 3]],
    pub(crate) q: &'a mut [[f32; 3]],
    pub(crate) vectors: &'a mut [[f32; 3]],
    pub(crate) products: &'a mut [[f32; 3]],
}

/// Bytes of state: `nodes` nodes, [`blocks`](crate::lane::blocks) blocks of tetrahedra, and so many past velocities
/// ([`Start::history`](crate::settings::Start::history)).
#[must_use]
pub const fn state_bytes(nodes: usize, blocks: usize, history: usize) -> usize {
    (2 + history) * nodes * size_of::<[f32; 3]>() + blocks * size_of::<RotationBlock>()
}

/// Bytes of workspace, with so many stored vectors of W ([`Start::vectors`](crate::settings::Start::vectors)).
#[must_use]
pub const fn workspace_bytes<L: Layout>(nodes: usize, blocks: usize, vectors: usize) -> usize {
    nodes
        * ((4 + 2 * vectors) * size_of::<[f32; 3]>()
            + 2 * size_of::<Sym3<f32>>()
            + size_of::<f32>())
        + blocks * size_of::<L::Rotated>()
}

/// Bytes of rest data.
#[must_use]
pub const fn rest_bytes<L: Layout>(nodes: usize, blocks: usize) -> usize {
    nodes * (size_of::<[f32; 3]>() + size_of::<f32>())
        + blocks * (size_of::<crate::rest::TetBlock>() + size_of::<L::Stiffness>())
        + size_of::<crate::rest::Header>()
}

/// State of a body of up to `NODES` nodes and `BLOCKS` blocks of eight tetrahedra, with `HISTORY`
/// past velocities.
///
/// `Clone` is left out so that no copy passes over the stack; [`State::copy_from`] is the snapshot.
#[derive(Debug)]
pub struct State<const NODES: usize, const BLOCKS: usize, const HISTORY: usize = 0> {
    nodes: usize,
    blocks: usize,
    x: [[f32; 3]; NODES],
    v: [[f32; 3]; NODES],
    history: [[[f32; 3]; NODES]; HISTORY],
    rotations: [RotationBlock; BLOCKS],
}

impl<const NODES: usize, const BLOCKS: usize, const HISTORY: usize> State<NODES, BLOCKS, HISTORY> {
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
                capacity: BLOCKS * crate::lane::BLOCK,
            });
        }
        (self.nodes, self.blocks) = (nodes, blocks);
        let state = self.view_mut();
        state.x.copy_from_slice(rest.nodes);
        state.v.fill([0.0; 3]);
        state.history.fill([0.0; 3]);
        fit_rotations::<Native, L>(rest, state.x, Fit::Cold, state.rotations);
        Ok(())
    }

    /// Takes over another state, bit for bit: a snapshot, or its restoring.
    pub fn copy_from(&mut self, other: &Self) {
        (self.nodes, self.blocks) = (other.nodes, other.blocks);
        self.x.copy_from_slice(&other.x);
        self.v.copy_from_slice(&other.v);
        self.history.copy_from_slice(&other.history);
        self.rotations.copy_from_slice(&other.rotations);
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
        }
    }
}

impl<const NODES: usize, const BLOCKS: usize, const HISTORY: usize> Default
    for State<NODES, BLOCKS, HISTORY>
{
    fn default() -> Self {
        Self::new()
    }
}

/// Scratch for bodies of up to `NODES` nodes and `BLOCKS` blocks, and `VECTORS` stored vectors of W.
#[derive(Debug)]
pub struct Workspace<
    const NODES: usize,
    const BLOCKS: usize,
    const VECTORS: usize = 1,
    L: Layout = Factored,
> {
    rotated: [L::Rotated; BLOCKS],
    filter: [Sym3<f32>; NODES],
    blocks: [Sym3<f32>; NODES],
    inertia: [f32; NODES],
    vectors: [[[f32; 3]; NODES]; 4],
    space: [[[f32; 3]; NODES]; VECTORS],
    products: [[[f32; 3]; NODES]; VECTORS],
}

impl<const NODES: usize, const BLOCKS: usize, const VECTORS: usize, L: Layout>
    Workspace<NODES, BLOCKS, VECTORS, L>
{
    /// All bits zero.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            rotated: [const { L::ZERO_ROTATED }; BLOCKS],
            filter: [[0.0; 6]; NODES],
            blocks: [[0.0; 6]; NODES],
            inertia: [0.0; NODES],
            vectors: [[[0.0; 3]; NODES]; 4],
            space: [[[0.0; 3]; NODES]; VECTORS],
            products: [[[0.0; 3]; NODES]; VECTORS],
        }
    }

    /// Borrows what a body of this size needs; where it has too little room, empty slices, which a
    /// step refuses.
    #[must_use]
    pub fn view_mut(&mut self, rest: &Rest<'_, L>) -> WorkspaceMut<'_, L> {
        let (nodes, blocks) = (rest.nodes.len(), rest.blocks.len());
        let [v, r, p, q] = &mut self.vectors;
        WorkspaceMut {
            rotated: self.rotated.get_mut(..blocks).unwrap_or_default(),
            filter: self.filter.get_mut(..nodes).unwrap_or_default(),
            blocks: self.blocks.get_mut(..nodes).unwrap_or_default(),
            inertia: self.inertia.get_mut(..nodes).unwrap_or_default(),
            v: v.get_mut(..nodes).unwrap_or_default(),
            r: r.get_mut(..nodes).unwrap_or_default(),
            p: p.get_mut(..nodes).unwrap_or_default(),
            q: q.get_mut(..nodes).unwrap_or_default(),
            vectors: self
                .space
                .as_flattened_mut()
                .get_mut(..VECTORS * nodes)
                .unwrap_or_default(),
            products: self
                .products
                .as_flattened_mut()
                .get_mut(..VECTORS * nodes)
                .unwrap_or_default(),
        }
    }
}

impl<const NODES: usize, const BLOCKS: usize, const VECTORS: usize, L: Layout> Default
    for Workspace<NODES, BLOCKS, VECTORS, L>
{
    fn default() -> Self {
        Self::new()
    }
}

/// What every body can do, over `parts` and `rest_and_state`.
macro_rules! body_methods {
    () => {
        /// Advances the body by one step; see [`step`].
        pub fn step(&mut self, scene: &Scene<'_>, settings: &Settings) -> StepReport {
            let (rest, mut state, mut workspace) = self.parts();
            step::<Native, L>(&rest, &mut state, &mut workspace, scene, settings)
        }

        /// Places the body; see [`StateMut::place`].
        ///
        /// # Errors
        /// [`StateError`]; the body is then as it was.
        pub fn place(&mut self, x: &[[f32; 3]], v: &[[f32; 3]]) -> Result<(), StateError> {
            let (rest, mut state, _) = self.parts();
            state.place(&rest, x, v)
        }

        /// The rest data, borrowed.
        #[must_use]
        pub fn rest(&self) -> Rest<'_, L> {
            self.rest_and_state().0
        }

        /// Positions, metres.
        #[must_use]
        pub fn positions(&self) -> &[[f32; 3]] {
            self.rest_and_state().1.x
        }

        /// Velocities, m/s.
        #[must_use]
        pub fn velocities(&self) -> &[[f32; 3]] {
            self.rest_and_state().1.v
        }

        /// Kinetic, elastic and gravitational energy; see [`energy::energies`].
        #[must_use]
        pub fn energies(&self, gravity: Vec3) -> Energies {
            let (rest, state) = self.rest_and_state();
            energy::energies(&rest, &state, gravity)
        }

        /// Linear and angular momentum; see [`energy::momenta`].
        #[must_use]
        pub fn momenta(&self) -> Momenta {
            let (rest, state) = self.rest_and_state();
            energy::momenta(&rest, &state)
        }

        /// The smallest det F; see [`energy::min_det`].
        #[must_use]
        pub fn min_det(&self) -> f64 {
            let (rest, state) = self.rest_and_state();
            energy::min_det(&rest, &state)
        }
    };
}
#[cfg(feature = "alloc")]
pub(crate) use body_methods;

/// One body with its own rest data, state and workspace: the simple case.
///
/// Firmware that keeps rest data in flash, or has several bodies, uses the parts by themselves.
#[derive(Debug)]
pub struct Body<
    const NODES: usize,
    const BLOCKS: usize,
    const HISTORY: usize = 0,
    const VECTORS: usize = 1,
    L: Layout = Factored,
> {
    rest: RestBuffer<NODES, BLOCKS, L>,
    state: State<NODES, BLOCKS, HISTORY>,
    workspace: Workspace<NODES, BLOCKS, VECTORS, L>,
}

impl<const NODES: usize, const BLOCKS: usize, const HISTORY: usize, const VECTORS: usize, L: Layout>
    Body<NODES, BLOCKS, HISTORY, VECTORS, L>
{
    /// Bytes of the rest data, capacity included.
    pub const REST_BYTES: usize = size_of::<RestBuffer<NODES, BLOCKS, L>>();
    /// Bytes of the state.
    pub const STATE_BYTES: usize = size_of::<State<NODES, BLOCKS, HISTORY>>();
    /// Bytes of the workspace.
    pub const WORKSPACE_BYTES: usize = size_of::<Workspace<NODES, BLOCKS, VECTORS, L>>();

    /// No mesh yet. All bits zero, so that a `static` costs no flash.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            rest: RestBuffer::new(),
            state: State::new(),
            workspace: Workspace::new(),
        }
    }

    /// Takes a mesh and its material, and puts the body at rest in the rest shape.
    ///
    /// # Errors
    /// [`MeshError`] where it does not fit; the body is then as it was.
    pub fn fill(&mut self, mesh: &Mesh<'_>, material: &Material) -> Result<(), MeshError> {
        self.rest.fill(mesh, material)?;
        self.state.reset(&self.rest.view())
    }

    /// The state, for snapshots: see [`State::copy_from`].
    #[must_use]
    pub fn state(&self) -> &State<NODES, BLOCKS, HISTORY> {
        &self.state
    }

    /// The state, for restoring a snapshot.
    #[must_use]
    pub fn state_mut(&mut self) -> &mut State<NODES, BLOCKS, HISTORY> {
        &mut self.state
    }

    fn parts(&mut self) -> (Rest<'_, L>, StateMut<'_>, WorkspaceMut<'_, L>) {
        let rest = self.rest.view();
        (rest, self.state.view_mut(), self.workspace.view_mut(&rest))
    }

    fn rest_and_state(&self) -> (Rest<'_, L>, StateRef<'_>) {
        (self.rest.view(), self.state.view())
    }

    body_methods!();
}

impl<const NODES: usize, const BLOCKS: usize, const HISTORY: usize, const VECTORS: usize, L: Layout>
    Default for Body<NODES, BLOCKS, HISTORY, VECTORS, L>
{
    fn default() -> Self {
        Self::new()
    }
}
