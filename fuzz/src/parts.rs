//! A few steps of a small body with the newer parts: shapes that turn, loads, several materials, fibres, plastic flow,
//! fracture, a factor or aggregates of its own, and the energy guard.

use femto::elasticity::{Fibres, Orthotropic};
use femto::element::{Dense, Elasticity, Factored, Layout};
use femto::lane::Lanes;
use femto::owned::{OwnedRest, OwnedState, OwnedWorkspace};
use femto::rest::Rest;
use femto::step::step;
use femto::{Material, Mesh, Preconditioner, Refusal, Regions, Scene, Settings, StepReport};
use femto_bake::{FactorOptions, Kind, OwnedFactor, RestStiffness, factor};
use wide::{f32x4, f32x8};

use super::bytes::Bytes;
use super::guard::check_energy;
use super::inputs;
use super::settings::{aggregates, room, settings, with_aggregates, with_laws};
use super::state::{bits, check_state, check_step, report_bits};
use super::world::{Heights, Solid, World};

pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let layout = bytes.below(4);
    let (nodes, tets) = inputs::body(&mut bytes);
    let Ok(mesh) = Mesh::new(&nodes, &tets) else {
        return;
    };
    let materials: Vec<Material> = (0..=bytes.below(3))
        .filter_map(|_| inputs::material(&mut bytes))
        .collect();
    let of: Vec<u16> = tets
        .iter()
        .map(|_| match bytes.byte() {
            255 => bytes.word() as u16,
            place => u16::from(place) % materials.len().max(1) as u16,
        })
        .collect();
    let regions = Regions {
        materials: &materials,
        of: &of,
    };
    match layout {
        0 => {
            if let Ok(rest) = OwnedRest::<Factored>::new(&mesh, &regions) {
                simulate(&rest, &tets, &mut bytes);
            }
        }
        1 => {
            if let Ok(rest) = OwnedRest::<Dense>::new(&mesh, &regions) {
                simulate(&rest, &tets, &mut bytes);
            }
        }
        _ => {
            let laws: Vec<_> = (0..2).filter_map(|_| elasticity(&mut bytes)).collect();
            let (Some(first), Some(last)) = (laws.first(), laws.last()) else {
                return;
            };
            let law = |tet: usize| if tet.is_multiple_of(2) { *first } else { *last };
            if let Ok(rest) = OwnedRest::anisotropic(&mesh, &regions, law) {
                simulate(&rest, &tets, &mut bytes);
            }
        }
    }
}

/// Of fibres, or of three axes, or any numbers at all.
fn elasticity(bytes: &mut Bytes<'_>) -> Option<Elasticity> {
    let kind = bytes.below(8);
    let mut modulus = || f64::from(bytes.usual(&[1e5, 1e6]).abs());
    let (along, across, shear) = (modulus(), modulus(), modulus());
    let mut ratio = || f64::from(bytes.usual(&[0.0, 0.3, 0.45]));
    let poisson = [ratio(), ratio(), ratio()];
    let direction = bytes.usual_vector(&[1.0, 0.0]).map(f64::from);
    let made = match kind {
        7 => return Some([0; 6].map(|_| [0; 6].map(|_| f64::from(bytes.usual(&[0.0]))))),
        0..4 => Fibres {
            along,
            across,
            poisson_along: poisson[0],
            poisson_across: poisson[1],
            shear,
        }
        .elasticity(direction),
        _ => Orthotropic {
            young: [along, across, across],
            poisson,
            shear: [shear; 3],
        }
        .along(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    };
    match made {
        Ok(c) => {
            for (row, line) in c.iter().enumerate() {
                assert!(
                    c[row][row] > 0.0 && line.iter().all(|x| !x.is_nan()),
                    "{c:?}"
                );
            }
            Some(c)
        }
        Err(error) => {
            assert!(!error.to_string().is_empty());
            None
        }
    }
}

fn simulate<L: RestStiffness>(rest: &OwnedRest<L>, tets: &[[u32; 4]], bytes: &mut Bytes<'_>) {
    let view = rest.view();
    let Some(settings) = settings(bytes).and_then(|settings| with_laws(settings, bytes)) else {
        return;
    };
    let of = aggregates(&view, bytes);
    let settings = with_aggregates(settings, of.as_ref());
    let made = own_factor(&view, &settings, bytes);
    let made = made.as_ref().map(OwnedFactor::view);
    let settings = match &made {
        Some(factor) => settings.with_preconditioner(Preconditioner::Factored(factor)),
        None => settings,
    };
    let needs = room(&settings, bytes);
    let mut state = OwnedState::new(&view, needs);
    let mut used = OwnedWorkspace::new(&view, needs);
    place(&view, &mut state, bytes);
    let heights = Heights::new(bytes);
    let mut solids: Vec<_> = (0..bytes.below(3))
        .filter_map(|_| Solid::new(bytes, &heights))
        .collect();
    let mut world = World::new(bytes, view.nodes, tets, &mut solids);
    for _ in 0..=bytes.below(4) {
        let mut new = OwnedWorkspace::new(&view, needs);
        let (x, v) = (state.view().x.to_vec(), state.view().v.to_vec());
        let report = world.act(&x, &v, settings.dt(), |scene| {
            step_all(&view, &mut state, [&mut new, &mut used], scene, &settings)
        });
        let no_room = matches!(
            report.refusal,
            Some(
                Refusal::Storage
                    | Refusal::History
                    | Refusal::Vectors
                    | Refusal::Coarse
                    | Refusal::Plasticity
                    | Refusal::Fracture
            )
        );
        assert!(!no_room || needs != (&settings).into(), "{report:?}");
        world.advance(settings.dt());
    }
}

/// A factor of the body, with nothing held or its first node, one time in four.
fn own_factor<L: RestStiffness>(
    rest: &Rest<'_, L>,
    settings: &Settings<'_>,
    bytes: &mut Bytes<'_>,
) -> Option<OwnedFactor> {
    if bytes.below(4) != 3 {
        return None;
    }
    let options = FactorOptions {
        kind: [Kind::Warped, Kind::Laplacian][bytes.below(2)],
        held: if bytes.flag() { vec![0] } else { Vec::new() },
        ..FactorOptions::default()
    };
    match factor(rest, settings, &options) {
        Ok(made) => Some(made),
        Err(error) => {
            assert!(!error.to_string().is_empty());
            None
        }
    }
}

/// Stretched, and a few nodes elsewhere.
fn place<L: Layout>(rest: &Rest<'_, L>, state: &mut OwnedState, bytes: &mut Bytes<'_>) {
    let scale = bytes.usual_vector(&[1.0, 1.1, 2.0, 0.0, -1.0]);
    let mut x: Vec<_> = rest
        .nodes
        .iter()
        .map(|x| [0, 1, 2].map(|axis| scale[axis] * x[axis]))
        .collect();
    let mut v = vec![bytes.usual_vector(&[0.0, 1.0]); x.len()];
    for _ in 0..bytes.below(8) {
        let field = if bytes.flag() { &mut v } else { &mut x };
        let node = usize::from(bytes.byte()) % field.len();
        field[node] = bytes.vector();
    }
    if state.view_mut().place(rest, &x, &v).is_ok() {
        check_state(&state.view());
    }
}

/// In a new workspace, then in a used one with other lanes; and what the energy guard would make of it.
fn step_all<L: Layout>(
    rest: &Rest<'_, L>,
    state: &mut OwnedState,
    [new, used]: [&mut OwnedWorkspace<L>; 2],
    scene: &Scene<'_>,
    settings: &Settings<'_>,
) -> StepReport {
    let before = state.clone();
    guarded(rest, &before, used, scene, settings);
    let report = advance::<f32, L>(rest, state, new, scene, settings);
    check_step(&before.view(), &state.view(), &report, settings);
    for again in [advance::<f32x4, L>, advance::<f32x8, L>] {
        let mut other = before.clone();
        let other_report = again(rest, &mut other, used, scene, settings);
        assert_eq!(bits(&other.view()), bits(&state.view()));
        assert_eq!(report_bits(&other_report), report_bits(&report));
    }
    report
}

/// The same step with the energy guard.
fn guarded<L: Layout>(
    rest: &Rest<'_, L>,
    before: &OwnedState,
    workspace: &mut OwnedWorkspace<L>,
    scene: &Scene<'_>,
    settings: &Settings<'_>,
) {
    if scene.colliders.is_empty() {
        return;
    }
    let settings = settings.with_energy_guard();
    let (mut state, mut other) = (before.clone(), before.clone());
    let report = advance::<f32, L>(rest, &mut state, workspace, scene, &settings);
    let other_report = advance::<f32x8, L>(rest, &mut other, workspace, scene, &settings);
    assert_eq!(bits(&other.view()), bits(&state.view()));
    assert_eq!(report_bits(&other_report), report_bits(&report));
    let (before, state) = (before.view(), state.view());
    check_step(&before, &state, &report, &settings);
    if report.advanced() {
        check_energy(rest, [&before, &state], scene, &settings, &report);
    }
}

fn advance<R: Lanes, L: Layout>(
    rest: &Rest<'_, L>,
    state: &mut OwnedState,
    workspace: &mut OwnedWorkspace<L>,
    scene: &Scene<'_>,
    settings: &Settings<'_>,
) -> StepReport {
    let (mut state, mut workspace) = (state.view_mut(), workspace.view_mut(rest));
    step::<R, L>(rest, &mut state, &mut workspace, scene, settings)
}
