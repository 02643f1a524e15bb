"""Plates under roofs that are one layer thick, which otherwise would fall apart along their seams.

Bricks are joined only by their studs, so the bricks of a roof of one layer are not joined to each other. Builders put a
second layer under it, and so does this stage, wherever a brick cannot reach something below or on top of the roof.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from scipy import ndimage

from ..arrays import Mask
from ..model import COLOUR_ANY, Fill, Role, UnitGrid, agree, brick_columns, every_plate, ground_of
from ..units import PLATES_PER_BRICK

_REACH: Final = 2
"""Studs by which a brick may stick out from what carries it."""

_OVERLAP: Final = 2
"""Studs by which the plates under a roof reach below the bricks around."""


def reinforce_roofs(grid: UnitGrid, *, plates: bool) -> UnitGrid:
    """Put plates or bricks of any colour under cells that nothing else holds.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model.
    plates : bool
        Whether to use plates: of role ``PLATE``; bricks have the role ``INSIDE``.

    Returns
    -------
    UnitGrid
        With more cells that must be built, in cells that were empty.
    """
    brick, colour = brick_columns(grid)
    solid = _stacked(grid.solid)
    single = solid & ~np.repeat(brick, PLATES_PER_BRICK, axis=0)
    added = np.zeros_like(solid)
    # a stair of plates, each on the rim of the next, carries nothing: supports must be as high as a brick
    upright = ndimage.binary_opening(solid, np.ones((PLATES_PER_BRICK, 1, 1), dtype=bool))
    for present, code, height in ((brick, colour, PLATES_PER_BRICK), (single, _stacked(grid.colour), 1)):
        below, above = _vertical(upright, ground_of(solid), height)
        under = _unheld(present, present & (below | above), code) & ~below
        # sheet k lies on level k * height, and nothing on the ground is unheld
        sheet, y, x = np.nonzero(under)
        added[sheet * height - 1, y, x] = True
    cells = (added & ~solid).reshape(grid.cover.shape)
    if not plates:
        cells = every_plate(cells.any(axis=1) & ~grid.solid.any(axis=1))
    if not cells.any():
        return grid
    return replace(
        grid,
        colour=np.where(cells, np.int16(COLOUR_ANY), grid.colour),
        cover=np.where(cells, np.uint8(Fill.REQUIRED), grid.cover),
        role=np.where(cells, np.uint8(Role.PLATE if plates else Role.INSIDE), grid.role),
    )


def _stacked(cells: np.ndarray) -> np.ndarray:
    return cells.reshape(-1, *cells.shape[2:])


def _vertical(solid: Mask, ground: int, height: int) -> tuple[Mask, Mask]:
    """Return whether the ground or a cell is right below, and right above, the cells of sheets of a height."""
    around = np.pad(solid, ((1, 1), (0, 0), (0, 0)))
    around[: ground + 1] = True
    return around[:-2][::height], around[2:][height - 1 :: height]


def _unheld(present: Mask, held: Mask, colour: np.ndarray) -> Mask:
    """Return the cells of sheets that are too far from held ones of their colour, and those around them.

    Parameters
    ----------
    present, held : (n_sheets, n_y, n_x) bool arrays
    colour : (n_sheets, n_y, n_x) int16 array

    Returns
    -------
    (n_sheets, n_y, n_x) bool array
    """
    reached = held.copy()
    for _ in range(_REACH):
        step = reached.copy()
        for axis in (1, 2):
            low, high = _pair(axis)
            same = agree(colour[low], colour[high])
            step[low] |= reached[high] & same
            step[high] |= reached[low] & same
        reached = step & present
    around = ndimage.binary_dilation(present & ~reached, np.ones((1, 3, 3), dtype=bool), iterations=_OVERLAP)
    unheld: Mask = around & present
    return unheld


def _pair(axis: int) -> tuple[tuple[slice, ...], tuple[slice, ...]]:
    """Return the slices of cells and of their next cells along an axis of three."""
    low = tuple(slice(None, -1) if each == axis else slice(None) for each in range(3))
    high = tuple(slice(1, None) if each == axis else slice(None) for each in range(3))
    return low, high
