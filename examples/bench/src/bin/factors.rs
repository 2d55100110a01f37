//! What a factor buys: whole trajectories at fixed budgets, their error and their time.
//!
//! `cargo run --release -p femto-bench --bin factors [MESH.msh NODE RADIUS]`
//!
//! Scenes: the snowman, swinging from its head; a cantilever of 4,913 nodes; and, if named, a mesh of
//! the user's, held by the nodes within RADIUS of NODE. Error is the distance of the nodes from the
//! converged run of the same time step, root mean square over nodes, mean over steps, over the
//! bounding box's diagonal. Time is that of a step, everything included, in units of one K apply on the same mesh.

#[path = "../mesh.rs"]
#[allow(dead_code, reason = "the benchmark uses more of it")]
mod mesh;

use std::hint::black_box;
use std::process::ExitCode;
use std::time::Duration;

use femto::element::Factored;
use femto::glam::Vec3;
use femto::lane::{Lanes, Native};
use femto::operator::{Operator, rotate};
use femto::order::fans;
use femto::owned::{OwnedRest, OwnedState, OwnedWorkspace};
use femto::preconditioner::factor::Entries;
use femto::rest::Rest;
use femto::step::step;
use femto::{Budget, Factor, Material, Mesh, Pin, Preconditioner, Scene, Settings, Start};
use femto_bake::{FactorOptions, Kind, Precision};
use femto_bench::clock::{self, Effort, Kernel};
use femto_bench::mesh_file;

/// What the thinned factor drops.
const THINNED: f64 = 0.005;

struct Case {
    name: String,
    nodes: Vec<[f32; 3]>,
    tets: Vec<[u32; 4]>,
    young: f32,
    poisson: f32,
    dt: f32,
    steps: u32,
    held: Vec<u32>,
}

/// What it is called, and its solver.
struct Method<'a> {
    name: &'static str,
    start: Start,
    preconditioner: Preconditioner<'a>,
    iterations: u32,
}

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let cases = match args.as_slice() {
        [] => snowman().map(|snowman| vec![snowman, cantilever()]),
        [file, node, radius] => match (node.parse(), radius.parse()) {
            (Ok(node), Ok(radius)) => own(file, node, radius).map(|own| vec![own]),
            _ => Err(format!("{node} and {radius} must be a node and a length")),
        },
        _ => Err("usage: factors [MESH.msh NODE RADIUS]".into()),
    };
    match cases {
        Ok(cases) => cases.iter().for_each(report),
        Err(why) => {
            eprintln!("error: {why}");
            return ExitCode::from(2);
        }
    }
    ExitCode::SUCCESS
}

fn snowman() -> Result<Case, String> {
    let (nodes, tets) = mesh_file::load(mesh_file::SNOWMAN)?;
    let top = nodes.iter().map(|x| x[1]).fold(f32::MIN, f32::max);
    let held = near(&nodes, |x| x[1] > top - 0.15);
    Ok(Case {
        name: "snowman, hung by its head".into(),
        nodes,
        tets,
        young: 1e5,
        poisson: 0.4,
        dt: 1.0 / 150.0,
        steps: 150,
        held,
    })
}

fn cantilever() -> Case {
    let scene = mesh::box_scene([48, 10, 8]);
    let held = near(&scene.nodes, |x| x[0] < 0.05);
    Case {
        name: "cantilever".into(),
        nodes: scene.nodes,
        tets: scene.tets,
        young: 1e7,
        poisson: 0.4,
        dt: 1.0 / 150.0,
        steps: 60,
        held,
    }
}

/// Scaled to a tenth and turned by 180° about y.
fn own(file: &str, node: usize, radius: f32) -> Result<Case, String> {
    let (mut nodes, tets) = mesh_file::load(file)?;
    for x in &mut nodes {
        *x = [-0.1 * x[0], 0.1 * x[1], -0.1 * x[2]];
    }
    let centre = nodes
        .get(node)
        .ok_or_else(|| format!("{file}: has no node {node}"))?;
    let centre = Vec3::from_array(*centre);
    let held = near(&nodes, |x| Vec3::from_array(x).distance(centre) < radius);
    Ok(Case {
        name: file.into(),
        nodes,
        tets,
        young: 1e6,
        poisson: 0.33,
        dt: 0.01,
        steps: 80,
        held,
    })
}

fn near(nodes: &[[f32; 3]], inside: impl Fn([f32; 3]) -> bool) -> Vec<u32> {
    (0..)
        .zip(nodes)
        .filter(|(_, x)| inside(**x))
        .map(|(i, _)| i)
        .collect()
}

fn report(case: &Case) {
    let tets = fans(&case.tets).tets;
    let mesh = Mesh::new(&case.nodes, &tets).expect("a good mesh");
    let material = Material::new(case.young, case.poisson, 1000.0).expect("a good material");
    let rest = OwnedRest::<Factored>::new(&mesh, &material).expect("in range");
    let rest = rest.view();
    let settings = Settings::new(case.dt).expect("a good time step");
    let factors: Vec<_> = [
        (Kind::Laplacian, Precision::Single, 0.0),
        (Kind::Warped, Precision::Single, 0.0),
        (Kind::Warped, Precision::Half, 0.0),
        (Kind::Warped, Precision::Single, THINNED),
    ]
    .into_iter()
    .map(|(kind, precision, drop)| {
        let options = FactorOptions {
            kind,
            precision,
            drop,
            held: case.held.clone(),
            ..FactorOptions::default()
        };
        femto_bake::factor(&rest, &settings, &options).expect("a factor")
    })
    .collect();
    let factors: Vec<Factor> = factors.iter().map(|f| f.view()).collect();
    let [laplacian, warped, half, thin] = factors.as_slice() else {
        unreachable!()
    };
    let named = [
        ("Laplacian", laplacian),
        ("warped", warped),
        ("warped f16", half),
        ("warped, thinned", thin),
    ];
    let apply = apply_time(&rest, &settings);
    println!(
        "\n## {}: {} nodes, {} tetrahedra; E = {:e}, nu = {}, h = {:.4}",
        case.name,
        case.nodes.len(),
        case.tets.len(),
        case.young,
        case.poisson,
        case.dt
    );
    for (name, factor) in named {
        println!(
            "{name}: {} scalars, {} bytes, one application {:.2} K applies",
            factor.scalars(),
            factor.bytes(),
            solve_time(factor, case.nodes.len()) / apply
        );
    }
    if let Some(scalars) = Scalars::new(warped) {
        println!(
            "warped, stored number by number: {} bytes, one application {:.2} K applies",
            scalars.bytes(),
            scalars.time() / apply
        );
    }
    thinned(case, &rest, &settings, apply);
    let converged = run(
        case,
        &rest,
        settings
            .with_start(Start::Galerkin(2))
            .with_preconditioner(Preconditioner::Factored(warped))
            .with_budget(Budget {
                iterations: 60,
                polar_sweeps: 2,
            }),
    )
    .0;
    let mut methods = Vec::new();
    for iterations in [1, 2, 3, 5, 8, 12, 18, 27, 40, 60, 90, 140] {
        methods.push(Method {
            name: "Jacobi",
            start: Start::Velocity,
            preconditioner: Preconditioner::Jacobi,
            iterations,
        });
    }
    for (name, factor) in named {
        for iterations in [1, 2, 3, 5] {
            methods.push(Method {
                name,
                start: Start::Galerkin(2),
                preconditioner: Preconditioner::Factored(factor),
                iterations,
            });
        }
    }
    println!(
        "| preconditioner | start | iterations | step / K apply | error | Jacobi's at this time, over it |"
    );
    println!("|---|---|---|---|---|---|");
    let mut paper: Vec<(f64, f64)> = Vec::new();
    for method in &methods {
        let settings = settings
            .with_start(method.start)
            .with_preconditioner(method.preconditioner)
            .with_budget(Budget {
                iterations: method.iterations,
                polar_sweeps: 2,
            });
        let (path, time) = run(case, &rest, settings);
        let (time, error) = (time / apply, error(case, &path, &converged));
        let ratio = if method.start == Start::Velocity {
            paper.push((time, error));
            String::new()
        } else {
            // The first budget of the paper's that takes at least as long.
            paper
                .iter()
                .find(|(other, _)| *other >= time)
                .map_or("no budget".into(), |(_, other)| {
                    format!("{:.0}", other / error)
                })
        };
        println!(
            "| {} | {} | {} | {time:.1} | {error:.1e} | {ratio} |",
            method.name,
            match method.start {
                Start::Velocity => "velocity",
                _ => "galerkin-2",
            },
            method.iterations
        );
    }
}

/// Positions after every step, and seconds of the fastest step.
fn run(case: &Case, rest: &Rest<'_>, settings: Settings<'_>) -> (Vec<Vec<[f32; 3]>>, f64) {
    let pins: Vec<Pin> = case.held.iter().map(|&node| Pin::held(node)).collect();
    let scene = Scene {
        gravity: Vec3::new(0.0, -9.81, 0.0),
        pins: &pins,
        ..Scene::default()
    };
    let mut path = Vec::new();
    let mut best = f64::INFINITY;
    for _ in 0..3 {
        path.clear();
        let mut state = OwnedState::new(rest, settings.start);
        let mut work = OwnedWorkspace::new(rest, settings.start);
        for _ in 0..case.steps {
            let begin = clock::now();
            let report = step::<Native, Factored>(
                rest,
                &mut state.view_mut(),
                &mut work.view_mut(rest),
                &scene,
                &settings,
            );
            best = best.min((clock::now() - begin).as_secs_f64());
            assert!(report.advanced(), "{report:?}");
            path.push(state.view().x.to_vec());
        }
    }
    (path, best)
}

fn error(case: &Case, path: &[Vec<[f32; 3]>], converged: &[Vec<[f32; 3]>]) -> f64 {
    let distance = |a: &[f32; 3], b: &[f32; 3]| -> f64 {
        (0..3)
            .map(|axis| (f64::from(a[axis]) - f64::from(b[axis])).powi(2))
            .sum()
    };
    let corner = |pick: fn(f32, f32) -> f32, start: f32| -> [f32; 3] {
        std::array::from_fn(|axis| case.nodes.iter().map(|x| x[axis]).fold(start, pick))
    };
    let diagonal = distance(&corner(f32::min, f32::MAX), &corner(f32::max, f32::MIN)).sqrt();
    let rms = |a: &[[f32; 3]], b: &[[f32; 3]]| {
        let sum: f64 = a.iter().zip(b).map(|(a, b)| distance(a, b)).sum();
        (sum / a.len() as f64).sqrt()
    };
    let sum: f64 = path.iter().zip(converged).map(|(a, b)| rms(a, b)).sum();
    sum / path.len() as f64 / diagonal
}

const EFFORT: Effort = Effort {
    rounds: 15,
    sample: Duration::from_millis(10),
};

/// Seconds of one K apply.
fn apply_time(rest: &Rest<'_>, settings: &Settings<'_>) -> f64 {
    let state = OwnedState::new(rest, Start::Zero);
    let nodes = rest.nodes.len();
    let mut rotated = vec![<Factored as femto::element::Layout>::ZERO_ROTATED; rest.blocks.len()];
    let mut out = vec![[0.0; 3]; nodes];
    rotate::<Native, Factored>(
        rest,
        rest.nodes,
        state.view().rotations,
        1.0,
        &mut rotated,
        &mut out,
    );
    let inertia = vec![1.0; nodes];
    let operator = Operator {
        rest: *rest,
        rotated: &rotated,
        inertia: &inertia,
        stiffness: settings.dt() * settings.dt(),
    };
    let u = out.clone();
    let kernel = Kernel::new("K apply", Native::WIDTH, move || {
        operator.apply::<Native>(black_box(&u), black_box(&mut out));
    });
    clock::time(&mut [kernel], EFFORT)[0]
}

/// What dropping small blocks saves, and what it costs: the residual after two iterations from rest.
fn thinned(case: &Case, rest: &Rest<'_>, settings: &Settings<'_>, apply: f64) {
    println!("| drop | blocks kept | one application / K apply | residual after 2 iterations |");
    println!("|---|---|---|---|");
    let pins: Vec<Pin> = case.held.iter().map(|&node| Pin::held(node)).collect();
    let scene = Scene {
        gravity: Vec3::new(0.0, -9.81, 0.0),
        pins: &pins,
        ..Scene::default()
    };
    let mut all = None;
    for drop in [0.0, 0.01, 0.03, 0.1, 0.3] {
        let options = FactorOptions {
            drop,
            held: case.held.clone(),
            ..FactorOptions::default()
        };
        let owned = femto_bake::factor(rest, settings, &options).expect("a factor");
        let factor = owned.view();
        let blocks = factor.rows().len() as f64;
        let share = blocks / *all.get_or_insert(blocks);
        let settings = settings
            .with_start(Start::Zero)
            .with_preconditioner(Preconditioner::Factored(&factor))
            .with_budget(Budget {
                iterations: 2,
                polar_sweeps: 2,
            });
        let mut state = OwnedState::new(rest, settings.start);
        let mut work = OwnedWorkspace::new(rest, settings.start);
        let report = step::<Native, Factored>(
            rest,
            &mut state.view_mut(),
            &mut work.view_mut(rest),
            &scene,
            &settings,
        );
        println!(
            "| {drop} | {:.0} % | {:.2} | {:.1e} |",
            100.0 * share,
            solve_time(&factor, case.nodes.len()) / apply,
            report.relative_residual()
        );
    }
}

/// A warped factor's L number by number, in compressed columns: what blocks are compared with.
struct Scalars {
    order: Vec<u16>,
    ends: Vec<u32>,
    rows: Vec<u16>,
    lower: Vec<f32>,
}

impl Scalars {
    /// `None` where there are too many for 16-bit rows. D stays in blocks, and is left out.
    fn new(factor: &Factor<'_>) -> Option<Self> {
        let Entries::Warped { lower, .. } = factor.entries() else {
            return None;
        };
        u16::try_from(3 * factor.nodes()).ok()?;
        let mut out = Self {
            order: Vec::new(),
            ends: Vec::new(),
            rows: Vec::new(),
            lower: Vec::new(),
        };
        let mut start = 0;
        for (&node, &end) in factor.order().iter().zip(factor.ends()) {
            let column = start as usize..end as usize;
            start = end;
            for b in 0..3 {
                out.order.push(3 * node + b as u16);
                for (row, block) in factor.rows()[column.clone()]
                    .iter()
                    .zip(&lower[column.clone()])
                {
                    for a in 0..3 {
                        out.rows.push(3 * row + a as u16);
                        out.lower.push(block[3 * b + a]);
                    }
                }
                out.ends.push(out.rows.len() as u32);
            }
        }
        Some(out)
    }

    fn bytes(&self) -> usize {
        6 * self.order.len() + 6 * self.rows.len()
    }

    /// Seconds of one pair of triangular solves.
    fn time(&self) -> f64 {
        let mut z = vec![1.0_f32; self.order.len()];
        let kernel = Kernel::new("scalars", 1, move || {
            z.fill(1.0);
            self.solve(black_box(&mut z));
        });
        clock::time(&mut [kernel], EFFORT)[0]
    }

    fn solve(&self, z: &mut [f32]) {
        let mut start = 0;
        for (&column, &end) in self.order.iter().zip(&self.ends) {
            let range = start as usize..end as usize;
            start = end;
            let y = z[usize::from(column)];
            for (&row, l) in self.rows[range.clone()].iter().zip(&self.lower[range]) {
                z[usize::from(row)] -= l * y;
            }
        }
        for (place, &column) in self.order.iter().enumerate().rev() {
            let start = if place == 0 { 0 } else { self.ends[place - 1] };
            let range = start as usize..self.ends[place] as usize;
            let mut sum = 0.0;
            for (&row, l) in self.rows[range.clone()].iter().zip(&self.lower[range]) {
                sum += l * z[usize::from(row)];
            }
            z[usize::from(column)] -= sum;
        }
    }
}

/// Seconds of one pair of triangular solves.
fn solve_time(factor: &Factor<'_>, nodes: usize) -> f64 {
    let mut z = vec![[1.0; 3]; nodes];
    let kernel = Kernel::new("solve", 1, move || {
        z.fill([1.0; 3]);
        factor.solve(black_box(&mut z));
    });
    clock::time(&mut [kernel], EFFORT)[0]
}
