// Bundles the page into dist/: `node scripts/page.mjs`. A folder that any static server can show, without the net.

import { copyFileSync, cpSync, mkdirSync, rmSync } from 'node:fs';

import esbuild from 'esbuild';

import { BUILDS } from './module.mjs';
import { here } from './run.mjs';

export async function buildPage() {
  rmSync(here('dist'), { recursive: true, force: true });
  mkdirSync(here('dist'));
  await esbuild.build({
    entryPoints: { main: here('page/src/main.js') },
    outdir: here('dist'),
    bundle: true,
    minify: true,
    format: 'esm',
    target: ['chrome123', 'firefox128', 'safari17.5'],
    legalComments: 'linked',
    logLevel: 'warning',
  });
  await esbuild.build({
    stdin: {
      contents: `@import 'uplot/dist/uPlot.min.css'; @import './style.css';`,
      loader: 'css',
      resolveDir: here('page'),
    },
    outfile: here('dist/main.css'),
    bundle: true,
    minify: true,
    target: ['chrome123', 'firefox128', 'safari17.5'],
    logLevel: 'warning',
  });
  copyFileSync(here('page/index.html'), here('dist/index.html'));
  cpSync(here('page/assets'), here('dist/assets'), { recursive: true });
  for (const { file } of BUILDS) copyFileSync(here(`package/${file}`), here(`dist/${file}`));
}

if (process.argv[1] === here('scripts/page.mjs')) await buildPage();
