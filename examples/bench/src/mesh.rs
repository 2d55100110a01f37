//! Box meshes of six tetrahedra a cell, and a bent, twisted, rotated state of motion.

use femto::glam::Vec3;
use femto::order::fans;

/// A mesh at rest and a state that is nowhere special.
pub struct Scene {
    pub nodes: Vec<[f32; 3]>,
    pub tets: Vec<[u32; 4]>,
    /// Positions, metres.
    pub x: Vec<[f32; 3]>,
    /// Velocities, m/s.
    pub v: Vec<[f32; 3]>,
}

/// Edge of a cell, metres.
const CELL: f32 = 0.1;

/// A box of so many cells. Node (i, j, k) has index (i·(ny+1) + j)·(nz+1) + k; each cell gives the
/// six tetrahedra that walk from its low to its high corner along the axes; in femto's order.
pub fn box_scene([nx, ny, nz]: [u32; 3]) -> Scene {
    // The last two of an odd walk are swapped, so that all are positively oriented.
    const WALKS: [[usize; 3]; 6] = [
        [0, 1, 2],
        [1, 2, 0],
        [2, 0, 1],
        [0, 2, 1],
        [1, 0, 2],
        [2, 1, 0],
    ];
    let index = |[i, j, k]: [u32; 3]| (i * (ny + 1) + j) * (nz + 1) + k;
    let mut random = Random(1);
    let (mut nodes, mut tets) = (Vec::new(), Vec::new());
    for i in 0..=nx {
        for j in 0..=ny {
            for k in 0..=nz {
                nodes.push([i, j, k].map(|at| CELL * (at as f32 + 0.15 * random.signed())));
                if i == nx || j == ny || k == nz {
                    continue;
                }
                for (walk, axes) in WALKS.iter().enumerate() {
                    let mut at = [i, j, k];
                    let mut tet = [index(at); 4];
                    for (corner, &axis) in tet[1..].iter_mut().zip(axes) {
                        at[axis] += 1;
                        *corner = index(at);
                    }
                    if walk >= 3 {
                        tet.swap(2, 3);
                    }
                    tets.push(tet);
                }
            }
        }
    }
    let tets = fans(&tets).tets;
    let length = CELL * nx as f32;
    let x = nodes
        .iter()
        .map(|&node| bent(node.into(), length))
        .collect();
    let v = nodes
        .iter()
        .map(|&node| moving(bent(node.into(), length).into(), &mut random))
        .collect();
    Scene { nodes, tets, x, v }
}

/// Stretched by up to a tenth, twisted about the first axis, and turned.
fn bent(node: Vec3, length: f32) -> [f32; 3] {
    let s = node.x / length;
    let (sin, cos) = (0.7 * s).sin_cos();
    let twisted = Vec3::new(
        node.x * (1.0 + 0.1 * s),
        cos * node.y - sin * node.z + 0.05 * length * s * s,
        sin * node.y + cos * node.z,
    );
    let (axis, (sin, cos)) = (Vec3::new(0.48, -0.6, 0.64), 1.1_f32.sin_cos());
    (twisted * cos + axis.cross(twisted) * sin + axis * axis.dot(twisted) * (1.0 - cos)).to_array()
}

/// Flying, spinning, and a little noise.
fn moving(x: Vec3, random: &mut Random) -> [f32; 3] {
    let noise = Vec3::from_array([(); 3].map(|()| 0.01 * random.signed()));
    (Vec3::new(0.3, -0.2, 0.1) + Vec3::new(0.5, 1.0, -0.4).cross(x) + noise).to_array()
}

/// Knuth's 64-bit congruential generator.
struct Random(u64);

impl Random {
    /// Uniform in [−1, 1).
    fn signed(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1_u32 << 23) as f32 - 1.0
    }
}
