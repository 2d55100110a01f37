// The package as a TypeScript program uses it; checked by `npm run types`, not run.

import { FemtoError, hasSimd, load } from '../package/index.js';

export async function simulate(bytes: ArrayBuffer): Promise<string> {
  const femto = await load(new URL(hasSimd() ? 'femto-simd.wasm' : 'femto.wasm', 'http://localhost/'));
  const body = femto.asset(bytes).body();
  body.configure({ iterations: 8, start: 'rigid-1', preconditioner: 'factor' });
  body.setColliders([{ normal: [0, 1, 0], friction: 0.4 }, { centre: [0, 0, 0], radius: 1 }]);
  body.setPins([{ node: 0, velocity: [0, 0, 1] }]);
  const { refusal } = body.step(100);
  if (refusal !== null) throw new FemtoError(refusal);
  const height: number = body.positions[1] ?? 0;
  // @ts-expect-error a start must be one that there is
  body.configure({ start: 'sideways' });
  // @ts-expect-error a collider has one shape
  body.setColliders([{ friction: 1 }]);
  body.free();
  return `${height} ${body.hash()}`;
}
