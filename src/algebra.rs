//! Vectors and 3×3 matrices of lanes: plain arrays, `[R; 3]`, and `[[R; 3]; 3]` by rows.

use crate::lane::Real;

/// Rows of zeros.
#[inline(always)]
pub(crate) fn zero3<R: Real>() -> [R; 3] {
    [R::splat(0.0); 3]
}

/// `f` of each. (`map` of arrays is not always inlined, and then passes vectors through memory.)
#[inline(always)]
pub(crate) fn each3<T, U>([a, b, c]: [T; 3], f: impl Fn(T) -> U) -> [U; 3] {
    [f(a), f(b), f(c)]
}

#[inline(always)]
pub(crate) fn each4<T, U>([a, b, c, d]: [T; 4], f: impl Fn(T) -> U) -> [U; 4] {
    [f(a), f(b), f(c), f(d)]
}

#[inline(always)]
pub(crate) fn dot3<R: Real>(a: &[R; 3], b: &[R; 3]) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn add3<R: Real>(a: &[R; 3], b: &[R; 3]) -> [R; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(crate) fn sub3<R: Real>(a: &[R; 3], b: &[R; 3]) -> [R; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(crate) fn scale3<R: Real>(a: &[R; 3], s: R) -> [R; 3] {
    [a[0] * s, a[1] * s, a[2] * s]
}

#[inline(always)]
pub(crate) fn neg3<R: Real>(a: &[R; 3]) -> [R; 3] {
    [-a[0], -a[1], -a[2]]
}

/// `m v`
#[inline(always)]
pub(crate) fn mul_vec<R: Real>(m: &[[R; 3]; 3], v: &[R; 3]) -> [R; 3] {
    [dot3(&m[0], v), dot3(&m[1], v), dot3(&m[2], v)]
}

/// `mᵀ v`
#[inline(always)]
pub(crate) fn mul_transposed_vec<R: Real>(m: &[[R; 3]; 3], v: &[R; 3]) -> [R; 3] {
    mul_vec(&transpose(m), v)
}

#[inline(always)]
pub(crate) fn transpose<R: Real>(m: &[[R; 3]; 3]) -> [[R; 3]; 3] {
    core::array::from_fn(|i| core::array::from_fn(|j| m[j][i]))
}

/// `a b`
#[inline(always)]
pub(crate) fn mul_mat<R: Real>(a: &[[R; 3]; 3], b: &[[R; 3]; 3]) -> [[R; 3]; 3] {
    let columns = transpose(b);
    core::array::from_fn(|i| core::array::from_fn(|j| dot3(&a[i], &columns[j])))
}
