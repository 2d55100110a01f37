//! Closed forms, with refinement.

use femto::element::Factored;
use femto::glam::Vec3;
use femto::{Budget, Scene, Settings, Start};

use crate::Run;
use crate::method::Method;
use crate::methods::ours::{Ours, Solver};
use crate::output::{Done, Output, exact, short};
use crate::problem::{Problem, box_mesh};
use crate::statics::{Mass, lowest_frequency, settled};

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

const LENGTH: f64 = 1.0;
const THICKNESS: f64 = 0.1;
const YOUNG: f64 = 1e7;
const DENSITY: f64 = 1000.0;
/// Second moment of area.
const INERTIA: f64 = THICKNESS * THICKNESS * THICKNESS * THICKNESS / 12.0;

/// A slender beam, clamped at x = 0, `n` cells through its thickness and ten times as many along.
fn beam(n: u32, poisson: f32) -> Outcome<Problem> {
    let mesh = box_mesh([LENGTH, THICKNESS, THICKNESS], [10 * n, n, n])?;
    let mut beam = Problem::new("beam", "", mesh, YOUNG as f32).hold(|x| x[0] < 1e-6);
    beam.poisson = poisson;
    Ok(beam)
}

fn tip(problem: &Problem, x: &[[f32; 3]]) -> [f64; 3] {
    let far = |i: &usize| f64::from(problem.nodes[*i][0]) > LENGTH - 1e-4;
    let tip: Vec<usize> = (0..x.len()).filter(far).collect();
    let mean = |a: usize| tip.iter().map(|&i| f64::from(x[i][a])).sum::<f64>() / tip.len() as f64;
    let rest = |a: usize| {
        tip.iter()
            .map(|&i| f64::from(problem.nodes[i][a]))
            .sum::<f64>()
            / tip.len() as f64
    };
    [0, 1, 2].map(|a| mean(a) - rest(a))
}

/// One quantity at several refinements, with what it should be.
struct Ladder {
    name: &'static str,
    /// Of the mesh or the step, as a text and relative to the first.
    sizes: Vec<(String, f64)>,
    found: Vec<f64>,
    exact: f64,
    expected: &'static str,
}

impl Ladder {
    fn rows(&self) -> Vec<Vec<String>> {
        let errors: Vec<f64> = self
            .found
            .iter()
            .map(|f| (f - self.exact).abs() / self.exact.abs())
            .collect();
        (0..self.found.len())
            .map(|k| {
                let order = (k > 0).then(|| {
                    (errors[k - 1] / errors[k]).ln() / (self.sizes[k - 1].1 / self.sizes[k].1).ln()
                });
                vec![
                    self.name.to_string(),
                    self.sizes[k].0.clone(),
                    format!("{:.5}", self.found[k]),
                    format!("{:.5}", self.exact),
                    short(errors[k]),
                    order.map_or(String::new(), |o| format!("{o:.1}")),
                    self.expected.to_string(),
                ]
            })
            .collect()
    }
}

fn through(ns: &[u32]) -> Vec<(String, f64)> {
    ns.iter()
        .map(|n| (format!("{n} cells through"), 1.0 / f64::from(*n)))
        .collect()
}

/// Its own weight, small; Timoshenko's beam, with shear.
fn deflection(n: u32, poisson: f32) -> Outcome<(f64, f64)> {
    let gravity = 1.0;
    let mut beam = beam(n, poisson)?;
    beam.gravity = [0.0, -gravity as f32, 0.0];
    let x = settled(&beam, &[], 0.25, 150);
    let shear = YOUNG / (2.0 * (1.0 + f64::from(poisson)));
    let load = DENSITY * gravity * THICKNESS * THICKNESS;
    let exact = load * LENGTH.powi(4) / (8.0 * YOUNG * INERTIA)
        + load * LENGTH.powi(2) / (2.0 * 5.0 / 6.0 * shear * THICKNESS * THICKNESS);
    Ok((-tip(&beam, &x)[1], exact))
}

/// Tip of the elastica under a dead load P at its end: (horizontal, vertical) shift over the length, by
/// shooting on EI θ'' = −P cos θ, θ(0) = 0, θ'(L) = 0, with RK4.
fn elastica(load: f64) -> [f64; 2] {
    let shoot = |slope: f64| {
        let (steps, mut s) = (2000, [0.0, slope, 0.0, 0.0]); // θ, θ', x, y
        let h = 1.0 / f64::from(steps);
        let rate = |s: [f64; 4]| [s[1], -load * s[0].cos(), s[0].cos(), s[0].sin()];
        let along = |s: [f64; 4], k: [f64; 4], h: f64| [0, 1, 2, 3].map(|i| s[i] + h * k[i]);
        for _ in 0..steps {
            let a = rate(s);
            let b = rate(along(s, a, h / 2.0));
            let c = rate(along(s, b, h / 2.0));
            let d = rate(along(s, c, h));
            s = [0, 1, 2, 3].map(|i| s[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        }
        s
    };
    let (mut low, mut high) = (0.0, 2.0 * load);
    for _ in 0..80 {
        let middle = f64::midpoint(low, high);
        if shoot(middle)[1] < 0.0 {
            low = middle
        } else {
            high = middle
        }
    }
    let end = shoot(low);
    [1.0 - end[2], end[3]]
}

/// The same on femto's beam, with P L²/(EI) = `load`.
fn bent(n: u32, load: f64) -> Outcome<[f64; 2]> {
    let beam = beam(n, 0.0)?;
    let force = load * YOUNG * INERTIA / LENGTH.powi(2);
    let tips: Vec<usize> = (0..beam.nodes.len())
        .filter(|&i| f64::from(beam.nodes[i][0]) > LENGTH - 1e-4)
        .collect();
    let mut forces = vec![[0.0; 3]; beam.nodes.len()];
    for &i in &tips {
        forces[i][1] = (force / tips.len() as f64) as f32;
    }
    let x = settled(&beam, &forces, 0.25, 200);
    let [along, up, _] = tip(&beam, &x);
    Ok([-along / LENGTH, up / LENGTH])
}

/// Speed of a wave along a rod in m/s, from the period of its lowest axial mode, 4L/c.
fn wave_speed(n: u32) -> Outcome<f64> {
    let mesh = box_mesh([1.0, 0.1, 0.1], [n, 2, 2])?;
    let quarter = std::f64::consts::FRAC_PI_2;
    let mut rod = Problem::new("rod", "", mesh, 1e6)
        .hold(|x| x[0] < 1e-6)
        .start(|x| [(1e-2 * (quarter * f64::from(x[0])).sin()) as f32, 0.0, 0.0]);
    rod.poisson = 0.0;
    let period = 4.0 / (1e6_f64 / DENSITY).sqrt();
    let h = period / 800.0;
    let solver = Solver {
        theta: 0.5,
        ..Solver::new(Start::Velocity, femto::Preconditioner::Jacobi)
    };
    let budget = Budget {
        iterations: 60,
        polar_sweeps: 2,
    };
    let mut ours = Ours::new(&rod, h, solver, budget);
    let end = rod
        .nodes
        .iter()
        .position(|x| x[0] > 1.0 - 1e-4)
        .ok_or("no tip")?;
    let (mut crossings, mut before) = (Vec::new(), 0.0);
    for step in 1..=2000_u32 {
        ours.step();
        let now = f64::from(ours.body.positions()[end][0]) - f64::from(rod.nodes[end][0]);
        if step > 10 && (now > 0.0) != (before > 0.0) {
            crossings.push(h * (f64::from(step) - now / (now - before)));
        }
        before = now;
    }
    let (first, last) = (
        crossings.first().ok_or("no crossing")?,
        crossings.last().ok_or("no crossing")?,
    );
    Ok(4.0 / (2.0 * (last - first) / (crossings.len() - 1) as f64))
}

/// An affine state of the boundary must be an affine state of the inside: RMS error over the displacement.
fn patch() -> Outcome<f64> {
    let (nodes, tets) = box_mesh([1.0; 3], [4; 3])?;
    let mut seed = 7_u32;
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 / 8_388_608.0 - 1.0
    };
    let inside = |x: &[f32; 3]| x.iter().all(|c| (0.01..0.99).contains(c));
    let mut moved = nodes;
    for x in &mut moved {
        if inside(x) {
            *x = x.map(|c| c + 0.04 * noise());
        }
    }
    let problem = Problem::new("patch", "", (moved, tets), 1e6).hold(|x| !inside(&x));
    // Turned by half a radian, then stretched and sheared.
    let (sin, cos) = 0.5_f32.sin_cos();
    let affine = |[x, y, z]: [f32; 3]| {
        let [x, y, z] = [1.1 * x + 0.05 * y, 0.95 * y + 0.03 * z, 1.02 * z];
        [cos * x - sin * y + 0.3, sin * x + cos * y, z]
    };
    let exact: Vec<[f32; 3]> = problem.nodes.iter().map(|&x| affine(x)).collect();
    let start: Vec<[f32; 3]> = exact
        .iter()
        .zip(&problem.nodes)
        .map(|(y, x)| {
            if inside(x) {
                y.map(|c| c + 0.02 * noise())
            } else {
                *y
            }
        })
        .collect();
    let mut body = problem.body::<Factored>(Start::Galerkin(1));
    body.place(&start, &vec![[0.0; 3]; start.len()])?;
    let budget = Budget {
        iterations: 60,
        polar_sweeps: 4,
    };
    let settings = Settings::new(0.1)?.with_budget(budget);
    let pins = problem.pins();
    for _ in 0..40 {
        let scene = Scene {
            pins: &pins,
            ..Scene::default()
        };
        if let Some(refusal) = body.step(&scene, &settings).refusal {
            return Err(refusal.to_string().into());
        }
    }
    let square = |a: &[f32; 3], b: &[f32; 3]| {
        crate::measure::square([0, 1, 2].map(|k| f64::from(a[k]) - f64::from(b[k])))
    };
    let error: f64 = exact
        .iter()
        .zip(body.positions())
        .map(|(a, b)| square(a, b))
        .sum();
    let size: f64 = exact
        .iter()
        .zip(&problem.nodes)
        .map(|(a, b)| square(a, b))
        .sum();
    Ok((error / size).sqrt())
}

/// A thrown bar after a second: distance of its centre of mass to the parabola that backward Euler's steps add
/// up to, and to the true one; metres.
fn flight(h: f64) -> Outcome<[f64; 2]> {
    let mut bar = Problem::new(
        "thrown bar",
        "",
        box_mesh([1.0, 0.25, 0.25], [8, 2, 2])?,
        1e6,
    )
    .start(|_| [3.0, 4.0, 0.0]);
    bar.gravity = [0.0, -9.81, 0.0];
    let solver = Solver::new(Start::Galerkin(1), femto::Preconditioner::Jacobi);
    let mut ours = Ours::new(&bar, h, solver, Budget::default());
    let steps = (1.0 / h).round() as u32;
    let masses = ours.body.rest().masses.to_vec();
    let total: f64 = masses.iter().map(|m| f64::from(*m)).sum();
    let centre = |x: &[[f32; 3]]| {
        [0, 1].map(|a| {
            masses
                .iter()
                .zip(x)
                .map(|(m, x)| f64::from(*m) * f64::from(x[a]))
                .sum::<f64>()
                / total
        })
    };
    let start = centre(&bar.nodes);
    for _ in 0..steps {
        ours.step();
    }
    let t = h * f64::from(steps);
    let end = centre(ours.body.positions());
    let off = |fall: f64| {
        ((end[0] - start[0] - 3.0 * t).powi(2) + (end[1] - start[1] - 4.0 * t + fall).powi(2))
            .sqrt()
    };
    Ok([off(0.5 * 9.81 * t * (t + h)), off(0.5 * 9.81 * t * t)])
}

/// What is left of a spin of 2 rad/s after two seconds, solved: kinetic energy.
fn spin(h: f64) -> Outcome<f64> {
    let omega = Vec3::new(0.0, 0.0, 2.0);
    let centre = Vec3::new(0.5, 0.125, 0.125);
    let bar = Problem::new(
        "spinning bar",
        "",
        box_mesh([1.0, 0.25, 0.25], [8, 2, 2])?,
        1e7,
    )
    .start(|x| omega.cross(Vec3::from_array(x) - centre).to_array());
    let solver = Solver::new(Start::Rigid(2), femto::Preconditioner::Jacobi);
    let budget = Budget {
        iterations: 100,
        polar_sweeps: 2,
    };
    let mut ours = Ours::new(&bar, h, solver, budget);
    let start = ours.body.energies(Vec3::ZERO).kinetic;
    for _ in 0..(2.0 / h).round() as u32 {
        ours.step();
    }
    Ok(ours.body.energies(Vec3::ZERO).kinetic / start)
}

pub fn chapter(study: &Run, out: &mut Output) -> Done {
    out.text("## Closed forms");
    study.progress("closed: patch test, flight, spin");
    let [to_steps, to_truth] = flight(0.01)?;
    out.text(&format!(
        "Patch test (irregular mesh, boundary turned, stretched and sheared): the inside is off by {} of the displacement. \
         Free flight for a second, five iterations a step: {} m off the parabola that backward Euler's steps add up to, {} m off the true one.",
        short(patch()?), short(to_steps), short(to_truth),
    ));
    let ns: &[u32] = if study.quick { &[1, 2] } else { &[1, 2, 4, 8] };
    let mut ladders = Vec::new();
    study.progress("closed: cantilever");
    let bends = ns
        .iter()
        .map(|&n| deflection(n, 0.3))
        .collect::<Outcome<Vec<_>>>()?;
    ladders.push(Ladder {
        name: "tip deflection of a cantilever, m (Timoshenko)",
        sizes: through(ns),
        found: bends.iter().map(|b| b.0).collect(),
        exact: bends[0].1,
        expected: "2",
    });
    study.progress("closed: frequencies");
    let exact_frequency = 1.875_104_f64.powi(2) / std::f64::consts::TAU
        * (YOUNG * INERTIA / (DENSITY * THICKNESS * THICKNESS * LENGTH.powi(4))).sqrt();
    for (name, mass) in [
        (
            "first bending frequency, Hz, lumped mass (Euler, Bernoulli)",
            Mass::Lumped,
        ),
        ("… consistent mass", Mass::Consistent),
    ] {
        let found = ns
            .iter()
            .map(|&n| Ok(lowest_frequency(&beam(n, 0.3)?, mass)))
            .collect::<Outcome<Vec<_>>>()?;
        ladders.push(Ladder {
            name,
            sizes: through(ns),
            found,
            exact: exact_frequency,
            expected: "2",
        });
    }
    study.progress("closed: waves");
    let rods: &[u32] = if study.quick { &[5, 10] } else { &[5, 10, 20] };
    ladders.push(Ladder {
        name: "axial wave speed, m/s (√(E/ρ))",
        sizes: rods
            .iter()
            .map(|n| (format!("{n} cells along"), 1.0 / f64::from(*n)))
            .collect(),
        found: rods
            .iter()
            .map(|&n| wave_speed(n))
            .collect::<Outcome<Vec<_>>>()?,
        exact: (1e6_f64 / DENSITY).sqrt(),
        expected: "2",
    });
    study.progress("closed: elastica");
    let load = 2.0;
    let exact_tip = elastica(load);
    let tips = ns
        .iter()
        .map(|&n| bent(n, load))
        .collect::<Outcome<Vec<_>>>()?;
    for (axis, name) in [
        (1, "elastica, P L²/EI = 2: tip up, over the length"),
        (0, "… tip back"),
    ] {
        ladders.push(Ladder {
            name,
            sizes: through(ns),
            found: tips.iter().map(|t| t[axis]).collect(),
            exact: exact_tip[axis],
            expected: "2",
        });
    }
    let hs = [0.01, 0.005, 0.0025];
    let spins = hs.iter().map(|&h| spin(h)).collect::<Outcome<Vec<_>>>()?;
    ladders.push(Ladder {
        name: "kinetic energy left of a spin of 2 rad/s after 2 s",
        sizes: hs.iter().map(|h| (format!("h = {h} s"), *h)).collect(),
        found: spins,
        exact: 1.0,
        expected: "1 or more",
    });
    let rows: Vec<_> = ladders.iter().flat_map(Ladder::rows).collect();
    let header = [
        "quantity",
        "refinement",
        "found",
        "closed form",
        "relative error",
        "order",
        "expected order",
    ];
    out.table(&header, &rows);
    out.csv(
        "closed-forms",
        &[
            "quantity",
            "refinement",
            "found",
            "closed_form",
            "error",
            "order",
            "expected",
        ],
        &rows,
    )?;
    out.text(
        "Statics by femto's step in f32; frequencies of femto's matrices by inverse iteration in f64. A lumped mass makes every \
         frequency lower than a consistent one does; stiff, coarse tetrahedra make them too high, so that lumping errs to the safe side.",
    );
    locking(study, out)
}

/// Linear tetrahedra lock as volume becomes incompressible.
fn locking(study: &Run, out: &mut Output) -> Done {
    study.progress("closed: locking");
    let ratios: &[f32] = if study.quick {
        &[0.3, 0.49]
    } else {
        &[0.0, 0.3, 0.4, 0.45, 0.49, 0.499]
    };
    let mut rows = Vec::new();
    for &poisson in ratios {
        let (found, exact_tip) = deflection(2, poisson)?;
        rows.push(vec![
            poisson.to_string(),
            format!("{:.2}", found / exact_tip),
            exact(found),
        ]);
    }
    out.text("Locking: the same cantilever, two cells through, as Poisson's ratio nears ½.");
    out.table(
        &["Poisson's ratio", "tip deflection over the beam's", "m"],
        &rows,
    );
    out.csv("locking", &["poisson", "ratio", "deflection"], &rows)
}
