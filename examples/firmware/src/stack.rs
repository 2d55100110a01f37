//! How deep the stack gets, by painting what is free of it (Cortex-M).

/// What nothing else writes.
const PAINT: u32 = 0xc5c5_c5c5;
/// Words above the painted part: the frame of [`paint`] itself.
const MARGIN: usize = 16;

unsafe extern "C" {
    /// The end of the `static`s and the top of the stack, from the linker script.
    static mut __sheap: u32;
    static mut _stack_start: u32;
}

/// Paints the free part of the stack.
#[inline(never)]
pub fn paint() {
    let free = pointer().wrapping_sub(MARGIN);
    let mut at = &raw mut __sheap;
    while at < free {
        // SAFETY: between the `static`s and the stack there is RAM that nobody uses: these programs have no heap.
        unsafe { at.write_volatile(PAINT) };
        at = at.wrapping_add(1);
    }
}

/// The most bytes of stack that were ever in use since then, from its top.
#[must_use]
pub fn used() -> usize {
    let (mut at, top) = (&raw mut __sheap, &raw mut _stack_start);
    // SAFETY: as above, only read.
    while at < top && unsafe { at.read_volatile() } == PAINT {
        at = at.wrapping_add(1);
    }
    top as usize - at as usize
}

fn pointer() -> *mut u32 {
    let pointer;
    // SAFETY: reads a register.
    unsafe { core::arch::asm!("mov {}, sp", out(reg) pointer, options(nomem, nostack)) };
    pointer
}
