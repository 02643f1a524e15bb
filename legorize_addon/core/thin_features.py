"""Cells for what is too thin to cover half of any cell: legs, ears, antlers, walls.

Wherever surface lies farther than half a cell from every brick, bricks are added
where most of that surface is, one at a time around each place, until all of it
is near to a brick.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from .model import Floats, Ints, Mask
from .samples import SurfaceSamples

_LEAST_AREA: Final = 12.0
"""Surface in mm^2, of both sides together, for which a brick is added."""

_CORNERS: Final = np.array(np.meshgrid([0, 1], [0, 1], [0, 1])).reshape(3, 8).T
_AROUND: Final = np.array([step for step in np.ndindex(3, 3, 3) if step != (1, 1, 1)]) - 1


def thin_cells(samples: SurfaceSamples, solid: Mask) -> Mask:
    """Return cells to add so that no surface is lost.

    Parameters
    ----------
    samples : SurfaceSamples
    solid : (n_layers, n_y, n_x) bool array

    Returns
    -------
    (n_layers, n_y, n_x) bool array
    """
    known = solid.copy()
    lost = np.arange(len(samples.area))
    while True:
        lost = lost[~_near(samples.place[lost], known)]
        cell, area = _lost_area(samples.cell[lost], samples.area[lost], known.shape)
        enough = area >= _LEAST_AREA
        if not enough.any():
            return known & ~solid
        best = _local_maxima(cell[enough], area[enough], known.shape)
        known.ravel()[best] = True


def _near(place: Floats, known: Mask) -> Mask:
    """Return whether each place lies in a known cell or within half a cell of one."""
    padded = np.pad(known, 1)
    base = np.clip(np.floor(place - 0.5).astype(np.int64) + 1, 0, np.array(padded.shape) - 2)
    flat = base @ np.array(padded.strides)
    near = np.zeros(len(place), dtype=bool)
    for step in _CORNERS @ np.array(padded.strides):
        near |= padded.ravel()[flat + step]
    return near


def _lost_area(cell: Ints, area: Floats, shape: tuple[int, ...]) -> tuple[Ints, Floats]:
    """Return the cells that hold lost surface, flat and rising, and its area in each."""
    cells, number = np.unique(np.ravel_multi_index(tuple(cell.T), shape), return_inverse=True)
    return cells, np.bincount(number, area, len(cells))


def _local_maxima(cell: Ints, area: Floats, shape: tuple[int, ...]) -> Ints:
    """Return the cells with more lost surface than all 26 neighbours; the lower index wins a tie."""
    place = np.stack(np.unravel_index(cell, shape), axis=1)
    rank = np.empty(len(cell), dtype=np.int64)
    rank[np.lexsort((-cell, area))] = np.arange(len(cell))
    best = np.ones(len(cell), dtype=bool)
    for step in _AROUND:
        beside = place + step
        inside = ((beside >= 0) & (beside < shape)).all(axis=1)
        flat = np.ravel_multi_index(tuple(beside[inside].T), shape)
        at = np.minimum(np.searchsorted(cell, flat), len(cell) - 1)
        there = cell[at] == flat
        rows = np.flatnonzero(inside)[there]
        best[rows] &= rank[rows] > rank[at[there]]
    return cell[best]
