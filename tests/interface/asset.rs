//! Assets: what is read is what was baked, in place and to the bit; and whatever is wrong is refused.

mod malformed;

use crate::support::meshes::box_mesh;
use crate::support::scenes::{self, Setup};
use femto::asset::{
    ALIGNMENT, Aligned, Asset, AssetBytes, AssetError, Capacity, HeaderField, Metadata, capacity,
};
use femto::body::{State, Workspace};
use femto::element::Factored;
use femto::energy::StateHash;
use femto::glam::Vec3;
use femto::lane::Native;
use femto::order::fans;
use femto::owned::{OwnedBody, OwnedRest, OwnedState, OwnedWorkspace};
use femto::rest::Rest;
use femto::step::step;
use femto::{Budget, Material, Mesh, Pin, Preconditioner, Scene, Settings, Start};
use femto_bake::{FactorOptions, Kind, OwnedFactor, Precision, factor};

const KINDS: [Option<(Kind, Precision)>; 5] = [
    None,
    Some((Kind::Warped, Precision::Single)),
    Some((Kind::Warped, Precision::Half)),
    Some((Kind::Laplacian, Precision::Single)),
    Some((Kind::Laplacian, Precision::Half)),
];

const START: Start = Start::Rigid(2);

/// A body with its factor, as a program has it that makes both itself.
struct Direct {
    setup: Setup,
    rest: OwnedRest,
    factor: Option<OwnedFactor>,
    pins: Vec<Pin>,
}

impl Direct {
    fn new(setup: Setup, kind: Option<(Kind, Precision)>) -> Self {
        let mesh = Mesh::new(&setup.mesh.nodes, &setup.mesh.tets).unwrap();
        let rest = OwnedRest::new(&mesh, &setup.material()).unwrap();
        let pins = setup.pin_list();
        let factor = kind.map(|(kind, precision)| {
            let options = FactorOptions {
                kind,
                precision,
                held: pins.iter().map(|pin| pin.node).collect(),
                ..FactorOptions::default()
            };
            factor(&rest.view(), &setup.settings(), &options).unwrap()
        });
        Self {
            setup,
            rest,
            factor,
            pins,
        }
    }

    fn settings(&self) -> Settings<'static> {
        let budget = Budget {
            iterations: 3,
            polar_sweeps: 1,
        };
        let settings = self.setup.settings();
        settings.with_start(START).with_budget(budget)
    }

    fn asset(&self) -> Asset<'_> {
        Asset {
            rest: self.rest.view(),
            factor: self.factor.as_ref().map(OwnedFactor::view),
            pins: &self.pins,
            metadata: Metadata {
                source: "bäume.msh",
                material: self.setup.material(),
                settings: self.settings(),
            },
        }
    }
}

/// A damped cantilever with a moving pin, of 142 tetrahedra, so that the last block is padded.
fn cantilever() -> Setup {
    let mut setup = scenes::cantilever();
    setup.mesh.tets.truncate(142);
    setup.alpha = 0.5;
    setup.theta = 0.75;
    setup.pins[2].1 = [0.0, 0.1, -0.2];
    setup
}

fn baked(kind: Option<(Kind, Precision)>) -> AssetBytes {
    Direct::new(cantilever(), kind).asset().to_bytes().unwrap()
}

fn rest_bits(rest: &Rest<'_>) -> Vec<u32> {
    let numbers = rest.nodes.as_flattened().iter().chain(rest.masses);
    let mut bits: Vec<u32> = numbers.map(|x| x.to_bits()).collect();
    for block in rest.blocks {
        bits.extend(block.corners.as_flattened());
        let gradients = block.gradients.as_flattened().as_flattened().iter();
        bits.extend(
            gradients
                .chain(&block.lambda_v)
                .chain(&block.mu_v)
                .map(|x| x.to_bits()),
        );
    }
    bits
}

#[test]
fn what_was_baked_is_what_is_read() {
    for kind in KINDS {
        let direct = Direct::new(cantilever(), kind);
        let bytes = direct.asset().to_bytes().unwrap();
        let (written, read) = (direct.asset(), Asset::new(&bytes).unwrap());
        assert_eq!(rest_bits(&read.rest), rest_bits(&written.rest));
        assert_eq!(read.rest.header, written.rest.header);
        assert_eq!(read.rest.stiffness.len(), read.rest.blocks.len());
        assert_eq!(read.factor, written.factor);
        assert_eq!(read.pins, written.pins);
        assert_eq!(read.metadata.source, written.metadata.source);
        assert_eq!(read.metadata.material, written.metadata.material);
        assert_eq!(read.metadata.settings, direct.settings());
        assert_eq!(*read.to_bytes().unwrap(), *bytes);
    }
}

/// What was checked before is borrowed as it was; bytes that would not pass make at worst a body of nonsense.
#[test]
fn reopening_trusts_the_numbers_and_nothing_else() {
    for kind in KINDS {
        let bytes = baked(kind);
        let (first, again) = (Asset::new(&bytes).unwrap(), Asset::reopen(&bytes).unwrap());
        assert_eq!(rest_bits(&first.rest), rest_bits(&again.rest));
        assert_eq!(first.factor, again.factor);
        assert_eq!(first.pins, again.pins);
        assert!(Asset::is_one(&bytes) && !Asset::is_one(&bytes[1..]));
        assert!(Asset::reopen(&bytes[..bytes.len() - 32]).is_err());

        let mut nonsense = Aligned([0; 1 << 17]);
        let nonsense = &mut nonsense.0[..bytes.len()];
        // The name stays text: half a byte is changed.
        for (seed, stride) in [(1_u8, 3), (7, 5), (15, 1)] {
            nonsense.copy_from_slice(&bytes);
            for (k, byte) in nonsense.iter_mut().enumerate().skip(192).step_by(stride) {
                *byte ^= ((k as u8).wrapping_mul(seed) | seed) & 15;
            }
            assert!(Asset::new(nonsense).is_err());
            let asset = Asset::reopen(nonsense).unwrap();
            let mut state = OwnedState::new(&asset.rest, Start::Galerkin(1));
            let settings = asset.settings().with_start(Start::Galerkin(1));
            let mut work = OwnedWorkspace::new(&asset.rest, &settings);
            let scene = Scene::default();
            _ = step::<Native, Factored>(
                &asset.rest,
                &mut state.view_mut(),
                &mut work.view_mut(&asset.rest),
                &scene,
                &settings,
            );
        }
    }
}

#[test]
fn nothing_is_copied() {
    let bytes = baked(KINDS[1]);
    let asset = Asset::new(&bytes).unwrap();
    let factor = asset.factor.unwrap();
    let parts = [
        asset.rest.nodes.as_ptr().addr(),
        asset.rest.masses.as_ptr().addr(),
        asset.rest.blocks.as_ptr().addr(),
        asset.pins.as_ptr().addr(),
        asset.metadata.source.as_ptr().addr(),
        factor.order().as_ptr().addr(),
        factor.ends().as_ptr().addr(),
        factor.rows().as_ptr().addr(),
    ];
    let range = bytes.as_ptr_range();
    for part in parts {
        assert!((range.start.addr()..range.end.addr()).contains(&part));
        assert!(part.is_multiple_of(ALIGNMENT));
    }
}

#[test]
fn a_baked_body_moves_as_the_same_body_built_directly() {
    for kind in KINDS {
        let direct = Direct::new(cantilever(), kind);
        let view = direct.factor.as_ref().map(OwnedFactor::view);
        let mut settings = direct.settings();
        if let Some(view) = &view {
            settings = settings.with_preconditioner(Preconditioner::Factored(view));
        }
        let scene = direct.setup.scene(&direct.pins);
        let mut body: OwnedBody = direct.setup.body(START);

        let bytes = direct.asset().to_bytes().unwrap();
        let asset = Asset::new(&bytes).unwrap();
        let mut state = OwnedState::new(&asset.rest, START);
        let mut workspace = OwnedWorkspace::new(&asset.rest, START);
        let baked_scene = direct.setup.scene(asset.pins);
        for _ in 0..60 {
            assert!(body.step(&scene, &settings).advanced());
            let report = step::<Native, Factored>(
                &asset.rest,
                &mut state.view_mut(),
                &mut workspace.view_mut(&asset.rest),
                &baked_scene,
                &asset.settings(),
            );
            assert!(report.advanced());
        }
        assert_eq!(&state, body.state(), "{kind:?}");
        let moved = StateHash::new().with(body.positions(), body.velocities());
        let still = StateHash::new().with(asset.rest.nodes, asset.rest.nodes);
        assert_ne!(moved, still);
    }
}

/// As in firmware: constants from the bytes, storage without an allocator.
#[test]
fn the_golden_asset_is_read_by_this_version() {
    static BYTES: &[u8] = femto::include_asset!("../golden/cube.femto");
    const SIZE: Capacity = capacity(BYTES);
    assert_eq!((SIZE.nodes, SIZE.blocks), (8, 1));
    let asset = Asset::new(BYTES).unwrap();
    let mut state = State::<{ SIZE.nodes }, { SIZE.blocks }>::new();
    let mut workspace = Workspace::<{ SIZE.nodes }, { SIZE.blocks }>::new();
    state.reset(&asset.rest).unwrap();

    let mesh = box_mesh([1.0; 3], [1; 3]);
    let tets = fans(&mesh.tets).tets; // as the tool orders them
    let material = Material::new(1e5, 0.4, 1000.0).unwrap();
    let material = material.with_damping(0.0, 0.001).unwrap();
    let mesh = Mesh::new(&mesh.nodes, &tets).unwrap();
    let mut body: OwnedBody = OwnedBody::new(&mesh, &material, Start::Galerkin(1)).unwrap();
    let gravity = Vec3::new(0.0, -9.81, 0.0);
    let scene = Scene {
        gravity,
        pins: asset.pins,
        ..Scene::default()
    };
    for _ in 0..20 {
        let (mut state, mut workspace) = (state.view_mut(), workspace.view_mut(&asset.rest));
        let settings = asset.settings();
        let report =
            step::<Native, Factored>(&asset.rest, &mut state, &mut workspace, &scene, &settings);
        assert!(report.advanced());
        assert!(body.step(&scene, &settings).advanced());
    }
    assert_eq!(asset.metadata.material, material);
    assert_eq!(asset.pins.len(), 4);
    assert!(!asset.factor.unwrap().is_warped());
    assert_eq!(state.view().x, body.positions());
}

#[test]
fn what_would_not_be_read_is_not_written() {
    let direct = Direct::new(cantilever(), KINDS[3]);
    let refused = |asset: Asset<'_>| asset.to_bytes().unwrap_err();

    let other = Direct::new(scenes::free_spin(), KINDS[3]);
    let factor = other.factor.as_ref().map(OwnedFactor::view);
    let asset = direct.asset();
    assert_eq!(
        refused(Asset { factor, ..asset }),
        AssetError::ForeignFactor
    );

    let pins = [Pin::held(3), Pin::held(3)];
    assert_eq!(
        refused(Asset {
            pins: &pins,
            ..asset
        }),
        AssetError::Pin { pin: 1 }
    );

    let material = Material::new(1e6, 0.4, 1000.0).unwrap();
    let metadata = Metadata {
        material,
        ..asset.metadata
    };
    let damping = AssetError::Header(HeaderField::Damping);
    assert_eq!(refused(Asset { metadata, ..asset }), damping);

    let mut rest = asset.rest;
    rest.header.total_mass *= 1.5;
    let mass = AssetError::Header(HeaderField::TotalMass);
    assert_eq!(refused(Asset { rest, ..asset }), mass);
}

#[test]
fn room_is_told_without_looking_further() {
    let bytes = baked(KINDS[0]);
    let asset = Asset::new(&bytes).unwrap();
    let size = capacity(&bytes);
    assert_eq!(size.nodes, asset.rest.nodes.len());
    assert_eq!(size.blocks, asset.rest.blocks.len());
    assert_eq!(
        capacity(&bytes[..20]),
        Capacity {
            nodes: 0,
            blocks: 0
        }
    );
    let (state, workspace) = asset.ram(START);
    // x, v, one past velocity; the rotations of eight tetrahedra are 128 bytes.
    assert_eq!(state, size.nodes * 36 + size.blocks * 128);
    assert!(workspace > state);
}
