"""Four meshes with overhangs: what cannot be built from below without supports."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from tests.core.solids import box, joined, mesh_of, reversed_mesh


def overhanging(size: float) -> dict[str, TriangleMesh]:
    """Return all four by name, ``size`` mm along their longest horizontal side."""
    return {"table": table(size), "t_shape": t_shape(size), "arch": arch(size), "box_car": box_car(size)}


def table(size: float) -> TriangleMesh:
    """Make a square top on four legs."""
    top = box((0, 0, 0.45), (1, 1, 0.55))
    legs = [box((x, y, 0), (x + 0.1, y + 0.1, 0.5)) for x in (0.05, 0.85) for y in (0.05, 0.85)]
    return _sized(joined(top, *legs), size)


def t_shape(size: float) -> TriangleMesh:
    """Make a wide top on one foot in the middle."""
    return _sized(joined(box((0, 0, 0.6), (1, 0.3, 0.7)), box((0.42, 0.07, 0), (0.58, 0.23, 0.65))), size)


def arch(size: float, n: int = 32) -> TriangleMesh:
    """Make a block with a half-round opening of n sides."""
    turn = np.linspace(0, np.pi, n + 1)
    round_ = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    # the same directions on a square, two of whose corners lie between them
    square = 0.5 * round_ / np.abs(round_).max(axis=1, keepdims=True)
    rings = [np.insert(ring, 1, y, axis=1) for y in (0, 0.25) for ring in (square, 0.35 * round_)]
    here = np.arange(n)
    outer, inner, outer_back, inner_back = (here + k * (n + 1) for k in range(4))
    strips = [(outer, inner), (inner_back, outer_back), (outer_back, outer), (inner, inner_back)]
    faces = [np.column_stack(each) for a, b in strips for each in ((a, a + 1, b), (a + 1, b + 1, b))]
    starts, ends = ([k * (n + 1) + at for k in range(4)] for at in (0, n))
    caps = [[*starts[:2], starts[2]], [starts[1], starts[3], starts[2]], [ends[1], ends[0], ends[2]], ends[1:4]]
    return _sized(mesh_of(np.concatenate(rings), np.concatenate([*faces, caps])), size)


def box_car(size: float) -> TriangleMesh:
    """Make a car: a wide flat chassis over four wheels, and on it a body that is hollow inside."""
    wheels = [box((x, y, 0), (x + 0.12, y + 0.08, 0.2)) for x in (0.12, 0.76) for y in (0.02, 0.4)]
    chassis = box((0, 0, 0.14), (1, 0.5, 0.22))
    body, inside = box((0.1, 0.02, 0.2), (0.9, 0.48, 0.55)), box((0.15, 0.07, 0.27), (0.85, 0.43, 0.5))
    return _sized(joined(*wheels, chassis, body, reversed_mesh(inside)), size)


def _sized(mesh: TriangleMesh, size: float) -> TriangleMesh:
    """Scale a mesh of length 1."""
    return mesh_of(mesh.vertices * size, mesh.faces)
