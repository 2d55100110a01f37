// Both builds give the committed bits.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { load } from '../../package/index.js';
import { here } from '../../scripts/run.mjs';
import { runGolden } from '../../page/src/golden.js';
import { BUILDS, assetBytes, moduleBytes } from '../support.mjs';

const golden = JSON.parse(readFileSync(here('page/src/golden.json'), 'utf8'));

for (const { file, simd } of BUILDS) {
  test(`${file} takes ${golden.steps} steps to the committed hash`, async () => {
    const femto = await load(moduleBytes(file));
    assert.equal(femto.lanes, simd ? 4 : 1);
    const asset = femto.asset(assetBytes(golden.asset));
    const hashes = [...runGolden(asset, golden)];
    assert.deepEqual(hashes, golden.hashes);
    assert.equal(new Set(Object.values(hashes.map(([, hash]) => hash))).size, hashes.length, 'it moves');
  });
}

test('another budget gives other bits', async () => {
  const femto = await load(moduleBytes('femto.wasm'));
  const asset = femto.asset(assetBytes(golden.asset));
  const [[, hash]] = runGolden(asset, { ...golden, iterations: golden.iterations + 1 });
  assert.notEqual(hash, golden.hashes[0][1]);
});
