//! A few steps of soft and rigid bodies in one system: contact, attachments, springs.

use femto::coupling::{Coupling, Couplings, Link, Piece};
use femto::element::{Dense, Factored, Layout};
use femto::glam::{Mat3, Quat};
use femto::join::Assembly;
use femto::lane::Lanes;
use femto::owned::{OwnedRest, OwnedState, OwnedWorkspace};
use femto::report::CouplingFault;
use femto::rest::Rest;
use femto::rigid::{Rigid, Shape};
use femto::step::step_coupled;
use femto::{Budget, Mesh, Refusal, Scene, Settings, StepReport};
use wide::{f32x4, f32x8};

use super::bytes::Bytes;
use super::inputs;
use super::settings::{aggregates, room, settings, with_aggregates, with_laws};
use super::state::{bits, check_step, report_bits};
use super::world::{Heights, Solid, World};

/// Room for every contact that the bodies of [`assemble`] can have: the bounds are in `femto::detect`.
const ROOM: usize = 1024;

pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let choice = bytes.byte();
    let (dense, edges) = (choice & 1 == 1, choice & 2 == 2);
    let Some(mut assembly) = assemble(&mut bytes) else {
        return;
    };
    if edges {
        assembly.touch_by_edges();
    }
    let Ok(mesh) = Mesh::new(&assembly.nodes, &assembly.tets) else {
        return;
    };
    let materials = &assembly.materials[..];
    if dense {
        if let Ok(rest) = OwnedRest::<Dense>::new(&mesh, materials) {
            simulate(&rest, &assembly, &mut bytes);
        }
    } else if let Ok(rest) = OwnedRest::<Factored>::new(&mesh, materials) {
        simulate(&rest, &assembly, &mut bytes);
    }
}

/// Up to two soft bodies and three rigid ones, near each other.
fn assemble(bytes: &mut Bytes<'_>) -> Option<Assembly> {
    let mut assembly = Assembly::new();
    let material = inputs::material(bytes)?;
    let friction = |bytes: &mut Bytes<'_>| bytes.usual(&[0.0, 0.5]);
    for _ in 0..bytes.below(3) {
        let (mut nodes, tets) = inputs::body(bytes);
        let offset = bytes.usual_vector(&[0.0, 1.0, 0.9]);
        for x in &mut nodes {
            *x = core::array::from_fn(|axis| x[axis] + offset[axis]);
        }
        let added = assembly.soft(&nodes, &tets, material, friction(bytes));
        check_error(added.err(), &assembly);
    }
    for _ in 0..bytes.below(4) {
        let shape = if bytes.flag() {
            Shape::Ball {
                radius: bytes.usual(&[0.5, 1.0]),
            }
        } else {
            let half = bytes.usual_vector(&[0.5, 1.0]).into();
            Shape::Cuboid { half }
        };
        let mass = bytes.usual(&[1.0, 1e3]);
        let centre = bytes.usual_vector(&[0.0, 1.0, 2.0]).into();
        let [x, y, z] = bytes.usual_vector(&[0.0, 1.0]);
        let turn = Mat3::from_quat(Quat::from_xyzw(x, y, z, 1.0).normalize());
        let axes = [turn.x_axis, turn.y_axis, turn.z_axis];
        let friction = friction(bytes);
        let added = assembly.rigid(shape, mass, centre, axes, friction, &material);
        check_error(added.err(), &assembly);
    }
    Some(assembly)
}

/// What is refused adds nothing.
fn check_error(error: Option<femto::join::JoinError>, assembly: &Assembly) {
    assert!(error.is_none_or(|error| !error.to_string().is_empty()));
    let end = assembly.parts.last().map_or(0, |part| part.nodes.end);
    assert_eq!(end, assembly.nodes.len());
    assert_eq!(assembly.tets.len(), assembly.materials.len());
}

fn link(bytes: &mut Bytes<'_>, nodes: usize, rigids: &[Rigid], x: &[[f32; 3]]) -> Link {
    let node = |bytes: &mut Bytes<'_>| match bytes.byte() {
        255 => bytes.word(),
        near => u32::from(near) % nodes as u32,
    };
    let end = |bytes: &mut Bytes<'_>| {
        let at = bytes.below(rigids.len() + 2);
        match rigids.get(at) {
            Some(rigid) => Link::point_of(rigid, x, bytes.usual_vector(&[0.0, 1.0]).into()),
            None => [0; 4].map(|_| (node(bytes), bytes.usual(&[0.25, 0.0]))),
        }
    };
    let link = match bytes.below(3) {
        0 => Link::nodes(node(bytes), node(bytes)),
        1 => Link::points(end(bytes), end(bytes)),
        _ => Link::to_target(
            end(bytes),
            bytes.usual_vector(&[0.0, 1.0]).into(),
            bytes.usual_vector(&[0.0]).into(),
        ),
    };
    if bytes.flag() {
        link.soft(bytes.usual(&[100.0, 1e6]), bytes.usual(&[0.0, 1.0]))
    } else {
        link
    }
}

/// What joins the bodies, and how much of it there is room for.
struct Joint<'a> {
    pieces: Vec<Piece<'a>>,
    rigids: Vec<Rigid>,
    links: Vec<Link>,
    slots: Vec<Coupling>,
}

impl<'a> Joint<'a> {
    fn new(assembly: &'a Assembly, bytes: &mut Bytes<'_>) -> Self {
        let (pieces, rigids) = (assembly.pieces(), assembly.rigids());
        let nodes = assembly.nodes.len();
        let links = (0..bytes.below(4))
            .map(|_| link(bytes, nodes, &rigids, &assembly.nodes))
            .collect();
        let slots = vec![Coupling::EMPTY; bytes.below(24)];
        let mut joint = Self {
            pieces,
            rigids,
            links,
            slots,
        };
        joint.spoil(bytes);
        joint
    }

    /// Now and then leaves out, repeats or renumbers something.
    fn spoil(&mut self, bytes: &mut Bytes<'_>) {
        match bytes.byte() {
            250 => _ = self.pieces.pop(),
            251 => _ = self.rigids.pop(),
            252 => self.pieces.extend(self.pieces.first().copied()),
            253 => self.rigids.extend(self.rigids.first().copied()),
            254 => {
                let (first, end) = (bytes.byte().into(), bytes.byte().into());
                let changed = self.pieces.first_mut();
                changed.into_iter().for_each(|p| p.range = (first, end));
            }
            255 => {
                let (first, friction) = (bytes.word(), bytes.number());
                let changed = self.rigids.first_mut();
                let remade = |r: &mut Rigid| *r = Rigid::new(first, r.shape(), friction);
                changed.into_iter().for_each(remade);
            }
            _ => {}
        }
    }

    fn couplings(&mut self) -> Couplings<'_> {
        Couplings::new(&self.pieces, &mut self.rigids, &self.links, &mut self.slots)
    }

    /// The same with other room for contacts.
    fn with_room(&self, slots: usize) -> Self {
        Self {
            pieces: self.pieces.clone(),
            rigids: self.rigids.clone(),
            links: self.links.clone(),
            slots: vec![Coupling::EMPTY; slots],
        }
    }

    /// Contacts in the slots.
    fn found(&self) -> usize {
        let contacts = self.slots.iter().skip(self.links.len());
        let used = contacts.filter(|slot| slot.weights().any(|(_, w)| w != 0.0));
        used.count()
    }
}

fn simulate<L: Layout>(rest: &OwnedRest<L>, assembly: &Assembly, bytes: &mut Bytes<'_>) {
    let view = rest.view();
    let Some(settings) = settings(bytes).and_then(|settings| with_laws(settings, bytes)) else {
        return;
    };
    let of = aggregates(&view, bytes);
    let settings = with_aggregates(settings, of.as_ref());
    let needs = room(&settings, bytes);
    let mut state = OwnedState::new(&view, needs);
    let mut used = OwnedWorkspace::new(&view, needs);
    place(&view, assembly, &mut state, bytes);
    let mut joint = Joint::new(assembly, bytes);
    let heights = Heights::new(bytes);
    let mut solids: Vec<_> = (0..bytes.below(3))
        .filter_map(|_| Solid::new(bytes, &heights))
        .collect();
    let soft: usize = joint
        .pieces
        .iter()
        .map(|p| p.range.1 as usize)
        .max()
        .unwrap_or(0);
    let is_soft = |tet: &&[u32; 4]| (tet[0] as usize) < soft;
    let tets: Vec<_> = assembly.tets.iter().filter(is_soft).copied().collect();
    let mut world = World::new(bytes, view.nodes, &tets, &mut solids);
    for _ in 0..=bytes.below(4) {
        let (x, v) = (state.view().x.to_vec(), state.view().v.to_vec());
        world.act(&x, &v, settings.dt(), |scene| {
            step_all(&view, &mut state, &mut used, &mut joint, scene, &settings);
        });
        world.advance(settings.dt());
    }
}

/// Each body moves by itself; a few nodes are elsewhere.
fn place<L: Layout>(
    rest: &Rest<'_, L>,
    assembly: &Assembly,
    state: &mut OwnedState,
    bytes: &mut Bytes<'_>,
) {
    let mut x = rest.nodes.to_vec();
    let mut v = vec![[0.0; 3]; x.len()];
    for part in &assembly.parts {
        let velocity = bytes.usual_vector(&[0.0, 1.0, -1.0]);
        let own = v.get_mut(part.nodes.clone()).unwrap_or_default();
        own.fill(velocity);
    }
    for _ in 0..bytes.below(8) {
        let field = if bytes.flag() { &mut v } else { &mut x };
        let node = usize::from(bytes.byte()) % field.len();
        field[node] = bytes.vector();
    }
    _ = state.view_mut().place(rest, &x, &v);
}

/// In a used workspace, with other lanes, and with room for all contacts.
fn step_all<L: Layout>(
    rest: &Rest<'_, L>,
    state: &mut OwnedState,
    used: &mut OwnedWorkspace<L>,
    joint: &mut Joint<'_>,
    scene: &Scene<'_>,
    settings: &Settings<'_>,
) {
    let before = state.clone();
    let fresh = joint.with_room(joint.slots.len());
    let report = advance::<f32, L>(rest, state, used, joint, scene, settings);
    check_step(&before.view(), &state.view(), &report, settings);
    if report.advanced() {
        joint.slots.iter().for_each(check_push);
    }
    for again in [advance::<f32x4, L>, advance::<f32x8, L>] {
        let mut other = before.clone();
        let mut joint = fresh.with_room(fresh.slots.len());
        let other_report = again(rest, &mut other, used, &mut joint, scene, settings);
        assert_eq!(bits(&other.view()), bits(&state.view()));
        assert_eq!(report_bits(&other_report), report_bits(&report));
    }
    check_room(&report, joint, |slots| {
        let mut other = before.clone();
        let mut joint = fresh.with_room(slots);
        let search_only = settings.with_budget(Budget {
            iterations: 0,
            polar_sweeps: 0,
        });
        let report = advance::<f32, L>(rest, &mut other, used, &mut joint, scene, &search_only);
        (report, joint.found())
    });
}

/// Contacts never pull.
fn check_push(slot: &Coupling) {
    let [n, j] = [slot.normal(), slot.impulse()].map(|u| u.map(f64::from));
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    // Products in f32 are rounded.
    let rounding = 4.0 * f64::from(f32::EPSILON) * dot(j, j).sqrt() + 1e-37;
    let push = dot(n, j);
    assert!(push >= -rounding || push.is_nan(), "{slot:?}");
}

/// Contacts are within their slots, and what found no place is counted: as many as more room shows.
fn check_room(
    report: &StepReport,
    joint: &Joint<'_>,
    with_room: impl FnOnce(usize) -> (StepReport, usize),
) {
    let Some(slots) = joint.slots.len().checked_sub(joint.links.len()) else {
        let fault = Refusal::Coupling(CouplingFault::Slots);
        return assert!(
            report
                .refusal
                .is_some_and(|r| r == fault || !report.advanced())
        );
    };
    assert!(report.couplings as usize <= slots, "{report:?}");
    if !report.advanced() {
        return;
    }
    assert!(joint.found() <= slots);
    if report.dropped > 0 {
        assert_eq!(joint.found(), slots, "{report:?}");
    }
    let (all, found) = with_room(joint.links.len() + ROOM);
    assert_eq!(all.dropped, 0, "more contacts than the bounds say");
    // With all contacts in the solve it may be refused; what was found is the same.
    if all.advanced() {
        assert_eq!(report.dropped as usize, found.saturating_sub(slots));
    }
}

fn advance<R: Lanes, L: Layout>(
    rest: &Rest<'_, L>,
    state: &mut OwnedState,
    workspace: &mut OwnedWorkspace<L>,
    joint: &mut Joint<'_>,
    scene: &Scene<'_>,
    settings: &Settings<'_>,
) -> StepReport {
    let (mut state, mut workspace) = (state.view_mut(), workspace.view_mut(rest));
    step_coupled::<R, L>(
        rest,
        &mut state,
        &mut workspace,
        scene,
        settings,
        &mut joint.couplings(),
    )
}
