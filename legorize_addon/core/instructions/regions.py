"""Outlines of what is seen: unions of the pieces of the plane as polygons, borders between them as lines.

An outline is the boundary of a union as directed edges with the inside on their
left, merged where they go on in a straight line, and linked end to start. Which
of several edges that start at the end of one it is linked to does not matter:
what a path of several loops fills depends on its edges alone.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Ints
from ..model import NOBODY

_WAYS: Final = np.array([(1, 0), (0, 1), (1, 1)])
"""The directions of all edges."""


@dataclass(frozen=True, slots=True, eq=False)
class Edges:
    """Straight edges on the lattice.

    Attributes
    ----------
    of : (n,) int64 array
        What each belongs to.
    start, end : (n, 2) int64 array
        Its points, p and q.
    """

    of: Ints
    start: Ints
    end: Ints


@dataclass(frozen=True, slots=True, eq=False)
class Loops:
    """Closed polygons.

    Attributes
    ----------
    of : (n_loops,) int64 array
        What each belongs to, rising.
    points : (n_points, 2) int64 array
        Their corners, loop after loop.
    count : (n_loops,) int64 array
        Corners of each.
    """

    of: Ints
    points: Ints
    count: Ints


def outlines(region: Ints, low: Ints) -> Loops:
    """Trace the regions of the plane.

    Parameters
    ----------
    region : (n_p, n_q, 2) int64 array
        To what each piece belongs, ``NOBODY`` for the ground; the outermost
        squares are ground.
    low : (2,) int64 array
        Point of the lattice at the lower corner of the first square.

    Returns
    -------
    Loops
        Around each region counter-clockwise with p to the right and q upwards,
        around its holes clockwise.
    """
    parts = []
    for one, other, way in _pairs(region):
        border = one != other
        start = np.argwhere(border)
        for inside, first, step in ((one[border], start, way), (other[border], start + way, -way)):
            there = inside != NOBODY
            parts.append(_merged(inside[there], first[there], step))
    edges = Edges(*(np.concatenate([getattr(each, name) for each in parts]) for name in Edges.__slots__))
    return _linked(edges, low)


def borders(kind_of: Ints, low: Ints) -> Edges:
    """Merge the edges of squares and halves that have a kind to long lines.

    Parameters
    ----------
    kind_of : (3, n_p, n_q) int64 array
        Kind of the line along each edge, ``NOBODY`` where there is none, as :func:`neighbours` lists them.
    low : (2,) int64 array
        Point of the lattice at the lower corner of the first square.

    Returns
    -------
    Edges
    """
    parts = []
    for kinds, way in zip(kind_of, _WAYS, strict=True):
        drawn = np.argwhere(kinds != NOBODY)
        parts.append(_merged(kinds[tuple(drawn.T)], drawn, way))
    edges = Edges(*(np.concatenate([getattr(each, name) for each in parts]) for name in Edges.__slots__))
    return Edges(edges.of, edges.start + low, edges.end + low)


def neighbours(region: Ints) -> tuple[Ints, Ints]:
    """Return what lies left and right of each edge.

    Parameters
    ----------
    region : (n_p, n_q, 2) int64 array

    Returns
    -------
    left, right : (3, n_p, n_q) int64 array
        Of the edges from the lower corner of each square along p, along q and
        along both. What lies outside of the plane is ``NOBODY``.
    """
    found = list(_pairs(region))
    return np.stack([one for one, *_ in found]), np.stack([other for _, other, *_ in found])


def _pairs(region: Ints) -> Iterator[tuple[Ints, Ints, Ints]]:
    """Yield, for each direction of edges, the regions left and right of them and that direction."""
    behind = np.full_like(region[..., 0], NOBODY)
    behind[:, 1:] = region[:, :-1, 0]
    yield region[..., 1], behind, _WAYS[0]
    before = np.full_like(region[..., 1], NOBODY)
    before[1:] = region[:-1, :, 1]
    yield before, region[..., 0], _WAYS[1]
    yield region[..., 0], region[..., 1], _WAYS[2]


def _merged(of: Ints, start: Ints, way: Ints) -> Edges:
    """Merge edges that have one direction and go on in a straight line."""
    across = start[:, 0] * abs(way[1]) - start[:, 1] * abs(way[0])
    along = start[:, 0] * way[0] if way[0] else start[:, 1] * way[1]
    if not len(of):
        return Edges(of, start, start)
    # one number an edge, by which those that follow each other differ by one
    span = np.ptp(along) + 2
    line = of * (np.ptp(across) + 1) + across - across.min()
    key = line * span + along - along.min()
    order = np.argsort(key)
    gap = np.diff(key[order]) != 1
    first = order[np.concatenate([[True], gap])]
    last = order[np.concatenate([gap, [True]])]
    return Edges(of[first], start[first], start[last] + way)


def _linked(edges: Edges, low: Ints) -> Loops:
    """Link edges to loops, each where another one of the same region ends."""
    if not len(edges.of):
        return Loops(edges.of, edges.start, edges.of)
    size = np.concatenate([edges.start, edges.end]).max(axis=0) + 1
    starts, ends = (
        np.argsort((edges.of * size[0] + point[:, 0]) * size[1] + point[:, 1], kind="stable")
        for point in (edges.start, edges.end)
    )
    following = np.empty(len(edges.of), dtype=np.int64)
    following[ends] = starts
    order, count = _walked(following.tolist(), np.argsort(edges.of, kind="stable").tolist())
    first = np.cumsum(count) - count
    return Loops(edges.of[order[first]], edges.start[order] + low, count)


def _walked(following: list[int], firsts: list[int]) -> tuple[Ints, Ints]:
    """Walk along all loops; return the edges in their order, and how many each loop has."""
    order: list[int] = []
    count = []
    seen = [False] * len(following)
    for first in firsts:
        if seen[first]:
            continue
        before, each = len(order), first
        while not seen[each]:
            seen[each] = True
            order.append(each)
            each = following[each]
        count.append(len(order) - before)
    return np.array(order), np.array(count)
