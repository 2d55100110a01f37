// Time per step of the snowman in WASM as a multiple of native SSE2: `node scripts/time.mjs`. One run on one machine; the
// programs take turns, and the least time of each counts. The last column compares with native code of as many lanes, and
// so leaves what the engine costs; native one-lane code against SSE2 is what the lack of lanes costs. Last, what one lane
// could reach at best: the operations that the tetrahedra of a step take, at the rate that this engine has in a loop of
// nothing but multiplications and additions (rate.mjs).

import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { load } from '../package/index.js';
import { BUILDS } from './module.mjs';
import { rate } from './rate.mjs';
import { here, run, targetOf } from './run.mjs';

/** Steps of a run, short enough to be left alone on a busy machine; runs of a turn; how often the programs take turns. */
const STEPS = 8;
const RUNS = 100;
const TURNS = 10;
/** Times native SSE2 that the build for speed may take. The plain one has one lane where SSE2 has four. */
const MOST = { 'femto-simd.wasm': 1.5 };

const asset = here('page/assets/snowman.femto');
/** The native program, with these features. */
function native(features) {
  const target = join(targetOf(here('native')), features || 'native');
  run('cargo', ['build', '--locked', '--release', '--features', features], {
    cwd: here('native'),
    env: { RUSTFLAGS: '', CARGO_TARGET_DIR: target },
  });
  return join(target, 'release', 'femto-web-native');
}
const NATIVE = { 'native, SSE2': native(''), 'native, one lane': native('lanes-1') };
const bodies = {};
for (const { file } of BUILDS) {
  const femto = await load(readFileSync(here(`package/${file}`)));
  bodies[file] = femto.asset(readFileSync(asset)).body();
  bodies[file].setColliders([{ normal: [0, 1, 0], friction: 0.4 }]);
}

const least = {};
let operations = 0;
let fastest = 0;
const hashes = new Set();
const take = (name, milliseconds) => (least[name] = Math.min(least[name] ?? Infinity, milliseconds));
for (let turn = 0; turn < TURNS; turn++) {
  for (const [name, program] of Object.entries(NATIVE)) {
    const [milliseconds, hash, count, counted] = run(program, [asset, String(STEPS), String(RUNS)]).split(/\s/);
    take(name, Number(milliseconds));
    hashes.add(hash).add(counted);
    operations = Number(count);
  }
  fastest = Math.max(fastest, await rate());
  for (const [file, body] of Object.entries(bodies)) {
    const start = body.save();
    for (let run = 0; run < RUNS; run++) {
      const begin = performance.now();
      body.step(STEPS);
      take(file, (performance.now() - begin) / STEPS);
      hashes.add(body.hash());
      body.restore(start);
    }
    start.free();
  }
}

let failed = hashes.size !== 1;
if (failed) console.error(`the hashes differ: ${[...hashes].join(', ')}`);
/** Which native program has as many lanes. */
const LIKE = { 'femto.wasm': 'native, one lane', 'femto-simd.wasm': 'native, SSE2' };
console.log('| snowman, 1,716 tetrahedra | ms a step | times SSE2 | times native of as many lanes |\n|---|---|---|---|');
for (const [name, milliseconds] of Object.entries(least)) {
  const times = milliseconds / least['native, SSE2'];
  const engine = milliseconds / least[LIKE[name] ?? name];
  console.log(`| ${name} | ${milliseconds.toFixed(3)} | ${times.toFixed(2)} | ${engine.toFixed(2)} |`);
  if (times > (MOST[name] ?? Infinity)) {
    console.error(`${name} takes more than ${MOST[name]} times native SSE2`);
    failed = true;
  }
}
const floor = (1e3 * operations) / fastest;
console.log(`\n${operations} operations a step in its tetrahedra, at most ${fastest.toExponential(2)} a second in one lane:`);
console.log(`${floor.toFixed(3)} ms without a load, a store or a choice, ${(floor / least['native, SSE2']).toFixed(2)} times SSE2`);
console.log(`of that rate femto.wasm reaches ${((100 * floor) / least['femto.wasm']).toFixed(0)} %; twice SSE2 would be ${((50 * floor) / least['native, SSE2']).toFixed(0)} %`);
process.exitCode = failed ? 1 : 0;
