//! femto as a WASM module: C-style exports over handles, no imports.
//!
//! Numbers go in as arguments, arrays through `input`: room that JavaScript fills before the call which reads
//! it. Calls that can be refused return 0 (or handle 0) then, and `message` says why. Positions, velocities and forces
//! are read and written in place, where `positions` and the like say; memory may grow or move with any call that
//! makes, sets or frees something, and stays where it is during `step`.
//!
//! All `unsafe` of the web is in this package: names of exports, and the one static ([`world`]).
#![no_std]

extern crate alloc;

use alloc::vec::Vec;

use femto::asset::AssetBytes;
use femto::glam::Vec3;
use femto::{Collider, Pin};

use body::{Body, Choice};
use fault::Fault;
use world::{Chunk, World, with};

mod body;
mod fault;
mod loaded;
mod table;
mod world;

#[global_allocator]
static ALLOCATOR: dlmalloc::GlobalDlmalloc = dlmalloc::GlobalDlmalloc;

/// Nothing here should panic; memory that is used up ends here.
#[cfg(target_family = "wasm")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}

const GONE: &str = "the handle was freed, or is of something else";

fn refuse(world: &mut World, why: impl Into<Fault>) -> u32 {
    world.fault = why.into();
    0
}

fn answer<E: Into<Fault>>(world: &mut World, result: Result<u32, E>) -> u32 {
    result.unwrap_or_else(|why| refuse(world, why))
}

/// The input as numbers: as many as fit in what was asked for.
fn floats(chunks: &[Chunk]) -> &[f32] {
    bytemuck::cast_slice(chunks)
}

fn vectors(numbers: &[f32], count: usize) -> Option<&[[f32; 3]]> {
    numbers.as_chunks().0.get(..count)
}

/// Room for so many bytes of input; 0 where there is none.
#[unsafe(no_mangle)]
extern "C" fn input(bytes: usize) -> *mut Chunk {
    with(|world| {
        world
            .room(bytes)
            .map_or(core::ptr::null_mut(), <[Chunk]>::as_mut_ptr)
    })
}

/// Where the reason of the last refusal stands, as UTF-8, with `{0}` and `{1}` for its numbers.
#[unsafe(no_mangle)]
extern "C" fn message() -> *const u8 {
    with(|world| world.fault.text.as_ptr())
}

/// Its length in bytes.
#[unsafe(no_mangle)]
extern "C" fn message_length() -> usize {
    with(|world| world.fault.text.len())
}

/// One of its two numbers.
#[unsafe(no_mangle)]
extern "C" fn message_number(which: usize) -> f64 {
    with(|world| world.fault.numbers.get(which).copied().unwrap_or_default())
}

/// Where calls leave their numbers, as f64.
#[unsafe(no_mangle)]
extern "C" fn numbers() -> *const f64 {
    with(|world| world.numbers.as_ptr())
}

/// Tetrahedra side by side.
#[unsafe(no_mangle)]
extern "C" fn lanes() -> usize {
    <femto::lane::Native as femto::lane::Lanes>::WIDTH
}

/// Assets, bodies and snapshots that are kept.
#[unsafe(no_mangle)]
extern "C" fn kept() -> usize {
    with(|world| world.assets.len() + world.bodies.len() + world.snapshots.len())
}

/// An asset of the first `bytes` bytes of the input.
#[unsafe(no_mangle)]
extern "C" fn asset_load(bytes: usize) -> u32 {
    with(|world| {
        let input = world.take_input();
        let all: &[u8] = bytemuck::cast_slice(&input);
        let asset = loaded::load(AssetBytes::copy_from(all.get(..bytes).unwrap_or_default()));
        drop(input);
        keep_asset(world, asset)
    })
}

fn keep_asset(world: &mut World, asset: Result<alloc::rc::Rc<loaded::Loaded>, Fault>) -> u32 {
    let kept = asset.and_then(|asset| {
        world
            .assets
            .keep(asset)
            .ok_or_else(|| "too many assets".into())
    });
    answer(world, kept)
}

/// An asset of a mesh: the input is `nodes` × 3 f32 metres, then `tets` × 4 u32.
#[cfg(feature = "meshes")]
#[unsafe(no_mangle)]
extern "C" fn asset_of_mesh(
    nodes: usize,
    tets: usize,
    young: f32,
    poisson: f32,
    density: f32,
    alpha: f32,
    beta: f32,
) -> u32 {
    with(|world| {
        let input = world.take_input();
        let words: &[u32] = bytemuck::cast_slice(&input);
        let parts = nodes.checked_mul(3).and_then(|n| words.split_at_checked(n));
        let made = parts
            .and_then(|(x, corners)| {
                Some((
                    vectors(bytemuck::cast_slice(x), nodes)?,
                    corners.as_chunks().0.get(..tets)?,
                ))
            })
            .ok_or_else(|| Fault::new("nodes and tets are longer than the input"))
            .and_then(|(x, corners)| {
                loaded::of_mesh(x, corners, [young, poisson, density, alpha, beta])
            });
        drop(input);
        keep_asset(world, made)
    })
}

/// The same body of another material.
#[cfg(feature = "meshes")]
#[unsafe(no_mangle)]
extern "C" fn asset_of_material(
    asset: u32,
    young: f32,
    poisson: f32,
    density: f32,
    alpha: f32,
    beta: f32,
) -> u32 {
    with(|world| {
        let made = match world.assets.get(asset) {
            Some(asset) => loaded::of_other_material(
                asset.borrow_dependent(),
                [young, poisson, density, alpha, beta],
            ),
            None => Err(GONE.into()),
        };
        keep_asset(world, made)
    })
}

/// Forgets an asset; bodies that use it keep it.
#[unsafe(no_mangle)]
extern "C" fn asset_free(asset: u32) -> u32 {
    with(|world| u32::from(world.assets.free(asset)))
}

/// What an asset holds, as numbers: nodes, tetrahedra, pins, factor (0 none, 1 warped, 2 Laplacian), bytes;
/// E, ν, ρ, α, β; time step, θ, iterations, sweeps; start, as [`Choice`] has it.
#[unsafe(no_mangle)]
extern "C" fn asset_info(asset: u32) -> u32 {
    with(|world| {
        let Some(loaded) = world.assets.get(asset) else {
            return refuse(world, GONE);
        };
        let (bytes, asset) = (loaded.borrow_owner().len(), loaded.borrow_dependent());
        let (material, settings) = (&asset.metadata.material, &asset.metadata.settings);
        let factor = asset
            .factor
            .map_or(0.0, |factor| if factor.is_warped() { 1.0 } else { 2.0 });
        let numbers = [
            asset.rest.nodes.len() as f64,
            f64::from(asset.rest.header.tets),
            asset.pins.len() as f64,
            factor,
            bytes as f64,
            material.young().into(),
            material.poisson().into(),
            material.density().into(),
            material.alpha().into(),
            material.beta().into(),
            settings.dt().into(),
            settings.theta().into(),
            settings.budget.iterations.into(),
            settings.budget.polar_sweeps.into(),
            body::code_of(settings.start).into(),
        ];
        for (to, from) in world.numbers.iter_mut().zip(numbers) {
            *to = from;
        }
        1
    })
}

/// The corners of an asset's tetrahedra, four u32 each, into the input room: returns where.
#[unsafe(no_mangle)]
extern "C" fn asset_tets(asset: u32) -> *const Chunk {
    with(|world| {
        let Some(asset) = world.assets.get(asset).cloned() else {
            refuse(world, GONE);
            return core::ptr::null();
        };
        let rest = asset.borrow_dependent().rest;
        let Some(room) = world.room(rest.header.tets as usize * size_of::<[u32; 4]>()) else {
            refuse(world, "no memory");
            return core::ptr::null();
        };
        let words: &mut [u32] = bytemuck::cast_slice_mut(room);
        for (to, from) in words.as_chunks_mut().0.iter_mut().zip(rest.tets()) {
            *to = from;
        }
        room.as_ptr()
    })
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
