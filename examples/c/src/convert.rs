//! From C's numbers to the crate's types.

use femto_core::collider::ColliderError;
use femto_core::glam::Vec3;
use femto_core::preconditioner::aggregate::MAX_AGGREGATES;
use femto_core::{Budget, Preconditioner};

use crate::FEMTO_MAX_AGGREGATES;
use crate::types::*;

pub fn start_of(start: FemtoStart) -> Result<femto_core::Start, FemtoStatus> {
    let velocities = u8::try_from(start.velocities).map_err(|_| FemtoStatus::Settings)?;
    match (start.kind, velocities) {
        (FEMTO_START_ZERO, 0) => Ok(femto_core::Start::Zero),
        (FEMTO_START_VELOCITY, 0) => Ok(femto_core::Start::Velocity),
        (FEMTO_START_VELOCITY_FORCE, 0) => Ok(femto_core::Start::VelocityForce),
        (FEMTO_START_GALERKIN, m) => Ok(femto_core::Start::Galerkin(m)),
        (FEMTO_START_RIGID, m) => Ok(femto_core::Start::Rigid(m)),
        _ => Err(FemtoStatus::Settings),
    }
}

pub fn start_code(start: femto_core::Start) -> FemtoStart {
    let (kind, velocities) = match start {
        femto_core::Start::Zero => (FEMTO_START_ZERO, 0),
        femto_core::Start::Velocity => (FEMTO_START_VELOCITY, 0),
        femto_core::Start::VelocityForce => (FEMTO_START_VELOCITY_FORCE, 0),
        femto_core::Start::Rigid(m) => (FEMTO_START_RIGID, m),
        femto_core::Start::Galerkin(m) => (FEMTO_START_GALERKIN, m),
        // An asset has none of those that there may be one day.
        _ => (FEMTO_START_GALERKIN, 1),
    };
    FemtoStart {
        kind,
        velocities: velocities.into(),
    }
}

/// The preconditioners that need no data.
pub fn local_of(code: u32) -> Result<Preconditioner<'static>, FemtoStatus> {
    match code {
        FEMTO_PRECONDITIONER_IDENTITY => Ok(Preconditioner::Identity),
        FEMTO_PRECONDITIONER_MASS => Ok(Preconditioner::Mass),
        FEMTO_PRECONDITIONER_JACOBI => Ok(Preconditioner::Jacobi),
        FEMTO_PRECONDITIONER_BLOCK_JACOBI => Ok(Preconditioner::BlockJacobi),
        _ => Err(FemtoStatus::Settings),
    }
}

/// All settings but the preconditioner.
pub fn settings_of<'a>(settings: &FemtoSettings) -> Result<femto_core::Settings<'a>, FemtoStatus> {
    let budget = Budget {
        iterations: settings.iterations,
        polar_sweeps: settings.polar_sweeps,
    };
    Ok(femto_core::Settings::new(settings.dt)
        .and_then(|s| s.with_theta(settings.theta))
        .map_err(|_| FemtoStatus::Settings)?
        .with_start(start_of(settings.start)?)
        .with_budget(budget))
}

pub fn collider_of(
    collider: &FemtoCollider,
) -> Result<femto_core::Collider<'static>, Option<ColliderError>> {
    let vector = Vec3::from_array(collider.vector);
    let shape = match collider.kind {
        FEMTO_COLLIDER_HALF_SPACE => femto_core::Collider::half_space(vector, collider.length),
        FEMTO_COLLIDER_SPHERE => femto_core::Collider::sphere(vector, collider.length),
        _ => return Err(None),
    };
    shape
        .and_then(|shape| shape.with_friction(collider.friction))
        .and_then(|shape| shape.with_velocity(Vec3::from_array(collider.velocity)))
        .map_err(Some)
}

// Arrays of the one are read as arrays of the other.
const _: () = {
    assert!(FEMTO_MAX_AGGREGATES == MAX_AGGREGATES);
    assert!(size_of::<FemtoPin>() == size_of::<femto_core::Pin>());
    assert!(align_of::<FemtoPin>() == align_of::<femto_core::Pin>());
};
