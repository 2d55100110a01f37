//! femto for C: see `femto.h`, which cbindgen writes from here.
//!
//! All `extern "C"` and its `unsafe` is in this package. Pieces of memory are the caller's; see [`memory`].
#![no_std]
#![allow(
    clippy::missing_safety_doc,
    reason = "the header says it once for all calls"
)]

// Its panic handler; nothing else. Nothing here panics.
#[cfg(not(target_os = "none"))]
extern crate std;

use core::ffi::c_void;
use core::mem::size_of;

use femto_core::body::{StateMut, StateRef, WorkspaceMut, workspace_numbers};
use femto_core::collider::ColliderError;
use femto_core::element::{Factored, RotatedGradients};
use femto_core::energy::StateHash;
use femto_core::glam::Vec3;
use femto_core::lane::{Native, blocks};
use femto_core::operator::{Fit, RotationBlock, fit_rotations};
use femto_core::report::Refusal;
use femto_core::rest::{Header, Rest, RestMut, TetBlock};
use femto_core::state::StateError;
use femto_core::step::step;
use femto_core::vector::copy;
use femto_core::{Budget, Mesh, Preconditioner};

use memory::{Head, Piece, REST, STATE, array, bytes, one, put, units};
pub use types::*;

mod memory;
mod types;

/// Linked into firmware alone, and only if something can panic: nothing does.
#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// Colliders of a step, at most.
pub const FEMTO_MAX_COLLIDERS: usize = 8;

/// Bytes of the rest data of a mesh; 0 if there is no such mesh.
#[unsafe(no_mangle)]
pub extern "C" fn femto_rest_bytes(nodes: usize, tets: usize) -> usize {
    rest_arrays(nodes, tets).unwrap_or(0)
}

/// Bytes of a body's state for a start; 0 if there is no such mesh or start.
#[unsafe(no_mangle)]
pub extern "C" fn femto_state_bytes(nodes: usize, tets: usize, start: FemtoStart) -> usize {
    start_of(start)
        .ok()
        .and_then(|start| state_arrays(nodes, tets, start.history()))
        .unwrap_or(0)
}

/// Bytes of the workspace of a step; 0 if there is no such mesh or start.
#[unsafe(no_mangle)]
pub extern "C" fn femto_workspace_bytes(nodes: usize, tets: usize, start: FemtoStart) -> usize {
    start_of(start)
        .ok()
        .and_then(|start| workspace_arrays(nodes, tets, start.vectors()))
        .unwrap_or(0)
}

/// Makes the rest data of a mesh: nodes in metres, four node numbers a tetrahedron, positively oriented.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn femto_rest_init(
    rest: *mut c_void,
    rest_bytes: usize,
    nodes: *const [f32; 3],
    node_count: usize,
    tets: *const [u32; 4],
    tet_count: usize,
    material: *const FemtoMaterial,
) -> FemtoStatus {
    // SAFETY: the caller's word; checked as far as can be.
    status(|| unsafe {
        let piece = Piece::new(rest, rest_bytes)?.limited(rest_arrays(node_count, tet_count))?;
        let (nodes, tets) = (
            array(nodes, node_count, &[piece])?,
            array(tets, tet_count, &[piece])?,
        );
        let material = one(material)?;
        let material =
            femto_core::Material::new(material.young, material.poisson, material.density)
                .and_then(|m| m.with_damping(material.alpha, material.beta))
                .map_err(|_| FemtoStatus::Material)?;
        let mesh = Mesh::new(nodes, tets).map_err(|_| FemtoStatus::Mesh)?;
        let mut header = Header::EMPTY;
        let mut cutter = piece.cutter();
        RestMut::<Factored> {
            nodes: cutter.take(node_count)?,
            masses: cutter.take(node_count)?,
            blocks: cutter.take(blocks(tet_count))?,
            stiffness: units(blocks(tet_count)),
            header: &mut header,
        }
        .fill(&mesh, &material)
        .map_err(|_| FemtoStatus::Mesh)?;
        piece.write_head(head(REST, node_count, tet_count, 0, header));
        Ok(())
    })
}

/// Puts a body at rest in the rest shape, with the history that the start needs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn femto_state_init(
    state: *mut c_void,
    state_bytes: usize,
    rest: *const c_void,
    rest_bytes: usize,
    start: FemtoStart,
) -> FemtoStatus {
    // SAFETY: as above.
    status(|| unsafe {
        let (piece, rest) = (
            Piece::new(state, state_bytes)?,
            Piece::new(rest, rest_bytes)?,
        );
        Piece::apart(&[piece, rest])?;
        let (head_of_rest, rest) = rest_of(rest)?;
        let (nodes, tets) = (rest.nodes.len(), head_of_rest.tets as usize);
        let history = start_of(start)?.history();
        let piece = piece.limited(state_arrays(nodes, tets, history))?;
        let state = cut_state(piece, nodes, tets, history)?;
        copy(state.x, rest.nodes);
        state.v.fill([0.0; 3]);
        state.history.fill([0.0; 3]);
        fit_rotations::<Native, Factored>(&rest, state.x, Fit::Cold, state.rotations);
        piece.write_head(head(STATE, nodes, tets, history, rest.header));
        Ok(())
    })
}

/// Places a body: positions (m) and velocities (m/s), `count` each, as many as it has nodes. Forgets its history.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn femto_place(
    state: *mut c_void,
    state_bytes: usize,
    rest: *const c_void,
    rest_bytes: usize,
    x: *const [f32; 3],
    v: *const [f32; 3],
    count: usize,
) -> FemtoStatus {
    // SAFETY: as above.
    status(|| unsafe {
        let (piece, rest) = (
            Piece::new(state, state_bytes)?,
            Piece::new(rest, rest_bytes)?,
        );
        Piece::apart(&[piece, rest])?;
        let (head, rest) = rest_of(rest)?;
        let mut state = state_of(piece, &head)?;
        let (x, v) = (array(x, count, &[piece])?, array(v, count, &[piece])?);
        state.place(&rest, x, v).map_err(|error| match error {
            StateError::NonFinite { .. } => FemtoStatus::NonFinite,
            _ => FemtoStatus::TooSmall,
        })
    })
}

/// Advances a body by one step. `report` may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn femto_step(
    state: *mut c_void,
    state_bytes: usize,
    rest: *const c_void,
    rest_bytes: usize,
    workspace: *mut c_void,
    workspace_bytes: usize,
    settings: *const FemtoSettings,
    scene: *const FemtoScene,
    report: *mut FemtoReport,
) -> FemtoStatus {
    // SAFETY: as above.
    status(|| unsafe {
        let piece = Piece::new(state, state_bytes)?;
        let rest = Piece::new(rest, rest_bytes)?;
        let workspace = Piece::new(workspace, workspace_bytes)?;
        Piece::apart(&[piece, rest, workspace])?;
        let (head, rest) = rest_of(rest)?;
        let mut state = state_of(piece, &head)?;
        let settings = settings_of(one(settings)?)?;

        let (nodes, tets, vectors) = (
            rest.nodes.len(),
            head.tets as usize,
            settings.start.vectors(),
        );
        let workspace = workspace.limited(workspace_arrays(nodes, tets, vectors))?;
        let mut cutter = workspace.cutter();
        let rotated = cutter.take::<RotatedGradients>(blocks(tets))?;
        let numbers = cutter.take::<f32>(workspace_numbers(nodes, vectors))?;
        let mut work = WorkspaceMut::<Factored>::over(&rest, vectors, rotated, numbers);

        let used = [piece, workspace];
        let scene = one(scene)?;
        let mut colliders = heapless::Vec::<_, FEMTO_MAX_COLLIDERS>::new();
        for collider in array(scene.colliders, scene.collider_count, &used)? {
            let collider = collider_of(collider).map_err(|_| FemtoStatus::Scene)?;
            colliders.push(collider).map_err(|_| FemtoStatus::Scene)?;
        }
        let scene = femto_core::Scene {
            gravity: Vec3::from_array(scene.gravity),
            forces: array(scene.forces, scene.force_count, &used)?,
            pins: array(scene.pins.cast(), scene.pin_count, &used)?,
            colliders: &colliders,
        };
        if !report.is_null() {
            // Its place, before anything changes.
            array(report.cast::<f32>(), size_of::<FemtoReport>() / 4, &used)?;
        }
        let said = step::<Native, Factored>(&rest, &mut state, &mut work, &scene, &settings);
        if !report.is_null() {
            put(
                report,
                FemtoReport {
                    rhs: said.rhs,
                    residual_before: said.residual_before,
                    residual_after: said.residual_after,
                    updates: said.updates,
                    contacts: said.contacts,
                },
            )?;
        }
        match said.refusal {
            None => Ok(()),
            Some(Refusal::Pin { .. } | Refusal::Forces) => Err(FemtoStatus::Scene),
            Some(Refusal::History) => Err(FemtoStatus::Settings),
            Some(_) => Err(FemtoStatus::Refused),
        }
    })
}

/// Where the positions (m) and velocities (m/s) of a body are, `*count` of each, within its state. Any of the three
/// may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn femto_read(
    state: *const c_void,
    state_bytes: usize,
    x: *mut *const [f32; 3],
    v: *mut *const [f32; 3],
    count: *mut usize,
) -> FemtoStatus {
    // SAFETY: as above.
    status(|| unsafe {
        let view = read_state(Piece::new(state, state_bytes)?)?;
        for (at, array) in [(x, view.x), (v, view.v)] {
            if !at.is_null() {
                put(at, array.as_ptr())?;
            }
        }
        if count.is_null() {
            Ok(())
        } else {
            put(count, view.x.len())
        }
    })
}

/// The hash of a body's positions and velocities: the same on every target for the same state.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn femto_hash(
    state: *const c_void,
    state_bytes: usize,
    hash: *mut u64,
) -> FemtoStatus {
    // SAFETY: as above.
    status(|| unsafe {
        let view = read_state(Piece::new(state, state_bytes)?)?;
        put(hash, StateHash::new().with(view.x, view.v).value())
    })
}

fn status(call: impl FnOnce() -> Result<(), FemtoStatus>) -> FemtoStatus {
    call().map_or_else(|status| status, |()| FemtoStatus::Ok)
}

fn head(magic: u32, nodes: usize, tets: usize, history: usize, header: Header) -> Head {
    // Counts that do not fit become 0, which no piece has.
    let number = |count: usize| u32::try_from(count).unwrap_or(0);
    Head {
        magic,
        nodes: number(nodes),
        tets: number(tets),
        history: number(history),
        header,
    }
}

fn rest_arrays(nodes: usize, tets: usize) -> Option<usize> {
    numbered(nodes, tets)?;
    bytes(&[
        (size_of::<[f32; 3]>(), Some(nodes)),
        (size_of::<f32>(), Some(nodes)),
        (size_of::<TetBlock>(), Some(blocks(tets))),
    ])
}

fn state_arrays(nodes: usize, tets: usize, history: usize) -> Option<usize> {
    numbered(nodes, tets)?;
    bytes(&[
        (size_of::<[f32; 3]>(), Some(nodes)),
        (size_of::<[f32; 3]>(), Some(nodes)),
        (size_of::<[f32; 3]>(), nodes.checked_mul(history)),
        (size_of::<RotationBlock>(), Some(blocks(tets))),
    ])
}

fn workspace_arrays(nodes: usize, tets: usize, vectors: usize) -> Option<usize> {
    numbered(nodes, tets)?;
    // More than `workspace_numbers` asks of any mesh and start.
    nodes.checked_mul(25 + 6 * vectors)?;
    bytes(&[
        (size_of::<RotatedGradients>(), Some(blocks(tets))),
        (size_of::<f32>(), Some(workspace_numbers(nodes, vectors))),
    ])
}

/// Nodes and tetrahedra are counted in u32, and there are some.
fn numbered(nodes: usize, tets: usize) -> Option<()> {
    let some = |count: usize| u32::try_from(count).is_ok_and(|count| count > 0);
    (some(nodes) && some(tets)).then_some(())
}

/// # Safety
/// As [`Piece::head`].
unsafe fn rest_of<'a>(piece: Piece) -> Result<(Head, Rest<'a, Factored>), FemtoStatus> {
    // SAFETY: the caller's.
    unsafe {
        let head = piece.expect(REST)?;
        let (nodes, tets) = (head.nodes as usize, head.tets as usize);
        let piece = piece.limited(rest_arrays(nodes, tets))?;
        let mut cutter = piece.cutter();
        let rest = Rest {
            nodes: cutter.take(nodes)?,
            masses: cutter.take(nodes)?,
            blocks: cutter.take(blocks(tets))?,
            stiffness: units(blocks(tets)),
            header: head.header,
        };
        Ok((head, rest))
    }
}

/// # Safety
/// As [`memory::Cutter::take`].
unsafe fn cut_state<'a>(
    piece: Piece,
    nodes: usize,
    tets: usize,
    history: usize,
) -> Result<StateMut<'a>, FemtoStatus> {
    let mut cutter = piece.cutter();
    // SAFETY: the caller's.
    unsafe {
        Ok(StateMut::new(
            cutter.take(nodes)?,
            cutter.take(nodes)?,
            cutter.take(nodes * history)?,
            cutter.take(blocks(tets))?,
        ))
    }
}

/// The state of a body of this rest data.
///
/// # Safety
/// As [`memory::Cutter::take`].
unsafe fn state_of<'a>(piece: Piece, rest: &Head) -> Result<StateMut<'a>, FemtoStatus> {
    // SAFETY: the caller's.
    unsafe {
        let head = piece.expect(STATE)?;
        let same = head.nodes == rest.nodes && head.tets == rest.tets;
        if !same || head.header.fingerprint != rest.header.fingerprint {
            return Err(FemtoStatus::WrongBytes);
        }
        let (nodes, tets, history) = (
            head.nodes as usize,
            head.tets as usize,
            head.history as usize,
        );
        let piece = piece.limited(state_arrays(nodes, tets, history))?;
        cut_state(piece, nodes, tets, history)
    }
}

/// # Safety
/// As [`Piece::head`].
unsafe fn read_state<'a>(piece: Piece) -> Result<StateRef<'a>, FemtoStatus> {
    // SAFETY: the caller's; nothing is written.
    unsafe {
        let head = piece.expect(STATE)?;
        let state = state_of(piece, &head)?;
        Ok(StateRef::new(
            state.x,
            state.v,
            state.history,
            state.rotations,
        ))
    }
}

fn start_of(start: FemtoStart) -> Result<femto_core::Start, FemtoStatus> {
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

fn settings_of(settings: FemtoSettings) -> Result<femto_core::Settings<'static>, FemtoStatus> {
    let preconditioner = match settings.preconditioner {
        FEMTO_PRECONDITIONER_IDENTITY => Preconditioner::Identity,
        FEMTO_PRECONDITIONER_MASS => Preconditioner::Mass,
        FEMTO_PRECONDITIONER_JACOBI => Preconditioner::Jacobi,
        FEMTO_PRECONDITIONER_BLOCK_JACOBI => Preconditioner::BlockJacobi,
        _ => return Err(FemtoStatus::Settings),
    };
    let budget = Budget {
        iterations: settings.iterations,
        polar_sweeps: settings.polar_sweeps,
    };
    Ok(femto_core::Settings::new(settings.dt)
        .and_then(|s| s.with_theta(settings.theta))
        .map_err(|_| FemtoStatus::Settings)?
        .with_start(start_of(settings.start)?)
        .with_preconditioner(preconditioner)
        .with_budget(budget))
}

fn collider_of(collider: &FemtoCollider) -> Result<femto_core::Collider, Option<ColliderError>> {
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
    assert!(size_of::<FemtoPin>() == size_of::<femto_core::Pin>());
    assert!(align_of::<FemtoPin>() == align_of::<femto_core::Pin>());
};
