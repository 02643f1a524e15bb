"""Where vertical rays through a fine lattice meet the mesh: on level surface, which slices miss."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from ..geometry import ranges
from .triangle_mesh import TriangleMesh

_NEAR: Final = 1e-9
"""A ray that is this close to an edge, in pitches, meets it."""

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
    face, place = _lattice_points(flat, mesh.faces)
    corners = flat.take(mesh.faces.take(face, axis=0), axis=0)
    doubled = _cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    weight, least = _weights(corners, doubled, place)
    met = np.flatnonzero(least >= -_NEAR)
    face, place, weight, on_edge = face[met], place.take(met, axis=0), weight.take(met, axis=0), least[met] <= _NEAR
    points = np.einsum("ki,kij->kj", weight, mesh.vertices.take(mesh.faces.take(face, axis=0), axis=0))
    uvs = np.einsum("ki,kij->kj", weight, mesh.uvs.take(face, axis=0))
    once = np.flatnonzero(~_repeated(place, points[:, 2] / pitch, doubled[met] > 0, on_edge))
    return face[once], points.take(once, axis=0), uvs.take(once, axis=0)


def _weights(corners: Floats, doubled: Floats, place: Floats) -> tuple[Floats, Floats]:
    """Return the barycentric coordinates of points in triangles, and how far inside their sides they lie."""
    weight = np.empty((len(place), 3))
    least = np.full(len(place), np.inf)
    for i in range(3):
        start, end = corners[:, i - 2], corners[:, i - 1]
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


def _lattice_points(flat: Floats, faces: NDArray[np.int32]) -> tuple[Ints, Floats]:
    """Return the integer points in the triangles that are not upright, and a few beside; and the triangle of each."""
    x, y = (column.take(faces) for column in flat.T)
    left, right, low, high = (side for part in (x, y) for side in (_least(part), -_least(-part)))
    # most triangles of a fine mesh lie between the rays
    between = (np.ceil(left - _MARGIN) > right + _MARGIN) | (np.ceil(low - _MARGIN) > high + _MARGIN)
    near = np.flatnonzero(~between)
    corners = flat.take(faces.take(near, axis=0), axis=0)
    doubled = _cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    level = np.abs(doubled) > _MARGIN * np.maximum(right - left, high - low)[near]
    corners, near = corners[level], near[level]
    row, line = _lines(low[near], high[near])
    first, last = _crossings(corners.take(row, axis=0), line)
    place, column = _lines(first, last)
    return near[row[place]], np.column_stack([column, line[place]]).astype(np.float64)


def _lines(low: Floats, high: Floats) -> tuple[Ints, Ints]:
    """List the integers within intervals, a little enlarged, and the interval of each."""
    first, last = np.ceil(low - _MARGIN).astype(np.int64), np.floor(high + _MARGIN).astype(np.int64)
    return ranges(first, np.maximum(last - first + 1, 0))


def _crossings(corners: Floats, line: Ints) -> tuple[Floats, Floats]:
    """Return where triangles begin and end on horizontal lines through them, (k,) each."""
    left, right = np.full(len(line), np.inf), np.full(len(line), -np.inf)
    for i in range(3):
        (x0, y0), (x1, y1) = corners[:, i - 1].T, corners[:, i].T
        rise = y1 - y0
        steep = np.abs(rise) > _MARGIN
        share = np.clip((line - y0) / np.where(steep, rise, 1), 0, 1)
        met = (np.minimum(y0, y1) - _MARGIN <= line) & (line <= np.maximum(y0, y1) + _MARGIN)
        # a level side counts from end to end
        first, last = (np.where(steep, x0 + share * (x1 - x0), end) for end in (x0, x1))
        left = np.minimum(left, np.where(met, np.minimum(first, last), np.inf))
        right = np.maximum(right, np.where(met, np.maximum(first, last), -np.inf))
    return left, right


def _least(columns: Floats) -> Floats:
    """Return the least of the three numbers in every row."""
    least: Floats = np.minimum(np.minimum(columns[:, 0], columns[:, 1]), columns[:, 2])
    return least


def _cross(first: Floats, second: Floats) -> Floats:
    product: Floats = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    return product
