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

use crate::constraint::Reactions;
use crate::element::{Factored, Layout};
use crate::energy::{self, Energies, Momenta};
use crate::lane::Native;
use crate::material::Materials;
use crate::mesh::{Mesh, MeshError};
pub use crate::rest::rest_bytes;
use crate::rest::{Rest, RestBuffer};
use crate::settings::Settings;
pub use crate::state::{State, StateError, StateMut, StateRef, state_bytes};
use crate::step::{Scene, StepReport, step};
pub use crate::workspace::{Workspace, WorkspaceMut, workspace_bytes, workspace_numbers};

/// What every body can do, over `parts` and `rest_and_state`.
macro_rules! body_methods {
    () => {
        /// Advances the body by one step; see [`step`].
        pub fn step(&mut self, scene: &Scene<'_>, settings: &Settings) -> StepReport {
            let (rest, mut state, mut workspace) = self.parts();
            step::<Native, L>(&rest, &mut state, &mut workspace, scene, settings)
        }

        /// Advances it with couplings between its pieces; see [`step_coupled`](crate::step::step_coupled).
        #[cfg(feature = "contact")]
        pub fn step_coupled(
            &mut self,
            scene: &Scene<'_>,
            settings: &Settings,
            couplings: &mut crate::coupling::Couplings<'_>,
        ) -> StepReport {
            let (rest, mut state, mut work) = self.parts();
            crate::step::step_coupled::<Native, L>(
                &rest, &mut state, &mut work, scene, settings, couplings,
            )
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

        /// What pins and colliders did to each node in the last step, N·s; see [`Workspace::reactions`](crate::body::Workspace::reactions).
        pub fn reactions(&self, settings: &Settings) -> Reactions<'_> {
            self.workspace.reactions(&self.rest(), settings)
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
    const COARSE: usize = 0,
    const DAMAGE: usize = 0,
> {
    rest: RestBuffer<NODES, BLOCKS, L>,
    state: State<NODES, BLOCKS, HISTORY, DAMAGE>,
    workspace: Workspace<NODES, BLOCKS, VECTORS, L, COARSE>,
}

impl<
    const NODES: usize,
    const BLOCKS: usize,
    const HISTORY: usize,
    const VECTORS: usize,
    L: Layout,
    const COARSE: usize,
    const DAMAGE: usize,
> Body<NODES, BLOCKS, HISTORY, VECTORS, L, COARSE, DAMAGE>
{
    /// Bytes of the rest data, capacity included.
    pub const REST_BYTES: usize = size_of::<RestBuffer<NODES, BLOCKS, L>>();
    /// Bytes of the state.
    pub const STATE_BYTES: usize = size_of::<State<NODES, BLOCKS, HISTORY, DAMAGE>>();
    /// Bytes of the workspace.
    pub const WORKSPACE_BYTES: usize = size_of::<Workspace<NODES, BLOCKS, VECTORS, L, COARSE>>();

    /// No mesh yet. All bits zero, so that a `static` costs no flash.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            rest: RestBuffer::new(),
            state: State::new(),
            workspace: Workspace::new(),
        }
    }

    /// Takes a mesh and its material, or [`Materials`], and puts the body at rest in the rest shape.
    ///
    /// # Errors
    /// [`MeshError`] where it does not fit; the body is then as it was.
    pub fn fill(
        &mut self,
        mesh: &Mesh<'_>,
        materials: &(impl Materials + ?Sized),
    ) -> Result<(), MeshError> {
        self.rest.fill(mesh, materials)?;
        self.state.reset(&self.rest.view())
    }

    /// The state, for snapshots: see [`State::copy_from`].
    #[must_use]
    pub fn state(&self) -> &State<NODES, BLOCKS, HISTORY, DAMAGE> {
        &self.state
    }

    /// The state, for restoring a snapshot.
    #[must_use]
    pub fn state_mut(&mut self) -> &mut State<NODES, BLOCKS, HISTORY, DAMAGE> {
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

impl<
    const NODES: usize,
    const BLOCKS: usize,
    const HISTORY: usize,
    const VECTORS: usize,
    L: Layout,
    const COARSE: usize,
    const DAMAGE: usize,
> Default for Body<NODES, BLOCKS, HISTORY, VECTORS, L, COARSE, DAMAGE>
{
    fn default() -> Self {
        Self::new()
    }
}
