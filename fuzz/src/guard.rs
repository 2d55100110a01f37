//! What a step with the energy guard promises, where it does: a plane, and nobody inside it.

use femto::element::Layout;
use femto::energy::{Rotations, elastic, energies};
use femto::glam::Vec3;
use femto::rest::Rest;
use femto::state::StateRef;
use femto::{Scene, Settings, StepReport};

/// Roundings of sums over at most [`inputs::NODES`](super::inputs::NODES) nodes.
const ROUNDINGS: f64 = 256.0 * f32::EPSILON as f64;

/// Where the units' squares and products stay in f32's range, and the terms above do for rounding.
const MODERATE: f64 = 1e24;

/// E⁺ − E (kinetic, elastic and potential energy) with the rotations at the step's begin, is not above zero.
pub fn check_energy<L: Layout>(
    rest: &Rest<'_, L>,
    [before, after]: [&StateRef<'_>; 2],
    scene: &Scene<'_>,
    settings: &Settings<'_>,
    report: &StepReport,
) {
    // A dense stiffness may come from any numbers, positive or not.
    if size_of_val(rest.stiffness) > 0 {
        return;
    }
    // It leaves alone what touches nothing.
    if report.contacts == 0 {
        return;
    }
    let moves = scene.pins.iter().any(|pin| pin.velocity != Vec3::ZERO)
        || scene.colliders.iter().any(|collider| collider.moves());
    if settings.theta() < 1.0 || moves || !outside_a_plane(scene, before, after) {
        return;
    }
    let h = f64::from(settings.dt());
    // As the step has them: it flows and breaks at its end.
    let frozen = |x, v| {
        let mut state = *before;
        (state.x, state.v) = (x, v);
        state
    };
    let stretched = |x| elastic(rest, &frozen(x, before.v), Rotations::Stored);
    let moving = |v| energies(rest, &frozen(before.x, v), Vec3::ZERO).kinetic;
    let (kinetic, strain) = (
        [before.v, after.v].map(moving),
        [before.x, after.x].map(stretched),
    );
    let gravity = scene.gravity.to_array().map(f64::from);
    let (mut work, mut works) = (0.0, 0.0);
    for (node, (mass, (old, new))) in rest
        .masses
        .iter()
        .zip(before.x.iter().zip(after.x))
        .enumerate()
    {
        let force = scene.forces.get(node).copied().unwrap_or_default();
        for axis in 0..3 {
            let force = f64::from(force[axis]) + f64::from(*mass) * gravity[axis];
            let done = force * (f64::from(new[axis]) - f64::from(old[axis]));
            (work, works) = (work + done, works + done.abs());
        }
    }
    let rise = kinetic[1] - kinetic[0] + strain[1] - strain[0] - work;

    // What rounding in coordinates of this size, with either sign, does by stiffness: a quadratic form.
    let reach = |sign: f32| -> Vec<[f32; 3]> {
        let size = |node: usize, axis: usize| {
            let [x, v] = [[before.x, after.x], [before.v, after.v]]
                .map(|of| of[0][node][axis].abs() + of[1][node][axis].abs());
            let one = if (7 * node + axis) % 5 < 2 {
                -sign
            } else {
                sign
            };
            one * (x + settings.dt() * v)
        };
        (0..before.x.len())
            .map(|node| [0, 1, 2].map(|axis| size(node, axis)))
            .collect()
    };
    let (plus, minus, none) = (reach(1.0), reach(-1.0), vec![[0.0; 3]; before.x.len()]);
    let stiff = 0.5 * (stretched(&plus) + stretched(&minus)) - stretched(&none);
    let header = &rest.header;
    let stiff = stiff.abs() * (1.0 + f64::from(header.beta) / h).powi(2);
    let all = (kinetic[0] + kinetic[1]) * (1.0 + f64::from(header.alpha) * h)
        + strain[0].abs()
        + strain[1].abs()
        + works;
    let unit = f64::from(header.mass_unit) * (f64::from(header.length_unit) / h).powi(2);
    let moderate = stiff + all < MODERATE * unit;
    if !moderate {
        return;
    }
    let rounding = ROUNDINGS * (all + (stiff * all).sqrt() + ROUNDINGS * stiff) + unit / MODERATE;
    assert!(rise <= rounding, "{rise:e} J, rounding {rounding:e}");
}

/// Whether the nodes know of one collider that it is a plane, and were all outside.
fn outside_a_plane(scene: &Scene<'_>, before: &StateRef<'_>, after: &StateRef<'_>) -> bool {
    let [plane] = scene.colliders else {
        return false;
    };
    let (at_origin, normal) = plane.distance(Vec3::ZERO);
    let flat = |x: &[f32; 3]| {
        let x = Vec3::from_array(*x);
        plane.distance(x) == (normal.dot(x) + at_origin, normal)
    };
    let outside = |x: &[f32; 3]| plane.distance(Vec3::from_array(*x)).0 >= 0.0;
    before.x.iter().chain(after.x).all(flat) && before.x.iter().all(outside)
}
