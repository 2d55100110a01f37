//! Every way in which bytes can be wrong, and the error that says so. Offsets are those of the
//! format's documentation, written once more.

use femto::asset::{Asset, AssetBytes, AssetError, HeaderField, Section, SectionFault};
use femto::material::MaterialError;
use femto::preconditioner::factor::FactorError;
use femto::settings::SettingsError;

use super::{KINDS, baked};

const CHECKSUM: usize = 16;
const SECTIONS: usize = 96;

/// FNV-1a, 64 bit.
fn fnv(bytes: &[u8]) -> u64 {
    let mut hash: u64 = 14_695_981_039_346_656_037;
    for byte in bytes {
        hash ^= u64::from(*byte);
        hash = hash.wrapping_mul(1_099_511_628_211);
    }
    hash
}

/// Makes the checksum right again, so that what lies behind it is reached.
fn sign(bytes: &mut [u8]) {
    let sum = fnv(&bytes[CHECKSUM + 8..]);
    bytes[CHECKSUM..CHECKSUM + 8].copy_from_slice(&sum.to_le_bytes());
}

fn word(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

fn put(bytes: &mut [u8], at: usize, value: u32) {
    bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
}

fn change(bytes: &mut [u8], at: usize, by: u32) {
    let changed = word(bytes, at).wrapping_add(by);
    put(bytes, at, changed);
}

/// Where a section begins.
fn start(bytes: &[u8], section: usize) -> usize {
    word(bytes, SECTIONS + 8 * section) as usize
}

/// Where the table has a section's offset; its length is 4 behind.
const fn table(section: usize) -> usize {
    SECTIONS + 8 * section
}

const NODES: usize = 0;
const MASSES: usize = 1;
const BLOCKS: usize = 2;
const PINS: usize = 3;
const SOURCE: usize = 4;
const ORDER: usize = 5;
const ENDS: usize = 6;
const PIVOTS: usize = 8;
const LOWER: usize = 9;

/// Bytes from a block's beginning.
const GRADIENTS: usize = 128;
const LAMBDA: usize = 416;
const MU: usize = 448;
const BLOCK: usize = 480;

fn refused(edit: impl FnOnce(&mut Vec<u8>)) -> AssetError {
    refused_of(3, edit)
}

fn refused_of(kind: usize, edit: impl FnOnce(&mut Vec<u8>)) -> AssetError {
    let mut bytes = baked(KINDS[kind]).to_vec();
    edit(&mut bytes);
    sign(&mut bytes);
    Asset::new(&AssetBytes::copy_from(&bytes)).expect_err("accepted")
}

const fn fault(section: Section, fault: SectionFault) -> AssetError {
    AssetError::Section { section, fault }
}

#[test]
fn unchanged_bytes_are_accepted() {
    for kind in KINDS {
        let mut bytes = baked(kind).to_vec();
        sign(&mut bytes);
        assert_eq!(bytes, *baked(kind));
        Asset::new(&AssetBytes::copy_from(&bytes)).unwrap();
    }
}

#[test]
fn bytes_must_begin_at_a_multiple_of_32() {
    let bytes = baked(KINDS[0]);
    let mut shifted = vec![0; bytes.len() + 64];
    let first = shifted.as_ptr().addr().next_multiple_of(32) - shifted.as_ptr().addr();
    for by in 1..32 {
        let at = first + by;
        shifted[at..at + bytes.len()].copy_from_slice(&bytes);
        let error = Asset::new(&shifted[at..at + bytes.len()]).expect_err("accepted");
        assert_eq!(error, AssetError::Unaligned);
    }
}

#[test]
fn the_frame() {
    assert_eq!(refused(|b| b[0] ^= 1), AssetError::Magic);
    assert_eq!(refused(|b| b[7] = b'\r'), AssetError::Magic);
    assert_eq!(refused(|b| put(b, 8, 2)), AssetError::Version { found: 2 });
    assert_eq!(
        refused(|b| put(b, 8, 1 << 24)),
        AssetError::Version { found: 1 << 24 }
    );
    let given = baked(KINDS[3]).len();
    let needed = given - 32;
    assert_eq!(
        refused(|b| put(b, 12, needed as u32)),
        AssetError::Trailing { needed, given }
    );
    let needed = u32::MAX as usize;
    assert_eq!(
        refused(|b| put(b, 12, u32::MAX)),
        AssetError::Truncated { needed, given }
    );
    let reserved = AssetError::Code {
        field: "reserved",
        found: 1,
    };
    assert_eq!(refused(|b| put(b, 92, 1)), reserved);
    // More bytes than the sections have, although the length says so.
    let (needed, given) = (given, given + 32);
    let longer = |b: &mut Vec<u8>| {
        b.resize(given, 0);
        put(b, 12, given as u32);
    };
    assert_eq!(refused(longer), AssetError::Trailing { needed, given });
}

#[test]
fn every_truncation_and_every_extension() {
    let bytes = baked(KINDS[2]);
    let mut longer = bytes.to_vec();
    longer.push(0);
    let (needed, given) = (bytes.len(), bytes.len() + 1);
    let error = Asset::new(&AssetBytes::copy_from(&longer)).expect_err("accepted");
    assert_eq!(error, AssetError::Trailing { needed, given });
    for given in (0..400).chain((400..needed).step_by(101)) {
        let error = Asset::new(&bytes[..given]).expect_err("accepted");
        let needed = if given < 176 { 176 } else { needed };
        assert_eq!(error, AssetError::Truncated { needed, given });
    }
}

/// FNV-1a multiplies by an odd number, so that one changed byte always changes the sum.
#[test]
fn every_flipped_bit() {
    static CUBE: &[u8] = femto::include_asset!("../../golden/cube.femto");
    let mut bytes = AssetBytes::copy_from(CUBE);
    for at in 0..CUBE.len() {
        for bit in 0..8 {
            let mut flipped = CUBE.to_vec();
            flipped[at] ^= 1 << bit;
            bytes.clone_from(&AssetBytes::copy_from(&flipped));
            let error = Asset::new(&bytes).expect_err("accepted");
            match at {
                0..8 => assert_eq!(error, AssetError::Magic),
                8..12 => assert!(matches!(error, AssetError::Version { .. })),
                12..16 => assert!(matches!(
                    error,
                    AssetError::Truncated { .. } | AssetError::Trailing { .. }
                )),
                _ => assert!(matches!(error, AssetError::Checksum { .. })),
            }
        }
    }
}

#[test]
fn sections() {
    let all = Section::ALL.into_iter().enumerate();
    for (number, section) in all {
        let at = table(number);
        let move_by = |by: u32| move |b: &mut Vec<u8>| change(b, at, by);
        assert_eq!(
            refused(move_by(4)),
            fault(section, SectionFault::Misaligned)
        );
        assert_eq!(
            refused(move_by(1 << 30)),
            fault(section, SectionFault::OutOfRange)
        );
        assert_eq!(
            refused(move_by(32_u32.wrapping_neg())),
            fault(section, SectionFault::Misplaced)
        );
        let endless = |b: &mut Vec<u8>| put(b, at + 4, u32::MAX);
        assert_eq!(refused(endless), fault(section, SectionFault::OutOfRange));
        // Not whole entries.
        if section != Section::Source {
            let shorter = |b: &mut Vec<u8>| change(b, at + 4, u32::MAX);
            assert_eq!(refused(shorter), fault(section, SectionFault::Length));
        }
    }
    // A whole entry less.
    let shorter =
        |number: usize, by: u32| refused(move |b| change(b, table(number) + 4, by.wrapping_neg()));
    assert_eq!(
        shorter(NODES, 12),
        fault(Section::Masses, SectionFault::Length)
    );
    assert_eq!(
        shorter(MASSES, 4),
        fault(Section::Masses, SectionFault::Length)
    );
    assert_eq!(shorter(ENDS, 4), AssetError::Factor(FactorError::Shape));
    // Parts of a factor, but no factor.
    let none = |b: &mut Vec<u8>| put(b, 88, 0);
    assert_eq!(refused(none), fault(Section::Order, SectionFault::Length));
}

#[test]
fn choices() {
    let code = |field, found| AssetError::Code { field, found };
    assert_eq!(refused(|b| put(b, 84, 5)), code("start", 5));
    assert_eq!(refused(|b| put(b, 84, 256)), code("start", 256));
    assert_eq!(
        refused(|b| put(b, 84, 3 | 1 << 16)),
        code("start", 3 | 1 << 16)
    );
    assert_eq!(refused(|b| put(b, 88, 5)), code("factor", 5));
}

#[test]
fn numbers_of_the_header() {
    let float = |at: usize, x: f32| refused(move |b| put(b, at, x.to_bits()));
    let wrong = AssetError::Header;
    assert_eq!(refused(|b| b[24] ^= 1), wrong(HeaderField::Fingerprint));
    let tets = word(&baked(KINDS[3]), 32);
    for wrong_tets in [0, tets + 8, tets - 8, u32::MAX] {
        assert_eq!(
            refused(|b| put(b, 32, wrong_tets)),
            wrong(HeaderField::Tets)
        );
    }
    for unit in [0.3, 0.0, -0.25, f32::INFINITY, f32::NAN, 1e-40] {
        assert_eq!(float(44, unit), wrong(HeaderField::LengthUnit));
        assert_eq!(float(48, unit), wrong(HeaderField::MassUnit));
    }
    for mass in [62.0, -62.0, f32::NAN, f32::INFINITY] {
        assert_eq!(float(52, mass), wrong(HeaderField::TotalMass));
    }
    let material = AssetError::Material;
    assert_eq!(float(36, -1.0), material(MaterialError::Alpha(-1.0)));
    assert_eq!(
        float(40, f32::INFINITY),
        material(MaterialError::Beta(f32::INFINITY))
    );
    assert_eq!(float(56, 0.0), material(MaterialError::Young(0.0)));
    assert_eq!(float(60, 0.5), material(MaterialError::Poisson(0.5)));
    assert_eq!(float(64, -1.0), material(MaterialError::Density(-1.0)));
    assert_eq!(float(68, 0.0), AssetError::Settings(SettingsError::Dt(0.0)));
    assert_eq!(
        float(72, 0.4),
        AssetError::Settings(SettingsError::Theta(0.4))
    );
}

#[test]
fn numbers_of_the_sections() {
    let float = |section: usize, at: usize, x: f32| {
        refused(move |b| {
            let at = start(b, section) + at;
            put(b, at, x.to_bits());
        })
    };
    for x in [f32::NAN, f32::INFINITY] {
        assert_eq!(float(NODES, 12 * 5 + 8, x), AssetError::Node { node: 5 });
    }
    assert_eq!(
        float(NODES, 0, 0.5),
        AssetError::Header(HeaderField::Fingerprint)
    );
    for x in [f32::NAN, f32::INFINITY, 0.0, -1.0, 1e-40] {
        assert_eq!(float(MASSES, 4 * 7, x), AssetError::Mass { node: 7 });
    }
    let stiffness = AssetError::Stiffness { tet: 8 + 3 };
    for x in [f32::NAN, f32::INFINITY, 1e30] {
        assert_eq!(float(BLOCKS, BLOCK + GRADIENTS + 4 * 3, x), stiffness);
        assert_eq!(
            float(BLOCKS, BLOCK + GRADIENTS + 8 * 32 + 4 * 3, x),
            stiffness
        );
    }
    for x in [f32::NAN, f32::INFINITY, -1e10] {
        assert_eq!(float(BLOCKS, BLOCK + LAMBDA + 4 * 3, x), stiffness);
    }
    for x in [f32::NAN, f32::INFINITY, 0.0, -1.0, 1e-40] {
        assert_eq!(float(BLOCKS, BLOCK + MU + 4 * 3, x), stiffness);
    }
    // 142 tetrahedra in 18 blocks: the last two lanes fill.
    for at in [0, GRADIENTS, LAMBDA, MU] {
        let padding = float(BLOCKS, 17 * BLOCK + at + 4 * 7, 1.0);
        assert_eq!(padding, AssetError::Padding { tet: 143 });
    }
}

#[test]
fn indices_and_text() {
    let whole = |section: usize, at: usize, x: u32| {
        refused(move |b| {
            let at = start(b, section) + at;
            put(b, at, x);
        })
    };
    let bytes = baked(KINDS[3]);
    let nodes = word(&bytes, table(NODES) + 4) / 12;
    for node in [nodes, u32::MAX] {
        assert_eq!(
            whole(BLOCKS, 4 * 2, node),
            AssetError::Corner { tet: 2, node }
        );
        assert_eq!(whole(PINS, 16, node), AssetError::Pin { pin: 1 });
    }
    let node = word(&bytes, start(&bytes, BLOCKS) + 4 * 2);
    let repeated = AssetError::Corner { tet: 2, node };
    assert_eq!(whole(BLOCKS, 3 * 32 + 4 * 2, node), repeated);
    assert_eq!(whole(PINS, 16, 0), AssetError::Pin { pin: 1 });
    assert_eq!(
        whole(PINS, 4, f32::NAN.to_bits()),
        AssetError::Pin { pin: 0 }
    );
    assert_eq!(whole(SOURCE, 0, u32::MAX), AssetError::Source);
    assert_eq!(
        whole(ORDER, 0, u32::MAX),
        AssetError::Factor(FactorError::Node { place: 0 })
    );
    assert_eq!(
        whole(ENDS, 0, u32::MAX),
        AssetError::Factor(FactorError::Shape)
    );
}

#[test]
fn factors() {
    for (kind, infinity) in [(1, 0x7f80_0000), (2, 0x7c00), (3, 0x7f80_0000), (4, 0x7c00)] {
        let put_first = |section: usize, x: u32| {
            refused_of(kind, move |b| {
                let at = start(b, section);
                put(b, at, x);
            })
        };
        let pivot = AssetError::Factor(FactorError::Pivot { node: 0 });
        assert_eq!(put_first(PIVOTS, (-1.0_f32).to_bits()), pivot);
        let entry = AssetError::Factor(FactorError::Entry { place: 0 });
        assert_eq!(put_first(LOWER, infinity), entry);
    }
    // A factor of one kind taken for another.
    let other = refused(|b| put(b, 88, 1));
    assert!(matches!(
        other,
        AssetError::Section {
            section: Section::Pivots,
            ..
        } | AssetError::Factor(_)
    ));
}
