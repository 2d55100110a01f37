// Writes the committed bits anew: `node scripts/golden.mjs`. The same scene from its mesh, by the native tool, so that
// the page compares a browser, WASM and the baked asset with a run that had none of them.

import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { buildTool } from './assets.mjs';
import { here, run } from './run.mjs';

const FILE = here('page/src/golden.json');
const CHECKPOINTS = [1, 20, 1000];

/** The hash that the native tool gets after so many steps of a scene. */
export function nativeHash(femto, name, steps) {
  const folder = mkdtempSync(join(tmpdir(), 'femto-'));
  try {
    const text = readFileSync(here(`scenes/${name}.toml`), 'utf8')
      .replace(/^steps = .*$/m, `steps = ${steps}`)
      .replace('"../../', `"${here('../')}`);
    const scene = join(folder, 'scene.toml');
    writeFileSync(scene, text);
    run(femto, ['run', scene, '--out', join(folder, 'out')]);
    const report = readFileSync(join(folder, 'out', 'report.json'), 'utf8');
    return JSON.parse(report).state_hash;
  } finally {
    rmSync(folder, { recursive: true });
  }
}

if (process.argv[1] === here('scripts/golden.mjs')) {
  const femto = buildTool();
  const golden = {
    asset: 'snowman',
    steps: CHECKPOINTS.at(-1),
    iterations: 5,
    sweeps: 2,
    start: 'rigid-1',
    ground: { normal: [0, 1, 0], offset: 0, friction: 0.4 },
    hashes: CHECKPOINTS.map((steps) => [steps, nativeHash(femto, 'snowman', steps)]),
  };
  writeFileSync(FILE, `${JSON.stringify(golden, null, 2)}\n`);
}
