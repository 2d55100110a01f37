//! What an asset says, checked: the same for reading and for writing.

use super::{Asset, AssetError, HeaderField, Section, SectionFault};
use crate::lane::{BLOCK, blocks};
use crate::math::power_of_two_below;
use crate::rest::{Rest, TetBlock, fingerprint, to_f32};

impl Asset<'_> {
    /// Everything that a step relies on.
    pub(super) fn check(&self) -> Result<(), AssetError> {
        check_nodes(&self.rest)?;
        check_blocks(&self.rest)?;
        check_header(&self.rest)?;
        let mut least = 0;
        for (place, pin) in (0_u32..).zip(self.pins) {
            let known = (least..self.nodes()).contains(&(pin.node as usize));
            if !(known && pin.velocity.is_finite()) {
                return Err(AssetError::Pin { pin: place });
            }
            least = pin.node as usize + 1;
        }
        let (header, material) = (self.rest.header, self.metadata.material);
        if (header.alpha, header.beta) != (material.alpha(), material.beta()) {
            return Err(AssetError::Header(HeaderField::Damping));
        }
        match self.factor {
            Some(factor)
                if factor.nodes() != self.nodes() || factor.fingerprint() != header.fingerprint =>
            {
                Err(AssetError::ForeignFactor)
            }
            _ => Ok(()),
        }
    }

    fn nodes(&self) -> usize {
        self.rest.nodes.len()
    }
}

fn check_nodes(rest: &Rest<'_>) -> Result<(), AssetError> {
    let wrong_length = |section| AssetError::Section {
        section,
        fault: SectionFault::Length,
    };
    let nodes = rest.nodes.len();
    if nodes == 0 || u32::try_from(nodes).is_err() {
        return Err(wrong_length(Section::Nodes));
    }
    if rest.masses.len() != nodes {
        return Err(wrong_length(Section::Masses));
    }
    for (node, (x, &mass)) in (0_u32..).zip(rest.nodes.iter().zip(rest.masses)) {
        if !x.iter().all(|x| x.is_finite()) {
            return Err(AssetError::Node { node });
        }
        if !(mass > 0.0 && mass.is_normal()) {
            return Err(AssetError::Mass { node });
        }
    }
    Ok(())
}

fn check_blocks(rest: &Rest<'_>) -> Result<(), AssetError> {
    let tets = rest.header.tets;
    if tets == 0 || usize::try_from(tets).map(blocks) != Ok(rest.blocks.len()) {
        return Err(AssetError::Header(HeaderField::Tets));
    }
    let mut number = 0;
    for block in rest.blocks {
        for lane in 0..BLOCK {
            if number < tets {
                check_tet(block, lane, number, rest.nodes.len())?;
            } else if !is_zero(block, lane) {
                return Err(AssetError::Padding { tet: number });
            }
            number += 1;
        }
    }
    Ok(())
}

fn check_header(rest: &Rest<'_>) -> Result<(), AssetError> {
    let header = rest.header;
    let mut total = 0.0;
    for &mass in rest.masses {
        total += f64::from(mass);
    }
    let is_unit = |x: f32| x >= f32::MIN_POSITIVE && x.is_finite() && power_of_two_below(x) == x;
    let field = if !is_unit(header.length_unit) {
        HeaderField::LengthUnit
    } else if !is_unit(header.mass_unit) {
        HeaderField::MassUnit
    } else if to_f32(total) != header.total_mass || !header.total_mass.is_finite() {
        HeaderField::TotalMass
    } else if fingerprint(rest.nodes, rest.tets()) != header.fingerprint {
        HeaderField::Fingerprint
    } else {
        return Ok(());
    };
    Err(AssetError::Header(field))
}

fn check_tet(block: &TetBlock, lane: usize, tet: u32, nodes: usize) -> Result<(), AssetError> {
    let lane = lane % BLOCK;
    let corners = block.corners.map(|corner| corner[lane]);
    for (corner, &node) in corners.iter().enumerate() {
        let mut before = corners.iter().take(corner);
        if node as usize >= nodes || before.any(|&other| other == node) {
            return Err(AssetError::Corner { tet, node });
        }
    }
    let (lambda, mu) = (block.lambda_v[lane], block.mu_v[lane]);
    // |g₀|² is at most three times the sum of the others'; NaN and infinity fail here too.
    let mut square = 0.0;
    for g in block.gradients.as_flattened() {
        square += 4.0 * g[lane] * g[lane];
    }
    let stiffness = 2.0 * square * (lambda.abs() + 2.0 * mu);
    // Each of the two numbers was rounded once, by half an ε of itself.
    let definite = 3.0 * f64::from(lambda) + 2.0 * f64::from(mu)
        >= -2.0 * f64::from(f32::EPSILON) * f64::from(mu);
    if mu > 0.0 && mu.is_normal() && stiffness.is_finite() && definite {
        Ok(())
    } else {
        Err(AssetError::Stiffness { tet })
    }
}

/// Whether every number of a tetrahedron is 0, all bits.
fn is_zero(block: &TetBlock, lane: usize) -> bool {
    const ROWS: usize = size_of::<TetBlock>() / size_of::<[u32; BLOCK]>();
    let rows: &[[u32; BLOCK]; ROWS] = bytemuck::cast_ref(block);
    rows.iter().all(|row| row[lane % BLOCK] == 0)
}
