// femto for JavaScript: see README.md, and index.d.ts for the types and their units.

import { FemtoError, Memory, choice, count, number, vector } from './memory.js';

export { FemtoError };

export const PRECONDITIONERS = Object.freeze(['identity', 'mass', 'jacobi', 'block-jacobi', 'factor', 'two-level']);
const FACTORS = ['none', 'warped', 'laplacian'];
const STARTS = ['zero', 'velocity', 'velocity-force', 'galerkin', 'rigid'];

/** `galerkin-2` as the module counts it: which start, and 256 times how many velocities. */
function startCode(/** @type {unknown} */ start) {
  const parts = /^(galerkin|rigid)-(\d+)$/.exec(String(start));
  if (parts) return STARTS.indexOf(parts[1]) + 256 * count('the velocities of a start', Number(parts[2]), 255);
  return choice('start', STARTS.slice(0, 3), start);
}

/** @param {number} code */
function startName(code) {
  const kind = STARTS[code % 256];
  return code % 256 < 3 ? kind : `${kind}-${code >> 8}`;
}

/** Materials, and their defaults. */
function materialNumbers(/** @type {any} */ material) {
  const { young, poisson, density, alpha = 0, beta = 0 } = material ?? {};
  const named = { young, poisson, density, alpha, beta };
  return Object.entries(named).map(([name, value]) => number(name, value));
}

/** A module that draws four numbers at once: whether this machine takes such. */
const SIMD_PROBE = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
]);

/** Whether modules with simd128 run here. */
export const hasSimd = () => WebAssembly.validate(SIMD_PROBE);

/**
 * Compiles a module and starts it.
 * @param {BufferSource | WebAssembly.Module | Response | URL | string} source
 */
export async function load(source) {
  let from = /** @type {any} */ (source);
  if (typeof from === 'string' || from instanceof URL) {
    const response = await fetch(from);
    if (!response.ok) throw new FemtoError(`${from}: ${response.status} ${response.statusText}`);
    from = response;
  }
  if (typeof Response !== 'undefined' && from instanceof Response) from = await from.arrayBuffer();
  const module = from instanceof WebAssembly.Module ? from : await WebAssembly.compile(from);
  return new Femto(new Memory(await WebAssembly.instantiate(module, {})));
}

/** One module with its memory. */
class Femto {
  #memory;

  /** @param {Memory} memory */
  constructor(memory) {
    this.#memory = memory;
  }

  get lanes() {
    return this.#memory.exports.lanes();
  }

  get memoryBytes() {
    return this.#memory.bytes.byteLength;
  }

  get kept() {
    return this.#memory.exports.kept();
  }

  /** @param {ArrayBuffer | ArrayBufferView} bytes */
  asset(bytes) {
    const view = bytes instanceof ArrayBuffer ? new Uint8Array(bytes) : bytes;
    if (!ArrayBuffer.isView(view)) throw new FemtoError('an asset must be an ArrayBuffer or a view of one');
    const length = this.#memory.input(view);
    return new Asset(this.#memory, this.#memory.exports.asset_load(length));
  }

  /** @param {any} nodes @param {any} tets @param {any} material */
  mesh(nodes, tets, material) {
    if (!(nodes instanceof Float32Array) || nodes.length % 3 !== 0) {
      throw new FemtoError('nodes must be a Float32Array of three numbers a node');
    }
    if (!(tets instanceof Uint32Array) || tets.length % 4 !== 0) {
      throw new FemtoError('tets must be a Uint32Array of four nodes a tetrahedron');
    }
    const numbers = materialNumbers(material);
    this.#memory.input(nodes, tets);
    const made = this.#memory.exports.asset_of_mesh(nodes.length / 3, tets.length / 4, ...numbers);
    return new Asset(this.#memory, made);
  }
}

/** Something that the module keeps until it is freed. */
class Kept {
  #handle;
  memory;

  /** @param {Memory} memory @param {number} handle */
  constructor(memory, handle) {
    this.memory = memory;
    this.#handle = memory.accepted(handle);
  }

  get handle() {
    if (this.#handle === 0) throw new FemtoError(`this ${this.constructor.name.toLowerCase()} was freed`);
    return this.#handle;
  }

  free() {
    if (this.#handle !== 0) this.memory.exports.free(this.#handle);
    this.#handle = 0;
  }
}

class Asset extends Kept {
  /** @param {Memory} memory @param {number} handle */
  constructor(memory, handle) {
    super(memory, handle);
    memory.accepted(memory.exports.asset_info(handle));
    const [nodes, tets, pins, factor, bytes, young, poisson, density, alpha, beta, dt, theta, iterations, sweeps, start] =
      memory.numbers(15);
    this.nodes = nodes;
    this.tets = tets;
    this.pins = pins;
    this.factor = FACTORS[factor];
    this.bytes = bytes;
    this.material = Object.freeze({ young, poisson, density, alpha, beta });
    this.settings = Object.freeze({ dt, theta, iterations, sweeps, start: startName(start) });
  }

  /** Four node numbers a tetrahedron. */
  get corners() {
    const at = this.memory.accepted(this.memory.exports.asset_tets(this.handle));
    return new Uint32Array(this.memory.bytes, at, 4 * this.tets).slice();
  }

  /** @param {any} material */
  withMaterial(material) {
    const numbers = materialNumbers({ ...this.material, ...material });
    return new Asset(this.memory, this.memory.exports.asset_of_material(this.handle, ...numbers));
  }

  body() {
    return new Body(this.memory, this.memory.exports.body_new(this.handle));
  }
}

class Snapshot extends Kept {
  /** @param {Memory} memory @param {number} handle */
  constructor(memory, handle) {
    super(memory, handle);
  }
}

class Body extends Kept {
  #asset;
  #settings;
  /** @type {Map<string, Float32Array>} */
  #views = new Map();

  /** @param {Memory} memory @param {number} handle */
  constructor(memory, handle) {
    super(memory, handle);
    this.#asset = new Asset(memory, memory.exports.body_asset(handle));
    this.#settings = { ...this.#asset.settings, preconditioner: 'jacobi' };
    this.configure({});
  }

  free() {
    this.#asset.free();
    super.free();
  }

  get material() {
    return this.#asset.material;
  }

  get settings() {
    return { ...this.#settings };
  }

  get nodes() {
    return this.#asset.nodes;
  }

  get positions() {
    return this.#view('body_positions');
  }

  get velocities() {
    return this.#view('body_velocities');
  }

  get forces() {
    return this.#view('body_forces');
  }

  /** A view of the module's memory, made anew only where memory has grown or moved. @param {string} of */
  #view(of) {
    const at = this.memory.accepted(this.memory.exports[of](this.handle)) >>> 0;
    const buffer = this.memory.bytes;
    let view = this.#views.get(of);
    if (view?.buffer !== buffer || view.byteOffset !== at) {
      view = new Float32Array(buffer, at, 3 * this.nodes);
      this.#views.set(of, view);
    }
    return view;
  }

  /** @param {any} changes */
  configure(changes) {
    for (const name of Object.keys(changes)) {
      if (!(name in this.#settings)) throw new FemtoError(`there is no setting ${name}`);
    }
    const settings = { ...this.#settings, ...changes };
    const accepted = this.memory.exports.body_settings(
      this.handle,
      number('dt', settings.dt),
      number('theta', settings.theta),
      count('iterations', settings.iterations),
      count('sweeps', settings.sweeps),
      startCode(settings.start),
      choice('preconditioner', PRECONDITIONERS, settings.preconditioner),
    );
    this.memory.accepted(accepted);
    this.#settings = settings;
  }

  /** @param {any} material */
  setMaterial(material) {
    const [old, asset] = [this.#asset, this.#asset.withMaterial(material)];
    this.memory.accepted(this.memory.exports.body_use(this.handle, asset.handle));
    this.#asset = asset;
    old.free();
  }

  /** @param {any} gravity */
  setGravity(gravity) {
    this.memory.accepted(this.memory.exports.body_gravity(this.handle, ...vector('gravity', gravity)));
  }

  /** @param {any[]} pins */
  setPins(pins) {
    const rows = new DataView(new ArrayBuffer(16 * pins.length));
    pins.forEach(({ node, velocity = [0, 0, 0] }, row) => {
      rows.setUint32(16 * row, count('the node of a pin', node), true);
      vector('the velocity of a pin', velocity).forEach((v, axis) => rows.setFloat32(16 * row + 4 + 4 * axis, v, true));
    });
    this.memory.input(rows);
    this.memory.accepted(this.memory.exports.body_pins(this.handle, pins.length));
  }

  /** @param {any[]} colliders */
  setColliders(colliders) {
    const rows = colliders.flatMap((collider) => {
      const { normal, offset = 0, centre, radius, friction = 0, velocity = [0, 0, 0] } = collider;
      const shape = normal
        ? [0, ...vector('normal', normal), number('offset', offset)]
        : [1, ...vector('centre', centre), number('radius', radius)];
      return [...shape, number('friction', friction), ...vector('velocity', velocity)];
    });
    this.memory.input(new Float32Array(rows));
    this.memory.accepted(this.memory.exports.body_colliders(this.handle, colliders.length));
  }

  clearForces() {
    this.memory.accepted(this.memory.exports.body_no_forces(this.handle));
  }

  /** @param {any} positions @param {any} velocities */
  place(positions, velocities) {
    for (const [what, list] of Object.entries({ positions, velocities })) {
      if (!(list instanceof Float32Array) || list.length !== 3 * this.nodes) {
        throw new FemtoError(`${what} must be a Float32Array of ${3 * this.nodes} numbers`);
      }
    }
    this.memory.input(positions, velocities);
    this.memory.accepted(this.memory.exports.body_place(this.handle, this.nodes));
  }

  step(steps = 1) {
    const wanted = count('steps', steps);
    const taken = this.memory.exports.body_step(this.handle, wanted) >>> 0;
    const [rhs, residualBefore, residualAfter, updates, contacts] = this.memory.numbers(5);
    const refusal = taken < wanted ? this.memory.reason() : null;
    return { taken, refusal, rhs, residualBefore, residualAfter, updates, contacts };
  }

  measure() {
    this.memory.accepted(this.memory.exports.body_measure(this.handle));
    const [kinetic, elastic, potential, px, py, pz, lx, ly, lz, minDet] = this.memory.numbers(10);
    return { kinetic, elastic, potential, linear: [px, py, pz], angular: [lx, ly, lz], minDet };
  }

  hash() {
    const hash = this.memory.exports.body_hash(this.handle);
    return BigInt.asUintN(64, hash).toString(16).padStart(16, '0');
  }

  save() {
    return new Snapshot(this.memory, this.memory.exports.body_save(this.handle));
  }

  /** @param {Snapshot} snapshot */
  restore(snapshot) {
    if (!(snapshot instanceof Snapshot)) throw new FemtoError('restore takes what save gave');
    this.memory.accepted(this.memory.exports.body_restore(this.handle, snapshot.handle));
  }
}
