//! One lane that counts what it does, for what no engine can do without.

use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use femto::lane::{BLOCK, Lanes, Real};

thread_local! {
    static OPERATIONS: Cell<u64> = const { Cell::new(0) };
}

/// Additions, subtractions, multiplications, divisions and square roots so far.
pub fn operations() -> u64 {
    OPERATIONS.get()
}

/// An f32.
#[derive(Clone, Copy)]
pub struct Counted(f32);

fn counted(x: f32) -> Counted {
    OPERATIONS.set(OPERATIONS.get() + 1);
    Counted(x)
}

impl Add for Counted {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        counted(self.0 + other.0)
    }
}

impl Sub for Counted {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        counted(self.0 - other.0)
    }
}

impl Mul for Counted {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        counted(self.0 * other.0)
    }
}

impl Div for Counted {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        counted(self.0 / other.0)
    }
}

/// A sign is a bit: not counted, as are comparisons and choices.
impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Real for Counted {
    type Mask = <f32 as Real>::Mask;
    fn splat(x: f32) -> Self {
        Self(x)
    }
    fn sqrt(self) -> Self {
        counted(Real::sqrt(self.0))
    }
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    fn below(self, bound: Self) -> Self::Mask {
        self.0.below(bound.0)
    }
    fn pick(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self(f32::pick(mask, yes.0, no.0))
    }
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask {
        f32::both(a, b)
    }
}

impl Lanes for Counted {
    const WIDTH: usize = 1;
    type Bites<T: Copy> = [T; BLOCK];
    type Wide = Self;
    fn bites<T: Copy>(make: impl Fn(usize) -> T) -> Self::Bites<T> {
        std::array::from_fn(make)
    }
    fn load(block: &[f32; BLOCK], at: usize) -> Self {
        Self(f32::load(block, at))
    }
    fn store(self, block: &mut [f32; BLOCK], at: usize) {
        self.0.store(block, at);
    }
    fn gather(vectors: &[[f32; 3]], nodes: &[u32; BLOCK], at: usize) -> Option<[Self; 3]> {
        f32::gather(vectors, nodes, at).map(|vector| vector.map(Self))
    }
    fn scatter_add<const N: usize>(
        values: &[Self; N],
        sums: &mut [[f32; N]],
        nodes: &[u32; BLOCK],
        at: usize,
    ) {
        f32::scatter_add(&values.map(|x| counted(x.0).0), sums, nodes, at);
    }
}
