//! Exports: assets.

use femto::asset::AssetBytes;

use crate::fault::fault;
use crate::world::{Kept, address, call};
use crate::{body, loaded};

/// An asset of the first `bytes` bytes of the input.
#[unsafe(no_mangle)]
extern "C" fn asset_load(bytes: usize) -> u32 {
    call(&mut |world| {
        let input = world.take_input();
        let all: &[u8] = bytemuck::cast_slice(&input);
        let asset = loaded::load(AssetBytes::copy_from(all.get(..bytes).unwrap_or_default()))?;
        drop(input);
        world.keep(Kept::Asset(asset))
    })
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
    call(&mut |world| {
        let input = world.take_input();
        let words: &[u32] = bytemuck::cast_slice(&input);
        let parts = nodes.checked_mul(3).and_then(|n| words.split_at_checked(n));
        let (x, corners) = parts
            .and_then(|(x, corners)| {
                Some((
                    crate::bodies::vectors(bytemuck::cast_slice(x), nodes)?,
                    corners.as_chunks().0.get(..tets)?,
                ))
            })
            .ok_or(fault!("nodes and tets are longer than the input"))?;
        let made = loaded::of_mesh(x, corners, [young, poisson, density, alpha, beta])?;
        drop(input);
        world.keep(Kept::Asset(made))
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
    call(&mut |world| {
        let asset = world.asset(asset)?;
        let numbers = [young, poisson, density, alpha, beta];
        let made = loaded::of_other_material(asset.borrow_dependent(), numbers)?;
        world.keep(Kept::Asset(made))
    })
}

/// What an asset holds, as numbers: nodes, tetrahedra, pins, factor (0 none, 1 warped, 2 Laplacian), bytes;
/// E, ν, ρ, α, β; time step, θ, iterations, sweeps; start, as [`Choice`] has it.
#[unsafe(no_mangle)]
extern "C" fn asset_info(asset: u32) -> u32 {
    call(&mut |world| {
        let loaded = world.asset(asset)?;
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
        world.numbers(numbers);
        Ok(1)
    })
}

/// The corners of an asset's tetrahedra, four u32 each, into the input room: returns where.
#[unsafe(no_mangle)]
extern "C" fn asset_tets(asset: u32) -> u32 {
    call(&mut |world| {
        let asset = world.asset(asset)?;
        let rest = asset.borrow_dependent().rest;
        let room = world
            .room(rest.header.tets as usize * size_of::<[u32; 4]>())
            .ok_or(fault!("no memory"))?;
        let words: &mut [u32] = bytemuck::cast_slice_mut(room);
        for (to, from) in words.as_chunks_mut().0.iter_mut().zip(rest.tets()) {
            *to = from;
        }
        Ok(address(room.as_ptr()))
    })
}
