// Both builds give the committed bits.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { load } from '../../package/index.js';
import { here } from '../../scripts/run.mjs';
import { runGolden } from '../../page/src/golden.js';
import { matches, runScenes } from '../../page/src/scenes.js';
import { CASES } from '../../scripts/module.mjs';
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

/** The hashes that all targets share, by scene: read here, not by the module. */
const committed = new Map();
for (const line of readFileSync(here('../cases/golden.txt'), 'utf8').trim().split('\n')) {
  const [kind, name, step, hash] = line.split(' ');
  const scene = `${kind} ${name}`;
  committed.set(scene, [...(committed.get(scene) ?? []), [Number(step), hash]]);
}

for (const { file } of CASES) {
  test(`${file} runs all golden scenes to the hashes that every target has`, async () => {
    const seen = [];
    for await (const scene of runScenes(readFileSync(here(`page/assets/${file}`)))) {
      assert.deepEqual(scene.checkpoints.map(([step, hash]) => [step, hash]), committed.get(scene.name), scene.name);
      assert.equal(scene.checkpoints.at(-1)[0], 1000);
      assert.ok(matches(scene), scene.name);
      seen.push(scene.name);
    }
    assert.deepEqual(seen, [...committed.keys()]);
  });
}

test('a scene with other bits is told from one with the committed ones', () => {
  const right = [[1, '00ff', '00ff'], [20, '01', '01']];
  assert.ok(matches({ checkpoints: right }));
  assert.ok(!matches({ checkpoints: [...right, [1000, '00fe', '00ff']] }));
  assert.ok(!matches({ checkpoints: [] }), 'one that did not run');
});
