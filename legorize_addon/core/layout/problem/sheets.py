"""Which cells are laid together.

A *sheet* is everything of one height at one level: the bricks of a layer, or
the plates of one third of it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...arrays import Mask
from ...model import COLOUR_EMPTY, Fill, Role, UnitGrid, brick_columns
from ...units import PLATES_PER_BRICK
from .shapes import Index, Plane, Rows


@dataclass(frozen=True, slots=True, eq=False)
class Sheets:
    """Sheets of one height, bottom-up.

    Their cells are numbered from 0, sheet after sheet, row after row, without
    those where nothing may be laid.

    Attributes
    ----------
    height : int
        Plates: 3 for bricks, 1 for plates.
    level : (n_sheets,) int32 array
        Lowest plate of each sheet.
    colour : (n_sheets, n_y, n_x) int16 array
        LDraw code, ``COLOUR_ANY``, or ``COLOUR_EMPTY`` where nothing may be laid.
    required : (n_sheets, n_y, n_x) bool array
        Cells that have to be covered.
    role : (n_sheets, n_y, n_x) uint8 array
        ``Role`` of the cells.
    """

    height: int
    level: Rows
    colour: Plane
    required: Mask
    role: NDArray[np.uint8]

    def __len__(self) -> int:
        """Return the number of sheets."""
        return len(self.level)

    @property
    def cells(self) -> Index:
        """Flat indices of the cells in the arrays, by number, shape (n_cells,)."""
        return np.flatnonzero(self.colour != COLOUR_EMPTY)

    @property
    def n_cells(self) -> Index:
        """Number of cells of each sheet, shape (n_sheets,)."""
        n_cells: Index = (self.colour != COLOUR_EMPTY).sum(axis=(1, 2))
        return n_cells

    def take(self, which: Mask | Index | slice) -> Sheets:
        """Return some of the sheets."""
        return Sheets(self.height, self.level[which], self.colour[which], self.required[which], self.role[which])


def split(grid: UnitGrid) -> list[Sheets]:
    """Split a grid into sheets of bricks and of plates.

    Bricks are laid in :func:`~..joints.brick_columns`; all other cells are plates. Fixed cells are in no sheet.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model.

    Returns
    -------
    list of Sheets
        Bricks first, then plates. Sheets without cells are left out, and so is
        a height without sheets.
    """
    brick, top = brick_columns(grid)
    required = grid.cover == Fill.REQUIRED
    no_plates = brick[:, None] | (grid.cover == Fill.FIXED)
    level = np.arange(len(brick) * PLATES_PER_BRICK, dtype=np.int32)
    bricks = Sheets(
        height=PLATES_PER_BRICK,
        level=level[::PLATES_PER_BRICK],
        colour=np.where(brick, top, np.int16(COLOUR_EMPTY)),
        required=required.any(axis=1) & brick,
        role=_outermost(grid.role),
    )
    plane = (-1, *brick.shape[1:])
    plates = Sheets(
        height=1,
        level=level,
        colour=np.where(no_plates, np.int16(COLOUR_EMPTY), grid.colour).reshape(plane),
        required=(required & ~brick[:, None]).reshape(plane),
        role=grid.role.reshape(plane),
    )
    filled = [each.take((each.colour != COLOUR_EMPTY).any(axis=(1, 2))) for each in (bricks, plates)]
    return [each for each in filled if len(each)]


def _outermost(role: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return the lowest role of each column's plates, inside being the last of all."""
    inside, last = np.uint8(Role.INSIDE), np.uint8(np.iinfo(np.uint8).max)
    lowest = np.where(role == inside, last, role).min(axis=1)
    return np.where(lowest == last, inside, lowest)
