// The words of the module's refusals, for package/faults.js: `node scripts/faults.mjs`. The module itself has only the
// codes (`fault!` in src/fault.rs), so that nobody downloads words which are hardly ever read as part of the code.

import { readFileSync, readdirSync, writeFileSync } from 'node:fs';

import { here } from './run.mjs';

/** FNV-1a (32 bit) of a text's bytes. */
function code(text) {
  const step = (hash, byte) => Math.imul(hash ^ byte, 0x01000193);
  return new TextEncoder().encode(text).reduce(step, 0x811c9dc5) >>> 0;
}

/** The text of every code. */
export function faults() {
  const texts = new Map();
  for (const file of readdirSync(here('src'))) {
    for (const [, text] of readFileSync(here(`src/${file}`), 'utf8').matchAll(/fault!\(\s*"([^"]+)"/g)) {
      const other = texts.get(code(text)) ?? text;
      if (other !== text) throw new Error(`two texts with one code: ${text}; ${other}`);
      texts.set(code(text), text);
    }
  }
  return texts;
}

export function writeFaults() {
  const rows = [...faults()].map(([code, text]) => `  [${code}, ${JSON.stringify(text)}],\n`);
  const head = '// Made by scripts/faults.mjs from the module\'s source: what its refusals say.\n\n';
  writeFileSync(here('package/faults.js'), `${head}export const FAULTS = new Map([\n${rows.join('')}]);\n`);
}

if (process.argv[1] === here('scripts/faults.mjs')) writeFaults();
