//! The solver, through whole steps with different budgets from one state, against the oracle's dense
//! solution v* of the same step (with the rotations that the state holds):
//!
//! * the error ‖v_k − v*‖_A never grows with the iterations, whatever the start and preconditioner,
//! * from rest ‖v_k‖_A never exceeds ‖v*‖_A,
//! * it sinks to rounding, and stays there however many iterations follow,
//! * useless vectors in W do no harm, and the report tells the truth.
//!
//! What rounding can do to the solution is ‖ρ‖ in the norm of A⁻¹, for a rounding ρ of the residual b − Av.
//! Of a tetrahedron's force h BᵀσV, σ = C (ε + h∇v), it is
//!
//! ```text
//! in the strain:    ρ = h Bᵀ C δε V, and BᵀCBV ≤ A/h² makes it ‖ρ‖² ≤ V δε·C δε,
//!                   δε = ε_f32 (Φ(x) + h Φ(v)),  Φ(u)² = Σ_j |u_j − u_0|² |g_j|²
//! after it:         ρ_i = ε_f32 h |σ| V |g_i|, and ε_f32 m (|v⁺| + |v| + h |g|) from the mass;
//!                   ‖ρ‖² = Σ_i ρ_i² (A⁻¹)_ii for independent signs
//! ```

use crate::support::factors;
use crate::support::reference::{node, stack};
use crate::support::scenes::{self, Setup};
use femto::element::Factored;
use femto::owned::{OwnedBody, OwnedState};
use femto::settings::{Budget, Preconditioner, Start};
use femto::step::StepReport;
use nalgebra::{DMatrix, DVector, Matrix3, Quaternion, UnitQuaternion};

/// A rounding is ½ ε at most and ¼ ε in the root mean square; some 16 of them, on the way to a strain or
/// a stress, add up to 4 times that.
const EPS: f64 = f32::EPSILON as f64;

/// The residual that a step reports, in ‖·‖: roundings counted in the stiffness tests, 73.
const ELEMENT: f64 = 3.0 * 8.6 * 0.5 * EPS;

const STARTS: [Start; 11] = [
    Start::Zero,
    Start::Velocity,
    Start::VelocityForce,
    Start::Galerkin(0),
    Start::Galerkin(1),
    Start::Galerkin(2),
    Start::Galerkin(3),
    Start::Galerkin(4),
    Start::Rigid(0),
    Start::Rigid(1),
    Start::Rigid(2),
];

/// One body in one state, and the step's system without the pinned nodes.
struct Step {
    setup: Setup,
    state: OwnedState,
    free: Vec<usize>,
    a: DMatrix<f64>,
    b: DVector<f64>,
    best: DVector<f64>,
    /// What rounding can do to v*, in ‖·‖_A.
    floor: f64,
    /// … and to the residual, in ‖·‖.
    residual_floor: f64,
}

impl Step {
    fn new(setup: &Setup, state: &OwnedState) -> Self {
        let mut oracle = setup.reference();
        let view = state.view();
        (oracle.x, oracle.v) = (stack(view.x), stack(view.v));
        let rotation = |e: usize| {
            let [w, x, y, z] = view.rotations[e / 8]
                .0
                .map(|component| f64::from(component[e % 8]));
            let q = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
            q.to_rotation_matrix().into_inner()
        };
        let q: Vec<Matrix3<f64>> = (0..setup.mesh.tets.len()).map(rotation).collect();
        let (a, b) = oracle.system(&q);
        let best = oracle.solve(&a, &b);
        let free: Vec<usize> = (0..b.len())
            .filter(|dof| oracle.pins[dof / 3].is_none())
            .collect();
        // b without what the pins take of it
        let mut held = best.clone();
        free.iter().for_each(|&dof| held[dof] = 0.0);
        let b = (b - &a * held).select_rows(&free);

        let (h, c_k) = (
            oracle.h,
            oracle.theta * oracle.h * (oracle.theta * oracle.h + oracle.beta),
        );
        let (mut strain_part, mut rho, mut reported) =
            (0.0, DVector::zeros(a.nrows()), DVector::zeros(a.nrows()));
        for (e, tet) in oracle.tets.iter().enumerate() {
            let g = &oracle.gradients[e];
            let spread = |u: &DVector<f64>| -> f64 {
                let edge = |j: usize| (node(u, tet[j]) - node(u, tet[0])).norm_squared();
                (1..4)
                    .map(|j| edge(j) * g[j].norm_squared())
                    .sum::<f64>()
                    .sqrt()
            };
            let symmetric =
                |u: &DVector<f64>| (q[e].transpose() * oracle.deformation(u, e)).symmetric_part();
            let stiff = oracle.volumes[e] * (oracle.lambda.abs() + 2.0 * oracle.mu);
            // h (ε + h∇v) in the step's own terms; over √c_K, which is h where nothing damps
            let gross = h * spread(&oracle.x) + c_k * spread(&best);
            let net = h * (symmetric(&oracle.x) - Matrix3::identity()).norm()
                + c_k * symmetric(&best).norm();
            strain_part += stiff * (EPS * gross).powi(2) / c_k;
            for (&i, g) in tet.iter().zip(g) {
                rho.fixed_rows_mut::<3>(3 * i)
                    .add_scalar_mut(EPS * stiff * g.norm() * net);
                reported
                    .fixed_rows_mut::<3>(3 * i)
                    .add_scalar_mut(ELEMENT * stiff * g.norm() * gross);
            }
        }
        for dof in 0..rho.len() {
            let speeds = best[dof].abs() + oracle.v[dof].abs() + h * oracle.gravity[dof % 3].abs();
            rho[dof] += EPS * oracle.masses[dof / 3] * speeds;
        }
        let a = a.select_rows(&free).select_columns(&free);
        let inverse = a.clone().try_inverse().expect("A is positive definite");
        let rho = rho.select_rows(&free);
        let later = rho.component_mul(&rho).dot(&inverse.diagonal());
        let residual_floor = (reported.select_rows(&free) + rho * (ELEMENT / EPS)).norm();
        let floor = (strain_part + later).sqrt();
        Self {
            setup: setup.clone(),
            state: state.clone(),
            b,
            best: best.select_rows(&free),
            free,
            a,
            floor,
            residual_floor,
        }
    }

    fn solver<'a>(&'a self, start: Start, preconditioner: Preconditioner<'a>) -> Solver<'a> {
        let settings = self.setup.solver(start, preconditioner, 0);
        let body = self.setup.body(&settings);
        Solver {
            step: self,
            body,
            start,
            preconditioner,
        }
    }

    fn norm(&self, v: &DVector<f64>) -> f64 {
        (&self.a * v).dot(v).sqrt()
    }

    fn error(&self, v: &[[f32; 3]]) -> f64 {
        self.norm(&(stack(v).select_rows(&self.free) - &self.best))
    }

    /// The numbers of a report against the oracle's.
    fn check_report(&self, v: &[[f32; 3]], report: &StepReport, iterations: u32) {
        let near = |found: f32, expected: f64| {
            let off = (f64::from(found) - expected).abs();
            assert!(
                off <= self.residual_floor,
                "{expected:e} is off by {off:e}: {report:?}"
            );
        };
        let v = stack(v).select_rows(&self.free);
        let residual = (&self.b - &self.a * v).norm();
        near(report.residual_after, residual);
        if iterations == 0 {
            near(report.residual_before, residual);
        }
        assert!(report.residual_before >= 0.0 && report.residual_before.is_finite());
        assert!(report.rhs > 0.0 && report.rhs.is_finite());
        // Moving pins are not part of b.
        if self.setup.pins.iter().all(|(_, v)| *v == [0.0; 3]) {
            near(report.rhs, self.b.norm());
        }
        assert!(
            report.updates <= iterations && report.contacts == 0,
            "{report:?}"
        );
        let relative = report.residual_after / report.rhs;
        assert_eq!(report.relative_residual(), relative);
    }
}

/// One way to take a step, as often as one likes.
struct Solver<'a> {
    step: &'a Step,
    body: OwnedBody<Factored>,
    start: Start,
    preconditioner: Preconditioner<'a>,
}

impl Solver<'_> {
    /// v_k; the report is checked.
    fn run(&mut self, iterations: u32) -> (Vec<[f32; 3]>, StepReport) {
        let step = self.step;
        self.run_with(iterations, step.state.view().history)
    }

    fn run_with(&mut self, iterations: u32, history: &[[f32; 3]]) -> (Vec<[f32; 3]>, StepReport) {
        let (to, from) = (self.body.state_mut().view_mut(), self.step.state.view());
        to.x.copy_from_slice(from.x);
        to.v.copy_from_slice(from.v);
        to.rotations.copy_from_slice(from.rotations);
        let kept = to.history.len();
        to.history.copy_from_slice(&history[..kept]);
        let setup = &self.step.setup;
        let report = take(
            &mut self.body,
            setup,
            self.start,
            self.preconditioner,
            iterations,
        );
        let v = self.body.velocities().to_vec();
        self.step.check_report(&v, &report, iterations);
        (v, report)
    }

    /// ‖v_k − v*‖_A
    fn error(&mut self, iterations: u32) -> f64 {
        let (v, _) = self.run(iterations);
        self.step.error(&v)
    }
}

fn take(
    body: &mut OwnedBody<Factored>,
    setup: &Setup,
    start: Start,
    preconditioner: Preconditioner,
    iterations: u32,
) -> StepReport {
    let pins = setup.pin_list();
    let settings = setup
        .settings()
        .with_budget(Budget {
            iterations,
            polar_sweeps: 2,
        })
        .with_start(start)
        .with_preconditioner(preconditioner);
    let report = body.step(&setup.scene(&pins), &settings);
    assert!(report.advanced(), "{}, {start:?}: {report:?}", setup.name);
    report
}

/// Some truncated steps into a scene, so that the history is one that a run would have.
fn under_way(setup: &Setup) -> Step {
    let start = Start::Galerkin(4);
    let mut body = setup.body::<Factored>(start);
    for _ in 0..6 {
        _ = take(&mut body, setup, start, Preconditioner::Jacobi, 10);
    }
    Step::new(setup, body.state())
}

/// E = 1e9, ν = 0.49, h = 1/60.
fn stiff() -> [Setup; 3] {
    let scenes = [scenes::cantilever(), scenes::free_spin(), scenes::two()];
    scenes.map(|setup| Setup {
        name: "stiff",
        young: 1e9,
        poisson: 0.49,
        h: 1.0 / 60.0,
        ..setup
    })
}

/// Converged: the floor of b; that of A v; the recurrence's drift from b − A v, which rounds as that does;
/// and what is left when the residual is taken for rounding.
const CONVERGED: f64 = 4.0;

#[test]
fn the_error_never_grows() {
    for setup in scenes::all().into_iter().chain(stiff()) {
        let step = under_way(&setup);
        // v + hM⁻¹f is no start for stiff bodies: its residual is 1e5 times that of v = 0.
        let starts = STARTS
            .iter()
            .filter(|&&s| setup.name != "stiff" || s != Start::VelocityForce);
        let all: Vec<_> = (0..factors::COUNT)
            .map(|which| factors::preconditioner(&setup, which))
            .collect();
        for (&start, which) in starts.flat_map(|s| (0..factors::COUNT).map(move |p| (s, p))) {
            let (preconditioner, kind) = (all[which], factors::name(which));
            let mut solver = step.solver(start, preconditioner);
            let (mut least, mut updates) = (f64::INFINITY, 0);
            // (A Laplacian factor with three vectors in W is there after 60 iterations, and 900 more, in
            // W's rounding, take it from one floor to two.)
            let last = match (setup.name, preconditioner) {
                ("stiff", Preconditioner::Factored(_)) => [200, 400],
                ("stiff", _) => [200, 1000],
                _ => [100, 200],
            };
            for iterations in (0..=40).chain(last) {
                let case = format!("{}, {start:?}, {kind}, {iterations}", setup.name);
                let (v, report) = solver.run(iterations);
                assert!(report.updates >= updates, "{case}");
                updates = report.updates;
                let (error, floor) = (step.error(&v), step.floor);
                assert!(
                    error <= least + floor,
                    "{case}: {error:e} after {least:e}, floor {floor:e}"
                );
                least = least.min(error);
                // The A-norm rises to that of v* from below.
                if start == Start::Zero {
                    let v = stack(&v).select_rows(&step.free);
                    let excess = step.norm(&v) - step.norm(&step.best);
                    assert!(
                        excess <= floor,
                        "{case}: ‖v‖ is {excess:e} above ‖v*‖, floor {floor:e}"
                    );
                }
            }
            let converged = CONVERGED * step.floor;
            let last = solver.error(1000);
            assert!(
                last <= converged,
                "{}, {start:?}, {kind}: {last:e} in the end",
                setup.name
            );
            assert!(
                least <= converged,
                "{}, {start:?}, {kind}: {least:e} > {converged:e}",
                setup.name
            );
        }
    }
}

/// A thousand iterations a step, where thirty would do.
#[test]
fn iterations_past_convergence_do_nothing() {
    let starts = (1..=4).map(Start::Galerkin).chain([Start::Rigid(2)]);
    let scenes = stiff();
    for (setup, start) in scenes
        .iter()
        .flat_map(|s| starts.clone().map(move |start| (s, start)))
    {
        let (mut body, mut frozen) = (setup.body::<Factored>(start), 0);
        for count in 0..50 {
            if count % 7 == 0 {
                let step = Step::new(setup, body.state());
                let mut solver = step.solver(start, Preconditioner::Jacobi);
                let (v, report) = solver.run(1000);
                let case = format!("{start:?}, step {count}, {report:?}");
                // Where it froze, no bit moves any more; where it did not, it turns at the floor.
                frozen += u32::from(report.updates < 1000);
                assert!(v == solver.run(report.updates).0, "{case}");
                let error = step.error(&v);
                for iterations in [0, 3, 10, 30, 100] {
                    let before = solver.error(iterations);
                    assert!(
                        error <= before + step.floor,
                        "{case}: {error:e} after {before:e}"
                    );
                }
                let converged = CONVERGED * step.floor;
                assert!(error <= converged, "{case}: {error:e} > {converged:e}");
            }
            _ = take(&mut body, setup, start, Preconditioner::Jacobi, 1000);
        }
        assert!(frozen > 0, "{start:?}: nothing to be seen");
    }
}

/// Zero, parallel, huge and non-finite vectors in W: whatever is of no use is dropped, and the
/// Galerkin solution is never worse than without them.
#[test]
fn useless_history_does_no_harm() {
    let rest = Setup {
        v: vec![[0.0; 3]; 63],
        ..scenes::free_spin()
    };
    let rest = Step::new(&rest, rest.body::<Factored>(Start::Galerkin(4)).state());
    let moving = [
        scenes::free_spin(),
        scenes::cantilever(),
        stiff()[1].clone(),
    ];
    for step in [rest].into_iter().chain(moving.iter().map(under_way)) {
        let state = step.state.view();
        let all: Vec<_> = (0..factors::COUNT)
            .map(|which| factors::preconditioner(&step.setup, which))
            .collect();
        let scaled = |by: f32| {
            state
                .v
                .iter()
                .map(|v| v.map(|c| c * by))
                .collect::<Vec<_>>()
        };
        let bent = |by: f32| {
            state
                .x
                .iter()
                .map(|&[x, y, z]| [by * y, -by * z, by * x * y])
                .collect()
        };
        let junk = [0.0, 1.0, 1.0 + f32::EPSILON, -1e-20, 1e15, 1e36, f32::NAN].map(scaled);
        let junk = junk
            .into_iter()
            .chain([1.0, 1e-15, 1e15, 1e38, f32::INFINITY].map(bent));
        for (kind, past) in junk.enumerate() {
            let history = [past.clone(), past.clone(), past].concat();
            for (which, &preconditioner) in all.iter().enumerate() {
                let alone = step.solver(Start::Galerkin(1), preconditioner).error(0);
                for start in [Start::Galerkin(2), Start::Galerkin(4), Start::Rigid(2)] {
                    let mut solver = step.solver(start, preconditioner);
                    for (iterations, bound) in [(0, alone), (300, CONVERGED * step.floor)] {
                        let error = step.error(&solver.run_with(iterations, &history).0);
                        let name = factors::name(which);
                        let case = format!("{}, {start:?}, {name}", step.setup.name);
                        assert!(
                            error <= bound + step.floor,
                            "{case}, kind {kind}: {error:e} > {bound:e}"
                        );
                    }
                }
            }
        }
    }
}
