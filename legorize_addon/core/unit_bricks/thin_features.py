"""Cells for parts too thin to cover half of any cell: legs, ears, antlers, walls.

Wherever surface is farther than half a cell from every brick, bricks are added where most of that surface is, one at a
time around each place, until all of it is close to a brick.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..units import BRICK
from .surface_samples import SurfaceSamples

_LEAST_AREA: Final = 12.0
"""Surface in mm^2, of both sides together, for which a brick is added; the sides of plates count three times."""

_RIM_AREA: Final = 18.0
"""The same beside the model, where another brick would only enlarge a rim."""

_GAP_AREA: Final = 32.0
"""Surface in mm^2 for which a gap in a wall is filled: half of a cell's side."""

_ROUNDING: Final = 1e-6
"""Distances in cells and areas in mm^2 below this count as zero."""

_AROUND: Final = np.array([step for step in np.ndindex(3, 3, 3) if step != (1, 1, 1)]) - 1
_EVERYWHERE: Final = (True, True, True)
_IN_LAYER: Final = (False, True, True)
_UPRIGHT: Final = (True, False, False)
_STEPS: Final = (0.0, -0.5 - _ROUNDING, 0.5 + _ROUNDING)
"""Where cells are looked for along an axis: here, and half a cell to both sides."""


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
    # surface on a cell's border belongs to the cell behind it
    place = samples.place - _ROUNDING * np.sign(samples.normal)
    thin = np.flatnonzero(~_near(place, _thick(solid), _EVERYWHERE))
    # of flat cells, a wall may rise by no more than one for each that it leans
    axis = np.argmax(np.abs(samples.normal * np.minimum(samples.sides, 1) ** 2), axis=1)
    # the sides of a plate are as much of it as the sides of a brick are of a brick
    samples = replace(samples, area=samples.area * np.where(axis == 0, 1, BRICK / samples.height))
    # beside the model a cell needs more, otherwise its rims become ragged
    rim = np.zeros_like(solid)
    for each in range(3):
        rim |= np.logical_or(*_neighbours(solid, each))
    least = np.where(rim, _RIM_AREA, _LEAST_AREA).ravel()
    lost = thin
    while True:
        lost = lost[~_near(place[lost], known, _IN_LAYER)]
        level = axis[lost] == 0
        lost = lost[~(level & _near(place[lost], known, _UPRIGHT))]
        if not _add(samples, lost, known, least):
            break
    mended = True
    while mended:
        mended = False
        for each in range(3):
            mended |= _mend(samples, place, thin[axis[thin] == each], known, each)
    _fill_gaps(samples, place, axis, known)
    return known & ~solid


def _add(samples: SurfaceSamples, lost: Ints, known: Mask, least: Floats, beside: Mask | None = None) -> bool:
    """Mark the cells with most lost surface as known; return whether there were any."""
    cell, area = _lost_area(samples.cell[lost], samples.area[lost], known.shape)
    enough = (area >= least[cell]) & ~known.ravel()[cell]
    if beside is not None:
        enough &= beside.ravel()[cell]
    known.ravel()[_local_maxima(cell[enough], area[enough], known.shape)] = True
    return bool(enough.any())


def _mend(samples: SurfaceSamples, place: Floats, facing: Ints, known: Mask, axis: int) -> bool:
    """Continue walls that face along an axis, from known cells to where no brick before or behind represents them."""
    lost = facing[~_near(place[facing], known, tuple(each == axis for each in range(3)))]
    beside = np.zeros_like(known)
    for other in {0, 1, 2} - {axis}:
        lower, upper = _neighbours(known, other)
        beside |= lower | upper
    return _add(samples, lost, known, np.full(known.size, _GAP_AREA), beside)


def _fill_gaps(samples: SurfaceSamples, place: Floats, axis: Ints, known: Mask) -> None:
    """Fill cells between two known ones if they hold much surface that no brick before or behind represents.

    The bricks beside a gap of one cell are near to all the surface in it, each to
    a half, and would leave a hole in a wall.
    """
    for each in range(3):
        facing = np.flatnonzero(axis == each)
        lost = facing[~_near(place[facing], known, tuple(other == each for other in range(3)))]
        cell, area = _lost_area(samples.cell[lost], samples.area[lost], known.shape)
        for other in {0, 1, 2} - {each}:
            lower, upper = _neighbours(known, other)
            known.ravel()[cell[(area >= _GAP_AREA) & (lower & upper).ravel()[cell]]] = True


def _neighbours(known: Mask, axis: int) -> tuple[Mask, Mask]:
    """Return whether the neighbours below and above each cell along an axis are known."""
    around = np.pad(known, [(int(each == axis),) * 2 for each in range(3)])
    moved = np.moveaxis(around, axis, 0)
    return np.moveaxis(moved[:-2], 0, axis), np.moveaxis(moved[2:], 0, axis)


def _thick(solid: Mask) -> Mask:
    """Return the cells that lie in a full cube of eight."""
    cubes = np.ones(tuple(n - 1 for n in solid.shape), dtype=bool)
    corners = [
        tuple(slice(c, n - 1 + c) for c, n in zip(corner, solid.shape, strict=True)) for corner in np.ndindex(2, 2, 2)
    ]
    for corner in corners:
        cubes &= solid[corner]
    thick = np.zeros_like(solid)
    for corner in corners:
        thick[corner] |= cubes
    return thick


def _near(place: Floats, known: Mask, axes: tuple[bool, ...]) -> Mask:
    """Return whether each place lies in a known cell, or within half a cell of one along some axes at once."""
    padded = np.pad(known, 1)
    flags, strides, last = padded.ravel(), padded.strides, np.array(padded.shape) - 1
    # the middle first: most places find their cell there
    steps = [_STEPS if each else _STEPS[:1] for each in axes]
    flat = [
        [np.minimum(np.maximum(np.floor(along + step) + 1, 0), end).astype(np.intp) * stride for step in choice]
        for along, end, stride, choice in zip(place.T, last, strides, steps, strict=True)
    ]
    near = np.zeros(len(place), dtype=bool)
    rest = np.arange(len(place))
    for z, y, x in product(*flat):
        near[rest] = flags[z[rest] + y[rest] + x[rest]]
        rest = rest[~near[rest]]
    return near


def _lost_area(cell: Ints, area: Floats, shape: tuple[int, ...]) -> tuple[Ints, Floats]:
    """Return the cells that hold lost surface, flat and rising, and its area in each, without rounding noise."""
    cells, number = np.unique(np.ravel_multi_index(tuple(cell.T), shape), return_inverse=True)
    return cells, np.round(np.bincount(number, area, len(cells)), 3)


def _local_maxima(cell: Ints, area: Floats, shape: tuple[int, ...]) -> Ints:
    """Return the cells with more lost surface than all 26 neighbours.

    Of equal ones the even cell wins, so that a large even sheet is done in a few
    rounds, and then the lower index.
    """
    place = np.stack(np.unravel_index(cell, shape), axis=1)
    rank = np.empty(len(cell), dtype=np.int64)
    rank[np.lexsort((-cell, -((place & 1) @ [4, 2, 1]), area))] = np.arange(len(cell))
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
