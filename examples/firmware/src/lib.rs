//! What the firmware programs share: the runtime of the target, and exclusive access to a `static`.
#![no_std]

#[cfg(target_arch = "arm")]
pub use cortex_m_rt::entry;
#[cfg(target_arch = "riscv32")]
pub use riscv_rt::entry;

#[cfg(target_arch = "arm")]
pub mod stack;

/// The interrupts of a processor that has none: the runtime wants one entry.
#[cfg(target_arch = "arm")]
// SAFETY: the section and the name are those that the runtime asks for, and the entry is never taken.
#[unsafe(link_section = ".vector_table.interrupts")]
#[unsafe(no_mangle)]
pub static __INTERRUPTS: [usize; 1] = [0];

/// The panic handler of the programs that print: says where, and exits with 101.
#[macro_export]
macro_rules! report_panics {
    () => {
        #[panic_handler]
        fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
            semihosting::eprintln!("{info}");
            semihosting::process::exit(101)
        }
    };
}

/// A `static` that one program takes once, `&mut`.
#[derive(Debug)]
pub struct Once<T>(core::cell::UnsafeCell<T>);

// SAFETY: `take` is unsafe, and its caller promises to be the only one.
unsafe impl<T> Sync for Once<T> {}

impl<T> Once<T> {
    /// With its first value.
    pub const fn new(value: T) -> Self {
        Self(core::cell::UnsafeCell::new(value))
    }

    /// The only reference there ever is.
    ///
    /// # Safety
    /// Called once in the life of the program.
    #[allow(clippy::mut_from_ref)]
    pub unsafe fn take(&self) -> &mut T {
        // SAFETY: the caller promises that there is no other.
        unsafe { &mut *self.0.get() }
    }
}
