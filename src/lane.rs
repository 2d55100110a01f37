//! Lanes: element arithmetic is written once and runs 1, 4 or 8 tetrahedra wide.
//!
//! Tetrahedra are stored in blocks of [`BLOCK`] = 8, component by component, whatever the lane
//! width. A kernel takes a block in 8/WIDTH bites. Every operation is element-wise IEEE, and
//! [`Lanes::scatter_add`] adds tetrahedron by tetrahedron, corner by corner, in the order of the
//! mesh: all widths give the same bits.

use core::ops::{Add, Div, Mul, Neg, Sub};

use wide::{f32x4, f32x8};

use crate::math;

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
    /// Lane by lane, `yes` where `self < bound`, else `no` (also where either is NaN).
    fn where_below(self, bound: Self, yes: Self, no: Self) -> Self;
}

/// Access to blocks and to nodes, `WIDTH` tetrahedra at a time.
pub trait Lanes: Real {
    /// Tetrahedra handled side by side: 1, 4 or 8.
    const WIDTH: usize;
    /// Lanes `at .. at + WIDTH` of a block's component.
    fn load(block: &[f32; BLOCK], at: usize) -> Self;
    /// Writes lanes `at .. at + WIDTH`.
    fn store(self, block: &mut [f32; BLOCK], at: usize);
    /// Node vectors at the four corners: `[corner][axis]`.
    fn gather(vectors: &[[f32; 3]], corners: &[[u32; BLOCK]; 4], at: usize) -> [[Self; 3]; 4];
    /// Adds `values[corner]` to the node vectors, tetrahedron by tetrahedron, corner by corner.
    fn scatter_add(
        values: &[[Self; 3]; 4],
        vectors: &mut [[f32; 3]],
        corners: &[[u32; BLOCK]; 4],
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
    #[inline(always)]
    fn where_below(self, bound: Self, yes: Self, no: Self) -> Self {
        math::select(self < bound, yes, no)
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
    #[inline(always)]
    fn where_below(self, bound: Self, yes: Self, no: Self) -> Self {
        if self < bound { yes } else { no }
    }
}

// Node numbers were checked when the rest data was filled; `get` only keeps panics out of the
// binary, and is as fast as indexing.
#[inline(always)]
fn node(vectors: &[[f32; 3]], index: u32) -> [f32; 3] {
    vectors.get(index as usize).copied().unwrap_or([0.0; 3])
}

impl Lanes for f32 {
    const WIDTH: usize = 1;
    #[inline(always)]
    fn load(block: &[f32; BLOCK], at: usize) -> Self {
        block[at % BLOCK]
    }
    #[inline(always)]
    fn store(self, block: &mut [f32; BLOCK], at: usize) {
        block[at % BLOCK] = self;
    }
    #[inline(always)]
    fn gather(vectors: &[[f32; 3]], corners: &[[u32; BLOCK]; 4], at: usize) -> [[Self; 3]; 4] {
        core::array::from_fn(|c| node(vectors, corners[c][at % BLOCK]))
    }
    #[inline(always)]
    fn scatter_add(
        values: &[[Self; 3]; 4],
        vectors: &mut [[f32; 3]],
        corners: &[[u32; BLOCK]; 4],
        at: usize,
    ) {
        for (value, corner) in values.iter().zip(corners) {
            add(vectors, corner[at % BLOCK], *value);
        }
    }
}

#[inline(always)]
fn add(vectors: &mut [[f32; 3]], index: u32, [x, y, z]: [f32; 3]) {
    if let Some(sum) = vectors.get_mut(index as usize) {
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
        return gather_last(vectors, nodes).map(f32x4::new);
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
fn gather_last(vectors: &[[f32; 3]], nodes: &[u32; 4]) -> [[f32; 4]; 3] {
    let rows = nodes.map(|n| node(vectors, n));
    core::array::from_fn(|axis| rows.map(|row| row[axis]))
}

/// Adds one row a corner.
#[inline(always)]
fn add_rows(vectors: &mut [[f32; 3]], nodes: [u32; 4], rows: [f32x4; 4]) {
    for (node, row) in nodes.into_iter().zip(rows) {
        let [x, y, z, _] = row.to_array();
        add(vectors, node, [x, y, z]);
    }
}

/// Turns the values of four tetrahedra back to rows, so that a node's components are added side by
/// side. Written out: loops over lanes would go through memory.
#[inline(always)]
fn scatter4(values: [[f32x4; 3]; 4], vectors: &mut [[f32; 3]], [i, j, k, l]: [&[u32; 4]; 4]) {
    let turned = |[x, y, z]: [f32x4; 3]| f32x4::transpose([x, y, z, f32x4::ZERO]);
    let [a, b, c, d] = values;
    let ([a0, a1, a2, a3], [b0, b1, b2, b3]) = (turned(a), turned(b));
    let ([c0, c1, c2, c3], [d0, d1, d2, d3]) = (turned(c), turned(d));
    add_rows(vectors, [i[0], j[0], k[0], l[0]], [a0, b0, c0, d0]);
    add_rows(vectors, [i[1], j[1], k[1], l[1]], [a1, b1, c1, d1]);
    add_rows(vectors, [i[2], j[2], k[2], l[2]], [a2, b2, c2, d2]);
    add_rows(vectors, [i[3], j[3], k[3], l[3]], [a3, b3, c3, d3]);
}

/// Four of a block's eight.
#[inline(always)]
fn half<T>(block: &[T; BLOCK], at: usize) -> &[T; 4] {
    let (halves, _) = block.as_chunks::<4>();
    &halves[at / 4 % 2]
}

#[inline(always)]
fn halves(corners: &[[u32; BLOCK]; 4], at: usize) -> [&[u32; 4]; 4] {
    let [a, b, c, d] = corners;
    [half(a, at), half(b, at), half(c, at), half(d, at)]
}

#[inline(always)]
fn gather8(vectors: &[[f32; 3]], nodes: &[u32; BLOCK]) -> [f32x8; 3] {
    let [x, y, z] = gather4(vectors, half(nodes, 0));
    let [u, v, w] = gather4(vectors, half(nodes, 4));
    [join(x, u), join(y, v), join(z, w)]
}

#[inline(always)]
fn join(low: f32x4, high: f32x4) -> f32x8 {
    let ([a, b, c, d], [e, f, g, h]) = (low.to_array(), high.to_array());
    f32x8::new([a, b, c, d, e, f, g, h])
}

#[inline(always)]
fn low([x, y, z]: [f32x8; 3]) -> [f32x4; 3] {
    let low = |x: f32x8| f32x4::new(*half(x.as_array(), 0));
    [low(x), low(y), low(z)]
}

#[inline(always)]
fn high([x, y, z]: [f32x8; 3]) -> [f32x4; 3] {
    let high = |x: f32x8| f32x4::new(*half(x.as_array(), 4));
    [high(x), high(y), high(z)]
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
    #[inline(always)]
    fn where_below(self, bound: Self, yes: Self, no: Self) -> Self {
        self.simd_lt(bound).select(yes, no)
    }
}

impl Lanes for f32x4 {
    const WIDTH: usize = 4;
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
    fn gather(vectors: &[[f32; 3]], corners: &[[u32; BLOCK]; 4], at: usize) -> [[Self; 3]; 4] {
        let [a, b, c, d] = halves(corners, at);
        [
            gather4(vectors, a),
            gather4(vectors, b),
            gather4(vectors, c),
            gather4(vectors, d),
        ]
    }
    #[inline(always)]
    fn scatter_add(
        values: &[[Self; 3]; 4],
        vectors: &mut [[f32; 3]],
        corners: &[[u32; BLOCK]; 4],
        at: usize,
    ) {
        scatter4(*values, vectors, halves(corners, at));
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
    #[inline(always)]
    fn where_below(self, bound: Self, yes: Self, no: Self) -> Self {
        self.simd_lt(bound).select(yes, no)
    }
}

impl Lanes for f32x8 {
    const WIDTH: usize = 8;
    #[inline(always)]
    fn load(block: &[f32; BLOCK], _at: usize) -> Self {
        f32x8::new(*block)
    }
    #[inline(always)]
    fn store(self, block: &mut [f32; BLOCK], _at: usize) {
        *block = self.to_array();
    }
    #[inline(always)]
    fn gather(vectors: &[[f32; 3]], corners: &[[u32; BLOCK]; 4], _at: usize) -> [[Self; 3]; 4] {
        let [a, b, c, d] = corners;
        [
            gather8(vectors, a),
            gather8(vectors, b),
            gather8(vectors, c),
            gather8(vectors, d),
        ]
    }
    #[inline(always)]
    fn scatter_add(
        values: &[[Self; 3]; 4],
        vectors: &mut [[f32; 3]],
        corners: &[[u32; BLOCK]; 4],
        _at: usize,
    ) {
        let [a, b, c, d] = *values;
        scatter4(
            [low(a), low(b), low(c), low(d)],
            vectors,
            halves(corners, 0),
        );
        scatter4(
            [high(a), high(b), high(c), high(d)],
            vectors,
            halves(corners, 4),
        );
    }
}
