"""Models of unit bricks: one part of 1 x 1 for each cell.

References
----------
Paper, section "Unit bricks": the initial model is made of unit bricks alone,
before it is hollowed and larger bricks take their place.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Ints, Mask
from ..model import COLOUR_ANY, Bricks, Catalogue, Fill, Role, UnitGrid
from ..units import PLATES_PER_BRICK

CARRYING: Final = 71
"""LDraw code of cells that are required although nobody sees them: light bluish grey, as hidden bricks of a model."""

PILLARS: Final = 4
"""Of the supports inside: red, as in the paper."""

OPTIONAL: Final = 19
"""Of cells that may be built: tan."""


def initial_model(grid: UnitGrid, catalogue: Catalogue) -> Bricks:
    """Return a unit brick for each cell that the surface passes or that closes it.

    Parameters
    ----------
    grid : UnitGrid
        The solid model.
    catalogue : Catalogue

    Returns
    -------
    Bricks
        Bricks of 1 x 1 where the three plates of a column have one colour, else
        plates, in the roles of the cells.
    """
    return _table(grid.colour >= 0, grid.colour, grid.role, catalogue)


def hollowed_model(shell: UnitGrid, catalogue: Catalogue) -> Bricks:
    """Return a unit brick for each cell that hollowing leaves.

    Parameters
    ----------
    shell : UnitGrid
        Required and optional cells.
    catalogue : Catalogue

    Returns
    -------
    Bricks
        As :func:`initial_model`; hidden cells in :data:`CARRYING`, pillars in
        :data:`PILLARS`, cells that may be built in :data:`OPTIONAL`.
    """
    colour, role = shell.colour.copy(), shell.role.copy()
    hidden, optional = colour == COLOUR_ANY, shell.cover == Fill.OPTIONAL
    colour[hidden] = CARRYING
    colour[hidden & (role == Role.SUPPORT_INSIDE)] = PILLARS
    colour[optional] = OPTIONAL
    role[optional] = Role.INSIDE
    return _table(shell.solid, colour, role, catalogue)


def _table(cells: Mask, colour: NDArray[np.int16], role: NDArray[np.uint8], catalogue: Catalogue) -> Bricks:
    """Return bricks for whole columns of one colour and role, and plates for the other cells."""
    whole = cells.all(axis=1) & (role != Role.PLATE).all(axis=1)
    for values in (colour, role):
        whole &= (values == values[:, :1]).all(axis=1)
    layer, *yx = np.nonzero(whole)
    bricks = np.stack([layer, np.zeros_like(layer), *yx])
    places = np.concatenate([bricks, np.stack(np.nonzero(cells & ~whole[:, None]))], axis=1)
    part = np.repeat(
        [_single(catalogue, PLATES_PER_BRICK), _single(catalogue, 1)], [len(layer), len(places[0]) - len(layer)]
    )
    order = np.lexsort((places[3], places[2], places[1], places[0]))
    return _bricks(places[:, order], part[order], colour, role)


def _bricks(places: Ints, part: Ints, colour: NDArray[np.int16], role: NDArray[np.uint8]) -> Bricks:
    """Return parts at places (layer, plate, y, x), each in the colour and role of its cell."""
    layer, plate, y, x = places
    n = len(layer)
    return Bricks(
        part=part.astype(np.int16),
        corner=np.stack([x, y, PLATES_PER_BRICK * layer + plate], axis=1).astype(np.int32),
        turn=np.zeros(n, np.uint8),
        colour=colour[tuple(places)],
        role=role[tuple(places)],
        piece=np.zeros(n, np.int16),
        step=layer.astype(np.int32),
    )


def _single(catalogue: Catalogue, height: int) -> int:
    """Return the row of the part of 1 x 1 of a height in plates."""
    return next(
        row
        for row, part in enumerate(catalogue.parts)
        if (part.use, part.length, part.width, part.height) == ("model", 1, 1, height)
    )
