"""The middle of wide areas of one colour, where a linear programme is slow and not needed."""

from __future__ import annotations

from typing import Final

import numpy as np
from scipy.ndimage import maximum_filter, minimum_filter

from ...arrays import Mask
from ...model import COLOUR_EMPTY
from ..problem import Index, Problem

_WIDTH: Final = 2
_LONGEST: Final = 8
"""Studs across and along the longest part of a running bond."""

_WORTH: Final = 2.0
"""Reward for a part of a running bond, in bricks."""

_DEPTH: Final = 2
"""Studs around the middle of a wide area that are not laid in running bond."""


def running_bond(problem: Problem) -> Index:
    """Lay the middle of wide areas of one colour: rows of the largest part, shifted by half of it.

    Parameters
    ----------
    problem : Problem
        The sheets.

    Returns
    -------
    (n,) intp array
        Rows of placements in the middle of areas that must be covered. They share no cell.
    """
    found, extents = problem.placements, problem.shapes.extent[problem.placements.shape]
    row: Index = np.flatnonzero(found.totals(_deep(problem)) == found.size)
    # a corner part has the sides of a square one, but lies beside others in another way
    row = row[(extents[row].min(axis=1) == _WIDTH) & (extents[row].prod(axis=1) == found.size[row])]
    if not len(row):
        return row
    _, area = np.unique(np.stack([found.corner[row, 2], found.colour[row]]), axis=1, return_inverse=True)
    area, length, along = area.ravel(), extents[row].max(axis=1), extents[row].argmax(axis=1)
    longest = np.zeros(area.max() + 1, dtype=np.intp)
    np.maximum.at(longest, area, length)
    # one lattice for each direction and way to begin; in each area the one that pays most is taken
    ahead, aside = (found.corner[row, axis] for axis in (along, 1 - along))
    shifted = (ahead + aside // _WIDTH % 2 * (length // 2)) % length
    lattice = (along * _WIDTH + aside % _WIDTH) * _LONGEST + shifted
    fits = length == longest[area]
    worth = np.zeros((len(longest), 2 * _WIDTH * _LONGEST))
    np.add.at(worth, (area[fits], lattice[fits]), _WORTH - problem.cost[row[fits]])
    row = row[fits & (lattice == worth.argmax(axis=1)[area])]
    return row


def _deep(problem: Problem) -> Mask:
    """Tell which cells have only required cells of their own colour around them, shape (n_cells,)."""
    sheets = problem.sheets
    colour = np.where(sheets.required, sheets.colour, np.int16(COLOUR_EMPTY))
    window = (1, 2 * _DEPTH + 1, 2 * _DEPTH + 1)
    least, most = (
        extreme(colour, window, mode="constant", cval=COLOUR_EMPTY) for extreme in (minimum_filter, maximum_filter)
    )
    deep: Mask = ((least == most) & (least != COLOUR_EMPTY)).reshape(-1)[sheets.cells]
    return deep
