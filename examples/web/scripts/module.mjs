// Builds the module: `node scripts/module.mjs`. Plain and with simd128, into package/.

import { mkdirSync, mkdtempSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { writeFaults } from './faults.mjs';
import { here, run, targetOf } from './run.mjs';

const TRIPLE = 'wasm32-unknown-unknown';

/** What rustc takes for granted, and every browser since 2022 has. */
const FEATURES = ['bulk-memory', 'multivalue', 'mutable-globals', 'nontrapping-float-to-int', 'reference-types', 'sign-ext', 'simd']
  .map((feature) => `--enable-${feature}`);

/** What the builds differ in: the plain one is for size, the other for speed. */
const KINDS = {
  // The stack lies lowest in memory; that its last KB stays unused shortens addresses. Constants in locals are shorter,
  // too, as long as nothing after that puts them back.
  plain: {
    profile: 'small',
    flags: '',
    optimise: '--low-memory-unused -O4 --flatten --rereloop -Oz --converge -Oz --const-hoisting --coalesce-locals --reorder-locals'.split(' '),
  },
  simd: { profile: 'release', flags: '-C target-feature=+simd128', optimise: ['-O3'] },
};

/** Every feature of Cargo.toml. */
export const ALL = ['factors', 'two-level', 'meshes', 'measures'];
/** The two builds. */
export const BUILDS = [
  { file: 'femto.wasm', simd: false },
  { file: 'femto-simd.wasm', simd: true },
];

/** The golden scenes, in the same two builds; for the page, which loads them when asked. */
export const CASES = BUILDS.map(({ file, simd }) => ({ file: file.replace('femto', 'cases'), simd }));

/** Builds a package of this workspace into `out`; returns its bytes. */
function build(name, out, kind, features) {
  const { profile, flags, optimise } = KINDS[kind];
  const cwd = here('');
  const target = join(targetOf(cwd), kind);
  run(
    'cargo',
    ['build', '--locked', '--package', name, '--profile', profile, '--target', TRIPLE, ...features],
    { cwd, env: { CARGO_TARGET_DIR: target, RUSTFLAGS: flags } },
  );
  const built = join(target, TRIPLE, profile, `${name.replaceAll('-', '_')}.wasm`);
  run(process.execPath, [here('node_modules/binaryen/bin/wasm-opt'), ...FEATURES, ...optimise, '--strip-producers', built, '-o', out]);
  return statSync(out).size;
}

/** Builds the module into `out`; returns its bytes. */
export const buildModule = (out, { simd, features = ALL }) =>
  build('femto-web', out, simd ? 'simd' : 'plain', ['--no-default-features', '--features', features.join(',')]);

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
  writeFaults();
  for (const { file, simd } of BUILDS) {
    console.log(`${file}: ${buildModule(here(`package/${file}`), { simd })} bytes`);
  }
  mkdirSync(here('page/assets'), { recursive: true });
  for (const { file, simd } of CASES) {
    console.log(`${file}: ${build('femto-web-cases', here(`page/assets/${file}`), simd ? 'simd' : 'plain', [])} bytes`);
  }
}

if (process.argv[1] === here('scripts/module.mjs')) buildModules();
