//! Momentum, work of contacts and depth, step by step, in f64 from what the scene file says.

use femto::coupling::Coupling;
use femto::rigid;
use glam::DVec3;

use super::Outcome;
use crate::colliders::Shape;
use crate::scene::Scene;
use crate::sim::Sim;

/// Lumped masses of all nodes: a quarter of each tet, or of a rigid body.
pub struct Masses(Vec<Vec<f64>>);

impl Masses {
    pub fn new(scene: &Scene) -> Self {
        let mut rigid = scene.coupled.iter().flat_map(|c| &c.rigid);
        let of = |body: &crate::scene::Body| {
            if body.shown.is_some() {
                let mass = rigid.next().map_or(0.0, |r| f64::from(r.mass));
                return vec![mass / 4.0; 4];
            }
            let at = |n: u32| vector(&body.rest[n as usize]);
            let mut masses = vec![0.0; body.rest.len()];
            for &[a, b, c, d] in &body.tets {
                let [u, v, w] = [b, c, d].map(|n| at(n) - at(a));
                let mass = f64::from(body.density) * u.dot(v.cross(w)).abs() / 6.0;
                for node in [a, b, c, d] {
                    masses[node as usize] += mass / 4.0;
                }
            }
            masses
        };
        Masses(scene.bodies.iter().map(of).collect())
    }
}

/// The sums over a run so far.
pub struct Account<'a> {
    masses: &'a Masses,
    scene: &'a Scene,
    gravity: DVec3,
    /// Of each body before the step.
    before: Vec<Motion>,
    /// Of all, at the start, and the most of Σ m|v|.
    first: DVec3,
    scale: f64,
    /// Impulse of gravity so far.
    weight: DVec3,
    always_free: bool,
    free: u32,
    free_error: f64,
    /// Sums of the ground's impulse: all, what pulls, what friction takes beyond μ times the normal part.
    ground: [f64; 3],
    /// Work, J: along the normals, across, and ½m|Δv|².
    work: [f64; 3],
    depth: f64,
    rigid_depth: f64,
}

struct Motion {
    velocities: Vec<DVec3>,
    momentum: DVec3,
    /// Σ m|v|
    scale: f64,
    /// No collider can be reached in a step.
    clear: bool,
}

impl<'a> Account<'a> {
    pub fn new(masses: &'a Masses, scene: &'a Scene, sim: &Sim) -> Self {
        let mut account = Account {
            masses,
            scene,
            gravity: vector(&scene.gravity),
            before: Vec::new(),
            first: DVec3::ZERO,
            scale: 0.0,
            weight: DVec3::ZERO,
            always_free: true,
            free: 0,
            free_error: 0.0,
            ground: [0.0; 3],
            work: [0.0; 3],
            depth: 0.0,
            rigid_depth: 0.0,
        };
        account.before = account.motions(sim);
        account.first = account.before.iter().map(|m| m.momentum).sum();
        account
    }

    /// Takes in the step that was just made.
    pub fn step(&mut self, sim: &Sim) {
        let after = self.motions(sim);
        let h = f64::from(self.scene.substep as f32);
        let touched = touched(sim);
        let mut ground = DVec3::ZERO;
        let mut all_clear = true;
        for (body, (old, new)) in self.before.iter().zip(&after).enumerate() {
            let masses = &self.masses.0[body];
            let push = self.gravity * (h * masses.iter().sum::<f64>());
            let change = new.momentum - old.momentum - push;
            ground += change;
            self.weight += push;
            all_clear &= old.clear && new.clear;
            if old.clear && new.clear && !touched[body] {
                self.free += 1;
                let scale = old.scale.max(new.scale);
                if scale > 0.0 {
                    self.free_error = self.free_error.max(change.length() / scale);
                }
            }
            let pairs = old.velocities.iter().zip(&new.velocities);
            let jumps = masses.iter().zip(pairs);
            self.work[2] += jumps
                .map(|(m, (a, b))| 0.5 * m * (*b - *a).length_squared())
                .sum::<f64>();
        }
        self.always_free &= all_clear;
        self.scale = self.scale.max(after.iter().map(|m| m.scale).sum());
        if !all_clear {
            self.on_ground(ground);
        }
        for slot in sim.contacts() {
            let (j, u, n) = (
                vector(&slot.impulse()),
                vector(&slot.velocity()),
                vector(&slot.normal()),
            );
            let along = j.dot(n) * u.dot(n);
            self.work[0] -= along;
            self.work[1] -= j.dot(u) - along;
        }
        self.sink(sim);
        self.before = after;
    }

    /// ½kd² of closed contacts.
    pub fn stored(&self, sim: &Sim) -> f64 {
        let of = |slot: &Coupling| {
            let closing = vector(&slot.velocity()).dot(vector(&slot.normal()));
            let gap = f64::from(slot.gap()) + self.scene.substep * closing;
            0.5 * f64::from(slot.stiffness()) * gap.min(0.0).powi(2)
        };
        sim.contacts().iter().map(of).sum()
    }

    pub fn finish(&self, out: &mut Outcome, energy: f64) {
        let [all, pull, beyond] = self.ground;
        let part = |x: f64| if all > 0.0 { x / all } else { 0.0 };
        (out.pull, out.beyond_friction) = (part(pull), part(beyond));
        [out.contact, out.friction, out.inertia] = self.work.map(|w| w / energy);
        (out.free, out.free_error) = (self.free, self.free_error);
        (out.depth, out.rigid_depth) = (self.depth, self.rigid_depth);
        let last: DVec3 = self.before.iter().map(|m| m.momentum).sum();
        let missing = (last - self.first - self.weight).length();
        out.drift = self.always_free.then_some(missing / self.scale);
    }

    /// The one plane's impulse on all bodies: normal and tangential.
    fn on_ground(&mut self, impulse: DVec3) {
        let [collider] = &self.scene.colliders[..] else {
            return;
        };
        if let Shape::Plane { normal, .. } = collider.shape {
            let push = impulse.dot(normal);
            let across = (impulse - normal * push).length();
            self.ground[0] += impulse.length();
            self.ground[1] += (-push).max(0.0);
            self.ground[2] += (across - f64::from(collider.friction) * push.max(0.0)).max(0.0);
        }
    }

    fn sink(&mut self, sim: &Sim) {
        let mut rigid = self.scene.coupled.iter().flat_map(|c| &c.rigid);
        for (body, of) in self.scene.bodies.iter().enumerate() {
            let nodes = sim.positions(body);
            if of.shown.is_none() {
                self.depth = self.depth.max(-lowest(self.scene, nodes));
            } else if let Some(rigid::Shape::Ball { radius }) = rigid.next().map(|r| r.shape) {
                let centre = nodes.iter().map(vector).sum::<DVec3>() / 4.0;
                let centre = centre.to_array().map(|x| x as f32);
                let below = f64::from(radius) - lowest(self.scene, &[centre]);
                self.rigid_depth = self.rigid_depth.max(below);
            }
        }
    }

    fn motions(&self, sim: &Sim) -> Vec<Motion> {
        let of = |(body, masses): (usize, &Vec<f64>)| {
            let velocities: Vec<DVec3> = sim.velocities(body).iter().map(vector).collect();
            let weighted = || masses.iter().zip(&velocities);
            let fastest = velocities.iter().map(|v| v.length()).fold(0.0, f64::max);
            // A rigid body's nodes are inside it: it may be as much larger as they are apart.
            let nodes = sim.positions(body);
            let reach = match self.scene.bodies[body].shown {
                Some(_) => vector(&nodes[0]).distance(vector(&nodes[1])),
                None => 0.0,
            };
            let room = 2.0 * self.scene.substep * fastest + reach + 1e-3;
            Motion {
                momentum: weighted().map(|(m, v)| *v * *m).sum(),
                scale: weighted().map(|(m, v)| m * v.length()).sum(),
                clear: lowest(self.scene, nodes) > room,
                velocities,
            }
        };
        self.masses.0.iter().enumerate().map(of).collect()
    }
}

/// Distance of the nearest of these to a plane of the scene.
fn lowest(scene: &Scene, nodes: &[[f32; 3]]) -> f64 {
    let mut lowest = f64::INFINITY;
    for collider in &scene.colliders {
        if let Shape::Plane { normal, offset } = collider.shape {
            let distances = nodes.iter().map(|x| normal.dot(vector(x)) - offset);
            lowest = distances.fold(lowest, f64::min);
        }
    }
    lowest
}

/// Which bodies a contact joins, whether it acts or not.
fn touched(sim: &Sim) -> Vec<bool> {
    let mut touched = vec![false; sim.bodies()];
    for slot in sim.contacts() {
        for (node, weight) in slot.weights() {
            if weight != 0.0 {
                touched[sim.body_of(node as usize)] = true;
            }
        }
    }
    touched
}

fn vector(x: &[f32; 3]) -> DVec3 {
    DVec3::from(x.map(f64::from))
}
