//! A free, spinning bar for five seconds: what truncation does to energy and momentum.

use femto::energy::{self, Rotations};
use femto::owned::OwnedState;
use femto::{Budget, Start};

use crate::Run;
use crate::measure::square;
use crate::method::Method;
use crate::methods::ours::{self, Ours, SOLVERS, Solver};
use crate::output::{Done, Output, exact, short};
use crate::plot::{Plot, Series};
use crate::problem::{H, Problem, free_bar};

/// As good as others that are here.
const SKIPPED: [&str; 4] = [
    "galerkin-3, jacobi",
    "galerkin-2, warped",
    "galerkin-1, warped in f16",
    ours::THINNED_1.name,
];

/// What five seconds did, relative to the start.
struct Account {
    /// Highest total energy.
    total: f64,
    /// Highest and last kinetic energy.
    kinetic: [f64; 2],
    /// Highest and last |L|.
    angular: [f64; 2],
    /// The most that a step raised the energy with its own rotations, which the theorem excludes, and
    /// the most that fitting new rotations raised it.
    step: f64,
    refit: f64,
    /// Kinetic energy over time.
    track: Vec<(f64, f64)>,
}

fn length(u: [f64; 3]) -> f64 {
    square(u).sqrt()
}

fn account(problem: &Problem, solver: Solver, iterations: u32, steps: usize) -> Account {
    let budget = Budget {
        iterations,
        polar_sweeps: 2,
    };
    let mut ours = Ours::new(problem, H, solver, budget);
    let start = ours.body.energies(problem.gravity());
    let spin = |ours: &Ours| length(about_centre(ours));
    let momentum = spin(&ours);
    let mut out = Account {
        total: 1.0,
        kinetic: [1.0; 2],
        angular: [1.0; 2],
        step: 0.0,
        refit: 0.0,
        track: vec![(0.0, 1.0)],
    };
    let unit = start.total();
    let mut stored = stored_energy(&ours, ours.body.state());
    for step in 1..=steps {
        let before = ours.body.state().clone();
        ours.step();
        let frozen = stored_energy(&ours, &before);
        let refitted = stored_energy(&ours, ours.body.state());
        out.step = out.step.max((frozen - stored) / unit);
        out.refit = out.refit.max((refitted - frozen) / unit);
        stored = refitted;
        if step % 10 == 0 {
            let energies = ours.body.energies(problem.gravity());
            out.total = out.total.max(energies.total() / unit);
            let kinetic = energies.kinetic / start.kinetic;
            out.kinetic = [out.kinetic[0].max(kinetic), kinetic];
            let angular = spin(&ours) / momentum;
            out.angular = [out.angular[0].max(angular), angular];
            out.track.push((H * step as f64, kinetic));
        }
        if !stored.is_finite() {
            out.total = f64::INFINITY;
            break;
        }
    }
    out
}

/// Kinetic energy now, and elastic with the rotations of some state.
fn stored_energy(ours: &Ours, rotations: &OwnedState) -> f64 {
    let (rest, now) = (ours.body.rest(), ours.body.state().view());
    let each = rest.masses.iter().zip(now.v);
    let kinetic: f64 = each
        .map(|(m, v)| 0.5 * f64::from(*m) * square(v.map(f64::from)))
        .sum();
    let mut view = now;
    view.rotations = rotations.view().rotations;
    kinetic + energy::elastic(&rest, &view, Rotations::Stored)
}

/// Angular momentum about the centre of mass.
fn about_centre(ours: &Ours) -> [f64; 3] {
    let rest = ours.body.rest();
    let momenta = ours.body.momenta();
    let mut centre = [0.0; 3];
    for (m, x) in rest.masses.iter().zip(ours.body.positions()) {
        for a in 0..3 {
            centre[a] += f64::from(*m) * f64::from(x[a]) / f64::from(rest.header.total_mass);
        }
    }
    let ([x, y, z], [px, py, pz]) = (centre, momenta.linear);
    let orbit = [y * pz - z * py, z * px - x * pz, x * py - y * px];
    [0, 1, 2].map(|a| momenta.angular[a] - orbit[a])
}

pub fn chapter(study: &Run, out: &mut Output) -> Done {
    out.text("## A free, spinning bar");
    out.text(
        "A bar of 1 m, thrown and spinning in weightlessness, five seconds at h = 1/150 s. All figures are \
         relative to the start. \"step\" is the most that a step raised the energy with its own, frozen rotations \
         (the theorem says: never, to rounding); \"refit\" the most that fitting the rotations anew raised it.",
    );
    let steps = if study.quick { 75 } else { 750 };
    let (stiffness, counts): (&[f32], &[u32]) = match study.quick {
        true => (&[1e6], &[1, 5]),
        false => (&[1e5, 1e6, 1e7, 1e8], &[1, 2, 3, 5, 10, 20]),
    };
    let mut rows = Vec::new();
    let mut worst: Vec<(Solver, [f64; 6])> = Vec::new();
    let mut tracks = Vec::new();
    for solver in SOLVERS
        .into_iter()
        .filter(|s| s.theta == 1.0 && !SKIPPED.contains(&s.name))
    {
        study.progress(&format!("spin: {}", solver.name));
        let mut most = [
            0.0_f64,
            0.0,
            0.0,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NEG_INFINITY,
        ];
        for &young in stiffness {
            let problem = free_bar(young)?;
            for &k in counts {
                let a = account(&problem, solver, k, steps);
                rows.push(
                    [
                        vec![solver.name.into(), format!("{young:e}"), k.to_string()],
                        [
                            a.total,
                            a.kinetic[0],
                            a.kinetic[1],
                            a.angular[0],
                            a.angular[1],
                            a.step,
                            a.refit,
                        ]
                        .map(exact)
                        .to_vec(),
                    ]
                    .concat(),
                );
                most = [
                    most[0].max(a.total),
                    most[1].max(a.kinetic[0]),
                    most[2].max(a.angular[0]),
                    most[3].min(a.angular[1]),
                    most[4].max(a.step),
                    most[5].max(a.refit),
                ];
                if k == 5 && young == 1e6 {
                    tracks.push(Series::new(solver.name, a.track));
                }
            }
        }
        worst.push((solver, most));
    }
    let lines: Vec<_> = worst
        .iter()
        .map(|(solver, m)| [vec![solver.name.to_string()], m.map(short).to_vec()].concat())
        .collect();
    out.text(&format!(
        "Worst of E = {} Pa and {counts:?} iterations:",
        stiffness
            .iter()
            .map(|e| format!("{e:e}"))
            .collect::<Vec<_>>()
            .join(", ")
    ));
    out.table(
        &[
            "solver",
            "highest total energy",
            "highest kinetic",
            "highest \\|L\\|",
            "lowest final \\|L\\|",
            "step",
            "refit",
        ],
        &lines,
    );
    let mut broken = Vec::new();
    for (solver, [_, kinetic, angular, _, step, _]) in &worst {
        let stable = matches!(solver.start, Start::Galerkin(_) | Start::Rigid(_));
        if stable && (*kinetic > 1.01 || *angular > 1.01 || *step > 1e-6) {
            broken.push(solver.name);
        }
    }
    out.text(&format!(
        "Bound for all `galerkin` and `rigid` rows: kinetic energy and |L| stay below 1.01 of the start, and a step raises \
         the energy with its own rotations by less than 1e-6 of it: {}. What the total energy gains, it gains by the \
         refitting of rotations: a solve that is stopped early leaves a stiff body longer than a rotation does.",
        if broken.is_empty() { "holds".to_string() } else { format!("BROKEN by {}", broken.join("; ")) }
    ));
    out.plot(
        "spin-energy",
        &Plot {
            title: "Kinetic energy over time, E = 1e6 Pa, 5 iterations".into(),
            x: "seconds",
            y: "kinetic energy over that at the start",
            log: [false, false],
            series: tracks,
        },
    )?;
    out.csv(
        "spin",
        &[
            "solver",
            "young",
            "iterations",
            "total_max",
            "kinetic_max",
            "kinetic_end",
            "angular_max",
            "angular_end",
            "step_max",
            "refit_max",
        ],
        &rows,
    )
}
