// The outer triangles of a mesh of tetrahedra.

/** Faces of a positively oriented tetrahedron, seen from outside counter-clockwise. */
const FACES = [
  [0, 2, 1],
  [0, 1, 3],
  [0, 3, 2],
  [1, 2, 3],
];

/** Three nodes a triangle: the faces that only one tetrahedron has. @param {Uint32Array} corners */
export function surface(corners) {
  const faces = new Map();
  for (let tet = 0; tet < corners.length; tet += 4) {
    for (const face of FACES) {
      const nodes = face.map((corner) => corners[tet + corner]);
      const key = [...nodes].sort((a, b) => a - b).join();
      if (faces.has(key)) faces.set(key, null);
      else faces.set(key, nodes);
    }
  }
  return new Uint32Array([...faces.values()].filter(Boolean).flat());
}
