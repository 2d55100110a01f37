//! Steps to be counted by the plugin under qemu-user, or as WASM by `femto-fuel`: `cost prove` and others; see
//! [`femto_cases::cost`].

use std::fmt::Arguments;
use std::io::Write;
use std::process::ExitCode;

#[cfg(feature = "contact")]
use femto_cases::cost::coupled;
use femto_cases::cost::{Counter, Room, cube, measure, prove};

#[expect(unsafe_code, reason = "what runs the module counts")]
#[cfg(target_arch = "wasm32")]
#[link(wasm_import_module = "count")]
unsafe extern "C" {
    safe fn count_begin();
    safe fn count_end();
}

#[cfg(not(target_arch = "wasm32"))]
#[expect(unsafe_code, reason = "the plugin finds the function by its name")]
#[unsafe(no_mangle)]
#[inline(never)]
fn count_begin() {
    std::hint::black_box(0);
}

#[cfg(not(target_arch = "wasm32"))]
#[expect(unsafe_code, reason = "as above")]
#[unsafe(no_mangle)]
#[inline(never)]
fn count_end() {
    std::hint::black_box(1);
}

fn main() -> ExitCode {
    static ROOM: std::sync::Mutex<Room> = std::sync::Mutex::new(Room::new());
    let mut room = ROOM.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let mut counter = Counter {
        say: |what: Arguments<'_>| {
            print!("{what}");
            // The plugin writes past this program's buffer.
            _ = std::io::stdout().flush();
        },
        begin: || count_begin(),
        end: || count_end(),
        early_exit: cfg!(feature = "early-exit"),
    };
    let outcome = match std::env::args().nth(1).as_deref() {
        Some("prove") => prove(&mut room, &mut counter),
        Some("measure") => measure(&mut room, &mut counter),
        Some("cube") => cube(&mut room, &mut counter),
        #[cfg(feature = "contact")]
        Some("prove-coupled") => coupled::prove(&mut room, &mut counter),
        #[cfg(any(
            feature = "contact",
            feature = "plasticity",
            feature = "fracture",
            feature = "guard"
        ))]
        Some("measure-more") => femto_cases::cost::measure_more(&mut room, &mut counter),
        _ => return ExitCode::from(2),
    };
    ExitCode::from(u8::from(outcome.is_err()))
}
