//! One step with couplings against a dense solve in f64: A' = A + Σ Wᵀ B W on the motions that rigid bodies have, with
//! the law of contact written down a second time from its description.

use femto::Scene;
use femto::coupling::{Coupling, Link};
use femto::glam::Vec3;
use femto::join::Assembly;
use femto::settings::{Budget, Preconditioner, Settings, Start};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::support::meshes::noise;
use super::support::reference::{Reference, node, stack};
use super::world::{AXES, World, ball, cube, soft};

const YOUNG: f32 = 2e5;
const FRICTION: f64 = 0.4;

/// A coupling in f64.
struct Dense {
    /// 3 × 3n
    w: DMatrix<f64>,
    b: Matrix3<f64>,
    j: Vector3<f64>,
    /// Zero for links.
    n: Vector3<f64>,
}

struct Oracle {
    reference: Reference,
    a: DMatrix<f64>,
    b: DVector<f64>,
    /// First nodes of the rigid bodies.
    rigid: Vec<usize>,
}

impl Oracle {
    fn new(world: &World, h: f64) -> Self {
        let parts = &world.parts;
        let mut reference =
            Reference::new(&parts.nodes, &parts.tets, f64::from(YOUNG), 0.3, 1000.0);
        reference.h = h;
        reference.gravity = [0.0, -9.81, 0.0];
        reference.masses = world
            .body
            .rest()
            .masses
            .iter()
            .map(|m| f64::from(*m))
            .collect();
        let rigid: Vec<usize> = world.rigids.iter().map(|r| r.first() as usize).collect();
        let state = world.body.state().view();
        for (e, volume) in reference.volumes.iter_mut().enumerate() {
            if rigid.contains(&reference.tets[e][0]) || state.is_broken(e) {
                *volume = 0.0;
            }
        }
        reference.x = stack(world.body.positions());
        reference.v = stack(world.body.velocities());
        let q = reference.rotations(&reference.x);
        let (a, mut b) = reference.system(&q);
        // 2μV Q ε_p g, of bodies that flow.
        for (e, tet) in reference.tets.iter().enumerate() {
            let Some(block) = state.plastic.get(e / 8) else {
                break;
            };
            let [xx, xy, xz, yy, yz, zz] = block.0.map(|c| f64::from(c[e % 8]));
            let strain = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
            let size = 2.0 * reference.mu * reference.volumes[e] * h;
            for (&i, g) in tet.iter().zip(&reference.gradients[e]) {
                let mut at = b.fixed_rows_mut::<3>(3 * i);
                at += q[e] * strain * g * size;
            }
        }
        Self {
            reference,
            a,
            b,
            rigid,
        }
    }

    /// Columns: what may move.
    fn motions(&self) -> DMatrix<f64> {
        let n = self.reference.masses.len();
        let soft = n - 4 * self.rigid.len();
        let mut t = DMatrix::zeros(3 * n, 3 * soft + 6 * self.rigid.len());
        for k in 0..3 * soft {
            t[(k, k)] = 1.0;
        }
        for (r, &first) in self.rigid.iter().enumerate() {
            let centre = self.centre(first);
            for k in 0..4 {
                let d = node(&self.reference.x, first + k) - centre;
                for axis in 0..3 {
                    let e = Vector3::ith(axis, 1.0);
                    let at = 3 * (first + k);
                    t.fixed_view_mut::<3, 1>(at, 3 * soft + 6 * r + axis)
                        .copy_from(&e);
                    t.fixed_view_mut::<3, 1>(at, 3 * soft + 6 * r + 3 + axis)
                        .copy_from(&e.cross(&d));
                }
            }
        }
        t
    }

    fn centre(&self, first: usize) -> Vector3<f64> {
        (0..4)
            .map(|k| node(&self.reference.x, first + k))
            .sum::<Vector3<f64>>()
            / 4.0
    }

    /// a_k
    fn own(&self, k: usize) -> f64 {
        self.a.fixed_view::<3, 3>(3 * k, 3 * k).trace() / 3.0
    }

    /// The impulse N of each slot, and the velocities that they leave: four sweeps of projected Gauss–Seidel with A's
    /// diagonal, on the motions there are, from v + D⁻¹ (b − A v).
    fn predict(&self, slots: &[&Coupling]) -> (Vec<f64>, DVector<f64>) {
        let inverse = DVector::from_fn(self.b.len(), |i, _| 1.0 / self.own(i / 3));
        let t = self.motions();
        let projector = &t
            * (t.transpose() * &t)
                .cholesky()
                .unwrap()
                .solve(&t.transpose());
        let v = &self.reference.v;
        let mut field = v + (&self.b - &self.a * v).component_mul(&inverse);
        let mut impulses = vec![0.0; slots.len()];
        for _ in 0..4 {
            for (slot, impulse) in slots.iter().zip(&mut impulses) {
                let n = Vector3::from(slot.normal().map(f64::from));
                let (w, d) = (self.w(slot), f64::from(slot.gap()));
                let depth = if d <= 0.0 { -d / 8.0 } else { -d };
                let missing = depth / self.reference.h - n.dot(&(&w * &field));
                let now = f64::max(0.0, *impulse + missing / self.compliance(slot, n));
                let push = (w.transpose() * n).component_mul(&inverse) * (now - *impulse);
                field += &projector * push;
                *impulse = now;
            }
        }
        (impulses, field)
    }

    /// 1/(the mass that a push along n meets), by moving unit masses: rigid sides in their six motions only.
    fn compliance(&self, slot: &Coupling, n: Vector3<f64>) -> f64 {
        let weights: Vec<(u32, f32)> = slot.weights().collect();
        let mut sum = 0.0;
        for side in weights.chunks(4) {
            let first = side[0].0 as usize;
            if self.rigid.contains(&first) {
                // A force n at the point gives the body these velocities.
                let (mass, centre) = (4.0 * self.reference.masses[first], self.centre(first));
                let mut inertia = Matrix3::zeros();
                let mut arm = Vector3::zeros();
                for &(k, w) in side {
                    let d = node(&self.reference.x, k as usize) - centre;
                    inertia +=
                        (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * (mass / 4.0);
                    arm += d * f64::from(w);
                }
                let turn = arm.cross(&n);
                sum += 1.0 / mass + turn.dot(&(inertia.try_inverse().unwrap() * turn));
            } else {
                for &(k, w) in side {
                    sum += f64::from(w) * f64::from(w) / self.own(k as usize);
                }
            }
        }
        sum
    }

    fn w(&self, slot: &Coupling) -> DMatrix<f64> {
        let mut w = DMatrix::zeros(3, self.b.len());
        for (k, weight) in slot.weights() {
            for axis in 0..3 {
                w[(axis, 3 * k as usize + axis)] += f64::from(weight);
            }
        }
        w
    }

    /// The law of the module's documentation, for those that act.
    fn contacts(&self, slots: &[&Coupling]) -> Vec<Dense> {
        let (impulses, field) = self.predict(slots);
        let each = slots.iter().zip(impulses);
        each.filter_map(|(slot, n)| self.contact(slot, n, &field))
            .collect()
    }

    fn contact(&self, slot: &Coupling, impulse: f64, field: &DVector<f64>) -> Option<Dense> {
        let n = Vector3::from(slot.normal().map(f64::from));
        let (h, d) = (self.reference.h, f64::from(slot.gap()));
        let a = 1.0 / self.compliance(slot, n);
        let matrix = self.w(slot);
        let w = &matrix * field;
        let w = Vector3::new(w[0], w[1], w[2]) - n * (impulse / a);
        let u_all = &matrix * &self.reference.v;
        let u = Vector3::new(u_all[0], u_all[1], u_all[2]);
        let (wn, un) = (w.dot(&n), u.dot(&n));
        let c = 32.0 * a;
        let (normal, push, grip);
        if d <= 0.0 {
            let out = 0.125 * -d / h;
            if wn >= out {
                return None;
            }
            (normal, push) = (c, c * out);
            grip = push + (c * (-un).max(0.0)).min(2.0 * a * (-wn).max(0.0));
        } else {
            if d + h * wn >= 0.0 {
                return None;
            }
            normal = c.min(a * (h * -wn / d - 1.0));
            push = 0.0;
            grip = a * -wn * normal / (a + normal);
        }
        let grip = FRICTION * grip;
        let speed = (u - n * un)
            .norm()
            .max((w - n * wn).norm() - 4.0 * grip / a);
        let tangent = if grip == 0.0 {
            0.0
        } else {
            c.min(grip / speed)
        };
        let nn = n * n.transpose();
        Some(Dense {
            w: matrix,
            b: nn * normal + (Matrix3::identity() - nn) * tangent,
            j: n * push,
            n,
        })
    }

    /// The velocities with which none of the couplings pulls, and which of them act: those that pull at a solution are
    /// left out of the next, and back where they would push.
    fn solve(&self, couplings: &[Dense]) -> (DVector<f64>, Vec<bool>) {
        let mut acts = vec![true; couplings.len()];
        for _ in 0..20 {
            let all = couplings.iter().zip(&acts);
            let v = self.solve_with(all.filter(|(_, acts)| **acts).map(|(c, _)| c));
            let push = couplings
                .iter()
                .map(|c| c.n.dot(&(c.j - c.b * (&c.w * &v))) >= 0.0)
                .collect();
            if acts == push {
                return (v, acts);
            }
            acts = push;
        }
        panic!("the active set does not settle");
    }

    fn solve_with<'a>(&self, couplings: impl Iterator<Item = &'a Dense>) -> DVector<f64> {
        let (mut a, mut b) = (self.a.clone(), self.b.clone());
        for c in couplings {
            a += c.w.transpose() * c.b * &c.w;
            b += c.w.transpose() * c.j;
        }
        let t = self.motions();
        let reduced = t.transpose() * a * &t;
        let q = reduced.cholesky().unwrap().solve(&(t.transpose() * b));
        t * q
    }
}

/// Two cubes that overlap a little, thrown together and shaken, and a ball on one of them.
pub fn crowd(settings: &Settings<'_>) -> World {
    let mut parts = Assembly::new();
    for at in [[0.0, 0.0, 0.0], [0.395, 0.05, 0.07]] {
        let mesh = cube(0.4, 3, at);
        parts
            .soft(&mesh.nodes, &mesh.tets, soft(YOUNG), FRICTION as f32)
            .unwrap();
    }
    parts
        .rigid(
            ball(0.1),
            6.0,
            Vec3::new(0.2, 0.5, 0.21),
            AXES,
            FRICTION as f32,
            &soft(YOUNG),
        )
        .unwrap();
    let mut world = World::new(parts, settings, 128);
    world.throw(&[
        (Vec3::new(0.3, 0.0, 0.1), Vec3::ZERO),
        (Vec3::new(-0.4, 0.1, 0.0), Vec3::new(0.0, 1.0, 0.5)),
        (Vec3::new(0.5, -1.0, 0.0), Vec3::new(1.0, 0.0, 4.0)),
    ]);
    let soft = world.parts.parts[2].nodes.start;
    let (mut x, mut v) = (
        world.body.positions().to_vec(),
        world.body.velocities().to_vec(),
    );
    for (i, (dx, dv)) in noise(soft, 2e-3, 7)
        .iter()
        .zip(noise(soft, 0.1, 8))
        .enumerate()
    {
        for axis in 0..3 {
            x[i][axis] += dx[axis];
            v[i][axis] += dv[axis];
        }
    }
    world.body.place(&x, &v).unwrap();
    world
}

pub fn settings(iterations: u32, preconditioner: Preconditioner<'static>) -> Settings<'static> {
    Settings::new(0.01)
        .unwrap()
        .with_budget(Budget {
            iterations,
            polar_sweeps: 4,
        })
        .with_start(Start::Galerkin(1))
        .with_preconditioner(preconditioner)
}

#[test]
fn a_step_is_the_dense_solution() {
    for preconditioner in [
        Preconditioner::Identity,
        Preconditioner::Mass,
        Preconditioner::Jacobi,
        Preconditioner::BlockJacobi,
    ] {
        let settings = settings(600, preconditioner);
        let mut world = crowd(&settings);
        world.links = links();
        let released = is_the_dense_solution(&mut world, &settings, 15);
        assert!(released > 0);
    }
}

pub fn links() -> Vec<Link> {
    let target = Vec3::new(-0.1, 0.2, 0.3);
    vec![
        Link::nodes(0, 70).soft(3e3, 20.0),
        Link::to_target([(3, 1.0)], target, Vec3::X).soft(500.0, 5.0),
    ]
}

/// Takes a step of a [`crowd`] with both of these links, and compares it. Returns how many contacts the prediction took in that
/// would have pulled.
pub fn is_the_dense_solution(world: &mut World, settings: &Settings<'_>, least: usize) -> usize {
    let oracle = Oracle::new(world, 0.01);
    let gravity = Vec3::new(0.0, -9.81, 0.0);
    let report = world.step(
        &Scene {
            gravity,
            ..Scene::default()
        },
        settings,
    );
    assert!(report.advanced() && report.dropped == 0, "{report:?}");

    let (links, contacts) = world.slots.split_at(2);
    let found = contacts.iter().filter(|slot| slot.normal() != [0.0; 3]);
    let mut dense = oracle.contacts(&found.collect::<Vec<_>>());
    let decided = dense.len();
    for (slot, (k, c, target, s)) in links.iter().zip([
        (3e3, 20.0, Vector3::zeros(), Vector3::zeros()),
        (
            500.0,
            5.0,
            Vector3::new(-0.1, 0.2, 0.3),
            Vector3::new(1.0, 0.0, 0.0),
        ),
    ]) {
        // −h k (e + h (u⁺ − s)) − h c (u⁺ − s)
        let w = oracle.w(slot);
        let apart = &w * &oracle.reference.x;
        let apart = Vector3::new(apart[0], apart[1], apart[2]) - target;
        let b = 0.01 * 0.01 * k + 0.01 * c;
        dense.push(Dense {
            w,
            b: Matrix3::identity() * b,
            j: s * b - apart * (0.01 * k),
            n: Vector3::zeros(),
        });
    }
    let (expected, acts) = oracle.solve(&dense);
    let acting = acts[..decided].iter().filter(|acts| **acts).count();
    let active = contacts.iter().filter(|slot| slot.is_active()).count();
    assert_eq!(acting, active);
    assert!(decided > least && active > 0, "{active} of {decided}");
    let found = stack(world.body.velocities());
    // Residuals end below 2⁻²² of the right-hand side, and the error is at most the root of the condition number (some
    // 10³ with couplings of 32 a) times that, relative to the largest speed in the A-norm; forces of f32 positions
    // (0.6 m at E = 2e5) are rounded at ε h E x Δx, or 2e-5 of a node's momentum here.
    let size = expected.amax();
    let soft = world.parts.parts[2].nodes.start;
    for i in 0..soft {
        let error = (node(&found, i) - node(&expected, i)).norm() / size;
        assert!(
            error < 2e-4,
            "{:?} node {i}: {error:e}",
            settings.preconditioner
        );
    }
    // The ball has the velocity and the spin of the solution, on its turned shape.
    let rows = |v: &DVector<f64>| -> Vector3<f64> {
        (0..4).map(|k| node(v, soft + k)).sum::<Vector3<f64>>() / 4.0
    };
    assert!((rows(&found) - rows(&expected)).norm() < 2e-4 * size);
    let spin = |x: &DVector<f64>, v: &DVector<f64>| -> Vector3<f64> {
        let c = (0..4).map(|k| node(x, soft + k)).sum::<Vector3<f64>>() / 4.0;
        (0..4)
            .map(|k| (node(x, soft + k) - c).cross(&node(v, soft + k)))
            .sum()
    };
    let (after, before) = (stack(world.body.positions()), &oracle.reference.x);
    let (l, expected_l) = (spin(&after, &found), spin(before, &expected));
    assert!(
        (l - expected_l).norm() < 2e-4 * 0.1 * size,
        "{l} {expected_l}"
    );
    decided - acting
}

#[test]
fn weights_are_exact_for_rigid_motions() {
    let settings = settings(1, Preconditioner::Jacobi);
    let mut world = crowd(&settings);
    let x = stack(world.body.positions());
    assert!(world.step(&Scene::default(), &settings).advanced());
    for slot in world.slots.iter().filter(|slot| slot.normal() != [0.0; 3]) {
        let n = Vector3::from(slot.normal().map(f64::from));
        let (mut sum, mut apart) = (0.0, Vector3::zeros());
        for (k, w) in slot.weights() {
            sum += f64::from(w);
            apart += node(&x, k as usize) * f64::from(w);
        }
        // Coordinates up to 0.8, weights up to 1: eight products, each rounded by ε/2.
        let rounding = 8.0 * f64::from(f32::EPSILON);
        assert!(sum.abs() < rounding, "{sum:e}");
        // The points are the gap apart, along the normal: impulses have no couple.
        assert!(
            (apart - n * f64::from(slot.gap())).norm() < rounding,
            "{apart} {}",
            slot.gap()
        );
        assert!((n.norm() - 1.0).abs() < 1e-6);
    }
}
