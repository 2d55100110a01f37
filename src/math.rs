//! The only door to scalar maths.
//!
//! A step uses `+ − × ÷`, comparisons and [`sqrt`], all of which IEEE 754 rounds correctly, so
//! that every target gives the same bits. Not allowed in a step, each for a reason:
//! `mul_add` (a routine in soft double on a Cortex-M4F, other bits than `a * b + c`),
//! `f32::max`/`min` (the sign of a zero differs between debug and release builds), and anything
//! transcendental.
//!
//! A choice that depends on the state goes through [`select`], which always costs the same:
//! a branch would make the number of instructions depend on the data.

/// Square root, correctly rounded. NaN for negative input.
///
/// One instruction, whatever the argument, on x86 with SSE2, AArch64, Arm with an FPU (`eabihf`: Cortex-M4F
/// and up, ARMv7), and WASM; elsewhere `libm`'s routine, with the same bits.
#[inline]
#[must_use]
pub fn sqrt(x: f32) -> f32 {
    cfg_select! {
        all(target_arch = "arm", target_abi = "eabihf") => { vsqrt(x) }
        target_arch = "wasm32" => { wasm_sqrt(x) }
        // With its feature `arch` it is the instruction on x86 and AArch64.
        _ => { libm::sqrtf(x) }
    }
}

/// On WASM `libm` has a routine as long as on a Cortex-M; the compiler's own run-time library, which is always
/// linked, has the instruction, that stable Rust cannot name without `std`.
#[cfg(target_arch = "wasm32")]
#[allow(unsafe_code)]
#[inline]
fn wasm_sqrt(x: f32) -> f32 {
    // SAFETY: that is the signature of C's `sqrtf`, which is defined for every argument.
    unsafe extern "C" {
        safe fn sqrtf(x: f32) -> f32;
    }
    sqrtf(x)
}

/// How many instructions `libm` takes here depends on its argument. Inline assembly cannot name the FPU's
/// registers as operands on stable Rust, so the bits go through a core register.
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
#[allow(unsafe_code)]
#[inline]
fn vsqrt(x: f32) -> f32 {
    let mut bits = x.to_bits();
    // SAFETY: reads and writes nothing but the registers named; `eabihf` targets have an FPU.
    unsafe {
        core::arch::asm!(
            "vmov s0, {0}",
            "vsqrt.f32 s0, s0",
            "vmov {0}, s0",
            inout(reg) bits,
            out("s0") _,
            options(pure, nomem, nostack, preserves_flags),
        );
    }
    f32::from_bits(bits)
}

/// A decision as a bit mask, all ones or all zeros: choosing costs the same either way.
#[derive(Clone, Copy, Debug)]
pub struct Mask(u32);

impl Mask {
    /// The optimiser may not look behind it: it would turn choices into branches (seen with LLVM on
    /// x86-64), whose cost depends on the data. On WASM it may: there hiding takes a trip through memory, and LLVM keeps to the one
    /// instruction that there is for a choice (CI counts).
    #[inline]
    #[must_use]
    pub fn of(condition: bool) -> Self {
        let mask = u32::from(condition).wrapping_neg();
        cfg_select! {
            target_arch = "wasm32" => { Self(mask) }
            _ => { Self(core::hint::black_box(mask)) }
        }
    }

    /// Whether both conditions held.
    #[inline]
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// `yes` if the condition held, else `no`.
    #[inline]
    #[must_use]
    pub fn pick(self, yes: f32, no: f32) -> f32 {
        f32::from_bits((yes.to_bits() & self.0) | (no.to_bits() & !self.0))
    }

    /// `(b, a)` if the condition held, else `(a, b)`.
    #[inline]
    #[must_use]
    pub fn swap(self, a: f32, b: f32) -> (f32, f32) {
        let different = (a.to_bits() ^ b.to_bits()) & self.0;
        (
            f32::from_bits(a.to_bits() ^ different),
            f32::from_bits(b.to_bits() ^ different),
        )
    }

    /// [`Self::pick`] for whole numbers.
    #[inline]
    #[must_use]
    pub fn pick_u32(self, yes: u32, no: u32) -> u32 {
        (yes & self.0) | (no & !self.0)
    }

    /// `x` if the condition held, else 0, also where `x` is NaN.
    #[inline]
    #[must_use]
    pub fn keep(self, x: f32) -> f32 {
        f32::from_bits(x.to_bits() & self.0)
    }
}

/// `yes` if `condition`, else `no`, by a [`Mask`].
#[inline]
#[must_use]
pub fn select(condition: bool, yes: f32, no: f32) -> f32 {
    Mask::of(condition).pick(yes, no)
}

/// [`select`] for three components.
#[inline]
#[must_use]
pub fn select3(condition: bool, yes: [f32; 3], no: [f32; 3]) -> [f32; 3] {
    let mask = Mask::of(condition);
    core::array::from_fn(|axis| mask.pick(yes[axis], no[axis]))
}

/// `numerator / denominator` where `denominator > floor` and the quotient is finite, else 0.
///
/// The one guard of the solver's scalars (CG's α and β, Galerkin coefficients): a breakdown
/// becomes a zero update at the same cost. NaN in either argument gives 0.
#[inline(never)]
#[must_use]
pub fn ratio_or_zero(numerator: f32, denominator: f32, floor: f32) -> f32 {
    ratio(numerator, denominator, floor)
}

/// [`ratio_or_zero`] in place: for loops over nodes.
#[inline(always)]
#[must_use]
pub(crate) fn ratio(numerator: f32, denominator: f32, floor: f32) -> f32 {
    let quotient = numerator / denominator;
    Mask::of((denominator > floor) & quotient.is_finite()).keep(quotient)
}

/// The largest power of two not above `x`, for finite `x ≥ f32::MIN_POSITIVE`; 1 otherwise.
///
/// Scaling by powers of two is exact, so that units change no digit of a result.
#[inline]
#[must_use]
pub fn power_of_two_below(x: f32) -> f32 {
    if x >= f32::MIN_POSITIVE && x.is_finite() {
        f32::from_bits(x.to_bits() & 0x7f80_0000)
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sqrt_is_correctly_rounded() {
        // f64 has more than 2·24 + 2 bits, so rounding its root once more is exact (Figueroa 1995).
        let mut bits = 1_u32;
        while bits < 0x7f80_0000 {
            let x = f32::from_bits(bits);
            assert_eq!(sqrt(x), f64::from(x).sqrt() as f32, "{x:e}");
            bits += 40_503;
        }
        assert!(sqrt(-1.0).is_nan());
        assert_eq!(sqrt(-0.0).to_bits(), (-0.0_f32).to_bits());
    }

    #[test]
    fn select_moves_bits_untouched() {
        for (a, b) in [(-0.0, 0.0), (f32::INFINITY, 1.0), (1e-45, -1e-45)] {
            assert_eq!(select(true, a, b).to_bits(), a.to_bits());
            assert_eq!(select(false, a, b).to_bits(), b.to_bits());
        }
        assert_eq!(select(true, 1.0, f32::NAN), 1.0);
    }

    #[test]
    fn ratios_break_down_to_zero() {
        assert_eq!(ratio_or_zero(6.0, 2.0, 0.0), 3.0);
        for (a, b) in [
            (1.0, 0.0),
            (1.0, -2.0),
            (f32::NAN, 1.0),
            (1.0, f32::NAN),
            (f32::MAX, 1e-30),
        ] {
            assert_eq!(ratio_or_zero(a, b, 0.0), 0.0, "{a} / {b}");
        }
    }

    #[test]
    fn powers_of_two() {
        assert_eq!(power_of_two_below(1.0), 1.0);
        assert_eq!(power_of_two_below(3.9), 2.0);
        assert_eq!(power_of_two_below(0.3), 0.25);
        assert_eq!(power_of_two_below(0.0), 1.0);
        assert_eq!(power_of_two_below(f32::NAN), 1.0);
    }
}
