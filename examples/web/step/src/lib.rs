//! What a step spends its time in is generic, and so is compiled with the package that names its types: this one.
#![no_std]

use femto::body::{StateMut, WorkspaceMut};
use femto::element::Factored;
use femto::lane::Native;
use femto::rest::Rest;
use femto::{Scene, Settings, StepReport};

/// [`femto::step::step`] in the lanes of this build.
pub fn step(
    rest: &Rest<'_>,
    state: &mut StateMut<'_>,
    work: &mut WorkspaceMut<'_>,
    scene: &Scene<'_>,
    settings: &Settings<'_>,
) -> StepReport {
    femto::step::step::<Native, Factored>(rest, state, work, scene, settings)
}
