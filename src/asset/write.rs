//! Writing (feature `alloc`).

use alloc::vec;
use alloc::vec::Vec;

use bytemuck::{NoUninit, Pod, Zeroable};

use super::format::{self, FactorCode, FileHeader, HEADER, MAGIC, Place, VERSION};
use super::{ALIGNMENT, Asset, AssetError};
use crate::preconditioner::factor::Entries;

/// Bytes that begin at a multiple of [`ALIGNMENT`]: an asset that was written, or read from a file.
#[derive(Clone, Debug)]
pub struct AssetBytes {
    chunks: Vec<Chunk>,
    length: usize,
}

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(32))]
struct Chunk([u8; ALIGNMENT]);

impl AssetBytes {
    /// A copy of bytes from anywhere, to be given to [`Asset::new`].
    #[must_use]
    pub fn copy_from(bytes: &[u8]) -> Self {
        let mut copy = Self {
            chunks: vec![Chunk([0; ALIGNMENT]); bytes.len().div_ceil(ALIGNMENT)],
            length: bytes.len(),
        };
        let all: &mut [u8] = bytemuck::cast_slice_mut(&mut copy.chunks);
        for (to, from) in all.iter_mut().zip(bytes) {
            *to = *from;
        }
        copy
    }
}

impl core::ops::Deref for AssetBytes {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        let all: &[u8] = bytemuck::cast_slice(&self.chunks);
        all.get(..self.length).unwrap_or_default()
    }
}

impl Asset<'_> {
    /// Writes it. The fields may come from anywhere: they are checked as in [`Asset::new`].
    ///
    /// # Errors
    /// [`AssetError`]: what the bytes would be refused for.
    pub fn to_bytes(&self) -> Result<AssetBytes, AssetError> {
        if cfg!(target_endian = "big") {
            return Err(AssetError::BigEndianHost);
        }
        self.check()?;
        let mut header = self.header();
        let mut bytes = vec![0; HEADER];
        let rest = &self.rest;
        let (code, pivots, lower) = match self.factor.as_ref().map(|factor| factor.entries()) {
            None => (FactorCode::None, raw::<u8>(&[]), raw::<u8>(&[])),
            Some(Entries::Warped { pivots, lower }) => {
                (FactorCode::Warped, raw(pivots), raw(lower))
            }
            Some(Entries::WarpedHalf { pivots, lower }) => {
                (FactorCode::WarpedHalf, raw(pivots), raw(lower))
            }
            Some(Entries::Laplacian { pivots, lower }) => {
                (FactorCode::Laplacian, raw(pivots), raw(lower))
            }
            Some(Entries::LaplacianHalf { pivots, lower }) => {
                (FactorCode::LaplacianHalf, raw(pivots), raw(lower))
            }
        };
        header.factor = code.code();
        let (order, ends, rows) = self
            .factor
            .as_ref()
            .map_or_else(Default::default, |factor| {
                (factor.order(), factor.ends(), factor.rows())
            });
        let sections = [
            raw(rest.nodes),
            raw(rest.masses),
            raw(rest.blocks),
            raw(self.pins),
            self.metadata.source.as_bytes(),
            raw(order),
            raw(ends),
            raw(rows),
            pivots,
            lower,
        ];
        let pad = |bytes: &mut Vec<u8>| bytes.resize(bytes.len().next_multiple_of(ALIGNMENT), 0);
        for (section, place) in sections.into_iter().zip(&mut header.sections) {
            pad(&mut bytes);
            *place = Place {
                offset: small(bytes.len())?,
                bytes: small(section.len())?,
            };
            bytes.extend_from_slice(section);
        }
        pad(&mut bytes);
        header.bytes = small(bytes.len())?;
        write_header(&mut bytes, &header);
        header.checksum = format::checksum(&bytes);
        write_header(&mut bytes, &header);
        Ok(AssetBytes::copy_from(&bytes))
    }

    /// All but the factor's kind, sections, length and checksum.
    fn header(&self) -> FileHeader {
        let (material, settings) = (&self.metadata.material, &self.metadata.settings);
        FileHeader {
            magic: MAGIC,
            version: VERSION,
            rest: self.rest.header,
            young: material.young(),
            poisson: material.poisson(),
            density: material.density(),
            dt: settings.dt(),
            theta: settings.theta(),
            iterations: settings.budget.iterations,
            polar_sweeps: settings.budget.polar_sweeps,
            start: format::start_code(settings.start),
            ..Zeroable::zeroed()
        }
    }
}

fn raw<T: NoUninit>(entries: &[T]) -> &[u8] {
    bytemuck::cast_slice(entries)
}

fn small(bytes: usize) -> Result<u32, AssetError> {
    u32::try_from(bytes).map_err(|_| AssetError::TooLarge)
}

fn write_header(bytes: &mut [u8], header: &FileHeader) {
    for (byte, written) in bytes.iter_mut().zip(bytemuck::bytes_of(header)) {
        *byte = *written;
    }
}
