// The run whose bits are committed: golden.json says which, and what `femto run` on a native machine made of it.

/** Runs it on a fresh body, and gives [step, hash] at every checkpoint. */
export function* runGolden(asset, { hashes, iterations, sweeps, start, ground }) {
  const body = asset.body();
  try {
    body.configure({ iterations, sweeps, start, preconditioner: 'jacobi' });
    body.setColliders([ground]);
    let taken = 0;
    for (const [step] of hashes) {
      taken += body.step(step - taken).taken;
      yield [taken, body.hash()];
    }
  } finally {
    body.free();
  }
}
