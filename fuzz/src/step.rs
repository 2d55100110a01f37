//! A few steps of a small body in any state, scene and settings.

use femto::element::{Dense, Factored, Layout};
use femto::lane::Lanes;
use femto::owned::{OwnedRest, OwnedState, OwnedWorkspace};
use femto::rest::Rest;
use femto::state::{State, StateError, StateRef};
use femto::step::step;
use femto::{Body, Material, Mesh, Refusal, Settings, StepReport, blocks};
use wide::{f32x4, f32x8};

use super::bytes::Bytes;
use super::inputs;
use super::scene::SceneData;
use super::settings::{settings, start};
use super::state::{bits, check_state, check_step, report_bits};

const BLOCKS: usize = blocks(inputs::TETS);
/// What `Start::Rigid(4)` needs.
const HISTORY: usize = 3;
const VECTORS: usize = 7;
type Fixed<L> = Body<{ inputs::NODES }, BLOCKS, HISTORY, VECTORS, L>;

pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let dense = bytes.flag();
    let (nodes, tets) = inputs::body(&mut bytes);
    let Some(material) = inputs::material(&mut bytes) else {
        return;
    };
    let Ok(mesh) = Mesh::new(&nodes, &tets) else {
        return;
    };
    let Some(settings) = settings(&mut bytes) else {
        return;
    };
    if dense {
        simulate::<Dense>(&mesh, &material, &settings, &mut bytes);
    } else {
        simulate::<Factored>(&mesh, &material, &settings, &mut bytes);
    }
}

fn simulate<L: Layout>(
    mesh: &Mesh<'_>,
    material: &Material,
    settings: &Settings,
    bytes: &mut Bytes<'_>,
) {
    let Ok(rest) = OwnedRest::<L>::new(mesh, material) else {
        return;
    };
    let rest = rest.view();
    // Mostly room for what the steps need.
    let room = if bytes.below(16) == 15 {
        start(bytes)
    } else {
        settings.start
    };
    let mut state = OwnedState::new(&rest, room);
    let mut used = OwnedWorkspace::new(&rest, room);
    let mut fixed = Fixed::<L>::new();
    fixed.fill(mesh, material).expect("what vectors hold");
    place(&rest, &mut state, &mut fixed, bytes);
    let scene = SceneData::new(bytes, mesh.nodes().len());
    for _ in 0..=bytes.below(4) {
        let mut new = OwnedWorkspace::new(&rest, room);
        let report = step_owned(&rest, &mut state, [&mut new, &mut used], &scene, settings);
        let too_small = matches!(report.refusal, Some(Refusal::History | Refusal::Vectors));
        assert!(!too_small || room != settings.start, "{report:?}");
        if !too_small {
            step_fixed(&mut fixed, &state, &report, &scene, settings);
        }
    }
    // Diagnostics of any state.
    _ = (
        fixed.energies(scene.gravity),
        fixed.momenta(),
        fixed.min_det(),
    );
}

/// In a new workspace, then from the snapshot with other lanes in a used one, then once more.
fn step_owned<L: Layout>(
    rest: &Rest<'_, L>,
    state: &mut OwnedState,
    [new, used]: [&mut OwnedWorkspace<L>; 2],
    scene: &SceneData,
    settings: &Settings,
) -> StepReport {
    let before = state.clone();
    let report = advance::<f32, L>(rest, state, new, scene, settings);
    check_step(&before.view(), &state.view(), &report, settings);
    let most = state.view().x.len() * scene.colliders.len();
    assert!(report.contacts as usize <= most, "{report:?}");
    for again in [advance::<f32x4, L>, advance::<f32x8, L>, advance::<f32, L>] {
        let mut other = before.clone();
        let other_report = again(rest, &mut other, used, scene, settings);
        assert_eq!(bits(&other.view()), bits(&state.view()));
        assert_eq!(report_bits(&other_report), report_bits(&report));
    }
    report
}

/// In arrays, from a snapshot that is restored once.
fn step_fixed<L: Layout>(
    fixed: &mut Fixed<L>,
    expected: &OwnedState,
    report: &StepReport,
    scene: &SceneData,
    settings: &Settings,
) {
    let mut snapshot = State::new();
    snapshot.copy_from(fixed.state());
    for _ in 0..2 {
        fixed.state_mut().copy_from(&snapshot);
        let fixed_report = fixed.step(&scene.view(), settings);
        assert_eq!(report_bits(&fixed_report), report_bits(report));
        // Arrays keep all the history that there is room for.
        let without_history = |mut state: StateRef<'_>| {
            state.history = &[];
            bits(&state)
        };
        assert_eq!(
            without_history(fixed.state().view()),
            without_history(expected.view())
        );
    }
}

fn advance<R: Lanes, L: Layout>(
    rest: &Rest<'_, L>,
    state: &mut OwnedState,
    workspace: &mut OwnedWorkspace<L>,
    scene: &SceneData,
    settings: &Settings,
) -> StepReport {
    step::<R, L>(
        rest,
        &mut state.view_mut(),
        &mut workspace.view_mut(rest),
        &scene.view(),
        settings,
    )
}

/// An affine image of the rest shape with affine velocities, and a few nodes elsewhere.
fn place<L: Layout>(
    rest: &Rest<'_, L>,
    state: &mut OwnedState,
    fixed: &mut Fixed<L>,
    bytes: &mut Bytes<'_>,
) {
    let usual = [1.0, 0.0, -1.0, 0.99];
    let mut x = affine(
        rest.nodes,
        bytes.usual_vector(&usual),
        bytes.usual_vector(&[0.0]),
    );
    let spin = bytes.usual_vector(&[0.0, 1.0, -1.0]);
    let turned: Vec<_> = rest.nodes.iter().map(|&[x, y, z]| [y, z, x]).collect();
    let mut v = affine(&turned, spin, bytes.usual_vector(&[0.0]));
    for _ in 0..bytes.below(8) {
        let field = if bytes.flag() { &mut v } else { &mut x };
        let node = usize::from(bytes.byte()) % field.len();
        field[node] = bytes.vector();
    }
    let before = bits(&state.view());
    let placed = state.view_mut().place(rest, &x, &v);
    assert_eq!(placed, fixed.place(&x, &v));
    match placed {
        Ok(()) => check_state(&state.view()),
        Err(refusal) => {
            assert!(
                matches!(refusal, StateError::NonFinite { .. }),
                "{refusal:?}"
            );
            assert_eq!(bits(&state.view()), before);
        }
    }
}

fn affine(nodes: &[[f32; 3]], scale: [f32; 3], offset: [f32; 3]) -> Vec<[f32; 3]> {
    nodes
        .iter()
        .map(|x| [0, 1, 2].map(|axis| scale[axis] * x[axis] + offset[axis]))
        .collect()
}
