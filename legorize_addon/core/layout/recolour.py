"""Bricks that were laid in the filler's colour although they can be seen take the colour of their neighbours.

Bricks that make roofs and joints hold have no colour of their own, and most are hidden. Where they can be seen, as
under the chassis of a car, they should have the colour of what they hold. Bricks take it after the layout, so that they
could be laid freely.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from scipy import ndimage

from ..arrays import Ints, Mask
from ..geometry import outer_air
from ..model import COLOUR_ANY, NOBODY, Bricks, Catalogue, ContactGraph, UnitGrid, ground_of

_UPWARDS: Final = (1, 0, 0)
_AROUND: Final = ((-1, 0, 0), (0, -1, 0), (0, 1, 0), (0, 0, -1), (0, 0, 1))
"""Steps (plate, y, x) to the cell that a brick holds, and to the others beside it."""


def recolour_visible(bricks: Bricks, grid: UnitGrid, graph: ContactGraph, catalogue: Catalogue) -> Bricks:
    """Colour the bricks of free colour that the outer air touches.

    Parameters
    ----------
    bricks : Bricks
        A layout of the grid.
    grid : UnitGrid
        The hollowed model: cells of colour ``COLOUR_ANY`` may have any.
    graph : ContactGraph
        Of the bricks.
    catalogue : Catalogue

    Returns
    -------
    Bricks
        Visible ones without a colour of their own have the most frequent colour
        of the coloured bricks right above them, or else beside them, in which
        their part is made; they stay as they are where there is none.
    """
    free = _free(bricks, grid, graph)
    # cells on the ground cannot be seen from below
    owner = graph.owner[ground_of(graph.owner != NOBODY) :]
    seen = ndimage.binary_dilation(outer_air(owner != NOBODY), border_value=0) & (owner != NOBODY)
    wanted = np.zeros(len(bricks), dtype=bool)
    wanted[owner[seen]] = True
    wanted &= free
    # a brick that has got a colour passes it on
    while (more := _coloured(bricks, graph, wanted, free, catalogue)) is not None:
        bricks, taken = more
        wanted[taken] = free[taken] = False
    return bricks


def _coloured(
    bricks: Bricks, graph: ContactGraph, wanted: Mask, free: Mask, catalogue: Catalogue
) -> tuple[Bricks, Ints] | None:
    """Colour the wanted bricks that have a coloured one beside them; return which, or None if there are none."""
    brick, colour, above, beside = _beside(bricks, graph, np.append(wanted, False), free)
    made = catalogue.exists_in(bricks.part[brick], colour)
    brick, colour, above, beside = brick[made], colour[made], above[made], beside[made]
    if not len(brick):
        return None
    # what it holds counts first, and what is beside it only between equals
    order = np.lexsort((colour, -beside, -above, brick))
    first = order[np.unique(brick[order], return_index=True)[1]]
    coloured = bricks.colour.copy()
    coloured[brick[first]] = colour[first]
    return replace(bricks, colour=coloured), brick[first]


def _free(bricks: Bricks, grid: UnitGrid, graph: ContactGraph) -> Mask:
    """Return which bricks cover no cell that has a colour."""
    colour = grid.colour.reshape(-1, *grid.colour.shape[2:])
    cell = np.argwhere(graph.owner != NOBODY)
    owner = graph.owner[tuple(cell.T)]
    z, y, x = (cell + graph.low[::-1]).T
    free = np.ones(len(bricks), dtype=bool)
    free[owner[colour[z, y, x] != COLOUR_ANY]] = False
    return free


def _beside(bricks: Bricks, graph: ContactGraph, wanted: Mask, free: Mask) -> tuple[Ints, Ints, Ints, Ints]:
    """Count the faces that each wanted brick has in common with coloured ones: brick, colour and faces."""
    owner = np.pad(graph.owner, 1, constant_values=NOBODY)
    at = np.argwhere(wanted[owner])
    own = owner[tuple(at.T)]
    found, upwards = [], []
    for step in (_UPWARDS, *_AROUND):
        other = owner[tuple((at + step).T)]
        counts = (other != NOBODY) & ~np.append(free, True)[other]
        found.append(np.stack([own[counts], bricks.colour[other[counts]]], axis=1).astype(np.int64))
        upwards.append(np.full(np.count_nonzero(counts), step == _UPWARDS))
    pairs, row = np.unique(np.concatenate(found).reshape(-1, 2), axis=0, return_inverse=True)
    up = np.concatenate(upwards)
    above, beside = (np.bincount(row.reshape(-1)[which], minlength=len(pairs)) for which in (up, ~up))
    return pairs[:, 0], pairs[:, 1], above, beside
