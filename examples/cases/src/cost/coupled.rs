//! Bodies in one system: the same proof, and steps for the cost table.

use core::fmt::Arguments;
use core::hint::black_box;

use femto::cost::{Coupled, Load, Search};
use femto::coupling::{Link, Piece};
use femto::glam::Vec3;
use femto::rigid::{Rigid, Shape};
use femto::{Coupling, Couplings, Material, Mesh, Scene, Settings, StepReport};

use super::measure::{budget, describe};
use super::{AnyBody, BadCase, Case, Counter, PLAIN, Room, counted};
use crate::choices::{MORE_STARTS, PRECONDITIONERS, STARTS};
use crate::states::STATES;
use crate::worlds::{
    CUBE, CUBES, EVEN, FLAT, FOUR, HEAP, LONG, MIXED, PILE, SLOPE, SMALL, STEEP, THREE, TWO,
};

/// Several bodies as one mesh, its tetrahedra in fans.
#[derive(Debug)]
pub struct World {
    /// Metres.
    pub nodes: &'static [[f32; 3]],
    /// By nodes of the world.
    pub tets: &'static [[u32; 4]],
    /// Young's modulus, Poisson's ratio and density of each tetrahedron.
    pub materials: &'static [[f32; 3]],
    /// The soft bodies.
    pub pieces: &'static [Surface],
    /// First node and shape of the rigid ones.
    pub rigids: &'static [(u32, Shape)],
}

/// That of a soft body.
#[derive(Debug)]
pub struct Surface {
    /// Its nodes.
    pub range: (u32, u32),
    /// Its boundary.
    pub triangles: &'static [[u32; 3]],
    /// The nodes on it.
    pub nodes: &'static [u32],
}

const MOST_TETS: usize = 400;
const MOST_SLOTS: usize = 96;

/// What joins the bodies of a world.
#[derive(Clone, Copy)]
struct Joined {
    world: &'static World,
    links: usize,
    slots: usize,
    friction: f32,
}

impl Joined {
    fn soft(&self) -> usize {
        self.world.nodes.len() - 4 * self.world.rigids.len()
    }

    fn fill(&self, room: &mut Room) -> Result<(), BadCase> {
        let World {
            nodes,
            tets,
            materials,
            ..
        } = self.world;
        let any = Material::new(1e5, 0.3, 1000.0).map_err(|_| BadCase)?;
        let mut all = [any; MOST_TETS];
        let all = all.get_mut(..tets.len()).ok_or(BadCase)?;
        for (out, &[young, poisson, density]) in all.iter_mut().zip(*materials) {
            *out = Material::new(young, poisson, density).map_err(|_| BadCase)?;
        }
        let mesh = Mesh::new(nodes, tets).map_err(|_| BadCase)?;
        room.factors.fill(nodes.len(), tets);
        room.body.fill(&mesh, &*all).map_err(|_| BadCase)
    }

    /// Counts one step. `label` gets its load and the most that its search may take.
    fn counted(
        &self,
        room: &mut Room,
        case: &Case,
        (name, change): (&str, Change),
        label: impl FnOnce(Load, u64, &mut dyn FnMut(Arguments<'_>)),
        counter: &mut Counter<impl FnMut(Arguments<'_>)>,
    ) -> Result<(), BadCase> {
        let pieces: [Piece<'_>; 3] = core::array::from_fn(|k| {
            let surface = &self.world.pieces[k.min(self.world.pieces.len() - 1)];
            Piece {
                range: surface.range,
                triangles: surface.triangles,
                tets: &[],
                edges: &[],
                nodes: surface.nodes,
                friction: self.friction,
            }
        });
        let pieces = &pieces[..self.world.pieces.len()];
        let mut rigids: [Rigid; 4] = core::array::from_fn(|k| match self.world.rigids.get(k) {
            Some(&(first, shape)) => Rigid::new(first, shape, self.friction),
            None => Rigid::new(0, Shape::Ball { radius: 1.0 }, 0.0),
        });
        let rigids = &mut rigids[..self.world.rigids.len()];
        let last = self.world.nodes.len() as u32 - 1;
        let links = [
            Link::nodes(1, last),
            Link::to_target([(3, 1.0)], Vec3::new(0.1, 0.5, 0.0), Vec3::X).soft(500.0, 5.0),
            Link::points([(0, 0.5), (2, 0.5)], [(last - 1, 1.0)]).soft(1e3, 0.0),
        ];
        let links = &links[..self.links];
        let mut slots = [Coupling::EMPTY; MOST_SLOTS];
        let slots = &mut slots[..self.slots];
        let (soft, apart) = (self.soft(), self.world.pieces[0].range.1 as usize);
        let change = |x: &mut [[f32; 3]], v: &mut [[f32; 3]]| {
            let [x, v] = [x, v].map(|all| all.split_at_mut(soft));
            match change {
                Change::Soft(change) => change(x.0, v.0),
                Change::Upper(by, speed) => {
                    let rigid = x.1.iter_mut().zip(v.1);
                    for (x, v) in x.0[apart..].iter_mut().zip(&mut v.0[apart..]).chain(rigid) {
                        for axis in 0..3 {
                            x[axis] += by[axis];
                            v[axis] += speed[axis];
                        }
                    }
                }
            }
        };
        let couplings = Couplings::new(pieces, rigids, links, slots);
        let coupled = Coupled {
            pieces: pieces.len(),
            rigids: self.world.rigids.len(),
            links: links.len(),
            slots: self.slots,
        };
        let search = Search::of(&couplings, case.colliders).most();
        let label = |load: Load, say: &mut dyn FnMut(Arguments<'_>)| {
            label(Load { coupled, ..load }, search, say);
        };
        let step = |body: &mut AnyBody, scene: &Scene<'_>, settings: &Settings<'_>| {
            let mut couplings = Couplings::new(pieces, rigids, links, slots);
            step(body, scene, settings, &mut couplings)
        };
        let state = (name, change);
        counted(room, self.world.nodes, case, state, label, step, counter)
    }
}

/// How a state differs from rest.
#[derive(Clone, Copy)]
enum Change {
    /// Of the soft bodies.
    Soft(crate::states::State),
    /// All but the first body are moved by so much, at such a speed.
    Upper([f32; 3], [f32; 3]),
}

/// Beside [`STATES`].
const MORE_STATES: [(&str, Change); 6] = [
    ("apart", Change::Upper([0.0, 3.0, 0.0], [0.0; 3])),
    ("deep", Change::Upper([0.01, -0.08, 0.02], [0.0, -1.0, 0.0])),
    ("hit", Change::Upper([0.0; 3], [0.3, -8.0, 0.1])),
    ("sliding", Change::Upper([0.0; 3], [3.0, -0.2, 1.0])),
    ("sticking", Change::Upper([0.0; 3], [1e-3, -0.1, 0.0])),
    ("leaving", Change::Upper([0.0; 3], [0.0, 2.0, 0.0])),
];

fn states() -> impl Iterator<Item = (&'static str, Change)> {
    let soft = STATES.map(|(name, state)| (name, Change::Soft(state)));
    soft.into_iter().chain(MORE_STATES)
}

/// Steps of several worlds in every state, for every preconditioner and start: lines "preconditioner start world state
/// limit count search", where the search may take `limit` at most. Worlds are soft on soft and soft on rigid, with
/// and without friction, links and colliders; in one most contacts find no room.
///
/// # Errors
/// [`BadCase`].
pub fn prove(
    room: &mut Room,
    counter: &mut Counter<impl FnMut(Arguments<'_>)>,
) -> Result<(), BadCase> {
    let worlds = [
        ("soft", &TWO, 0, 64, 0.0, 0),
        ("linked", &TWO, 3, 48, 0.4, 2),
        ("overflow", &TWO, 0, 8, 0.4, 0),
        ("rigid", &FOUR, 2, 64, 0.3, 1),
    ];
    for (name, world, links, slots, friction, colliders) in worlds {
        let joined = Joined {
            world,
            links,
            slots,
            friction,
        };
        joined.fill(room)?;
        let every = PRECONDITIONERS
            .into_iter()
            .flat_map(|p| STARTS.map(|s| (p, s)));
        for (k, (preconditioner, start)) in every.enumerate() {
            // Each setting in one of the worlds; the default in all.
            let default = preconditioner.0 == PLAIN.preconditioner.0 && start.0 == PLAIN.start.0;
            if !default && worlds[k % worlds.len()].0 != name {
                continue;
            }
            let case = Case {
                preconditioner,
                start,
                colliders,
                tears: 4,
                ..PLAIN
            };
            for state in states() {
                let label = |_, search, say: &mut dyn FnMut(Arguments<'_>)| {
                    let (preconditioner, start) = (preconditioner.0, start.0);
                    say(format_args!(
                        "{preconditioner} {start} {name} {} {search} ",
                        state.0
                    ));
                };
                joined.counted(room, &case, state, label, counter)?;
            }
        }
    }
    Ok(())
}

/// Lines as [`super::measure`]'s.
pub(super) fn measure(
    room: &mut Room,
    counter: &mut Counter<impl FnMut(Arguments<'_>)>,
) -> Result<(), BadCase> {
    let fitted: [(_, &[_]); 12] = [
        (&TWO, &[(0, 8), (0, 48), (3, 32)]),
        (&FOUR, &[(0, 8), (0, 48), (3, 32)]),
        (&SMALL, &[(0, 16), (2, 64)]),
        (&MIXED, &[(0, 24), (1, 96)]),
        (&PILE, &[(0, 12), (3, 80)]),
        (&LONG, &[(0, 4), (3, 40)]),
        (&FLAT, &[(1, 10)]),
        (&STEEP, &[(0, 56)]),
        (&THREE, &[(2, 20)]),
        (&SLOPE, &[(0, 36)]),
        (&HEAP, &[(0, 16), (1, 72)]),
        (&EVEN, &[(0, 20)]),
    ];
    let checked: [(_, &[_]); 2] = [(&CUBES, &[(1, 64), (0, 20)]), (&CUBE, &[(2, 96), (0, 30)])];
    let fitted = fitted.map(|(world, joins)| ("fit", world, joins));
    let checked = checked.map(|(world, joins)| ("check", world, joins));
    for (purpose, world, joins) in fitted.into_iter().chain(checked) {
        for (j, &(links, slots)) in joins.iter().enumerate() {
            let joined = Joined {
                world,
                links,
                slots,
                friction: 0.3,
            };
            joined.fill(room)?;
            let mut count = |case: &Case| {
                let label = |load: Load, _, say: &mut dyn FnMut(Arguments<'_>)| {
                    describe(purpose, case, &load, say);
                };
                joined.counted(room, case, states().nth(1).ok_or(BadCase)?, label, counter)
            };
            for (k, preconditioner) in PRECONDITIONERS.into_iter().enumerate() {
                count(&Case {
                    preconditioner,
                    budget: budget(2 + ((3 * k + j) % 7) as u32, 1),
                    colliders: usize::from(cfg!(feature = "guard") || (k + j) % 4 == 3),
                    ..PLAIN
                })?;
            }
            for start in STARTS.into_iter().chain(MORE_STARTS) {
                for iterations in [0, 6] {
                    count(&Case {
                        start,
                        budget: budget(iterations, 1),
                        // For the guard to have something to do.
                        colliders: usize::from(cfg!(feature = "guard")),
                        ..PLAIN
                    })?;
                }
            }
        }
    }
    Ok(())
}

/// As firmware would call it.
#[inline(never)]
fn step(
    body: &mut AnyBody,
    scene: &Scene<'_>,
    settings: &Settings<'_>,
    couplings: &mut Couplings<'_>,
) -> StepReport {
    black_box(body).step_coupled(black_box(scene), black_box(settings), black_box(couplings))
}
