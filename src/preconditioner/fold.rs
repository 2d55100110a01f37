//! The stiffness of one tetrahedron as rigid motions of groups of its corners see it.

use crate::algebra::{add3, dot3, mul_vec, neg3, scale3, zero3};
use crate::element::{Dense, Factored, Layout, balanced, edges, stress};
use crate::lane::{Lanes, Real};
use crate::rest::TetBlock;

/// Motions of a rigid body: three translations, and three rotations e × d.
pub(super) const MODES: usize = 6;

/// N e_m of a point at d.
#[inline(always)]
pub(super) fn motion<R: Real>(mode: usize, &[x, y, z]: &[R; 3]) -> [R; 3] {
    let (zero, one) = (R::splat(0.0), R::splat(1.0));
    match mode {
        0 => [one, zero, zero],
        1 => [zero, one, zero],
        2 => [zero, zero, one],
        3 => [zero, -z, y],
        4 => [z, zero, -x],
        _ => [-y, x, zero],
    }
}

/// Nᵀ f: force and torque.
#[inline(always)]
pub(super) fn restricted<R: Real>(d: &[R; 3], f: &[R; 3]) -> [R; MODES] {
    let torque = cross(d, f);
    [f[0], f[1], f[2], torque[0], torque[1], torque[2]]
}

#[inline(always)]
pub(super) fn cross<R: Real>(a: &[R; 3], b: &[R; 3]) -> [R; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Corners that move together: `members` is 1 or 0 for each, `d` their places from the centre.
#[derive(Clone, Copy, Debug)]
pub struct Group<'a, R> {
    /// 1 for a corner of the group, else 0.
    pub members: &'a [R; 4],
    /// Places of the corners from the group's centre.
    pub d: &'a [[R; 3]; 4],
}

/// How a layout multiplies with motions of groups.
pub trait Fold: Sized {
    /// What a group of corners is to the element.
    type Folded<R: Lanes>: Copy;

    /// Folds a group.
    fn fold<R: Lanes>(
        tet: &TetBlock,
        rotated: &<Self as Layout>::Rotated,
        at: usize,
        group: &Group<'_, R>,
    ) -> Self::Folded<R>
    where
        Self: Layout;

    /// N_toᵀ K N_from e_m, times `scale`: force and torque on one group from a motion of another.
    fn response<R: Lanes>(
        tet: &TetBlock,
        rotated: &<Self as Layout>::Rotated,
        at: usize,
        scale: R,
        from: (&Self::Folded<R>, usize),
        to: &Self::Folded<R>,
    ) -> [R; 6]
    where
        Self: Layout;
}

/// With Σ over the corners j of a group, H = Σ u_j G_jᵀ is e gᵀ of a translation, g = Σ G_j, and e × M of a
/// rotation, M = Σ d_j G_jᵀ; force and torque are S g and Σ_c M_c × S_c over columns c. Twelve numbers a group,
/// and a third of the work of a product for each motion.
impl Fold for Factored {
    type Folded<R: Lanes> = ([R; 3], [[R; 3]; 3]);

    #[inline(always)]
    fn fold<R: Lanes>(
        _: &TetBlock,
        rotated: &<Self as Layout>::Rotated,
        at: usize,
        group: &Group<'_, R>,
    ) -> Self::Folded<R> {
        let gradients = balanced(rotated.load::<R>(at));
        let (mut g, mut m) = (zero3(), [zero3(); 3]);
        for ((gradient, d), &member) in gradients.iter().zip(group.d).zip(group.members) {
            let gradient = scale3(gradient, member);
            g = add3(&g, &gradient);
            for (row, &d) in m.iter_mut().zip(d) {
                *row = add3(row, &scale3(&gradient, d));
            }
        }
        (g, m)
    }

    #[inline(always)]
    fn response<R: Lanes>(
        tet: &TetBlock,
        _: &<Self as Layout>::Rotated,
        at: usize,
        scale: R,
        ((g, m), mode): (&Self::Folded<R>, usize),
        (to_g, to_m): &Self::Folded<R>,
    ) -> [R; 6] {
        let zero = zero3();
        let [x, y, z] = m;
        let h = match mode {
            0 => [*g, zero, zero],
            1 => [zero, *g, zero],
            2 => [zero, zero, *g],
            3 => [zero, neg3(z), *y],
            4 => [*z, zero, neg3(x)],
            _ => [neg3(y), *x, zero],
        };
        let lambda = scale * R::load(&tet.lambda_v, at);
        let mu = scale * R::load(&tet.mu_v, at);
        let s = stress(&h, lambda, mu);
        let [fx, fy, fz] = mul_vec(&s, to_g);
        let torque = |a: usize, b: usize| dot3(&to_m[a], &s[b]) - dot3(&to_m[b], &s[a]);
        [fx, fy, fz, torque(1, 2), torque(2, 0), torque(0, 1)]
    }
}

/// Through the product itself.
impl Fold for Dense {
    type Folded<R: Lanes> = ([R; 4], [[R; 3]; 4]);

    #[inline(always)]
    fn fold<R: Lanes>(
        _: &TetBlock,
        _: &<Self as Layout>::Rotated,
        _: usize,
        group: &Group<'_, R>,
    ) -> Self::Folded<R> {
        (*group.members, *group.d)
    }

    #[inline(always)]
    fn response<R: Lanes>(
        tet: &TetBlock,
        rotated: &<Self as Layout>::Rotated,
        at: usize,
        scale: R,
        ((members, d), mode): (&Self::Folded<R>, usize),
        (to_members, to_d): &Self::Folded<R>,
    ) -> [R; 6] {
        let u = core::array::from_fn(|c| scale3(&motion(mode, &d[c]), members[c]));
        let f = balanced(Self::product(tet, rotated, at, scale, &edges(&u)));
        let parts: [_; 4] =
            core::array::from_fn(|c| restricted(&to_d[c], &f[c]).map(|part| part * to_members[c]));
        core::array::from_fn(|m| (parts[0][m] + parts[1][m]) + (parts[2][m] + parts[3][m]))
    }
}
