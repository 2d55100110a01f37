//! A parallel projection, seen from the front, a little from the right and from above.

use glam::{DVec2, DVec3};

use super::panel::Bounds;
use super::solid;
use crate::colliders::{Collider, Shape};

const AZIMUTH: f64 = 30.0;
const ELEVATION: f64 = 17.0;

pub struct Camera {
    /// Axes of the picture, and the direction towards the eye.
    right: DVec3,
    up: DVec3,
    pub eye: DVec3,
    /// Where light comes from.
    pub light: DVec3,
    /// Against gravity.
    pub vertical: DVec3,
}

/// The part of the picture's plane that is needed, y up.
#[derive(Clone, Copy)]
pub struct Frame {
    low: DVec2,
    high: DVec2,
}

impl Frame {
    /// Never zero.
    pub fn size(&self) -> DVec2 {
        (self.high - self.low).max(DVec2::splat(1e-9))
    }

    pub fn middle(&self) -> DVec2 {
        (self.high + self.low) / 2.0
    }

    fn of(points: impl Iterator<Item = DVec2>) -> Self {
        let mut frame = Frame {
            low: DVec2::INFINITY,
            high: DVec2::NEG_INFINITY,
        };
        for p in points {
            frame.low = frame.low.min(p);
            frame.high = frame.high.max(p);
        }
        frame
    }
}

impl Camera {
    /// Without gravity, y is up.
    pub fn new(gravity: DVec3) -> Self {
        let vertical = (-gravity).try_normalize().unwrap_or(DVec3::Y);
        // The front is seen from +z, or from −y where z is up.
        let front = if vertical.z.abs() < 0.9 {
            DVec3::Z
        } else {
            DVec3::NEG_Y
        };
        let front = (front - vertical * front.dot(vertical)).normalize();
        let side = vertical.cross(front);
        let (sin_a, cos_a) = libm::sincos(AZIMUTH.to_radians());
        let (sin_e, cos_e) = libm::sincos(ELEVATION.to_radians());
        let eye = (front * cos_a + side * sin_a) * cos_e + vertical * sin_e;
        let right = vertical.cross(eye).normalize();
        let up = eye.cross(right);
        let light = (vertical * 0.85 - right * 0.55 + eye * 0.45).normalize();
        Camera {
            right,
            up,
            eye,
            light,
            vertical,
        }
    }

    pub fn project(&self, p: DVec3) -> DVec2 {
        DVec2::new(p.dot(self.right), p.dot(self.up))
    }

    /// Larger is nearer.
    pub fn depth(&self, p: DVec3) -> f64 {
        p.dot(self.eye)
    }

    /// The frame that shows these points, the ground straight under them, and solids near them.
    pub fn frame(&self, points: &[DVec3], window: &Bounds, colliders: &[Collider]) -> Frame {
        let mut needed: Vec<DVec2> = points.iter().map(|&p| self.project(p)).collect();
        for collider in colliders {
            match collider.shape {
                Shape::Plane { normal, offset } => {
                    if self.tile(window, normal, offset).is_some() {
                        let shadow = points.iter().filter_map(|&p| self.fall(p, normal, offset));
                        needed.extend(shadow.map(|p| self.project(p)));
                    }
                }
                Shape::Sphere { centre, radius } => {
                    if radius < window.diagonal()
                        && window.distance(centre) < radius + window.diagonal()
                    {
                        let c = self.project(centre);
                        needed.extend([c - radius, c + radius]);
                    }
                }
                _ => {
                    let corners: Vec<DVec3> = solid::triangles(&collider.shape)
                        .into_iter()
                        .flatten()
                        .collect();
                    let own = Bounds::of(corners.iter());
                    let size = own.diagonal();
                    let middle = (own.low + own.high) / 2.0;
                    if size < 2.0 * window.diagonal()
                        && window.distance(middle) < size / 2.0 + window.diagonal()
                    {
                        needed.extend(corners.iter().map(|&p| self.project(p)));
                    }
                }
            }
        }
        Frame::of(needed.into_iter())
    }

    /// Where a point falls on a plane, unless that is too steep to catch shadows.
    pub fn fall(&self, p: DVec3, normal: DVec3, offset: f64) -> Option<DVec3> {
        let slope = normal.dot(self.vertical);
        (slope > 0.1).then(|| p - self.vertical * ((normal.dot(p) - offset) / slope))
    }

    /// The piece of a plane that lies under a window, when it is near and seen from above.
    pub fn tile(&self, window: &Bounds, normal: DVec3, offset: f64) -> Option<Tile> {
        let distance = window
            .corners()
            .iter()
            .map(|c| normal.dot(*c) - offset)
            .fold(f64::INFINITY, f64::min);
        if normal.dot(self.eye) < 0.05 || distance > window.diagonal() {
            return None;
        }
        // Grid lines run along the world's axes where the plane has them.
        let axis = [DVec3::X, DVec3::Y, DVec3::Z]
            .into_iter()
            .find(|a| normal.dot(*a).abs() < 1e-9);
        let u = axis.unwrap_or_else(|| normal.any_orthonormal_vector());
        let v = normal.cross(u);
        let corners = window.corners();
        let range = |axis: DVec3| {
            let low = corners
                .iter()
                .map(|c| axis.dot(*c))
                .fold(f64::INFINITY, f64::min);
            let high = corners
                .iter()
                .map(|c| axis.dot(*c))
                .fold(f64::NEG_INFINITY, f64::max);
            let margin = 0.5 * window.diagonal();
            (low - margin, high + margin)
        };
        Some(Tile {
            normal,
            offset,
            u,
            v,
            u_range: range(u),
            v_range: range(v),
        })
    }
}

/// A rectangle on a plane.
pub struct Tile {
    normal: DVec3,
    offset: f64,
    u: DVec3,
    v: DVec3,
    u_range: (f64, f64),
    v_range: (f64, f64),
}

impl Tile {
    fn at(&self, u: f64, v: f64) -> DVec3 {
        self.normal * self.offset + self.u * u + self.v * v
    }

    pub fn corners(&self) -> [DVec3; 4] {
        let ((u0, u1), (v0, v1)) = (self.u_range, self.v_range);
        [
            self.at(u0, v0),
            self.at(u1, v0),
            self.at(u1, v1),
            self.at(u0, v1),
        ]
    }

    /// Grid lines at round distances, some five to ten in the longer direction.
    pub fn lines(&self) -> Vec<[DVec3; 2]> {
        let ((u0, u1), (v0, v1)) = (self.u_range, self.v_range);
        let length = (u1 - u0).max(v1 - v0);
        if !(length > 0.0 && length.is_finite()) {
            return Vec::new();
        }
        let power = libm::pow(10.0, libm::floor(libm::log10(length / 5.0)));
        let spacing = [5.0, 2.0, 1.0]
            .into_iter()
            .map(|m| m * power)
            .find(|s| *s <= length / 5.0)
            .unwrap_or(power);
        let ticks = |low: f64, high: f64| {
            let first = libm::ceil(low / spacing);
            (0..100)
                .map(move |i| (first + f64::from(i)) * spacing)
                .take_while(move |t| *t <= high)
        };
        let across = ticks(u0, u1).map(|u| [self.at(u, v0), self.at(u, v1)]);
        across
            .chain(ticks(v0, v1).map(|v| [self.at(u0, v), self.at(u1, v)]))
            .collect()
    }
}
