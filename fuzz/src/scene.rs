//! What acts on a body: gravity, forces, pins, half-spaces and spheres.

use femto::glam::Vec3;
use femto::{Collider, Pin, Scene};

use super::bytes::Bytes;

pub struct SceneData {
    pub gravity: Vec3,
    pub forces: Vec<[f32; 3]>,
    pub pins: Vec<Pin>,
    pub colliders: Vec<Collider<'static>>,
}

impl SceneData {
    pub fn new(bytes: &mut Bytes<'_>, nodes: usize) -> Self {
        let gravity = bytes.usual_vector(&[0.0, -9.81]).into();
        let forces = [0, nodes, 0, nodes + 1][bytes.below(4)];
        Self {
            gravity,
            forces: (0..forces).map(|_| bytes.usual_vector(&[0.0])).collect(),
            pins: (0..bytes.below(4)).map(|_| pin(bytes, nodes)).collect(),
            colliders: (0..bytes.below(4))
                .filter_map(|_| collider(bytes))
                .collect(),
        }
    }

    pub fn view(&self) -> Scene<'_> {
        Scene {
            gravity: self.gravity,
            forces: &self.forces,
            pins: &self.pins,
            colliders: &self.colliders,
        }
    }
}

fn pin(bytes: &mut Bytes<'_>, nodes: usize) -> Pin {
    let node = match bytes.byte() {
        255 => bytes.word(),
        near => u32::from(near) % nodes as u32,
    };
    Pin {
        node,
        velocity: bytes.usual_vector(&[0.0]).into(),
    }
}

fn collider(bytes: &mut Bytes<'_>) -> Option<Collider<'static>> {
    let make = if bytes.flag() {
        Collider::sphere
    } else {
        Collider::half_space
    };
    let collider = make(bytes.usual_vector(&[0.0, 1.0]).into(), bytes.number()).ok()?;
    let (friction, velocity) = (bytes.usual(&[0.0, 0.5]), bytes.usual_vector(&[0.0]).into());
    let collider = collider
        .with_friction(friction)
        .ok()?
        .with_velocity(velocity)
        .ok()?;
    check_normal(&collider, bytes);
    Some(collider)
}

/// The normal anywhere has length 1, or the distance is beyond f32.
pub fn check_normal(collider: &Collider<'_>, bytes: &mut Bytes<'_>) {
    let (distance, normal) = collider.distance(bytes.vector().into());
    let square = normal.dot(normal);
    let unit = (square - 1.0).abs() <= 8.0 * f32::EPSILON;
    assert!(
        unit || !distance.is_finite(),
        "{collider:?}: a normal of length² {square:e}"
    );
}
