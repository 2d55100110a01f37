//! Lanes: element arithmetic is written once and runs 1, 4 or 8 tetrahedra wide.
//!
//! Tetrahedra are stored in blocks of [`BLOCK`] = 8, component by component, whatever the lane
//! width. A kernel takes a block in 8/WIDTH bites. Every operation is element-wise IEEE, and kernels
//! call [`Lanes::scatter_add`] corner by corner for all bites of a block, which adds lane by lane:
//! all widths give the same bits.

use core::ops::{Add, Div, Mul, Neg, Sub};

use wide::{f32x4, f32x8};

use crate::algebra::each3;
use crate::math::{self, Mask};
use crate::stages::fence;

/// Tetrahedra in one storage block.
pub const BLOCK: usize = 8;

/// Number of storage blocks for so many tetrahedra.
#[must_use]
pub const fn blocks(tets: usize) -> usize {
    tets.div_ceil(BLOCK)
}

/// The lane type that this build uses: 8 wide with AVX, 4 with SSE2, NEON or simd128, else 1.
/// The features `lanes-1`, `lanes-4` and `lanes-8` force it.
pub type Native = native::Native;

mod native {
    #[cfg(any(
        all(feature = "lanes-1", feature = "lanes-4"),
        all(feature = "lanes-1", feature = "lanes-8"),
        all(feature = "lanes-4", feature = "lanes-8"),
    ))]
    compile_error!("at most one of the features lanes-1, lanes-4 and lanes-8 can be on");

    cfg_select! {
        feature = "lanes-1" => { pub type Native = f32; }
        feature = "lanes-4" => { pub type Native = wide::f32x4; }
        feature = "lanes-8" => { pub type Native = wide::f32x8; }
        target_feature = "avx" => { pub type Native = wide::f32x8; }
        any(
            target_feature = "sse2",
            target_feature = "simd128",
            all(target_arch = "aarch64", target_feature = "neon"),
        ) => { pub type Native = wide::f32x4; }
        _ => { pub type Native = f32; }
    }
}

/// Arithmetic that a kernel may use, on one number or on several side by side.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The same number in every lane.
    fn splat(x: f32) -> Self;
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
    /// Magnitude.
    fn abs(self) -> Self;
    /// A decision in every lane.
    type Mask: Copy;
    /// Where `self < bound`; not where either is NaN.
    fn below(self, bound: Self) -> Self::Mask;
    /// Where both hold.
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Lane by lane, `yes` where the mask holds, else `no`.
    fn pick(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Lane by lane, `(b, a)` where the mask holds, else `(a, b)`.
    #[inline(always)]
    fn swap(mask: Self::Mask, a: Self, b: Self) -> (Self, Self) {
        (Self::pick(mask, b, a), Self::pick(mask, a, b))
    }
    /// Lane by lane, `yes` where `self < bound`, else `no` (also where either is NaN).
    #[inline(always)]
    fn where_below(self, bound: Self, yes: Self, no: Self) -> Self {
        Self::pick(self.below(bound), yes, no)
    }
}

/// Access to blocks and to nodes, `WIDTH` tetrahedra at a time.
pub trait Lanes: Real {
    /// Tetrahedra handled side by side: 1, 4 or 8.
    const WIDTH: usize;
    /// One for each bite of a block: `BLOCK / WIDTH` of them.
    type Bites<T: Copy>: AsRef<[T]> + AsMut<[T]>;
    /// The lanes for long chains of arithmetic on few numbers: wider, where the processor would wait.
    type Wide: Lanes;
    /// Whether such a chain is better taken for two blocks at once. With sixteen registers of four lanes, eight lanes are two
    /// already, and one lane has too few.
    const TWO: bool = false;
    /// Whether a block's bites are better taken side by side, one stage of a kernel after the other. An engine's code of
    /// one lane waits for its own results, unless the next bite's are there to work on; more lanes have others, and a
    /// microcontroller has nothing to wait for.
    const STAGES: bool = false;
    /// `make` of each bite's first lane.
    fn bites<T: Copy>(make: impl Fn(usize) -> T) -> Self::Bites<T>;
    /// Lanes `at .. at + WIDTH` of a block's component.
    fn load(block: &[f32; BLOCK], at: usize) -> Self;
    /// Writes lanes `at .. at + WIDTH`.
    fn store(self, block: &mut [f32; BLOCK], at: usize);
    /// The vectors of nodes `nodes[at .. at + WIDTH]`, `[axis]`. Where there is no such node: none in one lane, zeros
    /// in one of several.
    fn gather(vectors: &[[f32; 3]], nodes: &[u32; BLOCK], at: usize) -> Option<[Self; 3]>;
    /// Whether `vectors` has all of the nodes `nodes[at .. at + WIDTH]`.
    #[inline(always)]
    fn has<T>(vectors: &[T], nodes: &[u32; BLOCK], at: usize) -> bool {
        let mut nodes = nodes.iter().skip(at).take(Self::WIDTH);
        nodes.all(|&node| (node as usize) < vectors.len())
    }
    /// [`Self::scatter_add`] of what `value` makes for each number. One lane makes them one by one: in an
    /// engine, what one needs is then read after what comes of the one before is written (see [`Self::STAGES`]).
    #[inline(always)]
    fn scatter_add_each<const N: usize>(
        value: impl FnMut(usize) -> Self,
        sums: &mut [[f32; N]],
        nodes: &[u32; BLOCK],
        at: usize,
    ) {
        Self::scatter_add(&core::array::from_fn(value), sums, nodes, at);
    }
    /// Adds `values` to the numbers of nodes `nodes[at .. at + WIDTH]`, one lane after the other; three or six a node.
    fn scatter_add<const N: usize>(
        values: &[Self; N],
        sums: &mut [[f32; N]],
        nodes: &[u32; BLOCK],
        at: usize,
    );
}

impl Real for f32 {
    #[inline(always)]
    fn splat(x: f32) -> Self {
        x
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        math::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f32::abs(self)
    }
    type Mask = Mask;
    #[inline(always)]
    fn below(self, bound: Self) -> Mask {
        Mask::of(self < bound)
    }
    #[inline(always)]
    fn both(a: Mask, b: Mask) -> Mask {
        a.and(b)
    }
    #[inline(always)]
    fn pick(mask: Mask, yes: Self, no: Self) -> Self {
        mask.pick(yes, no)
    }
    #[inline(always)]
    fn swap(mask: Mask, a: Self, b: Self) -> (Self, Self) {
        cfg_select! {
            target_arch = "wasm32" => { (mask.pick(b, a), mask.pick(a, b)) }
            _ => { mask.swap(a, b) }
        }
    }
}

/// For energies and other diagnostics, which are not part of a step.
impl Real for f64 {
    #[inline(always)]
    fn splat(x: f32) -> Self {
        f64::from(x)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        libm::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    type Mask = bool;
    #[inline(always)]
    fn below(self, bound: Self) -> bool {
        self < bound
    }
    #[inline(always)]
    fn both(a: bool, b: bool) -> bool {
        a & b
    }
    #[inline(always)]
    fn pick(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

// Node numbers were checked when the rest data was filled; `get` only keeps panics out of the
// binary, and is as fast as indexing.
#[inline(always)]
fn node(vectors: &[[f32; 3]], index: u32) -> [f32; 3] {
    // A choice of two places to read from: zeros made ready before every check would cost more.
    *vectors.get(index as usize).unwrap_or(&[0.0; 3])
}

impl Lanes for f32 {
    const WIDTH: usize = 1;
    type Bites<T: Copy> = [T; BLOCK];
    type Wide = f32;
    const STAGES: bool = cfg!(target_arch = "wasm32");
    #[inline(always)]
    fn bites<T: Copy>(make: impl Fn(usize) -> T) -> Self::Bites<T> {
        core::array::from_fn(make)
    }
    #[inline(always)]
    fn load(block: &[f32; BLOCK], at: usize) -> Self {
        block[at % BLOCK]
    }
    #[inline(always)]
    fn store(self, block: &mut [f32; BLOCK], at: usize) {
        block[at % BLOCK] = self;
    }
    #[inline(always)]
    fn gather(vectors: &[[f32; 3]], nodes: &[u32; BLOCK], at: usize) -> Option<[Self; 3]> {
        vectors.get(nodes[at % BLOCK] as usize).copied()
    }
    #[inline(always)]
    fn scatter_add<const N: usize>(
        values: &[Self; N],
        sums: &mut [[f32; N]],
        nodes: &[u32; BLOCK],
        at: usize,
    ) {
        Self::scatter_add_each(|k| values[k % N], sums, nodes, at);
    }
    #[inline(always)]
    fn scatter_add_each<const N: usize>(
        mut value: impl FnMut(usize) -> Self,
        sums: &mut [[f32; N]],
        nodes: &[u32; BLOCK],
        at: usize,
    ) {
        if let Some(sums) = sums.get_mut(nodes[at % BLOCK] as usize) {
            for (k, sum) in sums.iter_mut().enumerate() {
                *sum += value(k);
                if Self::STAGES {
                    fence();
                }
            }
        }
    }
}

/// Adds to the numbers 3k, 3k + 1 and 3k + 2 of a node.
#[inline(always)]
fn add<const N: usize>(sums: &mut [[f32; N]], node: u32, k: usize, [x, y, z]: [f32; 3]) {
    let of_node = sums.get_mut(node as usize);
    if let Some(sum) = of_node.and_then(|sums| sums.as_chunks_mut::<3>().0.get_mut(k)) {
        sum[0] += x;
        sum[1] += y;
        sum[2] += z;
    }
}

/// A node vector and the first number of the next one.
#[inline(always)]
fn four(vectors: &[[f32; 3]], index: u32) -> Option<&[f32; 4]> {
    let n = index as usize;
    vectors.get(n..n + 2)?.as_flattened().first_chunk()
}

/// Four node vectors, turned to `[axis]` of four lanes.
#[inline(always)]
fn gather4(vectors: &[[f32; 3]], nodes: &[u32; 4]) -> [f32x4; 3] {
    let &[a, b, c, d] = nodes;
    let (Some(a), Some(b), Some(c), Some(d)) = (
        four(vectors, a),
        four(vectors, b),
        four(vectors, c),
        four(vectors, d),
    ) else {
        return gather_last(vectors, nodes).0.map(f32x4::new);
    };
    let rows = [
        f32x4::new(*a),
        f32x4::new(*b),
        f32x4::new(*c),
        f32x4::new(*d),
    ];
    let [x, y, z, _] = f32x4::transpose(rows);
    [x, y, z]
}

/// Where one of them is the last of all.
#[cold]
#[inline(never)]
fn gather_last(vectors: &[[f32; 3]], nodes: &[u32; 4]) -> Turned {
    let rows = nodes.map(|n| node(vectors, n));
    Turned(core::array::from_fn(|axis| rows.map(|row| row[axis])))
}

/// `[axis][lane]`. Whoever holds it has an aligned stack: else half of the eight lanes that a loop keeps there would
/// lie across two lines of the cache.
#[cfg_attr(target_feature = "avx", repr(align(32)))]
struct Turned([[f32; 4]; 3]);

/// Turns four lanes back to rows, so that a node's numbers 3k, 3k + 1 and 3k + 2 are added side by side. Written
/// out: loops over lanes would go through memory.
#[inline(always)]
fn scatter4<const N: usize>(
    [x, y, z]: [f32x4; 3],
    sums: &mut [[f32; N]],
    k: usize,
    nodes: &[u32; 4],
) {
    let [a, b, c, d] = f32x4::transpose([x, y, z, f32x4::ZERO]);
    let row = |row: f32x4| {
        let [x, y, z, _] = row.to_array();
        [x, y, z]
    };
    add(sums, nodes[0], k, row(a));
    add(sums, nodes[1], k, row(b));
    add(sums, nodes[2], k, row(c));
    add(sums, nodes[3], k, row(d));
}

/// Four of a block's eight.
#[inline(always)]
fn half<T>(block: &[T; BLOCK], at: usize) -> &[T; 4] {
    let (halves, _) = block.as_chunks::<4>();
    &halves[at / 4 % 2]
}

#[inline(always)]
fn join(low: f32x4, high: f32x4) -> f32x8 {
    bytemuck::cast([low, high])
}

impl Real for f32x4 {
    #[inline(always)]
    fn splat(x: f32) -> Self {
        f32x4::splat(x)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // Where `wide` has no hardware square root it would take a slow one of its own.
        cfg_select! {
            any(target_feature = "sse2", target_feature = "simd128", target_arch = "aarch64") => { self.sqrt() }
            _ => { f32x4::new(self.to_array().map(math::sqrt)) }
        }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }
    type Mask = Self;
    #[inline(always)]
    fn below(self, bound: Self) -> Self {
        self.simd_lt(bound)
    }
    #[inline(always)]
    fn both(a: Self, b: Self) -> Self {
        a & b
    }
    #[inline(always)]
    fn pick(mask: Self, yes: Self, no: Self) -> Self {
        mask.select(yes, no)
    }
}

impl Lanes for f32x4 {
    const WIDTH: usize = 4;
    type Bites<T: Copy> = [T; BLOCK / 4];
    type Wide = f32x8;
    #[inline(always)]
    fn bites<T: Copy>(make: impl Fn(usize) -> T) -> Self::Bites<T> {
        [make(0), make(4)]
    }
    #[inline(always)]
    fn load(block: &[f32; BLOCK], at: usize) -> Self {
        f32x4::new(*half(block, at))
    }
    #[inline(always)]
    fn store(self, block: &mut [f32; BLOCK], at: usize) {
        let (low, high) = block.split_at_mut(4);
        let side = if at < 4 { low } else { high };
        side.copy_from_slice(self.as_array());
    }
    #[inline(always)]
    fn gather(vectors: &[[f32; 3]], nodes: &[u32; BLOCK], at: usize) -> Option<[Self; 3]> {
        Some(gather4(vectors, half(nodes, at)))
    }
    #[inline(always)]
    fn scatter_add<const N: usize>(
        values: &[Self; N],
        sums: &mut [[f32; N]],
        nodes: &[u32; BLOCK],
        at: usize,
    ) {
        for (k, values) in values.as_chunks::<3>().0.iter().enumerate() {
            scatter4(*values, sums, k, half(nodes, at));
        }
    }
}

impl Real for f32x8 {
    #[inline(always)]
    fn splat(x: f32) -> Self {
        f32x8::splat(x)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        cfg_select! {
            any(target_feature = "sse2", target_feature = "simd128", target_arch = "aarch64") => { self.sqrt() }
            _ => { f32x8::new(self.to_array().map(math::sqrt)) }
        }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }
    type Mask = Self;
    #[inline(always)]
    fn below(self, bound: Self) -> Self {
        self.simd_lt(bound)
    }
    #[inline(always)]
    fn both(a: Self, b: Self) -> Self {
        a & b
    }
    #[inline(always)]
    fn pick(mask: Self, yes: Self, no: Self) -> Self {
        mask.select(yes, no)
    }
}

impl Lanes for f32x8 {
    const WIDTH: usize = 8;
    type Bites<T: Copy> = [T; 1];
    type Wide = f32x8;
    const TWO: bool = cfg!(target_feature = "avx");
    #[inline(always)]
    fn bites<T: Copy>(make: impl Fn(usize) -> T) -> Self::Bites<T> {
        [make(0)]
    }
    #[inline(always)]
    fn load(block: &[f32; BLOCK], _at: usize) -> Self {
        f32x8::new(*block)
    }
    #[inline(always)]
    fn store(self, block: &mut [f32; BLOCK], _at: usize) {
        *block = self.to_array();
    }
    #[inline(always)]
    fn gather(vectors: &[[f32; 3]], nodes: &[u32; BLOCK], _at: usize) -> Option<[Self; 3]> {
        let [x, y, z] = gather4(vectors, half(nodes, 0));
        let [u, v, w] = gather4(vectors, half(nodes, 4));
        Some([join(x, u), join(y, v), join(z, w)])
    }
    #[inline(always)]
    fn scatter_add<const N: usize>(
        values: &[Self; N],
        sums: &mut [[f32; N]],
        nodes: &[u32; BLOCK],
        _at: usize,
    ) {
        for (k, values) in values.as_chunks::<3>().0.iter().enumerate() {
            let [[x, u], [y, v], [z, w]] = each3(*values, bytemuck::cast::<f32x8, [f32x4; 2]>);
            scatter4([x, y, z], sums, k, half(nodes, 0));
            scatter4([u, v, w], sums, k, half(nodes, 4));
        }
    }
}
