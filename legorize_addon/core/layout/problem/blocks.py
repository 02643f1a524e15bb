"""Blocks of wide sheets, each small enough for a linear programme."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np

from ...arrays import Mask
from .shapes import Index

SIDE: Final = 16
_HALO: Final = 5
"""Studs along a block, unless said otherwise, and around it."""


def blocks(corner: Index, shift: int = 0, side: int = SIDE) -> Iterator[tuple[Mask, Mask]]:
    """Divide sheets into blocks, to and fro.

    Parameters
    ----------
    corner : (n_cells, 3) intp array
        Where the cells are: x and y in studs, number of the sheet.
    shift : int
        Studs by which the first row and column of blocks are cut short.
    side : int
        Studs along a block.

    Yields
    ------
    window, core : (n_cells,) bool arrays
        A block with some studs around it, and the block alone. Blocks without cells are left out.
    """
    x, y, sheet = corner.T + np.array([[shift], [shift], [0]])
    n_x, n_y, n_sheets = np.array([x.max(), y.max(), sheet.max()]) // (side, side, 1) + 1
    for row in range(n_sheets * n_y):
        for column in range(n_x)[:: -1 if row % 2 else 1]:
            low = np.array([column, row % n_y]) * side
            near = sheet == row // n_y
            core, window = (
                near
                & _between(x, low[0] - reach, low[0] + side + reach)
                & _between(y, low[1] - reach, low[1] + side + reach)
                for reach in (0, _HALO)
            )
            if core.any():
                yield window, core


def _between(at: Index, low: int, high: int) -> Mask:
    between: Mask = (at >= low) & (at < high)
    return between
