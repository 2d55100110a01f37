// Builds the module: `node scripts/module.mjs`. Plain and with simd128, into package/.

import { mkdtempSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { here, run, targetOf } from './run.mjs';

const TRIPLE = 'wasm32-unknown-unknown';

/** What rustc takes for granted, and every browser since 2022 has. */
const FEATURES = ['bulk-memory', 'multivalue', 'mutable-globals', 'nontrapping-float-to-int', 'reference-types', 'sign-ext', 'simd']
  .map((feature) => `--enable-${feature}`);

/** What the builds differ in: the plain one is for size, the other for speed. */
const KINDS = {
  // A fifth fewer bytes than rustc's own choice, at the same speed: what a step needs is inlined by its attributes.
  plain: { profile: 'small', flags: '-C llvm-args=-inline-threshold=5 -C llvm-args=-unroll-threshold=20', optimise: '-Oz' },
  simd: { profile: 'release', flags: '-C target-feature=+simd128', optimise: '-O3' },
};

/** Every feature of Cargo.toml. */
export const ALL = ['factors', 'two-level', 'meshes', 'measures'];
/** The two builds. */
export const BUILDS = [
  { file: 'femto.wasm', simd: false },
  { file: 'femto-simd.wasm', simd: true },
];

/** Builds a module into `out`; returns its bytes. */
export function buildModule(out, { simd, features = ALL }) {
  const kind = simd ? 'simd' : 'plain';
  const { profile, flags, optimise } = KINDS[kind];
  const cwd = here('');
  const target = join(targetOf(cwd), kind);
  run(
    'cargo',
    ['build', '--locked', '--profile', profile, '--target', TRIPLE, '--no-default-features', '--features', features.join(',')],
    { cwd, env: { CARGO_TARGET_DIR: target, RUSTFLAGS: flags } },
  );
  const built = join(target, TRIPLE, profile, 'femto_web.wasm');
  run(process.execPath, [here('node_modules/binaryen/bin/wasm-opt'), optimise, ...FEATURES, '--strip-producers', built, '-o', out]);
  return statSync(out).size;
}

/** Builds a module that nobody keeps; returns its bytes. */
export function sizeOf(options) {
  const folder = mkdtempSync(join(tmpdir(), 'femto-'));
  try {
    return buildModule(join(folder, 'module.wasm'), options);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

export function buildModules() {
  for (const { file, simd } of BUILDS) {
    console.log(`${file}: ${buildModule(here(`package/${file}`), { simd })} bytes`);
  }
}

if (process.argv[1] === here('scripts/module.mjs')) buildModules();
