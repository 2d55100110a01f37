//! Bodies as bytes: baked on a host, embedded in a program, read in place.
//!
//! An asset holds everything about a body that never changes: rest data, a factor if it has one, its pins,
//! and what it was made of and for. [`Asset::new`] checks all of it and borrows it from the bytes,
//! without a copy, so that it stays in flash:
//!
//! ```
//! use femto::asset::{Asset, Capacity, capacity};
//! use femto::body::{State, Workspace};
//! use femto::element::Factored;
//! use femto::lane::Native;
//! use femto::{Scene, Start, glam::Vec3, step::step};
//!
//! static BYTES: &[u8] = femto::include_asset!(
//!     concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/cube.femto")
//! );
//! const SIZE: Capacity = capacity(BYTES);
//! const START: Start = Start::Galerkin(1);
//! // In firmware, two statics; all bits zero.
//! let mut state = State::<{ SIZE.nodes }, { SIZE.blocks }, { START.history() }>::new();
//! let mut workspace = Workspace::<{ SIZE.nodes }, { SIZE.blocks }, { START.vectors() }>::new();
//!
//! let asset = Asset::new(BYTES)?;
//! state.reset(&asset.rest)?;
//! let scene = Scene { gravity: Vec3::new(0.0, -9.81, 0.0), pins: asset.pins, ..Scene::default() };
//! let report = step::<Native, Factored>(
//!     &asset.rest,
//!     &mut state.view_mut(),
//!     &mut workspace.view_mut(&asset.rest),
//!     &scene,
//!     &asset.settings().with_start(START),
//! );
//! assert!(report.advanced());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! With the feature `alloc`, [`Asset::to_bytes`] writes one. The tool `femto bake` makes them from meshes.
//!
//! # The bytes, version 1
//!
//! Little-endian; whole numbers are unsigned, the others IEEE 754. SI units.
//!
//! | offset | bytes | what |
//! |---|---|---|
//! | 0 | 8 | `f3 65 6d 74 6f 0d 0a 0a` |
//! | 8 | 4 | version |
//! | 12 | 4 | bytes in all |
//! | 16 | 8 | FNV-1a (64 bit) of all bytes from offset 24 on |
//! | 24 | 8 | fingerprint: FNV-1a (64 bit) of the nodes' coordinates, then of every tetrahedron's four corners as u32 |
//! | 32 | 4 | tetrahedra |
//! | 36 | 5 × 4 | f32: α, β, length unit, mass unit (powers of two), total mass |
//! | 56 | 3 × 4 | f32: Young's modulus, Poisson's ratio, density |
//! | 68 | 2 × 4 | f32: time step and θ, which the factor was made for |
//! | 76 | 2 × 4 | iterations, polar sweeps |
//! | 84 | 4 | start: 0 zero, 1 velocity, 2 velocity-force, 3 + 256m galerkin-m, 4 + 256m rigid-m |
//! | 88 | 4 | factor: 0 none, 1 warped, 2 warped in half precision, 3 Laplacian, 4 Laplacian in half precision |
//! | 92 | 4 | 0 |
//! | 96 | 10 × 8 | offset and bytes of every section, as they follow |
//!
//! | section | an entry | entries |
//! |---|---|---|
//! | nodes | 3 f32, X | one a node |
//! | masses | f32 | one a node |
//! | blocks | [`TetBlock`]: 32 u32, 88 f32 | one for eight tetrahedra, the last padded with zeros |
//! | pins | u32 node, 3 f32 velocity | by ascending node |
//! | source | UTF-8 | |
//! | order | u16 | one a node |
//! | ends | u32 | one a node |
//! | rows | u16 | one an entry of L |
//! | pivots | f32, or 6 f32 (warped) | one a node |
//! | lower | f32 or binary16 as u16, 9 of them (warped) | one an entry of L |
//!
//! The last five are empty without a factor; what they mean stands in
//! [`factor`](crate::preconditioner::factor). The first section begins at 192, each further one at the
//! next multiple of 32 behind the one before it, and the bytes end at the next multiple of 32 behind
//! the last.
//!
//! Big-endian machines cannot read such bytes in place and get [`AssetError::BigEndianHost`].

mod check;
mod error;
mod format;
#[cfg(feature = "alloc")]
mod write;

pub use error::{AssetError, HeaderField, SectionFault};
pub use format::{Section, VERSION};
#[cfg(feature = "alloc")]
pub use write::AssetBytes;

use bytemuck::AnyBitPattern;

use crate::body::{state_bytes, workspace_bytes};
use crate::constraint::Pin;
use crate::element::Factored;
use crate::lane::blocks;
use crate::material::Material;
use crate::preconditioner::Preconditioner;
use crate::preconditioner::factor::{Entries, Factor};
use crate::rest::{Rest, TetBlock};
use crate::settings::{Budget, Settings, Start};
use format::{FactorCode, FileHeader};

/// Assets, and all their sections, begin at multiples of so many bytes.
pub const ALIGNMENT: usize = align_of::<TetBlock>();

/// What makes bytes begin at a multiple of [`ALIGNMENT`].
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct Aligned<T: ?Sized>(pub T);

/// The bytes of an asset file as a `&'static [u8]` that begins at a multiple of 32, as
/// [`include_bytes!`] does not promise.
#[macro_export]
macro_rules! include_asset {
    ($path:expr) => {{
        const BYTES: &$crate::asset::Aligned<[u8]> =
            &$crate::asset::Aligned(*include_bytes!($path));
        &BYTES.0
    }};
}

/// An asset, checked and borrowed from its bytes.
#[derive(Clone, Copy, Debug)]
pub struct Asset<'a> {
    /// Rest data.
    pub rest: Rest<'a>,
    /// The factor, if it was baked with one.
    pub factor: Option<Factor<'a>>,
    /// Nodes to hold, by ascending node; the factor knows of them.
    pub pins: &'a [Pin],
    /// What it was made of and for.
    pub metadata: Metadata<'a>,
}

/// What an asset was made of and for.
#[derive(Clone, Copy, Debug)]
pub struct Metadata<'a> {
    /// Name of the mesh.
    pub source: &'a str,
    /// The material.
    pub material: Material,
    /// Time step and θ that the factor was made for; start and budget as a suggestion. The
    /// preconditioner is not part of it: see [`Asset::settings`].
    pub settings: Settings<'static>,
}

/// How much room a body needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capacity {
    /// Nodes.
    pub nodes: usize,
    /// Blocks of eight tetrahedra.
    pub blocks: usize,
}

/// Reads from an asset's bytes how much room it needs, for constants: the `NODES` and `BLOCKS` of
/// [`State`](crate::body::State) and [`Workspace`](crate::body::Workspace). Zeros where the bytes are
/// none; they are not checked.
#[must_use]
pub const fn capacity(bytes: &[u8]) -> Capacity {
    // Tetrahedra; the bytes of the section `nodes`.
    let (tets, nodes) = (word(bytes, 32), word(bytes, 100) / size_of::<[f32; 3]>());
    Capacity {
        nodes,
        blocks: blocks(tets),
    }
}

/// 0 where there are no bytes.
const fn word(bytes: &[u8], at: usize) -> usize {
    match bytes.split_at_checked(at) {
        Some((_, rest)) => match rest.first_chunk() {
            Some(word) => u32::from_le_bytes(*word) as usize,
            None => 0,
        },
        None => 0,
    }
}

impl<'a> Asset<'a> {
    /// Checks an asset, every number of it, and borrows it. What passes can be stepped with safely, as
    /// any body can.
    ///
    /// It is not computed anew whether gradients and stiffness are those of the nodes and the material;
    /// the checksum guards them.
    ///
    /// # Errors
    /// [`AssetError`].
    pub fn new(bytes: &'a [u8]) -> Result<Self, AssetError> {
        let asset = Self::parse(bytes, false)?;
        asset.check()?;
        Ok(asset)
    }

    /// Whether these bytes begin like an asset.
    #[must_use]
    pub fn is_one(bytes: &[u8]) -> bool {
        bytes.starts_with(&format::MAGIC)
    }

    /// Borrows once more the bytes of an asset that passed [`Self::new`], without going through its numbers: for
    /// callers that cannot keep an `Asset`. From bytes that would not pass, it may make a body of nonsense, whose
    /// steps are refused or nonsense; nothing worse.
    ///
    /// # Errors
    /// [`AssetError`], where the frame or the table of sections is wrong.
    pub fn reopen(bytes: &'a [u8]) -> Result<Self, AssetError> {
        Self::parse(bytes, true)
    }

    fn parse(bytes: &'a [u8], trusted: bool) -> Result<Self, AssetError> {
        let header = FileHeader::read(bytes, trusted)?;
        let [
            nodes,
            masses,
            blocks,
            pins,
            source,
            order,
            ends,
            rows,
            pivots,
            lower,
        ] = header.sections(bytes)?;
        let rest = Rest {
            nodes: cast(nodes, Section::Nodes)?,
            masses: cast(masses, Section::Masses)?,
            blocks: cast(blocks, Section::Blocks)?,
            stiffness: no_stiffness(blocks.len() / size_of::<TetBlock>()),
            fans: &[],
            header: header.rest,
        };
        let pins: &[Pin] = cast(pins, Section::Pins)?;
        let source = core::str::from_utf8(source).map_err(|_| AssetError::Source)?;
        let metadata = metadata(&header, source)?;
        let code = FactorCode::of(header.factor).ok_or(AssetError::Code {
            field: "factor",
            found: header.factor,
        })?;
        let entries = match code {
            _ if cfg!(not(feature = "factored")) => None,
            FactorCode::None => None,
            FactorCode::Warped => Some(Entries::Warped {
                pivots: cast(pivots, Section::Pivots)?,
                lower: cast(lower, Section::Lower)?,
            }),
            FactorCode::WarpedHalf => Some(Entries::WarpedHalf {
                pivots: cast(pivots, Section::Pivots)?,
                lower: cast(lower, Section::Lower)?,
            }),
            FactorCode::Laplacian => Some(Entries::Laplacian {
                pivots: cast(pivots, Section::Pivots)?,
                lower: cast(lower, Section::Lower)?,
            }),
            FactorCode::LaplacianHalf => Some(Entries::LaplacianHalf {
                pivots: cast(pivots, Section::Pivots)?,
                lower: cast(lower, Section::Lower)?,
            }),
        };
        let factor = match entries {
            Some(entries) => {
                let order = cast(order, Section::Order)?;
                let ends = cast(ends, Section::Ends)?;
                let rows = cast(rows, Section::Rows)?;
                let make = if trusted {
                    Factor::trusted
                } else {
                    Factor::new
                };
                let factor = make(header.rest.fingerprint, order, ends, rows, entries);
                Some(factor.map_err(AssetError::Factor)?)
            }
            None => {
                for (section, part) in Section::ALL
                    .into_iter()
                    .skip(5)
                    .zip([order, ends, rows, pivots, lower])
                {
                    if code == FactorCode::None && !part.is_empty() {
                        return Err(wrong_length(section));
                    }
                }
                None
            }
        };
        Ok(Self {
            rest,
            factor,
            pins,
            metadata,
        })
    }

    /// The settings that it was made for, with its factor if it has one.
    #[must_use]
    pub fn settings(&self) -> Settings<'_> {
        let settings = self.metadata.settings;
        match &self.factor {
            Some(factor) => settings.with_preconditioner(Preconditioner::Factored(factor)),
            None => settings,
        }
    }

    /// Bytes of state and of workspace that stepping with this start takes.
    #[must_use]
    pub fn ram(&self, start: Start) -> (usize, usize) {
        let (nodes, blocks) = (self.rest.nodes.len(), self.rest.blocks.len());
        (
            state_bytes(nodes, blocks, start.history()),
            workspace_bytes::<Factored>(nodes, blocks, start.vectors()),
        )
    }
}

fn metadata<'a>(header: &FileHeader, source: &'a str) -> Result<Metadata<'a>, AssetError> {
    let material = Material::new(header.young, header.poisson, header.density)
        .and_then(|m| m.with_damping(header.rest.alpha, header.rest.beta))
        .map_err(AssetError::Material)?;
    let start = format::start_of(header.start).ok_or(AssetError::Code {
        field: "start",
        found: header.start,
    })?;
    let settings = Settings::new(header.dt)
        .and_then(|settings| settings.with_theta(header.theta))
        .map_err(AssetError::Settings)?
        .with_start(start)
        .with_budget(Budget {
            iterations: header.iterations,
            polar_sweeps: header.polar_sweeps,
        });
    Ok(Metadata {
        source,
        material,
        settings,
    })
}

const fn wrong_length(section: Section) -> AssetError {
    AssetError::Section {
        section,
        fault: SectionFault::Length,
    }
}

/// What the factored layout stores beside the blocks: nothing, so many times.
fn no_stiffness(blocks: usize) -> &'static [()] {
    const NOTHING: &[()] = &[(); usize::MAX];
    NOTHING.get(..blocks).unwrap_or_default()
}

/// A section's entries. All begin at multiples of [`ALIGNMENT`].
fn cast<T: AnyBitPattern>(bytes: &[u8], section: Section) -> Result<&[T], AssetError> {
    bytemuck::try_cast_slice(bytes).map_err(|_| wrong_length(section))
}
