//! The units of a step, and the sums over nodes that they turn into the solver's.

use crate::body::StateMut;
use crate::element::{Layout, Sym3};
use crate::math::power_of_two_below;
use crate::rest::{Points, Rest};
use crate::scene::Scene;
use crate::settings::Settings;
use crate::vector::project;

/// The step's numbers, in units where one node's mass and one element a step are of order one.
pub(crate) struct Units {
    pub dt: f32,
    pub theta: f32,
    /// m₀, kg
    pub mass: f32,
    /// v₀, m/s
    pub velocity: f32,
    /// m₀v₀, N·s
    pub impulse: f32,
    /// c_M and c_K of A
    pub system: [f32; 2],
    /// c_M and c_K of the bracket, −(1−θ)hα and −[θ(1−θ)h² + (1−θ)hβ]
    pub bracket: [f32; 2],
}

impl Units {
    pub(crate) fn new<L: Layout>(rest: &Rest<'_, L>, settings: &Settings) -> Self {
        let (h, theta, header) = (settings.dt(), settings.theta(), rest.header);
        let velocity = header.length_unit / power_of_two_below(h);
        let damped = theta * h;
        let undamped = (1.0 - theta) * h;
        let per_mass = |c: f32| c / header.mass_unit;
        let per_stiffness = |c: f32| c / header.mass_unit / header.length_unit / header.length_unit;
        Self {
            dt: h,
            theta,
            mass: header.mass_unit,
            velocity,
            impulse: header.mass_unit * velocity,
            system: [
                per_mass(1.0 + damped * header.alpha),
                per_stiffness(damped * damped + damped * header.beta),
            ],
            bracket: [
                per_mass(-(undamped * header.alpha)),
                per_stiffness(-(damped * undamped + undamped * header.beta)),
            ],
        }
    }
}

/// `out` = M v + h f_external
pub(super) fn external_impulses(
    rest: Points<'_>,
    state: &StateMut<'_>,
    scene: &Scene<'_>,
    units: &Units,
    out: &mut [[f32; 3]],
) {
    let fall = (scene.gravity * units.dt).to_array();
    let per_unit = 1.0 / units.velocity;
    for ((out, m), v) in out.iter_mut().zip(rest.masses).zip(&*state.v) {
        let m = m / units.mass;
        *out = core::array::from_fn(|a| m * ((v[a] + fall[a]) * per_unit));
    }
    let push = units.dt / units.impulse;
    for (out, f) in out.iter_mut().zip(scene.forces) {
        for axis in 0..3 {
            out[axis] += push * f[axis];
        }
    }
}

/// `out` += P v(t), over the velocity unit
#[inline(never)]
pub(crate) fn add_free(v: &[[f32; 3]], filter: &[Sym3<f32>], units: &Units, out: &mut [[f32; 3]]) {
    let per_unit = 1.0 / units.velocity;
    for ((out, v), p) in out.iter_mut().zip(v).zip(filter) {
        let free = project(p, v);
        *out = core::array::from_fn(|a| out[a] + free[a] * per_unit);
    }
}

/// `out` += P M⁻¹b, where M⁻¹b = v + hM⁻¹f
pub(super) fn add_explicit(
    rest: Points<'_>,
    rhs: &[[f32; 3]],
    filter: &[Sym3<f32>],
    units: &Units,
    out: &mut [[f32; 3]],
) {
    for (((out, b), p), m) in out.iter_mut().zip(rhs).zip(filter).zip(rest.masses) {
        let free = project(p, b);
        *out = core::array::from_fn(|a| out[a] + free[a] * (units.mass / m));
    }
}
