// The golden scenes, which every target of the crate runs to the same hashes (examples/cases): here in a module of
// their own, that is loaded when someone asks.

/**
 * Runs all scenes of a module one after the other: the name of each, and [step, hash, committed hash] at its
 * checkpoints; none where it did not run.
 */
export async function* runScenes(bytes) {
  const { instance } = await WebAssembly.instantiate(bytes, {});
  const { memory, scenes, name, name_length, run_scene, step_at, hash_at, golden_at } = instance.exports;
  const text = (scene, part) =>
    new TextDecoder().decode(new Uint8Array(memory.buffer, name(scene, part), name_length(scene, part)));
  const hex = (hash) => BigInt.asUintN(64, hash).toString(16).padStart(16, '0');
  for (let scene = 0; scene < scenes(); scene++) {
    const checkpoints = Array.from({ length: run_scene(scene) }, (_, at) => [step_at(at), hex(hash_at(at)), hex(golden_at(at))]);
    yield { name: `${text(scene, 0)} ${text(scene, 1)}`, checkpoints };
    await new Promise((done) => setTimeout(done));
  }
}

/** Whether a scene came to its end with the committed hashes. */
export const matches = ({ checkpoints }) =>
  checkpoints.length > 0 && checkpoints.every(([, hash, golden]) => hash === golden);
