//! All that the module keeps, and the only place where it is reached.

use alloc::boxed::Box;
use alloc::rc::Rc;
use alloc::vec::Vec;
use core::cell::UnsafeCell;

use bytemuck::{Pod, Zeroable};

use crate::body::{Body, Saved};
use crate::fault::{Fault, fault};
use crate::loaded::Loaded;
use crate::table::Table;

/// 32 bytes, aligned as assets are.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(32))]
pub struct Chunk([u32; 8]);

/// What a handle stands for. In one table, whose code is in the module once.
pub enum Kept {
    Asset(Rc<Loaded>),
    Body(Box<Body>),
    Snapshot(Rc<Saved>),
}

pub struct World {
    pub kept: Table<Kept>,
    /// What JavaScript hands over: it asks for room, writes, and calls.
    input: Vec<Chunk>,
    /// Why the last call was refused.
    pub fault: Fault,
    /// What the last call has to say in numbers.
    pub numbers: [f64; 16],
}

impl World {
    /// The handle of something new.
    pub fn keep(&mut self, thing: Kept) -> Result<u32, Fault> {
        self.kept
            .keep(thing)
            .ok_or(fault!("too many assets, bodies and snapshots"))
    }

    pub fn asset(&mut self, handle: u32) -> Result<Rc<Loaded>, Fault> {
        match self.kept.get(handle) {
            Some(Kept::Asset(asset)) => Ok(asset.clone()),
            _ => Err(GONE),
        }
    }

    pub fn body(&mut self, handle: u32) -> Result<&mut Body, Fault> {
        match self.kept.get(handle) {
            Some(Kept::Body(body)) => Ok(body),
            _ => Err(GONE),
        }
    }

    pub fn snapshot(&mut self, handle: u32) -> Result<Rc<Saved>, Fault> {
        match self.kept.get(handle) {
            Some(Kept::Snapshot(saved)) => Ok(saved.clone()),
            _ => Err(GONE),
        }
    }

    /// Leaves numbers for JavaScript.
    pub fn numbers<const N: usize>(&mut self, numbers: [f64; N]) {
        for (to, from) in self.numbers.iter_mut().zip(numbers) {
            *to = from;
        }
    }

    /// Room for so many bytes. `None` where there is none.
    pub fn room(&mut self, bytes: usize) -> Option<&mut [Chunk]> {
        let chunks = bytes.div_ceil(size_of::<Chunk>());
        self.input = Vec::new();
        self.input.try_reserve_exact(chunks).ok()?;
        self.input.resize(chunks, Chunk([0; 8]));
        Some(&mut self.input)
    }

    /// What JavaScript wrote, which is then forgotten.
    pub fn take_input(&mut self) -> Vec<Chunk> {
        core::mem::take(&mut self.input)
    }
}

struct Single(UnsafeCell<World>);

// SAFETY: the module is built without threads.
unsafe impl Sync for Single {}

static WORLD: Single = Single(UnsafeCell::new(World {
    kept: Table::new(),
    input: Vec::new(),
    fault: Fault::NONE,
    numbers: [0.0; 16],
}));

const GONE: Fault = fault!("the handle was freed, or is of something else");

/// Exports that can be refused: what they return is not 0, or it is, and the reason is kept. Once in the module.
#[inline(never)]
pub fn call(export: &mut dyn FnMut(&mut World) -> Result<u32, Fault>) -> u32 {
    with(|world| {
        export(world).unwrap_or_else(|why| {
            world.fault = why;
            0
        })
    })
}

/// Every export is one such call.
pub fn with<T>(call: impl FnOnce(&mut World) -> T) -> T {
    // SAFETY: one thread; exports do not call each other, and the module imports nothing that could call back.
    call(unsafe { &mut *WORLD.0.get() })
}

/// Where something is, for JavaScript.
pub fn address<T>(pointer: *const T) -> u32 {
    pointer.addr() as u32
}
