"""A mosaic that stands: a wall of bricks that shows an image to the front."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..model import COLOUR_ANY, COLOUR_EMPTY, Fill, Role, UnitGrid
from ..units import PLATES_PER_BRICK

DEEP: Final = 2
"""Studs of such a wall from front to back: bricks of one stud would not hold where colours change from stud to stud."""


def wall_of(colour: NDArray[np.int16]) -> UnitGrid:
    """Return the cells of a wall.

    Parameters
    ----------
    colour : (rows, columns) int16 array
        LDraw code of each stud, the lowest row first; ``COLOUR_EMPTY`` where there is a hole.

    Returns
    -------
    UnitGrid
        A layer for each row. The front is row 0 along y; what is behind it may have any colour.
    """
    rows, columns = colour.shape
    codes = np.full((rows, PLATES_PER_BRICK, DEEP, columns), COLOUR_EMPTY, dtype=np.int16)
    codes[:, :, 0] = colour[:, None]
    codes[:, :, 1:] = np.where(colour == COLOUR_EMPTY, np.int16(COLOUR_EMPTY), np.int16(COLOUR_ANY))[:, None, None]
    role = np.full(codes.shape, Role.INSIDE, dtype=np.uint8)
    role[:, :, 0] = Role.SHELL
    cover = np.where(codes == COLOUR_EMPTY, Fill.EMPTY, Fill.REQUIRED).astype(np.uint8)
    return UnitGrid(codes, cover, role, np.zeros(3))
