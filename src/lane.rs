//! Lanes: element arithmetic is written once and runs 1, 4 or 8 tetrahedra wide.
//!
//! Tetrahedra are stored in blocks of [`BLOCK`] = 8, component by component, whatever the lane
//! width. A kernel takes a block in 8/WIDTH bites. Every operation is element-wise IEEE, and
//! [`Lanes::scatter_add`] adds tetrahedron by tetrahedron, corner by corner, in the order of the
//! mesh: all widths give the same bits.
//!
//! Small vectors and matrices of lanes are plain arrays: `[R; 3]`, and `[[R; 3]; 3]` by rows.

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
    /// Adds `values[corner][axis]` to the node vectors, tetrahedron by tetrahedron.
    fn scatter_add<const N: usize>(
        values: &[[Self; N]; 4],
        vectors: &mut [[f32; N]],
        corners: &[[u32; BLOCK]; 4],
        at: usize,
    );
}

/// Rows of zeros.
#[inline]
#[must_use]
pub fn zero3<R: Real>() -> [R; 3] {
    [R::splat(0.0); 3]
}

#[inline]
pub(crate) fn dot3<R: Real>(a: &[R; 3], b: &[R; 3]) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
pub(crate) fn add3<R: Real>(a: &[R; 3], b: &[R; 3]) -> [R; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline]
pub(crate) fn sub3<R: Real>(a: &[R; 3], b: &[R; 3]) -> [R; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline]
pub(crate) fn scale3<R: Real>(a: &[R; 3], s: R) -> [R; 3] {
    [a[0] * s, a[1] * s, a[2] * s]
}

#[inline]
pub(crate) fn neg3<R: Real>(a: &[R; 3]) -> [R; 3] {
    [-a[0], -a[1], -a[2]]
}

/// `m v`
#[inline]
pub(crate) fn mul_vec<R: Real>(m: &[[R; 3]; 3], v: &[R; 3]) -> [R; 3] {
    [dot3(&m[0], v), dot3(&m[1], v), dot3(&m[2], v)]
}

/// `mᵀ v`
#[inline]
pub(crate) fn mul_transposed_vec<R: Real>(m: &[[R; 3]; 3], v: &[R; 3]) -> [R; 3] {
    mul_vec(&transpose(m), v)
}

#[inline]
pub(crate) fn transpose<R: Real>(m: &[[R; 3]; 3]) -> [[R; 3]; 3] {
    core::array::from_fn(|i| core::array::from_fn(|j| m[j][i]))
}

/// `a b`
#[inline]
pub(crate) fn mul_mat<R: Real>(a: &[[R; 3]; 3], b: &[[R; 3]; 3]) -> [[R; 3]; 3] {
    let columns = transpose(b);
    core::array::from_fn(|i| core::array::from_fn(|j| dot3(&a[i], &columns[j])))
}

impl Real for f32 {
    #[inline]
    fn splat(x: f32) -> Self {
        x
    }
    #[inline]
    fn sqrt(self) -> Self {
        math::sqrt(self)
    }
    #[inline]
    fn abs(self) -> Self {
        f32::abs(self)
    }
    #[inline]
    fn where_below(self, bound: Self, yes: Self, no: Self) -> Self {
        math::select(self < bound, yes, no)
    }
}

/// For energies and other diagnostics, which are not part of a step.
impl Real for f64 {
    #[inline]
    fn splat(x: f32) -> Self {
        f64::from(x)
    }
    #[inline]
    fn sqrt(self) -> Self {
        libm::sqrt(self)
    }
    #[inline]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline]
    fn where_below(self, bound: Self, yes: Self, no: Self) -> Self {
        if self < bound { yes } else { no }
    }
}

// Node numbers were checked when the rest data was filled; `get` only keeps panics out of the
// binary, and is as fast as indexing.
#[inline]
fn node(vectors: &[[f32; 3]], index: u32) -> [f32; 3] {
    vectors.get(index as usize).copied().unwrap_or([0.0; 3])
}

impl Lanes for f32 {
    const WIDTH: usize = 1;
    #[inline]
    fn load(block: &[f32; BLOCK], at: usize) -> Self {
        block[at % BLOCK]
    }
    #[inline]
    fn store(self, block: &mut [f32; BLOCK], at: usize) {
        block[at % BLOCK] = self;
    }
    #[inline]
    fn gather(vectors: &[[f32; 3]], corners: &[[u32; BLOCK]; 4], at: usize) -> [[Self; 3]; 4] {
        core::array::from_fn(|c| node(vectors, corners[c][at % BLOCK]))
    }
    #[inline]
    fn scatter_add<const N: usize>(
        values: &[[Self; N]; 4],
        vectors: &mut [[f32; N]],
        corners: &[[u32; BLOCK]; 4],
        at: usize,
    ) {
        for (value, corner) in values.iter().zip(corners) {
            if let Some(sum) = vectors.get_mut(corner[at % BLOCK] as usize) {
                for axis in 0..N {
                    sum[axis] += value[axis];
                }
            }
        }
    }
}

/// Four node vectors, turned to `[axis]` of four lanes.
#[inline]
fn gather4(vectors: &[[f32; 3]], nodes: [u32; 4]) -> [f32x4; 3] {
    let rows = nodes.map(|n| {
        let [x, y, z] = node(vectors, n);
        f32x4::new([x, y, z, 0.0])
    });
    let [x, y, z, _] = f32x4::transpose(rows);
    [x, y, z]
}

#[inline]
fn half<T: Copy>(block: &[T; BLOCK], at: usize) -> [T; 4] {
    let &[a, b, c, d, e, f, g, h] = block;
    if at < 4 { [a, b, c, d] } else { [e, f, g, h] }
}

impl Real for f32x4 {
    #[inline]
    fn splat(x: f32) -> Self {
        f32x4::splat(x)
    }
    #[inline]
    fn sqrt(self) -> Self {
        // Where `wide` has no hardware square root it would take a slow one of its own.
        cfg_select! {
            any(target_feature = "sse2", target_feature = "simd128", target_arch = "aarch64") => { self.sqrt() }
            _ => { f32x4::new(self.to_array().map(math::sqrt)) }
        }
    }
    #[inline]
    fn abs(self) -> Self {
        self.abs()
    }
    #[inline]
    fn where_below(self, bound: Self, yes: Self, no: Self) -> Self {
        self.simd_lt(bound).select(yes, no)
    }
}

impl Lanes for f32x4 {
    const WIDTH: usize = 4;
    #[inline]
    fn load(block: &[f32; BLOCK], at: usize) -> Self {
        f32x4::new(half(block, at))
    }
    #[inline]
    fn store(self, block: &mut [f32; BLOCK], at: usize) {
        let (low, high) = block.split_at_mut(4);
        let side = if at < 4 { low } else { high };
        side.copy_from_slice(self.as_array());
    }
    #[inline]
    fn gather(vectors: &[[f32; 3]], corners: &[[u32; BLOCK]; 4], at: usize) -> [[Self; 3]; 4] {
        core::array::from_fn(|c| gather4(vectors, half(&corners[c], at)))
    }
    #[inline]
    fn scatter_add<const N: usize>(
        values: &[[Self; N]; 4],
        vectors: &mut [[f32; N]],
        corners: &[[u32; BLOCK]; 4],
        at: usize,
    ) {
        scatter_arrays(
            &values.map(|v| v.map(f32x4::to_array)),
            vectors,
            corners,
            at,
        );
    }
}

impl Real for f32x8 {
    #[inline]
    fn splat(x: f32) -> Self {
        f32x8::splat(x)
    }
    #[inline]
    fn sqrt(self) -> Self {
        cfg_select! {
            any(target_feature = "sse2", target_feature = "simd128", target_arch = "aarch64") => { self.sqrt() }
            _ => { f32x8::new(self.to_array().map(math::sqrt)) }
        }
    }
    #[inline]
    fn abs(self) -> Self {
        self.abs()
    }
    #[inline]
    fn where_below(self, bound: Self, yes: Self, no: Self) -> Self {
        self.simd_lt(bound).select(yes, no)
    }
}

impl Lanes for f32x8 {
    const WIDTH: usize = 8;
    #[inline]
    fn load(block: &[f32; BLOCK], _at: usize) -> Self {
        f32x8::new(*block)
    }
    #[inline]
    fn store(self, block: &mut [f32; BLOCK], _at: usize) {
        *block = self.to_array();
    }
    #[inline]
    fn gather(vectors: &[[f32; 3]], corners: &[[u32; BLOCK]; 4], _at: usize) -> [[Self; 3]; 4] {
        core::array::from_fn(|c| {
            let low = gather4(vectors, half(&corners[c], 0));
            let high = gather4(vectors, half(&corners[c], 4));
            core::array::from_fn(|axis| join(low[axis], high[axis]))
        })
    }
    #[inline]
    fn scatter_add<const N: usize>(
        values: &[[Self; N]; 4],
        vectors: &mut [[f32; N]],
        corners: &[[u32; BLOCK]; 4],
        at: usize,
    ) {
        scatter_arrays(
            &values.map(|v| v.map(f32x8::to_array)),
            vectors,
            corners,
            at,
        );
    }
}

#[inline]
fn join(low: f32x4, high: f32x4) -> f32x8 {
    let ([a, b, c, d], [e, f, g, h]) = (low.to_array(), high.to_array());
    f32x8::new([a, b, c, d, e, f, g, h])
}

#[inline]
fn scatter_arrays<const N: usize, const W: usize>(
    values: &[[[f32; W]; N]; 4],
    vectors: &mut [[f32; N]],
    corners: &[[u32; BLOCK]; 4],
    at: usize,
) {
    for lane in 0..W {
        for (value, corner) in values.iter().zip(corners) {
            if let Some(sum) = vectors.get_mut(corner[(at + lane) % BLOCK] as usize) {
                for axis in 0..N {
                    sum[axis] += value[axis][lane];
                }
            }
        }
    }
}
