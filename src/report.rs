//! What a step says of itself.

#[cfg(feature = "fracture")]
use crate::fracture::FractureReport;

/// Why a step was refused. The state is as it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Refusal {
    /// This node would have got a position or velocity that is not finite.
    NonFinite {
        /// The first such node.
        node: u32,
    },
    /// Positions would have stayed finite, but the squares of the step's forces or residuals leave the
    /// range of f32, so that it could not be solved.
    OutOfRange,
    /// This pin names a node that the body does not have.
    Pin {
        /// Its place in [`Scene::pins`](crate::scene::Scene::pins).
        pin: u32,
    },
    /// [`Scene::forces`](crate::scene::Scene::forces) is neither empty nor as long as the body has nodes.
    Forces,
    /// State or workspace is not of the size of the rest data: not filled, or of another body.
    Storage,
    /// The start needs more history than the state keeps.
    History,
    /// The start needs more vectors than the workspace holds.
    Vectors,
    /// The factor was made for another mesh.
    Factor,
    /// The aggregates are those of a body with another number of nodes.
    Aggregates,
    /// The preconditioner needs more coarse workspace than there is.
    Coarse,
    /// The settings ask for plastic flow, and the state has no room for plastic strain.
    #[cfg(feature = "plasticity")]
    Plasticity,
    /// The settings ask for fracture, and the state has no room for what has broken.
    #[cfg(feature = "fracture")]
    Fracture,
    /// The couplings do not fit the body or the settings.
    #[cfg(feature = "contact")]
    Coupling(CouplingFault),
}

/// Why couplings are refused.
#[cfg(feature = "contact")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CouplingFault {
    /// They need θ = 1.
    Theta,
    /// More links than slots.
    Slots,
    /// The rigid bodies' nodes are not the last of the body, four each, in their order; or there are more than
    /// [`MAX_RIGIDS`](crate::detect::MAX_RIGIDS).
    Rigid,
    /// Pieces do not follow each other up to the first rigid body, there are more than
    /// [`MAX_PIECES`](crate::detect::MAX_PIECES), or one names a node that is not there or rigid.
    Piece,
    /// A link names a node that the body does not have.
    Link,
    /// A pin holds a node of a rigid body.
    Pinned,
}

#[cfg(feature = "contact")]
impl core::fmt::Display for CouplingFault {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Theta => "couplings need theta = 1",
            Self::Slots => "there are more links than slots for couplings",
            Self::Rigid => "the nodes of the rigid bodies are not the last of the mesh, in order",
            Self::Piece => "the pieces are not the soft nodes of the mesh, in order, or too many",
            Self::Link => "a link names a node that does not exist",
            Self::Pinned => "a pin holds a node of a rigid body",
        })
    }
}

impl core::fmt::Display for Refusal {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NonFinite { node } => write!(f, "node {node} would have become non-finite"),
            Self::OutOfRange => {
                f.write_str("forces or velocities are too large to be squared in f32")
            }
            Self::Pin { pin } => write!(f, "pin {pin} names a node that does not exist"),
            Self::Forces => f.write_str("the list of forces is not as long as the body has nodes"),
            Self::Storage => f.write_str("state or workspace is not of the size of the rest data"),
            Self::History => f.write_str("the start needs more history than the state keeps"),
            Self::Factor => f.write_str("the factor was made for another mesh"),
            Self::Aggregates => f.write_str("the aggregates are not one for each node"),
            Self::Coarse => {
                f.write_str("the preconditioner needs more coarse workspace than there is")
            }
            #[cfg(feature = "plasticity")]
            Self::Plasticity => f.write_str("the state has no room for plastic strain"),
            #[cfg(feature = "fracture")]
            Self::Fracture => f.write_str("the state has no room for what has broken"),
            #[cfg(feature = "contact")]
            Self::Coupling(fault) => fault.fmt(f),
            Self::Vectors => f.write_str("the start needs more vectors than the workspace holds"),
        }
    }
}

/// What a step says of itself. A step cannot fail: it advances the state, or reports why not.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use = "a refused step leaves the state as it was"]
pub struct StepReport {
    /// Why the step was refused, if it was.
    pub refusal: Option<Refusal>,
    /// ‖b‖ in N·s, filtered.
    pub rhs: f32,
    /// ‖b − Av‖ in N·s before the first iteration, filtered.
    pub residual_before: f32,
    /// ‖b − Av‖ in N·s after the last iteration, filtered, as the recurrence has it.
    pub residual_after: f32,
    /// Iterations that moved the solution (of the budget's, and one more where there are colliders); the rest came after
    /// the residual had sunk to rounding.
    pub updates: u32,
    /// Contacts between nodes and colliders, as they were when the solve began.
    pub contacts: u32,
    /// Energy that plastic flow took in this step, in joules; not negative.
    #[cfg(feature = "plasticity")]
    pub dissipated: f32,
    /// What broke, and what may still.
    #[cfg(feature = "fracture")]
    pub fracture: FractureReport,
    /// Contacts between pieces and rigid bodies that acted, or that the solve let go of ([`coupling`](crate::coupling)).
    #[cfg(feature = "contact")]
    pub couplings: u32,
    /// Contacts that were left out for want of slots; the deepest were kept.
    #[cfg(feature = "contact")]
    pub dropped: u32,
}

impl StepReport {
    /// Of a step that did nothing.
    pub(crate) const NOTHING: Self = Self {
        refusal: None,
        rhs: 0.0,
        residual_before: 0.0,
        residual_after: 0.0,
        updates: 0,
        contacts: 0,
        #[cfg(feature = "plasticity")]
        dissipated: 0.0,
        #[cfg(feature = "fracture")]
        fracture: FractureReport::NOTHING,
        #[cfg(feature = "contact")]
        couplings: 0,
        #[cfg(feature = "contact")]
        dropped: 0,
    };

    pub(crate) fn refused(refusal: Refusal) -> Self {
        Self {
            refusal: Some(refusal),
            ..Self::NOTHING
        }
    }

    /// ‖b − Av‖/‖b‖ after the last iteration; 0 where ‖b‖ = 0.
    #[must_use]
    pub fn relative_residual(&self) -> f32 {
        if self.rhs > 0.0 {
            self.residual_after / self.rhs
        } else {
            0.0
        }
    }

    /// Whether the state advanced.
    #[must_use]
    pub fn advanced(&self) -> bool {
        self.refusal.is_none()
    }
}
