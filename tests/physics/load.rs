//! Pressure, gas and wind: against volumes and areas in f64, and closed forms.

use crate::support::meshes::{TetMesh, box_mesh, jitter, noise};
use crate::support::scenes::Setup;
use femto::element::Factored;
use femto::glam::Vec3;
use femto::load::{Gas, LoadError, Pressure, Triangles, Wind};
use femto::surface::boundary_triangles;
use femto::{Preconditioner, Scene, Start};
use nalgebra::Vector3;
use proptest::prelude::*;

fn v64(x: [f32; 3]) -> Vector3<f64> {
    Vector3::from(x.map(f64::from))
}

/// A deformed box, its surface, and positions.
fn body(seed: u64, offset: [f32; 3]) -> (TetMesh, Vec<[u32; 3]>) {
    let mut mesh = jitter(&box_mesh([1.0, 0.5, 0.7], [3, 2, 2]), 0.03, seed);
    for x in &mut mesh.nodes {
        *x = [
            x[0] + 0.3 * x[1] + offset[0],
            x[1] + 0.2 * x[0] * x[2] + offset[1],
            x[2] + offset[2],
        ];
    }
    let triangles = boundary_triangles(&mesh.tets);
    (mesh, triangles)
}

/// Σ of the tetrahedra's volumes.
fn volume(mesh: &TetMesh) -> f64 {
    mesh.tets.iter().map(|&tet| mesh.volume(tet)).sum()
}

fn sums(x: &[[f32; 3]], forces: &[[f32; 3]]) -> (Vector3<f64>, Vector3<f64>, f64) {
    let zero = (Vector3::zeros(), Vector3::zeros(), 0.0);
    x.iter()
        .zip(forces)
        .fold(zero, |(force, torque, size), (&x, &f)| {
            let f = v64(f);
            (force + f, torque + v64(x).cross(&f), size + f.norm())
        })
}

proptest! {
    /// Of a closed surface: no force, no torque, and the gradient of the volume.
    #[test]
    fn pressure_is_p_dv(seed in any::<u64>(), p in -1e4_f32..1e4, offset in prop::array::uniform3(-2.0_f32..2.0), step in any::<u64>()) {
        let (mut mesh, triangles) = body(seed, offset);
        let surface = Triangles::new(&triangles, mesh.nodes.len()).unwrap();
        let mut forces = vec![[0.0; 3]; mesh.nodes.len()];
        Pressure::new(p).unwrap().add(&surface, &mesh.nodes, &mut forces);
        let (force, torque, size) = sums(&mesh.nodes, &forces);
        // Some roundings of each force, about coordinates up to 4.
        let rounding = 8.0 * f64::from(f32::EPSILON) * size;
        prop_assert!(force.norm() <= rounding, "{force}");
        prop_assert!(torque.norm() <= 4.0 * rounding, "{torque}");
        let found = f64::from(surface.volume(&mesh.nodes));
        prop_assert!((found - volume(&mesh)).abs() < 1e-5 * volume(&mesh));

        // Work of a small displacement, by a central difference that is exact for a cubic to O(δ²).
        let (x, delta) = (mesh.nodes.clone(), 1e-3);
        let way = noise(x.len(), 1.0, step);
        let work: f64 = forces.iter().zip(&way).map(|(f, d)| v64(*f).dot(&v64(*d))).sum();
        let mut at = |side: f64| {
            for ((x, from), d) in mesh.nodes.iter_mut().zip(&x).zip(&way) {
                *x = core::array::from_fn(|a| (f64::from(from[a]) + side * delta * f64::from(d[a])) as f32);
            }
            volume(&mesh)
        };
        let change = f64::from(p) * (at(1.0) - at(-1.0)) / (2.0 * delta);
        // Positions are rounded by 2⁻²⁴ of up to 4 m: 1e-3 of δ.
        prop_assert!((work - change).abs() < 1e-3 * size, "{work} for {change}");
    }

    /// Air brings momentum through the silhouette: ρ|u|A u, where the surface takes all of it.
    #[test]
    fn wind_is_momentum_flux(
        u in prop::array::uniform3(-20.0_f32..20.0), drift in prop::array::uniform3(-20.0_f32..20.0),
        density in 0.1_f32..2.0, size in prop::array::uniform3(0.2_f64..2.0),
    ) {
        let mesh = box_mesh(size, [2, 3, 1]);
        let triangles = boundary_triangles(&mesh.tets);
        let surface = Triangles::new(&triangles, mesh.nodes.len()).unwrap();
        let v = vec![drift; mesh.nodes.len()];
        let wind = Wind::new(Vec3::from_array(u) + Vec3::from_array(drift), density).unwrap();
        let both = wind.with_coefficients(2.0, 2.0).unwrap();
        let mut forces = vec![[0.0; 3]; mesh.nodes.len()];
        both.add(&surface, &mesh.nodes, &v, &mut forces);
        let (force, _, _) = sums(&mesh.nodes, &forces);
        let faces = [size[1] * size[2], size[2] * size[0], size[0] * size[1]];
        let arrives: f64 = (0..3).map(|a| f64::from(u[a]).abs() * faces[a]).sum();
        let exact = v64(u) * (f64::from(density) * arrives);
        // u is a difference of numbers of up to 40.
        prop_assert!((force - exact).norm() < 1e-5 * (exact.norm() + 40.0 * arrives), "{force} for {exact}");

        // Only across: each pair of faces takes ρ u_a².
        forces.fill([0.0; 3]);
        wind.add(&surface, &mesh.nodes, &v, &mut forces);
        let (force, _, _) = sums(&mesh.nodes, &forces);
        let exact = Vector3::from_fn(|a, _| f64::from(density) * faces[a] * f64::from(u[a]) * f64::from(u[a]).abs());
        prop_assert!((force - exact).norm() < 1e-5 * (exact.norm() + 40.0 * arrives), "{force} for {exact}");
    }

    /// Whatever the motion: air at rest takes power, and air that moves with the body does nothing.
    #[test]
    fn still_air_brakes(seed in any::<u64>(), across in 0.0_f32..4.0, along in 0.0_f32..4.0, drift in prop::array::uniform3(-20.0_f32..20.0)) {
        let (mesh, triangles) = body(seed, [0.0; 3]);
        let surface = Triangles::new(&triangles, mesh.nodes.len()).unwrap();
        let air = |velocity| Wind::new(velocity, 1.2).unwrap().with_coefficients(across, along).unwrap();
        let v = noise(mesh.nodes.len(), 10.0, seed ^ 1);
        let mut forces = vec![[0.0; 3]; mesh.nodes.len()];
        air(Vec3::ZERO).add(&surface, &mesh.nodes, &v, &mut forces);
        let power: f64 = forces.iter().zip(&v).map(|(f, v)| v64(*f).dot(&v64(*v))).sum();
        prop_assert!(power <= 0.0);

        forces.fill([0.0; 3]);
        air(Vec3::from_array(drift)).add(&surface, &mesh.nodes, &vec![drift; v.len()], &mut forces);
        let (_, _, size) = sums(&mesh.nodes, &forces);
        // The mean of three equal numbers is rounded.
        prop_assert!(size < 1e-8, "{size}");
    }
}

/// A block of pressure p inside is stretched alike in all directions: V grows by 3(1 − 2ν)p/E.
#[test]
fn a_block_under_pressure_has_its_bulk_modulus() {
    let mut setup = Setup::new("block", jitter(&box_mesh([0.5; 3], [3; 3]), 0.01, 5));
    (setup.young, setup.poisson, setup.alpha) = (1e5, 0.3, 20.0);
    let triangles = boundary_triangles(&setup.mesh.tets);
    let surface = Triangles::new(&triangles, setup.x.len()).unwrap();
    let before = f64::from(surface.volume(&setup.x));
    for pascals in [500.0_f32, -500.0] {
        let pressure = Pressure::new(pascals).unwrap();
        let mut body = setup.body::<Factored>(Start::Galerkin(1));
        let settings = setup.solver(Start::Galerkin(1), Preconditioner::Jacobi, 20);
        let mut forces = vec![[0.0; 3]; setup.x.len()];
        for _ in 0..600 {
            forces.fill([0.0; 3]);
            pressure.add(&surface, body.positions(), &mut forces);
            let scene = Scene {
                forces: &forces,
                ..Scene::default()
            };
            assert!(body.step(&scene, &settings).advanced());
        }
        let strain = f64::from(surface.volume(body.positions())) / before - 1.0;
        let exact = 3.0 * (1.0 - 2.0 * 0.3) * f64::from(pascals) / 1e5;
        // Linear up to the strain itself.
        assert!(
            (strain - exact).abs() < exact.abs() * exact.abs() * 3.0,
            "{strain} for {exact}"
        );
    }
}

/// A free body is blown along up to the wind's speed, and not beyond.
#[test]
fn wind_carries_a_body_along() {
    let mut setup = Setup::new("block", box_mesh([0.5; 3], [2; 3]));
    (setup.young, setup.density) = (1e4, 5.0);
    let triangles = boundary_triangles(&setup.mesh.tets);
    let surface = Triangles::new(&triangles, setup.x.len()).unwrap();
    let wind = Wind::new(Vec3::X * 5.0, 1.2).unwrap();
    let mut body = setup.body::<Factored>(Start::Galerkin(1));
    let settings = setup.solver(Start::Galerkin(1), Preconditioner::Jacobi, 10);
    let mut forces = vec![[0.0; 3]; setup.x.len()];
    let mass = f64::from(body.rest().header.total_mass);
    let mut last = 0.0;
    for step in 1..=1500 {
        forces.fill([0.0; 3]);
        wind.add(&surface, body.positions(), body.velocities(), &mut forces);
        let scene = Scene {
            forces: &forces,
            ..Scene::default()
        };
        assert!(body.step(&scene, &settings).advanced());
        let speed = body.momenta().linear[0] / mass;
        assert!(speed >= last - 1e-5 && speed < 5.0, "step {step}: {speed}");
        last = speed;
        // u̇ = −ρA u²/m from u = 5: u = 5/(1 + 5ρA t/m); the body's shake is small.
        if step % 500 == 0 {
            let t = f64::from(step) / 150.0;
            let exact = 5.0 - 5.0 / (1.0 + 5.0 * 1.2 * 0.25 * t / mass);
            assert!((speed - exact).abs() < 0.02 * 5.0, "{speed} for {exact}");
        }
    }
}

#[test]
fn gas_keeps_pv() {
    let gas = Gas::new(1e5, 2.0).unwrap();
    assert_eq!(gas.pressure(2.0).pascals(), 1e5);
    assert_eq!(gas.pressure(1.0).pascals(), 2e5);
    assert_eq!(gas.with_outside(1e5).unwrap().pressure(2.0).pascals(), 0.0);
    for volume in [0.0, -1.0, f32::NAN] {
        assert_eq!(gas.pressure(volume).pascals(), 0.0);
    }
}

#[test]
fn errors_name_what_is_wrong() {
    let triangles = [[0, 1, 2], [1, 2, 7]];
    assert_eq!(
        Triangles::new(&triangles, 7).err(),
        Some(LoadError::Node { triangle: 1 })
    );
    assert!(
        LoadError::Node { triangle: 1 }
            .to_string()
            .contains("triangle 1")
    );
    assert_eq!(Pressure::new(f32::NAN), Err(LoadError::Pressure));
    assert_eq!(Gas::new(1.0, 0.0), Err(LoadError::Volume));
    assert_eq!(Gas::new(f32::INFINITY, 1.0), Err(LoadError::Pressure));
    assert_eq!(
        Gas::new(1.0, 1.0).unwrap().with_outside(f32::NAN),
        Err(LoadError::Pressure)
    );
    assert_eq!(Wind::new(Vec3::NAN, 1.0), Err(LoadError::Velocity));
    assert_eq!(Wind::new(Vec3::X, -1.0), Err(LoadError::Density));
    let wind = Wind::new(Vec3::X, 1.0).unwrap();
    assert_eq!(
        wind.with_coefficients(-1.0, 0.0),
        Err(LoadError::Coefficient)
    );
    assert_eq!(
        wind.with_coefficients(0.0, f32::INFINITY),
        Err(LoadError::Coefficient)
    );
}
