//! From pointers to references: the only place that dereferences what C passes.
//!
//! A piece of memory begins with a [`Head`] and goes on with arrays, each at a multiple of [`FEMTO_ALIGNMENT`]. Every
//! array is of numbers for which any bits are valid, so a piece with wrong bytes is wrong, but never undefined.

use core::ffi::c_void;
use core::mem::{align_of, size_of};
use core::slice;

use femto_core::rest::Header;

use crate::types::{FEMTO_ALIGNMENT, FemtoStatus};

/// The start of every piece.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug)]
pub struct Head {
    /// Which kind of piece, and that it is one.
    pub magic: u32,
    pub nodes: u32,
    pub tets: u32,
    /// Past velocities that a state keeps.
    pub history: u32,
    /// Of rest data.
    pub header: Header,
}

/// "fRst", "fSta"
pub const REST: u32 = 0x7473_5266;
pub const STATE: u32 = 0x6174_5366;

/// A piece of memory that is not null, aligned, and of a possible size.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    at: *mut u8,
    bytes: usize,
}

impl Piece {
    pub fn new(at: *const c_void, bytes: usize) -> Result<Self, FemtoStatus> {
        if at.is_null() {
            Err(FemtoStatus::Null)
        } else if !at.addr().is_multiple_of(FEMTO_ALIGNMENT) {
            Err(FemtoStatus::Misaligned)
        } else if bytes < size_of::<Head>() || !possible(at.addr(), bytes) {
            Err(FemtoStatus::TooSmall)
        } else {
            Ok(Self {
                at: at.cast::<u8>().cast_mut(),
                bytes,
            })
        }
    }

    pub fn apart(pieces: &[Self]) -> Result<(), FemtoStatus> {
        for (k, a) in pieces.iter().enumerate() {
            for b in pieces.iter().skip(k + 1) {
                let (from_a, from_b) = (a.at.addr(), b.at.addr());
                if from_a < from_b + b.bytes && from_b < from_a + a.bytes {
                    return Err(FemtoStatus::Overlap);
                }
            }
        }
        Ok(())
    }

    /// The first `bytes` bytes.
    pub fn limited(self, bytes: Option<usize>) -> Result<Self, FemtoStatus> {
        match bytes {
            Some(bytes) if bytes <= self.bytes => Ok(Self { bytes, ..self }),
            _ => Err(FemtoStatus::TooSmall),
        }
    }

    /// # Safety
    /// The piece is memory that nobody writes meanwhile.
    pub unsafe fn head(&self) -> Head {
        // SAFETY: aligned and long enough, by `new`; any bits are a `Head`.
        unsafe { self.at.cast::<Head>().read() }
    }

    /// # Safety
    /// The piece is memory that nobody else uses meanwhile.
    pub unsafe fn write_head(&self, head: Head) {
        // SAFETY: as above.
        unsafe { self.at.cast::<Head>().write(head) }
    }

    /// The head of an initialised piece.
    ///
    /// # Safety
    /// As [`Self::head`].
    pub unsafe fn expect(&self, magic: u32) -> Result<Head, FemtoStatus> {
        // SAFETY: the caller's.
        let head = unsafe { self.head() };
        if head.magic == magic && head.nodes > 0 && head.tets > 0 {
            Ok(head)
        } else {
            Err(FemtoStatus::WrongBytes)
        }
    }

    /// All its bytes.
    ///
    /// # Safety
    /// The piece is memory that nobody writes while they live.
    pub unsafe fn bytes<'a>(self) -> &'a [u8] {
        // SAFETY: not null, of a possible size, and any bits are bytes.
        unsafe { slice::from_raw_parts(self.at, self.bytes) }
    }

    /// What follows the head, to be cut into arrays.
    pub fn cutter(self) -> Cutter {
        Cutter {
            piece: self,
            used: size_of::<Head>(),
        }
    }
}

fn possible(address: usize, bytes: usize) -> bool {
    isize::try_from(bytes).is_ok() && address.checked_add(bytes).is_some()
}

/// Numbers for which any bits are valid.
///
/// # Safety
/// Only such, and aligned to at most [`FEMTO_ALIGNMENT`].
pub unsafe trait Plain: Copy {}
// SAFETY: a byte.
unsafe impl Plain for u8 {}
// SAFETY: arrays of f32 and u32.
unsafe impl Plain for f32 {}
// SAFETY: as above.
unsafe impl Plain for [f32; 3] {}
// SAFETY: as above.
unsafe impl Plain for [u32; 4] {}
// SAFETY: as above.
unsafe impl Plain for femto_core::rest::TetBlock {}
// SAFETY: as above.
unsafe impl Plain for femto_core::operator::RotationBlock {}
// SAFETY: as above.
unsafe impl Plain for femto_core::element::RotatedGradients {}
// SAFETY: of u32 and f32.
unsafe impl Plain for femto_core::Pin {}
// SAFETY: as above.
unsafe impl Plain for crate::types::FemtoCollider {}

/// Cuts a piece into arrays, one after the other.
#[derive(Debug)]
pub struct Cutter {
    piece: Piece,
    used: usize,
}

impl Cutter {
    /// The next `count` values.
    ///
    /// # Safety
    /// The piece is memory that nobody else uses while the array lives.
    pub unsafe fn take<'a, T: Plain>(&mut self, count: usize) -> Result<&'a mut [T], FemtoStatus> {
        let end = padded(size_of::<T>(), count)
            .and_then(|bytes| bytes.checked_add(self.used))
            .filter(|&end| end <= self.piece.bytes)
            .ok_or(FemtoStatus::TooSmall)?;
        let start = core::mem::replace(&mut self.used, end);
        // SAFETY: within the piece, aligned, of no other array, and any bits are valid.
        Ok(unsafe { slice::from_raw_parts_mut(self.piece.at.add(start).cast::<T>(), count) })
    }
}

/// Bytes of an array in a piece.
pub const fn padded(size: usize, count: usize) -> Option<usize> {
    match size.checked_mul(count) {
        Some(bytes) => bytes.checked_next_multiple_of(FEMTO_ALIGNMENT),
        None => None,
    }
}

/// Bytes of a piece with arrays of (size, count).
pub fn bytes(arrays: &[(usize, Option<usize>)]) -> Option<usize> {
    let mut sum = size_of::<Head>();
    for &(size, count) in arrays {
        sum = sum.checked_add(padded(size, count?)?)?;
    }
    isize::try_from(sum).is_ok().then_some(sum)
}

/// An array of the caller's, of no piece that is written meanwhile.
///
/// # Safety
/// It is memory that nobody writes meanwhile.
pub unsafe fn array<'a, T: Plain>(
    at: *const T,
    count: usize,
    written: &[Piece],
) -> Result<&'a [T], FemtoStatus> {
    if count == 0 {
        return Ok(&[]);
    }
    if at.is_null() {
        return Err(FemtoStatus::Null);
    }
    if !at.addr().is_multiple_of(align_of::<T>()) {
        return Err(FemtoStatus::Misaligned);
    }
    let bytes = size_of::<T>().checked_mul(count);
    let bytes = bytes.filter(|&bytes| possible(at.addr(), bytes));
    let read = Piece {
        at: at.cast::<u8>().cast_mut(),
        bytes: bytes.ok_or(FemtoStatus::TooSmall)?,
    };
    for piece in written {
        Piece::apart(&[read, *piece])?;
    }
    // SAFETY: not null, aligned, of a possible size, and any bits are valid; the rest is the caller's word.
    Ok(unsafe { slice::from_raw_parts(at, count) })
}

/// An array of the caller's that is to be written, apart from pieces that are read meanwhile.
///
/// # Safety
/// It is memory that nobody else uses meanwhile.
pub unsafe fn array_mut<'a, T: Plain>(
    at: *mut T,
    count: usize,
    read: &[Piece],
) -> Result<&'a mut [T], FemtoStatus> {
    // SAFETY: checked for reading as it must be for writing; the rest is the caller's word.
    unsafe {
        array(at.cast_const(), count, read)?;
        Ok(if count == 0 {
            &mut []
        } else {
            slice::from_raw_parts_mut(at, count)
        })
    }
}

/// As many units: they take no memory.
pub fn units<'a>(count: usize) -> &'a mut [()] {
    let at = core::ptr::NonNull::dangling().as_ptr();
    // SAFETY: a slice of no bytes at a pointer that is not null and aligned.
    unsafe { slice::from_raw_parts_mut(at, count) }
}

/// A struct of the caller's.
///
/// # Safety
/// As [`array`].
pub unsafe fn one<T: Copy>(at: *const T) -> Result<T, FemtoStatus> {
    if at.is_null() {
        Err(FemtoStatus::Null)
    } else if !at.addr().is_multiple_of(align_of::<T>()) {
        Err(FemtoStatus::Misaligned)
    } else {
        // SAFETY: not null and aligned; the structs are of numbers and pointers.
        Ok(unsafe { at.read() })
    }
}

/// Where a result goes.
///
/// # Safety
/// Nobody else uses it meanwhile.
pub unsafe fn put<T>(at: *mut T, value: T) -> Result<(), FemtoStatus> {
    if at.is_null() {
        Err(FemtoStatus::Null)
    } else if !at.addr().is_multiple_of(align_of::<T>()) {
        Err(FemtoStatus::Misaligned)
    } else {
        // SAFETY: not null and aligned.
        unsafe { at.write(value) };
        Ok(())
    }
}
