//! femto's kernels, one by one and as whole steps, for a lane width and a layout.

use femto::element::Layout;
use femto::lane::Lanes;
use femto::material::Material;
use femto::mesh::Mesh;
use femto::operator::{Fit, Operator, RotationBlock, fit_rotations, rotate};
use femto::owned::{OwnedRest, OwnedState, OwnedWorkspace};
use femto::rest::Rest;
use femto::settings::{Settings, Start};
use femto::step::{self, step};

use femto_bench::baseline::{Baseline, Setup};
use femto_bench::clock::Kernel;

use crate::mesh::Scene;

/// Time step, seconds.
pub const DT: f32 = 0.01;

/// What all kernels have in common.
pub struct Body<L: Layout> {
    pub rest: OwnedRest<L>,
    pub x: Vec<[f32; 3]>,
    pub v: Vec<[f32; 3]>,
    pub rotations: Vec<RotationBlock>,
    pub rotated: Vec<L::Rotated>,
    /// The masses, in the body's units.
    pub inertia: Vec<f32>,
}

/// Rubber.
fn material() -> Material {
    Material::new(1e6, 0.4, 1000.0).expect("a valid material")
}

/// The same body in the usual pipeline.
pub fn baseline(scene: &Scene) -> Baseline {
    let (lambda, mu) = material().lame();
    let mut body = Baseline::new(&Setup {
        nodes: &scene.nodes,
        tets: &scene.tets,
        lame: [lambda, mu],
        density: 1000.0,
        gravity: [0.0; 3],
        held: &[],
        dt: DT.into(),
    });
    body.place(&scene.x, &scene.v);
    body
}

impl<L: Layout> Body<L> {
    pub fn new(scene: &Scene) -> Self {
        let mesh = Mesh::new(&scene.nodes, &scene.tets).expect("a valid mesh");
        let material = material();
        let rest = OwnedRest::new(&mesh, &material).expect("masses and stiffnesses in range");
        let view = rest.view();
        let mut rotations = vec![RotationBlock::ZERO; view.blocks.len()];
        fit_rotations::<f32, L>(&view, &scene.x, Fit::Cold, &mut rotations);
        let mut rotated = vec![L::ZERO_ROTATED; view.blocks.len()];
        let mut forces = vec![[0.0; 3]; scene.x.len()];
        rotate::<f32, L>(&view, &scene.x, &rotations, 1.0, &mut rotated, &mut forces);
        let inertia = view
            .masses
            .iter()
            .map(|m| m / view.header.mass_unit)
            .collect();
        Self {
            rest,
            x: scene.x.clone(),
            v: scene.v.clone(),
            rotations,
            rotated,
            inertia,
        }
    }

    /// M + h²K in the body's units.
    pub fn operator(&self) -> Operator<'_, L> {
        let rest = self.rest.view();
        let (mass, length) = (rest.header.mass_unit, rest.header.length_unit);
        let stiffness = DT * DT / mass / length / length;
        Operator {
            rest,
            rotated: &self.rotated,
            inertia: &self.inertia,
            stiffness,
        }
    }

    /// In the state of the scene, with what `start` needs to step from there.
    pub fn stepper<'a>(&'a self, settings: Settings<'a>) -> Stepper<'a, L> {
        let rest = self.rest.view();
        let workspace = OwnedWorkspace::new(&rest, &settings);
        let mut stepper = Stepper {
            body: self,
            rest,
            state: OwnedState::new(&rest, &settings),
            workspace,
            settings,
        };
        stepper.reset();
        stepper
    }
}

/// A body that can step from the same state again and again.
pub struct Stepper<'a, L: Layout> {
    body: &'a Body<L>,
    rest: Rest<'a, L>,
    state: OwnedState,
    workspace: OwnedWorkspace<L>,
    settings: Settings<'a>,
}

impl<L: Layout> Stepper<'_, L> {
    pub fn reset(&mut self) {
        let state = self.state.view_mut();
        state.x.copy_from_slice(&self.body.x);
        state.v.copy_from_slice(&self.body.v);
        state.rotations.copy_from_slice(&self.body.rotations);
    }

    pub fn step<R: Lanes>(&mut self) {
        let mut work = self.workspace.view_mut(&self.rest);
        let scene = step::Scene::default();
        let report = step::<R, L>(
            &self.rest,
            &mut self.state.view_mut(),
            &mut work,
            &scene,
            &self.settings,
        );
        assert!(report.advanced(), "{report:?}");
    }

    pub fn velocities(&self) -> &[[f32; 3]] {
        self.state.view().v
    }
}

/// The names of a layout's rows.
pub struct Rows {
    pub apply: &'static str,
    pub rotate: &'static str,
    pub diagonal: &'static str,
    pub step: &'static str,
    pub step_from_velocity: &'static str,
}

pub const FACTORED: Rows = Rows {
    apply: "apply, factored",
    rotate: "rotate, factored",
    diagonal: "diagonal, factored",
    step: "step Galerkin(1), factored",
    step_from_velocity: "step Velocity, factored",
};

pub const DENSE: Rows = Rows {
    apply: "apply, dense",
    rotate: "rotate, dense",
    diagonal: "diagonal, dense",
    step: "step Galerkin(1), dense",
    step_from_velocity: "step Velocity, dense",
};

pub const ONE_SWEEP: &str = "polar, 1 sweep";
pub const TWO_SWEEPS: &str = "polar, 2 sweeps";

/// Applications, rotations, the diagonal, and whole steps of five iterations and two sweeps.
pub fn kernels<'a, R: Lanes + 'a, L: Layout>(body: &'a Body<L>, rows: &Rows) -> Vec<Kernel<'a>> {
    let rest = body.rest.view();
    let nodes = rest.nodes.len();
    let operator = body.operator();
    let mut out = vec![[0.0; 3]; nodes];
    let apply = move || operator.apply::<R>(&body.v, &mut out);
    let (mut rotated, mut forces) = (
        vec![L::ZERO_ROTATED; rest.blocks.len()],
        vec![[0.0; 3]; nodes],
    );
    let rotate = move || {
        rotate::<R, L>(
            &rest,
            &body.x,
            &body.rotations,
            DT,
            &mut rotated,
            &mut forces,
        );
    };
    let mut blocks = vec![[0.0; 6]; nodes];
    let diagonal = move || operator.diagonal::<R>(&mut blocks);
    let step = |row, start| {
        let settings = Settings::new(DT)
            .expect("a positive time step")
            .with_start(start);
        Kernel::after(
            row,
            R::WIDTH,
            body.stepper(settings),
            Stepper::reset,
            Stepper::step::<R>,
        )
    };
    vec![
        Kernel::new(rows.apply, R::WIDTH, apply),
        Kernel::new(rows.rotate, R::WIDTH, rotate),
        Kernel::new(rows.diagonal, R::WIDTH, diagonal),
        step(rows.step, Start::Galerkin(1)),
        step(rows.step_from_velocity, Start::Velocity),
    ]
}

/// The polar decomposition, which knows no layout.
pub fn polar<'a, R: Lanes + 'a, L: Layout>(body: &'a Body<L>) -> Vec<Kernel<'a>> {
    [(ONE_SWEEP, 1), (TWO_SWEEPS, 2)]
        .into_iter()
        .map(|(row, sweeps)| {
            let (rest, mut rotations) = (body.rest.view(), body.rotations.clone());
            Kernel::new(row, R::WIDTH, move || {
                fit_rotations::<R, L>(&rest, &body.x, Fit::Warm(sweeps), &mut rotations);
            })
        })
        .collect()
}
