//! What the state of a simulation says, body by body of the scene and with its numbers.

use femto::coupling::Coupling;
use femto::energy::StateHash;
use femto::state::StateRef;

use super::Sim;
use super::body::with;
use super::values::{Damage, Energies, Measure};

impl Sim<'_> {
    pub fn measure(&self) -> Measure {
        let mut sum = Measure {
            energy: Energies::default(),
            linear: [0.0; 3],
            angular: [0.0; 3],
            min_det: f64::INFINITY,
        };
        for body in &self.bodies {
            let (energy, momenta, min_det) = with!(&body.kind, body => (body.energies(self.gravity), body.momenta(), body.min_det()));
            sum.energy.kinetic += energy.kinetic;
            sum.energy.elastic += energy.elastic;
            sum.energy.potential += energy.potential;
            for axis in 0..3 {
                sum.linear[axis] += momenta.linear[axis];
                sum.angular[axis] += momenta.angular[axis];
            }
            sum.min_det = sum.min_det.min(min_det);
        }
        sum
    }

    pub fn bodies(&self) -> usize {
        self.ranges.len()
    }

    pub fn positions(&self, body: usize) -> &[[f32; 3]] {
        match self.joint {
            None => with!(&self.bodies[body].kind, body => body.positions()),
            Some(_) => {
                let all = with!(&self.bodies[0].kind, body => body.positions());
                &all[self.ranges[body].clone()]
            }
        }
    }

    pub fn velocities(&self, body: usize) -> &[[f32; 3]] {
        match self.joint {
            None => with!(&self.bodies[body].kind, body => body.velocities()),
            Some(_) => {
                let all = with!(&self.bodies[0].kind, body => body.velocities());
                &all[self.ranges[body].clone()]
            }
        }
    }

    /// Attachments, springs and contacts between bodies, as the last step left them; empty slots weigh nothing.
    pub fn contacts(&self) -> &[Coupling] {
        self.joint.as_ref().map_or(&[], |joint| &joint.slots)
    }

    /// Whose a node of the one system is.
    pub fn body_of(&self, node: usize) -> usize {
        self.ranges.partition_point(|range| range.end <= node)
    }

    /// FNV-1a over the bits of all x, then all v, then plastic strain and what has broken, if any, body by body.
    pub fn hash(&self) -> u64 {
        if self.joint.is_some() {
            let bodies = 0..self.bodies();
            let one = |hash: StateHash, b| hash.with(self.positions(b), self.velocities(b));
            let hash = bodies.fold(StateHash::new(), one);
            let body = &self.bodies[0];
            return match body.laws.any() {
                true => with!(&body.kind, body => hash.with_state(&body.state().view())).value(),
                false => hash.value(),
            };
        }
        self.bodies
            .iter()
            .fold(
                StateHash::new(),
                |hash, body| with!(&body.kind, body => hash.with_state(&body.state().view())),
            )
            .value()
    }

    /// What has yielded and broken; `None` where no body does either.
    pub fn damage(&self) -> Option<Damage> {
        let damaged = self.bodies.iter().filter(|body| body.laws.any());
        damaged.map(|body| body.damage).reduce(|a, b| Damage {
            dissipated_joules: a.dissipated_joules + b.dissipated_joules,
            broken_tets: a.broken_tets + b.broken_tets,
            reserve_left: match (a.reserve_left, b.reserve_left) {
                (Some(a), Some(b)) => Some(a.saturating_add(b)),
                (a, b) => a.or(b),
            },
        })
    }

    /// Calls `f` with the state that a body is in and, for each of its tets, the state's number and the scene's.
    fn each_tet(&self, body: usize, mut f: impl FnMut(&StateRef<'_>, usize, usize)) {
        let (own, range) = match &self.joint {
            None => (&self.bodies[body], 0..usize::MAX),
            Some(joint) => (&self.bodies[0], joint.parts.parts[body].tets.clone()),
        };
        with!(&own.kind, built => {
            let state = built.state().view();
            for (tet, original) in own.original.iter().enumerate() {
                if range.contains(original) {
                    f(&state, tet, original - range.start);
                }
            }
        });
    }

    /// Which tets of a body are whole, as the scene counts them.
    pub fn whole(&self, body: usize, tets: usize) -> Vec<bool> {
        let mut whole = vec![true; tets];
        self.each_tet(body, |state, tet, original| {
            whole[original] = !state.is_broken(tet)
        });
        whole
    }

    /// Norm of the plastic strain of a body's tets, as the scene counts them; 0 for those of bodies that do not yield.
    pub fn plastic_strain(&self, body: usize, tets: usize) -> Vec<f32> {
        let mut norms = vec![0.0; tets];
        self.each_tet(body, |state, tet, original| {
            norms[original] = state.plastic_strain(tet)
        });
        norms
    }

    /// Whether any body yields.
    pub fn yields(&self) -> bool {
        self.bodies
            .iter()
            .any(|body| body.laws.plasticity.is_some())
    }
}
