//! Why a call was refused: a text with places for numbers, `{0}` and `{1}`, which JavaScript fills in.
//!
//! The crate's own `Display` would say the same, and bring 20 KB of number formatting into the module, which
//! every JavaScript engine has already.

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
    pub text: &'static str,
    pub numbers: [f64; 2],
}

impl Fault {
    pub const fn new(text: &'static str) -> Self {
        Self::of(text, [0.0; 2])
    }

    pub const fn of(text: &'static str, numbers: [f64; 2]) -> Self {
        Self { text, numbers }
    }

    /// About one thing.
    fn at(text: &'static str, number: impl Into<f64>) -> Self {
        Self::of(text, [number.into(), 0.0])
    }

    /// About two.
    fn between(text: &'static str, numbers: [usize; 2]) -> Self {
        Self::of(text, numbers.map(|number| number as f64))
    }
}

impl From<&'static str> for Fault {
    fn from(text: &'static str) -> Self {
        Self::new(text)
    }
}

impl From<MaterialError> for Fault {
    fn from(error: MaterialError) -> Self {
        use MaterialError::{Alpha, Beta, Density, Poisson, Young};
        match error {
            Young(x) => Self::at("Young's modulus {0} must be positive and finite", x),
            Poisson(x) => Self::at("Poisson's ratio {0} must be above -1 and below 0.5", x),
            Density(x) => Self::at("density {0} must be positive and finite", x),
            Alpha(x) => Self::at("damping alpha {0} must be finite and not negative", x),
            Beta(x) => Self::at("damping beta {0} must be finite and not negative", x),
            _ => Self::new("the material is out of range"),
        }
    }
}

impl From<SettingsError> for Fault {
    fn from(error: SettingsError) -> Self {
        match error {
            SettingsError::Dt(x) => Self::at("time step {0} must be positive and finite", x),
            SettingsError::Theta(x) => Self::at("theta {0} must be between 0.5 and 1", x),
            _ => Self::new("the settings are out of range"),
        }
    }
}

impl From<ColliderError> for Fault {
    fn from(error: ColliderError) -> Self {
        Self::new(match error {
            ColliderError::Normal => "the collider's normal must be finite and not zero",
            ColliderError::Place => "the collider's offset or centre must be finite",
            ColliderError::Radius => {
                "the collider's radius must be positive, and its square finite"
            }
            ColliderError::Friction => {
                "the coefficient of friction must be finite and not negative"
            }
            ColliderError::Velocity => "the collider's velocity must be finite",
            _ => "the collider is out of range",
        })
    }
}

impl From<MeshError> for Fault {
    fn from(error: MeshError) -> Self {
        use MeshError as E;
        let of_tet = |text, tet: u32, node: u32| Self::of(text, [tet.into(), node.into()]);
        match error {
            E::Empty => Self::new("the mesh has no nodes or no tetrahedra"),
            E::NonFiniteNode { node } => {
                Self::at("node {0} has a coordinate that is not finite", node)
            }
            E::NodeOutOfRange { tet, node } => of_tet(
                "tetrahedron {0} names node {1}, which does not exist",
                tet,
                node,
            ),
            E::RepeatedNode { tet, node } => {
                of_tet("tetrahedron {0} names node {1} twice", tet, node)
            }
            E::BadVolume { tet } => Self::at(
                "tetrahedron {0} has a volume that is not positive, or too small",
                tet,
            ),
            E::UnreferencedNode { node } => Self::at("node {0} belongs to no tetrahedron", node),
            E::OutOfScale { tet } => Self::at(
                "the mass or stiffness of tetrahedron {0} is out of range",
                tet,
            ),
            _ => Self::new("the mesh does not fit"),
        }
    }
}

impl From<FactorError> for Fault {
    fn from(error: FactorError) -> Self {
        let of = |text, number| Self::between(text, [number, 0]);
        match error {
            FactorError::Node { place } => of("index {0} of the factor names no node", place),
            FactorError::Pivot { node } => {
                of("the pivot of node {0} is not positive definite", node)
            }
            FactorError::Entry { place } => {
                of("entry {0} of the factor is not a finite number", place)
            }
            _ => Self::new("the parts of the factor do not fit together"),
        }
    }
}

impl From<AssetError> for Fault {
    fn from(error: AssetError) -> Self {
        use AssetError as E;
        match error {
            E::Magic => Self::new("the bytes are not a femto asset"),
            E::Version { found } => Self::of(
                "the asset is of version {0} of the format; known is {1}",
                [found.into(), femto::asset::VERSION.into()],
            ),
            E::Truncated { needed, given } => {
                Self::between("the asset ends after {1} bytes of {0}", [needed, given])
            }
            E::Trailing { needed, given } => Self::between(
                "the asset has {1} bytes, more than its {0}",
                [needed, given],
            ),
            E::Checksum { .. } => Self::new("the asset was changed: its checksum is another"),
            E::Code { found, .. } => Self::at("the asset makes an unknown choice, {0}", found),
            E::Section { section, fault } => Self::at(
                match fault {
                    SectionFault::Misaligned => {
                        "section {0} of the asset does not begin at a multiple of 32"
                    }
                    SectionFault::OutOfRange => {
                        "section {0} of the asset ends behind the end of the bytes"
                    }
                    SectionFault::Misplaced => {
                        "section {0} of the asset does not follow the one before it"
                    }
                    _ => "section {0} of the asset is not as long as it must be",
                },
                section as u32,
            ),
            E::Source => Self::new("the name of the asset's source is not UTF-8"),
            E::Material(error) => error.into(),
            E::Settings(error) => error.into(),
            E::Header(field) => Self::new(match field {
                HeaderField::Tets => "the number of tetrahedra is not that of the blocks",
                HeaderField::Fingerprint => "the fingerprint is not that of nodes and corners",
                HeaderField::LengthUnit => "the length unit is not a power of two",
                HeaderField::MassUnit => "the mass unit is not a power of two",
                HeaderField::TotalMass => "the total mass is not the sum of the masses",
                HeaderField::Damping => "the damping is not the material's",
                _ => "the asset's header is wrong",
            }),
            E::Node { node } => Self::at("node {0} has a coordinate that is not finite", node),
            E::Mass { node } => Self::at("the mass of node {0} is not positive and normal", node),
            E::Corner { tet, node } => Self::of(
                "tetrahedron {0} cannot have node {1} for a corner",
                [tet.into(), node.into()],
            ),
            E::Stiffness { tet } => Self::at(
                "gradients or stiffness of tetrahedron {0} are out of range",
                tet,
            ),
            E::Padding { tet } => Self::at("padding tetrahedron {0} is not zero", tet),
            E::Pin { pin } => Self::at("pin {0} has a wrong node or velocity", pin),
            E::Factor(error) => error.into(),
            E::ForeignFactor => Self::new("the factor is of another mesh"),
            E::TooLarge => Self::new("an asset cannot have 4 GiB"),
            _ => Self::new("the asset cannot be read"),
        }
    }
}

impl From<StateError> for Fault {
    fn from(error: StateError) -> Self {
        match error {
            StateError::Length { given, nodes } => {
                Self::between("{0} entries were given for {1} nodes", [given, nodes])
            }
            StateError::NonFinite { node } => {
                Self::at("the position or velocity of node {0} is not finite", node)
            }
            _ => Self::new("the state does not fit"),
        }
    }
}

impl From<Refusal> for Fault {
    fn from(refusal: Refusal) -> Self {
        match refusal {
            Refusal::NonFinite { node } => Self::at("node {0} would have become non-finite", node),
            Refusal::OutOfRange => "forces or velocities are too large to be squared in f32".into(),
            Refusal::Pin { pin } => Self::at("pin {0} names a node that does not exist", pin),
            Refusal::Forces => "the list of forces is not as long as the body has nodes".into(),
            Refusal::Storage => "state or workspace is not of the size of the rest data".into(),
            Refusal::Factor => "the factor was made for another mesh".into(),
            _ => "the state keeps too little for these settings".into(),
        }
    }
}
