//! What can be wrong with an asset.

use core::fmt;

use super::Section;
use crate::material::MaterialError;
use crate::preconditioner::factor::FactorError;
use crate::settings::SettingsError;

/// Why an asset was refused. Indices count from zero.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum AssetError {
    /// Assets are little-endian and read in place, which this machine cannot.
    BigEndianHost,
    /// The bytes do not begin at a multiple of 32: take [`include_asset!`](crate::include_asset) or
    /// [`Aligned`](super::Aligned).
    Unaligned,
    /// The first eight bytes are not those of an asset.
    Magic,
    /// The bytes are of another version of the format.
    Version {
        /// The version.
        found: u32,
    },
    /// The bytes end too early.
    Truncated {
        /// Bytes that there should be.
        needed: usize,
        /// Bytes that there are.
        given: usize,
    },
    /// The bytes go on behind the end.
    Trailing {
        /// Bytes that there should be.
        needed: usize,
        /// Bytes that there are.
        given: usize,
    },
    /// The bytes were changed.
    Checksum {
        /// The checksum that the asset has.
        stored: u64,
        /// That of its bytes.
        computed: u64,
    },
    /// A number that stands for a choice, and for none that is known.
    Code {
        /// What it should choose.
        field: &'static str,
        /// The number.
        found: u32,
    },
    /// A section is not where or not as long as it must be.
    Section {
        /// The section.
        section: Section,
        /// What is wrong.
        fault: SectionFault,
    },
    /// The source's name is not UTF-8.
    Source,
    /// The material is out of range.
    Material(MaterialError),
    /// The time step or θ is out of range.
    Settings(SettingsError),
    /// A number of the header contradicts the sections or is out of range.
    Header(HeaderField),
    /// A node's coordinate is not finite.
    Node {
        /// The node.
        node: u32,
    },
    /// A node's mass is not positive, finite and a normal f32.
    Mass {
        /// The node.
        node: u32,
    },
    /// A tetrahedron names a node that does not exist, or one twice.
    Corner {
        /// The tetrahedron.
        tet: u32,
        /// The node that it names.
        node: u32,
    },
    /// A tetrahedron's gradients or stiffness are not finite or out of range; or its stiffness is not
    /// positive: μV > 0, 3λV + 2μV ≥ 0.
    Stiffness {
        /// The tetrahedron.
        tet: u32,
    },
    /// A tetrahedron that only fills a block is not all zeros.
    Padding {
        /// Its number, if it were one.
        tet: u32,
    },
    /// A pin names a node that does not exist or not one above the pin's before it, or its velocity is
    /// not finite.
    Pin {
        /// The pin.
        pin: u32,
    },
    /// The factor is not one.
    Factor(FactorError),
    /// The factor is of another mesh.
    ForeignFactor,
    /// For writing: more than 4 GiB.
    TooLarge,
}

/// What is wrong with a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SectionFault {
    /// It does not begin at a multiple of 32 bytes.
    Misaligned,
    /// It ends behind the end of the bytes.
    OutOfRange,
    /// It does not follow the section before it.
    Misplaced,
    /// It is not as long as it must be.
    Length,
}

/// A number of [`Header`](crate::rest::Header).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum HeaderField {
    /// There are not as many tetrahedra.
    Tets,
    /// It is not that of the nodes and corners.
    Fingerprint,
    /// It is not a power of two.
    LengthUnit,
    /// It is not a power of two.
    MassUnit,
    /// It is not the sum of the masses.
    TotalMass,
    /// It is not that of the material.
    Damping,
}

impl fmt::Display for AssetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::BigEndianHost => {
                f.write_str("assets are little-endian, this machine is big-endian")
            }
            Self::Unaligned => f.write_str("the bytes do not begin at a multiple of 32"),
            Self::Magic => f.write_str("not a femto asset"),
            Self::Version { found } => {
                let known = super::VERSION;
                write!(f, "version {found} of the format; known is {known}")
            }
            Self::Truncated { needed, given } => {
                write!(f, "ends after {given} bytes of {needed}")
            }
            Self::Trailing { needed, given } => {
                write!(f, "has {given} bytes, more than its {needed}")
            }
            Self::Checksum { stored, computed } => write!(
                f,
                "was changed: its checksum is {computed:016x}, not {stored:016x}"
            ),
            Self::Code { field, found } => write!(f, "{field} {found} is not known"),
            Self::Section { section, fault } => write!(f, "section {} {fault}", section.name()),
            Self::Source => f.write_str("the source's name is not UTF-8"),
            Self::Material(e) => e.fmt(f),
            Self::Settings(e) => e.fmt(f),
            Self::Header(field) => field.fmt(f),
            Self::Node { node } => write!(f, "node {node} has a coordinate that is not finite"),
            Self::Mass { node } => write!(f, "the mass of node {node} is not positive and normal"),
            Self::Corner { tet, node } => {
                write!(f, "tetrahedron {tet} cannot have node {node} for a corner")
            }
            Self::Stiffness { tet } => {
                write!(
                    f,
                    "gradients or stiffness of tetrahedron {tet} out of range"
                )
            }
            Self::Padding { tet } => write!(f, "padding tetrahedron {tet} is not zero"),
            Self::Pin { pin } => write!(f, "pin {pin} has a wrong node or velocity"),
            Self::Factor(e) => e.fmt(f),
            Self::ForeignFactor => f.write_str("the factor is of another mesh"),
            Self::TooLarge => f.write_str("an asset cannot have 4 GiB"),
        }
    }
}

impl core::error::Error for AssetError {}

impl fmt::Display for SectionFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Misaligned => "does not begin at a multiple of 32",
            Self::OutOfRange => "ends behind the end of the bytes",
            Self::Misplaced => "does not follow the one before it",
            Self::Length => "is not as long as it must be",
        })
    }
}

impl fmt::Display for HeaderField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Tets => "the number of tetrahedra is not that of the blocks",
            Self::Fingerprint => "the fingerprint is not that of nodes and corners",
            Self::LengthUnit => "the length unit is not a power of two",
            Self::MassUnit => "the mass unit is not a power of two",
            Self::TotalMass => "the total mass is not the sum of the masses",
            Self::Damping => "the damping is not the material's",
        })
    }
}
