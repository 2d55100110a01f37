//! The two-level preconditioner: what a step pays for it, and what an iteration.

use femto::element::{Factored, Sym3};
use femto::lane::Lanes;
use femto::preconditioner::aggregate::DEFAULT_AGGREGATES;
use femto::preconditioner::{Aggregates, Preconditioner, Prepared, Room};
use femto::settings::Settings;

use crate::clock::Kernel;
use crate::kernels::{Body, DT, Stepper};

pub const PREPARE: &str = "two-level, coarse matrix and factor";
pub const APPLY: &str = "two-level, one application";
pub const STEP: &str = "step Galerkin(1), factored, two-level";

/// The aggregates of a body, and its matrix' diagonal blocks.
pub struct Coarse {
    of: Vec<u8>,
    filter: Vec<Sym3<f32>>,
    diagonal: Vec<Sym3<f32>>,
}

impl Coarse {
    pub fn new(body: &Body<Factored>) -> Self {
        let nodes = body.x.len();
        let mut of = vec![0; nodes];
        Aggregates::divide(&body.rest.view(), DEFAULT_AGGREGATES, &mut of).expect("few aggregates");
        let mut diagonal = vec![[0.0; 6]; nodes];
        body.operator().diagonal::<f32>(&mut diagonal);
        Self {
            of,
            filter: vec![femto::constraint::FREE; nodes],
            diagonal,
        }
    }

    fn preconditioner(&self) -> Preconditioner<'_> {
        let aggregates = Aggregates::new(&self.of, DEFAULT_AGGREGATES);
        Preconditioner::TwoLevel(aggregates.expect("made by the library"))
    }
}

/// What a prepared preconditioner reads, and scratch.
struct Storage {
    blocks: Vec<Sym3<f32>>,
    coarse: Vec<f32>,
    scratch: Vec<[f32; 3]>,
}

impl Storage {
    fn new(coarse: &Coarse) -> Self {
        Self {
            blocks: coarse.diagonal.clone(),
            coarse: vec![0.0; coarse.preconditioner().coarse_length()],
            scratch: vec![[0.0; 3]; coarse.of.len()],
        }
    }

    fn prepare<'a, R: Lanes>(
        &'a mut self,
        body: &'a Body<Factored>,
        coarse: &'a Coarse,
    ) -> Prepared<'a> {
        self.blocks.copy_from_slice(&coarse.diagonal);
        let room = Room {
            blocks: &mut self.blocks,
            coarse: &mut self.coarse,
        };
        coarse.preconditioner().prepare::<R, Factored>(
            &body.operator(),
            &body.x,
            &body.rotations,
            (&coarse.filter, false),
            room,
            &mut self.scratch,
        )
    }
}

pub fn two_level<'a, R: Lanes + 'a>(
    body: &'a Body<Factored>,
    coarse: &'a Coarse,
) -> Vec<Kernel<'a>> {
    let mut storage = Storage::new(coarse);
    let prepare = move || {
        storage.prepare::<R>(body, coarse);
    };
    // Prepared in lanes or not, an application is the same.
    let (storage, mut z) = (Storage::new(coarse), vec![[0.0; 3]; body.x.len()]);
    let prepared = Box::leak(Box::new(storage)).prepare::<R>(body, coarse);
    let settings = Settings::new(DT)
        .expect("a positive time step")
        .with_preconditioner(coarse.preconditioner());
    vec![
        Kernel::new(PREPARE, R::WIDTH, prepare),
        Kernel::new(APPLY, R::WIDTH, move || {
            prepared.apply(&coarse.filter, &body.v, &mut z)
        }),
        Kernel::after(
            STEP,
            R::WIDTH,
            body.stepper(settings),
            Stepper::reset,
            Stepper::step::<R>,
        ),
    ]
}
