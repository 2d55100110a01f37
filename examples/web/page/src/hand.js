// What holds nodes: the user's hand, and pins. Both bodies feel the same.

/** Seconds that the hand takes to catch up: it pulls, it does not jump. */
const CATCH_UP = 0.05;
/** m/s; faster pulls would tear through anything. */
const FASTEST = 12;

export class Hand {
  /** Nodes that are pinned. @type {Set<number>} */
  pinned = new Set();
  /** Nodes in the hand, with their place beside its middle; or null. @type {Map<number, number[]> | null} */
  held = null;
  target = [0, 0, 0];

  /** Nodes around one, up to `radius` metres away. */
  static patch(positions, node, radius) {
    const patch = new Map();
    const at = [0, 1, 2].map((axis) => positions[3 * node + axis]);
    for (let other = 0; other < positions.length / 3; other++) {
      const from = at.map((x, axis) => positions[3 * other + axis] - x);
      if (Math.hypot(...from) <= radius) patch.set(other, from);
    }
    return patch;
  }

  grab(positions, node, radius, point) {
    const at = [0, 1, 2].map((axis) => positions[3 * node + axis]);
    this.held = Hand.patch(positions, node, radius);
    for (const from of this.held.values()) from.forEach((_, axis) => (from[axis] += at[axis] - point[axis]));
    this.target = [...point];
  }

  release() {
    this.held = null;
  }

  togglePins(positions, node, radius) {
    const patch = [...Hand.patch(positions, node, radius).keys()];
    const release = this.pinned.has(node);
    for (const other of patch) {
      if (release) this.pinned.delete(other);
      else this.pinned.add(other);
    }
  }

  /** The pins of a body for the coming steps. */
  pins(body, dt) {
    const x = body.positions;
    const pins = [...this.pinned].map((node) => ({ node }));
    for (const [node, from] of this.held ?? []) {
      const way = from.map((d, axis) => this.target[axis] + d - x[3 * node + axis]);
      const speed = Math.min(1 / Math.max(CATCH_UP, dt), FASTEST / (Math.hypot(...way) || 1));
      pins.push({ node, velocity: way.map((d) => d * speed) });
    }
    return pins;
  }
}
