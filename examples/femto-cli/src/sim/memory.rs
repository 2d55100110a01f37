//! How many bytes a simulation takes, by the library's own count.

use femto::body::{rest_bytes, state_bytes, workspace_bytes};
use femto::coupling::Coupling;
use femto::detect::Aabb;
use femto::element::{Dense, Factored, Layout};
use femto::lane::blocks;
use femto::owned::OwnedBody;
use femto::preconditioner::Factor;
use femto::settings::{Needs, Start};
use femto::state::{broken_bytes, plastic_bytes};

use super::Sim;
use super::body::{own_settings, with};
use super::values::Memory;

impl Sim<'_> {
    /// Rest and state of all bodies; the workspace serves one body at a time, so that of the
    /// largest is enough.
    pub fn memory(&self) -> Memory {
        let mut sum = Memory::default();
        for body in &self.bodies {
            let settings =
                own_settings(&self.settings, None, body.aggregates.as_deref(), body.laws);
            let needs = Needs::from(&settings);
            let one = with!(&body.kind, body => memory_of(body, needs));
            sum.rest += one.rest;
            sum.factor += body.factor.as_ref().map_or(0, Factor::bytes);
            sum.state += one.state;
            sum.workspace = sum.workspace.max(one.workspace);
        }
        if let Some(joint) = &self.joint {
            sum.workspace += joint.slots.len() * size_of::<Coupling>();
            sum.workspace += joint.boxes.len() * size_of::<Aabb>();
        }
        sum
    }
}

fn memory_of<L: Layout>(body: &OwnedBody<L>, needs: Needs) -> Memory {
    let rest = body.rest();
    needed::<L>(rest.nodes.len(), rest.header.tets as usize, needs)
}

fn needed<L: Layout>(nodes: usize, tets: usize, needs: Needs) -> Memory {
    let blocks = blocks(tets);
    Memory {
        rest: rest_bytes::<L>(nodes, blocks),
        factor: 0,
        state: state_bytes(nodes, blocks, needs.history)
            + if needs.plastic {
                plastic_bytes(blocks)
            } else {
                0
            }
            + if needs.broken {
                broken_bytes(blocks)
            } else {
                0
            },
        workspace: workspace_bytes::<L>(nodes, blocks, needs.vectors)
            + needs.coarse * size_of::<f32>(),
    }
}

/// What a body of this size takes with the default start, factored and dense.
pub fn memory_of_mesh(nodes: usize, tets: usize) -> [Memory; 2] {
    let needs = Needs::from(Start::default());
    [
        needed::<Factored>(nodes, tets, needs),
        needed::<Dense>(nodes, tets, needs),
    ]
}
