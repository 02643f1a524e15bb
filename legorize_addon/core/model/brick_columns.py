"""Which cell columns of a grid are built as whole bricks, and which of its cells touch."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Ints, Mask
from ..units import PLATES_PER_BRICK
from .bricks import Role
from .unit_grid import COLOUR_ANY, Fill, UnitGrid


def brick_columns(grid: UnitGrid) -> tuple[Mask, NDArray[np.int16]]:
    """Tell which cell columns are laid in bricks.

    Parameters
    ----------
    grid : UnitGrid

    Returns
    -------
    brick : (n_layers, n_y, n_x) bool array
        Columns of three solid plates of one colour (cells of any colour agree
        with every other), except those that have the role of plates or hold a fixed cell.
    colour : (n_layers, n_y, n_x) int16 array
        Their colour, or ``COLOUR_ANY``.
    """
    top = grid.colour.max(axis=1)
    lowest = np.where(grid.colour == COLOUR_ANY, np.iinfo(np.int16).max, grid.colour).min(axis=1)
    # free colours are -1 at the top and the greatest at the bottom: they never disagree
    free = (grid.role != Role.PLATE) & (grid.cover != Fill.FIXED)
    brick: Mask = grid.solid.all(axis=1) & (lowest >= top) & free.all(axis=1)
    return brick, top


@dataclass(frozen=True, slots=True, eq=False)
class Touching:
    """The solid cells of a grid and which of them touch.

    Attributes
    ----------
    cell : (n,) int64 array
        Flat index of each solid cell among all plates, rising.
    column : (n,) int64 array
        The lowest solid cell of the brick's height that each belongs to, by row of `cell`.
    upright, sideways : (2, m) int64 arrays
        Pairs of rows that are stacked, and that lie side by side.
    """

    cell: Ints
    column: Ints
    upright: Ints
    sideways: Ints

    @classmethod
    def of(cls, solid: Mask) -> Touching:
        """List the solid cells, (n_layers, 3, n_y, n_x), and their neighbours."""
        cell = np.flatnonzero(solid)
        row = np.full(solid.size + solid[0, 0].size, -1, dtype=np.int64)
        row[cell] = np.arange(len(cell))
        n_y, n_x = solid.shape[2:]
        above, behind, right = (row[cell + step] for step in (n_x * n_y, n_x, 1))
        right[(cell + 1) % n_x == 0] = -1
        behind[cell // n_x % n_y == n_y - 1] = -1
        here = np.arange(len(cell))
        upright, *sideways = (np.stack([here, there])[:, there >= 0] for there in (above, behind, right))
        column = here.copy()
        same = upright[:, cell[upright[1]] // (n_x * n_y) % PLATES_PER_BRICK != 0]
        for _ in range(PLATES_PER_BRICK - 1):
            column[same[1]] = column[same[0]]
        return cls(cell, column, upright, np.concatenate(sideways, axis=1))

    def laid(self, colour: NDArray[np.int16], whole: Mask) -> NDArray[np.int16]:
        """Return the colours that cells are laid in: all of a brick in the one that its cells agree on, (n,)."""
        of_column = np.full(len(colour), COLOUR_ANY, dtype=np.int16)
        np.maximum.at(of_column, self.column, colour)
        return np.where(whole, of_column[self.column], colour)


def every_plate(columns: NDArray[Any]) -> NDArray[Any]:
    """Repeat values of columns, (n_layers, n_y, n_x), for their plates, (n_layers, 3, n_y, n_x)."""
    layers, rows, across = columns.shape
    return np.broadcast_to(columns[:, None], (layers, PLATES_PER_BRICK, rows, across))


def agree(first: NDArray[np.int16], second: NDArray[np.int16]) -> Mask:
    """Return which pairs of colours one part can have: equal ones, and any with ``COLOUR_ANY``."""
    same: Mask = (first == second) | (first == COLOUR_ANY) | (second == COLOUR_ANY)
    return same
