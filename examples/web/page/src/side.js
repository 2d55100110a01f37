// One of the two bodies that are shown: a body, its budget, and what it has done.

/** What the second body does instead of a budget of its own, by the asset's factor: so much that more is not seen. */
export const CONVERGED = { warped: 10, laplacian: 40 };

export class Side {
  constructor(asset, ground) {
    this.body = asset.body();
    this.body.setColliders([ground]);
    this.steps = 0;
    this.milliseconds = 0;
    this.report = this.body.step(0);
  }

  /** Time of a step, smoothed over the last few. */
  get perStep() {
    return this.milliseconds;
  }

  step() {
    const begin = performance.now();
    this.report = this.body.step(1);
    const spent = performance.now() - begin;
    this.milliseconds += 0.1 * (spent - this.milliseconds);
    this.steps += this.report.taken;
    return this.report.refusal;
  }

  /** ‖b − Av‖/‖b‖ of the last step. */
  get residual() {
    return this.report.rhs > 0 ? this.report.residualAfter / this.report.rhs : 0;
  }

  place(positions, velocities) {
    this.body.place(positions, velocities);
    this.steps = 0;
  }

  free() {
    this.body.free();
  }
}

/** Root mean square distance of the nodes of two bodies. */
export function gap(a, b) {
  const [x, y] = [a.body.positions, b.body.positions];
  let sum = 0;
  for (let k = 0; k < x.length; k++) sum += (x[k] - y[k]) ** 2;
  return Math.sqrt((3 * sum) / x.length);
}

/** Length of a vector. */
export const length = (vector) => Math.hypot(...vector);
