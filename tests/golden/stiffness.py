#!/usr/bin/env python3
"""Makes stiffness.txt: stiffness matrices and masses that femto is checked against.

Run:

    python3 -m venv venv
    venv/bin/pip install scikit-fem==12.0.2 numpy==2.4.6 scipy==1.17.1
    venv/bin/python stiffness.py [OUT.txt]

OUT.txt defaults to stiffness.txt beside this script. The file was made with the
versions above and Python 3.11 on x86-64; elsewhere the last digits may differ, and
with them which entries are rounding noise and which are exact zeros (left out).

The matrices come from scikit-fem's own linear_elasticity form on linear tets. The
script checks them before it writes: symmetry, zero row sums, no force under rigid
translations and small rotations, six rigid modes and no more, and agreement with
the closed form for a linear tet.

Conventions:
- small strain, isotropic: lambda = E nu / ((1 + nu)(1 - 2 nu)), mu = E / (2 (1 + nu));
- dof 3 * node + axis (x, y, z = 0, 1, 2), nodes and tets count from 0;
- a tet a b c d has (b - a) x (c - a) . (d - a) > 0;
- every coordinate and every material value of a mesh is as printed, and the
  coordinates are exact in 32-bit floats.

Meshes:
- tet: the unit corner tet;
- box: the box 1.0 x 0.5 x 0.25 in 2 x 1 x 1 cells. Node (i, j, k) has the index
  (i * (ny + 1) + j) * (nz + 1) + k. A cell gives six tets that walk from its low to
  its high corner along the axes in the orders xyz, xzy, yxz, yzx, zxy, zyx, the last
  two nodes swapped where that makes the volume positive. Cells go in the order of
  their low corners;
- warped: the same box in 2 x 2 x 1 cells, each coordinate moved by a pseudo-random
  multiple of 1/256 between -12/256 and 12/256.

Format: lines of fields parted by one space; "#" starts a comment line.

    mesh NAME young poisson n_nodes n_tets n_entries
    node x y z              n_nodes lines
    tet a b c d             n_tets lines
    k row col value         n_entries lines, the upper triangle (row <= col)
    mass node value         n_nodes lines

Mass lines are the row sums of the consistent scalar mass matrix for density 1000.
"""

import os
import sys

import numpy as np
import skfem
from skfem.models.elasticity import lame_parameters, linear_elasticity

DENSITY = 1000.0
ORDERS = [(0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)]


def volumes(nodes, tets):
    a, b, c, d = (nodes[tets[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


def box(size, cells):
    nx, ny, nz = cells

    def index(i, j, k):
        return (i * (ny + 1) + j) * (nz + 1) + k

    nodes = [
        [size[0] * i / nx, size[1] * j / ny, size[2] * k / nz]
        for i in range(nx + 1)
        for j in range(ny + 1)
        for k in range(nz + 1)
    ]
    nodes = np.array(nodes)
    tets = []
    for i in range(nx):
        for j in range(ny):
            for k in range(nz):
                for order in ORDERS:
                    at = [i, j, k]
                    tet = [index(*at)]
                    for axis in order:
                        at[axis] += 1
                        tet.append(index(*at))
                    if volumes(nodes, np.array([tet]))[0] < 0:
                        tet[2], tet[3] = tet[3], tet[2]
                    tets.append(tet)
    return nodes, np.array(tets)


def warped(size, cells):
    nodes, tets = box(size, cells)
    state = 1
    for node in nodes:
        for axis in range(3):
            state = (1664525 * state + 1013904223) % 2**32
            node[axis] += ((state >> 16) % 25 - 12) / 256
    return nodes, tets


def stiffness(nodes, tets, lam, mu):
    """scikit-fem's stiffness matrix, its rows and columns in the order 3 * node + axis."""
    mesh = skfem.MeshTet(nodes.T.copy(), tets.T.copy())
    assert np.array_equal(mesh.p.T, nodes)
    # The gradients are constant in a tet: one quadrature point is exact.
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementTetP1()), intorder=1)
    assert basis.X.shape[1] == 1
    k = linear_elasticity(lam, mu).assemble(basis).toarray()
    # nodal_dofs[axis, node] is scikit-fem's dof. doflocs shows that it is at the node.
    for axis in range(3):
        assert np.array_equal(basis.doflocs[:, basis.nodal_dofs[axis]], nodes.T)
    dofs = basis.nodal_dofs.T.ravel()
    assert np.array_equal(np.sort(dofs), np.arange(3 * len(nodes)))
    return k[np.ix_(dofs, dofs)]


def masses(nodes, tets):
    @skfem.BilinearForm
    def mass(u, v, _):
        return DENSITY * u * v

    mesh = skfem.MeshTet(nodes.T.copy(), tets.T.copy())
    basis = skfem.Basis(mesh, skfem.ElementTetP1(), intorder=2)
    m = mass.assemble(basis).toarray()
    return m[np.ix_(basis.nodal_dofs[0], basis.nodal_dofs[0])].sum(axis=1)


def closed_form(nodes, tets, lam, mu):
    """K_ab = V (lam ga gb^T + mu gb ga^T + mu (ga . gb) I) with shape gradients g."""
    k = np.zeros((3 * len(nodes), 3 * len(nodes)))
    for tet, volume in zip(tets, volumes(nodes, tets)):
        grads = np.linalg.inv(np.c_[np.ones(4), nodes[tet]])[1:].T
        for a, ga in zip(tet, grads):
            for b, gb in zip(tet, grads):
                block = lam * np.outer(ga, gb) + mu * np.outer(gb, ga) + mu * (ga @ gb) * np.eye(3)
                k[3 * a : 3 * a + 3, 3 * b : 3 * b + 3] += volume * block
    return k


def check(nodes, tets, k, m, lam, mu):
    assert (nodes.astype(np.float32).astype(np.float64) == nodes).all()
    assert np.array_equal(np.unique(tets), np.arange(len(nodes)))
    assert (volumes(nodes, tets) > 0).all()

    tiny = 1e-13 * abs(k).max()
    assert abs(k - k.T).max() < tiny
    for axis in range(3):
        # every row sums to zero over the dofs of each axis: rigid translations
        assert abs(k[:, axis::3].sum(axis=1)).max() < tiny
        turn = np.cross(np.eye(3)[axis], nodes)
        assert abs(k @ turn.ravel()).max() < tiny
    values = np.linalg.eigvalsh((k + k.T) / 2)
    assert abs(values[:6]).max() < tiny and values[6] > 1e-4 * values[-1], values
    assert abs(k - closed_form(nodes, tets, lam, mu)).max() < tiny
    # stretching along x with the sides held: twice the energy is (lam + 2 mu) V
    stretch = np.zeros(3 * len(nodes))
    stretch[0::3] = nodes[:, 0]
    volume = volumes(nodes, tets).sum()
    assert abs(stretch @ k @ stretch / ((lam + 2 * mu) * volume) - 1) < 1e-12

    share = np.zeros(len(nodes))
    np.add.at(share, tets, DENSITY * volumes(nodes, tets)[:, None] / 4)
    assert abs(m / share - 1).max() < 1e-12
    assert abs(m.sum() / (DENSITY * volume) - 1) < 1e-12


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    path = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "stiffness.txt")
    unit = np.vstack([np.zeros(3), np.eye(3)])
    meshes = [
        ("tet", 1.0, 0.25, unit, np.array([[0, 1, 2, 3]])),
        ("box", 1e6, 0.4, *box([1.0, 0.5, 0.25], [2, 1, 1])),
        ("warped", 2e5, -0.2, *warped([1.0, 0.5, 0.25], [2, 2, 1])),
    ]
    lines = [
        f"# Made by stiffness.py with scikit-fem {skfem.__version__}; see there for the format.",
        "# mesh NAME young poisson n_nodes n_tets n_entries",
        f"# then lines node, tet, k (upper triangle) and mass (density {DENSITY!r})",
    ]
    for name, young, poisson, nodes, tets in meshes:
        lam, mu = lame_parameters(young, poisson)
        k = stiffness(nodes, tets, lam, mu)
        m = masses(nodes, tets)
        check(nodes, tets, k, m, lam, mu)
        rows, cols = np.nonzero(np.triu(k))
        lines.append(f"mesh {name} {young!r} {poisson!r} {len(nodes)} {len(tets)} {len(rows)}")
        lines += ["node " + " ".join(repr(float(c)) for c in node) for node in nodes]
        lines += ["tet " + " ".join(str(c) for c in tet) for tet in tets]
        lines += [f"k {i} {j} {k[i, j]:.17g}" for i, j in zip(rows, cols)]
        lines += [f"mass {i} {value:.17g}" for i, value in enumerate(m)]
        volume = volumes(nodes, tets)
        noise = (abs(k[rows, cols]) < 1e-13 * abs(k).max()).sum()
        print(
            f"{name}: {len(nodes)} nodes, {len(tets)} tets, {len(rows)} entries, {noise} of them noise,"
            f" max {abs(k).max():.6g}, smallest volume {volume.min():.3e}, largest {volume.max():.3e},"
            f" mass {m.sum():.6g}"
        )
    with open(path, "w", encoding="ascii", newline="\n") as f:
        f.write("\n".join(lines) + "\n")
    print(f"{os.path.basename(path)}, {os.path.getsize(path)} bytes")


if __name__ == "__main__":
    main()
