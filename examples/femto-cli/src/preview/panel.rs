//! One moment: ground, shadows, and all triangles from far to near.

use std::fmt::Write as _;

use glam::{DVec2, DVec3};
use svg::node::Blob;
use svg::node::element::{ClipPath, Group, Path, Rectangle};

use super::camera::{Camera, Frame};
use crate::colliders::{Collider, Shape};

use super::solid;

/// Shades of a colour between its shadow side and its lit side.
const SHADES: usize = 24;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    pub low: DVec3,
    pub high: DVec3,
}

impl Bounds {
    pub const EMPTY: Bounds = Bounds {
        low: DVec3::INFINITY,
        high: DVec3::NEG_INFINITY,
    };

    pub fn of<'a>(points: impl Iterator<Item = &'a DVec3>) -> Self {
        points.fold(Bounds::EMPTY, |b, &p| Bounds {
            low: b.low.min(p),
            high: b.high.max(p),
        })
    }

    pub fn and(&self, other: &Bounds) -> Self {
        Bounds {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Never zero, so that a body in one point has a picture too.
    pub fn diagonal(&self) -> f64 {
        self.low.distance(self.high).max(1e-9)
    }

    pub fn distance(&self, p: DVec3) -> f64 {
        p.distance(p.clamp(self.low, self.high))
    }

    pub fn corners(&self) -> [DVec3; 8] {
        let (l, h) = (self.low, self.high);
        std::array::from_fn(|i| {
            DVec3::new(
                if i & 1 == 0 { l.x } else { h.x },
                if i & 2 == 0 { l.y } else { h.y },
                if i & 4 == 0 { l.z } else { h.z },
            )
        })
    }
}

pub struct Panel<'a> {
    pub camera: &'a Camera,
    pub frame: Frame,
    pub window: &'a Bounds,
    /// Pixels a metre.
    pub scale: f64,
    pub size: [f64; 2],
    pub name: String,
}

/// A triangle to be drawn: its depth, corners, and class of colour and shade.
struct Facet {
    depth: f64,
    corners: [DVec3; 3],
    colour: usize,
    shade: usize,
}

/// The style sheet: a class for each colour and shade. Colliders come after the bodies.
pub fn style(bodies: &[[&str; 3]], solid: &[&str; 3]) -> String {
    let mut css = String::from(".s{stroke-width:.45;stroke-linejoin:round}");
    for (i, [dark, light, line]) in bodies.iter().chain([solid]).enumerate() {
        for shade in 0..SHADES {
            let t = shade as f64 / (SHADES - 1) as f64;
            let _ = write!(
                css,
                ".c{i}-{shade}{{fill:{};stroke:{}}}",
                mix(dark, light, t),
                mix(line, light, 0.75 * t)
            );
        }
    }
    css
}

impl Panel<'_> {
    pub fn draw(
        &self,
        positions: &[Vec<DVec3>],
        surfaces: &[Vec<[u32; 3]>],
        colliders: &[Collider],
    ) -> Group {
        let [width, height] = self.size;
        let clip = ClipPath::new().set("id", self.name.as_str()).add(
            Rectangle::new()
                .set("width", px(width))
                .set("height", px(height))
                .set("rx", 6),
        );
        let mut content = Group::new()
            .set("clip-path", format!("url(#{})", self.name))
            .add(
                Rectangle::new()
                    .set("width", px(width))
                    .set("height", px(height))
                    .set("fill", "#f3f5f8"),
            );
        for collider in colliders {
            if let Shape::Plane { normal, offset } = collider.shape {
                content = self.ground(content, normal, offset, positions, surfaces);
            }
        }
        let mut facets = Vec::new();
        for (b, (positions, surface)) in positions.iter().zip(surfaces).enumerate() {
            for face in surface {
                let corners = face.map(|n| positions[n as usize]);
                facets.extend(self.facet(corners, b % super::BODIES.len()));
            }
        }
        for collider in colliders {
            let solid = solid::triangles(&collider.shape).into_iter();
            facets.extend(solid.filter_map(|c| self.facet(c, super::BODIES.len())));
        }
        facets.sort_by(|a, b| a.depth.total_cmp(&b.depth));
        // As text: an element each would take ten times the memory.
        let path = |f: &Facet| {
            let d = self.outline(&f.corners);
            format!(r#"<path class="c{}-{}" d="{d}"/>"#, f.colour, f.shade)
        };
        let paths: Vec<String> = facets.iter().map(path).collect();
        let mut triangles = Group::new().set("class", "s");
        if !paths.is_empty() {
            triangles = triangles.add(Blob::new(paths.join("\n")));
        }
        let border = Rectangle::new()
            .set("width", px(width))
            .set("height", px(height))
            .set("rx", 6)
            .set("fill", "none")
            .set("stroke", "#d5dbe2");
        Group::new()
            .add(clip)
            .add(content.add(triangles))
            .add(border)
    }

    /// `None` for triangles that face away: a body is closed, so others hide them.
    fn facet(&self, corners: [DVec3; 3], colour: usize) -> Option<Facet> {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).try_normalize()?;
        if normal.dot(self.camera.eye) <= 0.0 {
            return None;
        }
        let light = normal.dot(self.camera.light).max(0.0);
        let above = 0.5 + 0.5 * normal.dot(self.camera.vertical);
        let brightness: f64 = 0.08 + 0.72 * light + 0.20 * above;
        Some(Facet {
            depth: self.camera.depth((a + b + c) / 3.0),
            corners,
            colour,
            shade: (brightness.clamp(0.0, 1.0) * (SHADES - 1) as f64 + 0.5) as usize,
        })
    }

    fn ground(
        &self,
        mut group: Group,
        normal: DVec3,
        offset: f64,
        positions: &[Vec<DVec3>],
        surfaces: &[Vec<[u32; 3]>],
    ) -> Group {
        let Some(tile) = self.camera.tile(self.window, normal, offset) else {
            return group;
        };
        let mut lines = String::new();
        for line in tile.lines() {
            let [a, b] = line.map(|p| self.pixel(p));
            let _ = write!(lines, "M{},{}L{},{}", px(a.x), px(a.y), px(b.x), px(b.y));
        }
        // Shadows fall straight down, of the faces that look up; one path, so they unite.
        let vertical = self.camera.vertical;
        let mut shadow = String::new();
        for (positions, surface) in positions.iter().zip(surfaces) {
            for face in surface {
                let [a, b, c] = face.map(|n| positions[n as usize]);
                if (b - a).cross(c - a).dot(vertical) <= 0.0 {
                    continue;
                }
                let fallen = [a, b, c].map(|p| self.camera.fall(p, normal, offset));
                if let [Some(a), Some(b), Some(c)] = fallen {
                    shadow += &self.outline(&[a, b, c]);
                }
            }
        }
        let floor = Path::new().set("d", self.outline(&tile.corners()));
        group = group
            .add(floor.set("fill", "#e3e7ec").set("stroke", "#cdd3db"))
            .add(
                Path::new()
                    .set("d", lines)
                    .set("stroke", "#ccd2da")
                    .set("stroke-width", 0.7)
                    .set("fill", "none"),
            );
        if shadow.is_empty() {
            return group;
        }
        group.add(
            Path::new()
                .set("d", shadow)
                .set("fill", "#9fa8b3")
                .set("opacity", 0.75),
        )
    }

    fn outline(&self, corners: &[DVec3]) -> String {
        let mut path = String::new();
        for (i, &corner) in corners.iter().enumerate() {
            let p = self.pixel(corner);
            let _ = write!(
                path,
                "{}{},{}",
                if i == 0 { 'M' } else { 'L' },
                px(p.x),
                px(p.y)
            );
        }
        path + "Z"
    }

    fn pixel(&self, p: DVec3) -> DVec2 {
        let at = (self.camera.project(p) - self.frame.middle()) * self.scale;
        DVec2::new(self.size[0] / 2.0 + at.x, self.size[1] / 2.0 - at.y)
    }
}

/// A tenth of a pixel is enough.
fn px(value: f64) -> String {
    let text = format!("{value:.1}");
    text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
}

fn mix(from: &str, to: &str, t: f64) -> String {
    let part = |colour: &str, i: usize| {
        let digits = colour.get(1 + 2 * i..3 + 2 * i).unwrap_or("00");
        f64::from(u8::from_str_radix(digits, 16).unwrap_or(0))
    };
    let channel = |i| part(from, i) + (part(to, i) - part(from, i)) * t;
    format!(
        "#{:02x}{:02x}{:02x}",
        channel(0) as u8,
        channel(1) as u8,
        channel(2) as u8
    )
}
