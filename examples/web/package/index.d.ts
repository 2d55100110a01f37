/** What the module says no to. The module is as usable as before. */
export class FemtoError extends Error {}

/** Preconditioners; `factor` is the asset's own. */
export type Preconditioner = 'identity' | 'mass' | 'jacobi' | 'block-jacobi' | 'factor' | 'two-level';
export const PRECONDITIONERS: readonly Preconditioner[];

/** Where the solver starts: `galerkin-m` and `rigid-m` use the last m velocities, up to 8. */
export type Start = 'zero' | 'velocity' | 'velocity-force' | `galerkin-${number}` | `rigid-${number}`;

/** Three numbers: x, y, z. */
export type Vector = readonly [number, number, number] | Float32Array;

/** Isotropic material with Rayleigh damping. */
export interface Material {
  /** Young's modulus, Pa, above 0. */
  young: number;
  /** Poisson's ratio, above −1 and below 0.5. */
  poisson: number;
  /** kg/m³, above 0. */
  density: number;
  /** Mass-proportional damping, 1/s; default 0. */
  alpha?: number;
  /** Stiffness-proportional damping, s; default 0. */
  beta?: number;
}

/** What a step may do. */
export interface Settings {
  /** Time step, s. */
  dt: number;
  /** 1 is backward Euler, 0.5 implicit Newmark. */
  theta: number;
  /** Iterations of the conjugate gradient, exactly this many; up to 10,000. */
  iterations: number;
  /** Jacobi sweeps of the polar decomposition, exactly this many; up to 10,000. */
  sweeps: number;
  start: Start;
  preconditioner: Preconditioner;
}

/** A node whose velocity is prescribed. */
export interface Pin {
  node: number;
  /** m/s; default 0, which holds it. */
  velocity?: Vector;
}

/** What nodes cannot enter: a half-space n·x ≥ offset, or a ball. It moves with its velocity as the body steps. */
export type Collider = { friction?: number; velocity?: Vector } & (
  | { normal: Vector; offset?: number }
  | { centre: Vector; radius: number }
);

/** What a call of `step` says. Norms are those of the last step, in N·s. */
export interface StepReport {
  /** Steps taken: fewer than asked for where one was refused. */
  taken: number;
  /** Why a step was refused, which left the state as it was; or null. */
  refusal: string | null;
  /** ‖b‖ */
  rhs: number;
  /** ‖b − Av‖ before the first iteration. */
  residualBefore: number;
  /** ‖b − Av‖ after the last. */
  residualAfter: number;
  /** Iterations that moved the solution. */
  updates: number;
  /** Contacts of nodes with colliders. */
  contacts: number;
}

/** Energies in J, momenta about the origin in N·s and N·m·s, the smallest det F (1 at rest, negative: inverted). */
export interface Measures {
  kinetic: number;
  elastic: number;
  potential: number;
  linear: [number, number, number];
  angular: [number, number, number];
  minDet: number;
}

/** Compiles a module, from its bytes or from where they are, and starts it. Each has a memory of its own. */
export function load(source: BufferSource | WebAssembly.Module | Response | URL | string): Promise<Femto>;

/** Whether modules with simd128 run here. */
export function hasSimd(): boolean;

export interface Femto {
  /** Tetrahedra that are computed side by side: 4 with simd128, else 1. */
  readonly lanes: number;
  /** Bytes of the module's memory. It grows, and never shrinks. */
  readonly memoryBytes: number;
  /** Assets, bodies and snapshots that were not freed; a body counts as two. */
  readonly kept: number;
  /** An asset that `femto bake` made. All of it is checked. */
  asset(bytes: ArrayBuffer | ArrayBufferView): Asset;
  /** An asset of a mesh: three metres a node, four node numbers a tetrahedron, positively oriented. No factor. */
  mesh(nodes: Float32Array, tets: Uint32Array, material: Material): Asset;
}

/** Frees what the module keeps; a second time does nothing. */
export interface Kept {
  free(): void;
}

/** All that never changes about a body. May be freed while bodies are made of it. */
export interface Asset extends Kept {
  readonly nodes: number;
  readonly tets: number;
  /** Nodes that it holds. */
  readonly pins: number;
  readonly factor: 'none' | 'warped' | 'laplacian';
  readonly bytes: number;
  readonly material: Readonly<Required<Material>>;
  /** What it was made for. */
  readonly settings: Readonly<Omit<Settings, 'preconditioner'>>;
  /** A copy of the four node numbers of every tetrahedron. */
  readonly corners: Uint32Array;
  /** The same body of another material. It keeps its factor, which then fits less well. */
  withMaterial(material: Partial<Material>): Asset;
  /** A body at rest, held by the asset's pins, with its settings; preconditioner `jacobi`, gravity −9.81 along y. */
  body(): Body;
}

/** A body that moves. */
export interface Body extends Kept {
  readonly nodes: number;
  readonly material: Readonly<Required<Material>>;
  readonly settings: Settings;
  /**
   * Positions in metres, three numbers a node, in the module's memory: read without a copy. Ask for it again
   * after calls other than `step`; keep no view of it. Written through `place` only.
   */
  readonly positions: Float32Array;
  /** Velocities in m/s, likewise. */
  readonly velocities: Float32Array;
  /** Forces on the nodes in N, to be written in place; they stay until they are written again. */
  readonly forces: Float32Array;
  /** No forces. */
  clearForces(): void;
  /** Changes settings. Another start forgets past velocities. */
  configure(changes: Partial<Settings>): void;
  /** Changes the material; positions and velocities stay. */
  setMaterial(material: Partial<Material>): void;
  /** m/s² */
  setGravity(gravity: Vector): void;
  /** Replaces all pins, those of the asset, too. */
  setPins(pins: readonly Pin[]): void;
  setColliders(colliders: readonly Collider[]): void;
  /** Sets positions and velocities; past velocities are forgotten. */
  place(positions: Float32Array, velocities: Float32Array): void;
  /** Advances by so many steps; see `refusal`. */
  step(steps?: number): StepReport;
  measure(): Measures;
  /** 16 hex digits over all positions and velocities: equal states, equal hashes, on every machine. */
  hash(): string;
  /** A copy of the state. */
  save(): Snapshot;
  /** Takes a copy back, to the bit. */
  restore(snapshot: Snapshot): void;
}

export interface Snapshot extends Kept {}
