//! Times femto's kernels on box meshes, as ratios to a block-CSR product of the same mesh in the
//! same run, which mean the same on every machine and at every clock rate.
//!
//! ```text
//! cargo run --release -p femto-bench [-- --quick] [--check]
//! RUSTFLAGS="-C target-cpu=x86-64-v3" cargo run --release -p femto-bench
//! ```
//!
//! `--quick` takes a few seconds; with `--check` the exit code is 1 where a target is missed.

mod guard;
mod kernels;
mod mesh;
mod report;
mod two_level;

use std::process::ExitCode;
use std::time::Duration;

use femto::element::{Dense, Factored};
use femto::lane::{Lanes, Native};
use femto::settings::Settings;
use femto_bake::{FactorOptions, Kind, OwnedFactor, Precision, factor};
use nalgebra::Matrix3;
use wide::{f32x4, f32x8};

use femto_bench::baseline::Stop;
use femto_bench::clock::{self, Effort, Kernel};
use femto_bench::csr::{BlockCsr, elements};
use kernels::{Body, DENSE, DT, FACTORED, baseline, kernels, polar};
use mesh::{Scene, box_scene};
use report::{Table, targets};
use two_level::{Coarse, two_level};

const PLAIN: &str = "block-CSR product, plain";
const IN_LANES: &str = "block-CSR product, in lanes";
const REFILL: &str = "block-CSR refill";
const SVD: &str = "polar, SVD (nalgebra)";
/// The preconditioner's triangular solves; turning the vector there and back is not in them.
const FACTORS: [(&str, (Kind, Precision)); 4] = [
    (
        "factor, Laplacian f32",
        (Kind::Laplacian, Precision::Single),
    ),
    ("factor, Laplacian f16", (Kind::Laplacian, Precision::Half)),
    ("factor, warped f32", (Kind::Warped, Precision::Single)),
    ("factor, warped f16", (Kind::Warped, Precision::Half)),
];
const BASELINE: &str = "step Velocity, SVD + assembly + CSR";

/// Cells along the edges: 0.4, 3, 25 and 80 thousand tetrahedra.
const MESHES: [[u32; 3]; 4] = [[4, 4, 4], [8, 8, 8], [16, 16, 16], [24, 24, 23]];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let Some(unknown) = arguments
        .iter()
        .find(|a| !["--quick", "--check"].contains(&a.as_str()))
    {
        eprintln!("unknown argument {unknown}; known are --quick and --check");
        return ExitCode::from(2);
    }
    let given = |name: &str| arguments.iter().any(|argument| argument == name);
    let effort = if given("--quick") {
        Effort {
            rounds: 7,
            sample: Duration::from_micros(200),
        }
    } else {
        Effort {
            rounds: 40,
            sample: Duration::from_millis(1),
        }
    };
    let features = if cfg!(target_feature = "avx2") {
        "with AVX2"
    } else {
        "without AVX2"
    };
    println!(
        "built for {} {features}, native lanes: {}",
        std::env::consts::ARCH,
        Native::WIDTH
    );
    let tables: Vec<Table> = MESHES
        .iter()
        .map(|&cells| measure(&box_scene(cells), effort))
        .collect();
    let met = targets(&tables);
    if given("--check") && !met {
        ExitCode::FAILURE
    } else {
        ExitCode::SUCCESS
    }
}

/// Times everything on one mesh and prints it.
fn measure(scene: &Scene, effort: Effort) -> Table {
    let body = Body::<Factored>::new(scene);
    let dense = Body::<Dense>::new(scene);
    let coarse = Coarse::new(&body);
    let operator = body.operator();
    let elements = elements(&body.rest.view(), &body.rotations, operator.stiffness);
    let mut matrix = BlockCsr::new(scene.nodes.len(), &scene.tets);
    matrix.refill(operator.inertia, &elements);
    println!(
        "\n{} tetrahedra, {} nodes",
        scene.tets.len(),
        scene.nodes.len()
    );
    guard::products(&body, &matrix);
    if scene.tets.len() < 10_000 {
        guard::steps(scene, &body);
    }

    let made = factors(&body, scene.tets.len());
    let mut refilled = BlockCsr::new(scene.nodes.len(), &scene.tets);
    let (mut plain, mut in_lanes) = (
        vec![[0.0; 3]; scene.nodes.len()],
        vec![[0.0; 3]; scene.nodes.len()],
    );
    let rotations_only = baseline(scene);
    let mut rotations = vec![Matrix3::identity(); scene.tets.len()];
    let mut all = vec![
        Kernel::new(PLAIN, 1, || matrix.product(&body.v, &mut plain)),
        Kernel::new(IN_LANES, 1, || {
            matrix.product_in_lanes(&body.v, &mut in_lanes)
        }),
        Kernel::new(REFILL, 1, || refilled.refill(operator.inertia, &elements)),
        Kernel::new(SVD, 1, || rotations_only.rotations(&mut rotations)),
        Kernel::after(
            BASELINE,
            1,
            baseline(scene),
            |b| b.place(&scene.x, &scene.v),
            |b| _ = b.step(Stop::After(5)),
        ),
    ];
    for ((row, _), factor) in FACTORS.iter().zip(&made) {
        let (factor, v) = (factor.view(), &body.v);
        let mut z = v.clone();
        all.push(Kernel::new(row, 1, move || {
            z.copy_from_slice(v);
            factor.solve(&mut z);
        }));
    }
    all.extend(of_width::<f32>(&body, &dense, &coarse));
    all.extend(of_width::<f32x4>(&body, &dense, &coarse));
    all.extend(of_width::<f32x8>(&body, &dense, &coarse));
    let seconds = clock::time(&mut all, effort);
    let table = Table::new(scene.tets.len(), &all, &seconds);
    table.print();
    table
}

/// The rest matrix of the body, factored in every way; of large meshes only as a Laplacian.
fn factors(body: &Body<Factored>, tets: usize) -> Vec<OwnedFactor> {
    let settings = Settings::new(DT).expect("a positive time step");
    let count = match tets {
        ..10_000 => FACTORS.len(),
        10_000..50_000 => 2,
        _ => 0,
    };
    let made = FACTORS.iter().take(count).map(|&(_, (kind, precision))| {
        let options = FactorOptions {
            kind,
            precision,
            ..FactorOptions::default()
        };
        factor(&body.rest.view(), &settings, &options).expect("a positive definite matrix")
    });
    made.collect()
}

fn of_width<'a, R: Lanes + 'a>(
    body: &'a Body<Factored>,
    dense: &'a Body<Dense>,
    coarse: &'a Coarse,
) -> Vec<Kernel<'a>> {
    let mut all = kernels::<R, Factored>(body, &FACTORED);
    all.extend(kernels::<R, Dense>(dense, &DENSE));
    all.extend(polar::<R, Factored>(body));
    all.extend(two_level::<R>(body, coarse));
    all
}
