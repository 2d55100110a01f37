//! The polar decomposition of eight matrices at a time.
//!
//! tr(QᵀF) = qᵀNq/qᵀq for the rotation Q of a quaternion q, with N symmetric and linear in F (Horn, J. Opt.
//! Soc. Am. A 4, 1987): the greatest eigenvalue of N is what the nearest rotation reaches.

use femto::lane::{BLOCK, Lanes};
use femto::polar;
use wide::{f32x4, f32x8};

use super::bytes::Bytes;
use super::inputs::det;

/// `[row][column][lane]`
type Matrices = [[[f32; BLOCK]; 3]; 3];
/// `[component][lane]`
type Quaternions = [[f32; BLOCK]; 4];

const EPSILON: f64 = f32::EPSILON as f64;
/// Magnitudes whose sum is below 256 times the least normal number count as a zero matrix, for which any
/// rotation will do: it can be so far, twice, from the best.
const NOTHING: f64 = 512.0 * f32::MIN_POSITIVE as f64;

pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let sweeps = bytes.below(9) as u32;
    let mut f: Matrices = [[[0.0; BLOCK]; 3]; 3];
    let mut q: Quaternions = [[0.0; BLOCK]; 4];
    for lane in 0..BLOCK {
        f.as_flattened_mut()
            .iter_mut()
            .for_each(|x| x[lane] = bytes.number());
        let start = unit([(); 4].map(|()| bytes.number()));
        q.iter_mut().zip(start).for_each(|(q, x)| q[lane] = x);
    }
    let nearest = nearest_rotations::<f32>(&f);
    let better = sweep::<f32>(&f, &q, sweeps);
    for wide in [
        nearest_rotations::<f32x4>(&f),
        nearest_rotations::<f32x8>(&f),
    ] {
        assert_eq!(bits(&nearest), bits(&wide));
    }
    for wide in [
        sweep::<f32x4>(&f, &q, sweeps),
        sweep::<f32x8>(&f, &q, sweeps),
    ] {
        assert_eq!(bits(&better), bits(&wide));
    }
    for lane in 0..BLOCK {
        let f = f.map(|row| row.map(|x| f64::from(x[lane])));
        let [q, nearest, better] = [&q, &nearest, &better].map(|q| q.map(|x| x[lane]));
        if f.as_flattened().iter().all(|x| x.is_finite()) {
            check_nearest(&f, nearest);
            if q.iter().all(|x| x.is_finite()) {
                check_sweeps(&f, q, better);
            }
        }
    }
}

/// A rotation, and none is nearer.
fn check_nearest(f: &[[f64; 3]; 3], q: [f32; 4]) {
    check_unit(q);
    let n = horn(f);
    let (reached, best) = (trace(&n, q), greatest_eigenvalue(n));
    assert!(
        reached >= best - rounding(f),
        "{f:?}: {q:?} reaches {reached:e} of {best:e}"
    );
}

/// No farther than before.
fn check_sweeps(f: &[[f64; 3]; 3], before: [f32; 4], after: [f32; 4]) {
    check_unit(after);
    let n = horn(f);
    let (had, has) = (trace(&n, before), trace(&n, after));
    assert!(
        has >= had - rounding(f),
        "{f:?}: {before:?} {had:e} became {after:?} {has:e}"
    );
}

/// What rounding may take from a trace: the error of an angle, ε|F| over a sum of two stretches, counts
/// by its square times that sum, so most where the sum itself is ε|F|.
fn rounding(f: &[[f64; 3]; 3]) -> f64 {
    let size = f.as_flattened().iter().map(|x| x * x).sum::<f64>().sqrt();
    NOTHING + 4.0 * EPSILON * size
}

/// A unit quaternion: four roundings of its square, and three more on the way to each component, make
/// ten halves of ε in |q|². The matrix's nine entries have up to four each, and the three of |q| besides.
pub fn check_unit(q: [f32; 4]) {
    let square: f64 = q.iter().map(|&x| f64::from(x) * f64::from(x)).sum();
    assert!(
        (square - 1.0).abs() <= 6.0 * EPSILON,
        "{q:?}: |q|² = {square}"
    );
    let det = det(&polar::matrix(&q).map(|row| row.map(f64::from)));
    assert!((det - 1.0).abs() <= 32.0 * EPSILON, "{q:?}: det Q = {det}");
}

fn nearest_rotations<R: Lanes>(f: &Matrices) -> Quaternions {
    let mut out = [[0.0; BLOCK]; 4];
    for at in (0..BLOCK).step_by(R::WIDTH) {
        let f = f.map(|row| row.map(|x| R::load(&x, at)));
        let q = polar::nearest_rotation(&f);
        q.iter().zip(&mut out).for_each(|(q, out)| q.store(out, at));
    }
    out
}

fn sweep<R: Lanes>(f: &Matrices, q: &Quaternions, sweeps: u32) -> Quaternions {
    let mut out = [[0.0; BLOCK]; 4];
    for at in (0..BLOCK).step_by(R::WIDTH) {
        let f = f.map(|row| row.map(|x| R::load(&x, at)));
        let q = polar::sweeps(&q.map(|x| R::load(&x, at)), &f, sweeps);
        q.iter().zip(&mut out).for_each(|(q, out)| q.store(out, at));
    }
    out
}

/// The payload of a NaN is the machine's.
fn bits(q: &Quaternions) -> [[u32; BLOCK]; 4] {
    q.map(|row| row.map(|x| if x.is_nan() { u32::MAX } else { x.to_bits() }))
}

/// q/|q|; where there is none, NaN: no rotation to start from.
fn unit(q: [f32; 4]) -> [f32; 4] {
    let square: f64 = q.iter().map(|&x| f64::from(x) * f64::from(x)).sum();
    q.map(|x| (f64::from(x) / square.sqrt()) as f32)
}

/// N
fn horn(f: &[[f64; 3]; 3]) -> [[f64; 4]; 4] {
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = *f;
    [
        [xx + yy + zz, zy - yz, xz - zx, yx - xy],
        [zy - yz, xx - yy - zz, xy + yx, xz + zx],
        [xz - zx, xy + yx, yy - xx - zz, yz + zy],
        [yx - xy, xz + zx, yz + zy, zz - xx - yy],
    ]
}

/// qᵀNq/qᵀq
fn trace(n: &[[f64; 4]; 4], q: [f32; 4]) -> f64 {
    let q = q.map(f64::from);
    let dot = |a: &[f64; 4], b: &[f64; 4]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    dot(&n.map(|row| dot(&row, &q)), &q) / dot(&q, &q)
}

/// By Jacobi's method, whose tenth sweep changes nothing in f64.
fn greatest_eigenvalue(mut n: [[f64; 4]; 4]) -> f64 {
    for _ in 0..10 {
        for (p, r) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
            let (sin, cos) = (0.5 * (2.0 * n[p][r]).atan2(n[p][p] - n[r][r])).sin_cos();
            // On columns, then on rows: n is symmetric again after both.
            for _ in 0..2 {
                for row in &mut n {
                    (row[p], row[r]) = (cos * row[p] + sin * row[r], cos * row[r] - sin * row[p]);
                }
                n = [0, 1, 2, 3].map(|i| n.map(|row| row[i]));
            }
        }
    }
    (0..4).fold(f64::NEG_INFINITY, |most, k| most.max(n[k][k]))
}
