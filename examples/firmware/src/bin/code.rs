//! A step and nothing else, to see what it links: how many bytes of flash, and no panic.
//!
//! With the feature `one-preconditioner` its settings are constants; else they could be any.
#![no_std]
#![no_main]

use core::hint::black_box;

use femto::body::{State, Workspace};
use femto::glam::Vec3;
use femto::rest::RestBuffer;
use femto::{Scene, Settings, Start, blocks};
use femto_firmware::{Once, entry};

const NODES: usize = 64;
const BLOCKS: usize = blocks(162);
const START: Start = Start::Galerkin(1);

/// In RAM: its bytes would only hide those of the code.
static REST: Once<RestBuffer<NODES, BLOCKS>> = Once::new(RestBuffer::new());
static STATE: Once<State<NODES, BLOCKS>> = Once::new(State::new());
static WORK: Once<Workspace<NODES, BLOCKS>> = Once::new(Workspace::new());

#[cfg(feature = "contact")]
static SLOTS: Once<[femto::Coupling; 16]> = Once::new([femto::Coupling::EMPTY; 16]);
#[cfg(feature = "contact")]
static RIGIDS: Once<[femto::rigid::Rigid; 2]> =
    Once::new([femto::rigid::Rigid::new(0, femto::rigid::Shape::Ball { radius: 0.1 }, 0.0); 2]);

static SETTINGS: Settings = match Settings::new(0.01) {
    Ok(settings) => settings.with_start(START),
    Err(_) => panic!("a valid time step"),
};
static SCENE: Scene<'static> = Scene {
    gravity: Vec3::new(0.0, -9.81, 0.0),
    forces: &[],
    pins: &[],
    colliders: &[],
};

/// Linked only if something in a step can panic.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

#[entry]
fn main() -> ! {
    // SAFETY: here only, and `main` runs once.
    let (rest, state, work) = unsafe { (REST.take(), STATE.take(), WORK.take()) };
    let rest = black_box(&*rest).view();
    let (scene, settings) = if cfg!(feature = "one-preconditioner") {
        (&SCENE, &SETTINGS)
    } else {
        (black_box(&SCENE), black_box(&SETTINGS))
    };
    #[cfg(feature = "contact")]
    // SAFETY: as above.
    let (slots, rigids) = unsafe { (SLOTS.take(), RIGIDS.take()) };
    loop {
        #[cfg(feature = "contact")]
        let report = femto::step::step_coupled::<femto::lane::Native, _>(
            &rest,
            &mut state.view_mut(),
            &mut work.view_mut(&rest),
            scene,
            settings,
            &mut femto::Couplings::new(black_box(&[]), rigids, black_box(&[]), slots),
        );
        #[cfg(not(feature = "contact"))]
        let report = femto::step::step::<femto::lane::Native, _>(
            &rest,
            &mut state.view_mut(),
            &mut work.view_mut(&rest),
            scene,
            settings,
        );
        _ = black_box(report);
        if cfg!(feature = "panics") {
            black_box(rest.masses[black_box(0)]);
        }
    }
}
