"""Which loop lies in which: the parent-and-son hierarchy of the trajectories."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from ..geometry import ranges
from .loops import loop_areas

_MOST: Final = 1 << 21
"""Pairs of loops, or edges, that are tested at once, to bound the memory."""

_OCTAVES: Final = 3
"""Loops whose widths differ by up to this many factors of two are sorted together."""

_FEW: Final = 300
"""Up to so many loops are all compared with each other."""


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
        A forest: no loop is its own ancestor, whatever the loops cross or repeat.

    References
    ----------
    Paper, section "Parent-and-son hierarchy".
    """
    parent = np.full(len(loop_slice), -1, dtype=np.int32)
    if len(parent) == 0:
        return parent
    low = np.minimum.reduceat(points, loop_start[:-1])
    high = np.maximum.reduceat(points, loop_start[:-1])
    # a parent is a larger loop, and of equal ones the first, so that no two can hold each other
    rank = np.empty(len(parent), dtype=np.int64)
    rank[np.argsort(-np.abs(loop_areas(points, loop_start)), kind="stable")] = np.arange(len(parent))
    pairs = list(_boxed_pairs(low, high, loop_slice, rank))
    son, around = (np.concatenate(parts) for parts in zip(*pairs, strict=True))
    inside = _contains(points, loop_start, around, points[loop_start[son]])
    son, around = son[inside], around[inside]
    order = np.lexsort((-rank[around], son))
    nearest = order[np.flatnonzero(np.diff(son[order], prepend=-1))]
    parent[son[nearest]] = around[nearest]
    return parent


def _boxed_pairs(low: Floats, high: Floats, loop_slice: NDArray[np.int32], rank: Ints) -> Iterator[tuple[Ints, Ints]]:
    """Yield pairs of loops of one slice where the first one's box lies in that of the second, a larger one.

    The loops of about one width are sorted along x, all slices in a row: those that
    may reach over a loop's left side are neighbours there, however many there are.
    """
    if len(low) <= _FEW:
        yield _boxed(low, high, rank, *np.nonzero(loop_slice[:, None] == loop_slice))
        return
    extent = float(high[:, 0].max() - low[:, 0].min())
    # slices are farther apart than any loop is wide
    left = low[:, 0] - low[:, 0].min() + loop_slice * (4 * extent + 1)
    # a little more than needed: far from the start of the row sums have lost some digits
    margin = 1e-12 * float(left.max())
    size = np.frexp(high[:, 0] - low[:, 0])[1] // _OCTAVES
    for number in np.flatnonzero(np.bincount(size - size.min())) + size.min():
        wide = np.flatnonzero(size == number)
        wide = wide[np.argsort(left[wide], kind="stable")]
        widest = min(extent, float(np.ldexp(1.0, _OCTAVES * (int(number) + 1))))
        first = np.searchsorted(left[wide], left - widest - margin)
        count = np.searchsorted(left[wide], left + margin, side="right") - first
        for rows in _blocks(count):
            row, place = ranges(first[rows], count[rows])
            yield _boxed(low, high, rank, rows[row], wide[place])


def _boxed(low: Floats, high: Floats, rank: Ints, son: Ints, around: Ints) -> tuple[Ints, Ints]:
    """Return the pairs whose second loop is the larger one, with the first one's box in its own."""
    larger = np.flatnonzero(rank[around] < rank[son])
    son, around = son[larger], around[larger]
    boxed = (low[son] >= low[around]).all(axis=1) & (high[son] <= high[around]).all(axis=1)
    return son[boxed], around[boxed]


def _blocks(size: Ints) -> list[Ints]:
    """Return consecutive rows whose sizes add up to what may be tested at once."""
    block = np.cumsum(size) // _MOST
    return np.split(np.arange(len(size)), np.flatnonzero(np.diff(block)) + 1)


def _contains(points: Floats, loop_start: Ints, loop: Ints, point: Floats) -> Mask:
    """Return whether each loop has the point inside, by the parity of crossings to its right."""
    inside = np.zeros(len(loop), dtype=bool)
    for rows in _blocks(np.diff(loop_start)[loop]):
        inside[rows] = _crossings(points, loop_start, loop[rows], point[rows]) % 2 == 1
    return inside


def _crossings(points: Floats, loop_start: Ints, loop: Ints, point: Floats) -> Ints:
    """Count the edges of each loop that a ray from its point towards +x crosses."""
    test, edge = ranges(loop_start[loop], np.diff(loop_start)[loop])
    after = edge + 1
    last = after == loop_start[loop + 1][test]
    after[last] = loop_start[loop][test[last]]
    (x0, y0), (x1, y1), (x, y) = (
        part.take(rows, axis=0).T for part, rows in ((points, edge), (points, after), (point, test))
    )
    spans = np.flatnonzero((y0 > y) != (y1 > y))
    x0, y0, x1, y1, x, y = (part[spans] for part in (x0, y0, x1, y1, x, y))
    right = x0 + (y - y0) / (y1 - y0) * (x1 - x0) > x
    return np.bincount(test[spans[right]], minlength=len(loop))
