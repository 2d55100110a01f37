// How fast this engine is at nothing but arithmetic: `node scripts/rate.mjs` prints operations of f32 a second.

import binaryen from 'binaryen';

import { here } from './run.mjs';

/** Numbers that do not wait for each other, as many as a core has registers for; operations on each in a round. */
const CHAINS = 12;
const OPERATIONS = 2;
/** Rounds of a run, and runs. */
const ROUNDS = 100_000;
const RUNS = 200;

/** x = x a + b, for all chains, without a load, a store or a choice. */
function text() {
  const chains = Array.from({ length: CHAINS }, (_, chain) => `$x${chain}`);
  const sum = chains.reduce((sum, x) => `(f32.add ${sum} (local.get ${x}))`, '(f32.const 0)');
  return `(module (func (export "run") (param $rounds i32) (param $a f32) (param $b f32) (result f32)
    ${chains.map((x) => `(local ${x} f32)`).join(' ')}
    (loop $again
      ${chains.map((x) => `(local.set ${x} (f32.add (f32.mul (local.get ${x}) (local.get $a)) (local.get $b)))`).join('\n')}
      (local.set $rounds (i32.sub (local.get $rounds) (i32.const 1)))
      (br_if $again (local.get $rounds)))
    ${sum}))`;
}

/** Operations a second; the best of some short runs. */
export async function rate() {
  const { instance } = await WebAssembly.instantiate(binaryen.parseText(text()).emitBinary());
  let least = Infinity;
  for (let run = 0; run < RUNS; run++) {
    const begin = performance.now();
    instance.exports.run(ROUNDS, 0.5, 0.5);
    least = Math.min(least, performance.now() - begin);
  }
  return (1e3 * CHAINS * OPERATIONS * ROUNDS) / least;
}

if (process.argv[1] === here('scripts/rate.mjs')) console.log((await rate()).toExponential(3));
