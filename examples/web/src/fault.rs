//! Why a call was refused: a code and two numbers. The text, with `{0}` and `{1}` for the numbers, stays out of the
//! module: the build gathers the texts of `fault!` for JavaScript (`scripts/faults.mjs`), which has them and number
//! formatting for less. The crate's own `Display` would say the same, and bring 20 KB.

use femto::asset::{AssetError, HeaderField, SectionFault};
use femto::collider::ColliderError;
use femto::material::MaterialError;
use femto::preconditioner::factor::FactorError;
use femto::settings::SettingsError;
use femto::state::StateError;
use femto::{Refusal, mesh::MeshError};

/// A refusal.
#[derive(Clone, Copy, Debug)]
pub struct Fault {
    pub code: u32,
    /// JavaScript shows seven digits.
    pub numbers: [f32; 2],
}

impl Fault {
    /// None yet.
    pub const NONE: Self = Self {
        code: 0,
        numbers: [0.0; 2],
    };
}

/// The code of a text: FNV-1a (32 bit) of its bytes.
pub const fn code(text: &str) -> u32 {
    let (mut hash, mut left) = (0x811c_9dc5_u32, text.as_bytes());
    while let [byte, rest @ ..] = left {
        hash = (hash ^ *byte as u32).wrapping_mul(0x0100_0193);
        left = rest;
    }
    hash
}

/// `fault!("text")`, `fault!("text with {0}", x)` or `fault!("text with {0} and {1}", x, y)`.
macro_rules! fault {
    ($text:literal) => {
        $crate::fault::fault!($text, 0.0, 0.0)
    };
    ($text:literal, $x:expr) => {
        $crate::fault::fault!($text, $x, 0.0)
    };
    ($text:literal, $x:expr, $y:expr) => {{
        const CODE: u32 = $crate::fault::code($text);
        $crate::fault::Fault {
            code: CODE,
            numbers: [$x as f32, $y as f32],
        }
    }};
}
pub(crate) use fault;

impl From<MaterialError> for Fault {
    fn from(error: MaterialError) -> Self {
        use MaterialError::{Alpha, Beta, Density, Poisson, Young};
        match error {
            Young(x) => fault!("Young's modulus {0} must be positive and finite", x),
            Poisson(x) => fault!("Poisson's ratio {0} must be above -1 and below 0.5", x),
            Density(x) => fault!("density {0} must be positive and finite", x),
            Alpha(x) => fault!("damping alpha {0} must be finite and not negative", x),
            Beta(x) => fault!("damping beta {0} must be finite and not negative", x),
            _ => fault!("the material is out of range"),
        }
    }
}

impl From<SettingsError> for Fault {
    fn from(error: SettingsError) -> Self {
        match error {
            SettingsError::Dt(x) => fault!("time step {0} must be positive and finite", x),
            SettingsError::Theta(x) => fault!("theta {0} must be between 0.5 and 1", x),
            _ => fault!("the settings are out of range"),
        }
    }
}

impl From<ColliderError> for Fault {
    fn from(error: ColliderError) -> Self {
        match error {
            ColliderError::Normal => fault!("the collider's normal must be finite and not zero"),
            ColliderError::Place => fault!("the collider's offset or centre must be finite"),
            ColliderError::Radius => {
                fault!("the collider's radius must be positive, and its square finite")
            }
            ColliderError::Friction => {
                fault!("the coefficient of friction must be finite and not negative")
            }
            ColliderError::Velocity => fault!("the collider's velocity must be finite"),
            _ => fault!("the collider is out of range"),
        }
    }
}

impl From<MeshError> for Fault {
    fn from(error: MeshError) -> Self {
        use MeshError as E;
        match error {
            E::Empty => fault!("the mesh has no nodes or no tetrahedra"),
            E::NonFiniteNode { node } => {
                fault!("node {0} has a coordinate that is not finite", node)
            }
            E::NodeOutOfRange { tet, node } => fault!(
                "tetrahedron {0} names node {1}, which does not exist",
                tet,
                node
            ),
            E::RepeatedNode { tet, node } => {
                fault!("tetrahedron {0} names node {1} twice", tet, node)
            }
            E::BadVolume { tet } => fault!(
                "tetrahedron {0} has a volume that is not positive, or too small",
                tet
            ),
            E::UnreferencedNode { node } => fault!("node {0} belongs to no tetrahedron", node),
            E::OutOfScale { tet } => fault!(
                "the mass or stiffness of tetrahedron {0} is out of range",
                tet
            ),
            _ => fault!("the mesh does not fit"),
        }
    }
}

impl From<FactorError> for Fault {
    fn from(error: FactorError) -> Self {
        match error {
            FactorError::Node { place } => fault!("index {0} of the factor names no node", place),
            FactorError::Pivot { node } => {
                fault!("the pivot of node {0} is not positive definite", node)
            }
            FactorError::Entry { place } => {
                fault!("entry {0} of the factor is not a finite number", place)
            }
            _ => fault!("the parts of the factor do not fit together"),
        }
    }
}

impl From<AssetError> for Fault {
    fn from(error: AssetError) -> Self {
        use AssetError as E;
        match error {
            E::Magic => fault!("the bytes are not a femto asset"),
            E::Version { found } => fault!(
                "the asset is of version {0} of the format; known is {1}",
                found,
                femto::asset::VERSION
            ),
            E::Truncated { needed, given } => {
                fault!("the asset ends after {1} bytes of {0}", needed, given)
            }
            E::Trailing { needed, given } => {
                fault!("the asset has {1} bytes, more than its {0}", needed, given)
            }
            E::Checksum { .. } => fault!("the asset was changed: its checksum is another"),
            E::Code { found, .. } => fault!("the asset makes an unknown choice, {0}", found),
            E::Section { section, fault } => match fault {
                SectionFault::Misaligned => fault!(
                    "section {0} of the asset does not begin at a multiple of 32",
                    section as u32
                ),
                SectionFault::OutOfRange => fault!(
                    "section {0} of the asset ends behind the end of the bytes",
                    section as u32
                ),
                SectionFault::Misplaced => fault!(
                    "section {0} of the asset does not follow the one before it",
                    section as u32
                ),
                _ => fault!(
                    "section {0} of the asset is not as long as it must be",
                    section as u32
                ),
            },
            E::Source => fault!("the name of the asset's source is not UTF-8"),
            E::Material(error) => error.into(),
            E::Settings(error) => error.into(),
            E::Header(field) => match field {
                HeaderField::Tets => fault!("the number of tetrahedra is not that of the blocks"),
                HeaderField::Fingerprint => {
                    fault!("the fingerprint is not that of nodes and corners")
                }
                HeaderField::LengthUnit => fault!("the length unit is not a power of two"),
                HeaderField::MassUnit => fault!("the mass unit is not a power of two"),
                HeaderField::TotalMass => fault!("the total mass is not the sum of the masses"),
                HeaderField::Damping => fault!("the damping is not the material's"),
                _ => fault!("the asset's header is wrong"),
            },
            E::Node { node } => fault!("node {0} has a coordinate that is not finite", node),
            E::Mass { node } => fault!("the mass of node {0} is not positive and normal", node),
            E::Corner { tet, node } => fault!(
                "tetrahedron {0} cannot have node {1} for a corner",
                tet,
                node
            ),
            E::Stiffness { tet } => fault!(
                "gradients or stiffness of tetrahedron {0} are out of range",
                tet
            ),
            E::Padding { tet } => fault!("padding tetrahedron {0} is not zero", tet),
            E::Pin { pin } => fault!("pin {0} has a wrong node or velocity", pin),
            E::Factor(error) if cfg!(feature = "factors") => error.into(),
            E::ForeignFactor => fault!("the factor is of another mesh"),
            E::TooLarge => fault!("an asset cannot have 4 GiB"),
            _ => fault!("the asset cannot be read"),
        }
    }
}

impl From<StateError> for Fault {
    fn from(error: StateError) -> Self {
        match error {
            StateError::Length { given, nodes } => {
                fault!("{0} entries were given for {1} nodes", given, nodes)
            }
            StateError::NonFinite { node } => {
                fault!("the position or velocity of node {0} is not finite", node)
            }
            _ => fault!("the state does not fit"),
        }
    }
}

impl From<Refusal> for Fault {
    fn from(refusal: Refusal) -> Self {
        match refusal {
            Refusal::NonFinite { node } => fault!("node {0} would have become non-finite", node),
            Refusal::OutOfRange => {
                fault!("forces or velocities are too large to be squared in f32")
            }
            Refusal::Pin { pin } => fault!("pin {0} names a node that does not exist", pin),
            Refusal::Forces => fault!("the list of forces is not as long as the body has nodes"),
            Refusal::Storage => fault!("state or workspace is not of the size of the rest data"),
            Refusal::Factor => fault!("the factor was made for another mesh"),
            _ => fault!("the state keeps too little for these settings"),
        }
    }
}
