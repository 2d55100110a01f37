//! Why corotated: three materials under a turn and under a press, in f64, damped to rest.
//!
//! ```text
//! linear       P = λ tr(ε) I + 2μ ε,          ε = sym(F) − I
//! StVK         P = F (λ tr(G) I + 2μ G),      G = ½(FᵀF − I)
//! corotated    P = λ tr(S − I) R + 2μ (F − R)
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::Run;
use crate::output::{Done, Output, short};
use crate::problem::{Problem, box_mesh};

/// First Piola-Kirchhoff stress for λ, μ and F.
type Stress = fn(f64, f64, &Matrix3<f64>) -> Matrix3<f64>;

fn linear(lambda: f64, mu: f64, f: &Matrix3<f64>) -> Matrix3<f64> {
    let strain = f.symmetric_part() - Matrix3::identity();
    Matrix3::from_diagonal_element(lambda * strain.trace()) + strain * (2.0 * mu)
}

fn stvk(lambda: f64, mu: f64, f: &Matrix3<f64>) -> Matrix3<f64> {
    let strain = (f.transpose() * f - Matrix3::identity()) * 0.5;
    f * (Matrix3::from_diagonal_element(lambda * strain.trace()) + strain * (2.0 * mu))
}

fn corotated(lambda: f64, mu: f64, f: &Matrix3<f64>) -> Matrix3<f64> {
    let r = femto_bench::baseline::polar(f);
    let trace = (r.transpose() * f).trace() - 3.0;
    r * (lambda * trace) + (f - r) * (2.0 * mu)
}

/// Volume and length along x of the body at rest, over those of the rest shape.
fn settle(
    problem: &Problem,
    stress: Stress,
    place: impl Fn(Vector3<f64>) -> Vector3<f64>,
    load: f64,
) -> [f64; 2] {
    let (lambda, mu) = problem.material().lame();
    let rest: Vec<Vector3<f64>> = problem
        .nodes
        .iter()
        .map(|x| x.map(f64::from).into())
        .collect();
    let mut masses = vec![0.0; rest.len()];
    let tets: Vec<_> = problem
        .tets
        .iter()
        .map(|tet| {
            let corners = tet.map(|i| i as usize);
            let [a, b, c, d] = corners.map(|i| rest[i]);
            let edges = Matrix3::from_columns(&[b - a, c - a, d - a]);
            let volume = edges.determinant() / 6.0;
            corners.iter().for_each(|&i| masses[i] += 250.0 * volume);
            (
                corners,
                edges.try_inverse().expect("a tetrahedron with a volume"),
                volume,
            )
        })
        .collect();
    let far: Vec<usize> = (0..rest.len())
        .filter(|&i| rest[i].x > 1.0 - 1e-6)
        .collect();
    let mut x: Vec<Vector3<f64>> = rest.iter().map(|&x| place(x)).collect();
    let mut v = vec![Vector3::zeros(); x.len()];
    let h = 4e-4;
    for step in 0..20_000 {
        let mut f = vec![Vector3::zeros(); x.len()];
        for (corners, inverse, volume) in &tets {
            let [a, b, c, d] = corners.map(|i| x[i]);
            let now = Matrix3::from_columns(&[b - a, c - a, d - a]) * inverse;
            let forces = stress(lambda, mu, &now) * inverse.transpose() * *volume;
            for (k, &corner) in corners[1..].iter().enumerate() {
                f[corner] -= forces.column(k);
                f[corners[0]] += forces.column(k);
            }
        }
        let ramp = (f64::from(step) / 5000.0).min(1.0);
        for &i in &far {
            f[i].x -= ramp * load / far.len() as f64;
        }
        for i in 0..x.len() {
            if rest[i].x < 1e-6 {
                continue;
            }
            v[i] = (v[i] + f[i] * (h / masses[i])) * 0.995;
            x[i] += v[i] * h;
        }
    }
    let volume: f64 = tets
        .iter()
        .map(|(corners, inverse, volume)| {
            let [a, b, c, d] = corners.map(|i| x[i]);
            (Matrix3::from_columns(&[b - a, c - a, d - a]) * inverse).determinant() * volume
        })
        .sum();
    let all: f64 = tets.iter().map(|t| t.2).sum();
    let length = far
        .iter()
        .map(|&i| (x[i] - place(Vector3::zeros())).norm())
        .sum::<f64>()
        / far.len() as f64;
    let before = far.iter().map(|&i| rest[i].norm()).sum::<f64>() / far.len() as f64;
    [volume / all, length / before]
}

pub fn chapter(study: &Run, out: &mut Output) -> Done {
    study.progress("models");
    out.text("## Why corotated");
    let mut bar = Problem::new("bar", "", box_mesh([1.0, 0.25, 0.25], [4, 1, 1])?, 1e5);
    bar.poisson = 0.3;
    let (sin, cos) = 60_f64.to_radians().sin_cos();
    let turn = |x: Vector3<f64>| Vector3::new(cos * x.x - sin * x.y, sin * x.x + cos * x.y, x.z);
    let models: [(&str, Stress); 3] =
        [("linear", linear), ("StVK", stvk), ("corotated", corotated)];
    let mut rows = Vec::new();
    for (name, stress) in models {
        let turned = settle(&bar, stress, turn, 0.0);
        // A quarter of E over the face's area.
        let pressed = settle(&bar, stress, |x| x, 0.25 * 1e5 * 0.25 * 0.25);
        rows.push(vec![
            name.to_string(),
            short(turned[0]),
            short(turned[1]),
            short(pressed[0]),
            short(pressed[1]),
        ]);
    }
    out.text(
        "A bar held at one end that is turned by 60°, and a bar pressed by a quarter of E: volume and length at rest over \
         those of the rest shape. The linear material swells when turned; StVK, whose resistance falls beyond a shortening \
         of 42 %, collapses when pressed; the corotated one does neither.",
    );
    out.table(
        &[
            "material",
            "turned: volume",
            "turned: length",
            "pressed: volume",
            "pressed: length",
        ],
        &rows,
    );
    out.csv(
        "models",
        &[
            "material",
            "turned_volume",
            "turned_length",
            "pressed_volume",
            "pressed_length",
        ],
        &rows,
    )
}
