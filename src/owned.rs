//! Bodies whose size is known at run time, over `Vec`s (feature `alloc`): the same kernels.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3;

use crate::body::{StateError, StateMut, StateRef, WorkspaceMut, body_methods};
use crate::constraint::Reactions;
use crate::element::{Dense, DenseBlocks, Elasticity, Factored, Layout, Sym3, elastic_blocks};
use crate::energy::{self, Energies, Momenta};
#[cfg(feature = "fracture")]
use crate::fracture::BrokenBlock;
use crate::lane::{BLOCK, Native, blocks};
use crate::material::Materials;
use crate::mesh::{Mesh, MeshError, shape};
use crate::operator::{RotationBlock, fit_cold};
#[cfg(feature = "plasticity")]
use crate::plasticity::PlasticBlock;
use crate::rest::{self, Header, Rest, RestMut, TetBlock, to_f32};
use crate::settings::{Needs, Settings};
use crate::step::{Scene, StepReport, Units, step};
use crate::workspace::workspace_methods;

/// Rest data in `Vec`s.
#[derive(Clone, Debug)]
pub struct OwnedRest<L: Layout = Factored> {
    nodes: Vec<[f32; 3]>,
    masses: Vec<f32>,
    blocks: Vec<TetBlock>,
    stiffness: Vec<L::Stiffness>,
    header: Header,
}

impl<L: Layout> OwnedRest<L> {
    /// Rest data of a mesh, of one material or of several.
    ///
    /// # Errors
    /// As [`RestMut::fill`].
    pub fn new(mesh: &Mesh<'_>, materials: &(impl Materials + ?Sized)) -> Result<Self, MeshError> {
        let first = rest::check_materials(mesh, materials)?;
        let (nodes, blocks) = (mesh.nodes().len(), blocks(mesh.tets().len()));
        let mut out = Self {
            nodes: vec![[0.0; 3]; nodes],
            masses: vec![0.0; nodes],
            blocks: vec![TetBlock::ZERO; blocks],
            stiffness: vec![L::ZERO_STIFFNESS; blocks],
            header: Header::EMPTY,
        };
        rest::fill(
            mesh,
            first,
            materials,
            &mut RestMut::<L> {
                nodes: &mut out.nodes,
                masses: &mut out.masses,
                blocks: &mut out.blocks,
                stiffness: &mut out.stiffness,
                header: &mut out.header,
            },
        );
        Ok(out)
    }

    /// The data, borrowed.
    #[must_use]
    pub fn view(&self) -> Rest<'_, L> {
        Rest {
            nodes: &self.nodes,
            masses: &self.masses,
            blocks: &self.blocks,
            stiffness: &self.stiffness,
            fans: &[],
            header: self.header,
        }
    }
}

impl OwnedRest<Dense> {
    /// Rest data of a mesh with any linear elastic material, given per tetrahedron. `materials` give
    /// density and damping.
    ///
    /// # Errors
    /// As [`RestMut::fill`].
    pub fn anisotropic(
        mesh: &Mesh<'_>,
        materials: &(impl Materials + ?Sized),
        mut elasticity: impl FnMut(usize) -> Elasticity,
    ) -> Result<Self, MeshError> {
        let mut out = Self::new(mesh, materials)?;
        for (tet, corners) in mesh.tets().iter().enumerate() {
            let Some(shape) = shape(mesh.nodes(), corners) else {
                continue;
            };
            let pairs = elastic_blocks(shape.volume, &shape.gradients, &elasticity(tet));
            let Some(DenseBlocks(stored)) = out.stiffness.get_mut(tet / BLOCK) else {
                continue;
            };
            for (stored, pair) in stored.iter_mut().zip(pairs) {
                for (stored, k) in stored.iter_mut().flatten().zip(pair.into_iter().flatten()) {
                    let k = to_f32(k);
                    if !k.is_finite() {
                        return Err(MeshError::OutOfScale {
                            tet: u32::try_from(tet).unwrap_or(u32::MAX),
                        });
                    }
                    stored[tet % BLOCK] = k;
                }
            }
        }
        Ok(out)
    }
}

/// State in `Vec`s. `Clone` is the snapshot.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnedState {
    x: Vec<[f32; 3]>,
    v: Vec<[f32; 3]>,
    history: Vec<[f32; 3]>,
    rotations: Vec<RotationBlock>,
    #[cfg(feature = "plasticity")]
    plastic: Vec<PlasticBlock>,
    #[cfg(feature = "fracture")]
    broken: Vec<BrokenBlock>,
}

impl OwnedState {
    /// At rest in the rest shape, with the history that a start, or settings, need.
    #[must_use]
    pub fn new<L: Layout>(rest: &Rest<'_, L>, needs: impl Into<Needs>) -> Self {
        let (nodes, needs) = (rest.nodes.len(), needs.into());
        let mut rotations = vec![RotationBlock::ZERO; rest.blocks.len()];
        fit_cold::<Native, L>(rest, rest.nodes, &mut rotations);
        Self {
            x: rest.nodes.to_vec(),
            v: vec![[0.0; 3]; nodes],
            history: vec![[0.0; 3]; needs.history * nodes],
            #[cfg(feature = "plasticity")]
            plastic: vec![PlasticBlock::ZERO; if needs.plastic { rotations.len() } else { 0 }],
            #[cfg(feature = "fracture")]
            broken: vec![BrokenBlock::ZERO; if needs.broken { rotations.len() } else { 0 }],
            rotations,
        }
    }

    /// Borrows it for reading.
    #[must_use]
    pub fn view(&self) -> StateRef<'_> {
        StateRef {
            x: &self.x,
            v: &self.v,
            history: &self.history,
            rotations: &self.rotations,
            #[cfg(feature = "plasticity")]
            plastic: &self.plastic,
            #[cfg(feature = "fracture")]
            broken: &self.broken,
        }
    }

    /// Borrows it for a step.
    #[must_use]
    pub fn view_mut(&mut self) -> StateMut<'_> {
        StateMut {
            x: &mut self.x,
            v: &mut self.v,
            history: &mut self.history,
            rotations: &mut self.rotations,
            #[cfg(feature = "plasticity")]
            plastic: &mut self.plastic,
            #[cfg(feature = "fracture")]
            broken: &mut self.broken,
        }
    }
}

/// Workspace in `Vec`s.
#[derive(Debug)]
pub struct OwnedWorkspace<L: Layout = Factored> {
    rotated: Vec<L::Rotated>,
    filter: Vec<Sym3<f32>>,
    normals: Vec<[f32; 3]>,
    blocks: Vec<Sym3<f32>>,
    inertia: Vec<f32>,
    fans: Vec<u32>,
    vectors: [Vec<[f32; 3]>; 4],
    space: Vec<[f32; 3]>,
    products: Vec<[f32; 3]>,
    coarse: Vec<f32>,
    nodes: usize,
}

impl<L: Layout> OwnedWorkspace<L> {
    /// Room for bodies up to the size of this one, and for what a start, or settings, need.
    #[must_use]
    pub fn new(rest: &Rest<'_, L>, needs: impl Into<Needs>) -> Self {
        let (nodes, needs) = (rest.nodes.len(), needs.into());
        let space = vec![[0.0; 3]; needs.vectors * nodes];
        Self {
            rotated: vec![L::ZERO_ROTATED; rest.blocks.len()],
            filter: vec![[0.0; 6]; nodes],
            normals: vec![[0.0; 3]; nodes],
            blocks: vec![[0.0; 6]; nodes],
            inertia: vec![0.0; nodes],
            fans: vec![0; rest.blocks.len()],
            vectors: core::array::from_fn(|_| vec![[0.0; 3]; nodes]),
            products: space.clone(),
            space,
            coarse: vec![0.0; needs.coarse],
            nodes,
        }
    }

    /// Borrows what a body of this size needs; where it has too little room, empty slices, which a
    /// step refuses.
    #[must_use]
    pub fn view_mut(&mut self, rest: &Rest<'_, L>) -> WorkspaceMut<'_, L> {
        let (nodes, blocks) = (rest.nodes.len(), rest.blocks.len());
        let stored = self.space.len().checked_div(self.nodes).unwrap_or(0) * nodes;
        let [v, r, p, q] = &mut self.vectors;
        WorkspaceMut {
            rotated: &mut self.rotated,
            filter: &mut self.filter,
            normals: &mut self.normals,
            blocks: &mut self.blocks,
            inertia: &mut self.inertia,
            fans: &mut self.fans,
            v,
            r,
            p,
            q,
            vectors: &mut self.space,
            products: &mut self.products,
            coarse: &mut self.coarse,
        }
        .cut(nodes, blocks, stored)
    }

    workspace_methods!();

    fn filter_and_residual(&self) -> (&[Sym3<f32>], &[[f32; 3]]) {
        let [_, r, _, _] = &self.vectors;
        (&self.filter, r)
    }
}

/// One body with its own rest data, state and workspace.
#[derive(Debug)]
pub struct OwnedBody<L: Layout = Factored> {
    rest: OwnedRest<L>,
    state: OwnedState,
    workspace: OwnedWorkspace<L>,
}

impl<L: Layout> OwnedBody<L> {
    /// A body at rest in the rest shape, with room for what a start, or settings, need.
    ///
    /// # Errors
    /// As [`RestMut::fill`].
    pub fn new(
        mesh: &Mesh<'_>,
        materials: &(impl Materials + ?Sized),
        needs: impl Into<Needs>,
    ) -> Result<Self, MeshError> {
        Ok(Self::from_rest(OwnedRest::new(mesh, materials)?, needs))
    }

    /// A body at rest, from rest data.
    #[must_use]
    pub fn from_rest(rest: OwnedRest<L>, needs: impl Into<Needs>) -> Self {
        let (view, needs) = (rest.view(), needs.into());
        let (state, workspace) = (
            OwnedState::new(&view, needs),
            OwnedWorkspace::new(&view, needs),
        );
        Self {
            rest,
            state,
            workspace,
        }
    }

    /// The state; `clone` it for a snapshot.
    #[must_use]
    pub fn state(&self) -> &OwnedState {
        &self.state
    }

    /// The state, for restoring a snapshot.
    #[must_use]
    pub fn state_mut(&mut self) -> &mut OwnedState {
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
