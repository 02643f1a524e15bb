"""Which loop lies in which: the parent-and-son hierarchy of the trajectories."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from .model import Floats, Ints, Mask

_CHUNK: Final = 1 << 22
"""Edges tested at a time, to bound the memory."""


def loop_parents(points: Floats, loop_start: Ints, loop_slice: NDArray[np.int32]) -> NDArray[np.int32]:
    """Return the smallest loop of the same slice around each loop, -1 for the outermost.

    Parameters
    ----------
    points : (n, 2) float64 array
        Points of all loops, loop after loop.
    loop_start : (n_loops + 1,) int64 array
    loop_slice : (n_loops,) int32 array

    Returns
    -------
    (n_loops,) int32 array

    References
    ----------
    Paper, section "Parent-and-son hierarchy".
    """
    parent = np.full(len(loop_slice), -1, dtype=np.int32)
    if len(parent) == 0:
        return parent
    low = np.minimum.reduceat(points, loop_start[:-1])
    high = np.maximum.reduceat(points, loop_start[:-1])
    son, around = _candidates(low, high, loop_slice)
    inside = _contains(points, loop_start, around, points[loop_start[son]])
    son, around = son[inside], around[inside]
    # of the loops around a son the one with the smallest box is the nearest: they are nested
    size = np.prod(high - low, axis=1)
    order = np.lexsort((size[around], son))
    nearest = order[np.unique(son[order], return_index=True)[1]]
    parent[son[nearest]] = around[nearest]
    return parent


def _candidates(low: Floats, high: Floats, loop_slice: NDArray[np.int32]) -> tuple[Ints, Ints]:
    """Return the pairs of loops of one slice where the first one's box lies in the second one's."""
    order = np.argsort(loop_slice, kind="stable")
    count = np.bincount(loop_slice)
    per_loop = count[loop_slice[order]]
    first = np.repeat(order, per_loop)
    start = np.repeat((np.cumsum(count) - count)[loop_slice[order]], per_loop)
    step = np.arange(len(first)) - np.repeat(np.cumsum(per_loop) - per_loop, per_loop)
    second = order[start + step]
    boxed = (low[first] >= low[second]).all(axis=1) & (high[first] <= high[second]).all(axis=1)
    boxed &= first != second
    return first[boxed], second[boxed]


def _contains(points: Floats, loop_start: Ints, loop: Ints, point: Floats) -> Mask:
    """Return whether each loop has the point inside, by the parity of crossings to its right."""
    inside = np.zeros(len(loop), dtype=bool)
    size = np.diff(loop_start)[loop]
    block = np.cumsum(size) // _CHUNK
    for number in np.unique(block):
        rows = np.flatnonzero(block == number)
        inside[rows] = _crossings(points, loop_start, loop[rows], size[rows], point[rows]) % 2 == 1
    return inside


def _crossings(points: Floats, loop_start: Ints, loop: Ints, size: Ints, point: Floats) -> Ints:
    """Count the edges of each loop that a ray from its point towards +x crosses."""
    test = np.repeat(np.arange(len(loop)), size)
    step = np.arange(len(test)) - np.repeat(np.cumsum(size) - size, size)
    here = points[loop_start[loop][test] + step]
    there = points[loop_start[loop][test] + np.where(step + 1 == size[test], 0, step + 1)]
    x, y = point[test].T
    spans = (here[:, 1] > y) != (there[:, 1] > y)
    rise = np.where(spans, there[:, 1] - here[:, 1], 1.0)
    crossing = spans & (here[:, 0] + (y - here[:, 1]) / rise * (there[:, 0] - here[:, 0]) > x)
    return np.bincount(test, crossing, len(loop)).astype(np.int64)
