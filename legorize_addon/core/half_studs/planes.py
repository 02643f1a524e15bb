"""Where half studs pay: the planes above which a model fits a grid half a stud further on better."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Final, NamedTuple

import numpy as np

from ..arrays import Floats, Ints
from ..mesh import TriangleMesh, cell_factors
from ..slicing import Grid, covered_area, linked, slice_mesh
from ..units import CELL_AREA, PLATE, PLATES_PER_BRICK, STUD

PHASES: Final = ((0, 0), (1, 0), (0, 1), (1, 1))
"""Half studs along x and y that a grid may lie further on."""

_PARTS: Final = 0.7
"""Parts more for each stud of a plane: a jumper covers two studs or more, and what was a brick below it becomes two
layers of plates."""

_GAIN: Final = 0.03
"""Share of the error that planes have to save, all costs counted: for less, no model gives up its symmetry."""

_CELLS: Final = 4_000_000
"""Quarters of cells at a time: 32 MB."""


class Plane(NamedTuple):
    """A plane on top of jumpers.

    Attributes
    ----------
    level : int
        Plates below it; whole layers of bricks.
    half : (int, int)
        Half studs along x and y, 0 or 1, by which all above it lies further on than the lowest part of the model, up
        to the next plane.
    """

    level: int
    half: tuple[int, int]


def choose_planes(
    mesh: TriangleMesh, grid: Grid, *, price: float, barred: Collection[int] = frozenset()
) -> tuple[Plane, ...]:
    """Choose the planes of a model.

    Parameters
    ----------
    mesh : TriangleMesh
        In its size, in mm.
    grid : Grid
        Of its lowest part, in layers of bricks.
    price : float
        Volume that a part more has to save, in cells a plate high.
    barred : collection of int
        Levels at which there must be no plane.

    Returns
    -------
    tuple of Plane
        From below; none where half studs do not pay, or save less than a few per cent of the error. Of all choices one
        that costs least: cells err by the share that they fill or leave empty in spite of the mesh, and each plane
        costs parts.
    """
    error, area = _errors(mesh, grid)
    error = error.reshape(grid.n_layers, PLATES_PER_BRICK, len(PHASES)).sum(axis=1)
    area = area[::PLATES_PER_BRICK]
    changing = price * _PARTS * np.maximum(area, 1)
    changing[[level // PLATES_PER_BRICK for level in barred]] = np.inf
    chosen = _least(error, changing)
    if cost_of(chosen, error, changing) > (1 - _GAIN) * error[:, 0].sum():
        return ()
    return tuple(
        Plane(PLATES_PER_BRICK * layer, PHASES[phase])
        for layer, (before, phase) in enumerate(pairwise(chosen), 1)
        if phase != before
    )


def _least(error: Floats, changing: Floats) -> list[int]:
    """Return the phases of layers that cost least, beginning with 0, by dynamic programming.

    Parameters
    ----------
    error : (n_layers, n_phases) float array
        Cost of a layer in a phase.
    changing : (n_layers, n_phases) float array
        Cost of a layer having another phase than the one below it.
    """
    n_layers, n_phases = error.shape
    cost = np.where(np.arange(n_phases) == 0, error[0], np.inf)
    before = np.zeros((n_layers, n_phases), np.int64)
    for layer in range(1, n_layers):
        # of equals the same phase as below
        cheapest = int(cost.argmin())
        other = cost[cheapest] + changing[layer]
        moves = other < cost
        before[layer] = np.where(moves, cheapest, np.arange(n_phases))
        cost = np.where(moves, other, cost) + error[layer]
    chosen = [int(cost.argmin())]
    for layer in range(n_layers - 1, 0, -1):
        chosen.append(int(before[layer, chosen[-1]]))
    return chosen[::-1]


def cost_of(phases: Sequence[int], error: Floats, changing: Floats) -> float:
    """Return what phases of layers cost, given the arrays of :func:`_least`."""
    layers = np.arange(len(phases))
    changes = 1 + np.flatnonzero(np.diff(phases))
    return float(error[layers, phases].sum() + changing[changes, np.array(phases)[changes]].sum())


def _errors(mesh: TriangleMesh, grid: Grid) -> tuple[Floats, Floats]:
    """Return by how many cells each plate errs in each phase, and how many it fills there, (n_plates, 4) each."""
    n_plates = PLATES_PER_BRICK * grid.n_layers
    heights = grid.origin[2] + (np.arange(n_plates) + 0.5) * PLATE
    # a stud more on each side, which the other phases reach
    corner, n_y, n_x = grid.origin[:2] - STUD, 2 * (grid.n_y + 2), 2 * (grid.n_x + 2)
    error, area = np.zeros((2, n_plates, len(PHASES)))
    factor = cell_factors(mesh, np.append(corner, grid.origin[2]), (n_plates, grid.n_y + 2, grid.n_x + 2))
    for some in np.array_split(np.arange(n_plates), -(-n_plates * n_y * n_x // _CELLS)):
        outline = linked(mesh.faces, slice_mesh(mesh, heights[some]))
        quarters = covered_area(replace(outline, start=outline.start * 2), len(some), corner * 2, n_y, n_x) / CELL_AREA
        for phase, (x, y) in enumerate(PHASES):
            inner = quarters[:, y : n_y - y, x : n_x - x]
            share = inner.reshape(len(some), n_y // 2 - y, 2, n_x // 2 - x, 2).sum(axis=(2, 4)) / 4
            counts = factor[some, : share.shape[1], : share.shape[2]]
            error[some, phase] = (counts * np.minimum(share, 1 - share)).sum(axis=(1, 2))
            area[some, phase] = np.count_nonzero(share >= 0.5, axis=(1, 2))
    return error, area


def halves_at(level: Ints, planes: tuple[Plane, ...]) -> Ints:
    """Return the half studs along x and y at levels, (n, 2): those of the last plane at or below each."""
    half = np.array([(0, 0), *(plane.half for plane in planes)])
    found: Ints = half[np.searchsorted([plane.level for plane in planes], level, side="right")]
    return found
