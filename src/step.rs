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

use crate::body::{StateMut, WorkspaceMut};
use crate::cg::{self, System};
use crate::constraint::{ContactStep, Decisions, land, pin, touch};
use crate::coupling::hook::{Couple, CoupleStep, FreeStep};
use crate::element::{Layout, Sym3};
use crate::fan;
use crate::inelastic;
use crate::lane::Lanes;
use crate::math::{power_of_two_below, ratio_or_zero, select, sqrt};
use crate::operator::{Fit, Operator, fit_rotations};
use crate::preconditioner::{Preconditioner, Prepared, Room};
pub use crate::report::{Refusal, StepReport};
use crate::rest::{Points, Rest};
pub use crate::scene::Scene;
use crate::settings::{Settings, Start};
use crate::space::{Space, Translate, fill_space};
use crate::vector::{add_scaled, copy, dot, sym_mul};

/// The step's numbers, in units where one node's mass and one element a step are of order one.
pub(crate) struct Units {
    pub dt: f32,
    pub theta: f32,
    /// m₀, kg
    pub mass: f32,
    /// v₀, m/s
    pub velocity: f32,
    /// m₀v₀, N·s
    impulse: f32,
    /// c_M and c_K of A
    system: [f32; 2],
    /// c_M and c_K of the bracket, −(1−θ)hα and −[θ(1−θ)h² + (1−θ)hβ]
    bracket: [f32; 2],
}

impl Units {
    fn new<L: Layout>(rest: &Rest<'_, L>, settings: &Settings) -> Self {
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

/// The system as the solver sees it.
struct Filtered<'a, L: Layout, R, C> {
    operator: &'a Operator<'a, L>,
    couplings: &'a C,
    preconditioner: Prepared<'a>,
    /// Whether nodes may touch something.
    touches: bool,
    lanes: core::marker::PhantomData<R>,
}

impl<L: Layout, R: Lanes, C: Couple> System for Filtered<'_, L, R, C> {
    fn apply(&self, u: &[[f32; 3]], out: &mut [[f32; 3]]) {
        self.operator.apply::<R>(u, out);
        self.couplings.apply(u, out);
        self.couplings.project(out);
    }
    /// Impulses of contacts are of b's size, and a P whose normal is not along an axis lets a rounding of them
    /// through. Pins have an exact P.
    fn confine(&self, q: &mut [[f32; 3]]) {
        if self.touches {
            for (q, p) in q.iter_mut().zip(self.preconditioner.filter()) {
                *q = sym_mul(p, q);
            }
        }
    }
    #[inline(always)]
    fn precondition(&self, r: &[[f32; 3]], z: &mut [[f32; 3]]) {
        self.preconditioner.apply(r, z);
        self.couplings.project(z);
    }
    fn size(&self, r: &[[f32; 3]], rz: f32) -> f32 {
        if self.preconditioner.is_cheap() {
            rz
        } else {
            filtered_square(self.preconditioner.filter(), r)
        }
    }
}

impl<L: Layout, R: Lanes, C: Couple> Filtered<'_, L, R, C> {
    /// [`System::size`] of any residual; `z` is scratch.
    #[inline(always)]
    fn size_of(&self, r: &[[f32; 3]], z: &mut [[f32; 3]]) -> f32 {
        let rz = if self.preconditioner.is_cheap() {
            self.precondition(r, z);
            dot(r, z)
        } else {
            0.0
        };
        self.size(r, rz)
    }
}

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
        gravity: scene.gravity,
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
    };
    let contacts = touch(scene.colliders, &contact, &mut decisions);
    if C::SOME {
        let touched = contact.masses.len();
        let untouched = work.p.get_mut(touched..).unwrap_or_default();
        untouched.fill([0.0; 3]);
    }
    couplings.decide(&CoupleStep {
        scene,
        masses: rest.masses,
        x: state.x,
        v: state.v,
        dt: units.dt,
        length_unit: rest.header.length_unit,
        mass_unit: units.mass,
        velocity_unit: units.velocity,
        rhs: work.r,
        blocks: work.blocks,
        filter: work.filter,
        targets: work.v,
    });
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
    let system = Filtered::<L, R, C> {
        operator: &operator,
        couplings,
        preconditioner: settings.preconditioner.prepare::<R, L>(
            &operator,
            state.x,
            state.rotations,
            work.filter,
            Room {
                blocks: &mut *work.blocks,
                coarse: &mut *work.coarse,
            },
            work.q,
        ),
        touches: !scene.colliders.is_empty(),
        lanes: core::marker::PhantomData,
    };

    // The start v₀ in place of its constrained part c; then the bracket, with c in v(t).
    if units.theta < 1.0 {
        copy(work.q, work.v);
        add_free(state.v, work.filter, &units, work.q);
    }
    match settings.start {
        Start::Velocity => add_free(state.v, work.filter, &units, work.v),
        Start::VelocityForce => add_explicit(rest.points(), work.r, work.filter, &units, work.v),
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
    let rhs = filtered_norm(work.filter, work.r);
    let mut rhs_size = system.size_of(work.r, work.q);
    let guessed = matches!(settings.start, Start::Velocity | Start::VelocityForce);
    if guessed || scene.moves() {
        system.apply(work.v, work.q);
        add_scaled(work.r, -1.0, work.q);
        let moved = system.size_of(work.r, work.q);
        rhs_size = select(moved > rhs_size, moved, rhs_size);
    }

    // W, and the Galerkin solution over it.
    let translations = couplings.translations(&FreeStep {
        augmented: settings.start.is_augmented(),
        pinned: !scene.pins.is_empty(),
        touched: contacts > 0,
        masses: rest.masses,
        total_mass: rest.header.total_mass,
        mass_factor: mass,
    });
    let stored = settings.start.vectors() * nodes;
    fill_space(
        rest.points(),
        state,
        scene,
        settings.start,
        &units,
        work.filter,
        work.vectors,
    );
    if C::SOME {
        for w in work.vectors.chunks_exact_mut(nodes.max(1)) {
            couplings.project(w);
        }
    }
    let mut space = Space {
        vectors: work.vectors.get_mut(..stored).unwrap_or_default(),
        products: work.products.get_mut(..stored).unwrap_or_default(),
        nodes,
        translations,
    };
    space.orthonormalise(&system);
    space.project(work.v, work.r);
    if !scene.colliders.is_empty() {
        system.apply(work.p, work.q);
        space.close_gap(work.v, work.r, work.p, work.q);
        // From here on only P r counts.
        system.confine(work.r);
    }
    let residual_before = filtered_norm(work.filter, work.r);

    let updates = cg::solve(
        &system,
        &space,
        settings.budget.iterations,
        rhs_size,
        [&mut *work.v, &mut *work.r, &mut *work.p, &mut *work.q],
    );
    space.project(work.v, work.r);
    if settings.start == Start::Zero {
        search_along(
            &system,
            work.filter,
            [&mut *work.v, &mut *work.r, &mut *work.p, &mut *work.q],
        );
    }
    let residual_after = filtered_norm(work.filter, work.r);

    // v⁺ in m/s, x⁺ into p, checked before anything is kept.
    if let Some(translations) = space.translations {
        translations.restore(rest, state.v, scene, &units, work.v);
    }
    if let Some(node) = advance(rest, state, scene, &units, work, couplings) {
        return StepReport::refused(Refusal::NonFinite { node });
    }
    let [rhs, residual_before, residual_after] =
        [rhs, residual_before, residual_after].map(|norm| norm * units.impulse);
    if !(rhs.is_finite() & residual_before.is_finite() & residual_after.is_finite()) {
        return StepReport::refused(Refusal::OutOfRange);
    }
    commit(state, work);
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

fn check<L: Layout>(
    rest: &Rest<'_, L>,
    state: &StateMut<'_>,
    work: &WorkspaceMut<'_, L>,
    scene: &Scene<'_>,
    settings: &Settings,
) -> Result<(), Refusal> {
    let (nodes, blocks) = (rest.nodes.len(), rest.blocks.len());
    let node_lists = [
        rest.masses.len(),
        state.x.len(),
        state.v.len(),
        work.filter.len(),
        work.blocks.len(),
        work.inertia.len(),
    ];
    let vectors = [work.v.len(), work.r.len(), work.p.len(), work.q.len()];
    let block_lists = [
        rest.stiffness.len(),
        state.rotations.len(),
        work.rotated.len(),
        work.fans.len(),
    ];
    if nodes == 0
        || node_lists
            .iter()
            .chain(&vectors)
            .any(|&length| length != nodes)
        || block_lists.iter().any(|&length| length != blocks)
    {
        return Err(Refusal::Storage);
    }
    inelastic::check(blocks, state, settings)?;
    if state.history.len() < settings.start.history() * nodes {
        return Err(Refusal::History);
    }
    if work.vectors.len().min(work.products.len()) < settings.start.vectors() * nodes {
        return Err(Refusal::Vectors);
    }
    if let Preconditioner::Factored(factor) = settings.preconditioner
        && (factor.fingerprint() != rest.header.fingerprint || factor.nodes() != nodes)
    {
        return Err(Refusal::Factor);
    }
    if let Preconditioner::TwoLevel(aggregates) = settings.preconditioner
        && aggregates.of().len() != nodes
    {
        return Err(Refusal::Aggregates);
    }
    if work.coarse.len() < settings.preconditioner.coarse_length() {
        return Err(Refusal::Coarse);
    }
    if !(scene.forces.is_empty() || scene.forces.len() == nodes) {
        return Err(Refusal::Forces);
    }
    let lost = (0_u32..)
        .zip(scene.pins)
        .find(|(_, pin)| pin.node as usize >= nodes);
    lost.map_or(Ok(()), |(pin, _)| Err(Refusal::Pin { pin }))
}

/// `out` = M v + h f_external
fn external_impulses(
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
fn add_free(v: &[[f32; 3]], filter: &[Sym3<f32>], units: &Units, out: &mut [[f32; 3]]) {
    let per_unit = 1.0 / units.velocity;
    for ((out, v), p) in out.iter_mut().zip(v).zip(filter) {
        let free = sym_mul(p, v);
        *out = core::array::from_fn(|a| out[a] + free[a] * per_unit);
    }
}

/// `out` += P M⁻¹b, where M⁻¹b = v + hM⁻¹f
fn add_explicit(
    rest: Points<'_>,
    rhs: &[[f32; 3]],
    filter: &[Sym3<f32>],
    units: &Units,
    out: &mut [[f32; 3]],
) {
    for (((out, b), p), m) in out.iter_mut().zip(rhs).zip(filter).zip(rest.masses) {
        let free = sym_mul(p, b);
        *out = core::array::from_fn(|a| out[a] + free[a] * (units.mass / m));
    }
}

/// ‖P u‖
fn filtered_norm(filter: &[Sym3<f32>], u: &[[f32; 3]]) -> f32 {
    sqrt(filtered_square(filter, u))
}

/// ‖P u‖²
#[inline(never)]
fn filtered_square(filter: &[Sym3<f32>], u: &[[f32; 3]]) -> f32 {
    let mut sum = 0.0;
    for (p, u) in filter.iter().zip(u) {
        let u = sym_mul(p, u);
        sum += u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    }
    sum
}

/// Line search along the solution itself: P v ⟂ r, so that (8) of the front page holds from rest, too, where
/// conjugate gradients in f32 have lost their directions' conjugacy. (A start with W has v(t) to hold on to.)
fn search_along(system: &impl System, filter: &[Sym3<f32>], [v, r, p, q]: [&mut [[f32; 3]]; 4]) {
    for ((p, v), filter) in p.iter_mut().zip(&*v).zip(filter) {
        *p = sym_mul(filter, v);
    }
    system.apply(p, q);
    let (rp, pap) = (dot(r, p), dot(p, q));
    crate::vector::advance(v, r, ratio_or_zero(rp, pap, 0.0), p, q);
}

/// v⁺ in m/s into `work.v` and x⁺ into `work.p`. Returns the first node that is not finite.
fn advance<L: Layout, C: Couple>(
    rest: &Rest<'_, L>,
    state: &StateMut<'_>,
    scene: &Scene<'_>,
    units: &Units,
    work: &mut WorkspaceMut<'_, L>,
    couplings: &mut C,
) -> Option<u32> {
    let (h, theta) = (units.dt, units.theta);
    let old = state.x.iter().zip(&*state.v).zip(&*work.filter);
    let new = work.p.iter_mut().zip(&mut *work.v);
    let touched = couplings.touched(rest.masses).len();
    for (node, (((x, v), p), (x_new, v_new))) in old.zip(new).enumerate() {
        *v_new = v_new.map(|v| v * units.velocity);
        // The constrained part of v(t) is that of v⁺.
        let change = sym_mul(p, &core::array::from_fn(|a| v_new[a] - v[a]));
        *x_new = core::array::from_fn(|a| x[a] + h * (v_new[a] - (1.0 - theta) * change[a]));
        if !C::SOME || node < touched {
            land(scene.colliders, h, rest.header.length_unit, x, x_new, v_new);
        }
    }
    couplings.place(h, units.impulse, units.velocity, work.p, work.v);
    // Pins go where they are told, whatever is in the way.
    for pin in scene.pins {
        let node = pin.node as usize;
        if let (Some(x), Some(x_new), Some(v_new)) = (
            state.x.get(node),
            work.p.get_mut(node),
            work.v.get_mut(node),
        ) {
            *v_new = pin.velocity.to_array();
            *x_new = core::array::from_fn(|a| x[a] + h * v_new[a]);
        }
    }
    let mut first = None;
    for (node, (x, v)) in (0_u32..).zip(work.p.iter().zip(&*work.v)) {
        // 0 · c is 0 where c is finite, else NaN.
        let [x, v] = [x, v].map(|c| 0.0 * c[0] + 0.0 * c[1] + 0.0 * c[2]);
        let finite = x + v == 0.0;
        if !finite && first.is_none() {
            first = Some(node);
        }
    }
    first
}

/// Keeps what [`advance`] found.
fn commit<L: Layout>(state: &mut StateMut<'_>, work: &WorkspaceMut<'_, L>) {
    let nodes = state.v.len().max(1);
    let mut later = &mut *state.history;
    // From the oldest to the latest, each takes over its successor.
    while let Some(kept) = later.len().checked_sub(nodes) {
        let (newer, oldest) = later.split_at_mut(kept);
        let successor = newer.get(kept.saturating_sub(nodes)..).unwrap_or_default();
        copy(oldest, if kept < nodes { state.v } else { successor });
        later = newer;
    }
    copy(state.v, work.v);
    copy(state.x, work.p);
}
