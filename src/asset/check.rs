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
            let tet = Tet::of(block, lane);
            if number < tets {
                tet.check(number, rest.nodes.len())?;
            } else if !tet.is_zero() {
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
    let wrong = [
        (!is_unit(header.length_unit), HeaderField::LengthUnit),
        (!is_unit(header.mass_unit), HeaderField::MassUnit),
        (
            to_f32(total) != header.total_mass || !header.total_mass.is_finite(),
            HeaderField::TotalMass,
        ),
        (
            fingerprint(rest.nodes, rest.tets()) != header.fingerprint,
            HeaderField::Fingerprint,
        ),
    ];
    let first = wrong.into_iter().find(|(wrong, _)| *wrong);
    first.map_or(Ok(()), |(_, field)| Err(AssetError::Header(field)))
}

/// One tetrahedron of a block.
struct Tet {
    corners: [u32; 4],
    gradients: [[f32; 3]; 3],
    lambda_v: f32,
    mu_v: f32,
}

impl Tet {
    fn of(block: &TetBlock, lane: usize) -> Self {
        Self {
            corners: block.corners.map(|corner| corner[lane % BLOCK]),
            gradients: block.gradients.map(|g| g.map(|axis| axis[lane % BLOCK])),
            lambda_v: block.lambda_v[lane % BLOCK],
            mu_v: block.mu_v[lane % BLOCK],
        }
    }

    fn check(&self, tet: u32, nodes: usize) -> Result<(), AssetError> {
        for (corner, &node) in self.corners.iter().enumerate() {
            let before = self.corners.iter().take(corner);
            if node as usize >= nodes || before.into_iter().any(|&other| other == node) {
                return Err(AssetError::Corner { tet, node });
            }
        }
        let (lambda, mu) = (self.lambda_v, self.mu_v);
        // |g₀|² is at most three times the sum of the others'; NaN and infinity fail here too.
        let mut square = 0.0;
        for g in self.gradients.as_flattened() {
            square += 4.0 * g * g;
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

    fn is_zero(&self) -> bool {
        let numbers = self.gradients.as_flattened().iter();
        self.corners == [0; 4]
            && numbers
                .chain([&self.lambda_v, &self.mu_v])
                .all(|x| x.to_bits() == 0)
    }
}
