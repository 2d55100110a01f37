// What each part of the plain module costs: `node scripts/size.mjs`. A row is a build without the part; the difference is
// the part's. `node scripts/size.mjs limits` only says whether the module with everything, and with no optional part, is
// as small as it must be.

import { ALL, sizeOf } from './module.mjs';

/** Bytes that the plain module may have, with everything and with no optional part: 96 KB and 48 KB. */
const MOST = { all: 98_304, least: 49_152 };

const NAMES = {
  factors: 'the factored preconditioners, and reading their factors',
  'two-level': 'the two-level preconditioner',
  meshes: 'assets made in the module, of meshes and other materials',
  measures: 'energies, momenta, the worst element',
};

const all = sizeOf({ simd: false });
const limits = process.argv[2] === 'limits';
const rows = (limits ? [] : ALL).map((part) => [NAMES[part], all - sizeOf({ simd: false, features: ALL.filter((other) => other !== part) })]);
const least = sizeOf({ simd: false, features: [] });

console.log('| part | bytes |\n|---|---|');
console.log(`| steps with local preconditioners, assets, pins, colliders, forces, snapshots | ${least.toLocaleString('en')} |`);
for (const [name, bytes] of rows) console.log(`| ${name} | ${bytes.toLocaleString('en')} |`);
console.log(`| **everything, plain** | ${all.toLocaleString('en')} |`);
if (!limits) console.log(`| everything, simd128 | ${sizeOf({ simd: true }).toLocaleString('en')} |`);
if (all > MOST.all || least > MOST.least) {
  console.error(`larger than ${MOST.least} and ${MOST.all} bytes`);
  process.exitCode = 1;
}
