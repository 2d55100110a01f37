//! The rows of the tables, and how often a step pays each.

use super::load::{Kind, Load, SIZES};
use crate::cg;
use crate::settings::{Budget, Start};

/// The rows of a table that no preconditioner has for itself, and after them, for each of [`Kind::ALL`], its
/// preparation without and with colliders, and its iteration; then what the crate's features add, each beside the
/// rows before; and which of the sizes a row depends on.
pub const ROWS: [(&str, [bool; SIZES]); 104] = [
    ("any sweeps", BLOCKS),
    ("a sweep", BLOCKS),
    ("a stored vector", ALL),
    ("a pair of them", NODES),
    ("a vector and iteration", NODES),
    ("translations", NODES),
    ("translations, a vector", NODES),
    ("translations, an iteration", NODES),
    ("colliders, a vector", NODES),
    ("colliders, an iteration", NODES),
    ("colliders, an iteration with a factor", NODES),
    ("a collider", NODES),
    ("a pin", ONCE),
    ("pins or colliders that move", ALL),
    ("newmark", ALL),
    ("forces", NODES),
    ("start from velocity", ALL),
    ("start from velocity and force", ALL),
    ("a search along the solution", ALL),
    ("a past velocity", NODES),
    ("rotations", NODES),
    ("held by pins", NODES),
    ("coarse: an application more", NODES),
    ("coarse: an aggregate", ONCE),
    ("coarse: its square", ONCE),
    ("coarse: its cube", ONCE),
    ("coarse: a cut block", ONCE),
    ("coarse: a product", ONCE),
    ("coarse: a sum", ONCE),
    ("coarse: an aggregate, an application", ONCE),
    ("coarse: its square, an application", ONCE),
    ("identity: step", ALL),
    ("identity: step with colliders", ALL),
    ("identity: iteration", ALL),
    ("mass: step", ALL),
    ("mass: step with colliders", ALL),
    ("mass: iteration", ALL),
    ("jacobi: step", ALL),
    ("jacobi: step with colliders", ALL),
    ("jacobi: iteration", ALL),
    ("block-jacobi: step", ALL),
    ("block-jacobi: step with colliders", ALL),
    ("block-jacobi: iteration", ALL),
    ("warped: step", ALL),
    ("warped: step with colliders", ALL),
    ("warped: iteration", FACTOR),
    ("warped-half: step", ALL),
    ("warped-half: step with colliders", ALL),
    ("warped-half: iteration", FACTOR),
    ("laplacian: step", ALL),
    ("laplacian: step with colliders", ALL),
    ("laplacian: iteration", FACTOR),
    ("laplacian-half: step", ALL),
    ("laplacian-half: step with colliders", ALL),
    ("laplacian-half: iteration", FACTOR),
    ("two-level: step", ALL),
    ("two-level: step with colliders", ALL),
    ("two-level: iteration", ALL),
    ("a sphere", NODES),
    ("a capsule", NODES),
    ("a box", NODES),
    ("a height field", NODES),
    ("a frame", NODES),
    ("plastic flow", BLOCKS),
    ("fracture", BLOCKS),
    ("fracture: a place", BLOCKS),
    ("guarded", ALL),
    ("guarded: a vector", NODES),
    ("guarded: translations", NODES),
    ("guarded: a collider", NODES),
    ("guarded: a sphere", NODES),
    ("guarded: a capsule", NODES),
    ("guarded: a box", NODES),
    ("guarded: a height field", NODES),
    ("guarded: a frame", NODES),
    ("guarded: couplings", NODES),
    ("guarded: islands", NODES),
    ("couplings: step", ALL),
    ("couplings: diagonal where none was", ALL),
    ("couplings: diagonal for jacobi", ALL),
    ("couplings: beside colliders", ALL),
    ("couplings: a rigid body and collider", ONCE),
    ("couplings: an iteration", NODES),
    ("couplings: an iteration with a factor", NODES),
    ("couplings: an iteration with half a factor", FACTOR),
    ("couplings: a slot", ONCE),
    ("couplings: a slot beside rigid bodies", ONCE),
    ("couplings: a slot, an application", ONCE),
    ("couplings: a switch", NODES),
    ("couplings: a switch of a vector", NODES),
    ("couplings: a switch of a pair of vectors", NODES),
    ("couplings: a slot, a switch", ONCE),
    ("couplings: a slot, a switch of a vector", ONCE),
    ("couplings: a link", ONCE),
    ("couplings: a link beside rigid bodies", ONCE),
    ("couplings: a part", ONCE),
    ("couplings: a part and slot", ONCE),
    ("couplings: a rigid body", ONCE),
    ("couplings: a rigid body, a projection", ONCE),
    ("islands", NODES),
    ("islands, a vector", NODES),
    ("islands, an iteration", NODES),
    ("islands: a part", ONCE),
    ("islands: a part, an operation", ONCE),
];

const ONCE: [bool; SIZES] = [true, false, false, false, false, false];
const NODES: [bool; SIZES] = [true, true, true, false, false, false];
const BLOCKS: [bool; SIZES] = [true, false, false, true, true, false];
const ALL: [bool; SIZES] = [true, true, true, true, true, false];
const FACTOR: [bool; SIZES] = [true; SIZES];

/// The row where those of the preconditioners begin, and how many each has.
const OWN: (usize, usize) = (31, 3);
/// The row where those of features begin.
const MORE: usize = OWN.0 + OWN.1 * Kind::ALL.len();

/// How often a step pays each of [`ROWS`].
#[must_use]
pub fn terms(load: &Load, budget: Budget) -> [u64; ROWS.len()] {
    let (k, w) = (iterations(load, budget), load.start.vectors() as u64);
    let coupled = load.coupled.parts() > 0;
    let free = u64::from(load.start.is_augmented() && load.pins == 0 && !coupled);
    let touching = u64::from(load.colliders > 0);
    let is = |start| u64::from(load.start == start);
    let guessed = is(Start::Velocity) + is(Start::VelocityForce);
    // Of the right-hand side and in every iteration; and of the residual of a start that is not zero.
    let more = u64::from(guessed > 0 || load.moving) * u64::from(load.coarse.aggregates > 0);
    let (aggregates, applications) = (load.coarse.aggregates as u64, 1 + k + more);
    let square = aggregates.saturating_mul(aggregates);
    let common = [
        u64::from(budget.polar_sweeps > 0),
        u64::from(budget.polar_sweeps),
        w,
        w * w.saturating_sub(1) / 2,
        w * k,
        free,
        free * w,
        free * k,
        touching * w,
        touching * k,
        touching * k * u64::from(factored(load)),
        load.colliders as u64,
        load.pins as u64,
        u64::from(load.moving) * (1 - guessed),
        u64::from(load.newmark),
        u64::from(load.forces),
        is(Start::Velocity),
        is(Start::VelocityForce),
        searches(load),
        load.start.history() as u64,
        u64::from(matches!(load.start, Start::Rigid(_))),
        u64::from(load.pins > 0),
        more,
        aggregates,
        square,
        square.saturating_mul(aggregates),
        load.coarse.cut_blocks as u64,
        load.coarse.products as u64,
        load.coarse.sums as u64,
        aggregates.saturating_mul(applications),
        square.saturating_mul(applications),
    ];
    let own = [1 - touching, touching, k];
    let at = OWN.0 + OWN.1 * load.preconditioner as usize;
    let inelastic = inelastic(load);
    let guard = guard(load);
    let couplings = couplings(load, budget);
    core::array::from_fn(|row| {
        let of = |first: usize, rows: &[u64]| Some(*rows.get(row.checked_sub(first)?)?);
        of(0, &common)
            .or_else(|| of(at, &own))
            .or_else(|| of(MORE, &inelastic))
            .or_else(|| of(MORE + inelastic.len(), &guard))
            .or_else(|| of(MORE + inelastic.len() + guard.len(), &couplings))
            .unwrap_or(0)
    })
}

fn factored(load: &Load) -> bool {
    matches!(
        load.preconditioner,
        Kind::Warped | Kind::WarpedHalf | Kind::Laplacian | Kind::LaplacianHalf
    )
}

/// Those of the solver: one more where there are colliders.
fn iterations(load: &Load, budget: Budget) -> u64 {
    u64::from(budget.iterations) + u64::from(load.colliders > 0)
}

/// Of the line searches along the solution: one from rest, and with couplings where W has translations.
fn searches(load: &Load) -> u64 {
    let joined = load.coupled.parts() > 0;
    u64::from(load.start == Start::Zero || (joined && load.start.is_augmented()))
}

/// Shapes of colliders, plastic flow and fracture.
fn inelastic(load: &Load) -> [u64; 8] {
    let of = &load.shapes;
    let placed = [
        of.spheres,
        of.capsules,
        of.boxes,
        of.height_fields,
        of.placed,
    ];
    let [spheres, capsules, boxes, fields, frames] = placed.map(|count| count as u64);
    let (flows, tears) = (u64::from(load.flows), u64::from(load.tears));
    let breaks = u64::from(tears > 0);
    [
        spheres, capsules, boxes, fields, frames, flows, breaks, tears,
    ]
}

/// The guard over contact's energy.
fn guard(load: &Load) -> [u64; 11] {
    let acts = u64::from(load.guarded);
    let coupled = u64::from(load.coupled.parts() > 0);
    let free = u64::from(load.start.is_augmented() && load.pins == 0);
    let [spheres, capsules, boxes, fields, frames, ..] = inelastic(load);
    [
        1,
        load.start.vectors() as u64,
        free * (1 - coupled),
        load.colliders as u64,
        spheres,
        capsules,
        boxes,
        fields,
        frames,
        coupled,
        free * coupled,
    ]
    .map(|count| acts * count)
}

/// Bodies in one system.
fn couplings(load: &Load, budget: Budget) -> [u64; 27] {
    let coupled = u64::from(load.coupled.parts() > 0);
    let (k, w) = (iterations(load, budget), load.start.vectors() as u64);
    let (k, w) = (coupled * k, coupled * w);
    let [parts, rigids, links, slots] = load.coupled.counts();
    let without = u64::from(load.colliders == 0) * coupled;
    let diagonal = match load.preconditioner {
        Kind::Jacobi => [0, without],
        Kind::BlockJacobi | Kind::TwoLevel => [0, 0],
        _ => [without, 0],
    };
    let guessed = matches!(load.start, Start::Velocity | Start::VelocityForce);
    let more = u64::from(guessed || load.moving);
    let free = u64::from(load.start.is_augmented());
    let guarded = 2 * u64::from(load.guarded);
    let applications =
        coupled * (k + w + more + guarded + searches(load) + u64::from(load.colliders > 0));
    let factored = factored(load);
    let halved = matches!(load.preconditioner, Kind::WarpedHalf | Kind::LaplacianHalf);
    let sizes = u64::from(!factored) * (1 + more);
    let during = coupled * u64::from(cg::switches(budget.iterations, load.colliders > 0));
    // Twice behind the solve; the last time W stays as it is.
    let (settles, all) = (during + coupled, during + 2 * coupled);
    let with = settles * w;
    let projections = 2 + applications + k + w + sizes + all + with;
    let beside = u64::from(rigids > 0);
    [
        coupled,
        diagonal[0],
        diagonal[1],
        coupled - without,
        rigids.saturating_mul(load.colliders as u64),
        k,
        u64::from(factored) * k,
        u64::from(halved) * k,
        slots - links.min(slots),
        (slots - links.min(slots)) * beside,
        slots.saturating_mul(applications),
        free * settles,
        with,
        settles * (w * w.saturating_sub(1) / 2),
        slots.saturating_mul(all),
        slots.saturating_mul(with),
        links,
        links * beside,
        parts,
        parts.saturating_mul(slots),
        rigids,
        rigids.saturating_mul(projections),
        coupled * free,
        free * w,
        free * k,
        free * parts,
        free.saturating_mul(parts)
            .saturating_mul(2 * w + k + guarded + settles),
    ]
}

// Names, kinds and rows are in one order.
const _: () = assert!(MORE + 8 + 11 + 27 == ROWS.len());
