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

_GAP_AREA: Final = 32.0
"""Surface in mm^2 for which a gap between two bricks is filled: half of a cell's side."""

_AROUND: Final = np.array([step for step in np.ndindex(3, 3, 3) if step != (1, 1, 1)]) - 1
_CUBE: Final = np.array(list(np.ndindex(2, 2, 2)))
_SQUARE: Final = _CUBE[:4]
_COLUMN: Final = _CUBE[[0, 4]]
_LINES: Final = (_COLUMN, _CUBE[[0, 2]], _CUBE[[0, 1]])
"""The cells on both sides of a place along each axis."""


def thin_cells(samples: SurfaceSamples, solid: Mask) -> Mask:
    """Return cells to add so that no surface is lost.

    Surface is kept by a brick of its own layer within half a stud, by one above
    or below within half a layer where it is level, and by the thick parts of the
    model within half a cell in any direction. So walls stand on themselves,
    layer by layer, while the edges of a massive body get nothing added.

    Parameters
    ----------
    samples : SurfaceSamples
    solid : (n_layers, n_y, n_x) bool array

    Returns
    -------
    (n_layers, n_y, n_x) bool array
    """
    known = solid.copy()
    level = np.abs(samples.normal[:, 0]) > np.abs(samples.normal[:, 1:]).max(axis=1)
    lost = np.flatnonzero(~_near(samples.place, _thick(solid), _CUBE))
    while True:
        lost = lost[~_kept(samples.place[lost], level[lost], known)]
        cell, area = _lost_area(samples.cell[lost], samples.area[lost], known.shape)
        enough = area >= _LEAST_AREA
        if not enough.any():
            break
        known.ravel()[_local_maxima(cell[enough], area[enough], known.shape)] = True
    _fill_gaps(samples, known)
    return known & ~solid


def _thick(solid: Mask) -> Mask:
    """Return the cells that lie in a full cube of eight."""
    cubes = np.ones(tuple(n - 1 for n in solid.shape), dtype=bool)
    corners = [tuple(slice(c, n - 1 + c) for c, n in zip(corner, solid.shape, strict=True)) for corner in _CUBE]
    for corner in corners:
        cubes &= solid[corner]
    thick = np.zeros_like(solid)
    for corner in corners:
        thick[corner] |= cubes
    return thick


def _kept(place: Floats, level: Mask, known: Mask) -> Mask:
    """Return the places that bricks of their own layer, or for level surface those above or below, stand for."""
    middle = np.floor(place) + 0.5
    kept = _near(np.column_stack([middle[:, 0], place[:, 1:]]), known, _SQUARE)
    kept[level] |= _near(np.column_stack([place[level, 0], middle[level, 1:]]), known, _COLUMN)
    return kept


def _near(place: Floats, known: Mask, steps: Ints) -> Mask:
    """Return whether a known cell is among those at some steps from each place, half a cell back.

    With the steps of a cube: whether one lies within half a cell. A coordinate in
    the middle of a cell with no step along it looks at that cell alone.
    """
    padded = np.pad(known, 1)
    base = np.clip(np.floor(place - 0.5).astype(np.int64) + 1, 0, np.array(padded.shape) - 2)
    flat = base @ np.array(padded.strides)
    near = np.zeros(len(place), dtype=bool)
    for step in steps @ np.array(padded.strides):
        near |= padded.ravel()[flat + step]
    return near


def _fill_gaps(samples: SurfaceSamples, known: Mask) -> None:
    """Fill cells between two known ones that hold much surface which no brick before or behind it stands for.

    The bricks beside a gap of one cell are near to all the surface in it, each to
    a half, and would leave a hole in a wall.
    """
    axis = np.argmax(np.abs(samples.normal), axis=1)
    middle = np.floor(samples.place) + 0.5
    for each, steps in enumerate(_LINES):
        facing = axis == each
        across = middle[facing]
        across[:, each] = samples.place[facing, each]
        lost = np.flatnonzero(facing)[~_near(across, known, steps)]
        cell, area = _lost_area(samples.cell[lost], samples.area[lost], known.shape)
        for other in {0, 1, 2} - {each}:
            known.ravel()[cell[(area >= _GAP_AREA) & _between(known, other).ravel()[cell]]] = True


def _between(known: Mask, axis: int) -> Mask:
    """Return the cells whose two neighbours along an axis are known."""
    beside = np.zeros_like(known)
    moved = np.moveaxis(known, axis, 0)
    np.moveaxis(beside, axis, 0)[1:-1] = moved[:-2] & moved[2:]
    return beside


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
