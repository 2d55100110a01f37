//! Exports: bodies and their snapshots.

use alloc::boxed::Box;
use alloc::rc::Rc;
use alloc::vec::Vec;

use femto::glam::Vec3;
use femto::{Collider, Pin};

use crate::body::{Body, Choice};
use crate::fault::{Fault, fault};
use crate::world::{Chunk, Kept, address, call, with};

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
    call(&mut |world| {
        let body = Body::new(world.asset(asset)?);
        world.keep(Kept::Body(Box::new(body)))
    })
}

/// A further handle of the asset that a body uses.
#[unsafe(no_mangle)]
extern "C" fn body_asset(body: u32) -> u32 {
    call(&mut |world| {
        let asset = world.body(body)?.loaded().clone();
        world.keep(Kept::Asset(asset))
    })
}

/// What is done with a body and the input.
type OnBody<'a> = dyn FnMut(&mut Body, &[Chunk]) -> Result<(), Fault> + 'a;

/// Does something with a body; 1, or 0 and a reason.
fn on_body(handle: u32, what: &mut OnBody<'_>) -> u32 {
    call(&mut |world| {
        let input = world.take_input();
        what(world.body(handle)?, &input).map(|()| 1)
    })
}

/// Goes on with another asset of the same mesh.
#[unsafe(no_mangle)]
extern "C" fn body_use(body: u32, asset: u32) -> u32 {
    call(&mut |world| {
        let asset = world.asset(asset)?;
        world.body(body)?.use_asset(asset).map(|()| 1)
    })
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
    on_body(body, &mut |body, _| {
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
    on_body(body, &mut |body, _| {
        let gravity = Vec3::new(x, y, z);
        if !gravity.is_finite() {
            return Err(fault!("gravity must be finite"));
        }
        body.gravity = gravity;
        Ok(())
    })
}

/// Pins: the input is `count` times a node as u32 and a velocity as 3 f32.
#[unsafe(no_mangle)]
extern "C" fn body_pins(body: u32, count: usize) -> u32 {
    on_body(body, &mut |body, input| {
        let pins: &[Pin] = bytemuck::cast_slice(input);
        let pins = pins.get(..count).ok_or(fault!("more pins than input"))?;
        let nodes = body.asset().rest.nodes.len();
        for pin in pins {
            if pin.node as usize >= nodes {
                return Err(fault!(
                    "a pin names node {0}, the body has {1}",
                    pin.node,
                    nodes
                ));
            }
            if !pin.velocity.is_finite() {
                return Err(fault!(
                    "the velocity of the pin at node {0} must be finite",
                    pin.node,
                    0.0
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
    on_body(body, &mut |body, input| {
        let rows = floats(input).as_chunks().0.get(..count);
        let mut colliders = Vec::with_capacity(count.min(64));
        for &[kind, x, y, z, size, friction, vx, vy, vz] in
            rows.ok_or(fault!("more colliders than input"))?
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
extern "C" fn body_forces(body: u32) -> u32 {
    call(&mut |world| {
        let body = world.body(body)?;
        let nodes = body.asset().rest.nodes.len();
        body.forces.resize(nodes, [0.0; 3]);
        Ok(address(body.forces.as_ptr()))
    })
}

/// No forces.
#[unsafe(no_mangle)]
extern "C" fn body_no_forces(body: u32) -> u32 {
    on_body(body, &mut |body, _| {
        body.forces = Vec::new();
        Ok(())
    })
}

/// Places a body: the input is `nodes` positions, then as many velocities.
#[unsafe(no_mangle)]
extern "C" fn body_place(body: u32, nodes: usize) -> u32 {
    on_body(body, &mut |body, input| {
        let numbers = floats(input);
        let (x, v) = nodes
            .checked_mul(3)
            .and_then(|n| numbers.split_at_checked(n))
            .and_then(|(x, v)| Some((vectors(x, nodes)?, vectors(v, nodes)?)))
            .ok_or(fault!("fewer numbers than nodes need"))?;
        body.place(x, v)
    })
}

/// Advances a body by up to `count` steps, fewer where one is refused. Returns how many were taken; the numbers are ‖b‖,
/// ‖b − Av‖ before and after, updates, contacts of the last.
#[unsafe(no_mangle)]
extern "C" fn body_step(body: u32, count: u32) -> u32 {
    call(&mut |world| {
        world.fault = Fault::NONE;
        for taken in 0..count {
            let step = world.body(body)?.step();
            let report = match step {
                Ok(report) => report,
                Err(why) => {
                    world.fault = why;
                    return Ok(taken);
                }
            };
            if let Some(refusal) = report.refusal {
                world.fault = refusal.into();
                return Ok(taken);
            }
            world.numbers([
                report.rhs.into(),
                report.residual_before.into(),
                report.residual_after.into(),
                report.updates.into(),
                report.contacts.into(),
            ]);
        }
        Ok(count)
    })
}

/// Where the positions are, 3 f32 a node in metres.
#[unsafe(no_mangle)]
extern "C" fn body_positions(body: u32) -> u32 {
    call(&mut |world| Ok(address(world.body(body)?.state().x.as_ptr())))
}

/// Where the velocities are, 3 f32 a node in m/s.
#[unsafe(no_mangle)]
extern "C" fn body_velocities(body: u32) -> u32 {
    call(&mut |world| Ok(address(world.body(body)?.state().v.as_ptr())))
}

/// The state hash; 0 where there is no such body.
#[unsafe(no_mangle)]
extern "C" fn body_hash(body: u32) -> u64 {
    with(|world| world.body(body).map_or(0, |body| body.hash()))
}

/// Numbers: kinetic, elastic, potential energy; linear and angular momentum; the smallest det F.
#[cfg(feature = "measures")]
#[unsafe(no_mangle)]
extern "C" fn body_measure(body: u32) -> u32 {
    call(&mut |world| {
        let measured = world.body(body)?.measure();
        world.numbers(measured);
        Ok(1)
    })
}

/// Keeps a copy of the state.
#[unsafe(no_mangle)]
extern "C" fn body_save(body: u32) -> u32 {
    call(&mut |world| {
        let saved = world.body(body)?.save();
        world.keep(Kept::Snapshot(Rc::new(saved)))
    })
}

/// Takes a kept state back.
#[unsafe(no_mangle)]
extern "C" fn body_restore(body: u32, snapshot: u32) -> u32 {
    call(&mut |world| {
        let saved = world.snapshot(snapshot)?;
        world.body(body)?.restore(&saved).map(|()| 1)
    })
}
