// Small things that the scripts share.

import { spawnSync } from 'node:child_process';
import { fileURLToPath } from 'node:url';

/** A path from examples/web. */
export const here = (path) => fileURLToPath(new URL(`../${path}`, import.meta.url));
/** A path from the repository's root. */
export const root = (path) => here(`../../${path}`);

/** Runs a program, says what it said if it fails, and gives its output. */
export function run(program, args, { cwd = here(''), env = {} } = {}) {
  const { status, stdout, stderr, error } = spawnSync(program, args, {
    cwd,
    env: { ...process.env, ...env },
    encoding: 'utf8',
    maxBuffer: 1 << 28,
  });
  if (status !== 0) throw new Error(`${program} ${args.join(' ')}: ${error ?? ''}\n${stdout}\n${stderr}`);
  return stdout;
}

/** Where cargo puts what it makes, for the workspace of this folder. */
export const targetOf = (cwd) =>
  JSON.parse(run('cargo', ['metadata', '--format-version=1', '--no-deps', '--locked'], { cwd })).target_directory;
