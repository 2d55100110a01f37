//! Signed distances in f64, found by search and by cases, not by the crate's formulas.

use nalgebra::{Matrix3, Rotation3, Vector3};

pub type V = Vector3<f64>;

pub fn v(x: femto::glam::Vec3) -> V {
    V::new(x.x.into(), x.y.into(), x.z.into())
}

/// To a segment by ternary search along it, less the radius.
pub fn capsule(x: V, from: V, to: V, radius: f64) -> f64 {
    let at = |t: f64| (x - from - (to - from) * t).norm();
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..120 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if at(a) < at(b) { high = b } else { low = a }
    }
    at(low).min(at(0.0)).min(at(1.0)) - radius
}

/// To the nearest of six rectangles, negative if all six planes have it behind them.
pub fn cuboid(x: V, centre: V, half: V) -> f64 {
    let p = x - centre;
    let mut nearest = f64::INFINITY;
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let foot = V::from_fn(|a, _| {
                if a == axis {
                    side * half[a]
                } else {
                    p[a].clamp(-half[a], half[a])
                }
            });
            nearest = nearest.min((p - foot).norm());
        }
    }
    let inside = (0..3).all(|a| p[a].abs() < half[a]);
    if inside { -nearest } else { nearest }
}

/// A grid of heights as triangles.
pub struct Ground {
    pub heights: Vec<f32>,
    pub samples: [u32; 2],
    pub spacing: [f64; 2],
}

impl Ground {
    fn corner(&self, i: u32, k: u32) -> V {
        let height = self.heights[(i * self.samples[1] + k) as usize];
        V::new(
            f64::from(i) * self.spacing[0],
            height.into(),
            f64::from(k) * self.spacing[1],
        )
    }

    /// The triangle over or under a point of the grid's inside, found by looking at all of them.
    fn triangle(&self, x: V) -> [V; 3] {
        let inside = |[a, b, c]: &[V; 3]| {
            let side = |p: &V, q: &V| (q.x - p.x) * (x.z - p.z) - (q.z - p.z) * (x.x - p.x);
            let sides = [side(a, b), side(b, c), side(c, a)];
            sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)
        };
        let cells =
            (0..self.samples[0] - 1).flat_map(|i| (0..self.samples[1] - 1).map(move |k| (i, k)));
        cells
            .flat_map(|(i, k)| {
                let (low, high) = (self.corner(i, k), self.corner(i + 1, k + 1));
                [
                    [low, self.corner(i + 1, k), high],
                    [low, high, self.corner(i, k + 1)],
                ]
            })
            .find(inside)
            .expect("a place over the grid")
    }

    /// To the plane of that triangle, and the plane's upward normal.
    pub fn distance(&self, x: V) -> (f64, V) {
        let [a, b, c] = self.triangle(x);
        let n = (b - a).cross(&(c - a)).normalize();
        let n = if n.y < 0.0 { -n } else { n };
        (n.dot(&(x - a)), n)
    }

    /// y above the surface.
    pub fn above(&self, x: V) -> f64 {
        let (d, n) = self.distance(x);
        d / n.y
    }
}

/// Where a frame of this origin and rotation is after a time, and what then is at x in its own coordinates.
pub struct Motion {
    pub origin: V,
    pub rotation: Matrix3<f64>,
    pub velocity: V,
    pub spin: V,
}

impl Motion {
    pub fn rotation_after(&self, time: f64) -> Matrix3<f64> {
        Rotation3::from_scaled_axis(self.spin * time).into_inner() * self.rotation
    }

    pub fn to_local(&self, x: V, time: f64) -> V {
        self.rotation_after(time).transpose() * (x - self.origin - self.velocity * time)
    }

    pub fn to_world(&self, p: V, time: f64) -> V {
        self.origin + self.velocity * time + self.rotation_after(time) * p
    }

    /// Of a point carried along, by a central difference.
    pub fn velocity_at(&self, x: V, time: f64) -> V {
        let p = self.to_local(x, time);
        let dt = 1e-6;
        (self.to_world(p, time + dt) - self.to_world(p, time - dt)) / (2.0 * dt)
    }
}

/// ∇ of a distance by central differences; `None` next to a kink, where those of one side differ.
pub fn gradient(d: impl Fn(V) -> f64, x: V) -> Option<V> {
    let step = 1e-6;
    let mut g = V::zeros();
    for axis in 0..3 {
        let e = V::ith(axis, step);
        let (before, here, after) = (d(x - e), d(x), d(x + e));
        if (after + before - 2.0 * here).abs() > 1e-4 * step {
            return None;
        }
        g[axis] = (after - before) / (2.0 * step);
    }
    Some(g)
}
