//! A soft body on a Cortex-M4F with 20 KB of RAM: the body in flash, state and workspace in `static`s, one
//! step a tick of the timer.
//!
//! `cargo run --release` runs it under QEMU. It prints what it measured, and exits with 0 if no step was
//! refused or late, its stack stayed within 2 KB, and the last state has the hash that the host computed.
#![no_std]
#![no_main]

use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::exception;
use femto::body::{State, Workspace};
use femto::energy::StateHash;
use femto::lane::Native;
use femto::step::step;
use femto::{Asset, Scene, blocks};
use femto_firmware::{Once, entry, report_panics, stack};
use scene::{NODES, RATE, SCENE, SETTINGS, STEPS, TETS};
use semihosting::{println, process};

mod scene;

/// The body, as the build script baked it (or `femto bake` would): it stays in flash.
static BODY: &[u8] = femto::include_asset!(concat!(env!("OUT_DIR"), "/cube.femto"));
/// The hash of its last state on the host.
const HASH: u64 = include!(concat!(env!("OUT_DIR"), "/hash"));

static STATE: Once<State<NODES, { blocks(TETS) }>> = Once::new(State::new());
static WORK: Once<Workspace<NODES, { blocks(TETS) }>> = Once::new(Workspace::new());

/// The board's core clock, Hz.
const CLOCK: u32 = 25_000_000;
/// Stack that `main`, placing the body or a step in it, and the timer's interrupt in that may use.
const STACK: usize = 2048;

static TICKS: AtomicU32 = AtomicU32::new(0);

#[exception]
fn SysTick() {
    TICKS.store(TICKS.load(Ordering::Relaxed) + 1, Ordering::Relaxed);
}

report_panics!();

#[entry]
fn main() -> ! {
    stack::paint();
    // SAFETY: here only, and `main` runs once.
    let (state, work) = unsafe { (STATE.take(), WORK.take()) };
    let Ok(Asset { rest, pins, .. }) = Asset::new(BODY) else {
        process::exit(4);
    };
    if state.reset(&rest).is_err() {
        process::exit(2);
    }
    let scene = Scene { pins, ..SCENE };
    let Some(mut timer) = cortex_m::Peripherals::take().map(|p| p.SYST) else {
        process::exit(3);
    };
    timer.set_clock_source(SystClkSource::Core);
    timer.set_reload(CLOCK / RATE - 1);
    timer.clear_current();
    timer.enable_counter();
    timer.enable_interrupt();

    let (mut late, mut refused, mut longest) = (0_u32, 0_u32, 0_u32);
    for due in 1..=STEPS {
        while TICKS.load(Ordering::Relaxed) < due {
            cortex_m::asm::wfi();
        }
        let before = timer_now();
        let report = step::<Native, _>(
            &rest,
            &mut state.view_mut(),
            &mut work.view_mut(&rest),
            &scene,
            &SETTINGS,
        );
        let taken = before.wrapping_sub(timer_now());
        if TICKS.load(Ordering::Relaxed) == due {
            longest = longest.max(taken);
        } else {
            late += 1;
        }
        refused += u32::from(!report.advanced());
    }
    timer.disable_counter();
    let used = stack::used();
    let view = state.view();
    let hash = StateHash::new().with(view.x, view.v).value();

    let (state, work) = (size_of_val(&STATE), size_of_val(&WORK));
    println!("{NODES} nodes, {TETS} tetrahedra, {STEPS} steps at {RATE} Hz");
    println!(
        "RAM: {state} B of state, {work} B of workspace, {used} B of stack: {} B in all",
        state + work + used
    );
    println!(
        "a step takes at most {longest} ticks of the {} from one to the next",
        CLOCK / RATE
    );
    println!(
        "{late} late, {refused} refused, state {hash:016x} (host: {:016x})",
        HASH
    );
    let fine = late == 0 && refused == 0 && used <= STACK && hash == HASH;
    process::exit(i32::from(!fine))
}

/// Counts down.
fn timer_now() -> u32 {
    cortex_m::peripheral::SYST::get_current()
}
