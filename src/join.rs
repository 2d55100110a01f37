//! Several meshes in one (feature `alloc`): what touches must be one system (module `coupling`).

use alloc::vec::Vec;
use core::ops::Range;

#[cfg(feature = "contact")]
use glam::Vec3;

#[cfg(feature = "contact")]
use crate::coupling::Piece;
#[cfg(feature = "contact")]
use crate::detect::{Aabb, boxes, spatial_order};
use crate::material::{Material, MaterialError};
#[cfg(feature = "contact")]
use crate::rigid::{Rigid, Shape};
#[cfg(feature = "contact")]
use crate::surface::{boundary, sharp_edges};

/// Bodies, added one after the other, as one mesh: nodes, tetrahedra, and a material for each of these.
///
/// Soft bodies come first, rigid ones last, as couplings ask for.
#[derive(Clone, Debug, Default)]
pub struct Assembly {
    /// Nodes of all bodies, metres, placed.
    pub nodes: Vec<[f32; 3]>,
    /// Their tetrahedra, by nodes of the assembly.
    pub tets: Vec<[u32; 4]>,
    /// One a tetrahedron.
    pub materials: Vec<Material>,
    /// One a body.
    pub parts: Vec<Part>,
    #[cfg(feature = "contact")]
    rigids: Vec<Rigid>,
    #[cfg(feature = "contact")]
    surfaces: Vec<Surface>,
}

/// Of a soft body.
#[cfg(feature = "contact")]
#[derive(Clone, Debug)]
struct Surface {
    triangles: Vec<[u32; 3]>,
    edges: Vec<[u32; 4]>,
    /// One a triangle.
    tets: Vec<u32>,
    nodes: Vec<u32>,
    friction: f32,
}

/// Where a body is in an [`Assembly`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Its nodes.
    pub nodes: Range<usize>,
    /// Its tetrahedra.
    pub tets: Range<usize>,
}

/// Why a body cannot be added.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum JoinError {
    /// More nodes in all than u32 counts.
    TooManyNodes,
    /// A tetrahedron names a node that its mesh does not have.
    Node,
    /// A soft body after a rigid one.
    Order,
    /// The mass or a size of a rigid body is not positive, or out of range; or it is not placed by finite numbers, or so
    /// far from the origin that rounding its nodes leaves no volume.
    Rigid,
    /// The coefficient of friction is negative or not finite.
    Friction,
    /// The material that gives a rigid body its mass is out of range.
    Material(MaterialError),
}

impl core::fmt::Display for JoinError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::TooManyNodes => f.write_str("more nodes in all than can be numbered"),
            Self::Node => f.write_str("a tetrahedron names a node that does not exist"),
            Self::Order => f.write_str("soft bodies must come before rigid ones"),
            Self::Rigid => f.write_str(
                "mass and sizes must be positive, in range, and not lost in rounding where it is",
            ),
            Self::Friction => {
                f.write_str("the coefficient of friction must be finite and not negative")
            }
            Self::Material(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for JoinError {}

impl Assembly {
    /// Of no bodies.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    fn append(
        &mut self,
        nodes: &[[f32; 3]],
        tets: &[[u32; 4]],
        material: impl Fn(usize) -> Material,
    ) -> Result<Part, JoinError> {
        let first = self.nodes.len();
        let base = u32::try_from(first).map_err(|_| JoinError::TooManyNodes)?;
        if u32::try_from(first + nodes.len()).is_err() {
            return Err(JoinError::TooManyNodes);
        }
        if tets
            .as_flattened()
            .iter()
            .any(|&n| n as usize >= nodes.len())
        {
            return Err(JoinError::Node);
        }
        let start = self.tets.len();
        self.nodes.extend_from_slice(nodes);
        self.tets
            .extend(tets.iter().map(|tet| tet.map(|n| n + base)));
        self.materials.extend((0..tets.len()).map(material));
        let part = Part {
            nodes: first..self.nodes.len(),
            tets: start..self.tets.len(),
        };
        self.parts.push(part.clone());
        Ok(part)
    }

    /// Adds a soft body, placed (metres), of one material, with Coulomb's coefficient of friction for its surface.
    ///
    /// # Errors
    /// [`JoinError`]; nothing is added then.
    pub fn soft(
        &mut self,
        nodes: &[[f32; 3]],
        tets: &[[u32; 4]],
        material: Material,
        friction: f32,
    ) -> Result<Part, JoinError> {
        if !(friction >= 0.0 && friction.is_finite()) {
            return Err(JoinError::Friction);
        }
        #[cfg(feature = "contact")]
        if !self.rigids.is_empty() {
            return Err(JoinError::Order);
        }
        let part = self.append(nodes, tets, |_| material)?;
        #[cfg(feature = "contact")]
        {
            let tets = self.tets.get(part.tets.clone()).unwrap_or_default();
            let found = boundary(tets);
            let mut triangles: Vec<_> = found.iter().map(|&(_, triangle)| triangle).collect();
            spatial_order(&self.nodes, &mut triangles);
            let mut of: Vec<_> = found.into_iter().map(|(tet, t)| (t, tet)).collect();
            of.sort_unstable();
            let first = part.tets.start;
            // Each is there; more than u32 counts are never in a mesh.
            let of = triangles.iter().map(|triangle| {
                let at = of.binary_search_by(|(t, _)| t.cmp(triangle)).ok()?;
                u32::try_from(first + of.get(at)?.1).ok()
            });
            let tets = of.map(|tet| tet.unwrap_or(u32::MAX)).collect();
            let mut nodes: Vec<u32> = triangles.as_flattened().to_vec();
            nodes.sort_unstable();
            nodes.dedup();
            self.surfaces.push(Surface {
                triangles,
                edges: Vec::new(),
                tets,
                nodes,
                friction,
            });
        }
        Ok(part)
    }

    /// Adds a rigid body of mass `mass` (kg), its centre at `centre` (metres) and its axes along `axes`
    /// (orthonormal, right-handed), as one tetrahedron of four equal masses; `damped_like` gives the system's Rayleigh
    /// damping, of which α acts on it.
    ///
    /// # Errors
    /// [`JoinError`]; nothing is added then.
    #[cfg(feature = "contact")]
    pub fn rigid(
        &mut self,
        shape: Shape,
        mass: f32,
        centre: Vec3,
        axes: [Vec3; 3],
        friction: f32,
        damped_like: &Material,
    ) -> Result<Part, JoinError> {
        if !(friction >= 0.0 && friction.is_finite()) {
            return Err(JoinError::Friction);
        }
        let lengths = shape.lengths();
        let nodes = shape.nodes(centre, axes);
        // Of the rounded nodes, so that the mass is right wherever they are.
        let volume = crate::mesh::shape(&nodes, &[0, 1, 2, 3]).map_or(0.0, |shape| shape.volume);
        let density = crate::rest::to_f32(f64::from(mass) / volume);
        // It never strains; so little that its rounding is nothing beside its inertia in any step up to a second.
        let young = mass * 1e-6 / lengths.max_element();
        let sizes = lengths.min_element() > 0.0 && lengths.is_finite() && volume.is_normal();
        let placed = centre.is_finite() && axes.iter().all(|e| e.is_finite());
        if !(mass > 0.0 && sizes && placed && density.is_normal() && young.is_normal()) {
            return Err(JoinError::Rigid);
        }
        let material = Material::new(young, 0.0, density)
            .and_then(|m| m.with_damping(damped_like.alpha(), damped_like.beta()))
            .map_err(JoinError::Material)?;
        let first = u32::try_from(self.nodes.len()).map_err(|_| JoinError::TooManyNodes)?;
        let part = self.append(&nodes, &[[0, 1, 2, 3]], |_| material)?;
        self.rigids.push(Rigid::new(first, shape, friction));
        Ok(part)
    }

    /// The rigid bodies, for [`Couplings`](crate::coupling::Couplings).
    #[cfg(feature = "contact")]
    #[must_use]
    pub fn rigids(&self) -> Vec<Rigid> {
        self.rigids.clone()
    }

    /// The soft pieces with their surfaces, for [`Couplings`](crate::coupling::Couplings).
    #[cfg(feature = "contact")]
    #[must_use]
    pub fn pieces(&self) -> Vec<Piece<'_>> {
        self.surfaces
            .iter()
            .zip(&self.parts)
            .map(|(surface, part)| Piece {
                // Counted when they were added.
                range: (part.nodes.start as u32, part.nodes.end as u32),
                triangles: &surface.triangles,
                edges: &surface.edges,
                tets: &surface.tets,
                nodes: &surface.nodes,
                friction: surface.friction,
            })
            .collect()
    }

    /// Lets the sharp edges of soft bodies, those that are there now, touch each other, too.
    #[cfg(feature = "contact")]
    pub fn touch_by_edges(&mut self) {
        for surface in &mut self.surfaces {
            surface.edges = sharp_edges(&self.nodes, &surface.triangles);
            spatial_order(&self.nodes, &mut surface.edges);
        }
    }

    /// Room for the boxes of the search for contacts, for
    /// [`Couplings::with_boxes`](crate::coupling::Couplings::with_boxes).
    #[cfg(feature = "contact")]
    #[must_use]
    pub fn boxes(&self) -> Vec<Aabb> {
        let of = |s: &Surface| boxes(s.triangles.len()) + boxes(s.edges.len());
        alloc::vec![Aabb::EMPTY; self.surfaces.iter().map(of).sum()]
    }

    /// Says that the mesh has the assembly's tetrahedra in another order: which of them is the mesh's k-th
    /// ([`Ordered::original`](crate::order::Ordered::original)). For [`Self::pieces`] of bodies that break.
    #[cfg(feature = "contact")]
    pub fn reorder(&mut self, original: &[usize]) {
        let mut place = alloc::vec![u32::MAX; self.tets.len()];
        for (new, &old) in (0_u32..).zip(original) {
            if let Some(place) = place.get_mut(old) {
                *place = new;
            }
        }
        let tets = self.surfaces.iter_mut().flat_map(|s| &mut s.tets);
        for tet in tets {
            *tet = place.get(*tet as usize).copied().unwrap_or(u32::MAX);
        }
    }
}
