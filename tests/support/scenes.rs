//! Named scenes, as a body of the crate and as the oracle's, from the same numbers.

use femto::constraint::Pin;
use femto::element::{Factored, Layout};
use femto::glam::Vec3;
use femto::lane::Lanes;
use femto::material::Material;
use femto::mesh::Mesh;
use femto::owned::{OwnedBody, OwnedRest, OwnedState, OwnedWorkspace};
use femto::preconditioner::Aggregates;
use femto::settings::{Budget, Needs, Preconditioner, Settings, Start};
use femto::step::{Scene, StepReport, step};

use super::meshes::{TetMesh, box_mesh, jitter, two_pieces};
use super::reference::{Reference, node, stack};

/// Everything that defines a run but the solver's settings. SI units; f32, so that both see the same.
#[derive(Clone, Debug)]
pub struct Setup {
    pub name: &'static str,
    pub mesh: TetMesh,
    pub young: f32,
    pub poisson: f32,
    pub density: f32,
    pub alpha: f32,
    pub beta: f32,
    pub gravity: [f32; 3],
    pub pins: Vec<(u32, [f32; 3])>,
    pub x: Vec<[f32; 3]>,
    pub v: Vec<[f32; 3]>,
    pub h: f32,
    pub theta: f32,
}

impl Setup {
    /// At rest, E = 1e6, ν = 0.4, ρ = 1000, undamped, no gravity, h = 1/150, backward Euler.
    pub fn new(name: &'static str, mesh: TetMesh) -> Self {
        Self {
            name,
            x: mesh.nodes.clone(),
            v: vec![[0.0; 3]; mesh.nodes.len()],
            mesh,
            young: 1e6,
            poisson: 0.4,
            density: 1000.0,
            alpha: 0.0,
            beta: 0.0,
            gravity: [0.0; 3],
            pins: Vec::new(),
            h: 1.0 / 150.0,
            theta: 1.0,
        }
    }

    /// Adds ω × (x − centroid) to the velocities.
    pub fn spinning(mut self, omega: [f32; 3]) -> Self {
        let centre = self
            .x
            .iter()
            .fold(Vec3::ZERO, |sum, x| sum + Vec3::from_array(*x))
            / self.x.len() as f32;
        for (v, x) in self.v.iter_mut().zip(&self.x) {
            let spin = Vec3::from_array(omega).cross(Vec3::from_array(*x) - centre);
            *v = (Vec3::from_array(*v) + spin).to_array();
        }
        self
    }

    /// Pins the nodes whose rest position satisfies `inside`, with a velocity that may depend on it.
    pub fn pinned(
        mut self,
        inside: impl Fn([f32; 3]) -> bool,
        velocity: impl Fn([f32; 3]) -> [f32; 3],
    ) -> Self {
        for (i, x) in self.mesh.nodes.iter().enumerate() {
            if inside(*x) {
                self.pins.push((i as u32, velocity(*x)));
            }
        }
        self
    }

    pub fn material(&self) -> Material {
        Material::new(self.young, self.poisson, self.density)
            .unwrap()
            .with_damping(self.alpha, self.beta)
            .unwrap()
    }

    /// With room for what a start, or settings, need.
    pub fn body<L: Layout>(&self, needs: impl Into<Needs>) -> OwnedBody<L> {
        let mut body = OwnedBody::from_rest(self.rest(), needs);
        body.place(&self.x, &self.v).unwrap();
        body
    }

    pub fn rest<L: Layout>(&self) -> OwnedRest<L> {
        let mesh = Mesh::new(&self.mesh.nodes, &self.mesh.tets).unwrap();
        OwnedRest::new(&mesh, &self.material()).unwrap()
    }

    /// So many steps with these lanes, none refused: the last state, and what each step said.
    pub fn run<R: Lanes>(
        &self,
        settings: &Settings<'_>,
        steps: usize,
    ) -> (OwnedState, Vec<StepReport>) {
        let rest: OwnedRest = self.rest();
        let view = rest.view();
        let mut state = OwnedState::new(&view, settings);
        let mut work = OwnedWorkspace::new(&view, settings);
        state.view_mut().place(&view, &self.x, &self.v).unwrap();
        let advance = |_| {
            let (mut state, mut work) = (state.view_mut(), work.view_mut(&view));
            let pins = self.pin_list();
            let report = step::<R, _>(&view, &mut state, &mut work, &self.scene(&pins), settings);
            assert!(report.advanced(), "{report:?}");
            report
        };
        let reports = (0..steps).map(advance).collect();
        (state, reports)
    }

    /// With so many aggregates, as the crate divides the mesh; they stay for the rest of the test.
    pub fn two_level(&self, aggregates: usize) -> Preconditioner<'static> {
        let of = Vec::leak(vec![0; self.x.len()]);
        let rest = self.rest::<Factored>();
        Preconditioner::TwoLevel(Aggregates::divide(&rest.view(), aggregates, of).unwrap())
    }

    pub fn pin_list(&self) -> Vec<Pin> {
        self.pins
            .iter()
            .map(|&(node, v)| Pin {
                node,
                velocity: Vec3::from_array(v),
            })
            .collect()
    }

    pub fn scene<'a>(&self, pins: &'a [Pin]) -> Scene<'a> {
        Scene {
            gravity: Vec3::from_array(self.gravity),
            pins,
            ..Scene::default()
        }
    }

    pub fn settings(&self) -> Settings<'static> {
        Settings::new(self.h)
            .unwrap()
            .with_theta(self.theta)
            .unwrap()
    }

    /// The setup's settings with this solver and two polar sweeps.
    pub fn solver<'a>(
        &self,
        start: Start,
        preconditioner: Preconditioner<'a>,
        iterations: u32,
    ) -> Settings<'a> {
        let budget = Budget {
            iterations,
            polar_sweeps: 2,
        };
        self.settings()
            .with_budget(budget)
            .with_start(start)
            .with_preconditioner(preconditioner)
    }

    pub fn reference(&self) -> Reference {
        let mut reference = Reference::new(
            &self.mesh.nodes,
            &self.mesh.tets,
            f64::from(self.young),
            f64::from(self.poisson),
            f64::from(self.density),
        );
        (reference.alpha, reference.beta) = (f64::from(self.alpha), f64::from(self.beta));
        reference.gravity = self.gravity.map(f64::from);
        (reference.h, reference.theta) = (f64::from(self.h), f64::from(self.theta));
        for &(node, v) in &self.pins {
            reference.pins[node as usize] = Some(v.map(f64::from));
        }
        (reference.x, reference.v) = (stack(&self.x), stack(&self.v));
        reference
    }
}

/// A thrown, spinning bar with damping off.
pub fn free_spin() -> Setup {
    let mesh = jitter(&box_mesh([1.0, 0.25, 0.25], [6, 2, 2]), 0.02, 3);
    let mut setup = Setup::new("free spin", mesh).spinning([0.5, 2.0, 6.0]);
    for v in &mut setup.v {
        v[0] += 1.0;
    }
    setup.gravity = [0.0, -9.81, 0.0];
    setup
}

/// A beam clamped at x = 0, sagging.
pub fn cantilever() -> Setup {
    let mut setup = Setup::new("cantilever", box_mesh([1.0, 0.25, 0.25], [6, 2, 2]))
        .pinned(|x| x[0] < 1e-6, |_| [0.0; 3]);
    setup.gravity = [0.0, -9.81, 0.0];
    setup.beta = 0.002;
    setup
}

/// A bar whose ends are turned against each other by moving pins, through about 35° each.
pub fn pinned_twist() -> Setup {
    let turn = |x: [f32; 3]| {
        let side = if x[0] < 0.5 { 0.5 } else { -0.5 };
        [0.0, -side * (x[2] - 0.125), side * (x[1] - 0.125)]
    };
    let mut setup = Setup::new("pinned twist", box_mesh([1.0, 0.25, 0.25], [6, 2, 2]))
        .pinned(|x| x[0] < 1e-6 || x[0] > 1.0 - 1e-6, turn);
    setup.alpha = 0.5;
    setup
}

/// Two disconnected pieces in one body, one of them thrown.
pub fn two() -> Setup {
    let mut setup = Setup::new("two pieces", two_pieces()).spinning([1.0, -2.0, 3.0]);
    setup.gravity = [0.0, -9.81, 0.0];
    setup
}

/// ν = 0.499, hanging by one end, with the trapezoidal rule.
pub fn near_incompressible() -> Setup {
    let mut setup = Setup::new(
        "near-incompressible",
        jitter(&box_mesh([0.5, 0.25, 0.25], [4, 2, 2]), 0.01, 7),
    )
    .pinned(|x| x[0] < 0.02, |_| [0.0; 3]);
    setup.poisson = 0.499;
    setup.young = 2e5;
    setup.gravity = [0.0, -9.81, 0.0];
    setup
}

/// A body let go from a stretched state, with the trapezoidal rule and damping.
pub fn released_newmark() -> Setup {
    let mut setup = Setup::new(
        "released (Newmark)",
        jitter(&box_mesh([0.5, 0.25, 0.25], [4, 2, 2]), 0.01, 11),
    )
    .pinned(|x| x[0] < 0.02, |_| [0.0; 3]);
    for x in &mut setup.x {
        x[0] *= 1.1;
    }
    setup.theta = 0.5;
    (setup.alpha, setup.beta) = (0.1, 0.001);
    setup
}

/// A free bar of irregular cells.
pub fn bar() -> Setup {
    Setup::new(
        "bar",
        jitter(&box_mesh([1.0, 0.3, 0.2], [6, 2, 2]), 0.02, 5),
    )
}

/// Bent and twisted, so that rotations differ and strains are there.
pub fn bent(mut setup: Setup) -> Setup {
    for x in &mut setup.x {
        let [a, b, c] = *x;
        *x = [a - 0.3 * a * b, 1.1 * b + 0.4 * a * a, c + 0.5 * a * b];
    }
    setup
}

pub fn all() -> Vec<Setup> {
    vec![
        free_spin(),
        cantilever(),
        pinned_twist(),
        two(),
        near_incompressible(),
        released_newmark(),
    ]
}

/// Largest distance between the nodes of a body and the oracle's, over the rest bounding box's diagonal.
pub fn distance(x: &[[f32; 3]], reference: &Reference) -> f64 {
    let worst = (0..x.len())
        .map(|i| (nalgebra::Vector3::from(x[i].map(f64::from)) - node(&reference.x, i)).norm())
        .fold(0.0, f64::max);
    worst / reference.bbox_diagonal()
}
