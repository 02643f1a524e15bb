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

from ..arrays import Floats, Ints, Mask
from ..geometry import ranges
from ..mesh import TriangleMesh
from ..units import BRICK, PLATE, PLATES_PER_BRICK

_HORIZONTAL: Final = 0.999
"""Facets with a larger |n_z| are horizontal: they leave no cusp, only a step."""

_SHALLOW_SHARE: Final = 0.05
"""Share of a layer's surface that may exceed the cusp height (the 95th percentile)."""

# The half-edge i of a triangle runs from corner i to corner i + 1. For each pattern of
# corners above the plane (bit i: corner i is above): the half-edge that falls through
# the plane, and the one that rises through it. With outward normals the segment from
# the first to the second has the inside on its left.
_FALLS: Final = np.array([0, 0, 1, 1, 2, 0, 2, 0], dtype=np.int8)
_RISES: Final = np.array([0, 2, 0, 2, 1, 1, 0, 0], dtype=np.int8)
_NEXT: Final = np.array([1, 2, 0])


@dataclass(frozen=True, slots=True, eq=False)
class Slices:
    """The cut of a mesh by parallel planes, as unordered directed segments.

    A segment runs through a triangle from the half-edge that falls through the
    plane to the one that rises through it; the inside lies to its left.

    Attributes
    ----------
    mesh : TriangleMesh
        The mesh that was cut.
    axis : int
        Axis across the planes. Their own coordinates are the two axes after it.
    heights : (n_slices,) float64 array
        Positions of the planes along the axis in mm, rising.
    slice : (n,) int32 array
        Plane of each segment; the segments of a triangle come together, rising.
    face : (n,) int32 array
        Triangle of each segment, rising.
    enter, exit : (n,) int8 arrays
        Half-edges of the triangle, by their first corner, where the segment starts and ends.
    """

    mesh: TriangleMesh
    axis: int
    heights: Floats
    slice: NDArray[np.int32]
    face: NDArray[np.int32]
    enter: NDArray[np.int8]
    exit: NDArray[np.int8]

    def __len__(self) -> int:
        """Return the number of segments."""
        return len(self.face)

    @property
    def segments(self) -> Floats:
        """Start and end of every segment in mm, shape (n, 2, 2)."""
        rows = np.arange(len(self))
        return np.stack([self.starts(rows), self.ends(rows)], axis=1)

    @property
    def first(self) -> Ints:
        """Index such that ``first[f] + k`` is the segment of triangle f in plane k, where there is one, (n_f,)."""
        first = np.zeros(len(self.mesh.faces), dtype=np.int64)
        start = np.flatnonzero(np.diff(self.face, prepend=-1))
        first[self.face[start]] = start - self.slice[start]
        return first

    def starts(self, rows: Ints) -> Floats:
        """Return where segments start in mm, shape (k, 2)."""
        return self._points(rows, *self.falls(rows))

    def ends(self, rows: Ints) -> Floats:
        """Return where segments end in mm, shape (k, 2)."""
        return self._points(rows, *self.rises(rows))

    def uvs(self, rows: Ints) -> Floats:
        """Return the image coordinates at start and end of segments, shape (k, 2, 2)."""
        corner_uvs = self.mesh.uvs.reshape(-1, 2)
        uvs = np.empty((len(rows), 2, 2))
        for i, edge in enumerate((self.falls(rows), self.rises(rows))):
            low, high = (corner_uvs.take(corner, axis=0) for corner in edge)
            _, _, share = self._met(rows, *edge)
            uvs[:, i] = low + share[:, None] * (high - low)
        return uvs

    def falls(self, rows: Ints) -> tuple[Ints, Ints]:
        """Return the lower and the upper face corner of the edges through which segments enter, (k,) each."""
        corner, local = 3 * self.face.take(rows).astype(np.int64), self.enter.take(rows)
        return corner + _NEXT.take(local), corner + local

    def rises(self, rows: Ints) -> tuple[Ints, Ints]:
        """Return the lower and the upper face corner of the edges through which segments leave, (k,) each."""
        corner, local = 3 * self.face.take(rows).astype(np.int64), self.exit.take(rows)
        return corner + local, corner + _NEXT.take(local)

    def _met(self, rows: Ints, lower: Ints, upper: Ints) -> tuple[Floats, Floats, Floats]:
        """Return the lower and upper vertices of edges, and where between them, 0 to 1, they meet the planes."""
        low, high = (self.mesh.vertices.take(self.mesh.faces.take(corner), axis=0) for corner in (lower, upper))
        height = self.heights.take(self.slice.take(rows))
        return low, high, (height - low[:, self.axis]) / (high[:, self.axis] - low[:, self.axis])

    def _points(self, rows: Ints, lower: Ints, upper: Ints) -> Floats:
        """Return where edges meet the planes.

        Always computed from the lower to the upper vertex, so that the two
        triangles of an edge find the same point to the last bit.
        """
        low, high, share = self._met(rows, lower, upper)
        points = np.empty((len(rows), 2))
        for i, axis in enumerate(((self.axis + 1) % 3, (self.axis + 2) % 3)):
            points[:, i] = low[:, axis] + share * (high[:, axis] - low[:, axis])
        return points


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
    # the number of planes at or below a vertex
    rank = np.searchsorted(heights, mesh.vertices[:, axis], side="right").astype(np.int32)
    corners = rank.take(mesh.faces)
    lowest = np.minimum(np.minimum(corners[:, 0], corners[:, 1]), corners[:, 2])
    highest = np.maximum(np.maximum(corners[:, 0], corners[:, 1]), corners[:, 2])
    cut = np.flatnonzero(lowest != highest)
    corners, lowest, highest = corners.take(cut, axis=0), lowest.take(cut), highest.take(cut)
    row, level = ranges(lowest.astype(np.int64), (highest - lowest).astype(np.int64))
    pattern = np.zeros(len(row), dtype=np.int8)
    for i in range(3):
        above = corners[:, i].take(row) > level
        pattern += above.view(np.int8) << np.int8(i)
    return Slices(
        mesh=mesh,
        axis=axis,
        heights=heights,
        slice=level.astype(np.int32),
        face=cut.take(row).astype(np.int32),
        enter=_FALLS.take(pattern),
        exit=_RISES.take(pattern),
    )


def adaptive_heights(
    mesh: TriangleMesh,
    *,
    ground: float,
    n_layers: int,
    cusp: float,
    colour: NDArray[np.int16],
    marked: Mask | None = None,
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
    marked : (n_layers,) bool array, optional
        Layers that get three planes in any case.

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
    Dolenc and Mäkelä 1994: the cusp of a step of height t on a facet is ``t |n_z|``.
    """
    fine = _fine_layers(mesh, ground=ground, n_layers=n_layers, cusp=cusp, colour=colour)
    if marked is not None:
        fine |= marked
    wanted = np.ones((n_layers, PLATES_PER_BRICK), dtype=bool)
    wanted[~fine] = [False, True, False]
    layer, plate = np.nonzero(wanted)
    heights = ground + layer * BRICK + (plate + 0.5) * PLATE
    return heights, layer.astype(np.int32), plate.astype(np.int8)


def _fine_layers(mesh: TriangleMesh, *, ground: float, n_layers: int, cusp: float, colour: NDArray[np.int16]) -> Mask:
    """Return which layers need three planes, shape (n_layers,)."""
    a, b, c = (mesh.vertices.take(mesh.faces[:, i], axis=0) for i in range(3))
    area, slope = _areas_and_slopes(b - a, c - a)
    flat = slope > _HORIZONTAL
    lowest = (np.minimum(np.minimum(a[:, 2], b[:, 2]), c[:, 2]) - ground) / BRICK
    highest = (np.maximum(np.maximum(a[:, 2], b[:, 2]), c[:, 2]) - ground) / BRICK
    low = np.maximum(np.floor(lowest).astype(np.int64), 0)
    high = np.minimum(np.ceil(highest).astype(np.int64), n_layers)
    # no plane cuts a horizontal facet
    span = np.where(flat, 0, np.maximum(high - low, 0))
    face, layer = ranges(low, span)
    weight = (area / np.maximum(span, 1))[face]
    shallow = np.bincount(layer, weight * (BRICK * slope > cusp)[face], n_layers)
    surface = np.bincount(layer, weight, n_layers)
    steps = _steps_inside(lowest[flat], n_layers)
    return (shallow > _SHALLOW_SHARE * surface) | steps | _many_coloured(layer, colour[face], n_layers)


def _areas_and_slopes(first: Floats, second: Floats) -> tuple[Floats, Floats]:
    """Return twice the area of triangles with the given sides, and |n_z|: 0 where upright, 1 where level."""
    (x0, y0, z0), (x1, y1, z1) = first.T, second.T
    x, y, z = y0 * z1 - z0 * y1, z0 * x1 - x0 * z1, x0 * y1 - y0 * x1
    area = np.sqrt(x * x + y * y + z * z)
    return area, np.abs(z) / np.maximum(area, np.finfo(float).tiny)


def _steps_inside(height: Floats, n_layers: int) -> Mask:
    """Return which layers hold a horizontal facet farther than half a plate from their faces."""
    layer = np.floor(height).astype(np.int64)
    inside = (np.abs(height - np.round(height)) > 1 / (2 * PLATES_PER_BRICK)) & (layer >= 0) & (layer < n_layers)
    return np.bincount(layer[inside], minlength=n_layers) > 0


def _many_coloured(layer: Ints, colour: NDArray[np.int16], n_layers: int) -> Mask:
    """Return which layers meet facets of more than one colour."""
    met = np.zeros((n_layers, int(colour.max(initial=0)) + 2), dtype=bool)
    # the first column is for facets of several colours
    met[layer, colour + 1] = True
    several: Mask = met[:, 0] | (met[:, 1:].sum(axis=1) > 1)
    return several
