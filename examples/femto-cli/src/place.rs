//! Where a body's nodes are: rest shape, start and pins. All in f64 with `libm`, and each
//! result rounded once, so that the bits do not depend on the machine.

use std::collections::BTreeMap;

use glam::{DMat3, DVec3};

use crate::colliders::Motion;
use crate::error::Error;
use crate::loads::Carried;
use crate::scene::Checker;
use crate::scene_file::{self as file, Corners, Vector};

pub struct Placing {
    scale: f64,
    rotation: DMat3,
    translate: DVec3,
    stretch: DVec3,
    velocity: DVec3,
    angular_velocity: DVec3,
}

impl Placing {
    pub fn new(check: &Checker, key: &str, raw: &file::Body) -> Result<Self, Error> {
        let at = |name: &str| format!("{key}.{name}");
        check.positive(&at("scale"), raw.scale)?;
        let rotation = turned(check, key, raw.rotate.as_ref())?;
        let vector = |name: &str, value: Vector| {
            check.vector(&at(name), value)?;
            Ok(DVec3::from(value.0))
        };
        Ok(Placing {
            scale: raw.scale,
            rotation,
            translate: vector("translate", raw.translate)?,
            stretch: vector("stretch", raw.stretch)?,
            velocity: vector("velocity", raw.velocity)?,
            angular_velocity: vector("angular_velocity", raw.angular_velocity)?,
        })
    }

    /// R u: a direction of the mesh, where it has been placed.
    pub fn turn(&self, direction: DVec3) -> DVec3 {
        self.rotation * direction
    }

    pub fn of_rigid(check: &Checker, key: &str, raw: &file::RigidBody) -> Result<Self, Error> {
        let vector = |name: &str, value: Vector| {
            check.vector(&format!("{key}.{name}"), value)?;
            Ok(DVec3::from(value.0))
        };
        Ok(Placing {
            scale: 1.0,
            rotation: turned(check, key, raw.rotate.as_ref())?,
            translate: vector("translate", raw.translate)?,
            stretch: DVec3::ONE,
            velocity: vector("velocity", raw.velocity)?,
            angular_velocity: vector("angular_velocity", raw.angular_velocity)?,
        })
    }

    /// translate + R (scale X)
    pub fn rest(&self, nodes: &[DVec3]) -> Vec<DVec3> {
        nodes
            .iter()
            .map(|&X| self.translate + self.rotation * (self.scale * X))
            .collect()
    }

    /// Start positions, stretched about the centroid, and v = velocity + w × (x − centroid).
    pub fn start(&self, rest: &[DVec3]) -> (Vec<DVec3>, Vec<DVec3>) {
        let sum = rest.iter().fold(DVec3::ZERO, |sum, &X| sum + X);
        let centroid = sum / rest.len() as f64;
        let x: Vec<DVec3> = rest
            .iter()
            .map(|&X| {
                // An axis that is not stretched keeps its bits: c + (X − c) may differ from X.
                let stretched = centroid + self.stretch * (X - centroid);
                DVec3::select(self.stretch.cmpeq(DVec3::ONE), X, stretched)
            })
            .collect();
        let v = x
            .iter()
            .map(|&x| self.velocity + self.angular_velocity.cross(x - centroid))
            .collect();
        (x, v)
    }

    pub fn round(&self, points: &[DVec3]) -> Result<Vec<[f32; 3]>, String> {
        let mut rounded = Vec::with_capacity(points.len());
        for (i, p) in points.iter().enumerate() {
            let r = p.to_array().map(|x| x as f32);
            if !r.iter().all(|x| x.is_finite()) {
                return Err(format!(
                    "node {i} = {:?} is too large for f32",
                    p.to_array()
                ));
            }
            rounded.push(r);
        }
        Ok(rounded)
    }
}

fn turned(check: &Checker, key: &str, raw: Option<&file::Rotate>) -> Result<DMat3, Error> {
    let Some(rotate) = raw else {
        return Ok(DMat3::IDENTITY);
    };
    let (axis, _) = check.direction(&format!("{key}.rotate.axis"), rotate.axis)?;
    check.any(&format!("{key}.rotate.degrees"), rotate.degrees)?;
    Ok(rotation(axis, rotate.degrees))
}

/// Rodrigues: R = cos I + sin k× + (1 − cos) k kᵀ, columns.
pub fn rotation(k: DVec3, degrees: f64) -> DMat3 {
    let (sin, cos) = libm::sincos(degrees * (std::f64::consts::PI / 180.0));
    let column = |e: DVec3| cos * e + sin * k.cross(e) + (1.0 - cos) * k.dot(e) * k;
    DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z))
}

/// The nodes that the body's pins hold, chosen by placed rest position, bounds included.
pub fn pins(check: &Checker, key: &str, raw: &file::Body, rest: &[DVec3]) -> Result<Pins, Error> {
    let mut pins = BTreeMap::new();
    let mut frames = Vec::new();
    for (i, pin) in raw.pin.iter().enumerate() {
        let key = format!("{key}.pin[{i}]");
        let velocity = check.vector(&format!("{key}.velocity"), pin.velocity)?;
        check.vector(&format!("{key}.angular_velocity"), pin.angular_velocity)?;
        let pivot = pin.pivot.unwrap_or_default();
        check.vector(&format!("{key}.pivot"), pivot)?;
        let mut motion = Motion {
            velocity: DVec3::from(pin.velocity.0),
            spin: DVec3::from(pin.angular_velocity.0),
            pivot: DVec3::from(pivot.0),
        };
        motion.frame(0.0).map_err(|why| {
            let spin = pin.angular_velocity.0;
            check.wrong(&format!("{key}.angular_velocity"), &spin, why)
        })?;
        let (corners, sphere) = (pin.corners.as_ref(), pin.sphere.as_ref());
        let (key, value, region) = region(check, &key, corners, sphere)?;
        let (mut selected, mut sum) = (0_u32, DVec3::ZERO);
        for (node, &X) in rest.iter().enumerate() {
            if region.holds(X) {
                pins.insert(node as u32, (velocity, i));
                selected += 1;
                sum += X;
            }
        }
        if pin.pivot.is_none() {
            motion.pivot = sum / f64::from(selected.max(1));
        }
        frames.push(motion);
        if selected == 0 {
            return Err(Error::Value {
                file: check.file.into(),
                key,
                value,
                why: "holds no node of the placed rest shape".into(),
            });
        }
    }
    let turning = frames
        .iter()
        .enumerate()
        .filter(|(_, m)| m.spin != DVec3::ZERO);
    let carried = turning.map(|(i, &motion)| Carried {
        motion,
        nodes: pins
            .iter()
            .filter(|pin| pin.1.1 == i)
            .map(|pin| *pin.0)
            .collect(),
    });
    let carried = carried.collect();
    Ok((
        pins.into_iter().map(|(node, (v, _))| (node, v)).collect(),
        carried,
    ))
}

/// Nodes and velocities, by rising node; and those that a turning frame carries.
pub type Pins = (Vec<(u32, [f32; 3])>, Vec<Carried>);

/// A box or a sphere, with the key and the value that it was given by.
pub fn region(
    check: &Checker,
    key: &str,
    corners: Option<&Corners>,
    sphere: Option<&file::Sphere>,
) -> Result<(String, String, Region), Error> {
    match (corners, sphere) {
        (Some(Corners(corners)), None) => {
            let key = format!("{key}.box");
            for &corner in corners {
                if corner.iter().any(|x| !x.is_finite()) {
                    return Err(check.wrong(&key, corners, "must be finite"));
                }
            }
            let [low, high] = corners.map(DVec3::from);
            if !low.cmple(high).all() {
                return Err(check.wrong(&key, corners, "the first corner must be the low one"));
            }
            Ok((key, format!("{corners:?}"), Region::Box { low, high }))
        }
        (None, Some(sphere)) => {
            let key = format!("{key}.sphere");
            let (centre, radius) = check.sphere(&key, sphere)?;
            let value = format!("{{ centre = {:?}, radius = {radius:?} }}", sphere.centre.0);
            Ok((key, value, Region::Sphere { centre, radius }))
        }
        _ => Err(Error::Scene {
            file: check.file.into(),
            what: format!("{key}: must have exactly one of box and sphere"),
        }),
    }
}

pub enum Region {
    Box { low: DVec3, high: DVec3 },
    Sphere { centre: DVec3, radius: f64 },
}

impl Region {
    pub fn holds(&self, p: DVec3) -> bool {
        match *self {
            Region::Box { low, high } => low.cmple(p).all() && p.cmple(high).all(),
            Region::Sphere { centre, radius } => p.distance_squared(centre) <= radius * radius,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placing() -> Placing {
        Placing {
            scale: 1.0,
            rotation: DMat3::IDENTITY,
            translate: DVec3::ZERO,
            stretch: DVec3::ONE,
            velocity: DVec3::ZERO,
            angular_velocity: DVec3::ZERO,
        }
    }

    #[test]
    fn rotation_turns_x_to_y_about_z() {
        let r = rotation(DVec3::Z, 90.0);
        assert!((r * DVec3::X).distance(DVec3::Y) < 1e-15);
        assert_eq!(rotation(DVec3::new(0.6, 0.0, 0.8), 0.0), DMat3::IDENTITY);
    }

    #[test]
    fn scale_then_rotation_then_translation() {
        let place = Placing {
            scale: 2.0,
            rotation: rotation(DVec3::Z, 90.0),
            translate: DVec3::new(10.0, 0.0, 0.0),
            ..placing()
        };
        let [x] = place.rest(&[DVec3::X])[..] else {
            panic!()
        };
        assert!(x.distance(DVec3::new(10.0, 2.0, 0.0)) < 1e-14);
    }

    #[test]
    fn no_stretch_changes_no_bit() {
        let rest: Vec<DVec3> = (0..100)
            .map(|i| DVec3::splat(0.1 * f64::from(i)) + 1e5)
            .collect();
        let (x, v) = placing().start(&rest);
        assert_eq!(x, rest);
        assert_eq!(v, vec![DVec3::ZERO; 100]);
    }

    #[test]
    fn stretch_and_spin_are_about_the_centroid() {
        let place = Placing {
            stretch: DVec3::new(3.0, 1.0, 1.0),
            velocity: DVec3::new(0.0, 0.0, 7.0),
            angular_velocity: DVec3::new(0.0, 0.0, 2.0),
            ..placing()
        };
        let (x, v) = place.start(&[DVec3::new(1.0, 5.0, 0.0), DVec3::new(3.0, 5.0, 0.0)]);
        assert_eq!(x, [DVec3::new(-1.0, 5.0, 0.0), DVec3::new(5.0, 5.0, 0.0)]);
        assert_eq!(v[1], DVec3::new(0.0, 6.0, 7.0)); // 2 ẑ × 3 x̂ = 6 ŷ
    }

    #[test]
    fn bounds_are_inclusive() {
        let unit = Region::Box {
            low: DVec3::ZERO,
            high: DVec3::ONE,
        };
        assert!(unit.holds(DVec3::ZERO) && unit.holds(DVec3::ONE));
        assert!(!unit.holds(DVec3::new(0.5, 0.5, 1.0 + 1e-15)));
        let ball = Region::Sphere {
            centre: DVec3::ZERO,
            radius: 2.0,
        };
        assert!(ball.holds(DVec3::new(0.0, 2.0, 0.0)) && !ball.holds(DVec3::new(0.0, 2.0, 1e-7)));
    }
}
