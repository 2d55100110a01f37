//! Assets: any bytes, and good ones that were damaged and signed again so that what lies behind the
//! checksum is reached. What is accepted can be stepped with.

use femto::asset::{Asset, AssetBytes, AssetError, capacity};
use femto::element::Factored;
use femto::glam::Vec3;
use femto::lane::Native;
use femto::owned::{OwnedState, OwnedWorkspace};
use femto::step::step;
use femto::{Budget, Collider, Scene, Start};

use super::bytes::Bytes;
use super::state::check_state;

/// A cube of six tetrahedra with every kind of factor, and without one.
const GOOD: [&[u8]; 5] = [
    include_bytes!("../assets/none.femto"),
    include_bytes!("../assets/warped-f32.femto"),
    include_bytes!("../assets/warped-f16.femto"),
    include_bytes!("../assets/laplacian-f32.femto"),
    include_bytes!("../assets/laplacian-f16.femto"),
];

const CHECKSUM: usize = 16;
const COVERED: usize = 24;
/// The section table begins here.
const TABLE: usize = 96;

/// The first byte chooses: the rest as it is, or as edits of a good asset.
pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let choice = usize::from(bytes.byte());
    let Some(good) = GOOD.get(choice % 8) else {
        let rest = data.get(1..).unwrap_or_default();
        read(rest, &mut Bytes::new(&[]));
        let mut signed = rest.to_vec();
        sign(&mut signed);
        return read(&signed, &mut Bytes::new(&[]));
    };
    let mut damaged = good.to_vec();
    for _ in 0..bytes.below(8) {
        edit(&mut damaged, &mut bytes);
    }
    if damaged != *good {
        let error = Asset::new(&AssetBytes::copy_from(&damaged)).err();
        assert!(error.is_some(), "damaged, and accepted");
    }
    sign(&mut damaged);
    read(&damaged, &mut bytes);
}

/// A bit, a word, or a number, anywhere or in a section of choice; or the length.
fn edit(asset: &mut Vec<u8>, bytes: &mut Bytes<'_>) {
    let kind = bytes.below(8);
    let place = usize::from(bytes.byte()) | usize::from(bytes.byte()) << 8;
    if kind == 7 {
        let length = asset.len() as u32;
        let length = length
            .wrapping_add(32 * (place as u32 % 5))
            .wrapping_sub(64);
        asset.resize(length as usize % (1 << 16), 0);
        return put(asset, 12, length);
    }
    let at = if kind < 3 {
        place
    } else {
        let section = bytes.below(10);
        let entry = TABLE + 8 * section;
        let (offset, length) = (word(asset, entry), word(asset, entry + 4).max(1));
        offset.wrapping_add(place as u32 % length) as usize
    };
    let at = at % asset.len().max(1);
    match kind {
        0 | 3 => {
            if let Some(byte) = asset.get_mut(at) {
                *byte ^= 1 << bytes.below(8);
            }
        }
        1 | 4 => put(asset, at & !3, bytes.word()),
        2 | 5 => put(asset, at & !3, bytes.number().to_bits()),
        _ => {
            let by = u32::from(bytes.byte()).wrapping_sub(128);
            let changed = word(asset, at & !3).wrapping_add(by);
            put(asset, at & !3, changed);
        }
    }
}

fn word(bytes: &[u8], at: usize) -> u32 {
    let found = bytes.get(at..).and_then(|bytes| bytes.first_chunk());
    found.map_or(0, |word| u32::from_le_bytes(*word))
}

fn put(bytes: &mut [u8], at: usize, value: u32) {
    for (byte, new) in bytes.iter_mut().skip(at).zip(value.to_le_bytes()) {
        *byte = new;
    }
}

/// FNV-1a, 64 bit.
fn sign(bytes: &mut [u8]) {
    let covered = bytes.get(COVERED..).unwrap_or_default();
    let sum = covered
        .iter()
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
        });
    for (byte, new) in bytes.iter_mut().skip(CHECKSUM).zip(sum.to_le_bytes()) {
        *byte = new;
    }
}

fn read(bytes: &[u8], choices: &mut Bytes<'_>) {
    let aligned = AssetBytes::copy_from(bytes);
    let room = capacity(&aligned);
    match Asset::new(&aligned) {
        Ok(asset) => {
            let nodes = (asset.rest.nodes.len(), room.nodes);
            let blocks = (asset.rest.blocks.len(), room.blocks);
            assert!(nodes.0 == nodes.1 && blocks.0 == blocks.1, "{room:?}");
            // Padding between sections is the writer's.
            let again = asset.to_bytes().expect("what was read can be written");
            assert_eq!(again.len(), aligned.len());
            simulate(&asset, choices);
        }
        Err(error) => {
            assert!(!error.to_string().is_empty());
            assert_ne!(error, AssetError::BigEndianHost);
        }
    }
}

/// Steps of the suggested settings, but for an endless budget, in a small world.
fn simulate(asset: &Asset<'_>, choices: &mut Bytes<'_>) {
    let start = match asset.metadata.settings.start {
        Start::Galerkin(m) => Start::Galerkin(m.min(4)),
        Start::Rigid(m) => Start::Rigid(m.min(4)),
        other => other,
    };
    let budget = asset.metadata.settings.budget;
    let settings = asset.settings().with_start(start).with_budget(Budget {
        iterations: budget.iterations.min(20),
        polar_sweeps: budget.polar_sweeps.min(4),
    });
    let ground = Collider::half_space(Vec3::Y, choices.usual(&[0.0, -1.0]));
    let colliders: Vec<Collider> = ground.into_iter().collect();
    let scene = Scene {
        gravity: choices.usual_vector(&[0.0, -9.81]).into(),
        pins: asset.pins,
        colliders: &colliders,
        ..Scene::default()
    };
    let mut state = OwnedState::new(&asset.rest, start);
    let mut workspace = OwnedWorkspace::new(&asset.rest, start);
    check_state(&state.view());
    for _ in 0..3 {
        let before = state.clone();
        let report = step::<Native, Factored>(
            &asset.rest,
            &mut state.view_mut(),
            &mut workspace.view_mut(&asset.rest),
            &scene,
            &settings,
        );
        if report.advanced() {
            check_state(&state.view());
        } else {
            assert_eq!(state, before, "{report:?}");
        }
    }
}
