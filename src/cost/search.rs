//! What the search for contacts takes at most.

/// What the module `detect` may have to do in a step, if everything is near everything: the one part of a step
/// whose cost depends on the state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Search {
    /// Surface nodes of all pieces, and four for each rigid body.
    pub nodes: u64,
    /// Pairs of pieces and rigid bodies, whose boxes are compared.
    pub pairs: u64,
    /// Points that may be looked for in another body: nodes, centres of balls, corners of boxes.
    pub points: u64,
    /// Looks at triangles and edges, and at boxes around them: the table of the module `detect`.
    pub looks: u64,
    /// Contacts that may be found.
    pub contacts: u64,
    /// Slots for them. Contacts beyond them go through a heap of them.
    pub slots: u64,
}

impl Search {
    /// That of a step with these couplings and so many colliders.
    #[cfg(feature = "contact")]
    #[must_use]
    pub fn of(couplings: &crate::coupling::Couplings<'_>, colliders: usize) -> Self {
        use crate::rigid::Shape;
        // Products of lengths do not fit 32 bits.
        let size = |length: usize| length as u64;
        let (pieces, rigids, colliders) = (couplings.pieces, &*couplings.rigids, size(colliders));
        let surface: u64 = pieces.iter().map(|piece| size(piece.nodes.len())).sum();
        let parts = size(pieces.len() + rigids.len());
        let slots = couplings.slots.len().saturating_sub(couplings.links.len());
        let mut out = Self {
            nodes: surface + 4 * size(rigids.len()),
            pairs: parts * parts.saturating_sub(1) / 2,
            slots: size(slots),
            ..Self::default()
        };
        for (i, one) in pieces.iter().enumerate() {
            for other in pieces.iter().take(i) {
                let [n, m] = [one, other].map(|piece| size(piece.nodes.len()));
                let [t, s] = [one, other].map(|piece| size(piece.triangles.len()));
                let [e, d] = [one, other].map(|piece| size(piece.edges.len()));
                out.points += n + m + e + d;
                out.contacts += n + m + e + d;
                out.looks += 6 * (n * s + m * t) + 2 * (t + s);
                out.looks += e * (3 * d + 6 * s) + d * (3 * (e + d) + 6 * (t + s)) + 2 * (e + d);
            }
        }
        for (i, rigid) in (0..).zip(rigids) {
            let own = match rigid.shape() {
                Shape::Ball { .. } => 1,
                Shape::Cuboid { .. } => 8,
            };
            for piece in pieces {
                out.points += size(piece.nodes.len()) + own;
                out.contacts += size(piece.nodes.len()) + own;
                out.looks += (6 * own + 2) * size(piece.triangles.len());
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
        let levels = u64::BITS - self.slots.leading_zeros();
        let counts = [
            1,
            self.nodes,
            self.pairs,
            self.points,
            self.looks,
            self.contacts,
            self.contacts.saturating_mul(levels.into()),
        ];
        let mut sum = 0_u64;
        for (count, most) in counts.into_iter().zip(MOST) {
            sum = sum.saturating_add(count.saturating_mul(most));
        }
        sum
    }
}

/// Once, and for each of the counts: a node, a pair, a point, a look, a contact, a level of the heap. With a
/// fourth and more to spare over what `examples/firmware/count` found in the worst of its states.
const MOST: [u64; 7] = [500, 80, 300, 200, 420, 600, 160];
