"""What the scripts that make meshes share: one volume in, one file of tets out, looked over.

The only physical group is the volume (tag 1), so a file holds no elements but tets and no nodes but
theirs. Coordinates are rounded to 1e-6. A file is read back without Gmsh's help, and a script fails if a
count, a volume or a node's use is not as it should be.
"""

import os
import sys

import gmsh
import numpy as np

DIGITS = 6  # decimals kept in the coordinates
TET4 = 4  # Gmsh's element type number


def make(path, size, build):
    """Meshes the one volume that `build(occ)` makes and writes it; returns Gmsh's version."""
    gmsh.initialize(readConfigFiles=False)
    try:
        number = gmsh.option.setNumber
        number("General.Terminal", 0)
        number("General.NumThreads", 1)
        number("Mesh.RandomSeed", 1)
        number("Mesh.MeshSizeFromPoints", 0)
        number("Mesh.MeshSizeMin", size)
        number("Mesh.MeshSizeMax", size)
        number("Mesh.Algorithm", 6)  # surfaces: frontal Delaunay
        number("Mesh.Algorithm3D", 1)  # volume: Delaunay
        number("Mesh.MshFileVersion", 4.1)
        number("Mesh.Binary", 0)
        number("Mesh.SaveAll", 0)
        number("Mesh.SaveParametric", 0)

        body = build(gmsh.model.occ)
        gmsh.model.occ.synchronize()
        assert len(body) == 1 and gmsh.model.getEntities(3) == body, body

        mesh = gmsh.model.mesh
        gmsh.model.addPhysicalGroup(3, [body[0][1]], 1)
        mesh.generate(3)
        mesh.optimize("Netgen")
        mesh.renumberNodes()
        mesh.renumberElements()
        tags, coords, _ = mesh.getNodes()
        for tag, xyz in zip(tags, coords.reshape(-1, 3)):
            # + 0.0 makes a zero of a negative zero
            mesh.setNode(tag, [round(float(c), DIGITS) + 0.0 for c in xyz], [])
        gmsh.write(path)
        return gmsh.option.getString("General.Version")
    finally:
        gmsh.finalize()


def read(path):
    """The nodes and tets of a Mesh format 4.1 ASCII file, without Gmsh's help."""
    sections, name = {}, None
    with open(path, encoding="ascii") as f:
        for line in f:
            line = line.strip()
            if name is None:
                name = line[1:]
                sections[name] = []
            elif line == "$End" + name:
                name = None
            else:
                sections[name].append(line.split())
    assert sections["MeshFormat"][0][:2] == ["4.1", "0"], sections["MeshFormat"]

    rows = iter(sections["Nodes"])
    blocks, n_nodes, low, high = map(int, next(rows))
    nodes = {}
    for _ in range(blocks):
        _, _, parametric, n = map(int, next(rows))
        assert parametric == 0
        tags = [int(next(rows)[0]) for _ in range(n)]
        for tag in tags:
            nodes[tag] = [float(c) for c in next(rows)]
    assert len(nodes) == n_nodes and sorted(nodes) == list(range(1, n_nodes + 1))
    assert (low, high) == (1, n_nodes)

    rows = iter(sections["Elements"])
    blocks, n_tets, _, _ = map(int, next(rows))
    tets = []
    for _ in range(blocks):
        dim, _, kind, n = map(int, next(rows))
        assert (dim, kind) == (3, TET4), (dim, kind)
        tets += [[int(c) - 1 for c in next(rows)[1:]] for _ in range(n)]
    assert len(tets) == n_tets
    return np.array([nodes[t] for t in sorted(nodes)]), np.array(tets)


def check(nodes, tets, count):
    """Fails if the mesh is not one closed body of good tets with about `count` nodes; prints its quality."""
    assert abs(len(nodes) - count) <= 0.03 * count, len(nodes)
    assert np.array_equal(np.unique(tets), np.arange(len(nodes))), "unused node"
    assert len(np.unique(np.sort(tets, axis=1), axis=0)) == len(tets), "double tet"
    assert len(np.unique(nodes, axis=0)) == len(nodes), "double node"

    a, b, c, d = (nodes[tets[:, i]] for i in range(4))
    u, v, w = b - a, c - a, d - a
    volume = np.einsum("ij,ij->i", np.cross(u, v), w) / 6
    assert (volume > 0).all(), "tet of no or negative volume"

    # Each inner face belongs to two tets; the outer ones make one closed surface.
    faces = np.sort(np.concatenate([np.delete(tets, i, axis=1) for i in range(4)]), axis=1)
    faces, uses = np.unique(faces, axis=0, return_counts=True)
    outer = faces[uses == 1]
    assert uses.max() == 2
    rim = np.sort(np.concatenate([outer[:, [0, 1]], outer[:, [0, 2]], outer[:, [1, 2]]]), axis=1)
    rim, uses = np.unique(rim, axis=0, return_counts=True)
    assert (uses == 2).all()
    assert len(np.unique(outer)) - len(rim) + len(outer) == 2, "not a sphere's topology"

    edges = np.stack([u, v, w, c - b, d - b, d - c])
    length2 = (edges**2).sum(axis=2)
    # circumradius from the vector a -> circumcentre
    square = lambda p: (p * p).sum(axis=1, keepdims=True)
    centre = square(u) * np.cross(v, w) + square(v) * np.cross(w, u) + square(w) * np.cross(u, v)
    radius = np.linalg.norm(centre, axis=1) / (12 * volume)
    area = sum(
        np.linalg.norm(np.cross(p, q), axis=1) / 2 for p, q in [(u, v), (u, w), (v, w), (v - u, w - u)]
    )
    inradius = 3 * volume / area

    mean_ratio = 12 * (3 * volume) ** (2 / 3) / length2.sum(axis=0)
    radius_ratio = 3 * inradius / radius
    radius_edge = radius / np.sqrt(length2.min(axis=0))
    length = np.sqrt(length2)
    print(f"nodes {len(nodes)}, tets {len(tets)}, outer triangles {len(outer)}")
    for axis, lo, hi in zip("xyz", nodes.min(axis=0), nodes.max(axis=0)):
        print(f"{axis} from {lo:g} to {hi:g}")
    print(f"volume {volume.sum():.6f}, of a tet {volume.min():.3e} to {volume.max():.3e}")
    print(f"edge length {length.min():.4f} to {length.max():.4f}")
    print(f"mean ratio (1 is best): min {mean_ratio.min():.3f}, median {np.median(mean_ratio):.3f}")
    print(f"3 r/R (1 is best): min {radius_ratio.min():.3f}, median {np.median(radius_ratio):.3f}")
    print(f"R/shortest edge (0.612 is best): max {radius_edge.max():.3f}, median {np.median(radius_edge):.3f}")
    assert mean_ratio.min() > 0.2
    assert nodes[:, 1].min() == 0


def run(script, count, size, build):
    """What each script does: writes NAME.msh beside NAME.py, or where it is told, and looks it over."""
    name = os.path.splitext(os.path.basename(script))[0] + ".msh"
    path = sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(os.path.abspath(script)), name)
    if not path.endswith(".msh"):
        sys.exit(f"usage: {os.path.basename(script)} [OUT.msh]")
    version = make(path, size, build)
    print(f"{os.path.basename(path)}, Gmsh {version}, {os.path.getsize(path)} bytes")
    check(*read(path), count)
