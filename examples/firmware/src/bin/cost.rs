//! Steps to be counted by the plugin: `cost prove` and others; see [`femto_cases::cost`].
#![no_std]
#![no_main]

use core::hint::black_box;

#[cfg(feature = "contact")]
use femto_cases::cost::coupled;
use femto_cases::cost::{Counter, Room, cube, measure, prove};
use femto_firmware::{Once, entry, report_panics};
use semihosting::{experimental::env, print, process};

static ROOM: Once<Room> = Once::new(Room::new());
report_panics!();

#[unsafe(no_mangle)]
#[inline(never)]
fn count_begin() {
    black_box(0);
}

#[unsafe(no_mangle)]
#[inline(never)]
fn count_end() {
    black_box(1);
}

#[entry]
fn main() -> ! {
    // SAFETY: here only, and `main` runs once.
    let room = unsafe { ROOM.take() };
    let mut counter = Counter {
        say: |what: core::fmt::Arguments<'_>| print!("{what}"),
        begin: count_begin,
        end: count_end,
        early_exit: cfg!(feature = "early-exit"),
    };
    let arguments = env::args::<128>();
    let mode = arguments
        .as_ref()
        .ok()
        .and_then(|mut arguments| arguments.nth(1)?.ok());
    let outcome = match mode {
        Some("prove") => prove(room, &mut counter),
        Some("measure") => measure(room, &mut counter),
        Some("cube") => cube(room, &mut counter),
        #[cfg(feature = "contact")]
        Some("prove-coupled") => coupled::prove(room, &mut counter),
        #[cfg(any(
            feature = "contact",
            feature = "plasticity",
            feature = "fracture",
            feature = "guard"
        ))]
        Some("measure-more") => femto_cases::cost::measure_more(room, &mut counter),
        _ => process::exit(2),
    };
    process::exit(i32::from(outcome.is_err()))
}
