//! Bodies that flow or break, in arrays.

use femto::body::{State, StateRef};
use femto::element::Factored;
use femto::lane::blocks;
use femto::settings::Settings;
use femto::{Body, Mesh};

use crate::support::scenes::Setup;

/// So many steps in arrays; then those after the first `kept` once more, from a snapshot. `end` sees the state both times.
pub fn run_twice(
    setup: &Setup,
    settings: &Settings<'_>,
    (steps, kept): (usize, usize),
    mut end: impl FnMut(&StateRef<'_>),
) {
    type Small = Body<64, { blocks(64) }, 0, 1, Factored, 0, { blocks(64) }>;
    let mesh = Mesh::new(&setup.mesh.nodes, &setup.mesh.tets).unwrap();
    let mut body = Box::new(Small::new());
    body.fill(&mesh, &setup.material()).unwrap();
    body.place(&setup.x, &setup.v).unwrap();
    let mut snapshot = State::new();
    for n in 0..steps {
        if n == kept {
            snapshot.copy_from(body.state());
        }
        assert!(body.step(&setup.scene(&[]), settings).advanced());
    }
    end(&body.state().view());
    body.state_mut().copy_from(&snapshot);
    for _ in kept..steps {
        assert!(body.step(&setup.scene(&[]), settings).advanced());
    }
    end(&body.state().view());
}
