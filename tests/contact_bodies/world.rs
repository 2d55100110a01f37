//! Bodies in one system, and what they are worth.

use femto::coupling::{Coupling, Couplings, Link};
use femto::detect::Aabb;
use femto::glam::Vec3;
use femto::join::Assembly;
use femto::material::Material;
use femto::owned::{OwnedBody, OwnedRest};
use femto::rigid::{Rigid, Shape};
use femto::settings::Settings;
use femto::{Mesh, Scene, StepReport};
use nalgebra::Vector3;

use super::support::meshes::{TetMesh, box_mesh};

pub struct World {
    pub body: OwnedBody,
    pub parts: Assembly,
    pub rigids: Vec<Rigid>,
    pub links: Vec<Link>,
    pub slots: Vec<Coupling>,
    pub boxes: Vec<Aabb>,
}

/// A cube of `cells` cells a side with its low corner at `at`.
pub fn cube(side: f64, cells: usize, at: [f32; 3]) -> TetMesh {
    let mut mesh = box_mesh([side; 3], [cells; 3]);
    for node in &mut mesh.nodes {
        for axis in 0..3 {
            node[axis] += at[axis];
        }
    }
    mesh
}

pub const AXES: [Vec3; 3] = [Vec3::X, Vec3::Y, Vec3::Z];

pub fn ball(radius: f32) -> Shape {
    Shape::Ball { radius }
}

impl World {
    pub fn new(parts: Assembly, settings: &Settings<'_>, slots: usize) -> Self {
        let mesh = Mesh::new(&parts.nodes, &parts.tets).unwrap();
        let rest = OwnedRest::new(&mesh, &parts.materials[..]).unwrap();
        Self {
            body: OwnedBody::from_rest(rest, settings),
            rigids: parts.rigids(),
            links: Vec::new(),
            slots: vec![Coupling::EMPTY; slots],
            boxes: parts.boxes(),
            parts,
        }
    }

    /// Gives each body a velocity and a spin about its centroid.
    pub fn throw(&mut self, motions: &[(Vec3, Vec3)]) {
        let x = self.body.positions().to_vec();
        let mut v = vec![[0.0; 3]; x.len()];
        for (part, (velocity, spin)) in self.parts.parts.iter().zip(motions) {
            let nodes = part.nodes.clone();
            let centre = x[nodes.clone()]
                .iter()
                .map(|x| Vec3::from_array(*x))
                .sum::<Vec3>()
                / nodes.len() as f32;
            for i in nodes {
                let arm = Vec3::from_array(x[i]) - centre;
                v[i] = (*velocity + spin.cross(arm)).to_array();
            }
        }
        self.body.place(&x, &v).unwrap();
    }

    pub fn step(&mut self, scene: &Scene<'_>, settings: &Settings<'_>) -> StepReport {
        let pieces = self.parts.pieces();
        let mut couplings = Couplings::new(&pieces, &mut self.rigids, &self.links, &mut self.slots)
            .with_boxes(&mut self.boxes);
        self.body.step_coupled(scene, settings, &mut couplings)
    }

    pub fn linear(&self) -> Vector3<f64> {
        Vector3::from(self.body.momenta().linear)
    }

    pub fn angular(&self) -> Vector3<f64> {
        Vector3::from(self.body.momenta().angular)
    }

    /// Momentum of one body.
    pub fn linear_of(&self, part: usize) -> Vector3<f64> {
        self.sum(part, self.body.velocities())
    }

    pub fn mass_of(&self, part: usize) -> f64 {
        let masses = self.body.rest().masses;
        masses[self.parts.parts[part].nodes.clone()]
            .iter()
            .map(|m| f64::from(*m))
            .sum()
    }

    /// Centre of mass of one body.
    pub fn centre_of(&self, part: usize) -> Vector3<f64> {
        self.sum(part, self.body.positions()) / self.mass_of(part)
    }

    pub fn velocity_of(&self, part: usize) -> Vector3<f64> {
        self.linear_of(part) / self.mass_of(part)
    }

    fn sum(&self, part: usize, of: &[[f32; 3]]) -> Vector3<f64> {
        let nodes = self.parts.parts[part].nodes.clone();
        let masses = &self.body.rest().masses[nodes.clone()];
        let terms = masses.iter().zip(&of[nodes]);
        terms
            .map(|(m, u)| Vector3::from(u.map(f64::from)) * f64::from(*m))
            .sum()
    }

    /// ½k d² of closed contacts, and ½k|e|² of links, as the last step left them.
    pub fn stored(&self, dt: f32) -> f64 {
        let sum = self.slots.iter().map(|slot| {
            let n = slot.normal().map(f64::from);
            let u = slot.velocity().map(f64::from);
            let d =
                f64::from(slot.gap()) + f64::from(dt) * (n[0] * u[0] + n[1] * u[1] + n[2] * u[2]);
            0.5 * f64::from(slot.stiffness()) * if d < 0.0 { d * d } else { 0.0 }
        });
        sum.sum()
    }

    /// The same as the last step found them.
    pub fn stored_before(&self) -> f64 {
        let sum = self.slots.iter().map(|slot| {
            let d = f64::from(slot.gap());
            0.5 * f64::from(slot.stiffness()) * if d < 0.0 { d * d } else { 0.0 }
        });
        sum.sum()
    }
}

pub fn soft(young: f32) -> Material {
    Material::new(young, 0.3, 1000.0).unwrap()
}
