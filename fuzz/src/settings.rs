//! Settings of a step, and what a body needs for them.

use femto::element::Layout;
use femto::preconditioner::aggregate::Aggregates;
use femto::rest::Rest;
use femto::settings::Needs;
use femto::{Budget, Fracture, Plasticity, Preconditioner, Settings, Start};

use super::bytes::Bytes;

pub fn settings(bytes: &mut Bytes<'_>) -> Option<Settings<'static>> {
    let dt = bytes.usual(&[0.01, 1e-6, 1.0]);
    let theta = bytes.usual(&[1.0, 0.5, 0.75]);
    let budget = Budget {
        iterations: bytes.below(21) as u32,
        polar_sweeps: bytes.below(5) as u32,
    };
    let preconditioners = [
        Preconditioner::Jacobi,
        Preconditioner::BlockJacobi,
        Preconditioner::Mass,
        Preconditioner::Identity,
    ];
    let settings = Settings::new(dt)
        .ok()?
        .with_theta(theta)
        .ok()?
        .with_budget(budget);
    let settings = settings.with_start(start(bytes));
    Some(settings.with_preconditioner(preconditioners[bytes.below(preconditioners.len())]))
}

pub fn start(bytes: &mut Bytes<'_>) -> Start {
    let vectors = bytes.below(5) as u8;
    match bytes.below(5) {
        0 => Start::Galerkin(vectors),
        1 => Start::Rigid(vectors),
        2 => Start::Velocity,
        3 => Start::VelocityForce,
        _ => Start::Zero,
    }
}

/// With plastic flow, fracture, both, or neither.
pub fn with_laws<'a>(settings: Settings<'a>, bytes: &mut Bytes<'_>) -> Option<Settings<'a>> {
    let mut settings = settings;
    let laws = bytes.below(4);
    if laws & 1 == 1 {
        let law = Plasticity::new(
            bytes.usual(&[0.0, 0.01, 0.1]).abs(),
            bytes.usual(&[1.0, 0.01, 1e3]).abs(),
        );
        let law = law.ok()?.with_relaxation(bytes.usual(&[0.0, 0.1]).abs());
        settings = settings.with_plasticity(law.ok()?);
    }
    if laws & 2 == 2 {
        let strength = bytes.usual(&[1e3, 1e-3, 1e6]).abs();
        let (per_step, reserve) = (bytes.below(18), bytes.below(16));
        let law = Fracture::new(strength, per_step as u32, reserve as u32);
        settings = settings.with_fracture(law.ok()?);
    }
    Some(settings)
}

/// Aggregates of the nodes for a two-level preconditioner, one time in four.
pub fn aggregates<L: Layout>(
    rest: &Rest<'_, L>,
    bytes: &mut Bytes<'_>,
) -> Option<(Vec<u8>, usize)> {
    if bytes.below(4) != 3 {
        return None;
    }
    let count = bytes.below(18);
    let mut of = vec![0; rest.nodes.len()];
    Aggregates::divide(rest, count, &mut of).ok()?;
    Some((of, count))
}

/// With them, if there are any.
pub fn with_aggregates<'a>(
    settings: Settings<'a>,
    aggregates: Option<&'a (Vec<u8>, usize)>,
) -> Settings<'a> {
    let Some((of, count)) = aggregates else {
        return settings;
    };
    let made = Aggregates::new(of, *count).expect("made by the library");
    settings.with_preconditioner(Preconditioner::TwoLevel(made))
}

/// Mostly what the settings need; now and then what others do.
pub fn room(settings: &Settings<'_>, bytes: &mut Bytes<'_>) -> Needs {
    let needs = Needs::from(settings);
    match bytes.below(16) {
        13 => Needs {
            plastic: !needs.plastic,
            ..needs
        },
        14 => Needs {
            broken: !needs.broken,
            ..needs
        },
        15 => start(bytes).into(),
        _ => needs,
    }
}
