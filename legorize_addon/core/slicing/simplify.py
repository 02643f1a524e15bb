"""Leave out the points of a trajectory that its chord deviation allows."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask


def simplify(points: Floats, colour: NDArray[np.int16], loop_start: Ints, deviation: float) -> Mask:
    """Choose the points that keep every run of one colour within a distance of its polygon.

    The ends of the runs stay; a loop of one colour keeps its first point and the
    one farthest from it. All runs are halved at once, as in the algorithm of
    Douglas and Peucker, at their farthest points, until none is too far.

    Parameters
    ----------
    points : (n, 2) float64 array
        Starts of the edges, loop after loop, in mm.
    colour : (n,) int16 array
        Colour of each edge.
    loop_start : (n_loops + 1,) int64 array
    deviation : float
        Largest distance in mm; 0 keeps every point.

    Returns
    -------
    (n,) bool array
        True for the points to keep.

    References
    ----------
    D. Douglas and T. Peucker, "Algorithms for the reduction of the number of points
    required to represent a digitized line", Cartographica 10(2), 1973. Paper,
    section "Colour trajectory" (chord deviation).
    """
    if deviation <= 0 or len(points) == 0:
        return np.ones(len(points), dtype=bool)
    loop = np.repeat(np.arange(len(loop_start) - 1), np.diff(loop_start))
    keep = _run_starts(colour, loop_start)
    _keep_farthest_of_round_loops(points, loop, loop_start, keep)
    while True:
        start = np.flatnonzero(keep)
        span = np.cumsum(keep) - 1
        # the run after the last kept point of a loop ends at the loop's first kept point, its start
        end = np.where(loop[np.roll(start, -1)] == loop[start], np.roll(start, -1), loop_start[loop[start]])
        distance = _distances(points, points.take(start[span], axis=0), points.take(end[span], axis=0))
        distance[start] = 0
        worst = np.maximum.reduceat(distance, start)
        split = (distance == worst[span]) & (distance > deviation)
        rows = np.flatnonzero(split)
        if len(rows) == 0:
            return keep
        _, first = np.unique(span[rows], return_index=True)
        keep[rows[first]] = True


def _run_starts(colour: NDArray[np.int16], loop_start: Ints) -> Mask:
    """Return where a colour begins; the first point of a loop always counts."""
    starts = np.ones(len(colour), dtype=bool)
    starts[1:] = colour[1:] != colour[:-1]
    starts[loop_start[:-1]] = True
    return starts


def _keep_farthest_of_round_loops(points: Floats, loop: Ints, loop_start: Ints, keep: Mask) -> None:
    """Split the loops of which only the first point is kept, which have no chord to measure from."""
    distance = np.linalg.norm(points - points[loop_start[loop]], axis=1)
    distance[np.add.reduceat(keep.astype(np.int64), loop_start[:-1])[loop] > 1] = -1
    farthest = np.maximum.reduceat(distance, loop_start[:-1])
    rows = np.flatnonzero((distance == farthest[loop]) & (distance > 0))
    _, first = np.unique(loop[rows], return_index=True)
    keep[rows[first]] = True


def _distances(points: Floats, start: Floats, end: Floats) -> Floats:
    """Return the distances of points from line segments, shape (n,)."""
    along = end - start
    length = np.maximum((along**2).sum(axis=1), np.finfo(float).tiny)
    share = np.clip(((points - start) * along).sum(axis=1) / length, 0, 1)
    distance: Floats = np.linalg.norm(points - start - share[:, None] * along, axis=1)
    return distance
