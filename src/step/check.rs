//! What makes a step impossible, found before it begins.

use crate::body::{StateMut, WorkspaceMut};
use crate::element::Layout;
use crate::inelastic;
use crate::preconditioner::Preconditioner;
use crate::report::Refusal;
use crate::rest::Rest;
use crate::scene::Scene;
use crate::settings::Settings;

/// Whether everything is of the size of the rest data, and names what it has.
pub(super) fn check<L: Layout>(
    rest: &Rest<'_, L>,
    state: &StateMut<'_>,
    work: &WorkspaceMut<'_, L>,
    scene: &Scene<'_>,
    settings: &Settings,
) -> Result<(), Refusal> {
    let (nodes, blocks) = (rest.nodes.len(), rest.blocks.len());
    let node_lists = [
        rest.masses.len(),
        state.x.len(),
        state.v.len(),
        work.filter.len(),
        work.blocks.len(),
        work.inertia.len(),
    ];
    let vectors = [work.v.len(), work.r.len(), work.p.len(), work.q.len()];
    let block_lists = [
        rest.stiffness.len(),
        state.rotations.len(),
        work.rotated.len(),
        work.fans.len(),
    ];
    if nodes == 0
        || node_lists
            .iter()
            .chain(&vectors)
            .any(|&length| length != nodes)
        || block_lists.iter().any(|&length| length != blocks)
    {
        return Err(Refusal::Storage);
    }
    inelastic::check(blocks, rest.header.tets as usize, state, settings)?;
    if state.history.len() < settings.start.history() * nodes {
        return Err(Refusal::History);
    }
    if work.vectors.len().min(work.products.len()) < settings.start.vectors() * nodes {
        return Err(Refusal::Vectors);
    }
    if let Preconditioner::Factored(factor) = settings.preconditioner
        && (factor.fingerprint() != rest.header.fingerprint || factor.nodes() != nodes)
    {
        return Err(Refusal::Factor);
    }
    if let Preconditioner::TwoLevel(aggregates) = settings.preconditioner
        && aggregates.of().len() != nodes
    {
        return Err(Refusal::Aggregates);
    }
    if work.coarse.len() < settings.preconditioner.coarse_length() {
        return Err(Refusal::Coarse);
    }
    if !(scene.forces.is_empty() || scene.forces.len() == nodes) {
        return Err(Refusal::Forces);
    }
    let lost = (0_u32..)
        .zip(scene.pins)
        .find(|(_, pin)| pin.node as usize >= nodes);
    lost.map_or(Ok(()), |(pin, _)| Err(Refusal::Pin { pin }))
}
