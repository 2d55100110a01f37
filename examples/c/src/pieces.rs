//! What pieces of memory hold: their sizes, and rest data, states and factors as views of them.

use core::mem::size_of;

use femto_core::Asset;
use femto_core::body::{StateMut, StateRef, workspace_numbers};
use femto_core::element::{Factored, RotatedGradients};
use femto_core::lane::blocks;
use femto_core::operator::RotationBlock;
use femto_core::preconditioner::Factor;
use femto_core::rest::{Header, Rest, TetBlock};

use crate::memory::{Head, Piece, REST, STATE, bytes, units};
use crate::types::{FEMTO_PRECONDITIONER_FACTORED, FemtoSettings, FemtoStatus};

pub fn head(magic: u32, nodes: usize, tets: usize, history: usize, header: Header) -> Head {
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

pub fn rest_arrays(nodes: usize, tets: usize) -> Option<usize> {
    numbered(nodes, tets)?;
    bytes(&[
        (size_of::<[f32; 3]>(), Some(nodes)),
        (size_of::<f32>(), Some(nodes)),
        (size_of::<TetBlock>(), Some(blocks(tets))),
    ])
}

pub fn state_arrays(nodes: usize, tets: usize, history: usize) -> Option<usize> {
    numbered(nodes, tets)?;
    bytes(&[
        (size_of::<[f32; 3]>(), Some(nodes)),
        (size_of::<[f32; 3]>(), Some(nodes)),
        (size_of::<[f32; 3]>(), nodes.checked_mul(history)),
        (size_of::<RotationBlock>(), Some(blocks(tets))),
    ])
}

pub fn workspace_arrays(nodes: usize, tets: usize, vectors: usize, coarse: usize) -> Option<usize> {
    numbered(nodes, tets)?;
    // What `workspace_numbers` asks of any mesh and start.
    let most = nodes.checked_mul(25 + 6 * vectors)?;
    most.checked_add(blocks(tets))?;
    let numbers = workspace_numbers(nodes, blocks(tets), vectors);
    bytes(&[
        (size_of::<RotatedGradients>(), Some(blocks(tets))),
        (size_of::<f32>(), numbers.checked_add(coarse)),
    ])
}

/// Nodes and tetrahedra are counted in u32, and there are some.
pub fn numbered(nodes: usize, tets: usize) -> Option<()> {
    let some = |count: usize| u32::try_from(count).is_ok_and(|count| count > 0);
    (some(nodes) && some(tets)).then_some(())
}

/// The factor that the settings ask for, of a piece apart from those that are written.
///
/// # Safety
/// As [`Piece::bytes`].
pub unsafe fn factor_of<'a>(
    settings: &FemtoSettings,
    written: &[Piece; 2],
) -> Result<Option<Factor<'a>>, FemtoStatus> {
    if settings.preconditioner != FEMTO_PRECONDITIONER_FACTORED {
        return Ok(None);
    }
    let [state, workspace] = *written;
    let piece = Piece::new(settings.factor, settings.factor_bytes)?;
    Piece::apart(&[piece, state])?;
    Piece::apart(&[piece, workspace])?;
    // SAFETY: the caller's.
    let asset = Asset::reopen(unsafe { piece.bytes() }).map_err(|_| FemtoStatus::Asset)?;
    asset.factor.map(Some).ok_or(FemtoStatus::Asset)
}

/// Rest data: of a piece, or of an asset.
///
/// # Safety
/// As [`Piece::bytes`].
pub unsafe fn rest_of<'a>(piece: Piece) -> Result<(Head, Rest<'a, Factored>), FemtoStatus> {
    // SAFETY: the caller's.
    unsafe {
        if Asset::is_one(piece.bytes()) {
            let rest = Asset::reopen(piece.bytes())
                .map_err(|_| FemtoStatus::Asset)?
                .rest;
            let (nodes, tets) = (rest.nodes.len(), rest.header.tets as usize);
            return Ok((head(REST, nodes, tets, 0, rest.header), rest));
        }
        let head = piece.expect(REST)?;
        let (nodes, tets) = (head.nodes as usize, head.tets as usize);
        let piece = piece.limited(rest_arrays(nodes, tets))?;
        let mut cutter = piece.cutter();
        let rest = Rest {
            nodes: cutter.take(nodes)?,
            masses: cutter.take(nodes)?,
            blocks: cutter.take(blocks(tets))?,
            stiffness: units(blocks(tets)),
            fans: &[],
            header: head.header,
        };
        Ok((head, rest))
    }
}

/// # Safety
/// As [`memory::Cutter::take`].
pub unsafe fn cut_state<'a>(
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
pub unsafe fn state_of<'a>(piece: Piece, rest: &Head) -> Result<StateMut<'a>, FemtoStatus> {
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
pub unsafe fn read_state<'a>(piece: Piece) -> Result<StateRef<'a>, FemtoStatus> {
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
