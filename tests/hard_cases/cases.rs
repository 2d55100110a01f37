//! The hard cases: states, meshes, materials and numbers that solvers break on.

use super::meshes::{Lcg, TetMesh, box_mesh, chain, single_tet, two_pieces};

/// What must come of a case, with a start that is energy-stable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected {
    /// Bounded, its energy too; it may take its time to its rest shape.
    Bounded,
    /// Bounded, and with the default settings back in its rest shape before the run ends.
    Recovered,
    /// As stiff for its step as single precision cannot hold: bounded with a local preconditioner and
    /// without rotations in W.
    BoundedLocally,
    /// Refused with an error that begins so.
    Refused(&'static str),
}

/// A body, its state, and its step. SI units.
#[derive(Clone, Debug)]
pub struct Case {
    pub name: &'static str,
    pub mesh: TetMesh,
    pub young: f32,
    pub poisson: f32,
    /// Of the half of smaller x, and of the other.
    pub densities: [f32; 2],
    pub h: f32,
    pub x: Vec<[f32; 3]>,
    pub v: Vec<[f32; 3]>,
    pub pins: Vec<u32>,
    /// On node 0, along y; N.
    pub force: f32,
    pub steps: u32,
    pub expected: Expected,
}

/// A bar of 1 m at rest, E = 1e6, ν = 0.4, h = 0.01 s, for a second.
fn case(name: &'static str, mesh: TetMesh, expected: Expected) -> Case {
    Case {
        name,
        x: mesh.nodes.clone(),
        v: vec![[0.0; 3]; mesh.nodes.len()],
        mesh,
        young: 1e6,
        poisson: 0.4,
        densities: [1000.0; 2],
        h: 0.01,
        pins: Vec::new(),
        force: 0.0,
        steps: 100,
        expected,
    }
}

impl Case {
    fn placed(mut self, place: impl FnMut(&[f32; 3]) -> [f32; 3]) -> Self {
        self.x = self.mesh.nodes.iter().map(place).collect();
        self
    }

    /// Stretched by a fifth, which is what the cases that are about something else recover from.
    fn stretched(self) -> Self {
        self.placed(|&[x, y, z]| [1.2 * x, y, z])
    }

    fn moving(mut self, mut velocity: impl FnMut(&[f32; 3]) -> [f32; 3]) -> Self {
        self.v = self.x.iter().map(&mut velocity).collect();
        self
    }

    fn scaled(mut self, scale: f32) -> Self {
        for x in [&mut self.mesh.nodes, &mut self.x, &mut self.v] {
            x.as_flattened_mut().iter_mut().for_each(|c| *c *= scale);
        }
        self
    }
}

/// Every case, on a bar of so many cells.
pub fn all(cells: [usize; 3]) -> Vec<Case> {
    use Expected::{Bounded, BoundedLocally, Recovered, Refused};
    let bar = || box_mesh([1.0, 0.25, 0.25], cells);
    let random = |seed: u64, size: f32| {
        let mut numbers = Lcg(seed);
        move |_: &[f32; 3]| [(); 3].map(|()| size * numbers.signed() as f32)
    };
    let with = |case: Case, change: &dyn Fn(&mut Case)| {
        let mut case = case;
        change(&mut case);
        case
    };
    let mut cases = vec![
        case("all nodes in one point", bar(), Recovered).placed(|_| [0.3, 0.1, 0.2]),
        case("flattened to a plane", bar(), Recovered).placed(|&[x, _, z]| [x, 0.1, z]),
        case("flattened to a line", bar(), Recovered).placed(|&[x, _, _]| [x, 0.1, 0.1]),
        case("mirrored", bar(), Recovered).placed(|&[x, y, z]| [-x, y, z]),
        // May stay tangled: the energy has other minima than the rest shape.
        case("random in a box", bar(), Bounded).placed(random(5, 0.5)),
        case("twisted by 720 degrees", bar(), Recovered).placed(|&[x, y, z]| {
            let (sin, cos) = sin_cos(4.0 * std::f64::consts::PI * f64::from(x));
            let (y, z) = (f64::from(y) - 0.125, f64::from(z) - 0.125);
            [x, (cos * y - sin * z) as f32, (sin * y + cos * z) as f32]
        }),
        case("one tetrahedron", single_tet(), Recovered).stretched(),
        // May be left spinning: its angular momentum is not exact.
        case("one tetrahedron, inverted", single_tet(), Bounded).placed(|&[x, y, z]| [-x, y, z]),
        case("chain by vertices", chain(8, 1), Recovered).stretched(),
        case("chain by edges", chain(8, 2), Recovered).stretched(),
        case("chain by faces", chain(8, 3), Recovered).stretched(),
        case("two pieces", two_pieces(), Recovered).stretched(),
        case(
            "slivers of aspect 1e4",
            box_mesh([1.0, 1e-4, 1.0], [3, 1, 3]),
            Bounded,
        )
        .stretched(),
        case("volumes 1 : 1e6", graded(cells), Bounded).stretched(),
    ];
    let poisson = |case: &mut Case| case.poisson = 0.499;
    cases.push(with(
        case("Poisson's ratio 0.499", bar(), Recovered).stretched(),
        &poisson,
    ));
    cases.push(with(
        case("density 1 : 1e6 in one body", bar(), Bounded).stretched(),
        &|c| c.densities = [1.0, 1e6],
    ));
    cases.push(with(case("E = 1e3", bar(), Bounded).stretched(), &|c| {
        c.young = 1e3
    }));
    // Where single precision ends: a coarse space without v(t) in W, then rotations in W, then warped factors.
    for (name, h) in [
        ("E = 1e10", 0.01),
        ("E = 1e10, h = 0.03 s", 0.03),
        ("E = 1e10, h = 0.3 s", 0.3),
    ] {
        cases.push(with(case(name, bar(), BoundedLocally).stretched(), &|c| {
            (c.young, c.h) = (1e10, h);
        }));
    }
    for (name, expected, h) in [
        ("h = 1e-6 s", Bounded, 1e-6),
        ("h = 1 s", BoundedLocally, 1.0),
    ] {
        cases.push(with(case(name, bar(), expected).stretched(), &|c| c.h = h));
    }
    cases.extend([
        case("flying at 1e4 m/s", bar(), Bounded)
            .stretched()
            .moving(|_| [1e4, 0.0, 0.0]),
        case("every node at 1e4 m/s", bar(), Bounded).moving(random(9, 1e4)),
        case("spinning at 1e4 m/s", bar(), Bounded)
            .moving(|&[x, y, _]| [-2e4 * (y - 0.125), 2e4 * (x - 0.5), 0.0]),
        // With steps of the body's own time, and with one of the big world's.
        with(
            case("a body of 1e-6 m, h = 1e-8 s", bar(), Recovered)
                .stretched()
                .scaled(1e-6),
            &|c| {
                c.h = 1e-8;
            },
        ),
        with(
            case("a body of 1e6 m, h = 1e4 s", bar(), Recovered)
                .stretched()
                .scaled(1e6),
            &|c| {
                c.h = 1e4;
            },
        ),
        case("a body of 1e6 m, h = 0.01 s", bar(), Bounded)
            .stretched()
            .scaled(1e6),
        case(
            "a body of 1e-6 m, h = 0.01 s: h2E/(rho dx2) = 1e13",
            bar(),
            BoundedLocally,
        )
        .stretched()
        .scaled(1e-6),
        case("1e4 m from the origin", far(bar()), Bounded)
            .placed(|&[x, y, z]| [1e4 + 1.2 * (x - 1e4), y, z]),
        with(
            case("everything pinned", bar(), Bounded).stretched(),
            &|c| {
                c.pins = (0..c.x.len() as u32).collect();
            },
        ),
        with(
            case("clamped at one end", bar(), Recovered).stretched(),
            &|c| {
                let nodes = (0_u32..).zip(&c.mesh.nodes);
                c.pins = nodes.filter(|(_, x)| x[0] < 1e-6).map(|(i, _)| i).collect();
            },
        ),
    ]);
    for (name, force) in [
        ("a force of NaN", f32::NAN),
        ("a force of +inf", f32::INFINITY),
        ("a force of -inf", f32::NEG_INFINITY),
    ] {
        let refused = Refused("node 0 would have become non-finite");
        cases.push(with(case(name, bar(), refused).stretched(), &|c| {
            c.force = force
        }));
    }
    let huge = Refused("forces or velocities are too large");
    cases.push(with(case("a force of 1e30 N", bar(), huge), &|c| {
        c.force = 1e30
    }));
    let flat = box_mesh([1.0, 0.0, 1.0], [2, 1, 2]);
    cases.push(case(
        "no volume",
        flat,
        Refused("tetrahedron 0 has a volume"),
    ));
    cases
}

/// Without the host's libm, so that the states have the same bits everywhere.
fn sin_cos(angle: f64) -> (f64, f64) {
    // A thousandth of the angle by its series, then the addition theorem.
    let small = angle / 1024.0;
    let (mut sin, mut cos) = (
        small - small.powi(3) / 6.0,
        1.0 - small * small / 2.0 + small.powi(4) / 24.0,
    );
    for _ in 0..10 {
        (sin, cos) = (2.0 * sin * cos, cos * cos - sin * sin);
    }
    (sin, cos)
}

/// Cells that shrink along x by a hundred, and so does the cross section: volumes 1 : 1e6.
fn graded(cells: [usize; 3]) -> TetMesh {
    let mut mesh = box_mesh([1.0, 1.0, 1.0], cells);
    for node in &mut mesh.nodes {
        let [x, y, z] = *node;
        // Cross section from 1 to 1e-2 squared, and length along with it.
        let size = 1.0 - 0.99 * x;
        *node = [x * (2.0 - x) * 0.5, size * (y - 0.5), size * (z - 0.5)];
    }
    mesh
}

fn far(mut mesh: TetMesh) -> TetMesh {
    mesh.nodes.iter_mut().for_each(|x| x[0] += 1e4);
    mesh
}
