//! What a step's cost depends on.

use crate::element::Layout;
use crate::fan;
use crate::lane::blocks;
use crate::preconditioner::Preconditioner;
use crate::preconditioner::coarse;
use crate::preconditioner::factor::Entries;
use crate::rest::Rest;
use crate::scene::Scene;
use crate::settings::{Settings, Start};
use crate::vector::SUMS;

/// A preconditioner without its data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// [`Preconditioner::Identity`]
    Identity,
    /// [`Preconditioner::Mass`]
    Mass,
    /// [`Preconditioner::Jacobi`]
    Jacobi,
    /// [`Preconditioner::BlockJacobi`]
    BlockJacobi,
    /// [`Entries::Warped`]
    Warped,
    /// [`Entries::WarpedHalf`]
    WarpedHalf,
    /// [`Entries::Laplacian`]
    Laplacian,
    /// [`Entries::LaplacianHalf`]
    LaplacianHalf,
    /// [`Preconditioner::TwoLevel`]
    TwoLevel,
}

impl Kind {
    /// All, by name, in the order of their rows.
    pub const ALL: [(&str, Self); 9] = [
        ("identity", Self::Identity),
        ("mass", Self::Mass),
        ("jacobi", Self::Jacobi),
        ("block-jacobi", Self::BlockJacobi),
        ("warped", Self::Warped),
        ("warped-half", Self::WarpedHalf),
        ("laplacian", Self::Laplacian),
        ("laplacian-half", Self::LaplacianHalf),
        ("two-level", Self::TwoLevel),
    ];
}

impl From<Preconditioner<'_>> for Kind {
    fn from(preconditioner: Preconditioner<'_>) -> Self {
        match preconditioner {
            Preconditioner::Identity => Self::Identity,
            Preconditioner::Mass => Self::Mass,
            Preconditioner::Jacobi => Self::Jacobi,
            Preconditioner::BlockJacobi => Self::BlockJacobi,
            Preconditioner::Factored(factor) => match factor.entries() {
                Entries::Warped { .. } => Self::Warped,
                Entries::WarpedHalf { .. } => Self::WarpedHalf,
                Entries::Laplacian { .. } => Self::Laplacian,
                Entries::LaplacianHalf { .. } => Self::LaplacianHalf,
            },
            Preconditioner::TwoLevel(_) => Self::TwoLevel,
        }
    }
}

/// What the coarse half of [`Preconditioner::TwoLevel`] has to do: nothing for any other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Coarse {
    /// How many aggregates.
    pub aggregates: usize,
    /// Blocks that hold a tetrahedron whose corners are not all of one aggregate.
    pub cut_blocks: usize,
    /// Over these blocks, n(n + 1)/2 where n is the most aggregates of one of its tetrahedra.
    pub products: usize,
    /// Over these tetrahedra, n(n + 1)/2 where n is the number of its aggregates.
    pub sums: usize,
}

/// Shapes of colliders that are no half-spaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Shapes {
    /// Spheres.
    pub spheres: usize,
    /// [`Capsule`](crate::collider::Capsule)s.
    pub capsules: usize,
    /// [`Cuboid`](crate::collider::Cuboid)s.
    pub boxes: usize,
    /// [`HeightField`](crate::collider::HeightField)s.
    pub height_fields: usize,
    /// How many of all are [`Placed`](crate::collider::Placed).
    pub placed: usize,
    /// Shapes of one's own. What they cost, three calls a node, is not in the formula.
    pub others: usize,
}

/// What couples the bodies of one system (feature `contact`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Coupled {
    /// Soft pieces.
    pub pieces: usize,
    /// Rigid bodies.
    pub rigids: usize,
    /// Attachments and springs.
    pub links: usize,
    /// Slots for links and contacts, used or not.
    pub slots: usize,
}

impl Coupled {
    pub(super) fn parts(&self) -> usize {
        self.pieces.saturating_add(self.rigids)
    }

    /// Parts, rigid ones among them, links, slots.
    pub(super) fn counts(&self) -> [u64; 4] {
        [self.parts(), self.rigids, self.links, self.slots].map(|count| count as u64)
    }
}

/// All that a step's cost depends on, but for the budget.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Load {
    /// Nodes of the mesh.
    pub nodes: usize,
    /// Tetrahedra of the mesh.
    pub tets: usize,
    /// Runs of blocks that share gathers and scatters, eight fans side by side; at most as many as there are
    /// blocks. [`order::fans`](crate::order::fans) makes them few.
    pub fans: usize,
    /// Start of the solver.
    pub start: Start,
    /// Preconditioner of the solver.
    pub preconditioner: Kind,
    /// Entries of its factor, or 0.
    pub entries: usize,
    /// Its coarse half, if it has one.
    pub coarse: Coarse,
    /// Pins of the scene.
    pub pins: usize,
    /// Colliders of the scene.
    pub colliders: usize,
    /// Those of them that are no half-spaces.
    pub shapes: Shapes,
    /// Whether a pin or collider has a velocity.
    pub moving: bool,
    /// Whether the guard over contact's energy acts (feature `energy-guard`).
    pub guarded: bool,
    /// Whether the scene has a list of forces.
    pub forces: bool,
    /// Whether θ < 1.
    pub newmark: bool,
    /// Whether the body flows (feature `plasticity`).
    pub flows: bool,
    /// How many tetrahedra may fail in a step, 0 where the body does not break (feature `fracture`).
    pub tears: u32,
    /// Its couplings, if it has any: [`Self::with_couplings`].
    pub coupled: Coupled,
}

impl Load {
    /// A free body of so many nodes and tetrahedra, with the settings' defaults. No two blocks share anything,
    /// which is the most that a mesh can cost, whatever its order; [`Self::of`] counts.
    #[must_use]
    pub const fn new(nodes: usize, tets: usize) -> Self {
        Self {
            nodes,
            tets,
            fans: blocks(tets),
            start: Start::Galerkin(1),
            preconditioner: Kind::Jacobi,
            entries: 0,
            coarse: Coarse {
                aggregates: 0,
                cut_blocks: 0,
                products: 0,
                sums: 0,
            },
            pins: 0,
            colliders: 0,
            shapes: Shapes {
                spheres: 0,
                capsules: 0,
                boxes: 0,
                height_fields: 0,
                placed: 0,
                others: 0,
            },
            moving: false,
            guarded: false,
            forces: false,
            newmark: false,
            flows: false,
            tears: 0,
            coupled: Coupled {
                pieces: 0,
                rigids: 0,
                links: 0,
                slots: 0,
            },
        }
    }

    /// That of a step with these couplings.
    #[cfg(feature = "contact")]
    #[must_use]
    pub fn with_couplings(self, couplings: &crate::coupling::Couplings<'_>) -> Self {
        let coupled = Coupled {
            pieces: couplings.pieces.len(),
            rigids: couplings.rigids.len(),
            links: couplings.links.len(),
            slots: couplings.slots.len(),
        };
        Self { coupled, ..self }
    }

    /// That of a step. Goes through the mesh once: not for every step.
    #[must_use]
    pub fn of<L: Layout>(rest: &Rest<'_, L>, scene: &Scene<'_>, settings: &Settings<'_>) -> Self {
        let preconditioner = settings.preconditioner;
        let mut shapes = Shapes::default();
        for collider in scene.colliders {
            collider.count(&mut shapes);
        }
        Self {
            shapes,
            #[cfg(feature = "plasticity")]
            flows: settings.plasticity.is_some(),
            #[cfg(feature = "fracture")]
            tears: settings.fracture.map_or(0, |law| law.per_step()),
            fans: fan::fans(rest).count(),
            start: settings.start,
            preconditioner: preconditioner.into(),
            entries: match preconditioner {
                Preconditioner::Factored(factor) => factor.rows().len(),
                _ => 0,
            },
            coarse: match preconditioner {
                Preconditioner::TwoLevel(aggregates) => coarse::load(rest.blocks, &aggregates),
                _ => Coarse::default(),
            },
            pins: scene.pins.len(),
            colliders: scene.colliders.len(),
            moving: scene.moves(),
            guarded: settings.guards(scene),
            forces: !scene.forces.is_empty(),
            newmark: settings.theta() < 1.0,
            ..Self::new(rest.nodes.len(), rest.header.tets as usize)
        }
    }

    /// What the coefficients of a row are multiplied with.
    #[must_use]
    pub fn sizes(&self) -> [u64; SIZES] {
        let left = self.nodes % SUMS * 3 % SUMS;
        let blocks = blocks(self.tets);
        [1, self.nodes, left, blocks, self.fans, self.entries].map(|size| size as u64)
    }
}

/// Once; nodes; numbers of a node vector that do not fill the sums of a dot product; blocks; fans; entries of the
/// factor.
pub const SIZES: usize = 6;
