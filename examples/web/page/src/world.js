// The two bodies of one scene, with what acts on both.

import { Hand } from './hand.js';
import { CONVERGED, Side, gap, length } from './side.js';

const GROUND = { normal: [0, 1, 0], offset: 0, friction: 0.4 };

/** Two bodies of one asset. */
export class World {
  hand = new Hand();
  time = 0;
  refusal = null;

  /** @param {any} femto @param {ArrayBuffer} bytes */
  constructor(femto, bytes) {
    this.asset = femto.asset(bytes);
    this.sides = [new Side(this.asset, GROUND), new Side(this.asset, GROUND)];
    this.rest = this.sides[0].body.positions.slice();
    this.dt = this.asset.settings.dt;
    const bounds = [0, 1, 2].map((axis) => {
      const along = this.rest.filter((_, k) => k % 3 === axis);
      return [Math.min(...along), Math.max(...along)];
    });
    this.size = length(bounds.map(([low, high]) => high - low));
    this.top = bounds[1][1];
    // The asset's pins become pins of the page, which can be released.
    this.held = this.asset.pins > 0 ? this.heldByAsset() : new Set();
    this.hand.pinned = new Set(this.held);
  }

  /** Nodes that the asset holds: those that a step leaves where they are. */
  heldByAsset() {
    const [{ body }] = this.sides;
    body.step(1);
    const held = new Set();
    for (let node = 0; node < body.nodes; node++) {
      if (body.velocities.subarray(3 * node, 3 * node + 3).every((v) => v === 0)) held.add(node);
    }
    this.place(0);
    return held;
  }

  free() {
    this.sides.forEach((side) => side.free());
    this.asset.free();
  }

  /** Settings of one body, checked by the module. */
  configure(which, { iterations, sweeps, start, preconditioner, converged }) {
    const settings = converged
      ? { iterations: CONVERGED[this.asset.factor], sweeps: 4, start: 'rigid-2', preconditioner: 'factor' }
      : { iterations, sweeps, start, preconditioner };
    this.sides[which].body.configure({ ...settings, dt: this.dt });
  }

  /** Both or neither. */
  setBoth(change) {
    const [first, second] = this.sides.map((side) => side.body);
    change(first);
    change(second);
  }

  setDt(dt) {
    this.setBoth((body) => body.configure({ dt }));
    this.dt = dt;
  }

  setMaterial(material) {
    this.setBoth((body) => body.setMaterial(material));
  }

  setGravity(g) {
    this.setBoth((body) => body.setGravity([0, -g, 0]));
  }

  /** At rest, lifted by so many metres; with pins as the asset has them. */
  place(lift, pins = true) {
    const x = this.rest.map((x, k) => (k % 3 === 1 ? x + lift : x));
    for (const side of this.sides) side.place(x, new Float32Array(x.length));
    if (pins && this.held) this.hand.pinned = new Set(this.held);
    this.hand.release();
    this.time = 0;
  }

  /** Adds a throw to what both do: up, aside, and turning. Pinned nodes stay. */
  throw() {
    for (const { body } of this.sides) {
      const [x, v] = [body.positions.slice(), body.velocities.slice()];
      const middle = [0, 1, 2].map((axis) => x.reduce((sum, c, k) => (k % 3 === axis ? sum + c : sum), 0) / body.nodes);
      for (let node = 0; node < body.nodes; node++) {
        const [dx, dy] = [x[3 * node] - middle[0], x[3 * node + 1] - middle[1]];
        const kick = [0.5 - 5 * dy, 3.4 + 5 * dx, 0];
        kick.forEach((c, axis) => (v[3 * node + axis] += c));
      }
      body.place(x, v);
    }
  }

  /** One step of both, or of the first alone. Says what was refused. */
  step(single) {
    const active = single ? this.sides.slice(0, 1) : this.sides;
    if (this.hand.held || this.hand.pinned.size || this.pinsSet) {
      for (const { body } of active) body.setPins(this.hand.pins(body, this.dt));
      this.pinsSet = this.hand.held !== null || this.hand.pinned.size > 0;
    }
    const refusals = active.map((side) => side.step());
    this.refusal = refusals.find((refusal) => refusal !== null) ?? null;
    this.time += this.dt;
    return this.refusal;
  }

  /** Distance of the two bodies over the diagonal of their box. */
  get gap() {
    return gap(...this.sides) / this.size;
  }

  measures() {
    return this.sides.map(({ body }) => body.measure());
  }
}
