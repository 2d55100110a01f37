//! One tetrahedron: deformation gradient, stress, forces, and its rotated stiffness blocks.
//!
//! ```text
//! F   = Σ_j (x_j − x_0) g_jᵀ                                    deformation gradient
//! ε   = sym(QᵀF) − I,   σ = λ tr(ε) I + 2 μ ε                   corotated strain, Hooke
//! f_i = −V Q σ g_i                                              elastic force on corner i
//! K_ij = V Q [λ g_i g_jᵀ + μ (g_i·g_j) I + μ g_j g_iᵀ] Qᵀ       stiffness, positive semidefinite
//! ```
//!
//! Sign convention: f = −K u for a displacement u from the rotated rest shape. Dahl and Bargteil
//! (MIG 2019) use the negative semidefinite K, and their Eq. (8) has 1/(36v) where differentiating
//! their Eq. (6), with the area-weighted normals n_i = −3V g_i of their text, gives 1/(9v): typed
//! in as printed, a body is four times too soft. Here everything goes through g_i.
//!
//! Two [`Layout`]s hold K. [`Factored`] stores the rotated gradients G_i = Q g_i and multiplies by
//!
//! ```text
//! H = Σ_{j=1..3} (u_j − u_0) G_jᵀ;   S = λV tr(H) I + μV (H + Hᵀ);   (K u)_i = S G_i
//! ```
//!
//! which is the same matrix in 36 bytes. [`Dense`] stores the six blocks above the diagonal (rows
//! sum to zero), 216 bytes, and carries *any* linear elastic material. (For an isotropic one the force
//! is exactly the slope of the energy, rotations included. For an anisotropic one it is the slope at
//! frozen rotations, as in every corotated method: σ and S do not commute.)

use crate::algebra::{
    add3, dot3, each3, each4, mul_mat, mul_transposed_vec, mul_vec, neg3, scale3, sub3, transpose,
    zero3,
};
use crate::lane::{BLOCK, Lanes, Real};
use crate::preconditioner::fold::Fold;
use crate::rest::TetBlock;
use crate::stages::Stages;

/// Symmetric 3×3 matrix: xx, xy, xz, yy, yz, zz.
pub type Sym3<R> = [R; 6];

/// How a tetrahedron's rotated stiffness is stored and applied.
pub trait Layout: Fold + Stages + Sized + 'static {
    /// What the layout keeps per block of eight at rest, besides [`TetBlock`].
    type Stiffness: Copy + core::fmt::Debug + 'static;
    /// What it writes per block each step.
    type Rotated: Copy + core::fmt::Debug;
    /// No stiffness.
    const ZERO_STIFFNESS: Self::Stiffness;
    /// Scratch before the first step.
    const ZERO_ROTATED: Self::Rotated;

    /// Rest stiffness of the isotropic material that the block holds.
    fn isotropic(tet: &TetBlock) -> Self::Stiffness;

    /// Writes the rotated blocks of lanes `at..` and returns the elastic forces on corners 1, 2, 3, times −`scale` and
    /// the square of `unit`, which makes the blocks dimensionless in length. Corner 0 balances them.
    fn rotate<R: Lanes>(
        bite: &Bite<'_, Self, R>,
        q: &[[R; 3]; 3],
        unit: Unit<R>,
        scale: R,
        rotated: &mut Self::Rotated,
    ) -> [[R; 3]; 3];

    /// Multiplies with the rotated blocks: `scale` · K u at corners 1, 2, 3, `[corner − 1][axis]`, given
    /// the edges u_j − u_0; corner 0 balances them.
    fn product<R: Lanes>(
        tet: &TetBlock,
        rotated: &Self::Rotated,
        at: usize,
        scale: R,
        edges: &[[R; 3]; 3],
    ) -> [[R; 3]; 3];

    /// The four diagonal blocks of `scale` · K.
    fn diagonal<R: Lanes>(
        tet: &TetBlock,
        rotated: &Self::Rotated,
        at: usize,
        scale: R,
    ) -> [Sym3<R>; 4];

    /// Elastic energy of lane `at` in joules, given Q.
    fn energy(bite: &Bite<'_, Self, f64>, q: &[[f64; 3]; 3]) -> f64;
}

/// The body's unit of length in metres, a power of two.
#[derive(Clone, Copy, Debug)]
pub struct Unit<R> {
    /// The unit.
    pub length: R,
    /// The same where a tetrahedron is whole, else 0.
    pub share: R,
}

/// Some tetrahedra of a block in some state.
#[derive(Debug)]
pub struct Bite<'a, L: Layout, R> {
    /// The block.
    pub tet: &'a TetBlock,
    /// Its stored stiffness.
    pub stiffness: &'a L::Stiffness,
    /// First lane.
    pub at: usize,
    /// Edges x_j − x_0 (j = 1, 2, 3), metres.
    pub edges: [[R; 3]; 3],
    /// Edges X_j − X_0 at rest, metres.
    pub rest_edges: [[R; 3]; 3],
}

/// x_j − x_0 for j = 1, 2, 3.
#[inline(always)]
pub(crate) fn edges<R: Real>(x: &[[R; 3]; 4]) -> [[R; 3]; 3] {
    [sub3(&x[1], &x[0]), sub3(&x[2], &x[0]), sub3(&x[3], &x[0])]
}

/// The gradients g₁, g₂, g₃ of lanes `at..`.
#[inline(always)]
pub(crate) fn gradients<R: Lanes>(tet: &TetBlock, at: usize) -> [[R; 3]; 3] {
    core::array::from_fn(|j| core::array::from_fn(|a| R::load(&tet.gradients[j][a], at)))
}

/// F = Σ_j (x_j − x_0) g_jᵀ
#[inline(always)]
pub(crate) fn deformation<R: Real>(edges: &[[R; 3]; 3], g: &[[R; 3]; 3]) -> [[R; 3]; 3] {
    mul_mat(&transpose(edges), g)
}

/// ε = sym(B) − I with B = QᵀF
#[inline(always)]
fn strain<R: Real>(b: &[[R; 3]; 3]) -> [[R; 3]; 3] {
    let (one, half) = (R::splat(1.0), R::splat(0.5));
    let (xy, xz, yz) = (
        half * (b[0][1] + b[1][0]),
        half * (b[0][2] + b[2][0]),
        half * (b[1][2] + b[2][1]),
    );
    [
        [b[0][0] - one, xy, xz],
        [xy, b[1][1] - one, yz],
        [xz, yz, b[2][2] - one],
    ]
}

/// S = λ tr(H) I + μ (H + Hᵀ)
#[inline(always)]
pub(crate) fn stress<R: Real>(h: &[[R; 3]; 3], lambda: R, mu: R) -> [[R; 3]; 3] {
    let pressure = lambda * (h[0][0] + h[1][1] + h[2][2]);
    let twice = mu + mu;
    let [xx, yy, zz] = each3([0, 1, 2], |a| pressure + twice * h[a][a]);
    let [xy, xz, yz] = each3([(0, 1), (0, 2), (1, 2)], |(a, b)| mu * (h[a][b] + h[b][a]));
    [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
}

/// The fourth corner balances the other three.
#[inline(always)]
pub(crate) fn balanced<R: Real>(f: [[R; 3]; 3]) -> [[R; 3]; 4] {
    [neg3(&add3(&add3(&f[0], &f[1]), &f[2])), f[0], f[1], f[2]]
}

/// Rotated gradients and two scalars: the default, for isotropic materials.
#[derive(Clone, Copy, Debug)]
pub enum Factored {}

/// G₁, G₂, G₃ of eight tetrahedra, `[corner − 1][axis][lane]`, in units of 1/`length_unit`.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct RotatedGradients(pub(crate) [[[f32; BLOCK]; 3]; 3]);

impl RotatedGradients {
    #[inline(always)]
    pub(crate) fn load<R: Lanes>(&self, at: usize) -> [[R; 3]; 3] {
        core::array::from_fn(|j| core::array::from_fn(|a| R::load(&self.0[j][a], at)))
    }

    /// G_j of corner j = 1, 2, 3.
    #[inline(always)]
    pub(crate) fn of<R: Lanes>(&self, corner: usize, at: usize) -> [R; 3] {
        // Only to keep the panic of an index out of the binary.
        let g = &self.0[(corner - 1) % 3];
        core::array::from_fn(|a| R::load(&g[a], at))
    }
}

impl Factored {
    /// Writes G_j = Q g_j, and returns it.
    #[inline(always)]
    pub(crate) fn rotate_gradients<R: Lanes>(
        tet: &TetBlock,
        q: &[[R; 3]; 3],
        unit: Unit<R>,
        at: usize,
        rotated: &mut RotatedGradients,
    ) -> [[R; 3]; 3] {
        let mut all = gradients::<R>(tet, at);
        for (g, out) in all.iter_mut().zip(&mut rotated.0) {
            *g = scale3(&mul_vec(q, g), unit.share);
            for (g, out) in g.iter().zip(out) {
                g.store(out, at);
            }
        }
        all
    }

    /// `scale` · V S from H.
    #[inline(always)]
    pub(crate) fn scaled_stress<R: Lanes>(
        tet: &TetBlock,
        at: usize,
        scale: R,
        h: &[[R; 3]; 3],
    ) -> [[R; 3]; 3] {
        let lambda = scale * R::load(&tet.lambda_v, at);
        let mu = scale * R::load(&tet.mu_v, at);
        stress(h, lambda, mu)
    }
}

impl Layout for Factored {
    type Stiffness = ();
    type Rotated = RotatedGradients;
    const ZERO_STIFFNESS: () = ();
    const ZERO_ROTATED: RotatedGradients = RotatedGradients([[[0.0; BLOCK]; 3]; 3]);

    fn isotropic(_: &TetBlock) {}

    #[inline(always)]
    fn rotate<R: Lanes>(
        bite: &Bite<'_, Self, R>,
        q: &[[R; 3]; 3],
        unit: Unit<R>,
        scale: R,
        rotated: &mut Self::Rotated,
    ) -> [[R; 3]; 3] {
        let g = Self::rotate_gradients(bite.tet, q, unit, bite.at, rotated);
        // In world axes: FQᵀ = Σ_j (x_j − x_0) G_jᵀ, and f = −V (QσQᵀ) G.
        let mut h = deformation(&bite.edges, &g);
        for axis in 0..3 {
            h[axis][axis] = h[axis][axis] - unit.length;
        }
        let s = Self::scaled_stress(bite.tet, bite.at, scale, &h);
        each3(g, |g| mul_vec(&s, &g))
    }

    #[inline(always)]
    fn product<R: Lanes>(
        tet: &TetBlock,
        rotated: &Self::Rotated,
        at: usize,
        scale: R,
        edges: &[[R; 3]; 3],
    ) -> [[R; 3]; 3] {
        let g = rotated.load::<R>(at);
        let h = deformation(edges, &g); // H = Σ (u_j − u_0) G_jᵀ
        let s = Self::scaled_stress(tet, at, scale, &h);
        each3(g, |g| mul_vec(&s, &g)) // (K u)_i = S G_i
    }

    #[inline(always)]
    fn diagonal<R: Lanes>(
        tet: &TetBlock,
        rotated: &Self::Rotated,
        at: usize,
        scale: R,
    ) -> [Sym3<R>; 4] {
        let g = balanced(rotated.load::<R>(at)); // G_0 = −ΣG_j
        let mu = scale * R::load(&tet.mu_v, at);
        let both = mu + scale * R::load(&tet.lambda_v, at);
        // K_ii = (λ + μ)V G Gᵀ + μV |G|² I
        each4(g, |g| {
            let isotropic = mu * dot3(&g, &g);
            let w = scale3(&g, both);
            [
                w[0] * g[0] + isotropic,
                w[0] * g[1],
                w[0] * g[2],
                w[1] * g[1] + isotropic,
                w[1] * g[2],
                w[2] * g[2] + isotropic,
            ]
        })
    }

    /// V (μ |ε|² + λ/2 tr(ε)²)
    fn energy(bite: &Bite<'_, Self, f64>, q: &[[f64; 3]; 3]) -> f64 {
        let lane = |block: &[f32; BLOCK]| f64::from(block[bite.at % BLOCK]);
        let g = bite.tet.gradients.map(|g| g.map(|axis| lane(&axis)));
        let e = strain(&mul_mat(&transpose(q), &deformation(&bite.edges, &g)));
        let trace = e[0][0] + e[1][1] + e[2][2];
        let square: f64 = e
            .iter()
            .flatten()
            .map(|x| x * x)
            .fold(0.0, |sum, x| sum + x);
        lane(&bite.tet.mu_v) * square + 0.5 * lane(&bite.tet.lambda_v) * trace * trace
    }
}

/// Six dense blocks: any symmetric linear elastic element.
#[derive(Clone, Copy, Debug)]
pub enum Dense {}

/// Corners of the six blocks above the diagonal.
pub const PAIRS: [(usize, usize); 6] = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];

/// K_ij for the six [`PAIRS`] of eight tetrahedra, `[pair][row][column][lane]`.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct DenseBlocks(pub [[[[f32; BLOCK]; 3]; 3]; 6]);

impl DenseBlocks {
    const ZERO: Self = Self([[[[0.0; BLOCK]; 3]; 3]; 6]);

    #[inline(always)]
    fn load<R: Lanes>(&self, pair: usize, at: usize) -> [[R; 3]; 3] {
        core::array::from_fn(|i| core::array::from_fn(|j| R::load(&self.0[pair][i][j], at)))
    }
}

/// K u by the off-diagonal blocks alone: f_i += K_ij (u_j − u_i), f_j −= K_ijᵀ (u_j − u_i).
#[inline(always)]
fn pairwise<R: Real>(u: &[[R; 3]; 4], mut block: impl FnMut(usize) -> [[R; 3]; 3]) -> [[R; 3]; 4] {
    let mut f = [zero3::<R>(); 4];
    for (pair, &(i, j)) in PAIRS.iter().enumerate() {
        let k = block(pair);
        let d = sub3(&u[j], &u[i]);
        f[i] = add3(&f[i], &mul_vec(&k, &d));
        f[j] = sub3(&f[j], &mul_transposed_vec(&k, &d));
    }
    f
}

impl Layout for Dense {
    type Stiffness = DenseBlocks;
    type Rotated = DenseBlocks;
    const ZERO_STIFFNESS: DenseBlocks = DenseBlocks::ZERO;
    const ZERO_ROTATED: DenseBlocks = DenseBlocks::ZERO;

    fn isotropic(tet: &TetBlock) -> DenseBlocks {
        let mut out = DenseBlocks::ZERO;
        for lane in 0..BLOCK {
            let g = balanced(gradients::<f32>(tet, lane));
            let (lambda, mu) = (tet.lambda_v[lane], tet.mu_v[lane]);
            for (pair, &(i, j)) in PAIRS.iter().enumerate() {
                let dot = mu * dot3(&g[i], &g[j]);
                for row in 0..3 {
                    for column in 0..3 {
                        let k = lambda * g[i][row] * g[j][column] + mu * g[j][row] * g[i][column];
                        out.0[pair][row][column][lane] = if row == column { k + dot } else { k };
                    }
                }
            }
        }
        out
    }

    #[inline(always)]
    fn rotate<R: Lanes>(
        bite: &Bite<'_, Self, R>,
        q: &[[R; 3]; 3],
        unit: Unit<R>,
        scale: R,
        rotated: &mut Self::Rotated,
    ) -> [[R; 3]; 3] {
        let square = unit.share * unit.share;
        for pair in 0..PAIRS.len() {
            // K_ij = Q K⁰_ij Qᵀ
            let half = mul_mat(q, &bite.stiffness.load::<R>(pair, bite.at));
            let turned = mul_mat(&half, &transpose(q));
            for (row, out) in turned.iter().zip(&mut rotated.0[pair]) {
                for (k, out) in row.iter().zip(out) {
                    (*k * square).store(out, bite.at);
                }
            }
        }
        // f = −Q K⁰ d with the unrotated displacement d = Qᵀx − X, relative to corner 0
        let d = displacement(bite, q);
        let [_, a, b, c] = pairwise(&d, |pair| bite.stiffness.load(pair, bite.at));
        each3([a, b, c], |f| scale3(&mul_vec(q, &f), scale * square))
    }

    #[inline(always)]
    fn product<R: Lanes>(
        _: &TetBlock,
        rotated: &Self::Rotated,
        at: usize,
        scale: R,
        edges: &[[R; 3]; 3],
    ) -> [[R; 3]; 3] {
        let [a, b, c] = *edges;
        let [_, a, b, c] = pairwise(&[zero3(), a, b, c], |pair| rotated.load(pair, at));
        each3([a, b, c], |f| scale3(&f, scale))
    }

    #[inline(always)]
    fn diagonal<R: Lanes>(
        _: &TetBlock,
        rotated: &Self::Rotated,
        at: usize,
        scale: R,
    ) -> [Sym3<R>; 4] {
        let mut sums = [[R::splat(0.0); 6]; 4];
        // K_ii = −Σ_j K_ij; its skew part is rounding.
        let half = -(R::splat(0.5) * scale);
        for (pair, &(i, j)) in PAIRS.iter().enumerate() {
            let k = rotated.load::<R>(pair, at);
            let entries = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
            for (entry, &(row, column)) in entries.iter().enumerate() {
                let symmetric = half * (k[row][column] + k[column][row]);
                sums[i][entry] = sums[i][entry] + symmetric;
                sums[j][entry] = sums[j][entry] + symmetric;
            }
        }
        sums
    }

    /// ½ dᵀ K⁰ d
    fn energy(bite: &Bite<'_, Self, f64>, q: &[[f64; 3]; 3]) -> f64 {
        let d = displacement(bite, q);
        let f = pairwise(&d, |pair| {
            bite.stiffness.0[pair].map(|row| row.map(|entry| f64::from(entry[bite.at % BLOCK])))
        });
        0.5 * d
            .iter()
            .zip(&f)
            .map(|(d, f)| dot3(d, f))
            .fold(0.0, |sum, x| sum + x)
    }
}

/// Qᵀ(x − x_0) − (X − X_0) at the four corners.
#[inline(always)]
fn displacement<L: Layout, R: Real>(bite: &Bite<'_, L, R>, q: &[[R; 3]; 3]) -> [[R; 3]; 4] {
    let d = |j: usize| sub3(&mul_transposed_vec(q, &bite.edges[j]), &bite.rest_edges[j]);
    [zero3(), d(0), d(1), d(2)]
}

/// Elasticity in Voigt's notation, in pascals: σ = C ε with the components xx, yy, zz, yz, xz, xy
/// and engineering shear strains. Must be symmetric and positive semidefinite. [`elasticity`](crate::elasticity) makes
/// some.
pub type Elasticity = [[f64; 6]; 6];

/// Place of the components (i, j) in Voigt's notation.
pub(crate) const VOIGT: [[usize; 3]; 3] = [[0, 5, 4], [5, 1, 3], [4, 3, 2]];

/// The six off-diagonal rest blocks of a tetrahedron of any linear elastic material:
/// (K_ij)_ab = V Σ_cd C_acbd g_i,c g_j,d, from its volume (m³) and gradients (1/m).
#[must_use]
pub fn elastic_blocks(
    volume: f64,
    gradients: &[[f64; 3]; 3],
    c: &Elasticity,
) -> [[[f64; 3]; 3]; 6] {
    let g = balanced(*gradients);
    PAIRS.map(|(i, j)| {
        core::array::from_fn(|a| {
            core::array::from_fn(|b| {
                let mut sum = 0.0;
                for p in 0..3 {
                    for q in 0..3 {
                        sum += c[VOIGT[a][p]][VOIGT[b][q]] * g[i][p] * g[j][q];
                    }
                }
                volume * sum
            })
        })
    })
}
