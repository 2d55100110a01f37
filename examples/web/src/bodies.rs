//! Exports: bodies and their snapshots.

use alloc::vec::Vec;

use femto::glam::Vec3;
use femto::{Collider, Pin};

use crate::assets::keep_asset;
use crate::body::{Body, Choice};
use crate::fault::Fault;
use crate::world::{Chunk, with};
use crate::{GONE, answer, refuse};

/// The input as numbers: as many as fit in what was asked for.
fn floats(chunks: &[Chunk]) -> &[f32] {
    bytemuck::cast_slice(chunks)
}

pub fn vectors(numbers: &[f32], count: usize) -> Option<&[[f32; 3]]> {
    numbers.as_chunks().0.get(..count)
}

/// A body at rest in its rest shape, with the asset's pins and settings.
#[unsafe(no_mangle)]
extern "C" fn body_new(asset: u32) -> u32 {
    with(|world| match world.assets.get(asset) {
        Some(asset) => {
            let body = Body::new(asset.clone());
            let kept = world.bodies.keep(body).ok_or("too many bodies");
            answer(world, kept)
        }
        None => refuse(world, GONE),
    })
}

/// A further handle of the asset that a body uses.
#[unsafe(no_mangle)]
extern "C" fn body_asset(body: u32) -> u32 {
    with(|world| {
        let asset = match world.bodies.get(body) {
            Some(body) => Ok(body.loaded().clone()),
            None => Err(GONE.into()),
        };
        keep_asset(world, asset)
    })
}

/// Forgets a body.
#[unsafe(no_mangle)]
extern "C" fn body_free(body: u32) -> u32 {
    with(|world| u32::from(world.bodies.free(body)))
}

/// Does something with a body; 1, or 0 and a reason.
fn on_body(handle: u32, call: impl FnOnce(&mut Body, &[Chunk]) -> Result<(), Fault>) -> u32 {
    with(|world| {
        let input = world.take_input();
        let result = match world.bodies.get(handle) {
            Some(body) => call(body, &input).map(|()| 1),
            None => Err(GONE.into()),
        };
        answer(world, result)
    })
}

/// Goes on with another asset of the same mesh.
#[unsafe(no_mangle)]
extern "C" fn body_use(body: u32, asset: u32) -> u32 {
    let asset = with(|world| world.assets.get(asset).cloned());
    on_body(body, |body, _| body.use_asset(asset.ok_or(GONE)?))
}

/// Settings; start and preconditioner as [`Choice`] has them.
#[unsafe(no_mangle)]
extern "C" fn body_settings(
    body: u32,
    dt: f32,
    theta: f32,
    iterations: u32,
    sweeps: u32,
    start: u32,
    preconditioner: u32,
) -> u32 {
    on_body(body, |body, _| {
        body.set(Choice::new(
            dt,
            theta,
            [iterations, sweeps, start, preconditioner],
        )?)
    })
}

/// Gravity in m/s².
#[unsafe(no_mangle)]
extern "C" fn body_gravity(body: u32, x: f32, y: f32, z: f32) -> u32 {
    on_body(body, |body, _| {
        let gravity = Vec3::new(x, y, z);
        if !gravity.is_finite() {
            return Err("gravity must be finite".into());
        }
        body.gravity = gravity;
        Ok(())
    })
}

/// Pins: the input is `count` times a node as u32 and a velocity as 3 f32.
#[unsafe(no_mangle)]
extern "C" fn body_pins(body: u32, count: usize) -> u32 {
    on_body(body, |body, input| {
        let pins: &[Pin] = bytemuck::cast_slice(input);
        let pins = pins.get(..count).ok_or("more pins than input")?;
        let nodes = body.asset().rest.nodes.len();
        for pin in pins {
            if pin.node as usize >= nodes {
                return Err(Fault::of(
                    "a pin names node {0}, the body has {1}",
                    [pin.node.into(), nodes as f64],
                ));
            }
            if !pin.velocity.is_finite() {
                return Err(Fault::of(
                    "the velocity of the pin at node {0} must be finite",
                    [pin.node.into(), 0.0],
                ));
            }
        }
        body.pins.clear();
        body.pins.extend_from_slice(pins);
        Ok(())
    })
}

/// Colliders: the input is `count` rows of nine f32: 0 for a half-space with normal and offset, or 1 for a
/// sphere with centre and radius; friction; velocity.
#[unsafe(no_mangle)]
extern "C" fn body_colliders(body: u32, count: usize) -> u32 {
    on_body(body, |body, input| {
        let rows = floats(input).as_chunks().0.get(..count);
        let mut colliders = Vec::with_capacity(count.min(64));
        for &[kind, x, y, z, size, friction, vx, vy, vz] in
            rows.ok_or("more colliders than input")?
        {
            let (at, velocity) = (Vec3::new(x, y, z), Vec3::new(vx, vy, vz));
            let shape = if kind == 0.0 {
                Collider::half_space(at, size)
            } else {
                Collider::sphere(at, size)
            };
            let collider = shape
                .and_then(|collider| collider.with_friction(friction))
                .and_then(|collider| collider.with_velocity(velocity));
            colliders.push(collider?);
        }
        body.colliders = colliders;
        Ok(())
    })
}

/// Where the body's forces on its nodes are to be written, 3 f32 a node in newtons; zeros at first.
#[unsafe(no_mangle)]
extern "C" fn body_forces(body: u32) -> *mut [f32; 3] {
    with(|world| {
        let Some(body) = world.bodies.get(body) else {
            refuse(world, GONE);
            return core::ptr::null_mut();
        };
        let nodes = body.asset().rest.nodes.len();
        body.forces.resize(nodes, [0.0; 3]);
        body.forces.as_mut_ptr()
    })
}

/// No forces.
#[unsafe(no_mangle)]
extern "C" fn body_no_forces(body: u32) -> u32 {
    on_body(body, |body, _| {
        body.forces = Vec::new();
        Ok(())
    })
}

/// Places a body: the input is `nodes` positions, then as many velocities.
#[unsafe(no_mangle)]
extern "C" fn body_place(body: u32, nodes: usize) -> u32 {
    on_body(body, |body, input| {
        let numbers = floats(input);
        let (x, v) = nodes
            .checked_mul(3)
            .and_then(|n| numbers.split_at_checked(n))
            .and_then(|(x, v)| Some((vectors(x, nodes)?, vectors(v, nodes)?)))
            .ok_or("fewer numbers than nodes need")?;
        body.place(x, v)
    })
}

/// Advances a body by up to `count` steps, fewer where one is refused. Returns how many were taken; the numbers are ‖b‖,
/// ‖b − Av‖ before and after, updates, contacts of the last.
#[unsafe(no_mangle)]
extern "C" fn body_step(body: u32, count: u32) -> u32 {
    with(|world| {
        world.fault = Fault::new("");
        let Some(body) = world.bodies.get(body) else {
            return refuse(world, GONE);
        };
        for taken in 0..count {
            let why = match body.step() {
                Ok(report) => {
                    let Some(refusal) = report.refusal else {
                        let numbers = [
                            report.rhs.into(),
                            report.residual_before.into(),
                            report.residual_after.into(),
                            report.updates.into(),
                            report.contacts.into(),
                        ];
                        for (to, from) in world.numbers.iter_mut().zip(numbers) {
                            *to = from;
                        }
                        continue;
                    };
                    refusal.into()
                }
                Err(why) => why,
            };
            world.fault = why;
            return taken;
        }
        count
    })
}

/// Where the positions are, 3 f32 a node in metres.
#[unsafe(no_mangle)]
extern "C" fn body_positions(body: u32) -> *const [f32; 3] {
    state_of(body, |body| body.state().x.as_ptr())
}

/// Where the velocities are, 3 f32 a node in m/s.
#[unsafe(no_mangle)]
extern "C" fn body_velocities(body: u32) -> *const [f32; 3] {
    state_of(body, |body| body.state().v.as_ptr())
}

fn state_of(body: u32, pointer: impl FnOnce(&Body) -> *const [f32; 3]) -> *const [f32; 3] {
    with(|world| match world.bodies.get(body) {
        Some(body) => pointer(body),
        None => {
            refuse(world, GONE);
            core::ptr::null()
        }
    })
}

/// The state hash; 0 where there is no such body.
#[unsafe(no_mangle)]
extern "C" fn body_hash(body: u32) -> u64 {
    with(|world| match world.bodies.get(body) {
        Some(body) => body.hash(),
        None => {
            refuse(world, GONE);
            0
        }
    })
}

/// Numbers: kinetic, elastic, potential energy; linear and angular momentum; the smallest det F.
#[cfg(feature = "measures")]
#[unsafe(no_mangle)]
extern "C" fn body_measure(body: u32) -> u32 {
    with(|world| {
        let Some(body) = world.bodies.get(body) else {
            return refuse(world, GONE);
        };
        let measured = body.measure();
        for (to, from) in world.numbers.iter_mut().zip(measured) {
            *to = from;
        }
        1
    })
}

/// Keeps a copy of the state.
#[unsafe(no_mangle)]
extern "C" fn body_save(body: u32) -> u32 {
    with(
        |world| match world.bodies.get(body).map(|body| body.save()) {
            Some(saved) => {
                let kept = world.snapshots.keep(saved).ok_or("too many snapshots");
                answer(world, kept)
            }
            None => refuse(world, GONE),
        },
    )
}

/// Takes a kept state back.
#[unsafe(no_mangle)]
extern "C" fn body_restore(body: u32, snapshot: u32) -> u32 {
    with(|world| {
        let result = match (world.bodies.get(body), world.snapshots.get(snapshot)) {
            (Some(body), Some(saved)) => body.restore(saved).map(|()| 1),
            _ => Err(GONE.into()),
        };
        answer(world, result)
    })
}

/// Forgets a kept state.
#[unsafe(no_mangle)]
extern "C" fn snapshot_free(snapshot: u32) -> u32 {
    with(|world| u32::from(world.snapshots.free(snapshot)))
}
