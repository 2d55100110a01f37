//! Rest meshes as they come in: borrowed nodes and tetrahedra, and what can be wrong with them.

use core::fmt;

/// A tetrahedral mesh at rest, validated and borrowed.
///
/// Node positions in metres; each tetrahedron names four nodes, positively oriented:
/// (X₁ − X₀) · ((X₂ − X₀) × (X₃ − X₀)) > 0.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    nodes: &'a [[f32; 3]],
    tets: &'a [[u32; 4]],
}

/// What is wrong with a mesh, and where. Indices count from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshError {
    /// No nodes or no tetrahedra.
    Empty,
    /// A coordinate is NaN or infinite.
    NonFiniteNode {
        /// The node.
        node: u32,
    },
    /// A tetrahedron names a node that does not exist.
    NodeOutOfRange {
        /// The tetrahedron.
        tet: u32,
        /// The index that it names.
        node: u32,
    },
    /// A tetrahedron names a node twice.
    RepeatedNode {
        /// The tetrahedron.
        tet: u32,
        /// The node.
        node: u32,
    },
    /// A tetrahedron's volume is zero, negative, or too small for its shape gradients to be f32.
    BadVolume {
        /// The tetrahedron.
        tet: u32,
    },
    /// No tetrahedron uses this node: it would have no mass.
    UnreferencedNode {
        /// The node.
        node: u32,
    },
    /// A tetrahedron's mass or stiffness leaves the range of f32.
    OutOfScale {
        /// The tetrahedron.
        tet: u32,
    },
    /// The list of materials is not one a tetrahedron.
    Materials {
        /// Entries that were given.
        given: usize,
        /// Tetrahedra of the mesh.
        tets: usize,
    },
    /// A tetrahedron is given no material: its region does not exist.
    NoMaterial {
        /// The tetrahedron.
        tet: u32,
    },
    /// A tetrahedron's material has not the damping of tetrahedron 0: a body has one.
    Damping {
        /// The tetrahedron.
        tet: u32,
    },
    /// More nodes than the storage holds.
    TooManyNodes {
        /// Nodes of the mesh.
        needed: usize,
        /// Nodes that fit.
        capacity: usize,
    },
    /// More tetrahedra than the storage holds.
    TooManyTets {
        /// Tetrahedra of the mesh.
        needed: usize,
        /// Tetrahedra that fit.
        capacity: usize,
    },
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Empty => write!(f, "the mesh has no nodes or no tetrahedra"),
            Self::NonFiniteNode { node } => {
                write!(f, "node {node} has a coordinate that is not finite")
            }
            Self::NodeOutOfRange { tet, node } => {
                write!(
                    f,
                    "tetrahedron {tet} names node {node}, which does not exist"
                )
            }
            Self::RepeatedNode { tet, node } => {
                write!(f, "tetrahedron {tet} names node {node} twice")
            }
            Self::BadVolume { tet } => {
                write!(
                    f,
                    "tetrahedron {tet} has a volume that is not positive, or too small"
                )
            }
            Self::UnreferencedNode { node } => write!(f, "node {node} belongs to no tetrahedron"),
            Self::OutOfScale { tet } => {
                write!(
                    f,
                    "the mass or stiffness of tetrahedron {tet} is out of range"
                )
            }
            Self::Materials { given, tets } => {
                write!(f, "{given} materials were given for {tets} tetrahedra")
            }
            Self::NoMaterial { tet } => {
                write!(f, "tetrahedron {tet} names a material that does not exist")
            }
            Self::Damping { tet } => {
                write!(
                    f,
                    "the damping of tetrahedron {tet} is not that of the first: a body has one"
                )
            }
            Self::TooManyNodes { needed, capacity } => {
                write!(
                    f,
                    "the mesh has {needed} nodes, the storage holds {capacity}"
                )
            }
            Self::TooManyTets { needed, capacity } => {
                write!(
                    f,
                    "the mesh has {needed} tetrahedra, the storage holds {capacity}"
                )
            }
        }
    }
}

impl core::error::Error for MeshError {}

impl<'a> Mesh<'a> {
    /// Checks a mesh and borrows it.
    ///
    /// # Errors
    /// The first thing that [`problems`] finds.
    pub fn new(nodes: &'a [[f32; 3]], tets: &'a [[u32; 4]]) -> Result<Self, MeshError> {
        let mut first = None;
        problems(nodes, tets, |problem| {
            first.get_or_insert(problem);
        });
        first.map_or(Ok(Self { nodes, tets }), Err)
    }

    /// Rest positions, metres.
    #[must_use]
    pub fn nodes(&self) -> &'a [[f32; 3]] {
        self.nodes
    }

    /// Four node numbers a tetrahedron.
    #[must_use]
    pub fn tets(&self) -> &'a [[u32; 4]] {
        self.tets
    }
}

/// Reports everything that is wrong with a mesh, in the order of [`MeshError`]'s variants up to
/// `UnreferencedNode`; each tetrahedron is reported for its first fault only.
pub fn problems(nodes: &[[f32; 3]], tets: &[[u32; 4]], mut report: impl FnMut(MeshError)) {
    // Node numbers are u32.
    let (node_count, tet_count) = match (u32::try_from(nodes.len()), u32::try_from(tets.len())) {
        (Ok(n), Ok(t)) if n > 0 && t > 0 => (n, t),
        (Ok(_), Ok(_)) => return report(MeshError::Empty),
        (Err(_), _) => {
            return report(MeshError::TooManyNodes {
                needed: nodes.len(),
                capacity: u32::MAX as usize,
            });
        }
        (_, Err(_)) => {
            return report(MeshError::TooManyTets {
                needed: tets.len(),
                capacity: u32::MAX as usize,
            });
        }
    };
    for (node, position) in (0..node_count).zip(nodes) {
        if !position.iter().all(|x| x.is_finite()) {
            report(MeshError::NonFiniteNode { node });
        }
    }
    for (tet, corners) in (0..tet_count).zip(tets) {
        if let Some(&node) = corners.iter().find(|&&n| n >= node_count) {
            report(MeshError::NodeOutOfRange { tet, node });
        } else if let Some(node) = repeated(corners) {
            report(MeshError::RepeatedNode { tet, node });
        } else if !shape(nodes, corners).is_some_and(|shape| shape.fits_f32()) {
            report(MeshError::BadVolume { tet });
        }
    }
    unreferenced(node_count, tets, |node| {
        report(MeshError::UnreferencedNode { node })
    });
}

fn repeated([a, b, c, d]: &[u32; 4]) -> Option<u32> {
    if a == b || a == c || a == d {
        Some(*a)
    } else if b == c || b == d {
        Some(*b)
    } else if c == d {
        Some(*c)
    } else {
        None
    }
}

/// Marks nodes in windows of 2,048 bits, so that no memory in proportion to the mesh is needed.
fn unreferenced(node_count: u32, tets: &[[u32; 4]], mut report: impl FnMut(u32)) {
    const WORDS: u32 = 64;
    let mut start = 0;
    while start < node_count {
        let mut seen = [0_u32; WORDS as usize];
        for offset in tets
            .iter()
            .flatten()
            .filter_map(|node| node.checked_sub(start))
        {
            if let Some(word) = seen.get_mut((offset / 32) as usize) {
                *word |= 1 << (offset % 32);
            }
        }
        let window = (node_count - start).min(32 * WORDS);
        for offset in 0..window {
            if seen
                .get((offset / 32) as usize)
                .is_some_and(|word| word & (1 << (offset % 32)) == 0)
            {
                report(start + offset);
            }
        }
        start = start.saturating_add(32 * WORDS);
    }
}

/// Volume V (m³) and shape-function gradients g₁, g₂, g₃ (1/m) of one tetrahedron, in f64.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    pub volume: f64,
    pub gradients: [[f64; 3]; 3],
}

impl Shape {
    fn fits_f32(&self) -> bool {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "the rounding is what is tested"
        )]
        let fits = |x: f64| (x as f32).is_finite();
        self.volume > f64::from(f32::MIN_POSITIVE)
            && self.gradients.iter().flatten().all(|&g| fits(g))
    }
}

/// With edges e_j = X_j − X₀: 6V = e₁·(e₂ × e₃) and g₁ = (e₂ × e₃)/6V, cyclically. `None` where a
/// corner does not exist or V is not positive.
pub(crate) fn shape(nodes: &[[f32; 3]], corners: &[u32; 4]) -> Option<Shape> {
    let mut x = [[0.0_f64; 3]; 4];
    for (position, &corner) in x.iter_mut().zip(corners) {
        *position = nodes.get(corner as usize)?.map(f64::from);
    }
    let [x0, x1, x2, x3] = x;
    let edge = |p: [f64; 3]| [p[0] - x0[0], p[1] - x0[1], p[2] - x0[2]];
    let (e1, e2, e3) = (edge(x1), edge(x2), edge(x3));
    let normals = [cross(e2, e3), cross(e3, e1), cross(e1, e2)];
    let six_volumes = e1[0] * normals[0][0] + e1[1] * normals[0][1] + e1[2] * normals[0][2];
    if !(six_volumes > 0.0 && six_volumes.is_finite()) {
        return None;
    }
    Some(Shape {
        volume: six_volumes / 6.0,
        gradients: normals.map(|n| n.map(|x| x / six_volumes)),
    })
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
