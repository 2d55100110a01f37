//! The search for contacts: with any number of boxes the same, to the bit, and what a search written a second time in
//! f64, of every node against every triangle, finds.

use femto::Scene;
use femto::coupling::Coupling;
use femto::detect::{Aabb, boxes};
use femto::glam::Vec3;
use femto::join::Assembly;
use femto::rigid::Shape;
use femto::settings::{Budget, Settings};
use nalgebra::Vector3;
use proptest::prelude::*;

use super::support::meshes::{Lcg, noise};
use super::world::{AXES, World, ball, cube, soft};

const H: f32 = 1.0 / 150.0;
const SIDE: f32 = 0.4;

/// What is done to every body.
#[derive(Clone, Copy, Debug)]
enum Deformed {
    Shaken(f64),
    Flat,
    Line,
    Point,
    Inverted,
    Random,
    /// Metres from the origin.
    Far(f32),
}

fn deformed() -> impl Strategy<Value = Deformed> {
    prop_oneof![
        4 => (0.0..0.05).prop_map(Deformed::Shaken),
        1 => Just(Deformed::Flat),
        1 => Just(Deformed::Line),
        1 => Just(Deformed::Point),
        1 => Just(Deformed::Inverted),
        1 => Just(Deformed::Random),
        1 => (10.0_f32..1e5).prop_map(Deformed::Far),
    ]
}

fn vector(size: f32) -> impl Strategy<Value = Vec3> {
    [-size..size, -size..size, -size..size].prop_map(Vec3::from_array)
}

#[derive(Clone, Debug)]
struct Case {
    cells: [usize; 2],
    at: Vec3,
    deformed: Deformed,
    throw: [Vec3; 4],
    seed: u64,
}

fn case() -> impl Strategy<Value = Case> {
    (
        [1_usize..5, 1_usize..5],
        prop_oneof![
            vector(0.5),
            Just(Vec3::Y * SIDE),
            Just(Vec3::new(0.1, SIDE, 0.0))
        ],
        deformed(),
        [vector(3.0), vector(3.0), vector(8.0), vector(8.0)],
        1_u64..1 << 40,
    )
        .prop_map(|(cells, at, deformed, throw, seed)| Case {
            cells,
            at,
            deformed,
            throw,
            seed,
        })
}

fn settings() -> Settings<'static> {
    Settings::new(H).unwrap().with_budget(Budget {
        iterations: 1,
        polar_sweeps: 1,
    })
}

/// Two cubes about `case.at` from each other; or also their edges, a ball and a box.
fn world(case: &Case, all: bool) -> World {
    let mut parts = Assembly::new();
    for (cells, at) in case.cells.iter().zip([Vec3::ZERO, case.at]) {
        let mesh = cube(f64::from(SIDE), *cells, at.to_array());
        parts.soft(&mesh.nodes, &mesh.tets, soft(1e5), 0.3).unwrap();
    }
    if all {
        for (shape, at) in [
            (ball(0.15), Vec3::splat(0.3)),
            (
                Shape::Cuboid {
                    half: Vec3::new(0.1, 0.15, 0.2),
                },
                Vec3::new(-0.1, 0.3, 0.2),
            ),
        ] {
            parts.rigid(shape, 5.0, at, AXES, 0.3, &soft(1e5)).unwrap();
        }
    }
    let soft_nodes = parts.parts[1].nodes.end;
    if all {
        parts.touch_by_edges();
    }
    let mut world = World::new(parts, &settings(), 1024);
    let [v, u, spin, turn] = case.throw;
    world.throw(&[(v, spin), (u, turn), (u - v, turn - spin), (v, turn)]);
    let mut x = world.body.positions().to_vec();
    let v = world.body.velocities().to_vec();
    let mut random = Lcg(case.seed);
    let centre = 0.5 * SIDE;
    for (x, d) in x.iter_mut().zip(noise(soft_nodes, 1.0, case.seed)) {
        let keep = |axis: usize, x: &mut [f32; 3]| x[axis] = centre;
        match case.deformed {
            Deformed::Shaken(size) => {
                for axis in 0..3 {
                    x[axis] += d[axis] * size as f32;
                }
            }
            Deformed::Flat => keep(1, x),
            Deformed::Line => (0..2).for_each(|axis| keep(axis, x)),
            Deformed::Point => (0..3).for_each(|axis| keep(axis, x)),
            Deformed::Inverted => x[0] = SIDE - x[0],
            Deformed::Random => *x = [0; 3].map(|_| random.signed() as f32 * SIDE),
            Deformed::Far(_) => {}
        }
    }
    if let Deformed::Far(far) = case.deformed {
        x.iter_mut().for_each(|x| x[0] += far);
    }
    world.body.place(&x, &v).unwrap();
    world
}

/// Slots after a step with so many boxes.
fn slots(case: &Case, count: usize) -> Vec<Coupling> {
    let mut world = world(case, true);
    world.boxes = vec![Aabb::EMPTY; count];
    let _ = world.step(&Scene::default(), &settings());
    world.slots
}

/// What may become of a node and a piece.
#[derive(Debug)]
struct Candidate {
    node: u32,
    other: usize,
    /// Of the triangles that may be taken for the nearest.
    gaps: Vec<f64>,
    /// What rounding may change of a gap.
    error: f64,
    /// Whether it is a contact, where rounding cannot decide that.
    sure: Option<bool>,
}

/// All at the start of a step, in f64.
struct Brute<'a> {
    world: &'a World,
    x: Vec<Vector3<f64>>,
    v: Vec<Vector3<f64>>,
    unit: f64,
    /// Of coordinates.
    rounding: f64,
}

/// The nearest point: where the plane's foot is inside, that, else the nearest of the three sides'. Weights.
fn nearest(p: &Vector3<f64>, [a, b, c]: [Vector3<f64>; 3]) -> [f64; 3] {
    let area = (b - a).cross(&(c - a));
    let part = |u: Vector3<f64>, w: Vector3<f64>| (u - p).cross(&(w - p)).dot(&area);
    let inside = [part(b, c), part(c, a), part(a, b)].map(|x| x / area.norm_squared());
    if inside.iter().all(|w| *w >= 0.0) {
        return inside;
    }
    let along = |u: Vector3<f64>, w: Vector3<f64>| {
        let t = (p - u).dot(&(w - u)) / (w - u).norm_squared();
        if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) }
    };
    let (s, t, r) = (along(a, b), along(b, c), along(c, a));
    let sides = [[1.0 - s, s, 0.0], [0.0, 1.0 - t, t], [r, 0.0, 1.0 - r]];
    let apart = |w: &[f64; 3]| (a * w[0] + b * w[1] + c * w[2] - p).norm();
    sides
        .into_iter()
        .min_by(|a, b| apart(a).total_cmp(&apart(b)))
        .unwrap()
}

impl<'a> Brute<'a> {
    fn new(world: &'a World) -> Self {
        let all = |u: &[[f32; 3]]| {
            u.iter()
                .map(|u| Vector3::from(u.map(f64::from)))
                .collect::<Vec<_>>()
        };
        let x = all(world.body.positions());
        let most = x.iter().fold(0.0, |most: f64, x| most.max(x.amax()));
        Self {
            world,
            v: all(world.body.velocities()),
            unit: f64::from(world.body.rest().header.length_unit),
            rounding: 16.0 * f64::from(f32::EPSILON) * most,
            x,
        }
    }

    /// Now and after the step.
    fn ends(&self, node: u32) -> [Vector3<f64>; 2] {
        let (x, v) = (self.x[node as usize], self.v[node as usize]);
        [x, x + v * f64::from(H)]
    }

    /// Low corner, high corner, greatest speed.
    fn bounds(&self, nodes: &[u32]) -> (Vector3<f64>, Vector3<f64>, f64) {
        let ends: Vec<_> = nodes.iter().flat_map(|n| self.ends(*n)).collect();
        let speeds = nodes.iter().map(|n| self.v[*n as usize].norm());
        (
            ends.iter().copied().reduce(|a, b| a.inf(&b)).unwrap(),
            ends.iter().copied().reduce(|a, b| a.sup(&b)).unwrap(),
            speeds.fold(0.0, f64::max),
        )
    }

    fn contacts(&self) -> Vec<Candidate> {
        let pieces = self.world.parts.pieces();
        let (a, b) = (self.bounds(pieces[0].nodes), self.bounds(pieces[1].nodes));
        let (low, high) = (a.0.sup(&b.0), a.1.inf(&b.1));
        let reach = 4.0 * self.unit + f64::from(H) * (a.2 + b.2);
        let margin = self.unit / 64.0;
        let mut out = Vec::new();
        for (of, other) in [(0, 1), (1, 0)] {
            for &node in pieces[of].nodes {
                let within = |margin: f64| {
                    let inside = |p: Vector3<f64>| {
                        (0..3).all(|k| p[k] >= low[k] - margin && p[k] <= high[k] + margin)
                    };
                    self.ends(node).into_iter().any(inside)
                        && (0..3).all(|k| low[k] - margin <= high[k] + margin)
                };
                let limits = [
                    within(margin - self.rounding),
                    within(margin + self.rounding),
                ];
                if limits[1] {
                    out.extend(self.candidate(
                        node,
                        other,
                        pieces[other].triangles,
                        reach,
                        limits[0],
                    ));
                }
            }
        }
        out
    }

    fn candidate(
        &self,
        node: u32,
        other: usize,
        triangles: &[[u32; 3]],
        reach: f64,
        seen: bool,
    ) -> Option<Candidate> {
        let p = self.x[node as usize];
        let feet: Vec<_> = triangles
            .iter()
            .filter_map(|nodes| {
                let corners = nodes.map(|n| self.x[n as usize]);
                let area = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
                let w = nearest(&p, corners);
                let foot = corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2];
                let speed: Vector3<f64> = (0..3).map(|k| self.v[nodes[k] as usize] * w[k]).sum();
                let long = corners
                    .iter()
                    .map(|c| (c - corners[0]).norm())
                    .fold(0.0, f64::max);
                // What rounding turns the normal by.
                let turn = self.rounding * long / area.norm();
                (area.norm() > 0.0).then(|| {
                    (
                        p - foot,
                        area.normalize(),
                        self.v[node as usize] - speed,
                        turn,
                    )
                })
            })
            .collect();
        let least = feet
            .iter()
            .map(|f| f.0.norm())
            .fold(f64::INFINITY, f64::min);
        let error = self.rounding + 1e-4 * least;
        if least > reach + error {
            return None;
        }
        let facing = |f: &(Vector3<f64>, Vector3<f64>, Vector3<f64>, f64)| {
            if f.0.norm() <= 2e-5 * self.unit + self.rounding {
                1.0
            } else {
                f.0.dot(&f.1).abs() / f.0.norm()
            }
        };
        // Equally near: for certain, and perhaps.
        let near = |part: f64, more: f64| {
            let most = least * (1.0 + part) + more;
            feet.iter().filter(move |f| f.0.norm() <= most)
        };
        // What rounding turns the way to the node by.
        let blur = self.rounding / least.max(1e-5 * self.unit);
        let certain = near(4e-5, -self.rounding).map(|f| facing(f) - f.3);
        let most = certain.fold(0.0, f64::max);
        let mut sure = (seen && least < reach - error).then_some(());
        let (mut gaps, mut decided) = (Vec::new(), Vec::new());
        let perhaps = near(1e-4, 2e-5 * self.unit + self.rounding);
        for f in perhaps.filter(|f| facing(f) + f.3 + blur >= most - 1e-3) {
            let (distance, height) = (f.0.norm(), f.0.dot(&f.1));
            let touching = distance < 2e-5 * self.unit + self.rounding;
            let gap = if touching {
                height
            } else {
                distance * height.signum()
            };
            // Which side a point is on that the triangle's plane holds, rounding decides.
            let sides = match height.abs() < self.rounding + f.3 * distance {
                true => vec![gap.abs(), -gap.abs()],
                false => vec![gap],
            };
            for gap in sides {
                let n = if touching { f.1 } else { f.0 / gap };
                let predicted = gap + f64::from(H) * n.dot(&f.2);
                let doubt = error + f64::from(H) * f.2.norm() * (blur + f.3);
                let over = predicted - self.unit / 64.0;
                gaps.push(gap);
                decided.push((over < 0.0, over.abs() > doubt));
            }
        }
        if decided.iter().any(|d| !d.1 || d.0 != decided[0].0) {
            sure = None;
        }
        let sure = sure.map(|()| decided[0].0);
        Some(Candidate {
            node,
            other,
            gaps,
            error,
            sure,
        })
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_number_of_boxes_finds_the_same_bits(case in case(), few in 0_usize..200) {
        let all = world(&case, true).boxes.len();
        let expected = slots(&case, 0);
        prop_assert_eq!(&slots(&case, all), &expected);
        prop_assert_eq!(&slots(&case, few), &expected);
    }

    #[test]
    fn contacts_are_those_of_every_node_against_every_triangle(case in case()) {
        compare(&case)?;
    }
}

/// Contacts found, and how many of these rounding could not undo.
fn compare(case: &Case) -> Result<[usize; 2], TestCaseError> {
    let mut world = world(case, false);
    let expected = Brute::new(&world).contacts();
    let ranges: Vec<_> = world
        .parts
        .parts
        .iter()
        .map(|part| part.nodes.clone())
        .collect();
    let _ = world.step(&Scene::default(), &settings());
    let found: Vec<(u32, usize, f64)> = world
        .slots
        .iter()
        .filter(|slot| slot.normal() != [0.0; 3])
        .map(|slot| {
            let nodes: Vec<u32> = slot.weights().map(|(node, _)| node).collect();
            let other = ranges.iter().position(|r| r.contains(&(nodes[4] as usize)));
            (nodes[0], other.unwrap(), f64::from(slot.gap()))
        })
        .collect();
    let mut sure = 0;
    for (node, other, gap) in &found {
        let candidate = expected
            .iter()
            .find(|c| c.node == *node && c.other == *other);
        prop_assert!(candidate.is_some(), "node {} of nobody: {}", node, gap);
        let candidate = candidate.unwrap();
        let near = candidate
            .gaps
            .iter()
            .any(|g| (g - gap).abs() < candidate.error);
        prop_assert!(
            near && candidate.sure != Some(false),
            "{} {:?}",
            gap,
            candidate
        );
        sure += usize::from(candidate.sure == Some(true));
    }
    let certain = expected.iter().filter(|c| c.sure == Some(true)).count();
    prop_assert_eq!(certain, sure);
    Ok([found.len(), sure])
}

#[test]
fn most_contacts_are_beyond_doubt() {
    let mut total = [0; 2];
    for seed in 1..40 {
        let mut random = Lcg(seed);
        let mut vector =
            |size: f32| Vec3::from_array([0; 3].map(|_| random.signed() as f32 * size));
        let case = Case {
            cells: [2 + seed as usize % 3, 3],
            at: vector(0.35),
            deformed: Deformed::Shaken(0.02),
            throw: [vector(3.0), vector(3.0), vector(8.0), vector(8.0)],
            seed,
        };
        let counts = compare(&case).unwrap();
        total = [total[0] + counts[0], total[1] + counts[1]];
    }
    assert!(total[0] > 500 && total[1] * 10 > total[0] * 9, "{total:?}");
}

#[test]
fn boxes_are_counted_as_documented() {
    assert_eq!([0, 1, 4, 5, 8, 9, 108].map(boxes), [0, 0, 0, 3, 3, 7, 63]);
    let mesh = cube(0.4, 3, [0.0; 3]);
    let mut parts = Assembly::new();
    parts.soft(&mesh.nodes, &mesh.tets, soft(1e5), 0.3).unwrap();
    assert_eq!(parts.boxes().len(), 63);
}
