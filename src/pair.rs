//! Two vectors of lanes that take the same steps: while one waits for a square root or a quotient, the other goes on.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::lane::Real;

/// Two of a kind.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair<R>(pub R, pub R);

impl<R: Add<Output = R>> Add for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}

impl<R: Sub<Output = R>> Sub for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }
}

impl<R: Mul<Output = R>> Mul for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0, self.1 * other.1)
    }
}

impl<R: Div<Output = R>> Div for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0, self.1 / other.1)
    }
}

impl<R: Neg<Output = R>> Neg for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl<R: Real> Real for Pair<R> {
    #[inline(always)]
    fn splat(x: f32) -> Self {
        Self(R::splat(x), R::splat(x))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs(), self.1.abs())
    }
    type Mask = Pair<R::Mask>;
    #[inline(always)]
    fn below(self, bound: Self) -> Self::Mask {
        Pair(self.0.below(bound.0), self.1.below(bound.1))
    }
    #[inline(always)]
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask {
        Pair(R::both(a.0, b.0), R::both(a.1, b.1))
    }
    #[inline(always)]
    fn pick(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self(R::pick(mask.0, yes.0, no.0), R::pick(mask.1, yes.1, no.1))
    }
}
