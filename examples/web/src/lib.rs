//! femto as a WASM module: C-style exports over handles, no imports.
//!
//! Numbers go in as arguments, arrays through `input`: room that JavaScript fills before the call which reads
//! it. Calls that can be refused return 0 (or handle 0) then, and `message` says why. Positions, velocities and forces
//! are read and written in place, where `positions` and the like say; memory may grow or move with any call that
//! makes, sets or frees something, and stays where it is during `step`.
//!
//! All `unsafe` of the web is in this package: names of exports, and what is safe without threads ([`world`], the
//! allocator).
#![no_std]

extern crate alloc;

use world::{Chunk, with};

mod assets;
mod bodies;
mod body;
mod fault;
mod loaded;
mod table;
mod world;

#[global_allocator]
static ALLOCATOR: lol_alloc::AssumeSingleThreaded<lol_alloc::FreeListAllocator> =
    // SAFETY: the module is built without threads.
    unsafe { lol_alloc::AssumeSingleThreaded::new(lol_alloc::FreeListAllocator::new()) };

/// Nothing here should panic; memory that is used up ends here.
#[cfg(target_family = "wasm")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}

/// Room for so many bytes of input; 0 where there is none.
#[unsafe(no_mangle)]
extern "C" fn input(bytes: usize) -> *mut Chunk {
    with(|world| {
        world
            .room(bytes)
            .map_or(core::ptr::null_mut(), <[Chunk]>::as_mut_ptr)
    })
}

/// Why the last call was refused: the code of a text.
#[unsafe(no_mangle)]
extern "C" fn message() -> u32 {
    with(|world| world.fault.code)
}

/// One of its two numbers.
#[unsafe(no_mangle)]
extern "C" fn message_number(which: usize) -> f32 {
    with(|world| world.fault.numbers.get(which).copied().unwrap_or_default())
}

/// Where calls leave their numbers, as f64.
#[unsafe(no_mangle)]
extern "C" fn numbers() -> *const f64 {
    with(|world| world.numbers.as_ptr())
}

/// Tetrahedra side by side.
#[unsafe(no_mangle)]
extern "C" fn lanes() -> usize {
    <femto::lane::Native as femto::lane::Lanes>::WIDTH
}

/// Assets, bodies and snapshots that are kept.
#[unsafe(no_mangle)]
extern "C" fn kept() -> usize {
    with(|world| world.kept.len())
}

/// Forgets an asset, a body or a snapshot; bodies that use an asset keep it.
#[unsafe(no_mangle)]
extern "C" fn free(handle: u32) -> u32 {
    with(|world| u32::from(world.kept.free(handle)))
}
