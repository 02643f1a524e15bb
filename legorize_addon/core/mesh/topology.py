"""How triangles are connected: half-edges grouped by edge, connected parts, open rims."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components

from ..arrays import Floats, Ints, Mask


@dataclass(frozen=True, slots=True, eq=False)
class Edges:
    """The half-edges of a set of triangles, grouped by the edge they lie on.

    Half-edge ``3 f + k`` runs from corner k of face f to its next corner.

    Attributes
    ----------
    order : (3 n_f,) int array
        Half-edges, edge by edge; ascending within an edge.
    start : (n_e + 1,) int64 array
        Where each edge begins in ``order``.
    forward : (3 n_f,) bool array
        Whether a half-edge runs from the lower vertex number to the higher.
    """

    order: NDArray[Any]
    start: Ints
    forward: Mask

    @property
    def count(self) -> Ints:
        """Number of faces at each edge, shape (n_e,)."""
        return np.diff(self.start)

    def edge(self) -> Ints:
        """Return the edge of every half-edge, shape (3 n_f,)."""
        edge = np.empty(len(self.order), np.int64)
        edge[self.order] = np.repeat(np.arange(len(self.start) - 1), self.count)
        return edge

    def turned(self, flip: Mask) -> Edges:
        """Return the edges after the last two corners of some faces changed places."""
        face = self.order // 3
        order = np.where(flip[face], 6 * face + 2 - self.order, self.order)
        forward = self.forward.reshape(-1, 3).copy()
        forward[flip] = ~forward[flip][:, ::-1]
        return Edges(order, self.start, forward.ravel())

    def odd_ones(self) -> tuple[NDArray[Any], Ints]:
        """Return the half-edges at edges of one face or of more than two, and their edge."""
        edge = np.flatnonzero(self.count != 2)
        place, member = spread(self.start[edge], self.start[edge + 1])
        return self.order[member], edge[place]


def edges_of(faces: NDArray[np.int32]) -> Edges:
    """Group the half-edges of triangles by their two vertices.

    Parameters
    ----------
    faces : (n_f, 3) int32 array
        Vertex numbers, the three of a face different.
    """
    tail, head = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    low, high = np.minimum(tail, head), np.maximum(tail, head)
    order = _counting_argsort(high)
    order = order[_counting_argsort(low[order])]
    new = np.ones(len(order) + 1, bool)
    new[1:-1] = np.diff(low[order]) | np.diff(high[order]) != 0
    return Edges(order, np.flatnonzero(new), tail < head)


def components(n: int, left: NDArray[Any], right: NDArray[Any]) -> Ints:
    """Label the connected components of n nodes joined pair by pair.

    Labels count up in the order of each component's first node.
    """
    if n == 0:
        return np.empty(0, np.int64)
    graph = coo_array((np.ones(len(left), np.int8), (left, right)), shape=(n, n))
    label: Ints = connected_components(graph, directed=False)[1].astype(np.int64)
    return label


def regions(edge: Ints) -> Ints:
    """Label faces so that faces with a common edge have the same label.

    Parameters
    ----------
    edge : (n, 3) int64 array
        The three edges of every face.
    """
    number = np.unique(edge, return_inverse=True)[1].reshape(edge.shape)
    n = len(edge)
    return components(n + int(number.max(initial=-1)) + 1, np.repeat(np.arange(n), 3), n + number.ravel())[:n]


def n_bodies(edges: Edges, patch: Ints) -> int:
    """Count what remains of the patches when those with a common edge are one."""
    half, edge = edges.odd_ones()
    at, same = patch[half // 3], edge[1:] == edge[:-1]
    return int(components(int(patch.max()) + 1, at[:-1][same], at[1:][same]).max()) + 1


def spread(first: Ints, last: Ints) -> tuple[Ints, Ints]:
    """List the members of many ranges.

    Returns
    -------
    row : (n,) int64 array
        Range that a member belongs to.
    member : (n,) int64 array
        First, first + 1, ... up to but not including last.
    """
    n = last - first
    row = np.repeat(np.arange(len(n)), n)
    return row, np.arange(len(row)) - np.repeat(np.cumsum(n) - n - first, n)


def open_rim(faces: NDArray[np.int32], edges: Edges, patch: Ints) -> tuple[Ints, Ints]:
    """Find the directed edges that every patch lacks to be closed.

    Where three or more faces meet, a patch that has as many half-edges one way
    as the other lacks nothing.

    Returns
    -------
    rim : (n, 2) int64 array
        Vertices from -> to, against the direction of the patch's own edge.
    owner : (n,) int64 array
        Patch.
    """
    half, edge = edges.odd_ones()
    ends = np.column_stack([faces.ravel()[half], faces[:, [1, 2, 0]].ravel()[half]]).astype(np.int64)
    key = edge * (patch.max() + 1) + patch[half // 3]
    _, first, inverse = np.unique(key, return_index=True, return_inverse=True)
    net = np.bincount(inverse.reshape(-1), weights=np.where(edges.forward[half], 1, -1)).astype(np.int64)
    rows = np.repeat(first, np.abs(net))
    # the surplus runs with or against the first half-edge there
    along = np.repeat((net > 0) == edges.forward[half[first]], np.abs(net))[:, None]
    return np.where(along, ends[rows][:, ::-1], ends[rows]), patch[half[rows] // 3]


def rim_loops(rim: Ints, owner: Ints) -> tuple[Ints, Mask]:
    """Group directed edges into loops that stay within one owner.

    Parameters
    ----------
    rim : (n, 2) int64 array
        Vertices from -> to.
    owner : (n,) int64 array
        Patch of every edge.

    Returns
    -------
    loop : (n,) int64 array
        Loop of every edge.
    simple : (n_loops,) bool array
        Whether every vertex is entered and left once.
    """
    node = rim_nodes(rim, owner)
    n = int(node.max(initial=-1)) + 1
    label = components(n, node[:, 0], node[:, 1])
    once = (np.bincount(node[:, 0], minlength=n) == 1) & (np.bincount(node[:, 1], minlength=n) == 1)
    return label[node[:, 0]], np.bincount(label[~once], minlength=int(label.max(initial=-1)) + 1) == 0


def rim_nodes(rim: Ints, owner: Ints) -> Ints:
    """Give the ends of directed edges numbers, shape (n, 2), that edges of different owners do not share."""
    key = rim * (owner.max(initial=0) + 1) + owner[:, None]
    node: Ints = np.unique(key, return_inverse=True)[1].reshape(rim.shape)
    return node


def rim_fans(points: Floats, rim: Ints, loop: Ints) -> tuple[Floats, Floats]:
    """Close loops by fans.

    Returns
    -------
    fans : (n, 3, 3) float64 array
        Triangle from each rim edge to the centre of its loop.
    centre : (n_loops, 3) float64 array
    """
    sums = [np.bincount(loop, weights=points[rim[:, 0], axis]) for axis in range(3)]
    centre = np.column_stack(sums) / np.bincount(loop)[:, None]
    return np.stack([points[rim[:, 0]], points[rim[:, 1]], centre[loop]], axis=1), centre


def areas_and_longest_sides(corners: Floats) -> tuple[Floats, Floats]:
    """Measure triangles, given as (n, 3, 3) corners."""
    first, last = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(first, last)
    middle = corners[:, 2] - corners[:, 1]
    longest = np.maximum(_squares(middle), np.maximum(_squares(first), _squares(last)))
    return np.sqrt(_squares(normal)) / 2, np.sqrt(longest)


def _squares(vectors: Floats) -> Floats:
    """Return the squared lengths of the rows."""
    squares: Floats = np.einsum("ij,ij->i", vectors, vectors)
    return squares


def _counting_argsort(keys: NDArray[np.int32]) -> NDArray[Any]:
    """Sort small integers stably: turning a sparse matrix from rows to columns is a counting sort."""
    n = len(keys)
    rows = csr_array((np.ones(n, np.int8), keys, np.arange(n + 1)), shape=(n, int(keys.max()) + 1))
    order: NDArray[Any] = rows.tocsc().indices
    return order
