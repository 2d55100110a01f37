// The JavaScript interface does what its types say.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { PRECONDITIONERS, hasSimd, load } from '../../package/index.js';
import { BODIES, BUILDS, SOFT, TET, assetBytes, moduleBytes } from '../support.mjs';

const fresh = (file = 'femto.wasm') => load(moduleBytes(file));
const fall = (x, steps, dt) => x - (9.81 * dt * dt * steps * (steps + 1)) / 2;

for (const { file } of BUILDS) {
  test(`${file}: a free body falls as backward Euler says, at every preconditioner`, async () => {
    const asset = (await fresh(file)).asset(assetBytes('snowman'));
    for (const preconditioner of PRECONDITIONERS) {
      const body = asset.body();
      body.configure({ preconditioner, iterations: 1 });
      const start = body.positions.slice();
      const { dt } = body.settings;
      const report = body.step(20);
      assert.deepEqual([report.taken, report.refusal], [20, null]);
      const { linear } = body.measure();
      let [mass, wrong] = [0, 0];
      for (let node = 0; node < body.nodes; node++) {
        wrong = Math.max(wrong, Math.abs(body.positions[3 * node + 1] - fall(start[3 * node + 1], 20, dt)));
      }
      mass = linear[1] / (-9.81 * 20 * dt);
      assert.ok(wrong < 1e-5, `${preconditioner}: off by ${wrong}`);
      assert.ok(mass > 100 && mass < 200, `${mass} kg`);
      body.free();
    }
  });
}

test('assets say what they hold', async () => {
  const femto = await fresh();
  for (const [name, factor] of Object.entries(BODIES)) {
    const bytes = assetBytes(name);
    const asset = femto.asset(bytes);
    assert.equal(asset.factor, factor);
    assert.equal(asset.bytes, bytes.length);
    assert.equal(asset.corners.length, 4 * asset.tets);
    assert.equal(Math.max(...asset.corners), asset.nodes - 1);
    assert.ok(Math.abs(asset.settings.dt - 1 / 150) < 1e-9);
    assert.match(asset.settings.start, /^(rigid|galerkin)-1$/);
    asset.free();
  }
  assert.equal(femto.kept, 0);
});

test('positions are the module\'s own memory, also after it has grown', async () => {
  const femto = await fresh();
  const asset = femto.asset(assetBytes('cube'));
  const body = asset.body();
  const before = body.positions;
  assert.equal(body.positions, before, 'the same view');
  const height = before[1];
  body.step(10);
  assert.ok(before[1] < height, 'it sees the step without being asked for again');
  const bytes = femto.memoryBytes;
  while (femto.memoryBytes === bytes) femto.asset(assetBytes('tower'));
  assert.equal(before.length, 0, 'the old view is detached');
  assert.equal(body.positions.length, 3 * body.nodes);
});

test('a mesh becomes a body, and another material another one', async () => {
  const femto = await fresh();
  const asset = femto.mesh(...TET, SOFT);
  assert.deepEqual([asset.nodes, asset.tets, asset.factor], [4, 1, 'none']);
  const body = asset.body();
  asset.free();
  body.setMaterial({ young: 1e6, beta: 0.01 });
  assert.deepEqual([body.material.young, body.material.density], [1e6, 1000]);
  body.step(3);
  body.setMaterial({ density: 500 });
  assert.ok(Math.abs(body.measure().linear[1] + (9.81 * 3 * 500) / 6 / 150) < 1e-3);
  body.free();
  assert.equal(femto.kept, 0);
});

test('pins hold and move, colliders keep out, forces push', async () => {
  const body = (await fresh()).mesh(...TET, SOFT).body();
  body.setPins([{ node: 0 }, { node: 1, velocity: [0, 0, 0] }, { node: 2, velocity: [0.5, 0, 0] }]);
  body.step(30);
  assert.deepEqual([...body.positions.slice(0, 6)], [0, 0, 0, 1, 0, 0]);
  assert.ok(Math.abs(body.positions[6] - 0.1) < 1e-6);

  body.setPins([]);
  body.place(TET[0], new Float32Array(12));
  body.setColliders([{ normal: [0, 1, 0], offset: -0.25, friction: 0.5 }, { centre: [9, 9, 9], radius: 1 }]);
  for (let step = 0; step < 300; step++) {
    body.step();
    for (let node = 0; node < 4; node++) assert.ok(body.positions[3 * node + 1] >= -0.25 - 1e-6);
  }
  assert.ok(body.step().contacts >= 3);

  body.setColliders([]);
  body.setGravity([0, 0, 0]);
  body.place(TET[0], new Float32Array(12));
  body.forces.fill(0);
  for (let node = 0; node < 4; node++) body.forces[3 * node] = 10;
  body.step(15);
  assert.ok(Math.abs(body.measure().linear[0] - 40 * 0.1) < 1e-3);
  body.clearForces();
  body.step(15);
  assert.ok(Math.abs(body.measure().linear[0] - 40 * 0.1) < 1e-3);
});

test('a snapshot brings the same bits back, with history', async () => {
  const body = (await fresh()).asset(assetBytes('cube')).body();
  body.configure({ start: 'galerkin-3' });
  body.step(5);
  const snapshot = body.save();
  body.step(40);
  const hash = body.hash();
  body.restore(snapshot);
  assert.notEqual(body.hash(), hash);
  body.step(40);
  assert.equal(body.hash(), hash);
});

test('step reports what it did', async () => {
  const body = (await fresh()).asset(assetBytes('beam')).body();
  body.configure({ iterations: 40, preconditioner: 'factor' });
  const report = body.step(4);
  assert.ok(report.rhs > 0 && report.residualAfter < 1e-4 * report.rhs);
  assert.ok(report.residualBefore > report.residualAfter && report.updates > 0);
  assert.equal(body.step(0).taken, 0);
});

test('this machine\'s engine is asked for simd128', () => assert.equal(hasSimd(), true));
