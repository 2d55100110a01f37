//! Scratch of a step. It carries nothing from one step to the next, so any number of bodies share it; until the next, it says
//! what pins and colliders did.

use crate::constraint::Reactions;
use crate::element::{Factored, Layout, Sym3};
use crate::rest::Rest;
use crate::settings::Settings;
use crate::step::Units;

/// What every workspace says of the last step, over `filter_and_residual`.
macro_rules! workspace_methods {
    () => {
        /// Impulses with which pins and colliders acted on each node in the last step, N·s, if it advanced; `settings` are those
        /// of that step. Divided by its duration they are the mean forces, N. Zero where nothing holds a node.
        ///
        /// Colliders never pull: along their normal, where only one holds a node, it is not negative to rounding (where several
        /// do, along the sum of their normals). What sticks has its friction here; the friction of what slides, and what put
        /// nodes back on a surface after the solve, is not in it. Bodies' own: [`Coupling::impulse`](crate::Coupling::impulse).
        pub fn reactions(&self, rest: &Rest<'_, L>, settings: &Settings) -> Reactions<'_> {
            let (filter, r) = self.filter_and_residual();
            let filter = filter.get(..rest.nodes.len()).unwrap_or_default();
            Reactions::new(filter, r, Units::new(rest, settings).impulse)
        }
    };
}
#[cfg(feature = "alloc")]
pub(crate) use workspace_methods;

/// Scratch of a step, borrowed.
#[derive(Debug)]
pub struct WorkspaceMut<'a, L: Layout = Factored> {
    pub(crate) rotated: &'a mut [L::Rotated],
    pub(crate) filter: &'a mut [Sym3<f32>],
    pub(crate) normals: &'a mut [[f32; 3]],
    pub(crate) blocks: &'a mut [Sym3<f32>],
    pub(crate) inertia: &'a mut [f32],
    pub(crate) fans: &'a mut [u32],
    pub(crate) v: &'a mut [[f32; 3]],
    pub(crate) r: &'a mut [[f32; 3]],
    pub(crate) p: &'a mut [[f32; 3]],
    pub(crate) q: &'a mut [[f32; 3]],
    pub(crate) vectors: &'a mut [[f32; 3]],
    pub(crate) products: &'a mut [[f32; 3]],
    pub(crate) coarse: &'a mut [f32],
}

impl<'a, L: Layout> WorkspaceMut<'a, L> {
    /// Cuts a workspace from memory of the caller's: one rotated stiffness a block, and [`workspace_numbers`]
    /// numbers; what is left serves a two-level preconditioner. Where that is too little, empty slices, which
    /// a step refuses.
    #[must_use]
    pub fn over(
        rest: &Rest<'_, L>,
        vectors: usize,
        rotated: &'a mut [L::Rotated],
        numbers: &'a mut [f32],
    ) -> Self {
        let nodes = rest.nodes.len();
        let (mut left, length) = (numbers, vectors.saturating_mul(nodes));
        let (filter, blocks) = (take(&mut left, nodes), take(&mut left, nodes));
        let inertia = take::<1>(&mut left, nodes).as_flattened_mut();
        let fans = take::<1>(&mut left, rest.blocks.len()).as_flattened_mut();
        let [normals, v, r, p, q] = core::array::from_fn(|_| take(&mut left, nodes));
        let [vectors, products] = core::array::from_fn(|_| take(&mut left, length));
        Self {
            rotated,
            filter,
            normals,
            blocks,
            inertia,
            fans: bytemuck::try_cast_slice_mut(fans).unwrap_or_default(),
            v,
            r,
            p,
            q,
            vectors,
            products,
            coarse: left,
        }
        .cut(nodes, rest.blocks.len(), length)
    }
}

/// The first `count` groups of `N` numbers; none where there are not as many.
fn take<'a, const N: usize>(numbers: &mut &'a mut [f32], count: usize) -> &'a mut [[f32; N]] {
    let Some((taken, left)) =
        core::mem::take(numbers).split_at_mut_checked(N.saturating_mul(count))
    else {
        return &mut [];
    };
    *numbers = left;
    taken.as_chunks_mut().0
}

impl<L: Layout> WorkspaceMut<'_, L> {
    workspace_methods!();

    fn filter_and_residual(&self) -> (&[Sym3<f32>], &[[f32; 3]]) {
        (self.filter, self.r)
    }

    /// The parts that a body needs of larger ones; empty where there is too little.
    pub(crate) fn cut(self, nodes: usize, blocks: usize, stored: usize) -> Self {
        Self {
            rotated: self.rotated.get_mut(..blocks).unwrap_or_default(),
            filter: self.filter.get_mut(..nodes).unwrap_or_default(),
            normals: self.normals.get_mut(..nodes).unwrap_or_default(),
            blocks: self.blocks.get_mut(..nodes).unwrap_or_default(),
            inertia: self.inertia.get_mut(..nodes).unwrap_or_default(),
            fans: self.fans.get_mut(..blocks).unwrap_or_default(),
            v: self.v.get_mut(..nodes).unwrap_or_default(),
            r: self.r.get_mut(..nodes).unwrap_or_default(),
            p: self.p.get_mut(..nodes).unwrap_or_default(),
            q: self.q.get_mut(..nodes).unwrap_or_default(),
            vectors: self.vectors.get_mut(..stored).unwrap_or_default(),
            products: self.products.get_mut(..stored).unwrap_or_default(),
            coarse: self.coarse,
        }
    }
}

/// Numbers of a workspace besides the rotated stiffness, with so many stored vectors of W.
#[must_use]
pub const fn workspace_numbers(nodes: usize, blocks: usize, vectors: usize) -> usize {
    nodes * (3 * (5 + 2 * vectors) + 2 * 6 + 1) + blocks
}

/// Bytes of workspace, with so many stored vectors of W ([`Start::vectors`](crate::settings::Start::vectors));
/// a two-level preconditioner takes [`coarse_length`](crate::preconditioner::coarse::coarse_length) f32 more.
#[must_use]
pub const fn workspace_bytes<L: Layout>(nodes: usize, blocks: usize, vectors: usize) -> usize {
    workspace_numbers(nodes, blocks, vectors) * size_of::<f32>() + blocks * size_of::<L::Rotated>()
}

/// Scratch for bodies of up to `NODES` nodes and `BLOCKS` blocks, `VECTORS` stored vectors of W, and `COARSE`
/// numbers of a two-level preconditioner ([`coarse_length`](crate::preconditioner::coarse::coarse_length)).
#[derive(Debug)]
pub struct Workspace<
    const NODES: usize,
    const BLOCKS: usize,
    const VECTORS: usize = 1,
    L: Layout = Factored,
    const COARSE: usize = 0,
> {
    rotated: [L::Rotated; BLOCKS],
    filter: [Sym3<f32>; NODES],
    blocks: [Sym3<f32>; NODES],
    inertia: [f32; NODES],
    fans: [u32; BLOCKS],
    vectors: [[[f32; 3]; NODES]; 5],
    space: [[[f32; 3]; NODES]; VECTORS],
    products: [[[f32; 3]; NODES]; VECTORS],
    coarse: [f32; COARSE],
}

impl<const NODES: usize, const BLOCKS: usize, const VECTORS: usize, L: Layout, const COARSE: usize>
    Workspace<NODES, BLOCKS, VECTORS, L, COARSE>
{
    /// All bits zero.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            rotated: [const { L::ZERO_ROTATED }; BLOCKS],
            filter: [[0.0; 6]; NODES],
            blocks: [[0.0; 6]; NODES],
            inertia: [0.0; NODES],
            fans: [0; BLOCKS],
            vectors: [[[0.0; 3]; NODES]; 5],
            space: [[[0.0; 3]; NODES]; VECTORS],
            products: [[[0.0; 3]; NODES]; VECTORS],
            coarse: [0.0; COARSE],
        }
    }

    /// Borrows what a body of this size needs; where it has too little room, empty slices, which a
    /// step refuses.
    #[must_use]
    pub fn view_mut(&mut self, rest: &Rest<'_, L>) -> WorkspaceMut<'_, L> {
        let (nodes, blocks) = (rest.nodes.len(), rest.blocks.len());
        let [normals, v, r, p, q] = &mut self.vectors;
        WorkspaceMut {
            rotated: &mut self.rotated,
            filter: &mut self.filter,
            normals,
            blocks: &mut self.blocks,
            inertia: &mut self.inertia,
            fans: &mut self.fans,
            v,
            r,
            p,
            q,
            vectors: self.space.as_flattened_mut(),
            products: self.products.as_flattened_mut(),
            coarse: &mut self.coarse,
        }
        .cut(nodes, blocks, VECTORS * nodes)
    }

    workspace_methods!();

    fn filter_and_residual(&self) -> (&[Sym3<f32>], &[[f32; 3]]) {
        let [_, _, r, _, _] = &self.vectors;
        (&self.filter, r)
    }
}

impl<const NODES: usize, const BLOCKS: usize, const VECTORS: usize, L: Layout, const COARSE: usize>
    Default for Workspace<NODES, BLOCKS, VECTORS, L, COARSE>
{
    fn default() -> Self {
        Self::new()
    }
}
