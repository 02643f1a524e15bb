"""Repairing a triangle mesh: welding, duplicate faces, triangles without area, small holes.

Works on plain arrays. Lengths are shares of the mesh's diagonal, so that the
constants hold for a model of any size.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..arrays import Floats, Ints, Mask
from .topology import Edges, areas_and_longest_sides, components, regions, rim_fans, rim_loops, rim_nodes, spread

WELD: Final = 1e-6
"""Vertices closer than this share of the diagonal are one (float32 coordinates are exact to 1e-7)."""

HOLE: Final = 0.02
"""Holes no wider than this share of the diagonal are filled: about a stud on a model of 48 studs."""

SLIT: Final = HOLE / 10
"""Holes narrower than this share of the diagonal are filled too, such as cracks between badly joined faces."""

HOLE_AREA: Final = 0.25
"""A hole takes no more than this share of its surface's area; the rim of a loose sheet takes all of it."""


def weld(points: Floats, tolerance: float) -> Ints:
    """Return for every point the first point that it coincides with.

    Points in one cell of half the tolerance are one at once; what lies on
    either side of a cell border is found by a k-d tree. Chains of close points
    become one point.

    Parameters
    ----------
    points : (n, 3) float64 array
        Coordinates whose range is at most 10^6 tolerances.
    tolerance : float
        Greatest distance of two points that are taken for one.

    Returns
    -------
    (n,) int64 array
        Row of the first point of each cluster.
    """
    cell = ((points - points.min(axis=0)) * (2 / tolerance)).astype(np.int64)
    key = (cell[:, 0] << 42) | (cell[:, 1] << 21) | cell[:, 2]
    order = np.argsort(key, kind="stable")
    new = np.diff(key[order], prepend=-1) != 0
    first = order[new]
    cluster = np.empty(len(points), np.int64)
    cluster[order] = np.cumsum(new) - 1
    # unbalanced: points are all different by now, and it is built twice as fast
    tree = cKDTree(points[first], balanced_tree=False, compact_nodes=False)
    close = tree.query_pairs(tolerance, output_type="ndarray")
    if len(close):
        label = components(len(first), close[:, 0], close[:, 1])
        lowest = np.full(label.max() + 1, len(points))
        np.minimum.at(lowest, label, first)
        first = lowest[label]
    target: Ints = first[cluster]
    return target


def redundant(faces: NDArray[np.int32], edges: Edges) -> Mask:
    """Find faces that only repeat another face.

    Of faces on the same three vertices one for each side is kept. Where a
    surface is drawn on both sides, the back is redundant too if the faces
    around do not close without it: then it is a double-sided surface, and
    front and back together would enclose nothing. If they do close (a fin on a
    body, the wall between two boxes that touch), both sides stay and cancel in
    every slice.

    Parameters
    ----------
    faces : (n_f, 3) int32 array
        Vertex numbers.
    edges : Edges
        Of these faces.

    Returns
    -------
    (n_f,) bool array
        Faces to leave out.
    """
    drop = np.zeros(len(faces), bool)
    suspects = _suspects(faces, edges)
    if not len(suspects):
        return drop
    corners: NDArray[np.int32] = faces[suspects]
    triple = np.unique(np.sort(corners, axis=1), axis=0, return_inverse=True)[1].reshape(-1)
    # which way round the other two corners follow the lowest
    following: Ints = (corners.argmin(axis=1)[:, None] + np.array([1, 2])) % 3
    others = np.take_along_axis(corners, following, axis=1)
    side, first = np.unique(2 * triple + (others[:, 0] < others[:, 1]), return_index=True)
    drop[suspects] = True
    drop[suspects[first]] = False
    both = np.flatnonzero(side[1:] // 2 == side[:-1] // 2)
    pairs = np.sort(suspects[np.column_stack([first[both], first[both + 1]])], axis=1)
    drop[_backs(pairs, drop, edges)] = True
    return drop


def _suspects(faces: NDArray[np.int32], edges: Edges) -> Ints:
    """Return the faces that meet, on each of their edges, a face that may have the same third vertex."""
    count, begin = edges.count, edges.start[:-1]
    two = np.flatnonzero(count == 2)
    pair = edges.order[begin[two][:, None] + [0, 1]]
    third = faces.ravel()[pair // 3 * 3 + (pair + 2) % 3]
    doubtful = count > 2
    doubtful[two[third[:, 0] == third[:, 1]]] = True
    met = np.bincount(edges.order[np.repeat(doubtful, count)] // 3, minlength=len(faces))
    return np.flatnonzero(met == 3)


def _backs(pairs: Ints, drop: Mask, edges: Edges) -> Ints:
    """Return the second faces of those (front, back) pairs that belong to double-sided surfaces."""
    edge = edges.edge().reshape(-1, 3)
    single = ~drop
    single[pairs] = False
    around = np.bincount(edge[single].ravel(), minlength=len(edges.start) - 1)
    own = edge[pairs[:, 0]]
    region = regions(own)
    odd = np.bincount(region, (around[own] % 2).sum(axis=1)) > 0
    touched = np.bincount(region, around[own].sum(axis=1)) > 0
    backs: Ints = pairs[(odd | ~touched)[region], 1]
    return backs


def useless_slivers(flat: Mask, edges: Edges) -> Mask:
    """Find triangles without area that hold nothing together.

    A triangle whose three different corners lie on a line closes the gap
    between a long edge and the shorter ones beside it; without it the surface
    would be torn. It goes only where its surroundings are torn or flat anyway.

    Parameters
    ----------
    flat : (n_f,) bool array
        Whether a face has no area.
    edges : Edges
        Of these faces.

    Returns
    -------
    (n_f,) bool array
        Faces to leave out.
    """
    slivers = np.flatnonzero(flat)
    if not len(slivers):
        return flat
    edge = edges.edge().reshape(-1, 3)
    own = edge[slivers]
    firm = np.bincount(edge[~flat].ravel(), minlength=len(edges.start) - 1)[own] > 0
    torn = edges.count[own] == 1
    region = regions(own)
    holds = (np.bincount(region, firm.any(axis=1)) > 0) & (np.bincount(region, torn.any(axis=1)) == 0)
    useless = flat.copy()
    useless[slivers] = ~holds[region]
    return useless


@dataclass(frozen=True, slots=True, eq=False)
class Filling:
    """Triangles that close small holes.

    Attributes
    ----------
    centres : (n_c, 3) float64 array
        New vertices, numbered after the existing ones.
    faces : (n, 3) int32 array
        Vertex numbers: end and start of the rim edge, then the third corner.
    rim : (n,) int64 array
        Half-edge that each triangle continues; its face lends patch and colour.
    n_holes : int
        Number of holes.
    """

    centres: Floats
    faces: NDArray[np.int32]
    rim: Ints
    n_holes: int


def small_holes(points: Floats, faces: NDArray[np.int32], edges: Edges, patch: Ints, area: Floats) -> Filling | None:
    """Close the holes that are mistakes rather than openings of the shape.

    A hole of three edges is a missing triangle; others are filled, by a fan
    around their centre, if nothing as small (``HOLE``) or as narrow (``SLIT``)
    could be built. Loops that touch themselves are left open.

    Parameters
    ----------
    points : (n_v, 3) float64 array
        Vertices, in diagonals of the mesh.
    faces : (n_f, 3) int32 array
        Vertex numbers, wound consistently within a patch.
    edges : Edges
        Of these faces.
    patch : (n_f,) int64 array
        Patch of every face.
    area : (n_f,) float64 array
        Area of every face.

    Returns
    -------
    Filling or None
        None where no hole is to be filled.
    """
    half = edges.order[edges.start[:-1][edges.count == 1]].astype(np.int64)
    if not len(half):
        return None
    rim = np.column_stack([faces[:, [1, 2, 0]].ravel()[half], faces.ravel()[half]]).astype(np.int64)
    loop, simple = rim_loops(rim, _apart(rim, patch[half // 3]))
    size = np.bincount(loop)
    fans, centre = rim_fans(points, rim, loop)
    fan_area, width = np.bincount(loop, weights=areas_and_longest_sides(fans)[0]), _widths(fans[:, 0], loop)
    around = np.zeros(len(size))
    around[loop] = np.bincount(patch, weights=area)[patch[half // 3]]
    small = (size == 3) | (width <= HOLE) | (fan_area <= SLIT * width)
    fill = simple & small & (fan_area <= HOLE_AREA * around)
    if not fill.any():
        return None

    fan = fill & (size > 3)
    centre_number = len(points) + np.cumsum(fan) - 1
    corner_sum = np.bincount(loop, weights=rim[:, 0]).astype(np.int64)
    third = np.where(fan[loop], centre_number[loop], corner_sum[loop] - rim.sum(axis=1))
    first = np.zeros(len(loop), bool)
    first[np.unique(loop, return_index=True)[1]] = True
    rows = np.flatnonzero(fan[loop] | (fill[loop] & first))
    triangles = np.column_stack([rim[rows], third[rows]]).astype(np.int32)
    return Filling(centre[fan], triangles, half[rows], int(fill.sum()))


def _apart(rim: Ints, owner: Ints) -> Ints:
    """Return the owners, but a number of its own for each missing triangle, as other holes may touch its corners."""
    node = rim_nodes(rim, owner)
    size = node.max() + 1
    key = node[:, 0] * size + node[:, 1]
    order = np.argsort(key, kind="stable")
    key = key[order]
    one, place = spread(np.searchsorted(key, node[:, 1] * size), np.searchsorted(key, (node[:, 1] + 1) * size))
    two = order[place]
    place = np.searchsorted(key, node[two, 1] * size + node[one, 0])
    three = order[np.minimum(place, len(order) - 1)]
    closed = (node[three, 0] == node[two, 1]) & (node[three, 1] == node[one, 0])
    triangles = np.column_stack([one, two, three])[closed & (one < two) & (one < three)]
    alone = np.bincount(triangles.ravel(), minlength=len(rim))[triangles].max(axis=1, initial=0) == 1
    apart = owner.copy()
    apart[triangles[alone]] = owner.max() + 1 + np.arange(alone.sum())[:, None]
    return apart


def _widths(points: Floats, loop: Ints) -> Floats:
    """Return the diagonal of the box around each loop, shape (n_loops,)."""
    low = np.full((int(loop.max()) + 1, 3), np.inf)
    high = -low
    np.minimum.at(low, loop, points)
    np.maximum.at(high, loop, points)
    widths: Floats = np.linalg.norm(high - low, axis=1)
    return widths
