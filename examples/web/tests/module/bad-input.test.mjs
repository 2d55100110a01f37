// Bad input is refused with words, and leaves the module as usable as before.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { FemtoError, load } from '../../package/index.js';
import { SOFT, TET, assetBytes, moduleBytes } from '../support.mjs';

const femto = await load(moduleBytes('femto.wasm'));
const cube = assetBytes('cube');
const asset = femto.asset(cube);
const body = asset.body();
const other = femto.mesh(...TET, SOFT);
const nodes = 3 * body.nodes;
const broken = (at) => {
  const bytes = new Uint8Array(cube);
  bytes[at] ^= 1;
  return bytes;
};
const freed = (kept) => {
  kept.free();
  return kept;
};
const nan = (length) => new Float32Array(length).fill(NaN);

const CASES = {
  'no bytes': [() => femto.asset(new Uint8Array()), /ends after 0 bytes/],
  'foreign bytes': [() => femto.asset(new TextEncoder().encode('GIF89a'.repeat(99))), /not a femto asset/],
  'half an asset': [() => femto.asset(cube.subarray(0, cube.length >> 1)), /ends after \d+ bytes of \d+/],
  'an asset and a half': [() => femto.asset(Buffer.concat([cube, cube.subarray(9)])), /more than its/],
  'a changed bit': [() => femto.asset(broken(cube.length - 40)), /checksum/],
  'another version': [() => femto.asset(broken(8)), /version 0 of the format; known is 1/],
  'text for an asset': [() => femto.asset('cube'), /ArrayBuffer/],
  'nothing for an asset': [() => femto.asset(undefined), /ArrayBuffer/],
  'nodes as a list': [() => femto.mesh([...TET[0]], TET[1], SOFT), /Float32Array/],
  'a third of a node': [() => femto.mesh(TET[0].subarray(1), TET[1], SOFT), /three numbers a node/],
  'half a tetrahedron': [() => femto.mesh(TET[0], TET[1].subarray(2), SOFT), /four nodes/],
  'no tetrahedra': [() => femto.mesh(TET[0], new Uint32Array(), SOFT), /no nodes or no tetrahedra/],
  'a node that is not there': [() => femto.mesh(TET[0], new Uint32Array([0, 1, 2, 4]), SOFT), /names node 4/],
  'an inverted tetrahedron': [() => femto.mesh(TET[0], new Uint32Array([0, 2, 1, 3]), SOFT), /volume/],
  'nodes of NaN': [() => femto.mesh(nan(12), TET[1], SOFT), /node 0 has a coordinate/],
  'no material': [() => femto.mesh(...TET), /young must be a finite number/],
  'a modulus of 0': [() => femto.mesh(...TET, { ...SOFT, young: 0 }), /Young's modulus 0 must be positive/],
  'a ratio of 0.6': [() => asset.withMaterial({ poisson: 0.6 }), /Poisson's ratio 0\.6/],
  'a density of NaN': [() => body.setMaterial({ density: NaN }), /density must be a finite number, not NaN/],
  'a time step of NaN': [() => body.configure({ dt: NaN }), /dt must be a finite number/],
  'a time step of 0': [() => body.configure({ dt: 0 }), /time step 0 must be positive/],
  'a time step of -1': [() => body.configure({ dt: -1 }), /time step -1 must be positive/],
  'a theta of 2': [() => body.configure({ theta: 2 }), /theta 2 must be between/],
  'half an iteration': [() => body.configure({ iterations: 0.5 }), /iterations must be a whole number/],
  '1e9 iterations': [() => body.configure({ iterations: 1e9 }), /iterations 1000000000 must be at most 10000/],
  '-1 sweeps': [() => body.configure({ sweeps: -1 }), /sweeps must be a whole number/],
  'an unknown start': [() => body.configure({ start: 'sideways' }), /start must be one of/],
  'a start of 99 velocities': [() => body.configure({ start: 'galerkin-99' }), /at most 8 past velocities, not 99/],
  'an unknown preconditioner': [() => body.configure({ preconditioner: 'magic' }), /one of identity/],
  'a factor where there is none': [() => other.body().configure({ preconditioner: 'factor' }), /no factor/],
  'an unknown setting': [() => body.configure({ iteration: 5 }), /no setting iteration/],
  'gravity of two numbers': [() => body.setGravity([0, 1]), /three numbers/],
  'gravity of infinity': [() => body.setGravity([0, Infinity, 0]), /finite number/],
  'gravity past f32': [() => body.setGravity([0, 1e300, 0]), /gravity must be finite/],
  'a pin too far': [() => body.setPins([{ node: body.nodes }]), /pin names node 64, the body has 64/],
  'a pin at half a node': [() => body.setPins([{ node: 1.5 }]), /whole number/],
  'a pin of NaN': [() => body.setPins([{ node: 1, velocity: [0, NaN, 0] }]), /finite number/],
  'a collider without shape': [() => body.setColliders([{}]), /centre must be three numbers/],
  'a normal of zero': [() => body.setColliders([{ normal: [0, 0, 0] }]), /normal must be finite and not zero/],
  'a radius of -1': [() => body.setColliders([{ centre: [0, 0, 0], radius: -1 }]), /radius must be positive/],
  'friction of -1': [() => body.setColliders([{ normal: [0, 1, 0], friction: -1 }]), /friction/],
  'too few positions': [() => body.place(new Float32Array(3), new Float32Array(nodes)), /192 numbers/],
  'velocities of NaN': [() => body.place(body.positions.slice(), nan(nodes)), /node 0 is not finite/],
  '-1 steps': [() => body.step(-1), /whole number/],
  'a foreign snapshot': [() => body.restore({ handle: 1 }), /what save gave/],
  'a snapshot of another body': [() => body.restore(other.body().save()), /another body/],
  'a freed snapshot': [() => body.restore(freed(body.save())), /snapshot was freed/],
  'a freed body': [() => freed(asset.body()).step(), /body was freed/],
  'positions of a freed body': [() => freed(asset.body()).positions, /body was freed/],
  'a freed asset': [() => freed(femto.asset(cube)).body(), /asset was freed/],
  'more bytes than there are': [() => femto.asset(new Proxy(new Uint8Array(1), {})), /ArrayBuffer/],
};

for (const [what, [call, message]] of Object.entries(CASES)) {
  test(`${what}: refused`, () => {
    const [hash, settings, material] = [body.hash(), body.settings, body.material];
    assert.throws(call, (error) => error instanceof FemtoError && message.test(error.message));
    assert.deepEqual([body.hash(), body.settings, body.material], [hash, settings, material]);
    assert.deepEqual(body.step().refusal, null, 'the next step is taken');
  });
}

test('handles of the module itself are safe: freed, made up, or of something else', () => {
  const { exports } = new WebAssembly.Instance(new WebAssembly.Module(moduleBytes('femto.wasm')));
  for (const handle of [0, 1, 7, 65536, 0xffffffff]) {
    assert.equal(exports.body_new(handle), 0);
    assert.equal(exports.body_step(handle, 1), 0);
    assert.equal(exports.body_positions(handle), 0);
    assert.equal(exports.free(handle), 0);
    assert.equal(exports.asset_info(handle), 0);
    assert.equal(exports.body_restore(handle, handle), 0);
  }
  assert.equal(exports.asset_load(0xffffffff), 0, 'longer than the input');
  assert.equal(exports.body_pins(1, 0xffffffff), 0);
});

test('a step that would leave the range of f32 is refused, and the state stays', () => {
  const wild = other.body();
  wild.place(TET[0], new Float32Array(12).fill(3e38));
  const hash = wild.hash();
  const { taken, refusal } = wild.step(5);
  assert.equal(taken, 0);
  assert.match(refusal ?? '', /non-finite|too large/);
  assert.equal(wild.hash(), hash);
});

test('what was refused leaves nothing behind', async () => {
  const clean = await load(moduleBytes('femto.wasm'));
  const refuse = () => assert.throws(() => clean.asset(broken(400)), FemtoError);
  refuse();
  const bytes = clean.memoryBytes;
  for (let k = 0; k < 2000; k++) refuse();
  assert.equal(clean.kept, 0);
  assert.equal(clean.memoryBytes, bytes);
});
