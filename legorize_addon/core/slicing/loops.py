"""Closed loops of numbered elements: put them in order, step along them, measure them."""

from __future__ import annotations

from typing import Final

import numpy as np

from ..arrays import Floats, Ints

_HALF: Final = 32
"""Bits for the steps in a number that holds an element and the steps to it."""


def ordered_loops(following: Ints) -> tuple[Ints, Ints]:
    """Put the cycles of a permutation one after the other.

    Every element looks for the lowest of its cycle and counts the steps to it,
    over twice as many elements each time (pointer jumping).

    Parameters
    ----------
    following : (n,) int64 array
        A permutation.

    Returns
    -------
    order : (n,) int64 array
        Elements in cyclic order, cycle after cycle; each starts at its lowest
        element and the cycles are sorted by it.
    loop_start : (n_loops + 1,) int64 array
        Where each cycle starts in ``order``, and n.
    """
    n = len(following)
    # an element and the steps to it in one number, whose minimum is that of the elements
    found, jump, reach = np.arange(n) << _HALF, following, 1
    while True:
        lower = np.minimum(found, found.take(jump) + reach)
        if (lower == found).all():
            break
        found, jump, reach = lower, jump.take(jump), 2 * reach
    lowest, steps = found >> _HALF, found & ((1 << _HALF) - 1)
    first = np.flatnonzero(steps == 0)
    size = np.bincount(lowest, minlength=n)
    end = np.cumsum(size)
    place = end.take(lowest) - steps
    place[first] -= size[first]
    order = np.empty(n, dtype=np.int64)
    order[place] = np.arange(n)
    return order, np.concatenate([[0], end[first]])


def loop_ends(points: Floats, loop_start: Ints) -> Floats:
    """Return the point after each point of closed loops.

    Parameters
    ----------
    points : (n, 2) float64 array
        Points of all loops, loop after loop.
    loop_start : (n_loops + 1,) int64 array

    Returns
    -------
    (n, 2) float64 array
    """
    after = np.empty_like(points)
    after[:-1] = points[1:]
    after[loop_start[1:] - 1] = points[loop_start[:-1]]
    return after


def loop_areas(points: Floats, loop_start: Ints) -> Floats:
    """Return the signed areas of closed polygons.

    Parameters
    ----------
    points : (n, 2) float64 array
        Points of all loops in mm, loop after loop.
    loop_start : (n_loops + 1,) int64 array

    Returns
    -------
    (n_loops,) float64 array
        In mm^2, positive where a loop runs counter-clockwise.
    """
    if len(points) == 0:
        return np.zeros(len(loop_start) - 1)
    # around the first point of each loop, so that far-away loops lose no digits
    base = points.take(loop_start[:-1], axis=0).repeat(np.diff(loop_start), axis=0)
    x, y = (points - base).T
    cross = np.zeros(len(points))
    # a loop's first point is its origin: the edge back to it spans nothing, nor does that to the next loop's
    cross[:-1] = x[:-1] * y[1:] - x[1:] * y[:-1]
    area: Floats = np.add.reduceat(cross, loop_start[:-1]) / 2
    return area
