//! The layout of the bytes, for reading and for writing.

use bytemuck::{Pod, Zeroable};

use super::{ALIGNMENT, AssetError, SectionFault};
use crate::energy::{FNV_START, fnv1a};
use crate::rest::Header;
use crate::settings::Start;

/// Line endings of both kinds, and a byte beyond ASCII: damaged by whatever takes it for text.
pub(super) const MAGIC: [u8; 8] = *b"\xf3emto\r\n\n";

/// Of the bytes; other versions are refused.
pub const VERSION: u32 = 1;

/// What precedes the sections.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct FileHeader {
    pub magic: [u8; 8],
    pub version: u32,
    pub bytes: u32,
    pub checksum: u64,
    pub rest: Header,
    pub young: f32,
    pub poisson: f32,
    pub density: f32,
    pub dt: f32,
    pub theta: f32,
    pub iterations: u32,
    pub polar_sweeps: u32,
    pub start: u32,
    pub factor: u32,
    pub reserved: u32,
    pub sections: [Place; SECTIONS],
}

/// Where a section is, in bytes from the beginning.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Place {
    pub offset: u32,
    pub bytes: u32,
}

/// Bytes that the checksum does not cover: the magic, the version, the length, and itself.
pub(super) const UNCOVERED: usize = 24;
pub(super) const HEADER: usize = size_of::<FileHeader>();
const SECTIONS: usize = Section::ALL.len();

/// A part of an asset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Section {
    /// Rest positions.
    Nodes,
    /// Node masses.
    Masses,
    /// Blocks of eight tetrahedra.
    Blocks,
    /// Pinned nodes.
    Pins,
    /// Where the mesh came from.
    Source,
    /// The factor's order of elimination.
    Order,
    /// Where the factor's columns end.
    Ends,
    /// The factor's rows.
    Rows,
    /// The factor's pivots.
    Pivots,
    /// The factor's entries.
    Lower,
}

impl Section {
    /// All, in the order in which they lie.
    pub const ALL: [Self; 10] = [
        Self::Nodes,
        Self::Masses,
        Self::Blocks,
        Self::Pins,
        Self::Source,
        Self::Order,
        Self::Ends,
        Self::Rows,
        Self::Pivots,
        Self::Lower,
    ];

    /// Its name in messages.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nodes => "nodes",
            Self::Masses => "masses",
            Self::Blocks => "blocks",
            Self::Pins => "pins",
            Self::Source => "source",
            Self::Order => "order",
            Self::Ends => "ends",
            Self::Rows => "rows",
            Self::Pivots => "pivots",
            Self::Lower => "lower",
        }
    }
}

/// What kind of factor the sections `pivots` and `lower` hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FactorCode {
    None,
    Warped,
    WarpedHalf,
    Laplacian,
    LaplacianHalf,
}

impl FactorCode {
    const ALL: [Self; 5] = [
        Self::None,
        Self::Warped,
        Self::WarpedHalf,
        Self::Laplacian,
        Self::LaplacianHalf,
    ];

    #[cfg(feature = "alloc")]
    pub const fn code(self) -> u32 {
        self as u32
    }

    pub fn of(code: u32) -> Option<Self> {
        let index = usize::try_from(code).ok()?;
        Self::ALL.get(index).copied()
    }
}

/// A start as a number: its kind in the low byte, its history in the next.
#[cfg(feature = "alloc")]
pub(super) fn start_code(start: Start) -> u32 {
    match start {
        Start::Zero => 0,
        Start::Velocity => 1,
        Start::VelocityForce => 2,
        Start::Galerkin(m) => 3 | u32::from(m) << 8,
        Start::Rigid(m) => 4 | u32::from(m) << 8,
    }
}

pub(super) fn start_of(code: u32) -> Option<Start> {
    let [kind, m, 0, 0] = code.to_le_bytes() else {
        return None;
    };
    match (kind, m) {
        (0, 0) => Some(Start::Zero),
        (1, 0) => Some(Start::Velocity),
        (2, 0) => Some(Start::VelocityForce),
        (3, _) => Some(Start::Galerkin(m)),
        (4, _) => Some(Start::Rigid(m)),
        _ => None,
    }
}

/// FNV-1a of the bytes behind the checksum. It sees every single changed byte.
pub(super) fn checksum(bytes: &[u8]) -> u64 {
    let covered = bytes.get(UNCOVERED..).unwrap_or_default();
    fnv1a(FNV_START, covered.iter().copied())
}

impl FileHeader {
    /// Checks the frame: what can be said without looking into the sections, and the checksum unless that is
    /// trusted.
    pub fn read(bytes: &[u8], trusted: bool) -> Result<Self, AssetError> {
        if cfg!(target_endian = "big") {
            return Err(AssetError::BigEndianHost);
        }
        if !bytes.as_ptr().addr().is_multiple_of(ALIGNMENT) {
            return Err(AssetError::Unaligned);
        }
        let given = bytes.len();
        if !bytes.iter().zip(&MAGIC).all(|(a, b)| a == b) {
            return Err(AssetError::Magic);
        }
        let truncated = |needed| AssetError::Truncated { needed, given };
        let head = bytes.get(..HEADER).ok_or(truncated(HEADER))?;
        let header: Self = bytemuck::try_pod_read_unaligned(head).map_err(|_| AssetError::Magic)?;
        if header.version != VERSION {
            return Err(AssetError::Version {
                found: header.version,
            });
        }
        let needed = usize::try_from(header.bytes).unwrap_or(usize::MAX);
        if given < needed {
            return Err(truncated(needed));
        }
        if given > needed {
            return Err(AssetError::Trailing { needed, given });
        }
        let computed = if trusted {
            header.checksum
        } else {
            checksum(bytes)
        };
        if computed != header.checksum {
            return Err(AssetError::Checksum {
                stored: header.checksum,
                computed,
            });
        }
        if header.reserved != 0 {
            return Err(AssetError::Code {
                field: "reserved",
                found: header.reserved,
            });
        }
        Ok(header)
    }

    /// The bytes of every section. They lie one behind the other, each at the next multiple of
    /// [`ALIGNMENT`], up to the end.
    pub fn sections<'a>(&self, bytes: &'a [u8]) -> Result<[&'a [u8]; SECTIONS], AssetError> {
        let mut parts: [&[u8]; SECTIONS] = [&[]; SECTIONS];
        let mut end = HEADER;
        let places = Section::ALL.iter().zip(&self.sections);
        for ((&section, place), part) in places.zip(&mut parts) {
            let wrong = |fault| AssetError::Section { section, fault };
            let out_of_range = wrong(SectionFault::OutOfRange);
            let offset = usize::try_from(place.offset).map_err(|_| out_of_range)?;
            let length = usize::try_from(place.bytes).map_err(|_| out_of_range)?;
            if !offset.is_multiple_of(ALIGNMENT) {
                return Err(wrong(SectionFault::Misaligned));
            }
            let stop = offset.checked_add(length).ok_or(out_of_range)?;
            *part = bytes.get(offset..stop).ok_or(out_of_range)?;
            if Some(offset) != end.checked_next_multiple_of(ALIGNMENT) {
                return Err(wrong(SectionFault::Misplaced));
            }
            end = stop;
        }
        let (given, needed) = (bytes.len(), end.next_multiple_of(ALIGNMENT));
        if given == needed {
            Ok(parts)
        } else {
            Err(AssetError::Trailing { needed, given })
        }
    }
}
