// Time per step of the snowman in WASM as a multiple of native SSE2: `node scripts/time.mjs`. One run on one machine; the
// programs take turns, and the least time of each counts.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { load } from '../package/index.js';
import { BUILDS } from './module.mjs';
import { here, run, targetOf } from './run.mjs';

/** Steps of a run, and how often the programs take turns. */
const STEPS = 100;
const TURNS = 12;
/** Times native SSE2 that a build may take. */
const MOST = { 'femto.wasm': 2, 'femto-simd.wasm': 1.5 };

const asset = here('page/assets/snowman.femto');
run('cargo', ['build', '--locked', '--release'], { cwd: here('native'), env: { RUSTFLAGS: '' } });
const native = join(targetOf(here('native')), 'release', 'femto-web-native');
const bodies = {};
for (const { file } of BUILDS) {
  const femto = await load(readFileSync(here(`package/${file}`)));
  bodies[file] = femto.asset(readFileSync(asset)).body();
  bodies[file].setColliders([{ normal: [0, 1, 0], friction: 0.4 }]);
}

const least = { native: Infinity };
const hashes = new Set();
const take = (name, milliseconds) => (least[name] = Math.min(least[name] ?? Infinity, milliseconds));
for (let turn = 0; turn < TURNS; turn++) {
  const [milliseconds, hash] = run(native, [asset, String(STEPS), '2']).split(/\s/);
  take('native', Number(milliseconds));
  hashes.add(hash);
  for (const [file, body] of Object.entries(bodies)) {
    const start = body.save();
    const begin = performance.now();
    body.step(STEPS);
    take(file, (performance.now() - begin) / STEPS);
    hashes.add(body.hash());
    body.restore(start);
    start.free();
  }
}

let failed = hashes.size !== 1;
if (failed) console.error(`the hashes differ: ${[...hashes].join(', ')}`);
console.log('| snowman, 1,716 tetrahedra | ms a step | times native |\n|---|---|---|');
console.log(`| native, SSE2 | ${least.native.toFixed(3)} | 1 |`);
for (const { file } of BUILDS) {
  const times = least[file] / least.native;
  console.log(`| ${file} | ${least[file].toFixed(3)} | ${times.toFixed(2)} |`);
  if (times > MOST[file]) {
    console.error(`${file} takes more than ${MOST[file]} times native`);
    failed = true;
  }
}
process.exitCode = failed ? 1 : 0;
