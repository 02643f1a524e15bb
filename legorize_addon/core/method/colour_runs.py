"""Trajectories as lines of one colour each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..slicing import Trajectories


@dataclass(frozen=True, slots=True, eq=False)
class ColourRuns:
    """Open lines, one after the other, each in one colour.

    Attributes
    ----------
    points : (n, 2) float64 array
        In mm.
    count : (n_runs,) int64 array
        Points of each line, at least two.
    colour : (n_runs,) int16 array
        LDraw code; ``COLOUR_ANY`` where a line closes a gap of the mesh.
    loop : (n_runs,) int64 array
        Loop that it is part of.
    """

    points: Floats
    count: Ints
    colour: NDArray[np.int16]
    loop: Ints


def colour_runs(trajectories: Trajectories) -> ColourRuns:
    """Cut loops where their colour changes.

    Parameters
    ----------
    trajectories : Trajectories

    Returns
    -------
    ColourRuns
        In the order of the edges; each line ends where the next one of its loop
        begins.
    """
    colour, loop = trajectories.colour, trajectories.edge_loop
    first = np.ones(len(colour), dtype=bool)
    first[1:] = (colour[1:] != colour[:-1]) | (loop[1:] != loop[:-1])
    start = np.flatnonzero(first)
    edges = np.diff(np.append(start, len(colour)))
    # the starts of a run's edges, and the end of its last one
    last = np.cumsum(edges + 1) - 1
    points = np.empty((len(colour) + len(start), 2))
    is_end = np.zeros(len(points), dtype=bool)
    is_end[last] = True
    points[~is_end] = trajectories.points
    points[is_end] = trajectories.ends[start + edges - 1]
    return ColourRuns(points, edges + 1, colour[start], loop[start])
