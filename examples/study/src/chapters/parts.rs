//! What the parts of a step cost, and when an assembled matrix would pay.

use femto::element::{Factored, Layout};
use femto::lane::Native;
use femto::operator::{Fit, Operator, RotationBlock, fit_rotations, rotate};
use femto::owned::OwnedRest;
use femto::{Budget, Mesh};
use femto_bench::clock::{self, Effort, Kernel};
use femto_bench::csr::{BlockCsr, elements};

use crate::Run;
use crate::method::Method;
use crate::methods::ours::{Ours, PAPER};
use crate::output::{Done, Output, exact, short};
use crate::plot::{Plot, Series};
use crate::problem::{H, Problem, STEPS_PER_FRAME, box_mesh};

/// Seconds of each part, in the state at rest: no part's cost depends on it.
struct Parts {
    rotations: f64,
    system: f64,
    apply: f64,
    /// A step of ten iterations.
    step: f64,
    product: f64,
    refill: f64,
}

fn parts(problem: &Problem) -> Parts {
    let mesh = Mesh::new(&problem.nodes, &problem.tets).expect("a valid mesh");
    let rest = OwnedRest::<Factored>::new(&mesh, &problem.material()).expect("in range");
    let rest = rest.view();
    let x = &problem.nodes;
    let mut rotations = vec![RotationBlock::ZERO; rest.blocks.len()];
    fit_rotations::<Native, Factored>(&rest, x, Fit::Cold, &mut rotations);
    let mut rotated = vec![Factored::ZERO_ROTATED; rest.blocks.len()];
    let mut forces = vec![[0.0; 3]; x.len()];
    rotate::<Native, Factored>(&rest, x, &rotations, 1.0, &mut rotated, &mut forces);
    let (mass, unit) = (rest.header.mass_unit, rest.header.length_unit);
    let inertia: Vec<f32> = rest.masses.iter().map(|m| m / mass).collect();
    let stiffness = (H * H) as f32 / mass / unit / unit;
    let operator = Operator {
        rest,
        rotated: &rotated,
        inertia: &inertia,
        stiffness,
    };
    let elements = elements(&rest, &rotations, stiffness);
    let mut matrix = BlockCsr::<f32>::new(x.len(), &problem.tets);
    matrix.refill(&inertia, &elements);
    let mut refilled = BlockCsr::<f32>::new(x.len(), &problem.tets);
    let budget = Budget {
        iterations: 10,
        polar_sweeps: 1,
    };
    let mut ours = Ours::new(problem, H, PAPER, budget);
    let (mut q, mut s) = (rotations.clone(), rotated.clone());
    let (mut f, mut a, mut b) = (forces.clone(), forces.clone(), forces.clone());
    let mut kernels = [
        Kernel::new("", 0, || {
            fit_rotations::<Native, Factored>(&rest, x, Fit::Warm(1), &mut q)
        }),
        Kernel::new("", 0, || {
            rotate::<Native, Factored>(&rest, x, &rotations, 1.0, &mut s, &mut f)
        }),
        Kernel::new("", 0, || operator.apply::<Native>(&problem.v, &mut a)),
        Kernel::new("", 0, || ours.step()),
        Kernel::new("", 0, || matrix.product_in_lanes(&problem.v, &mut b)),
        Kernel::new("", 0, || refilled.refill(&inertia, &elements)),
    ];
    let effort = Effort {
        rounds: 15,
        sample: std::time::Duration::from_micros(500),
    };
    let seconds = clock::time(&mut kernels, effort);
    Parts {
        rotations: seconds[0],
        system: seconds[1],
        apply: seconds[2],
        step: seconds[3],
        product: seconds[4],
        refill: seconds[5],
    }
}

/// The table of a frame's parts.
pub fn costs(out: &mut Output, problem: &Problem) -> Done {
    let p = parts(problem);
    let frame = STEPS_PER_FRAME as f64 * 1e3;
    let rest = p.step - p.rotations - p.system;
    let row = |name: &str, seconds: f64| {
        vec![
            name.to_string(),
            short(seconds * frame),
            format!("{:.0} %", 100.0 * seconds / p.step),
        ]
    };
    out.table(
        &[
            "part of a frame (Jacobi from v, 10 iterations)",
            "ms of this run",
            "share",
        ],
        &[
            row("rotations, one sweep", p.rotations),
            row("forces and system, in one kernel", p.system),
            row("solve and the rest", rest),
            row("of which products with A", 11.0 * p.apply),
        ],
    );
    Ok(())
}

/// Below which number of iterations no matrix should be assembled.
pub fn break_even(study: &Run, out: &mut Output, problems: &[Problem]) -> Done {
    study.progress("paper: cost against mesh size");
    out.text("### Matrix-free or assembled, the question that the paper leaves open");
    let mut all = problems.to_vec();
    let cells: &[u32] = if study.quick {
        &[4]
    } else {
        &[4, 8, 12, 16, 24]
    };
    for &n in cells {
        let mesh = box_mesh([0.1 * f64::from(n); 3], [n; 3])?;
        all.push(Problem::new("cube", "", mesh, 1e6));
    }
    let (mut rows, mut data) = (Vec::new(), Vec::new());
    let (mut step, mut assembled) = (Vec::new(), Vec::new());
    for problem in &all {
        let p = parts(problem);
        let n = problem.tets.len() as f64;
        let lost = p.apply - p.product;
        let even = if lost > 0.0 {
            p.refill / lost
        } else {
            f64::INFINITY
        };
        rows.push(vec![
            problem.name.to_string(),
            problem.tets.len().to_string(),
            short(p.apply / p.product),
            short(p.refill / p.product),
            if lost > 0.0 {
                format!("{even:.0}")
            } else {
                "any number".into()
            },
        ]);
        data.push(
            [
                vec![problem.name.to_string()],
                [
                    n,
                    p.rotations,
                    p.system,
                    p.apply,
                    p.step,
                    p.product,
                    p.refill,
                ]
                .map(exact)
                .to_vec(),
            ]
            .concat(),
        );
        if problem.name == "cube" {
            step.push((n, p.step * 1e9 / n));
            assembled.push((n, (p.step + p.refill - 11.0 * lost) * 1e9 / n));
        }
    }
    out.text(
        "Products with femto's matrix-free operator against products with an assembled block-CSR matrix, both in lanes. \
         Refilling the matrix once a step pays only for more iterations than the last column says.",
    );
    out.table(
        &[
            "body",
            "tetrahedra",
            "apply over CSR product",
            "refill over CSR product",
            "matrix-free pays below this many iterations",
        ],
        &rows,
    );
    out.plot(
        "cost-by-size",
        &Plot {
            title: "A step of ten Jacobi iterations, cubes".into(),
            x: "tetrahedra",
            y: "ns a tetrahedron",
            log: [true, false],
            series: vec![
                Series::new("matrix-free", step),
                Series::new("assembled (computed from its parts)", assembled),
            ],
        },
    )?;
    out.csv(
        "parts",
        &[
            "body",
            "tets",
            "rotations",
            "system",
            "apply",
            "step",
            "csr_product",
            "csr_refill",
        ],
        &data,
    )
}
