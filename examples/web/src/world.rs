//! All that the module keeps, and the only place where it is reached.

use alloc::rc::Rc;
use alloc::vec::Vec;
use core::cell::UnsafeCell;

use bytemuck::{Pod, Zeroable};

use crate::body::{Body, Saved};
use crate::fault::Fault;
use crate::loaded::Loaded;
use crate::table::Table;

/// 32 bytes, aligned as assets are.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(32))]
pub struct Chunk([u32; 8]);

pub struct World {
    pub assets: Table<Rc<Loaded>>,
    pub bodies: Table<Body>,
    pub snapshots: Table<Saved>,
    /// What JavaScript hands over: it asks for room, writes, and calls.
    input: Vec<Chunk>,
    /// Why the last call was refused.
    pub fault: Fault,
    /// What the last call has to say in numbers.
    pub numbers: [f64; 16],
}

impl World {
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
    assets: Table::new(),
    bodies: Table::new(),
    snapshots: Table::new(),
    input: Vec::new(),
    fault: Fault::new(""),
    numbers: [0.0; 16],
}));

/// Every export is one such call.
pub fn with<T>(call: impl FnOnce(&mut World) -> T) -> T {
    // SAFETY: one thread; exports do not call each other, and the module imports nothing that could call back.
    call(unsafe { &mut *WORLD.0.get() })
}
