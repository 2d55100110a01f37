//! Rest data: what a body is before it moves. It never changes, may live in flash, and may be
//! shared by any number of bodies.

use bytemuck::{Pod, Zeroable};

use crate::element::{Factored, Layout};
use crate::energy::{FNV_START, fnv1a_of, fnv1a_word};
use crate::lane::{BLOCK, blocks};
use crate::material::{Material, Materials};
use crate::math::power_of_two_below;
use crate::mesh::{Mesh, MeshError, Shape, shape};
use crate::vector::copy;

/// Eight tetrahedra at rest, component by component. The last block of a mesh is padded with
/// tetrahedra that have no stiffness and sit at node 0.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(32))]
pub struct TetBlock {
    /// Corner node numbers, `[corner][lane]`.
    pub corners: [[u32; BLOCK]; 4],
    /// Shape gradients g₁, g₂, g₃ in 1/m, `[corner − 1][axis][lane]`; g₀ = −g₁ − g₂ − g₃.
    pub gradients: [[[f32; BLOCK]; 3]; 3],
    /// λV, in N·m.
    pub lambda_v: [f32; BLOCK],
    /// μV, in N·m.
    pub mu_v: [f32; BLOCK],
}

impl TetBlock {
    /// Eight padding tetrahedra.
    pub const ZERO: Self = Self {
        corners: [[0; BLOCK]; 4],
        gradients: [[[0.0; BLOCK]; 3]; 3],
        lambda_v: [0.0; BLOCK],
        mu_v: [0.0; BLOCK],
    };
}

/// The few numbers of a body that are not per node or per tetrahedron.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Header {
    /// Of nodes and tetrahedra, whatever the material: tells which mesh a factor belongs to.
    pub fingerprint: u64,
    /// Tetrahedra, without padding.
    pub tets: u32,
    /// Mass-proportional damping α, 1/s.
    pub alpha: f32,
    /// Stiffness-proportional damping β, s.
    pub beta: f32,
    /// A power of two near the size of an element, metres.
    pub length_unit: f32,
    /// A power of two near the mass of a node, kilograms.
    pub mass_unit: f32,
    /// Sum of the node masses, kilograms.
    pub total_mass: f32,
}

impl Header {
    /// Of no mesh. All bits zero.
    pub const EMPTY: Self = Self {
        fingerprint: 0,
        tets: 0,
        alpha: 0.0,
        beta: 0.0,
        length_unit: 0.0,
        mass_unit: 0.0,
        total_mass: 0.0,
    };
}

/// Rest data, borrowed: from flash, from a [`RestBuffer`], or from `Vec`s.
#[derive(Debug)]
pub struct Rest<'a, L: Layout = Factored> {
    /// Rest positions X, metres.
    pub nodes: &'a [[f32; 3]],
    /// Lumped node masses, kilograms.
    pub masses: &'a [f32],
    /// Tetrahedra, eight at a time.
    pub blocks: &'a [TetBlock],
    /// What the layout stores beside them (nothing, when factored).
    pub stiffness: &'a [L::Stiffness],
    /// At the first block of every eight fans, how many blocks they have; or empty. A step finds it once, for all
    /// its passes.
    pub fans: &'a [u32],
    /// Counts, damping and units.
    pub header: Header,
}

/// What passes over nodes read: of one type, whatever the layout, so that a binary has them once.
#[derive(Clone, Copy)]
pub(crate) struct Points<'a> {
    pub masses: &'a [f32],
    pub header: &'a Header,
}

impl<L: Layout> Rest<'_, L> {
    pub(crate) fn points(&self) -> Points<'_> {
        Points {
            masses: self.masses,
            header: &self.header,
        }
    }
}

impl<L: Layout> Clone for Rest<'_, L> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<L: Layout> Copy for Rest<'_, L> {}

impl<L: Layout> Rest<'_, L> {
    /// The four node numbers of every tetrahedron, without padding.
    pub fn tets(&self) -> impl Iterator<Item = [u32; 4]> {
        (0..self.header.tets as usize).map_while(|tet| {
            let block = self.blocks.get(tet / BLOCK)?;
            Some(block.corners.map(|corner| corner[tet % BLOCK]))
        })
    }
}

/// Where rest data is written: memory of the caller's, for meshes whose size is known at run time only.
#[derive(Debug)]
pub struct RestMut<'a, L: Layout = Factored> {
    /// One a node.
    pub nodes: &'a mut [[f32; 3]],
    /// One a node.
    pub masses: &'a mut [f32],
    /// As many as [`blocks`] says.
    pub blocks: &'a mut [TetBlock],
    /// As many.
    pub stiffness: &'a mut [L::Stiffness],
    /// The rest.
    pub header: &'a mut Header,
}

impl<L: Layout> RestMut<'_, L> {
    /// Computes the rest data of a mesh, of one [`Material`] or of several.
    ///
    /// # Errors
    /// [`MeshError::TooManyNodes`] or [`MeshError::TooManyTets`] where a slice is not of the mesh's length;
    /// what is wrong with the materials: [`MeshError::Materials`], [`MeshError::NoMaterial`],
    /// [`MeshError::Damping`]; [`MeshError::OutOfScale`]. Nothing is written then.
    pub fn fill(
        &mut self,
        mesh: &Mesh<'_>,
        materials: &(impl Materials + ?Sized),
    ) -> Result<(), MeshError> {
        let (nodes, tets) = (mesh.nodes().len(), mesh.tets().len());
        if self.nodes.len() != nodes || self.masses.len() != nodes {
            return Err(MeshError::TooManyNodes {
                needed: nodes,
                capacity: self.nodes.len().min(self.masses.len()),
            });
        }
        if self.blocks.len() != blocks(tets) || self.stiffness.len() != blocks(tets) {
            return Err(MeshError::TooManyTets {
                needed: tets,
                capacity: self.blocks.len().min(self.stiffness.len()) * BLOCK,
            });
        }
        let first = check_materials(mesh, materials)?;
        fill(mesh, first, materials, self);
        Ok(())
    }
}

/// Checks that every tetrahedron has a material, all with one damping, and that what a step computes of it at
/// rest is in the range of f32: its mass, λV, μV, |g|², its stiffness; and the sum of the masses. Returns
/// the first material.
pub(crate) fn check_materials<'m>(
    mesh: &Mesh<'_>,
    materials: &'m (impl Materials + ?Sized),
) -> Result<&'m Material, MeshError> {
    let tets = mesh.tets().len();
    if let Some(given) = materials.tets()
        && given != tets
    {
        return Err(MeshError::Materials { given, tets });
    }
    let none = |tet| MeshError::NoMaterial { tet };
    let first = materials.of(0).ok_or(none(0))?;
    let finite = |x: f64| to_f32(x).is_finite();
    let normal = |x: f64| to_f32(x).is_normal();
    let mut total = 0.0;
    for ((tet, corners), index) in (0_u32..).zip(mesh.tets()).zip(0..) {
        let material = materials.of(index).ok_or(none(tet))?;
        if material.alpha() != first.alpha() || material.beta() != first.beta() {
            return Err(MeshError::Damping { tet });
        }
        let Some(Shape { volume, gradients }) = shape(mesh.nodes(), corners) else {
            continue;
        };
        let (lambda, mu) = material.lame();
        let mass = volume * f64::from(material.density());
        total += mass;
        // |g_0|² is at most three times the sum of the others'.
        let square = 4.0 * gradients.iter().flatten().fold(0.0, |sum, g| sum + g * g);
        let stiffness = 2.0 * square * volume * (lambda.abs() + 2.0 * mu);
        let scalars = normal(mass / 4.0) && normal(mu * volume) && finite(lambda * volume);
        if !(scalars && finite(square) && finite(stiffness) && finite(2.0 * total)) {
            return Err(MeshError::OutOfScale { tet });
        }
    }
    Ok(first)
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "rest data is computed in f64 and rounded once"
)]
pub(crate) fn to_f32(x: f64) -> f32 {
    x as f32
}

/// Computes rest data in f64 and rounds each number once. The slices must have as many entries as
/// the mesh has nodes, and as [`blocks`] says for its tetrahedra. `first` is any of the materials, which were checked.
pub(crate) fn fill<L: Layout>(
    mesh: &Mesh<'_>,
    first: &Material,
    materials: &(impl Materials + ?Sized),
    out: &mut RestMut<'_, L>,
) {
    copy(out.nodes, mesh.nodes());
    out.masses.fill(0.0);
    let (mut total_mass, mut total_volume) = (0.0, 0.0);
    let chunks = mesh.tets().chunks(BLOCK);
    for (((chunk, block), stiffness), start) in chunks
        .zip(out.blocks.iter_mut())
        .zip(out.stiffness.iter_mut())
        .zip((0..).step_by(BLOCK))
    {
        *block = TetBlock::ZERO;
        for (lane, corners) in (0..BLOCK).zip(chunk) {
            let Some(shape) = shape(mesh.nodes(), corners) else {
                continue;
            };
            let material = materials.of(start + lane).unwrap_or(first);
            let (lambda, mu) = material.lame();
            let density = f64::from(material.density());
            total_volume += shape.volume;
            for (corner, &node) in corners.iter().enumerate() {
                block.corners[corner][lane] = node;
                // m_i = Σ ρV/4
                if let Some(mass) = out.masses.get_mut(node as usize) {
                    *mass += to_f32(density * shape.volume / 4.0);
                }
            }
            for corner in 0..3 {
                for axis in 0..3 {
                    block.gradients[corner][axis][lane] = to_f32(shape.gradients[corner][axis]);
                }
            }
            block.lambda_v[lane] = to_f32(lambda * shape.volume);
            block.mu_v[lane] = to_f32(mu * shape.volume);
        }
        *stiffness = L::isotropic(block);
    }
    for mass in out.masses.iter() {
        total_mass += f64::from(*mass);
    }
    let (tets, nodes) = (mesh.tets().len(), mesh.nodes().len());
    #[expect(
        clippy::cast_precision_loss,
        reason = "units only need the order of magnitude"
    )]
    let (per_tet, per_node) = (total_volume / tets as f64, total_mass / nodes as f64);
    *out.header = Header {
        fingerprint: fingerprint(mesh.nodes(), mesh.tets().iter().copied()),
        tets: u32::try_from(tets).unwrap_or(u32::MAX),
        alpha: first.alpha(),
        beta: first.beta(),
        length_unit: power_of_two_below(to_f32(libm::cbrt(per_tet))),
        mass_unit: power_of_two_below(to_f32(per_node)),
        total_mass: to_f32(total_mass),
    };
}

/// 64-bit FNV-1a over the bytes of the nodes' coordinates, then the tetrahedra's corners.
pub(crate) fn fingerprint(nodes: &[[f32; 3]], tets: impl Iterator<Item = [u32; 4]>) -> u64 {
    let hash = fnv1a_of(FNV_START, nodes.as_flattened());
    tets.fold(hash, |hash, corners| {
        corners.into_iter().fold(hash, fnv1a_word)
    })
}

/// Bytes of rest data.
#[must_use]
pub const fn rest_bytes<L: Layout>(nodes: usize, blocks: usize) -> usize {
    nodes * (size_of::<[f32; 3]>() + size_of::<f32>())
        + blocks * (size_of::<TetBlock>() + size_of::<L::Stiffness>())
        + size_of::<Header>()
}

/// Rest data of up to `NODES` nodes and `BLOCKS` blocks of eight tetrahedra
/// (`BLOCKS` = [`blocks`]`(tets)`), for a `static`.
#[derive(Debug)]
pub struct RestBuffer<const NODES: usize, const BLOCKS: usize, L: Layout = Factored> {
    nodes: heapless::Vec<[f32; 3], NODES>,
    masses: heapless::Vec<f32, NODES>,
    blocks: heapless::Vec<TetBlock, BLOCKS>,
    stiffness: heapless::Vec<L::Stiffness, BLOCKS>,
    header: Header,
}

impl<const NODES: usize, const BLOCKS: usize, L: Layout> RestBuffer<NODES, BLOCKS, L> {
    /// No mesh yet. All bits zero, so that a `static` costs no flash.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            nodes: heapless::Vec::new(),
            masses: heapless::Vec::new(),
            blocks: heapless::Vec::new(),
            stiffness: heapless::Vec::new(),
            header: Header::EMPTY,
        }
    }

    /// Fills the buffer in place; see [`RestMut::fill`].
    ///
    /// # Errors
    /// [`MeshError`] where the mesh does not fit, its materials do not, or its masses and stiffnesses leave
    /// the range of f32. The buffer is then as it was.
    pub fn fill(
        &mut self,
        mesh: &Mesh<'_>,
        materials: &(impl Materials + ?Sized),
    ) -> Result<(), MeshError> {
        let (nodes, tets) = (mesh.nodes().len(), mesh.tets().len());
        if nodes > NODES {
            return Err(MeshError::TooManyNodes {
                needed: nodes,
                capacity: NODES,
            });
        }
        if blocks(tets) > BLOCKS {
            return Err(MeshError::TooManyTets {
                needed: tets,
                capacity: BLOCKS * BLOCK,
            });
        }
        let first = check_materials(mesh, materials)?;
        // Both were checked above, so no resize can fail.
        _ = self.nodes.resize(nodes, [0.0; 3]);
        _ = self.masses.resize(nodes, 0.0);
        _ = self.blocks.resize(blocks(tets), TetBlock::ZERO);
        _ = self.stiffness.resize(blocks(tets), L::ZERO_STIFFNESS);
        fill(
            mesh,
            first,
            materials,
            &mut RestMut::<L> {
                nodes: &mut self.nodes,
                masses: &mut self.masses,
                blocks: &mut self.blocks,
                stiffness: &mut self.stiffness,
                header: &mut self.header,
            },
        );
        Ok(())
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

impl<const NODES: usize, const BLOCKS: usize, L: Layout> Default for RestBuffer<NODES, BLOCKS, L> {
    fn default() -> Self {
        Self::new()
    }
}
