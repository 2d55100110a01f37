//! Runs a hard case with a solver, and says what became of it.

use femto::element::Factored;
use femto::energy::{self, Rotations};
use femto::glam::Vec3;
use femto::owned::OwnedRest;
use femto::preconditioner::aggregate::{Aggregates, DEFAULT_AGGREGATES};
use femto::state::StateRef;
use femto::{Budget, Material, Mesh, OwnedBody, Pin, Preconditioner, Scene, Settings, Start};
use femto_bake::{FactorOptions, Kind, OwnedFactor, factor};

use super::cases::Case;

pub const STARTS: [(&str, Start); 7] = [
    ("zero", Start::Zero),
    ("velocity", Start::Velocity),
    ("velocity-force", Start::VelocityForce),
    ("galerkin-1", Start::Galerkin(1)),
    ("galerkin-2", Start::Galerkin(2)),
    ("rigid-1", Start::Rigid(1)),
    ("rigid-2", Start::Rigid(2)),
];
pub const PRECONDITIONERS: [&str; 7] = [
    "identity",
    "mass",
    "jacobi",
    "block-jacobi",
    "two-level",
    "laplacian",
    "warped",
];
pub const ITERATIONS: [u32; 4] = [1, 2, 5, 20];

/// Energies that rise by less than this part of the first have risen by rounding.
const ROUNDING: f64 = 1e-3;
/// A body has recovered when so little of its elastic energy is left.
const RECOVERED: f64 = 1e-3;

/// What became of a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// A constructor or the first step said no.
    Refused(String),
    /// A later step said no: the state had grown out of range.
    Lost,
    /// It ran to its end.
    Ran {
        /// Highest kinetic and elastic energy over the first.
        growth: f64,
        /// The most that a step raised the energy at its own, frozen rotations, over the first.
        step: f64,
        /// Seconds after which less than [`RECOVERED`] of the elastic energy was left, for good.
        recovered: Option<f64>,
        /// Smallest det F at the end.
        least_det: f64,
    },
}

impl Outcome {
    /// As the table has it: what happened to the energy, and when the rest shape was back.
    pub fn cell(&self) -> String {
        match self {
            Self::Refused(_) => "refused".into(),
            Self::Lost => "LOST".into(),
            Self::Ran {
                growth,
                recovered,
                least_det,
                ..
            } => {
                let energy = match growth {
                    g if *g <= 1.0 + ROUNDING => "ok".to_string(),
                    g if *g < 1.995 => format!("+{:.0}%", 100.0 * (g - 1.0)),
                    g if *g < 1000.0 => format!("x{g:.0}"),
                    _ => "BLOWN".into(),
                };
                let inverted = if *least_det < 0.0 { " inv" } else { "" };
                match recovered {
                    Some(seconds) => format!("{energy} {seconds:.2}"),
                    None => format!("{energy} -{inverted}"),
                }
            }
        }
    }

    /// Whether an energy-stable start may end like this.
    pub fn is_bounded(&self) -> bool {
        matches!(self, Self::Ran { step, .. } if *step <= ROUNDING)
    }
}

/// The materials of a case, one a tetrahedron.
pub fn materials(case: &Case) -> Vec<Material> {
    let [light, heavy] = case
        .densities
        .map(|density| Material::new(case.young, case.poisson, density).expect("a valid material"));
    let xs = case.mesh.nodes.iter().map(|x| x[0]);
    let (low, high) = xs.fold((f32::MAX, f32::MIN), |(l, h), x| (l.min(x), h.max(x)));
    let x = |&i: &u32| case.mesh.nodes[i as usize][0];
    let far = |tet: &[u32; 4]| tet.iter().map(x).sum::<f32>() > 2.0 * (low + high);
    let of = |tet| if far(tet) { heavy } else { light };
    case.mesh.tets.iter().map(of).collect()
}

/// One run.
pub fn run(case: &Case, start: Start, preconditioner: &str, budget: Budget) -> Outcome {
    let rest = Mesh::new(&case.mesh.nodes, &case.mesh.tets)
        .and_then(|mesh| OwnedRest::<Factored>::new(&mesh, materials(case).as_slice()));
    let rest = match rest {
        Ok(rest) => rest,
        Err(e) => return Outcome::Refused(e.to_string()),
    };
    let settings = Settings::new(case.h)
        .expect("a valid step")
        .with_start(start)
        .with_budget(budget);
    let kind = match preconditioner {
        "warped" => Some(Kind::Warped),
        "laplacian" => Some(Kind::Laplacian),
        _ => None,
    };
    let made: Option<OwnedFactor> = match kind {
        None => None,
        Some(kind) => {
            let options = FactorOptions {
                kind,
                held: case.pins.clone(),
                ..FactorOptions::default()
            };
            match factor(&rest.view(), &settings, &options) {
                Ok(made) => Some(made),
                Err(e) => return Outcome::Refused(format!("no factor: {e}")),
            }
        }
    };
    let view = made.as_ref().map(OwnedFactor::view);
    let mut of = vec![0; rest.view().nodes.len()];
    let chosen = match (preconditioner, &view) {
        (_, Some(factor)) => Preconditioner::Factored(factor),
        ("identity", _) => Preconditioner::Identity,
        ("mass", _) => Preconditioner::Mass,
        ("block-jacobi", _) => Preconditioner::BlockJacobi,
        ("two-level", _) => Preconditioner::TwoLevel(
            Aggregates::divide(&rest.view(), DEFAULT_AGGREGATES, &mut of)
                .expect("one entry a node"),
        ),
        _ => Preconditioner::Jacobi,
    };
    let settings = settings.with_preconditioner(chosen);
    let mut body = OwnedBody::from_rest(rest.clone(), &settings);
    if let Err(e) = body.place(&case.x, &case.v) {
        return Outcome::Refused(e.to_string());
    }
    follow(case, &mut body, &settings)
}

fn follow(case: &Case, body: &mut OwnedBody, settings: &Settings<'_>) -> Outcome {
    let pins: Vec<Pin> = case.pins.iter().map(|&node| Pin::held(node)).collect();
    let mut forces = vec![[0.0; 3]; case.x.len()];
    forces[0][1] = case.force;
    let scene = Scene {
        pins: &pins,
        forces: &forces,
        ..Scene::default()
    };
    let first = body.energies(Vec3::ZERO);
    let (mut growth, mut worst, mut back) = (1.0_f64, 0.0_f64, None);
    for step in 1..=case.steps {
        let before = body.state().clone();
        let report = body.step(&scene, settings);
        if let Some(refusal) = report.refusal {
            assert_eq!(*body.state(), before, "a refused step left a trace");
            return match step {
                1 => Outcome::Refused(refusal.to_string()),
                _ => Outcome::Lost,
            };
        }
        let rise = frozen(body, &before.view(), body.state().view()) - stored(body, &before.view());
        worst = worst.max(rise / first.total());
        let now = body.energies(Vec3::ZERO);
        growth = growth.max(now.total() / first.total());
        if now.elastic > RECOVERED * first.elastic {
            back = None;
        } else if back.is_none() {
            back = Some(f64::from(step) * f64::from(case.h));
        }
    }
    Outcome::Ran {
        growth,
        step: worst,
        recovered: back,
        least_det: body.min_det(),
    }
}

/// Kinetic energy, and elastic with the state's own rotations.
fn stored(body: &OwnedBody, state: &StateRef<'_>) -> f64 {
    frozen(body, state, *state)
}

/// Kinetic energy of a state, and elastic with another's rotations.
fn frozen(body: &OwnedBody, rotations: &StateRef<'_>, state: StateRef<'_>) -> f64 {
    let rest = body.rest();
    let kinetic: f64 = rest
        .masses
        .iter()
        .zip(state.v)
        .map(|(m, v)| 0.5 * f64::from(*m) * v.iter().map(|c| f64::from(*c).powi(2)).sum::<f64>())
        .sum();
    let mut view = state;
    view.rotations = rotations.rotations;
    kinetic + energy::elastic(&rest, &view, Rotations::Stored)
}

/// One line of the table.
pub struct Line {
    pub case: usize,
    pub start: usize,
    pub preconditioner: usize,
    /// After [`ITERATIONS`].
    pub outcomes: Vec<Outcome>,
}

/// All starts, preconditioners and iteration counts, on as many threads as there are.
pub fn table(cases: &[Case], polar_sweeps: u32) -> Vec<Line> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let places: Vec<(usize, usize, usize)> = (0..cases.len())
        .flat_map(|c| {
            (0..STARTS.len()).flat_map(move |s| (0..PRECONDITIONERS.len()).map(move |p| (c, s, p)))
        })
        .collect();
    let line = |&(case, start, preconditioner): &(usize, usize, usize)| Line {
        case,
        start,
        preconditioner,
        outcomes: ITERATIONS
            .iter()
            .map(|&iterations| {
                let budget = Budget {
                    iterations,
                    polar_sweeps,
                };
                run(
                    &cases[case],
                    STARTS[start].1,
                    PRECONDITIONERS[preconditioner],
                    budget,
                )
            })
            .collect(),
    };
    let mut lines: Vec<Line> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads)
            .map(|first| {
                let mine = places.iter().skip(first).step_by(threads);
                scope.spawn(move || mine.map(line).collect::<Vec<_>>())
            })
            .collect();
        workers
            .into_iter()
            .flat_map(|w| w.join().expect("a run that does not panic"))
            .collect()
    });
    lines.sort_by_key(|l| (l.case, l.start, l.preconditioner));
    lines
}
