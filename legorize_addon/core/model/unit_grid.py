"""The grid of unit bricks: three plates to a brick, each cell filled or empty, in a colour."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Mask
from ..units import PLATE, STUD

COLOUR_ANY: Final = -1
"""Colour of a hidden cell: the layout may choose."""

COLOUR_EMPTY: Final = -2
"""Colour of a cell where nothing may be built."""


class Fill(IntEnum):
    """Whether a cell must be filled (visible or carrying), may be filled, must stay empty, or belongs to a given brick.

    Nothing is laid in a fixed cell: the brick that fills it was there before.
    """

    EMPTY = 0
    OPTIONAL = 1
    REQUIRED = 2
    FIXED = 3


@dataclass(frozen=True, slots=True, eq=False)
class UnitGrid:
    """The model in unit cells of 8 x 8 x 3.2 mm, three plates to a brick.

    Attributes
    ----------
    colour : (n_layers, 3, n_y, n_x) int16 array
        LDraw colour code, ``COLOUR_ANY`` or ``COLOUR_EMPTY``.
    cover : (n_layers, 3, n_y, n_x) uint8 array
        ``Fill`` of each cell; ``EMPTY`` exactly where the colour is ``COLOUR_EMPTY``.
    role : (n_layers, 3, n_y, n_x) uint8 array
        ``Role`` of each cell (of no meaning where it is empty).
    origin : (3,) float64 array
        Corner of cell [0, 0, 0, 0] in mm, in the coordinates of the scaled mesh.
    """

    colour: NDArray[np.int16]
    cover: NDArray[np.uint8]
    role: NDArray[np.uint8]
    origin: Floats

    @property
    def solid(self) -> Mask:
        """Required, optional and fixed cells, shape (n_layers, 3, n_y, n_x)."""
        solid: Mask = self.cover != Fill.EMPTY
        return solid


def ground_of(filled: Mask) -> int:
    """Return the plane that stands on the ground: the lowest one that is not empty.

    Parameters
    ----------
    filled : (n_planes, n_y, n_x) bool array

    Returns
    -------
    int
        0 where there is nothing at all.
    """
    return int(filled.any(axis=(1, 2)).argmax()) if len(filled) else 0


CELL_SIZE: Final = np.array([STUD, STUD, PLATE])
"""Size of a cell along x, y and z in mm."""
