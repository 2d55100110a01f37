//! Preconditioners for a setup, factors included.

use femto::Factor;
use femto::element::Factored;
use femto::settings::{Preconditioner, Start};
use femto_bake::{FactorOptions, Kind, Precision};

use super::scenes::Setup;

/// The factor that suits the setup: its time step, its material, its pins. It lives on until the test ends.
pub fn factor(setup: &Setup, kind: Kind, precision: Precision) -> &'static Factor<'static> {
    let options = FactorOptions {
        kind,
        precision,
        held: setup.pins.iter().map(|pin| pin.0).collect(),
        ..FactorOptions::default()
    };
    factor_with(setup, &options)
}

pub fn factor_with(setup: &Setup, options: &FactorOptions) -> &'static Factor<'static> {
    let body = setup.body::<Factored>(Start::Zero);
    let owned = femto_bake::factor(&body.rest(), &setup.settings(), options).unwrap();
    Box::leak(Box::new(Box::leak(Box::new(owned)).view()))
}

/// A warped factor that knows nothing of the setup but its mesh: 20 times the time step, a fiftieth of the
/// stiffness, another Poisson's ratio, no pins.
pub fn wrong_factor(setup: &Setup) -> &'static Factor<'static> {
    let other = Setup {
        h: 20.0 * setup.h,
        young: 0.02 * setup.young,
        poisson: 0.1,
        pins: Vec::new(),
        ..setup.clone()
    };
    factor(&other, Kind::Warped, Precision::Single)
}

/// How many there are.
pub const COUNT: usize = 9;

/// One of every kind: local, factored in either precision, two-level, and with a wrong factor.
pub fn preconditioner(setup: &Setup, which: usize) -> Preconditioner<'static> {
    use Preconditioner as P;
    match which {
        0 => P::Identity,
        1 => P::Mass,
        2 => P::Jacobi,
        3 => P::BlockJacobi,
        4 => P::Factored(factor(setup, Kind::Warped, Precision::Single)),
        5 => P::Factored(factor(setup, Kind::Warped, Precision::Half)),
        6 => P::Factored(factor(setup, Kind::Laplacian, Precision::Half)),
        7 => setup.two_level(4),
        _ => P::Factored(wrong_factor(setup)),
    }
}

/// What a message calls it.
pub fn name(which: usize) -> &'static str {
    [
        "identity",
        "mass",
        "Jacobi",
        "block Jacobi",
        "warped",
        "warped f16",
        "Laplacian f16",
        "two-level",
        "wrong warped",
    ][which]
}
