//! femto as a WASM module: C-style exports over handles, no imports.
//!
//! Numbers go in as arguments, arrays through `input`: room that JavaScript fills before the call which reads
//! it. Calls that can be refused return 0 (or handle 0) then, and `message` says why. Positions, velocities and forces
//! are read and written in place, where `positions` and the like say; memory may grow or move with any call that
//! makes, sets or frees something, and stays where it is during `step`.
//!
//! All `unsafe` of the web is in this package: names of exports, and the one static ([`world`]).
#![no_std]

extern crate alloc;

use fault::Fault;
use world::{Chunk, World, with};

mod assets;
mod bodies;
mod body;
mod fault;
mod loaded;
mod table;
mod world;

#[global_allocator]
static ALLOCATOR: dlmalloc::GlobalDlmalloc = dlmalloc::GlobalDlmalloc;

/// Nothing here should panic; memory that is used up ends here.
#[cfg(target_family = "wasm")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}

const GONE: &str = "the handle was freed, or is of something else";

fn refuse(world: &mut World, why: impl Into<Fault>) -> u32 {
    world.fault = why.into();
    0
}

fn answer<E: Into<Fault>>(world: &mut World, result: Result<u32, E>) -> u32 {
    result.unwrap_or_else(|why| refuse(world, why))
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

/// Where the reason of the last refusal stands, as UTF-8, with `{0}` and `{1}` for its numbers.
#[unsafe(no_mangle)]
extern "C" fn message() -> *const u8 {
    with(|world| world.fault.text.as_ptr())
}

/// Its length in bytes.
#[unsafe(no_mangle)]
extern "C" fn message_length() -> usize {
    with(|world| world.fault.text.len())
}

/// One of its two numbers.
#[unsafe(no_mangle)]
extern "C" fn message_number(which: usize) -> f64 {
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
    with(|world| world.assets.len() + world.bodies.len() + world.snapshots.len())
}
