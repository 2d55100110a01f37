//! The golden scenes as a WASM module: no imports, no allocator, one scene at a time.
//!
//! A page asks how many there are, runs one, and reads what came out at each of its checkpoints.
#![no_std]

use core::cell::UnsafeCell;

use femto_cases::scenes::{Bodies, CHECKPOINTS, Case, STEPS, cases, golden, run};

/// The state hash after so many steps, and the one that it should be.
#[derive(Clone, Copy)]
struct Checkpoint {
    step: u32,
    hash: u64,
    golden: u64,
}

const NOTHING: Checkpoint = Checkpoint {
    step: 0,
    hash: 0,
    golden: 0,
};

struct World {
    bodies: Bodies,
    /// Of the scene that ran last.
    checkpoints: [Checkpoint; CHECKPOINTS.len()],
}

struct Single(UnsafeCell<World>);

// SAFETY: the module is built without threads.
unsafe impl Sync for Single {}

static WORLD: Single = Single(UnsafeCell::new(World {
    bodies: Bodies::new(),
    checkpoints: [NOTHING; CHECKPOINTS.len()],
}));

fn with<T>(call: impl FnOnce(&mut World) -> T) -> T {
    // SAFETY: one thread; exports do not call each other, and the module imports nothing that could call back.
    call(unsafe { &mut *WORLD.0.get() })
}

/// Nothing here should panic.
#[cfg(target_family = "wasm")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}

fn case(scene: usize) -> Option<Case> {
    cases().nth(scene)
}

/// How many scenes there are.
#[unsafe(no_mangle)]
extern "C" fn scenes() -> usize {
    cases().count()
}

fn part(scene: usize, part: usize) -> &'static str {
    let name = case(scene).and_then(|case| case.name.get(part).copied());
    name.unwrap_or_default()
}

/// Where the first or the second part of a scene's name stands, as UTF-8.
#[unsafe(no_mangle)]
extern "C" fn name(scene: usize, which: usize) -> *const u8 {
    part(scene, which).as_ptr()
}

/// Its length in bytes.
#[unsafe(no_mangle)]
extern "C" fn name_length(scene: usize, which: usize) -> usize {
    part(scene, which).len()
}

/// Runs a scene for its 1,000 steps. How many checkpoints it came to; 0 where it did not run.
#[unsafe(no_mangle)]
extern "C" fn run_scene(scene: usize) -> usize {
    with(|world| {
        let World {
            bodies,
            checkpoints,
        } = world;
        *checkpoints = [NOTHING; CHECKPOINTS.len()];
        let Some(case) = case(scene) else { return 0 };
        let mut places = checkpoints.iter_mut();
        let mut count = 0;
        let ran = run(&case, bodies, STEPS, |step, hash| {
            if let (Some(place), Some(golden)) = (places.next(), golden(&case, step)) {
                *place = Checkpoint { step, hash, golden };
                count += 1;
            }
        });
        ran.map_or(0, |()| count)
    })
}

fn checkpoint(which: usize) -> Checkpoint {
    with(|world| world.checkpoints.get(which).copied().unwrap_or(NOTHING))
}

/// Steps taken at a checkpoint of the last run.
#[unsafe(no_mangle)]
extern "C" fn step_at(which: usize) -> u32 {
    checkpoint(which).step
}

/// The state hash there.
#[unsafe(no_mangle)]
extern "C" fn hash_at(which: usize) -> u64 {
    checkpoint(which).hash
}

/// The hash that is committed.
#[unsafe(no_mangle)]
extern "C" fn golden_at(which: usize) -> u64 {
    checkpoint(which).golden
}
