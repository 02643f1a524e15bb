"""Where vertical rays through a fine lattice meet the mesh: the surface that slices see least."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from .mesh import TriangleMesh
from .model import Floats, Ints, Mask
from .ranges import ranges

_NEAR: Final = 1e-9
"""A ray this near to an edge, in pitches, meets it."""

_MARGIN: Final = 1e-6
"""Triangles that rays see no wider than this, in pitches, are upright; lattice points this far beside are tested."""

_SAME: Final = 1e-3
"""Hits on an edge are one if their heights differ by no more than this, in pitches."""


def vertical_hits(mesh: TriangleMesh, *, corner: Floats, pitch: float) -> tuple[NDArray[np.int64], Floats, Floats]:
    """Find where vertical rays through the lattice's cell centres meet the triangles.

    A ray through an edge or a vertex meets all triangles there, so that none is
    lost between them, left or right; but hits of surface that faces the same way
    count once. Upright triangles are met by no ray.

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
    reach = np.maximum(np.ptp(corners[:, :, 0], axis=1), np.ptp(corners[:, :, 1], axis=1))
    triangles = np.flatnonzero(np.abs(doubled) > _MARGIN * reach)
    row, place = _lattice_points(corners.take(triangles, axis=0))
    weight, least = _weights(corners.take(triangles, axis=0), row, place)
    met = least >= -_NEAR
    face, place, weight, on_edge = triangles[row[met]], place[met], weight[met], least[met] <= _NEAR
    points = np.einsum("ki,kij->kj", weight, mesh.vertices[mesh.faces[face]])
    uvs = np.einsum("ki,kij->kj", weight, mesh.uvs[face])
    once = ~_repeated(place, points[:, 2] / pitch, doubled[face] > 0, on_edge)
    return face[once], points[once], uvs[once]


def _weights(corners: Floats, row: Ints, place: Floats) -> tuple[Floats, Floats]:
    """Return the barycentric coordinates of points in triangles, and how far inside their sides they lie."""
    doubled = _cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[row]
    weight = np.empty((len(row), 3))
    least = np.full(len(row), np.inf)
    for i in range(3):
        start, end = corners[row, i - 2], corners[row, i - 1]
        # the twice areas of the triangles that the point makes with the sides
        side = _cross(start - place, end - place)
        weight[:, i] = side / doubled
        along = end - start
        least = np.minimum(least, side * np.sign(doubled) / np.hypot(along[:, 0], along[:, 1]))
    return weight, least


def _repeated(place: Floats, height: Floats, upwards: Mask, on_edge: Mask) -> Mask:
    """Return the hits on edges that repeat another one of the same ray, height and way of facing."""
    rows = np.flatnonzero(on_edge)
    rows = rows[np.lexsort((height[rows], upwards[rows], place[rows, 0], place[rows, 1]))]
    before, after = rows[:-1], rows[1:]
    same = (place[before] == place[after]).all(axis=1) & (upwards[before] == upwards[after])
    repeated = np.zeros(len(place), dtype=bool)
    repeated[after] = same & (height[after] - height[before] <= _SAME)
    return repeated


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
