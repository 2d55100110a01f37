//! What plastic flow and fracture add to a step, where a state has room for them; nothing where it has not.

#[cfg(any(feature = "plasticity", feature = "fracture"))]
use core::iter::repeat;

use crate::body::StateMut;
use crate::element::Layout;
#[cfg(feature = "fracture")]
use crate::fracture::{self, BrokenBlock};
use crate::lane::Lanes;
use crate::operator::rotate;
#[cfg(feature = "fracture")]
use crate::operator::rotate_shares;
#[cfg(feature = "plasticity")]
use crate::plasticity;
#[cfg(all(feature = "fracture", feature = "plasticity"))]
use crate::plasticity::PlasticBlock;
use crate::report::{Refusal, StepReport};
use crate::rest::Rest;
use crate::settings::Settings;

/// How much of the tetrahedra of a block is there: all, or nothing of those that have failed.
pub(crate) trait Share: Copy {
    /// `x` where a tetrahedron is whole, else 0.
    fn of<R: Lanes>(self, x: R, at: usize) -> R;
}

impl Share for () {
    #[inline(always)]
    fn of<R: Lanes>(self, x: R, _: usize) -> R {
        x
    }
}

#[cfg(feature = "fracture")]
impl Share for &BrokenBlock {
    #[inline(always)]
    fn of<R: Lanes>(self, x: R, at: usize) -> R {
        R::load(&self.0, at).where_below(R::splat(0.5), x, R::splat(0.0))
    }
}

/// The plastic strain of a block, where a body has one.
#[cfg(feature = "fracture")]
pub(crate) trait PlasticStrain: Copy {
    /// A stress less 2μ ε_p.
    fn relieve<R: Lanes>(self, stress: [[R; 3]; 3], mu: R, at: usize) -> [[R; 3]; 3];
}

#[cfg(feature = "fracture")]
impl PlasticStrain for () {
    #[inline(always)]
    fn relieve<R: Lanes>(self, stress: [[R; 3]; 3], _: R, _: usize) -> [[R; 3]; 3] {
        stress
    }
}

#[cfg(all(feature = "fracture", feature = "plasticity"))]
impl PlasticStrain for &PlasticBlock {
    #[inline(always)]
    fn relieve<R: Lanes>(self, s: [[R; 3]; 3], mu: R, at: usize) -> [[R; 3]; 3] {
        let [xx, xy, xz, yy, yz, zz] = self.load::<R>(at).map(|p| (mu + mu) * p);
        [
            [s[0][0] - xx, s[0][1] - xy, s[0][2] - xz],
            [s[1][0] - xy, s[1][1] - yy, s[1][2] - yz],
            [s[2][0] - xz, s[2][1] - yz, s[2][2] - zz],
        ]
    }
}

/// [`rotate`] of what is whole, and the forces of plastic strain.
pub(crate) fn rotate_state<R: Lanes, L: Layout>(
    rest: &Rest<'_, L>,
    state: &StateMut<'_>,
    scale: f32,
    rotated: &mut [L::Rotated],
    out: &mut [[f32; 3]],
) {
    #[cfg(feature = "fracture")]
    if !state.broken.is_empty() {
        let whole = state.broken.iter();
        rotate_shares::<R, L, _>(rest, state.x, state.rotations, whole, scale, rotated, out);
        #[cfg(feature = "plasticity")]
        if !state.plastic.is_empty() {
            let whole = state.broken.iter();
            plasticity::add_forces::<R, L, _>(
                rest,
                state.rotations,
                state.plastic,
                whole,
                scale,
                out,
            );
        }
        return;
    }
    rotate::<R, L>(rest, state.x, state.rotations, scale, rotated, out);
    #[cfg(feature = "plasticity")]
    if !state.plastic.is_empty() {
        plasticity::add_forces::<R, L, _>(
            rest,
            state.rotations,
            state.plastic,
            repeat(()),
            scale,
            out,
        );
    }
}

/// At the end of a step: flow, then fracture.
#[cfg_attr(
    not(any(feature = "plasticity", feature = "fracture")),
    expect(
        unused_variables,
        unused_mut,
        clippy::extra_unused_type_parameters,
        reason = "nothing to do"
    )
)]
pub(crate) fn update<R: Lanes, L: Layout>(
    rest: &Rest<'_, L>,
    state: &mut StateMut<'_>,
    settings: &Settings<'_>,
    mut report: StepReport,
) -> StepReport {
    #[cfg(feature = "plasticity")]
    if let Some(law) = &settings.plasticity {
        let (x, q, h) = (&*state.x, &*state.rotations, settings.dt());
        let flow = (h, law, settings.regions.as_ref());
        cfg_select! {
            feature = "fracture" => {
                report.dissipated = if state.broken.is_empty() {
                    plasticity::flow::<R, L, _>(rest, x, q, repeat(()), flow, state.plastic)
                } else {
                    let whole = state.broken.iter();
                    plasticity::flow::<R, L, _>(rest, x, q, whole, flow, state.plastic)
                };
            }
            _ => {
                report.dissipated =
                    plasticity::flow::<R, L, _>(rest, x, q, repeat(()), flow, state.plastic);
            }
        }
    }
    #[cfg(feature = "fracture")]
    if let Some(law) = &settings.fracture {
        let (x, q) = (&*state.x, &*state.rotations);
        let law = (law, settings.regions.as_ref());
        #[cfg(feature = "plasticity")]
        if !state.plastic.is_empty() {
            let plastic = state.plastic.iter();
            report.fracture = fracture::tear::<R, L, _>(rest, x, q, plastic, law, state.broken);
            return report;
        }
        report.fracture = fracture::tear::<R, L, _>(rest, x, q, repeat(()), law, state.broken);
    }
    report
}

/// Whether the state has room for what the settings ask for.
#[cfg_attr(
    not(any(feature = "plasticity", feature = "fracture")),
    expect(
        unused_variables,
        clippy::unnecessary_wraps,
        reason = "nothing to check"
    )
)]
pub(crate) fn check(
    blocks: usize,
    tets: usize,
    state: &StateMut<'_>,
    settings: &Settings<'_>,
) -> Result<(), Refusal> {
    #[cfg(any(feature = "plasticity", feature = "fracture"))]
    if settings
        .regions
        .is_some_and(|regions| regions.of.len() != tets)
    {
        return Err(Refusal::Storage);
    }
    #[cfg(feature = "plasticity")]
    room(
        blocks,
        state.plastic.len(),
        settings.plasticity.is_some(),
        Refusal::Plasticity,
    )?;
    #[cfg(feature = "fracture")]
    room(
        blocks,
        state.broken.len(),
        settings.fracture.is_some(),
        Refusal::Fracture,
    )?;
    Ok(())
}

#[cfg(any(feature = "plasticity", feature = "fracture"))]
fn room(blocks: usize, found: usize, asked: bool, refusal: Refusal) -> Result<(), Refusal> {
    match found {
        0 if asked => Err(refusal),
        0 => Ok(()),
        found if found == blocks => Ok(()),
        _ => Err(Refusal::Storage),
    }
}
