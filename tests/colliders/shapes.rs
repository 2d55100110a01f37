//! Distances, normals, ways out and velocities of single points.

use femto::Frame;
use femto::collider::{
    Capsule, Collider, ColliderError, Cuboid, HeightField, Near, Placed, SignedDistance,
};
use femto::frame::FrameError;
use femto::glam::{Mat3, Vec3};
use proptest::prelude::*;

use crate::oracle::{Ground, Motion, V, capsule, cuboid, gradient, v};

/// Roundings of coordinates of at most a few metres that a distance, or a unit vector, may be off by.
const ROUNDINGS: f64 = 32.0 * f32::EPSILON as f64;

fn vector(size: f32) -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-size..size).prop_map(Vec3::from_array)
}

/// What holds of every shape at every point, for a distance `d` in f64.
fn check(near: Near, x: Vec3, d: impl Fn(V) -> f64) -> Result<(), TestCaseError> {
    let exact = d(v(x));
    let found = f64::from(near.distance);
    prop_assert!(
        (found - exact).abs() < 4.0 * ROUNDINGS,
        "{found} for {exact}"
    );
    let n = v(near.normal);
    prop_assert!((n.norm() - 1.0).abs() < ROUNDINGS, "|n| = {}", n.norm());
    if let Some(g) = gradient(&d, v(x)) {
        // A direction is a difference of coordinates over its length.
        let bound = 1e-5 + 4.0 * ROUNDINGS / (exact.abs() + 1e-3);
        prop_assert!((g - n).norm() < bound, "{n} for {g}");
    }
    Ok(())
}

proptest! {
    #[test]
    fn capsules(from in vector(1.0), to in vector(1.0), radius in 0.05_f32..1.0, x in vector(2.0), is_ball in any::<bool>()) {
        let to = if is_ball { from } else { to };
        let near = Capsule::new(from, to, radius).unwrap().near(x, 0.0);
        // The normal of a distance to a line is as good as the distance is long.
        prop_assume!((near.distance + radius).abs() > 0.02);
        check(near, x, |x| capsule(x, v(from), v(to), radius.into()))?;
        prop_assert_eq!(near.way_out, near.normal);
    }

    #[test]
    fn cuboids(centre in vector(1.0), half in prop::array::uniform3(0.1_f32..1.0), x in vector(2.5)) {
        let half = Vec3::from_array(half);
        let near = Cuboid::new(centre, half).unwrap().near(x, 0.0);
        let d = |x: V| cuboid(x, v(centre), v(half));
        check(near, x, d)?;
        // One way out leads there at once, also from inside.
        let out = x - near.way_out * near.distance;
        prop_assert!(d(v(out)).abs() < 4.0 * ROUNDINGS);
    }

    #[test]
    fn height_fields(
        heights in prop::collection::vec(-0.5_f32..0.5, 12),
        spacing in prop::array::uniform2(0.25_f32..1.0),
        at in prop::array::uniform2(0.01_f32..0.99),
        y in -1.0_f32..1.0,
    ) {
        let ground = Ground { heights: heights.clone(), samples: [4, 3], spacing: spacing.map(f64::from) };
        let field = HeightField::new(&heights, [4, 3], spacing).unwrap();
        let x = Vec3::new(at[0] * 3.0 * spacing[0], y, at[1] * 2.0 * spacing[1]);
        let near = field.near(x, 0.0);
        let (exact, normal) = ground.distance(v(x));
        // Near the border of two triangles rounding decides which.
        let shifted = |dx: f64, dz: f64| ground.distance(v(x) + V::new(dx, 0.0, dz)).1;
        prop_assume!([(1e-5, 0.0), (-1e-5, 0.0), (0.0, 1e-5), (0.0, -1e-5)]
            .iter().all(|&(dx, dz)| (shifted(dx, dz) - normal).norm() < 1e-9));
        prop_assert!((f64::from(near.distance) - exact).abs() < 4.0 * ROUNDINGS);
        prop_assert!((v(near.normal) - normal).norm() < ROUNDINGS);
        check(near, x, |x| ground.distance(x).0)?;
        // Straight up, and onto the surface whatever lies beside.
        let out = x - near.way_out * near.distance;
        prop_assert!(ground.above(v(out)).abs() < 8.0 * ROUNDINGS, "{}", ground.above(v(out)));
        prop_assert_eq!((out.x, out.z), (x.x, x.z));
    }

    /// Beyond its border a field goes on level.
    #[test]
    fn height_fields_have_no_end(heights in prop::collection::vec(-0.5_f32..0.5, 9), x in vector(50.0)) {
        let field = HeightField::new(&heights, [3, 3], [0.5; 2]).unwrap();
        let inside = Vec3::new(x.x.clamp(0.0, 1.0), x.y, x.z.clamp(0.0, 1.0));
        let (near, at_border) = (field.near(x, 0.0), field.near(inside, 0.0));
        let above = |near: Near| near.distance * near.way_out.y;
        prop_assert!((above(near) - above(at_border)).abs() < 2e-5);
        if x.x < 0.0 || x.x > 1.0 { prop_assert_eq!(near.normal.x, 0.0); }
        if x.z < 0.0 || x.z > 1.0 { prop_assert_eq!(near.normal.z, 0.0); }
    }

    /// A frame carries a shape as a rigid body moves, up to 2 rad a step.
    #[test]
    fn placed_shapes(
        origin in vector(1.0), axis in vector(1.0), turn in 0.0_f32..3.0, half in prop::array::uniform3(0.1_f32..1.0),
        velocity in vector(2.0), spin in vector(1.0), rate in 0.0_f32..20.0, later in 0.0_f32..0.1, x in vector(2.0),
    ) {
        prop_assume!(axis.length() > 0.1 && spin.length() > 0.1);
        let (spin, rotation) = (spin.normalize() * rate, Mat3::from_axis_angle(axis.normalize(), turn));
        let frame = Frame::new(origin, rotation).unwrap().with_velocity(velocity).unwrap().with_spin(spin).unwrap();
        let half = Vec3::from_array(half);
        let mut placed = Placed::new(Cuboid::new(Vec3::ZERO, half).unwrap(), frame);
        let near = placed.near(x, later);
        let r = frame.rotation();
        let motion = Motion {
            origin: v(origin),
            rotation: nalgebra::Matrix3::from_columns(&[v(r.x_axis), v(r.y_axis), v(r.z_axis)]),
            velocity: v(velocity),
            spin: v(spin),
        };
        let t = f64::from(later);
        check(near, x, |x| cuboid(motion.to_local(x, t), V::zeros(), v(half)))?;
        let speed = v(near.velocity);
        let exact = motion.velocity_at(v(x), t);
        prop_assert!((speed - exact).norm() < 1e-7 + 64.0 * ROUNDINGS, "{speed} for {exact}");
        prop_assert_eq!(placed.moves(), true);
        // Advanced, it is where it said it would be.
        placed.advance(later);
        let now = placed.near(x, 0.0);
        prop_assert!((now.distance - near.distance).abs() < ROUNDINGS as f32);
        prop_assert!((now.velocity - near.velocity).length() < 16.0 * ROUNDINGS as f32);
    }

    /// Any step, any number of steps: a rotation, about the axis, by the rate times the time.
    #[test]
    fn frames_turn_exactly(spin in vector(1.0), rate in 0.01_f32..1e4, dt in 1e-4_f32..1e-2, steps in 1_usize..2000) {
        prop_assume!(spin.length() > 0.1);
        let spin = spin.normalize() * rate;
        let mut frame = Frame::WORLD.with_spin(spin).unwrap();
        for _ in 0..steps {
            frame.advance(dt);
        }
        let r = frame.rotation();
        let off = [r.x_axis.dot(r.x_axis) - 1.0, r.y_axis.dot(r.y_axis) - 1.0, r.x_axis.dot(r.y_axis), r.determinant() - 1.0];
        prop_assert!(off.iter().all(|c| c.abs() < 8.0 * f32::EPSILON), "{off:?}");
        // Some roundings a step.
        let rounded = steps as f32 * 4.0 * f32::EPSILON;
        prop_assert!((r * spin - spin).length() < rounded * rate);
        let angle = f64::from(spin.length()) * f64::from(dt);
        if angle < 2.0 {
            let exact = nalgebra::Rotation3::from_scaled_axis(v(spin).normalize() * (angle * steps as f64));
            let x = exact * V::x();
            let bound = steps as f64 * 1e-6 + f64::from(rounded);
            prop_assert!((v(r.x_axis) - x).norm() < bound, "{} of {bound}", (v(r.x_axis) - x).norm());
        }
    }

    /// Pins that a frame carries are where the frame is, after any number of steps.
    #[test]
    fn frames_carry_pins(origin in vector(1.0), spin in vector(5.0), velocity in vector(1.0), x in vector(1.0)) {
        let mut frame = Frame::new(origin, Mat3::IDENTITY).unwrap()
            .with_velocity(velocity).unwrap().with_spin(spin).unwrap();
        let motion = Motion { origin: v(origin), rotation: nalgebra::Matrix3::identity(), velocity: v(velocity), spin: v(spin) };
        let mut at = [[9.0; 3], x.to_array()];
        let mut pins = [femto::Pin::held(1)];
        let mut local = [[0.0; 3]];
        frame.hold(&pins, &at, &mut local);
        for step in 1..=200 {
            frame.carry(&local, &at, 0.01, &mut pins);
            at[1] = core::array::from_fn(|a| at[1][a] + 0.01 * pins[0].velocity[a]);
            frame.advance(0.01);
            let exact = motion.to_world(motion.to_local(v(x), 0.0), 0.01_f32 as f64 * f64::from(step));
            let off = (v(Vec3::from_array(at[1])) - exact).norm();
            prop_assert!(off < f64::from(step) * ROUNDINGS, "step {step}: {off}");
        }
    }
}

/// Points that have no direction of their own get one.
#[test]
fn middles_have_normals() {
    for (from, to) in [
        (Vec3::ZERO, Vec3::X),
        (Vec3::ZERO, Vec3::Y),
        (Vec3::NEG_Z, Vec3::Z),
        (Vec3::ONE, Vec3::ONE),
        (Vec3::ZERO, Vec3::splat(1e-25)),
    ] {
        let near = Capsule::new(from, to, 0.5)
            .unwrap()
            .near((from + to) / 2.0, 0.0);
        assert_eq!(near.distance, -0.5);
        assert!((near.normal.length() - 1.0).abs() < 1e-6, "{from} {to}");
        assert!(near.normal.dot(to - from).abs() < 1e-6, "{from} {to}");
    }
    for half in [
        Vec3::ONE,
        Vec3::new(2.0, 1.0, 1.0),
        Vec3::new(3.0, 3.0, 1.0),
    ] {
        let near = Cuboid::new(Vec3::ZERO, half).unwrap().near(Vec3::ZERO, 0.0);
        assert_eq!(near.distance, -1.0);
        assert_eq!(near.normal.dot(half), 1.0);
    }
}

#[test]
fn errors_name_what_is_wrong() {
    for place in [Vec3::NAN, Vec3::INFINITY, Vec3::splat(1e30)] {
        assert_eq!(
            Capsule::new(Vec3::ZERO, place, 1.0),
            Err(ColliderError::Place)
        );
    }
    assert_eq!(
        Capsule::new(Vec3::NAN, Vec3::ZERO, 1.0),
        Err(ColliderError::Place)
    );
    for radius in [0.0, -1.0, f32::NAN, 1e20] {
        assert_eq!(
            Capsule::new(Vec3::ZERO, Vec3::X, radius),
            Err(ColliderError::Radius)
        );
    }
    assert_eq!(Cuboid::new(Vec3::NAN, Vec3::ONE), Err(ColliderError::Place));
    for half in [
        Vec3::ZERO,
        Vec3::new(1.0, -1.0, 1.0),
        Vec3::NAN,
        Vec3::splat(1e20),
    ] {
        assert_eq!(
            Cuboid::new(Vec3::ZERO, half),
            Err(ColliderError::Size),
            "{half}"
        );
    }
    let flat = [0.0; 6];
    for (samples, spacing) in [
        ([1, 6], [1.0; 2]),
        ([2, 2], [1.0; 2]),
        ([u32::MAX, u32::MAX], [1.0; 2]),
        ([2, 3], [0.0, 1.0]),
        ([2, 3], [1.0, -1.0]),
        ([2, 3], [f32::NAN, 1.0]),
        ([2, 3], [1e-45, 1.0]),
    ] {
        let field = HeightField::new(&flat, samples, spacing);
        assert_eq!(field, Err(ColliderError::Grid), "{samples:?} {spacing:?}");
    }
    for (bad, at) in [(f32::NAN, 4), (f32::INFINITY, 4), (1e30, 1)] {
        let mut heights = flat;
        heights[4] = bad;
        let field = HeightField::new(&heights, [2, 3], [1.0; 2]);
        assert_eq!(field, Err(ColliderError::Height { index: at }));
    }
    assert!(ColliderError::Height { index: 4 }.to_string().contains('4'));
    let cuboid = Cuboid::new(Vec3::ZERO, Vec3::ONE).unwrap();
    let collider = Collider::shape(&cuboid);
    assert_eq!(
        collider.with_velocity(Vec3::X),
        Err(ColliderError::Borrowed)
    );
    assert_eq!(collider.with_friction(-1.0), Err(ColliderError::Friction));

    assert_eq!(
        Frame::new(Vec3::NAN, Mat3::IDENTITY),
        Err(FrameError::Origin)
    );
    for no_rotation in [
        Mat3::ZERO,
        Mat3::from_diagonal(Vec3::new(1.0, 1.0, -1.0)),
        Mat3::IDENTITY * 1.01,
        Mat3::NAN,
    ] {
        assert_eq!(
            Frame::new(Vec3::ZERO, no_rotation),
            Err(FrameError::Rotation)
        );
    }
    assert_eq!(
        Frame::WORLD.with_velocity(Vec3::NAN),
        Err(FrameError::Velocity)
    );
    for spin in [Vec3::NAN, Vec3::splat(1e20)] {
        assert_eq!(Frame::WORLD.with_spin(spin), Err(FrameError::Spin));
    }
}
