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

use femto_core::body::{WorkspaceMut, workspace_numbers};
use femto_core::element::{Factored, RotatedGradients};
use femto_core::energy::StateHash;
use femto_core::glam::Vec3;
use femto_core::lane::{Native, blocks};
use femto_core::operator::{Fit, fit_rotations};
use femto_core::preconditioner::Aggregates;
use femto_core::preconditioner::coarse::coarse_length;
use femto_core::report::Refusal;
use femto_core::rest::{Header, RestMut};
use femto_core::state::StateError;
use femto_core::step::step;
use femto_core::vector::copy;
use femto_core::{Asset, Mesh, Preconditioner};

use convert::{collider_of, local_of, settings_of, start_code, start_of};
use memory::{Piece, REST, STATE, array, array_mut, one, padded, put, units};
use pieces::{
    cut_state, factor_of, head, read_state, rest_arrays, rest_of, state_arrays, state_of,
    workspace_arrays,
};
pub use types::*;

mod convert;
mod memory;
mod pieces;
mod types;

/// Linked into firmware alone, and only if something can panic: nothing does.
#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// Colliders of a step, at most.
pub const FEMTO_MAX_COLLIDERS: usize = 8;

/// Aggregates of a two-level preconditioner, at most.
pub const FEMTO_MAX_AGGREGATES: usize = 16;

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

/// Bytes of the workspace of a step; 0 if there is no such mesh or start. A two-level preconditioner needs
/// femto_coarse_bytes more.
#[unsafe(no_mangle)]
pub extern "C" fn femto_workspace_bytes(nodes: usize, tets: usize, start: FemtoStart) -> usize {
    start_of(start)
        .ok()
        .and_then(|start| workspace_arrays(nodes, tets, start.vectors(), 0))
        .unwrap_or(0)
}

/// Bytes that so many aggregates add to the workspace; 0 if there are none, or more than FEMTO_MAX_AGGREGATES.
#[unsafe(no_mangle)]
pub extern "C" fn femto_coarse_bytes(aggregates: u32) -> usize {
    match usize::try_from(aggregates) {
        Ok(count) if count <= FEMTO_MAX_AGGREGATES => {
            padded(size_of::<f32>(), coarse_length(count)).unwrap_or(0)
        }
        _ => 0,
    }
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

/// Checks an asset (of the tool `femto bake`), every number of it, and says what it is of. It is read in place: where
/// rest data is asked for, it may be passed instead, and its factor where FemtoSettings names it. `asset_bytes` is
/// exact. Call it once: all other calls trust the numbers of an asset.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn femto_asset_open(
    asset: *const c_void,
    asset_bytes: usize,
    out: *mut FemtoAsset,
) -> FemtoStatus {
    // SAFETY: as above.
    status(|| unsafe {
        let piece = Piece::new(asset, asset_bytes)?;
        // Its place, before the work.
        array(out.cast::<f32>(), size_of::<FemtoAsset>() / 4, &[piece])?;
        let opened = Asset::new(piece.bytes()).map_err(|_| FemtoStatus::Asset)?;
        let settings = opened.metadata.settings;
        let (preconditioner, factor, factor_bytes) = match opened.factor {
            Some(_) => (FEMTO_PRECONDITIONER_FACTORED, asset, asset_bytes),
            None => (FEMTO_PRECONDITIONER_JACOBI, core::ptr::null(), 0),
        };
        put(
            out,
            FemtoAsset {
                nodes: opened.rest.nodes.len(),
                tets: opened.rest.header.tets as usize,
                pins: opened.pins.as_ptr().cast(),
                pin_count: opened.pins.len(),
                settings: FemtoSettings {
                    dt: settings.dt(),
                    theta: settings.theta(),
                    iterations: settings.budget.iterations,
                    polar_sweeps: settings.budget.polar_sweeps,
                    start: start_code(settings.start),
                    preconditioner,
                    aggregate_count: 0,
                    aggregates: core::ptr::null(),
                    factor,
                    factor_bytes,
                },
            },
        )
    })
}

/// Divides a body into aggregates for a two-level preconditioner: writes one number a node. 8 are the usual choice,
/// FEMTO_MAX_AGGREGATES the most. Goes through the mesh many times: at load, not in every step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn femto_aggregates_init(
    aggregates: *mut u8,
    node_count: usize,
    rest: *const c_void,
    rest_bytes: usize,
    count: u32,
) -> FemtoStatus {
    // SAFETY: as above.
    status(|| unsafe {
        let piece = Piece::new(rest, rest_bytes)?;
        let (_, rest) = rest_of(piece)?;
        let count = usize::try_from(count).map_err(|_| FemtoStatus::Settings)?;
        if node_count < rest.nodes.len() {
            return Err(FemtoStatus::TooSmall);
        }
        let out = array_mut(aggregates, rest.nodes.len(), &[piece])?;
        match Aggregates::divide(&rest, count, out) {
            Ok(_) => Ok(()),
            Err(_) => Err(FemtoStatus::Settings),
        }
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
        let settings = one(settings)?;
        let factor = factor_of(&settings, &[piece, workspace])?;
        let preconditioner = match (settings.preconditioner, &factor) {
            (_, Some(factor)) => Preconditioner::Factored(factor),
            (FEMTO_PRECONDITIONER_TWO_LEVEL, None) => {
                let count = usize::try_from(settings.aggregate_count);
                let count = count.map_err(|_| FemtoStatus::Settings)?;
                let nodes = rest.nodes.len();
                let of = array(settings.aggregates, nodes, &[piece, workspace])?;
                let aggregates = Aggregates::new(of, count).map_err(|_| FemtoStatus::Settings)?;
                Preconditioner::TwoLevel(aggregates)
            }
            (code, None) => local_of(code)?,
        };
        let settings = settings_of(&settings)?.with_preconditioner(preconditioner);

        let (nodes, tets, vectors, coarse) = (
            rest.nodes.len(),
            head.tets as usize,
            settings.start.vectors(),
            settings.preconditioner.coarse_length(),
        );
        let workspace = workspace.limited(workspace_arrays(nodes, tets, vectors, coarse))?;
        let mut cutter = workspace.cutter();
        let rotated = cutter.take::<RotatedGradients>(blocks(tets))?;
        let numbers = workspace_numbers(nodes, blocks(tets), vectors) + coarse;
        let numbers = cutter.take::<f32>(numbers)?;
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
            Some(Refusal::Factor) => Err(FemtoStatus::WrongBytes),
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
