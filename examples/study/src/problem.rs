//! What is simulated: bodies that nothing but pins and gravity touches, so that every method solves
//! exactly the same equations.

use std::error::Error;

use femto::element::Layout;
use femto::glam::Vec3;
use femto::order::fans;
use femto::settings::Needs;
use femto::{Material, Mesh, OwnedBody, Pin};
use femto_bench::baseline;
use femto_cli::mesh::{self, gmsh};

const SNOWMAN: &[u8] = include_bytes!("../../femto-cli/meshes/snowman.msh");
const BOWLING_PIN: &[u8] = include_bytes!("../../femto-cli/meshes/bowling_pin.msh");
const CAR: &[u8] = include_bytes!("../../femto-cli/meshes/car.msh");

/// The paper's time step: five steps make a frame of 1/30 s.
pub const H: f64 = 1.0 / 150.0;
pub const STEPS_PER_FRAME: usize = 5;

/// A body, its world, and how long to look. SI units.
#[derive(Clone)]
pub struct Problem {
    pub name: &'static str,
    pub what: &'static str,
    pub nodes: Vec<[f32; 3]>,
    pub tets: Vec<[u32; 4]>,
    pub young: f32,
    pub poisson: f32,
    pub density: f32,
    pub gravity: [f32; 3],
    /// Nodes that do not move.
    pub held: Vec<u32>,
    /// At the start; positions are those at rest.
    pub v: Vec<[f32; 3]>,
    pub steps: usize,
}

type Nodes = (Vec<[f32; 3]>, Vec<[u32; 4]>);

fn rounded(mesh: mesh::Mesh) -> Nodes {
    let nodes = mesh.nodes.iter().map(|x| x.to_array().map(|c| c as f32));
    (nodes.collect(), mesh.tets)
}

/// A box with its low corner at the origin, six tetrahedra a cell.
pub fn box_mesh(size: [f64; 3], cells: [u32; 3]) -> Result<Nodes, Box<dyn Error>> {
    Ok(rounded(mesh::grid::mesh(size, cells)?))
}

impl Problem {
    /// At rest, ν = 0.4, 1000 kg/m³, weightless, free.
    pub fn new(name: &'static str, what: &'static str, (nodes, tets): Nodes, young: f32) -> Self {
        Self {
            name,
            what,
            v: vec![[0.0; 3]; nodes.len()],
            nodes,
            // The order in which femto is fastest; the others do not mind.
            tets: fans(&tets).tets,
            young,
            poisson: 0.4,
            density: 1000.0,
            gravity: [0.0; 3],
            held: Vec::new(),
            steps: 150,
        }
    }

    pub fn hold(mut self, inside: impl Fn([f32; 3]) -> bool) -> Self {
        let all = (0_u32..).zip(&self.nodes);
        self.held = all.filter(|(_, x)| inside(**x)).map(|(i, _)| i).collect();
        self
    }

    pub fn start(mut self, velocity: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        self.v = self.nodes.iter().map(|&x| velocity(x)).collect();
        for &node in &self.held {
            self.v[node as usize] = [0.0; 3];
        }
        self
    }

    pub fn material(&self) -> Material {
        Material::new(self.young, self.poisson, self.density).expect("a valid material")
    }

    pub fn body<L: Layout>(&self, needs: impl Into<Needs>) -> OwnedBody<L> {
        let mesh = Mesh::new(&self.nodes, &self.tets).expect("a valid mesh");
        let mut body = OwnedBody::new(&mesh, &self.material(), needs).expect("in range");
        body.place(&self.nodes, &self.v).expect("a finite state");
        body
    }

    pub fn pins(&self) -> Vec<Pin> {
        self.held.iter().map(|&node| Pin::held(node)).collect()
    }

    pub fn gravity(&self) -> Vec3 {
        Vec3::from_array(self.gravity)
    }

    /// The usual pipeline, or the reference, at a step of `dt`.
    pub fn baseline<T: femto_bench::csr::Scalar>(&self, dt: f64) -> baseline::Baseline<T> {
        let (lambda, mu) = self.material().lame();
        let mut body = baseline::Baseline::new(&baseline::Setup {
            nodes: &self.nodes,
            tets: &self.tets,
            lame: [lambda, mu],
            density: f64::from(self.density),
            gravity: self.gravity.map(f64::from),
            held: &self.held,
            dt,
        });
        body.place(&self.nodes, &self.v);
        body
    }

    /// Of the bounding box, metres.
    pub fn diagonal(&self) -> f64 {
        let side = |axis: usize| {
            let along = || self.nodes.iter().map(|x| f64::from(x[axis]));
            along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min)
        };
        (0..3).map(|axis| side(axis).powi(2)).sum::<f64>().sqrt()
    }

    /// h²E/(ρ dx²), with dx the cube root of six mean tetrahedra, the edge of a cell.
    pub fn stiffness(&self, h: f64) -> f64 {
        let volume: f64 = self.tets.iter().map(|&tet| self.volume(tet)).sum();
        let dx = (6.0 * volume / self.tets.len() as f64).cbrt();
        h * h * f64::from(self.young) / (f64::from(self.density) * dx * dx)
    }

    pub fn volume(&self, tet: [u32; 4]) -> f64 {
        let [a, b, c, d] =
            tet.map(|i| nalgebra::Vector3::from(self.nodes[i as usize].map(f64::from)));
        (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0
    }
}

/// The paper's three bodies.
pub fn three() -> Result<Vec<Problem>, Box<dyn Error>> {
    let mut snowman = Problem::new(
        "snowman",
        "held at its foot, pulled sideways by gravity, E = 5e5 Pa",
        rounded(gmsh::parse(SNOWMAN)?),
        5e5,
    )
    .hold(|x| x[1] < 0.05);
    snowman.gravity = [9.81, 0.0, 0.0];
    let mut bowling = Problem::new(
        "bowling pin",
        "hit at its belly, then flying, E = 1e6 Pa",
        rounded(gmsh::parse(BOWLING_PIN)?),
        1e6,
    )
    .start(|[x, y, z]| {
        let d2 = (x + 0.16).powi(2) + (y - 0.3).powi(2) + z * z;
        let push = 15.0 * (-d2 / 0.02).exp();
        [push, 0.2 * push, 0.0]
    });
    bowling.gravity = [0.0, -9.81, 0.0];
    bowling.steps = 90;
    let mut car = Problem::new(
        "car",
        "held at its wheels, braking from 3 m/s, E = 5e6 Pa",
        rounded(gmsh::parse(CAR)?),
        5e6,
    )
    .hold(|x| x[1] < 0.08)
    .start(|x| {
        if x[1] > 0.35 {
            [3.0, 0.0, 0.0]
        } else {
            [0.0; 3]
        }
    });
    car.gravity = [0.0, -9.81, 0.0];
    car.steps = 60;
    Ok(vec![snowman, bowling, car])
}

/// A beam of 1 m clamped at x = 0 under gravity: 425 nodes.
pub fn cantilever(young: f32) -> Result<Problem, Box<dyn Error>> {
    let mut problem = Problem::new(
        "cantilever",
        "clamped at one end, sagging under its weight",
        box_mesh([1.0, 0.25, 0.25], [16, 4, 4])?,
        young,
    )
    .hold(|x| x[0] < 1e-6);
    problem.gravity = [0.0, -9.81, 0.0];
    Ok(problem)
}

/// The same beam thrown and spinning.
pub fn free_bar(young: f32) -> Result<Problem, Box<dyn Error>> {
    let omega = Vec3::new(0.5, 2.0, 6.0);
    let problem = Problem::new(
        "free bar",
        "thrown and spinning, weightless",
        box_mesh([1.0, 0.25, 0.25], [12, 3, 3])?,
        young,
    );
    let centre = Vec3::new(0.5, 0.125, 0.125);
    Ok(problem.start(|x| (omega.cross(Vec3::from_array(x) - centre) + Vec3::X).to_array()))
}
