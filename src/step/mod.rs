//! One time step, as data flows:
//!
//! ```text
//! x, Q → G = Q g, f_el → b → filter → start, W → k × { precondition, apply, dots } → v⁺ → x⁺ → Q⁺
//! ```
//!
//! The θ family of linearly implicit steps, with A = M + θ²h²K + θhD and D = αM + βK:
//!
//! ```text
//! b  = M v + h (f_el(x) + f_ext) − [θ(1−θ)h²K + (1−θ)hD] v,      A v⁺ = b,
//! x⁺ = x + h (θ v⁺ + (1−θ) v)
//! ```
//!
//! θ = 1 is backward Euler, where the bracket is absent; θ = ½ the implicit Newmark (trapezoidal)
//! rule. Constrained parts of v are replaced by their targets in the bracket and in x⁺.
//!
//! The solver works on A/m₀ and on velocities over v₀, with m₀ and v₀ powers of two of the size of
//! the body's node masses and of one element's length per step. Scaling is exact, keeps squares in the range
//! of f32 for micrometres as for kilometres, and lets "nothing" mean the same in every unit.
//!
//! The rotations are fitted at the end of a step, so that a step which is refused leaves the state
//! untouched without a copy of it.

mod check;
mod guard;
mod keep;
mod system;
mod units;

use crate::body::{StateMut, WorkspaceMut};
use crate::cg::{self, System};
use crate::constraint::{self, ContactStep, Decisions, pin, touch};
use crate::coupling::hook::{Couple, CoupleStep, FreeStep};
use crate::element::Layout;
use crate::fan;
use crate::inelastic;
use crate::lane::Lanes;
use crate::math::select;
use crate::operator::{Fit, Operator, fit_rotations};
use crate::preconditioner::Room;
pub use crate::report::{Refusal, StepReport};
use crate::rest::Rest;
pub use crate::scene::Scene;
use crate::settings::{Settings, Start};
use crate::space::{Space, Translate, fill_space};
use crate::vector::{add_scaled, copy};
use check::check;
use guard::keep_energy;
use keep::commit;
use system::{Filtered, filtered_norm, search_along};
pub(crate) use units::Units;
pub(crate) use units::add_free;
use units::{add_explicit, external_impulses};

/// Advances a body by one step. Its cost depends on the mesh, the lengths of the scene's lists and
/// the settings; not on the state.
///
/// `R` is the lane type, [`Native`](crate::lane::Native) unless for testing; every choice gives the same bits.
pub fn step<R: Lanes, L: Layout>(
    rest: &Rest<'_, L>,
    state: &mut StateMut<'_>,
    work: &mut WorkspaceMut<'_, L>,
    scene: &Scene<'_>,
    settings: &Settings,
) -> StepReport {
    step_with::<R, L, ()>(rest, state, work, scene, settings, &mut ())
}

/// [`step`] with couplings between pieces of the body ([`coupling`](crate::coupling)).
#[cfg(feature = "contact")]
pub fn step_coupled<R: Lanes, L: Layout>(
    rest: &Rest<'_, L>,
    state: &mut StateMut<'_>,
    work: &mut WorkspaceMut<'_, L>,
    scene: &Scene<'_>,
    settings: &Settings,
    couplings: &mut crate::coupling::Couplings<'_>,
) -> StepReport {
    step_with::<R, L, _>(rest, state, work, scene, settings, couplings)
}

fn step_with<R: Lanes, L: Layout, C: Couple>(
    rest: &Rest<'_, L>,
    state: &mut StateMut<'_>,
    work: &mut WorkspaceMut<'_, L>,
    scene: &Scene<'_>,
    settings: &Settings,
    couplings: &mut C,
) -> StepReport {
    let fits = check(rest, state, work, scene, settings)
        .and_then(|()| couplings.check(rest.nodes.len(), scene, settings));
    if let Err(refusal) = fits {
        return StepReport::refused(refusal);
    }
    let fans = core::mem::take(&mut work.fans);
    fan::find(rest.blocks, fans);
    let rest = Rest { fans, ..*rest };
    let report = checked_step::<R, L, C>(&rest, state, work, scene, settings, couplings);
    work.fans = fans;
    report
}

fn checked_step<R: Lanes, L: Layout, C: Couple>(
    rest: &Rest<'_, L>,
    state: &mut StateMut<'_>,
    work: &mut WorkspaceMut<'_, L>,
    scene: &Scene<'_>,
    settings: &Settings,
    couplings: &mut C,
) -> StepReport {
    let units = Units::new(rest, settings);
    let nodes = rest.nodes.len();

    // b = M v + h f
    external_impulses(rest.points(), state, scene, &units, work.r);
    inelastic::rotate_state::<R, L>(rest, state, units.dt / units.impulse, work.rotated, work.r);

    let [mass, stiffness] = units.system;
    for (inertia, m) in work.inertia.iter_mut().zip(rest.masses) {
        *inertia = mass * m;
    }
    let operator = Operator {
        rest: *rest,
        rotated: &*work.rotated,
        inertia: &*work.inertia,
        stiffness,
    };
    if settings.preconditioner.needs_blocks() || !scene.colliders.is_empty() || C::SOME {
        operator.diagonal::<R>(work.blocks);
    } else if settings.preconditioner.needs_diagonal() {
        operator.diagonal_entries::<R>(work.q);
        for (block, &[x, y, z]) in work.blocks.iter_mut().zip(&*work.q) {
            *block = [x, 0.0, 0.0, y, 0.0, z];
        }
    }

    // Who is held, who touches, who slides; targets c in m/s.
    pin(scene.pins, work.filter, work.v);
    couplings.locate(state.x);
    couplings.project(work.r);
    let contact = ContactStep {
        masses: couplings.touched(rest.masses),
        x: state.x,
        v: state.v,
        dt: units.dt,
        length_unit: rest.header.length_unit,
        mass_unit: units.mass,
        velocity_unit: units.velocity,
    };
    let mut decisions = Decisions {
        rhs: &mut *work.r,
        diagonal: &mut *work.blocks,
        inertia: &mut *work.inertia,
        filter: &mut *work.filter,
        targets: &mut *work.v,
        gaps: &mut *work.p,
        normals: &mut *work.normals,
    };
    let contacts = touch(scene.colliders, &contact, &mut decisions);
    // Rigid bodies do not touch colliders by their nodes.
    let touched = contact.masses.len();
    if C::SOME {
        let untouched = work.p.get_mut(touched..).unwrap_or_default();
        untouched.fill([0.0; 3]);
        let operator = Operator {
            rest: *rest,
            rotated: &*work.rotated,
            inertia: &*work.inertia,
            stiffness,
        };
        operator.apply::<R>(state.v, work.q);
    }
    let couple = CoupleStep {
        scene,
        masses: rest.masses,
        x: state.x,
        v: state.v,
        dt: units.dt,
        length_unit: rest.header.length_unit,
        mass_unit: units.mass,
        velocity_unit: units.velocity,
        #[cfg(feature = "fracture")]
        broken: state.broken,
        rhs: work.r,
        blocks: work.blocks,
        filter: work.filter,
        targets: work.v,
    };
    couplings.decide(&couple, work.q);
    couplings.add_to(work.blocks, work.r);
    couplings.project(work.r);
    // From here on in units of the velocity unit, also the gaps that wait in p.
    for c in [&mut *work.v, &mut *work.p] {
        c.as_flattened_mut()
            .iter_mut()
            .for_each(|c| *c /= units.velocity);
    }
    let operator = Operator {
        rest: *rest,
        rotated: &*work.rotated,
        inertia: &*work.inertia,
        stiffness,
    };
    let touches = !scene.colliders.is_empty();
    let mut system = Filtered::<L, R, C> {
        operator: &operator,
        couplings,
        preconditioner: settings.preconditioner.prepare::<R, L>(
            &operator,
            state.x,
            state.rotations,
            (&*work.filter, touches),
            Room {
                blocks: &mut *work.blocks,
                coarse: &mut *work.coarse,
            },
            work.q,
        ),
        filter: &mut *work.filter,
        colliders: scene.colliders,
        contact: &contact,
        normals: if touches {
            work.normals.get_mut(..touched).unwrap_or_default()
        } else {
            &mut []
        },
        lanes: core::marker::PhantomData,
    };

    // The start v₀ in place of its constrained part c; then the bracket, with c in v(t).
    if units.theta < 1.0 {
        copy(work.q, work.v);
        add_free(state.v, system.filter, &units, work.q);
    }
    match settings.start {
        Start::Velocity => add_free(state.v, system.filter, &units, work.v),
        Start::VelocityForce => add_explicit(rest.points(), work.r, system.filter, &units, work.v),
        Start::Zero | Start::Galerkin(_) | Start::Rigid(_) => {}
    }
    if units.theta < 1.0 {
        let [mass, stiffness] = units.bracket;
        for ((r, v), m) in work.r.iter_mut().zip(&*work.q).zip(rest.masses) {
            *r = core::array::from_fn(|a| r[a] + mass * m * v[a]);
        }
        Operator {
            stiffness,
            ..operator
        }
        .add_stiffness::<R>(work.q, work.r);
    }
    let rhs = filtered_norm(system.filter, work.r);
    let guessed = matches!(settings.start, Start::Velocity | Start::VelocityForce);
    // Of b, and of what the start leaves of it.
    let mut rhs_size = 0.0;
    for start in 0..1 + u32::from(guessed || scene.moves()) {
        if start > 0 {
            system.apply(work.v, work.q);
            add_scaled(work.r, -1.0, work.q);
        }
        let size = system.size_of(work.r, work.q);
        rhs_size = select(size > rhs_size, size, rhs_size);
    }

    // W, and the Galerkin solution over it.
    let free = FreeStep {
        augmented: settings.start.is_augmented(),
        pinned: !scene.pins.is_empty(),
        touched: contacts > 0,
        masses: rest.masses,
        total_mass: rest.header.total_mass,
        mass_factor: mass,
    };
    let translations = system.couplings.translations(&free, system.filter);
    let stored = settings.start.vectors() * nodes;
    fill_space(
        rest.points(),
        state,
        scene,
        settings.start,
        &units,
        system.filter,
        work.vectors,
    );
    if C::SOME {
        for w in work.vectors.chunks_exact_mut(nodes.max(1)) {
            system.couplings.project(w);
        }
    }
    let mut space = Space {
        vectors: work.vectors.get_mut(..stored).unwrap_or_default(),
        products: work.products.get_mut(..stored).unwrap_or_default(),
        nodes,
        translations,
    };
    space.orthonormalise(&system);
    space.project(&system, work.v, work.r);
    if touches {
        space.close_gap(&system, work.v, work.r, work.p, work.q);
    }
    let residual_before = filtered_norm(system.filter, work.r);

    let updates = cg::solve(
        &mut system,
        &mut space,
        settings.budget.iterations,
        rhs_size,
        [&mut *work.v, &mut *work.r, &mut *work.p, &mut *work.q],
    );
    // What would pull now is let go: from here on it counts as residual.
    system.release(work.r, true);
    space.project(&system, work.v, work.r);
    if C::SOME {
        system.switch(work.v, work.r, &mut space);
    }
    if settings.start == Start::Zero || (C::SOME && settings.start.is_augmented()) {
        search_along(
            &system,
            &space,
            [&mut *work.v, &mut *work.r, &mut *work.p, &mut *work.q],
        );
    }
    if settings.guards(scene) {
        keep_energy(
            &mut system,
            &mut space,
            &units,
            state.v,
            [&mut *work.v, &mut *work.r, &mut *work.p, &mut *work.q],
        );
    }
    if C::SOME {
        // As for colliders. It only takes energy: what pulls also separates.
        (system.couplings).switch(work.v, work.r, [&mut [], &mut []], false);
    }

    // v⁺ in m/s, x⁺ into p, checked before anything is kept.
    if let Some(translations) = space.translations {
        translations.restore(rest, state.v, scene, &units, work.v);
    }
    let lost = keep::advance(
        rest.points(),
        state,
        scene,
        &units,
        work.filter,
        couplings,
        [&mut *work.p, &mut *work.v],
    );
    if let Some(node) = lost {
        return StepReport::refused(Refusal::NonFinite { node });
    }
    // What the last corrections have made pull is no contact either: reactions push.
    let held = if touches {
        work.normals.get_mut(..touched).unwrap_or_default()
    } else {
        &mut []
    };
    constraint::release(true, work.r, work.filter, held);
    let residual_after = filtered_norm(work.filter, work.r);
    let [rhs, residual_before, residual_after] =
        [rhs, residual_before, residual_after].map(|norm| norm * units.impulse);
    if !(rhs.is_finite() & residual_before.is_finite() & residual_after.is_finite()) {
        return StepReport::refused(Refusal::OutOfRange);
    }
    commit(state, [work.p, work.v]);
    fit_rotations::<R::Wide, L>(
        rest,
        state.x,
        Fit::Warm(settings.budget.polar_sweeps),
        state.rotations,
    );
    let report = StepReport {
        rhs,
        residual_before,
        residual_after,
        updates,
        contacts,
        #[cfg(feature = "contact")]
        couplings: couplings.counts().active,
        #[cfg(feature = "contact")]
        dropped: couplings.counts().dropped,
        ..StepReport::NOTHING
    };
    inelastic::update::<R, L>(rest, state, settings, report)
}
