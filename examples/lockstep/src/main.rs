//! Lockstep with rollback, as games play it over a network. Two players each push a soft cube about; each machine
//! simulates, and they exchange nothing but inputs.
//!
//! The first machine hears the other's inputs at once. The second hears them [`DELAY`] steps late: it goes on with
//! the last one that it knows, and when the true one arrives and differs, it goes back to its snapshot and replays.
//! After every step the states whose inputs are all known must be equal to the bit, for 10,000 steps. Prints what
//! rollback costs, as a multiple of the time without. Exits with 1 where a bit differs.

use std::collections::VecDeque;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use femto::energy::StateHash;
use femto::glam::Vec3;
use femto::owned::OwnedState;
use femto::{Collider, Material, Mesh, OwnedBody, Scene, Settings, Start};
use femto_cases::mesh::Grid;

const STEPS: usize = 10_000;
/// Steps until an input arrives, and so the length of a rollback.
const DELAY: usize = 8;
const NODES: usize = 64;

static CUBE: Grid<NODES, 162> = Grid::new([3, 3, 3]);

/// What a player does in a step: which of eight directions to push in, if any.
type Input = Option<u8>;

/// The players' inputs at a step: they change every few steps, at moments of their own.
fn inputs(step: usize) -> [Input; 2] {
    let choice = |period: usize, seed: usize| {
        let turn = (step / period + seed).wrapping_mul(2_654_435_761) >> 7;
        (!turn.is_multiple_of(3)).then_some((turn % 8) as u8)
    };
    [choice(5, 1), choice(23, 7)]
}

/// One machine.
struct Player {
    body: OwnedBody,
    settings: Settings<'static>,
    colliders: [Collider<'static>; 1],
}

impl Player {
    fn new() -> Result<Self, Box<dyn std::error::Error>> {
        let settings = Settings::new(1.0 / 60.0)?.with_start(Start::Galerkin(2));
        let mesh = Mesh::new(&CUBE.nodes, &CUBE.tets)?;
        let material = Material::new(5e4, 0.4, 1000.0)?.with_damping(0.1, 1e-3)?;
        Ok(Self {
            body: OwnedBody::new(&mesh, &material, settings.start)?,
            settings,
            colliders: [Collider::half_space(Vec3::Y, -0.5)?.with_friction(0.5)?],
        })
    }

    /// One step. Each player pushes one half of the cube's nodes.
    fn step(&mut self, inputs: [Input; 2]) {
        let force = |input: Input| {
            let sign = |bit: u8| {
                if input.unwrap_or(0) >> bit & 1 == 0 {
                    -1.0
                } else {
                    1.0
                }
            };
            let size = if input.is_some() { 3.0 } else { 0.0 };
            [size * sign(0), size * 0.5 * sign(1), size * sign(2)]
        };
        let [first, second] = inputs.map(force);
        let forces: [_; NODES] =
            std::array::from_fn(|n| if n < NODES / 2 { first } else { second });
        let scene = Scene {
            gravity: Vec3::new(0.0, -9.81, 0.0),
            forces: &forces,
            colliders: &self.colliders,
            ..Scene::default()
        };
        // A refused step would be refused on both machines.
        _ = self.body.step(&scene, &self.settings);
    }
}

/// The machine that hears late.
struct Late {
    player: Player,
    /// The states before the last steps, the oldest first, and what inputs those steps were simulated with.
    recent: VecDeque<(OwnedState, [Input; 2])>,
    rollbacks: usize,
}

impl Late {
    /// Simulates step `now` with the last input of the other player's that is known.
    fn step(&mut self, now: usize) {
        let known = now.checked_sub(DELAY).and_then(|then| inputs(then)[0]);
        let input = [known, inputs(now)[1]];
        self.recent
            .push_back((self.player.body.state().clone(), input));
        self.player.step(input);
    }

    /// The other's input of the oldest recent step arrives: where it is not what was assumed, all recent steps are
    /// taken again. Returns the state before that step, which nothing can change any more.
    fn arrive(&mut self, step: usize) -> Option<OwnedState> {
        let (_, assumed) = self.recent.front()?;
        let input = inputs(step)[0];
        if assumed[0] != input {
            self.recent
                .iter_mut()
                .for_each(|(_, assumed)| assumed[0] = input);
            self.replay();
            self.rollbacks += 1;
        }
        self.recent.pop_front().map(|(state, _)| state)
    }

    /// Goes back to the oldest recent state, and takes all steps since then again.
    fn replay(&mut self) {
        if let Some((state, _)) = self.recent.front() {
            self.player.body.state_mut().clone_from(state);
        }
        for (state, input) in &mut self.recent {
            state.clone_from(self.player.body.state());
            self.player.step(*input);
        }
    }
}

/// Equal to the bit; `==` on numbers would take −0 for 0.
fn same(a: &OwnedState, b: &OwnedState) -> bool {
    let hash = |state: &OwnedState| StateHash::new().with(state.view().x, state.view().v);
    a == b && hash(a) == hash(b)
}

fn main() -> Result<ExitCode, Box<dyn std::error::Error>> {
    let mut prompt = Player::new()?;
    let mut late = Late {
        player: Player::new()?,
        recent: VecDeque::new(),
        rollbacks: 0,
    };
    let mut history = VecDeque::new();
    let (mut time, mut time_late, mut replays) = (Duration::ZERO, Duration::ZERO, 0);
    for now in 0..STEPS {
        history.push_back(prompt.body.state().clone());
        let start = Instant::now();
        prompt.step(inputs(now));
        time += start.elapsed();

        let start = Instant::now();
        late.step(now);
        time_late += start.elapsed();
        // Going back without any news changes nothing.
        if now % 50 == 49 && late.recent.len() == DELAY {
            let before = late.player.body.state().clone();
            late.replay();
            replays += 1;
            if !same(&before, late.player.body.state()) {
                println!("a replay before step {now} has other bits");
                return Ok(ExitCode::FAILURE);
            }
        }

        let start = Instant::now();
        let confirmed = match (now + 1).checked_sub(DELAY) {
            Some(step) => late.arrive(step).map(|state| (step, state)),
            None => None,
        };
        time_late += start.elapsed();
        if let Some((step, state)) = confirmed {
            let true_one = history.pop_front().ok_or("no state to compare with")?;
            if !same(&state, &true_one) {
                println!("the states before step {step} differ");
                return Ok(ExitCode::FAILURE);
            }
        }
    }
    println!("{STEPS} steps, inputs {DELAY} steps late: equal to the bit after every step");
    println!("{replays} replays of {DELAY} steps without news: equal to the bit");
    println!(
        "{} rollbacks, {:.2} times the time of a machine that hears at once",
        late.rollbacks,
        time_late.as_secs_f64() / time.as_secs_f64()
    );
    Ok(ExitCode::SUCCESS)
}
