//! The point of a triangle, or of a box, that is nearest to a given one.

use glam::Vec3;

use crate::math::{ratio_or_zero, sqrt};

/// Barycentric coordinates of the point of triangle abc that is nearest to `p` (Ericson, *Real-Time Collision
/// Detection*, 2005, section 5.1.5).
#[inline(never)]
pub(super) fn on_triangle(p: Vec3, [a, b, c]: [Vec3; 3]) -> [f32; 3] {
    let (ab, ac) = (b - a, c - a);
    let ap = p - a;
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let v = ratio_or_zero(d1, d1 - d3, 0.0);
        return [1.0 - v, v, 0.0];
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let w = ratio_or_zero(d2, d2 - d6, 0.0);
        return [1.0 - w, 0.0, w];
    }
    let va = d3 * d6 - d5 * d4;
    let (along, back) = (d4 - d3, d5 - d6);
    if va <= 0.0 && along >= 0.0 && back >= 0.0 {
        let w = ratio_or_zero(along, along + back, 0.0);
        return [0.0, 1.0 - w, w];
    }
    // All positive, but for rounding in slivers: the point must not leave the triangle.
    let [va, vb, vc] = [va, vb, vc].map(|x| if x > 0.0 { x } else { 0.0 });
    let sum = va + vb + vc;
    let (v, w) = (ratio_or_zero(vb, sum, 0.0), ratio_or_zero(vc, sum, 0.0));
    [1.0 - v - w, v, w]
}

/// Signed distance and outward normal of a box of half sides `half` at the origin.
#[inline(never)]
pub(super) fn box_distance(p: Vec3, half: Vec3) -> (f32, Vec3) {
    let q = p.abs() - half;
    let side = Vec3::new(sign(p.x), sign(p.y), sign(p.z));
    let positive = |x: f32| if x > 0.0 { x } else { 0.0 };
    let out = Vec3::new(positive(q.x), positive(q.y), positive(q.z));
    let length = sqrt(out.dot(out));
    if length > 0.0 {
        return (length, out * side / length);
    }
    if q.x >= q.y && q.x >= q.z {
        (q.x, Vec3::X * side.x)
    } else if q.y >= q.z {
        (q.y, Vec3::Y * side.y)
    } else {
        (q.z, Vec3::Z * side.z)
    }
}

fn sign(x: f32) -> f32 {
    if x < 0.0 { -1.0 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers in [−1, 1), from the high bits of a congruential generator.
    fn numbers() -> impl FnMut() -> f32 {
        let mut state = 7_u64;
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / (1 << 23) as f32 - 1.0
        }
    }

    #[test]
    fn no_point_of_the_triangle_is_nearer() {
        let mut number = numbers();
        let mut point = |size: f32| Vec3::new(number(), number(), number()) * size;
        for _ in 0..2_000 {
            let triangle = [point(1.0), point(1.0), point(1.0)];
            let p = point(2.0);
            let at = |w: [f32; 3]| triangle[0] * w[0] + triangle[1] * w[1] + triangle[2] * w[2];
            let weights = on_triangle(p, triangle);
            assert!(
                weights.iter().all(|w| (-1e-6..=1.0 + 1e-6).contains(w)),
                "{weights:?}"
            );
            assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6);
            let found = (p - at(weights)).length();
            for i in 0..=20 {
                for j in 0..=20 - i {
                    let (u, v) = (i as f32 / 20.0, j as f32 / 20.0);
                    let other = (p - at([u, v, 1.0 - u - v])).length();
                    assert!(found < other + 2e-5, "{found} {other} {triangle:?} {p}");
                }
            }
        }
    }

    #[test]
    fn a_step_along_the_normal_ends_on_the_box() {
        let mut number = numbers();
        let half = Vec3::new(0.5, 0.3, 0.8);
        for _ in 0..10_000 {
            let p = Vec3::new(number(), number(), number()) * 2.0;
            let (gap, normal) = box_distance(p, half);
            assert!((normal.length() - 1.0).abs() < 1e-6);
            let (left, _) = box_distance(p - normal * gap, half);
            assert!(left.abs() < 1e-6, "{p} {gap} {normal} {left}");
            let inside = p.abs().cmplt(half).all();
            assert_eq!(gap < 0.0, inside, "{p}");
        }
    }
}
