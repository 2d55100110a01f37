//! What a step asks of couplings. A step without any is compiled with `()`, which does nothing and costs nothing.

use crate::element::Sym3;
use crate::math::select;
use crate::report::Refusal;
use crate::scene::Scene;
use crate::settings::Settings;
use crate::space::{Translate, Translations};

/// What couplings need to know of a step. SI units, but for the system's.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(
    not(feature = "contact"),
    expect(dead_code, reason = "() reads nothing")
)]
pub(crate) struct CoupleStep<'a> {
    pub scene: &'a Scene<'a>,
    pub masses: &'a [f32],
    pub x: &'a [[f32; 3]],
    pub v: &'a [[f32; 3]],
    pub dt: f32,
    pub length_unit: f32,
    pub mass_unit: f32,
    pub velocity_unit: f32,
    /// Which tetrahedra have failed; empty where none can.
    #[cfg(feature = "fracture")]
    pub broken: &'a [crate::fracture::BrokenBlock],
    /// b
    pub rhs: &'a [[f32; 3]],
    /// The diagonal blocks of A.
    pub blocks: &'a [Sym3<f32>],
    /// P
    pub filter: &'a [Sym3<f32>],
    /// c, m/s
    pub targets: &'a [[f32; 3]],
}

/// What decides on the translations in W.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FreeStep<'a> {
    pub augmented: bool,
    pub pinned: bool,
    pub touched: bool,
    pub masses: &'a [f32],
    pub total_mass: f32,
    /// c_M
    pub mass_factor: f32,
}

/// Counts of a step.
#[cfg(feature = "contact")]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Counts {
    pub active: u32,
    pub dropped: u32,
}

pub(crate) trait Couple {
    /// Whether there can be any.
    const SOME: bool;
    fn check(
        &self,
        nodes: usize,
        scene: &Scene<'_>,
        settings: &Settings<'_>,
    ) -> Result<(), Refusal>;
    /// What colliders touch by their nodes: all before those of rigid bodies.
    fn touched<'a>(&self, masses: &'a [f32]) -> &'a [f32];
    /// Reads off where the rigid bodies are.
    fn locate(&mut self, x: &[[f32; 3]]);
    /// Finds and decides. `kept` is A v(t) (SI units but for A) and is overwritten.
    fn decide(&mut self, step: &CoupleStep<'_>, kept: &mut [[f32; 3]]);
    /// Of what nothing holds.
    type Free<'a>: Translate;
    fn translations<'a>(
        &mut self,
        step: &FreeStep<'a>,
        filter: &[Sym3<f32>],
    ) -> Option<Self::Free<'a>>;
    /// Adds to A's diagonal and to b.
    fn add_to(&self, blocks: &mut [Sym3<f32>], rhs: &mut [[f32; 3]]);
    /// `out` += W ᵀB W u
    fn apply(&self, u: &[[f32; 3]], out: &mut [[f32; 3]]);
    /// Lets go of contacts that pull at `v`; if `back`, those that were let go and would push are back. b − A `v` in `r`
    /// and the products A w follow. Returns whether there were any.
    fn switch(
        &mut self,
        v: &[[f32; 3]],
        r: &mut [[f32; 3]],
        space: [&mut [[f32; 3]]; 2],
        back: bool,
    ) -> bool;
    /// Projects on the rigid bodies' motions.
    fn project(&self, u: &mut [[f32; 3]]);
    /// Given v⁺ in m/s: notes impulses (units of N·s), puts rigid bodies on their shape.
    fn place(
        &mut self,
        h: f32,
        impulse_unit: f32,
        velocity_unit: f32,
        x: &mut [[f32; 3]],
        v: &mut [[f32; 3]],
    );
    #[cfg(feature = "contact")]
    fn counts(&self) -> Counts;
}

impl Couple for () {
    const SOME: bool = false;
    fn check(&self, _: usize, _: &Scene<'_>, _: &Settings<'_>) -> Result<(), Refusal> {
        Ok(())
    }
    #[inline(always)]
    fn touched<'a>(&self, masses: &'a [f32]) -> &'a [f32] {
        masses
    }
    fn locate(&mut self, _: &[[f32; 3]]) {}
    fn decide(&mut self, _: &CoupleStep<'_>, _: &mut [[f32; 3]]) {}
    type Free<'a> = Translations<'a>;
    fn translations<'a>(
        &mut self,
        step: &FreeStep<'a>,
        _: &[Sym3<f32>],
    ) -> Option<Translations<'a>> {
        (step.augmented && !step.pinned).then_some(Translations {
            masses: step.masses,
            mass_factor: step.mass_factor,
            per_mass: select(!step.touched, 1.0 / step.total_mass, 0.0),
        })
    }
    fn add_to(&self, _: &mut [Sym3<f32>], _: &mut [[f32; 3]]) {}
    #[inline(always)]
    fn apply(&self, _: &[[f32; 3]], _: &mut [[f32; 3]]) {}
    fn switch(
        &mut self,
        _: &[[f32; 3]],
        _: &mut [[f32; 3]],
        _: [&mut [[f32; 3]]; 2],
        _: bool,
    ) -> bool {
        false
    }
    #[inline(always)]
    fn project(&self, _: &mut [[f32; 3]]) {}
    fn place(&mut self, _: f32, _: f32, _: f32, _: &mut [[f32; 3]], _: &mut [[f32; 3]]) {}
    #[cfg(feature = "contact")]
    fn counts(&self) -> Counts {
        Counts::default()
    }
}
