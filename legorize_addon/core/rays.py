"""Where vertical rays through a fine lattice meet the mesh: the surface that slices see least."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .mesh import TriangleMesh
from .model import Floats, Ints


def vertical_hits(
    mesh: TriangleMesh, *, corner: Floats, pitch: float
) -> tuple[NDArray[np.int64], Floats, Floats]:
    """Find where vertical rays through the lattice's cell centres meet the triangles.

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
    corners = flat[mesh.faces]
    doubled = _cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    face, point = _lattice_points(corners, np.flatnonzero(doubled))
    # the twice areas of the triangles that the point makes with the sides, as shares: barycentric
    a, b, c = (corners[face, i] - point for i in range(3))
    weight = np.stack([_cross(b, c), _cross(c, a), _cross(a, b)], axis=1) / doubled[face, None]
    inside = (weight >= 0).all(axis=1)
    face, weight = face[inside], weight[inside]
    points = np.einsum("ki,kij->kj", weight, mesh.vertices[mesh.faces[face]])
    uvs = np.einsum("ki,kij->kj", weight, mesh.uvs[face])
    return face, points, uvs


def _lattice_points(corners: Floats, candidates: Ints) -> tuple[Ints, Floats]:
    """Return the integer points in the bounding boxes of triangles, and their triangles."""
    low = np.ceil(corners[candidates].min(axis=1)).astype(np.int64)
    high = np.floor(corners[candidates].max(axis=1)).astype(np.int64)
    size = np.maximum(high - low + 1, 0)
    count = size[:, 0] * size[:, 1]
    triangle = np.repeat(np.arange(len(candidates)), count)
    number = np.arange(len(triangle)) - np.repeat(np.cumsum(count) - count, count)
    width = size[triangle, 0]
    point = low[triangle] + np.stack([number % width, number // width], axis=1)
    return candidates[triangle], point.astype(np.float64)


def _cross(first: Floats, second: Floats) -> Floats:
    product: Floats = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    return product
