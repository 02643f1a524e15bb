"""Cut a mesh with parallel planes: where to cut, and the segments of the cut.

A vertex that lies exactly on a plane counts as above it, which is the same as
lowering every plane by an infinitesimal (simulation of simplicity). So every
triangle meets a plane in no segment or in one, never in a point or an edge, and
the choice is the same for all triangles around a vertex.

References
----------
Paper, section "Adaptive slicing"; A. Dolenc and I. Mäkelä, "Slicing procedures
for layered manufacturing techniques", CAD 26(2), 1994 (cusp height); H.
Edelsbrunner and E. Mücke, "Simulation of simplicity", ACM TOG 9(1), 1990.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from .mesh import TriangleMesh
from .model import Floats, Ints, Mask
from .units import BRICK, PLATE, PLATES_PER_BRICK

_HORIZONTAL: Final = 0.999
"""Facets with a larger |n_z| are horizontal: they leave no cusp, only a step."""

_SHALLOW_SHARE: Final = 0.05
"""Share of a layer's surface that may exceed the cusp height (the 95th percentile)."""

# The local half-edge i of a triangle runs from corner i to corner i + 1. For each
# pattern of corners above the plane (bit i: corner i is above): the half-edge that
# goes down through the plane, and the one that comes up. With outward normals the
# segment from the first to the second has the inside on its left.
_DOWN: Final = np.array([0, 0, 1, 1, 2, 0, 2, 0])
_UP: Final = np.array([0, 2, 0, 2, 1, 1, 0, 0])


@dataclass(frozen=True, slots=True, eq=False)
class Slices:
    """The cut of a mesh by parallel planes, as unordered directed segments.

    Attributes
    ----------
    heights : (n_slices,) float64 array
        Heights of the planes in mm, rising.
    segments : (n, 2, 2) float64 array
        Start and end of each segment in mm; the inside lies to the left.
    uvs : (n, 2, 2) float64 array
        Image coordinates at start and end.
    slice : (n,) int32 array
        Plane of each segment.
    face : (n,) int32 array
        Triangle of each segment.
    exit : (n,) int8 array
        Local half-edge of the triangle through which the segment ends.
    first : (n_faces,) int64 array
        ``first[f] + k`` is the segment of triangle f in plane k, where there is one.
    """

    heights: Floats
    segments: Floats
    uvs: Floats
    slice: NDArray[np.int32]
    face: NDArray[np.int32]
    exit: NDArray[np.int8]
    first: Ints

    def __len__(self) -> int:
        """Return the number of segments."""
        return len(self.face)


def slice_mesh(mesh: TriangleMesh, heights: Floats, *, axis: int = 2) -> Slices:
    """Cut a mesh with planes across an axis.

    Parameters
    ----------
    mesh : TriangleMesh
    heights : (n_slices,) float64 array
        Positions of the planes along the axis in mm, rising.
    axis : int
        0, 1 or 2. The planes' own coordinates are the two axes after it in
        cyclic order, so that outer loops are counter-clockwise for every axis.

    Returns
    -------
    Slices
    """
    plane = [(axis + 1) % 3, (axis + 2) % 3]
    rank = np.searchsorted(heights, mesh.vertices[:, axis], side="right")
    corner_rank = rank[mesh.faces]
    lowest = corner_rank.min(axis=1)
    count = corner_rank.max(axis=1) - lowest
    first = np.cumsum(count) - count - lowest
    face = np.repeat(np.arange(len(mesh.faces)), count)
    level = np.arange(len(face)) - first[face]
    above = corner_rank[face] > level[:, None]
    pattern = above @ np.array([1, 2, 4])
    down, up = _DOWN[pattern], _UP[pattern]
    ends = [
        _cross(mesh, heights[level], axis, plane, lower=3 * face + (down + 1) % 3, upper=3 * face + down),
        _cross(mesh, heights[level], axis, plane, lower=3 * face + up, upper=3 * face + (up + 1) % 3),
    ]
    return Slices(
        heights=heights,
        segments=np.stack([point for point, _ in ends], axis=1),
        uvs=np.stack([uv for _, uv in ends], axis=1),
        slice=level.astype(np.int32),
        face=face.astype(np.int32),
        exit=up.astype(np.int8),
        first=first,
    )


def _cross(
    mesh: TriangleMesh, height: Floats, axis: int, plane: list[int], *, lower: Ints, upper: Ints
) -> tuple[Floats, Floats]:
    """Return the points and uvs where the edges between two face corners each meet a height.

    Always computed from the lower to the upper vertex, so that the two triangles
    of an edge find the same point to the last bit.
    """
    corners = mesh.faces.ravel()
    low, high = mesh.vertices[corners[lower]], mesh.vertices[corners[upper]]
    share = ((height - low[:, axis]) / (high[:, axis] - low[:, axis]))[:, None]
    uvs = mesh.uvs.reshape(-1, 2)
    return (
        low[:, plane] + share * (high[:, plane] - low[:, plane]),
        uvs[lower] + share * (uvs[upper] - uvs[lower]),
    )


def adaptive_heights(
    mesh: TriangleMesh, *, ground: float, n_layers: int, cusp: float, colour: NDArray[np.int16]
) -> tuple[Floats, NDArray[np.int32], NDArray[np.int8]]:
    """Choose the planes of every brick layer: its middle, or the middles of its three plates.

    A layer gets three planes where more than a twentieth of its surface would
    leave steps above the cusp height between planes 9.6 mm apart, where a
    horizontal facet lies inside it, or where its surface has more than one
    colour; else one.

    Parameters
    ----------
    mesh : TriangleMesh
    ground : float
        Height of the lower side of layer 0 in mm.
    n_layers : int
    cusp : float
        Largest cusp height in mm.
    colour : (n_faces,) int16 array
        The one colour of a facet, or -1 where it has several.

    Returns
    -------
    heights : (n_slices,) float64 array
        Rising heights of the planes in mm.
    layer : (n_slices,) int32 array
        Brick layer of each plane.
    plate : (n_slices,) int8 array
        Plate of the layer whose middle the plane is (1: the middle of the brick as well).

    References
    ----------
    Dolenc and Mäkelä 1994: the cusp of a step of height t on a facet is t |n_z|.
    """
    fine = _fine_layers(mesh, ground=ground, n_layers=n_layers, cusp=cusp, colour=colour)
    wanted = np.ones((n_layers, PLATES_PER_BRICK), dtype=bool)
    wanted[~fine] = [False, True, False]
    layer, plate = np.nonzero(wanted)
    heights = ground + layer * BRICK + (plate + 0.5) * PLATE
    return heights, layer.astype(np.int32), plate.astype(np.int8)


def _fine_layers(mesh: TriangleMesh, *, ground: float, n_layers: int, cusp: float, colour: NDArray[np.int16]) -> Mask:
    """Return which layers need three planes, shape (n_layers,)."""
    corners = mesh.vertices[mesh.faces]
    z = (corners[:, :, 2] - ground) / BRICK
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(normal, axis=1)
    slope = np.abs(normal[:, 2]) / np.maximum(area, np.finfo(float).tiny)
    flat = slope > _HORIZONTAL
    low = np.clip(np.floor(z.min(axis=1)).astype(int), 0, n_layers - 1)
    high = np.clip(np.ceil(z.max(axis=1)).astype(int) - 1, low, n_layers - 1)
    span = high - low + 1
    face = np.repeat(np.arange(len(area)), span)
    layer = np.arange(len(face)) - np.repeat(np.cumsum(span) - span - low, span)
    weight = (area / span * ~flat)[face]
    shallow = np.bincount(layer, weight * (BRICK * slope > cusp)[face], n_layers)
    steps = _steps_inside(z[flat, 0], n_layers)
    surface = np.bincount(layer, weight, n_layers)
    return (shallow > _SHALLOW_SHARE * surface) | steps | _many_coloured(layer, colour[face], n_layers)


def _steps_inside(height: Floats, n_layers: int) -> Mask:
    """Return which layers hold a horizontal facet farther than half a plate from their faces."""
    rounding = np.abs(height - np.round(height)) > 1 / (2 * PLATES_PER_BRICK)
    layer = np.clip(np.floor(height[rounding]).astype(int), 0, n_layers - 1)
    return np.bincount(layer, minlength=n_layers) > 0


def _many_coloured(layer: Ints, colour: NDArray[np.int16], n_layers: int) -> Mask:
    """Return which layers meet facets of more than one colour."""
    lowest = np.full(n_layers, np.iinfo(np.int16).max, dtype=np.int16)
    highest = np.full(n_layers, -1, dtype=np.int16)
    np.minimum.at(lowest, layer, colour)
    np.maximum.at(highest, layer, colour)
    return (lowest < 0) | (lowest < highest)
