"""Where vertical rays through a fine lattice meet the mesh: the surface that slices see least."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from .mesh import TriangleMesh
from .model import Floats, Ints, Mask
from .ranges import ranges

_MARGIN: Final = 1e-6
"""How far beside a triangle, in pitches, lattice points are still tested exactly."""


def vertical_hits(mesh: TriangleMesh, *, corner: Floats, pitch: float) -> tuple[NDArray[np.int64], Floats, Floats]:
    """Find where vertical rays through the lattice's cell centres meet the triangles.

    A ray exactly through an edge or a vertex counts as infinitesimally beside it,
    so that it meets one of the triangles there and not several or none. The side
    of an edge is computed alike for both of its triangles: a ray can be lost only
    within rounding of a vertex. Upright triangles are met by no ray.

    Parameters
    ----------
    mesh : TriangleMesh
    corner : (2,) float64 array
        Corner of the lattice in mm.
    pitch : float
        Distance of the rays in mm.

    Returns
    -------
    face : (k,) int64 array
        Triangle of each hit.
    points : (k, 3) float64 array
        The hits in mm.
    uvs : (k, 2) float64 array
        Image coordinates of the hits.
    """
    flat = (mesh.vertices[:, :2] - corner) / pitch - 0.5
    corners = flat.take(mesh.faces, axis=0)
    doubled = _cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    triangles = np.flatnonzero(doubled)
    row, point = _lattice_points(corners.take(triangles, axis=0))
    face = triangles[row]
    # the twice areas of the triangles that the point makes with the sides, as shares: barycentric
    sides = [_cross(corners[face, i - 2] - point, corners[face, i - 1] - point) for i in range(3)]
    inside = np.ones(len(face), dtype=bool)
    for i, side in enumerate(sides):
        inside &= _on_left(side, corners[face, i - 1] - corners[face, i - 2], doubled[face])
    face, weight = face[inside], np.stack([side[inside] for side in sides], axis=1)
    weight /= doubled[face, None]
    points = np.einsum("ki,kij->kj", weight, mesh.vertices[mesh.faces[face]])
    uvs = np.einsum("ki,kij->kj", weight, mesh.uvs[face])
    return face, points, uvs


def _on_left(side: Floats, along: Floats, doubled: Floats) -> Mask:
    """Return whether points lie on the inner side of a side of their triangles.

    Parameters
    ----------
    side : (k,) float64 array
        Twice the signed area that the point makes with the side.
    along : (k, 2) float64 array
        From the start of the side to its end.
    doubled : (k,) float64 array
        Twice the signed area of the triangle.
    """
    # a point on the line is moved by an infinitesimal along x, and by its square along y
    moved = np.where(along[:, 1] != 0, -along[:, 1], along[:, 0])
    left: Mask = np.where(side != 0, side, moved) * np.sign(doubled) > 0
    return left


def _lattice_points(corners: Floats) -> tuple[Ints, Floats]:
    """Return the integer points in triangles, and a few beside them; and the triangle of each."""
    y = corners[:, :, 1]
    low, high = np.ceil(y.min(axis=1)).astype(np.int64), np.floor(y.max(axis=1)).astype(np.int64)
    triangle, line = ranges(low, np.maximum(high - low + 1, 0))
    left, right = np.full(len(line), np.inf), np.full(len(line), -np.inf)
    for i in range(3):
        (x0, y0), (x1, y1) = corners[triangle, i - 1].T, corners[triangle, i].T
        rise = y1 - y0
        steep = np.abs(rise) > _MARGIN
        share = (line - y0) / np.where(steep, rise, 1)
        met = (np.minimum(y0, y1) <= line) & (line <= np.maximum(y0, y1))
        # a level side counts from end to end
        first, last = (np.where(steep, x0 + share * (x1 - x0), end) for end in (x0, x1))
        left = np.minimum(left, np.where(met, np.minimum(first, last), np.inf))
        right = np.maximum(right, np.where(met, np.maximum(first, last), -np.inf))
    begin, end = np.ceil(left - _MARGIN).astype(np.int64), np.floor(right + _MARGIN).astype(np.int64)
    row, column = ranges(begin, np.maximum(end - begin + 1, 0))
    return triangle[row], np.column_stack([column, line[row]]).astype(np.float64)


def _cross(first: Floats, second: Floats) -> Floats:
    product: Floats = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    return product
