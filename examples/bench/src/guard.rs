//! What is compared must compute the same thing.

use femto::element::Factored;
use femto::lane::Native;
use femto::settings::{Budget, Settings, Start};

use femto_bench::baseline::Stop;
use femto_bench::csr::BlockCsr;

use crate::kernels::{Body, DT, baseline};
use crate::mesh::Scene;

/// Both are sums of some 60 products per component, in different orders.
const PRODUCT: f64 = 1e-5;
/// f32 rounding of forces and rotations, and its growth through CG: far below the step's change.
const STEP: f64 = 1e-3;

/// The assembled and the matrix-free product agree.
pub fn products(body: &Body<Factored>, matrix: &BlockCsr) {
    let mut ours = vec![[0.0; 3]; body.v.len()];
    body.operator().apply::<Native>(&body.v, &mut ours);
    let mut theirs = ours.clone();
    matrix.product(&body.v, &mut theirs);
    agree(
        "block-CSR product",
        PRODUCT,
        &ours,
        &theirs,
        &vec![[0.0; 3]; ours.len()],
    );
    matrix.product_in_lanes(&body.v, &mut theirs);
    agree(
        "block-CSR product in lanes",
        PRODUCT,
        &ours,
        &theirs,
        &vec![[0.0; 3]; ours.len()],
    );
}

/// One step of the baseline changes the velocities as femto's does, after five iterations and
/// converged.
pub fn steps(scene: &Scene, body: &Body<Factored>) {
    for iterations in [5, 200] {
        let budget = Budget {
            iterations,
            polar_sweeps: 2,
        };
        let settings = Settings::new(DT).expect("a positive time step");
        let mut ours = body.stepper(settings.with_start(Start::Velocity).with_budget(budget));
        ours.step::<Native>();
        let mut theirs = baseline(scene);
        theirs.step(Stop::After(iterations));
        agree(
            &format!("baseline step of {iterations} iterations"),
            STEP,
            ours.velocities(),
            &theirs.v,
            &scene.v,
        );
    }
}

/// ‖a − b‖ ≤ tolerance ‖a − origin‖
fn agree(what: &str, tolerance: f64, a: &[[f32; 3]], b: &[[f32; 3]], origin: &[[f32; 3]]) {
    let error = distance(a, b) / distance(a, origin);
    assert!(
        error <= tolerance,
        "{what}: off by {error:.1e}, more than {tolerance:.0e}"
    );
    println!("guard: {what}: off by {error:.1e} (at most {tolerance:.0e})");
}

fn distance(a: &[[f32; 3]], b: &[[f32; 3]]) -> f64 {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs
        .map(|(&a, &b)| (f64::from(a) - f64::from(b)).powi(2))
        .sum::<f64>()
        .sqrt()
}
