"""Which way is up: turning a mesh upright, and finding from its shape how it stands.

Some file formats do not say which axis points up. The shape can tell: legs, wheels and bases are made to stand on,
noses and backs are not.
"""

from __future__ import annotations

import math
from dataclasses import replace
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats
from .triangle_mesh import TriangleMesh

TURNS: Final = MappingProxyType(
    {
        "x": ((0, 0, -1), (0, 1, 0), (1, 0, 0)),
        "y": ((1, 0, 0), (0, 0, -1), (0, 1, 0)),
        "z": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    }
)
"""Rotation that turns each axis to z; for y, the one of Blender's importers."""

FALLEN: Final = -90.0
"""Degrees for a shape without any base."""

_SHAKY: Final = 7.0
_FIRM: Final = 3.0
_GAIN: Final = 5.0
"""Degrees: what stands less firmly than the first may be turned, to stand by the second at least, and the third more.

Chosen on models and shapes of boxes, balls, capsules and cones, standing and lying. The rule as it is now was measured
on eight models and the sample alone; that it never turns what stands is not proven. What is shaky is a column more than
eight times as high as wide.
"""

_FLATTER: Final = 8.0
"""Columns and pictures are unstable upright, stable lying: not laid down to less than this share of their height."""

_BASE: Final = 0.003
"""Share of the diagonal within which points of the base lie: the soles of a figure, not the curve of its back."""


_SAMPLES: Final = 1_000_000
"""Number of triangles that is enough to find the centre of a surface."""


def turn_upright(mesh: TriangleMesh, up: str) -> tuple[TriangleMesh, Floats]:
    """Turn a mesh so that one of its axes points up.

    Parameters
    ----------
    mesh : TriangleMesh
        Of finite coordinates.
    up : {"auto", "x", "y", "z"}
        The axis; the first one leaves the mesh as it is, like the last.

    Returns
    -------
    mesh : TriangleMesh
        Standing where it lay: on the same ground, about the same middle.
    turn : (4, 4) float64 array
        From the old to the new coordinates, for column vectors (x, y, z, 1).
    """
    turn = np.eye(4)
    standing = turn_mesh(mesh, up)
    if standing is mesh:
        return mesh, turn
    turn[:3, :3] = TURNS[up]
    turn[:3, 3] = _foot(mesh.vertices) - _foot(standing.vertices)
    return replace(mesh, vertices=standing.vertices + turn[:3, 3]), turn


def turn_mesh(mesh: TriangleMesh, up: str) -> TriangleMesh:
    """Return a mesh turned as by :func:`turn_upright`, but about the origin, whatever its coordinates are."""
    if up in ("auto", "z"):
        return mesh
    return replace(mesh, vertices=mesh.vertices @ np.array(TURNS[up], dtype=np.float64).T)


def stands_better(vertices: Floats, faces: NDArray[np.integer], usual: str, other: str) -> bool:
    """Return whether a shape is clearly meant to stand along another axis than the usual one.

    Parameters
    ----------
    vertices : (n, 3) float64 array
    faces : (m, 3) integer array
    usual, other : {"x", "y", "z"}
        Axes.

    Returns
    -------
    bool
        False in doubt.
    """
    now, then = (steadiness(vertices @ np.array(TURNS[up]).T, faces) for up in (usual, other))
    height, new_height = (np.ptp(vertices[:, "xyz".index(up)]) for up in (usual, other))
    firm = then >= _FIRM and then > now + _GAIN
    return bool(now < _SHAKY and firm and new_height * _FLATTER > height)


def steadiness(vertices: Floats, faces: NDArray[np.integer]) -> float:
    """Return how far a shape can be tilted before it falls over.

    Parameters
    ----------
    vertices : (n, 3) float64 array
        z up; of any unit.
    faces : (m, 3) integer array

    Returns
    -------
    float
        Degrees between the upright and the line from the nearest edge of the base to the middle of the surface. Below
        0 it falls by itself, :data:`FALLEN` without any base.
    """
    # slow to import, and only files without an axis need it
    from scipy.spatial import ConvexHull, QhullError

    used = np.zeros(len(vertices), dtype=bool)
    used[faces] = True
    points = vertices[used]
    ground = points[:, 2].min()
    base = points[points[:, 2] <= ground + _BASE * math.hypot(*np.ptp(points, axis=0))][:, :2]
    corners = vertices[faces[:: len(faces) // _SAMPLES + 1]]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    if not areas.any():
        return FALLEN
    middle = areas @ corners.mean(axis=1) / areas.sum()
    try:
        edges = ConvexHull(base).equations
    except QhullError:
        # less than a triangle
        return FALLEN
    inside = -float((edges[:, :2] @ middle[:2] + edges[:, 2]).max())
    return math.degrees(math.atan2(inside, float(middle[2] - ground)))


def _foot(vertices: Floats) -> Floats:
    """Return the middle of the bottom of the box around vertices."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    return np.array([*(low + high)[:2] / 2, low[2]])
