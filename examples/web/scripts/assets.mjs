// Bakes the page's bodies: `node scripts/assets.mjs`. The scenes of scenes/, by `femto bake`, into page/assets/.

import { mkdirSync, statSync } from 'node:fs';
import { join } from 'node:path';

import { here, root, run, targetOf } from './run.mjs';

/** The bodies, with the factor that each is baked with. */
export const BODIES = {
  snowman: 'warped',
  cube: 'warped',
  beam: 'warped',
  tower: 'laplacian',
};

/** The tool, built for this machine. */
export function buildTool() {
  run('cargo', ['build', '--locked', '--release', '--package', 'femto-cli'], { cwd: root('') });
  return join(targetOf(root('')), 'release', 'femto');
}

export function bakeAssets() {
  const femto = buildTool();
  mkdirSync(here('page/assets'), { recursive: true });
  for (const [name, factor] of Object.entries(BODIES)) {
    const out = here(`page/assets/${name}.femto`);
    const scene = here(`scenes/${name}.toml`);
    run(femto, ['bake', '--scene', scene, '--preconditioner', factor, '--precision', 'f16', '--out', out]);
    console.log(`${name}.femto: ${statSync(out).size} bytes`);
  }
}

if (process.argv[1] === here('scripts/assets.mjs')) bakeAssets();
