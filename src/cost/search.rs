//! What the search for contacts takes at most.

/// What the module `detect` may have to do in a step, if everything is near everything: the one part of a step
/// whose cost depends on the state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Search {
    /// Surface nodes of all pieces, and four for each rigid body.
    pub nodes: usize,
    /// Pairs of pieces and rigid bodies, whose boxes are compared.
    pub pairs: usize,
    /// Points that may be looked for in another body: nodes, centres of balls, corners of boxes.
    pub points: usize,
    /// Looks at triangles and edges, and at boxes around them: the table of the module `detect`.
    pub looks: usize,
    /// Contacts that may be found.
    pub contacts: usize,
    /// Slots for them. Contacts beyond them go through a heap of them.
    pub slots: usize,
}

impl Search {
    /// That of a step with these couplings and so many colliders.
    #[cfg(feature = "contact")]
    #[must_use]
    pub fn of(couplings: &crate::coupling::Couplings<'_>, colliders: usize) -> Self {
        use crate::rigid::Shape;
        let (pieces, rigids) = (couplings.pieces, &*couplings.rigids);
        let surface: usize = pieces.iter().map(|piece| piece.nodes.len()).sum();
        let parts = pieces.len() + rigids.len();
        let mut out = Self {
            nodes: surface + 4 * rigids.len(),
            pairs: parts * parts.saturating_sub(1) / 2,
            slots: couplings.slots.len().saturating_sub(couplings.links.len()),
            ..Self::default()
        };
        for (i, one) in pieces.iter().enumerate() {
            for other in pieces.iter().take(i) {
                let [n, m] = [one, other].map(|piece| piece.nodes.len());
                let [t, s] = [one, other].map(|piece| piece.triangles.len());
                let [e, d] = [one, other].map(|piece| piece.edges.len());
                out.points += n + m + e + d;
                out.contacts += n + m + e + d;
                out.looks += 6 * (n * s + m * t) + 2 * (t + s);
                out.looks += e * (3 * d + 6 * s) + d * (3 * (e + d) + 6 * (t + s)) + 2 * (e + d);
            }
        }
        for (i, rigid) in rigids.iter().enumerate() {
            let own = match rigid.shape() {
                Shape::Ball { .. } => 1,
                Shape::Cuboid { .. } => 8,
            };
            for piece in pieces {
                out.points += piece.nodes.len() + own;
                out.contacts += piece.nodes.len() + own;
                out.looks += (6 * own + 2) * piece.triangles.len();
            }
            // Two boxes try the corners of both.
            out.points += 16 * i + own * colliders;
            out.contacts += 16 * i + own * colliders;
        }
        out
    }

    /// Instructions that it takes at most, on any of [`Machine::ALL`](super::Machine::ALL).
    #[must_use]
    pub fn most(&self) -> u64 {
        // A heap: each goes down at most as many levels as it has.
        let levels = usize::BITS - self.slots.leading_zeros();
        let counts = [
            1,
            self.nodes,
            self.pairs,
            self.points,
            self.looks,
            self.contacts,
            self.contacts.saturating_mul(levels as usize),
        ];
        let mut sum = 0_u64;
        for (count, most) in counts.into_iter().zip(MOST) {
            sum = sum.saturating_add((count as u64).saturating_mul(most));
        }
        sum
    }
}

/// Once, and for each of the counts: a node, a pair, a point, a look, a contact, a level of the heap. With a
/// fourth and more to spare over what `examples/firmware/count` found in the worst of its states.
const MOST: [u64; 7] = [500, 80, 300, 200, 420, 600, 160];
