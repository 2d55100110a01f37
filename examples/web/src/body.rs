//! One body: its asset, its state, its scratch, and what acts on it.

use alloc::rc::Rc;
use alloc::vec::Vec;

use femto::body::StateRef;
use femto::energy::StateHash;
use femto::glam::Vec3;
use femto::owned::{OwnedState, OwnedWorkspace};
#[cfg(feature = "two-level")]
use femto::preconditioner::aggregate::{Aggregates, DEFAULT_AGGREGATES};
use femto::rest::Rest;
use femto::settings::Needs;
use femto::{Asset, Budget, Collider, Pin, Preconditioner, Scene, Settings, Start, StepReport};

use femto_web_step::step;

use crate::fault::{Fault, fault};
use crate::loaded::Loaded;

/// Iterations, and sweeps, of a step at most: more would look to a page like a hang.
const MOST: u32 = 10_000;
/// The preconditioner that needs aggregates.
#[cfg(feature = "two-level")]
const TWO_LEVEL: u32 = 5;
/// Past velocities that a start can use, at most.
const MOST_HISTORY: u32 = 8;

/// A body's settings but for the preconditioner, which borrows from the asset.
#[derive(Clone, Copy, Debug)]
pub struct Choice {
    pub settings: Settings<'static>,
    /// 0 identity, 1 mass, 2 Jacobi, 3 block Jacobi, 4 the asset's factor, 5 two-level
    pub preconditioner: u32,
}

impl Choice {
    pub fn new(
        dt: f32,
        theta: f32,
        [iterations, polar_sweeps, start, preconditioner]: [u32; 4],
    ) -> Result<Self, Fault> {
        if iterations > MOST {
            return Err(fault!(
                "iterations {0} must be at most {1}",
                iterations,
                MOST
            ));
        }
        if polar_sweeps > MOST {
            return Err(fault!("sweeps {0} must be at most {1}", polar_sweeps, MOST));
        }
        let settings = Settings::new(dt)
            .and_then(|settings| settings.with_theta(theta))?
            .with_start(start_of(start)?)
            .with_budget(Budget {
                iterations,
                polar_sweeps,
            });
        Ok(Self {
            settings,
            preconditioner,
        })
    }

    /// With what the preconditioner borrows: the factor, or the aggregates of the nodes.
    #[inline(never)]
    fn for_asset<'a>(
        &self,
        asset: &'a Asset<'a>,
        #[cfg_attr(not(feature = "two-level"), expect(unused))] aggregates: &'a [u8],
    ) -> Result<Settings<'a>, Fault> {
        let preconditioner = match self.preconditioner {
            0 => Preconditioner::Identity,
            1 => Preconditioner::Mass,
            2 => Preconditioner::Jacobi,
            3 => Preconditioner::BlockJacobi,
            #[cfg(feature = "factors")]
            4 => match &asset.factor {
                Some(factor) => Preconditioner::Factored(factor),
                None => return Err(fault!("the asset has no factor")),
            },
            #[cfg(feature = "two-level")]
            TWO_LEVEL => Preconditioner::TwoLevel(
                Aggregates::new(aggregates, DEFAULT_AGGREGATES)
                    .map_err(|_| fault!("the aggregates do not fit"))?,
            ),
            code => {
                return Err(fault!("preconditioner {0} does not exist", code, 0.0));
            }
        };
        #[cfg(not(feature = "factors"))]
        let _ = asset;
        let settings: Settings<'a> = self.settings;
        Ok(settings.with_preconditioner(preconditioner))
    }
}

/// As in an asset: 0 zero, 1 velocity, 2 velocity-force, 3 + 256m galerkin-m, 4 + 256m rigid-m.
fn start_of(code: u32) -> Result<Start, Fault> {
    let (kind, m) = (code & 0xff, code >> 8);
    let history = u8::try_from(m).ok().filter(|_| m <= MOST_HISTORY);
    match (kind, history) {
        (0, Some(0)) => Ok(Start::Zero),
        (1, Some(0)) => Ok(Start::Velocity),
        (2, Some(0)) => Ok(Start::VelocityForce),
        (3, Some(m)) => Ok(Start::Galerkin(m)),
        (4, Some(m)) => Ok(Start::Rigid(m)),
        (3 | 4, None) => Err(fault!(
            "a start has at most {1} past velocities, not {0}",
            m,
            MOST_HISTORY
        )),
        _ => Err(fault!("start {0} does not exist", code, 0.0)),
    }
}

/// The code of a start.
pub fn code_of(start: Start) -> u32 {
    match start {
        Start::Velocity => 1,
        Start::VelocityForce => 2,
        Start::Galerkin(m) => 3 + 256 * u32::from(m),
        Start::Rigid(m) => 4 + 256 * u32::from(m),
        _ => 0,
    }
}

pub struct Body {
    asset: Rc<Loaded>,
    state: OwnedState,
    workspace: OwnedWorkspace,
    choice: Choice,
    /// What state and workspace were made for.
    needs: Needs,
    /// The aggregate of each node, once the two-level preconditioner was chosen.
    aggregates: Vec<u8>,
    pub gravity: Vec3,
    pub pins: Vec<Pin>,
    pub colliders: Vec<Collider<'static>>,
    pub forces: Vec<[f32; 3]>,
}

/// Once in the module, not once for every caller.
#[inline(never)]
fn state(rest: &Rest<'_>, needs: Needs) -> OwnedState {
    OwnedState::new(rest, needs)
}

#[inline(never)]
fn workspace(rest: &Rest<'_>, needs: Needs) -> OwnedWorkspace {
    OwnedWorkspace::new(rest, needs)
}

/// A snapshot.
pub type Saved = OwnedState;

impl Body {
    /// At rest in the rest shape, held by the asset's pins, with its settings and the preconditioner Jacobi.
    pub fn new(asset: Rc<Loaded>) -> Self {
        let held = asset.borrow_dependent();
        let settings = held.metadata.settings;
        let needs = Needs::from(settings.start);
        Self {
            state: state(&held.rest, needs),
            workspace: workspace(&held.rest, needs),
            needs,
            choice: Choice {
                settings,
                preconditioner: 2,
            },
            gravity: Vec3::new(0.0, -9.81, 0.0),
            aggregates: Vec::new(),
            pins: held.pins.to_vec(),
            colliders: Vec::new(),
            forces: Vec::new(),
            asset,
        }
    }

    pub fn loaded(&self) -> &Rc<Loaded> {
        &self.asset
    }

    pub fn asset(&self) -> &Asset<'_> {
        self.asset.borrow_dependent()
    }

    fn rest(&self) -> Rest<'_> {
        self.asset().rest
    }

    pub fn state(&self) -> StateRef<'_> {
        self.state.view()
    }

    /// Takes another asset of the same mesh: another material. Positions and velocities stay.
    pub fn use_asset(&mut self, asset: Rc<Loaded>) -> Result<(), Fault> {
        let (old, new) = (self.rest(), asset.borrow_dependent());
        if old.header.fingerprint != new.rest.header.fingerprint
            || old.nodes.len() != new.rest.nodes.len()
        {
            return Err(fault!("the asset is of another mesh"));
        }
        self.choice.for_asset(new, &self.aggregates)?;
        self.asset = asset;
        Ok(())
    }

    /// Takes other settings. Where the start needs another history, the old one is forgotten.
    pub fn set(&mut self, choice: Choice) -> Result<(), Fault> {
        let asset = self.asset.borrow_dependent();
        #[cfg(feature = "two-level")]
        if choice.preconditioner == TWO_LEVEL && self.aggregates.is_empty() {
            let mut aggregates = alloc::vec![0; asset.rest.nodes.len()];
            Aggregates::divide(&asset.rest, DEFAULT_AGGREGATES, &mut aggregates)
                .map_err(|_| fault!("the aggregates do not fit"))?;
            self.aggregates = aggregates;
        }
        let old = self.needs;
        let new = Needs::from(&choice.for_asset(asset, &self.aggregates)?);
        if old.history != new.history {
            let mut state = state(&asset.rest, new);
            let (mut to, from) = (state.view_mut(), self.state.view());
            to.place(&asset.rest, from.x, from.v)?;
            to.rotations.copy_from_slice(from.rotations);
            self.state = state;
        }
        if old != new {
            self.workspace = workspace(&asset.rest, new);
        }
        (self.choice, self.needs) = (choice, new);
        Ok(())
    }

    /// Advances by one step, and the colliders with it.
    pub fn step(&mut self) -> Result<StepReport, Fault> {
        let asset = self.asset.borrow_dependent();
        let settings = self.choice.for_asset(asset, &self.aggregates)?;
        let scene = Scene {
            gravity: self.gravity,
            forces: &self.forces,
            pins: &self.pins,
            colliders: &self.colliders,
        };
        let report = step(
            &asset.rest,
            &mut self.state.view_mut(),
            &mut self.workspace.view_mut(&asset.rest),
            &scene,
            &settings,
        );
        if report.advanced() {
            for collider in &mut self.colliders {
                collider.advance(settings.dt());
            }
        }
        Ok(report)
    }

    pub fn place(&mut self, x: &[[f32; 3]], v: &[[f32; 3]]) -> Result<(), Fault> {
        let rest = self.asset.borrow_dependent().rest;
        Ok(self.state.view_mut().place(&rest, x, v)?)
    }

    pub fn save(&self) -> Saved {
        self.state.clone()
    }

    pub fn restore(&mut self, saved: &Saved) -> Result<(), Fault> {
        let (here, there) = (self.state.view(), saved.view());
        if here.x.len() != there.x.len()
            || here.history.len() != there.history.len()
            || here.rotations.len() != there.rotations.len()
        {
            return Err(fault!(
                "the snapshot is of another body, or of another start"
            ));
        }
        self.state.clone_from(saved);
        Ok(())
    }

    pub fn hash(&self) -> u64 {
        let state = self.state();
        StateHash::new().with(state.x, state.v).value()
    }

    /// Kinetic, elastic and potential energy, linear and angular momentum, the smallest det F.
    #[cfg(feature = "measures")]
    pub fn measure(&self) -> [f64; 10] {
        use femto::energy::{energies, min_det, momenta};
        let (rest, state) = (self.rest(), self.state());
        let energies = energies(&rest, &state, self.gravity);
        let momenta = momenta(&rest, &state);
        let ([px, py, pz], [lx, ly, lz]) = (momenta.linear, momenta.angular);
        [
            energies.kinetic,
            energies.elastic,
            energies.potential,
            px,
            py,
            pz,
            lx,
            ly,
            lz,
            min_det(&rest, &state),
        ]
    }
}
