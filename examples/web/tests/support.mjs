// What the tests have in common.

import { readFileSync } from 'node:fs';

import { BODIES } from '../scripts/assets.mjs';
import { BUILDS } from '../scripts/module.mjs';
import { here } from '../scripts/run.mjs';

export { BODIES, BUILDS };

export const moduleBytes = (file) => readFileSync(here(`package/${file}`));
export const assetBytes = (name) => readFileSync(here(`page/assets/${name}.femto`));

/** Four nodes, one tetrahedron. */
export const TET = [new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]), new Uint32Array([0, 1, 2, 3])];
export const SOFT = { young: 1e5, poisson: 0.4, density: 1000 };
