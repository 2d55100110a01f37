//! Small tetrahedral meshes for the tests, the same bits on every host: f64 with
//! + − × ÷ and sqrt only, each coordinate rounded once to f32.

/// Random numbers without a dependency: Knuth's 64-bit congruential generator.
pub struct Lcg(pub u64);

impl Lcg {
    /// Uniform in [−1, 1); the high bits, since the low ones of an LCG repeat early.
    pub fn signed(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct TetMesh {
    pub nodes: Vec<[f32; 3]>,
    pub tets: Vec<[u32; 4]>,
}

impl TetMesh {
    /// Signed volume, in f64: (e_1 × e_2) · e_3 / 6 with e_i = X_i − X_0.
    pub fn volume(&self, tet: [u32; 4]) -> f64 {
        let node = tet.map(|i| self.nodes[i as usize].map(f64::from));
        let e = |i: usize| [0, 1, 2].map(|a| node[i][a] - node[0][a]);
        let ([a, b, c], [d, f, g], [p, q, r]) = (e(1), e(2), e(3));
        ((b * g - c * f) * p + (c * d - a * g) * q + (a * f - b * d) * r) / 6.0
    }

    /// With the tetrahedra in fans.
    pub fn ordered(mut self) -> Self {
        self.tets = femto::order::fans(&self.tets).tets;
        self
    }

    /// Swaps the last two nodes of every tet of negative volume.
    fn orient(&mut self) {
        for e in 0..self.tets.len() {
            if self.volume(self.tets[e]) < 0.0 {
                self.tets[e].swap(2, 3);
            }
        }
    }
}

/// A box with its low corner at the origin. Node (i, j, k) has index (i·(ny+1) + j)·(nz+1) + k;
/// each cell gives the six tets that walk from its low to its high corner along the axes.
pub fn box_mesh(size: [f64; 3], cells: [usize; 3]) -> TetMesh {
    const WALKS: [[usize; 3]; 6] = [
        [0, 1, 2],
        [0, 2, 1],
        [1, 0, 2],
        [1, 2, 0],
        [2, 0, 1],
        [2, 1, 0],
    ];
    let [nx, ny, nz] = cells;
    let index = |[i, j, k]: [usize; 3]| ((i * (ny + 1) + j) * (nz + 1) + k) as u32;
    let mut mesh = TetMesh::default();
    for i in 0..=nx {
        for j in 0..=ny {
            for k in 0..=nz {
                let at = [i, j, k];
                mesh.nodes
                    .push([0, 1, 2].map(|a| (size[a] * at[a] as f64 / cells[a] as f64) as f32));
            }
        }
    }
    for i in 0..nx {
        for j in 0..ny {
            for k in 0..nz {
                for walk in WALKS {
                    let mut at = [i, j, k];
                    let mut tet = [index(at); 4];
                    for (step, axis) in walk.into_iter().enumerate() {
                        at[axis] += 1;
                        tet[step + 1] = index(at);
                    }
                    mesh.tets.push(tet);
                }
            }
        }
    }
    mesh.orient();
    mesh
}

/// The corner tet of the unit cube.
pub fn single_tet() -> TetMesh {
    TetMesh {
        nodes: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        tets: vec![[0, 1, 2, 3]],
    }
}

/// Two boxes of different shape, a gap of 0.5 between them, in one mesh.
pub fn two_pieces() -> TetMesh {
    let mut mesh = box_mesh([1.0, 0.5, 0.5], [2, 1, 1]);
    let other = box_mesh([0.5, 1.0, 0.5], [1, 2, 1]);
    let first = mesh.nodes.len() as u32;
    mesh.nodes
        .extend(other.nodes.iter().map(|&[x, y, z]| [x + 1.5, y, z]));
    mesh.tets
        .extend(other.tets.iter().map(|tet| tet.map(|i| i + first)));
    mesh
}

/// `n` regular tets of edge 1 in a row, each sharing `shared` nodes with the next:
/// 1 a vertex, 2 an edge, 3 a face. Any four successive points of the helix
/// (r cos kφ, r sin kφ, k/√10), cos φ = −2/3, r = √27/10, are such a tet.
pub fn chain(n: usize, shared: usize) -> TetMesh {
    assert!((1..=3).contains(&shared) && n > 0);
    let stride = 4 - shared;
    let (cos, sin, r) = (-2.0 / 3.0, 5f64.sqrt() / 3.0, 27f64.sqrt() / 10.0);
    let mut mesh = TetMesh::default();
    let (mut x, mut y) = (r, 0.0);
    for k in 0..(n - 1) * stride + 4 {
        mesh.nodes
            .push([x as f32, y as f32, (k as f64 / 10f64.sqrt()) as f32]);
        (x, y) = (x * cos - y * sin, x * sin + y * cos);
    }
    for e in 0..n {
        mesh.tets
            .push([0, 1, 2, 3].map(|i| (e * stride + i) as u32));
    }
    mesh.orient();
    mesh
}

/// Moves every coordinate by less than `amount`, halved until each tet keeps a tenth of its
/// volume: irregular on purpose, slivers only where a test asks for them.
pub fn jitter(mesh: &TetMesh, amount: f64, seed: u64) -> TetMesh {
    let mut amount = amount;
    loop {
        let mut random = Lcg(seed);
        let mut moved = mesh.clone();
        for x in moved.nodes.as_flattened_mut() {
            *x = (f64::from(*x) + amount * random.signed()) as f32;
        }
        let keeps = |&tet: &[u32; 4]| moved.volume(tet) > 0.1 * mesh.volume(tet);
        if mesh.tets.iter().all(keeps) {
            return moved;
        }
        amount *= 0.5;
    }
}

/// Node vectors with components of size up to `size`.
pub fn noise(nodes: usize, size: f64, seed: u64) -> Vec<[f32; 3]> {
    let mut random = Lcg(seed);
    (0..nodes)
        .map(|_| core::array::from_fn(|_| (size * random.signed()) as f32))
        .collect()
}
