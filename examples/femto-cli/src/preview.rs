//! `preview.svg`: the surface at a few moments, side by side at one scale, and below them
//! the energies over time.

mod camera;
mod chart;
mod panel;
mod solid;

use std::path::Path;

use femto::surface::boundary_triangles;
use glam::{DVec2, DVec3};
use svg::Document;
use svg::node::Blob;
use svg::node::element::{Group, Rectangle, Style, Text};

use crate::colliders::Collider;
use crate::scene::{Body, Scene};
use crate::sim::{Energies, Sim};
use camera::{Camera, Frame};
use panel::{Bounds, Panel};

/// How many states a picture shows.
pub const MOMENTS: u32 = 5;

/// A picture of more would take gigabytes.
const MOST_COLLIDERS: usize = 500;

const WIDTH: f64 = 1200.0;
const MARGIN: f64 = 24.0;
const GAP: f64 = 10.0;
/// Around the bodies in a panel.
const PADDING: f64 = 18.0;
/// A panel's width, where there are few.
const WIDEST: f64 = 480.0;
const HEAD: f64 = 58.0;
const CHART_HEIGHT: f64 = 330.0;
const FONT: &str = "Helvetica, Arial, 'DejaVu Sans', sans-serif";

/// Colours of bodies in turn: shadow side, lit side, mesh lines.
const BODIES: [[&str; 3]; 6] = [
    ["#27496d", "#a9d3ff", "#1f3b59"],
    ["#7a3b12", "#ffcf9c", "#5f2e0e"],
    ["#215732", "#b5e8c0", "#194226"],
    ["#55306b", "#e2c4f5", "#412452"],
    ["#6b5a12", "#f7e6a0", "#51440d"],
    ["#6b2430", "#f8bcc5", "#521b24"],
];
/// Colliders.
const SOLID: [&str; 3] = ["#8b8d91", "#f1f1ef", "#85878b"];

pub struct Moment {
    time: f64,
    positions: Vec<Vec<DVec3>>,
    /// Where a body has broken, what is its surface by now.
    torn: Option<Vec<Vec<[u32; 3]>>>,
}

impl Moment {
    pub fn new(time: f64, scene: &Scene, sim: &Sim) -> Self {
        let tets: Vec<_> = scene.bodies.iter().map(Body::shown_tets).collect();
        let point = |&[x, y, z]: &[f32; 3]| DVec3::new(x.into(), y.into(), z.into());
        let positions = (0..sim.bodies())
            .map(|b| {
                scene.bodies[b]
                    .show(sim.positions(b))
                    .iter()
                    .map(point)
                    .collect()
            })
            .collect();
        let surface = |(body, tets): (usize, &&[[u32; 4]])| {
            let whole = sim.whole(body, tets.len());
            let left = tets.iter().zip(whole).filter(|(_, whole)| *whole);
            boundary_triangles(&left.map(|(tet, _)| *tet).collect::<Vec<_>>())
        };
        let broken = sim.damage().is_some_and(|damage| damage.broken_tets > 0);
        let torn = broken.then(|| tets.iter().enumerate().map(surface).collect());
        Moment {
            time,
            positions,
            torn,
        }
    }
}

/// Energies over time; of a long run only every 2nd, 4th, ... state is kept.
pub struct EnergyLog {
    points: Vec<(f64, Energies)>,
    stride: u32,
    skipped: u32,
    last: (f64, Energies),
}

impl EnergyLog {
    const LIMIT: usize = 2048;

    pub fn new(start: Energies) -> Self {
        EnergyLog {
            points: vec![(0.0, start)],
            stride: 1,
            skipped: 0,
            last: (0.0, start),
        }
    }

    pub fn push(&mut self, time: f64, energies: Energies) {
        self.last = (time, energies);
        self.skipped += 1;
        if self.skipped < self.stride {
            return;
        }
        self.skipped = 0;
        self.points.push(self.last);
        if self.points.len() > Self::LIMIT {
            let mut keep = false;
            self.points.retain(|_| {
                keep = !keep;
                keep
            });
            self.stride *= 2;
        }
    }

    fn all(&self) -> impl Iterator<Item = (f64, Energies)> + '_ {
        let last = (self.skipped > 0).then_some(self.last);
        self.points.iter().copied().chain(last)
    }
}

pub struct Preview<'a> {
    pub moments: Vec<Moment>,
    scene: &'a Scene,
    surfaces: Vec<Vec<[u32; 3]>>,
}

impl<'a> Preview<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        Preview {
            moments: Vec::new(),
            scene,
            surfaces: scene
                .bodies
                .iter()
                .map(|b| boundary_triangles(b.shown_tets()))
                .collect(),
        }
    }

    pub fn draw(&self, energy: &EnergyLog, refused: bool) -> String {
        let camera = Camera::new(DVec3::from(self.scene.gravity.map(f64::from)));
        let (views, follows) = self.views(&camera);
        let count = self.moments.len().max(1) as f64;
        let width = ((WIDTH - 2.0 * MARGIN - GAP * (count - 1.0)) / count).min(WIDEST);
        let needed = views
            .iter()
            .map(|(_, frame)| frame.size())
            .fold(DVec2::ZERO, DVec2::max);
        // One scale for all; panels are as high as the motion is, within reason.
        let inner = width - 2.0 * PADDING;
        let height = (needed.y / needed.x * inner + 2.0 * PADDING).clamp(190.0, 420.0);
        let scale = (inner / needed.x).min((height - 2.0 * PADDING) / needed.y);

        let top = HEAD + height + 34.0;
        let total = top + CHART_HEIGHT + 12.0;
        let mut document = Document::new()
            .set("viewBox", (0, 0, WIDTH, total.ceil()))
            .set("width", WIDTH)
            .set("height", total.ceil())
            .set("font-family", FONT)
            .add(Style::new(panel::style(&BODIES, &SOLID)))
            .add(
                Rectangle::new()
                    .set("width", "100%")
                    .set("height", "100%")
                    .set("fill", "#ffffff"),
            )
            .add(text(&self.title(), MARGIN, 30.0, 20.0, "#1d2733").set("font-weight", "bold"))
            .add(text(
                &self.subtitle(follows, refused),
                MARGIN,
                49.0,
                13.0,
                "#5b6673",
            ));
        for (i, (moment, (window, frame))) in self.moments.iter().zip(&views).enumerate() {
            let left = MARGIN + i as f64 * (width + GAP);
            let panel = Panel {
                camera: &camera,
                frame: *frame,
                window,
                scale,
                size: [width, height],
                name: format!("panel{i}"),
            };
            let picture = panel.draw(
                &moment.positions,
                moment.torn.as_ref().unwrap_or(&self.surfaces),
                &self.colliders_at(moment.time),
            );
            let label = format!("t = {} s", trim(moment.time));
            document = document
                .add(
                    Group::new()
                        .set("transform", format!("translate({left:.1},{HEAD})"))
                        .add(picture),
                )
                .add(
                    text(
                        &label,
                        left + width / 2.0,
                        HEAD + height + 19.0,
                        13.0,
                        "#333d48",
                    )
                    .set("text-anchor", "middle"),
                );
        }
        let chart = chart::energies(energy.all(), WIDTH - 2.0 * MARGIN, CHART_HEIGHT);
        document = document.add(
            Group::new()
                .set("transform", format!("translate({MARGIN},{top:.1})"))
                .add(Blob::new(chart)),
        );
        document.to_string()
    }

    /// The scene file without its folders: where it lies is not what the picture shows.
    fn title(&self) -> String {
        let name = Path::new(&self.scene.file).file_name();
        name.map_or_else(
            || self.scene.file.clone(),
            |name| name.to_string_lossy().into_owned(),
        )
    }

    fn subtitle(&self, follows: bool, refused: bool) -> String {
        let scene = self.scene;
        let nodes: usize = scene.bodies.iter().map(|b| b.rest.len()).sum();
        let tets: usize = scene.bodies.iter().map(|b| b.tets.len()).sum();
        let budget = scene.budget;
        let mut line = format!(
            "{nodes} nodes, {tets} tets · {} steps of {} s · {} × {} iterations, {} polar sweep{}, {}, start {}",
            scene.steps,
            trim(scene.dt),
            budget.substeps,
            budget.iterations,
            budget.polar_sweeps,
            if budget.polar_sweeps == 1 { "" } else { "s" },
            scene.solver.preconditioner,
            scene.solver.start
        );
        if scene.colliders.len() > MOST_COLLIDERS {
            line += &format!(
                " · only {MOST_COLLIDERS} of {} colliders",
                scene.colliders.len()
            );
        }
        if follows {
            line += " · each view follows the bodies";
        }
        if refused {
            line += " · ended by a refused step";
        }
        line
    }

    /// What each panel shows: all the same part of space, or, where the bodies travel much
    /// farther than they are long, each its own (then the second value is true).
    fn views(&self, camera: &Camera) -> (Vec<(Bounds, Frame)>, bool) {
        let points: Vec<Vec<DVec3>> = self.moments.iter().map(|m| m.positions.concat()).collect();
        let each: Vec<Bounds> = points.iter().map(|p| Bounds::of(p.iter())).collect();
        let largest = each.iter().map(Bounds::diagonal).fold(0.0, f64::max);
        let all = each.iter().fold(Bounds::EMPTY, |all, b| all.and(b));
        let colliders = self.moments.iter().map(|m| self.colliders_at(m.time));
        if all.diagonal() <= 4.0 * largest {
            let colliders: Vec<Collider> = colliders.flatten().collect();
            let frame = camera.frame(&points.concat(), &all, &colliders);
            return (vec![(all, frame); each.len()], false);
        }
        let own = |((points, window), colliders): ((&Vec<DVec3>, &Bounds), Vec<Collider>)| {
            (*window, camera.frame(points, window, &colliders))
        };
        (
            points.iter().zip(&each).zip(colliders).map(own).collect(),
            true,
        )
    }

    fn colliders_at(&self, time: f64) -> Vec<Collider> {
        let at = |c: &Collider| Collider {
            shape: c.shape_at(time),
            ..c.clone()
        };
        let shown = self.scene.colliders.iter().take(MOST_COLLIDERS);
        shown.map(at).collect()
    }
}

fn text(content: &str, x: f64, y: f64, size: f64, colour: &str) -> Text {
    let clean: String = content.chars().filter(|c| !c.is_control()).collect();
    Text::new(clean)
        .set("x", format!("{x:.1}"))
        .set("y", format!("{y:.1}"))
        .set("font-size", size)
        .set("fill", colour)
}

/// At most four significant digits, without trailing zeros.
fn trim(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let digits = (3 - libm::floor(libm::log10(value.abs())) as i32).clamp(0, 9);
    if !(1e-6..1e7).contains(&value.abs()) {
        let text = format!("{value:.2e}");
        let (mantissa, power) = text.split_once('e').unwrap_or((&text, "0"));
        return format!(
            "{}e{power}",
            mantissa.trim_end_matches('0').trim_end_matches('.')
        );
    }
    let text = format!("{value:.*}", digits as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').into(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_for_people() {
        assert_eq!(trim(0.006666667), "0.006667");
        assert_eq!(trim(0.5), "0.5");
        assert_eq!(trim(2.0), "2");
        assert_eq!(trim(1234567.0), "1234567");
        assert_eq!(trim(1e-9), "1e-9");
        assert_eq!(trim(-1.25e60), "-1.25e60");
        assert_eq!(trim(0.0), "0");
    }

    #[test]
    fn a_long_run_keeps_its_ends_and_little_memory() {
        let e = |kinetic| Energies {
            kinetic,
            elastic: 0.0,
            potential: 0.0,
        };
        let mut log = EnergyLog::new(e(0.0));
        for i in 1..=100_001 {
            log.push(f64::from(i), e(f64::from(i)));
        }
        let all: Vec<f64> = log.all().map(|(t, _)| t).collect();
        assert!(all.len() <= EnergyLog::LIMIT + 1);
        assert_eq!((all[0], all[all.len() - 1]), (0.0, 100_001.0));
        assert!(all.is_sorted());
    }
}
