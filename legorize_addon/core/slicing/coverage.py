"""How much of every grid cell lies inside the cut of the mesh, exactly.

References
----------
The accumulation buffer is the one of font rasterisers: every directed edge adds
its height and the area to its right, and a running sum along the row gives the
signed area of each cell, whatever the loops' nesting.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Floats, Ints
from ..geometry import split_at_lattice
from ..units import CELL_AREA, STUD
from .trajectories import Outline

_LEFT: Final = 1e-7
"""An edge that is this close to a grid line, in cells, belongs to the cell on its left, the inside."""


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """Edges cut at the grid lines, so that each piece lies in one cell.

    Attributes
    ----------
    edge : (m,) int64 array
        Edge of each piece; the pieces of an edge come in its direction.
    cell : (m, 2) int64 array
        Column and row of the cell.
    middle : (m, 2) float64 array
        Middle of the piece in cells from the grid's corner.
    along : (m, 2) float64 array
        Vector from start to end in cells.
    """

    edge: Ints
    cell: Ints
    middle: Floats
    along: Floats

    @property
    def length(self) -> Floats:
        """Length of each piece in mm, shape (m,)."""
        length: Floats = np.hypot(self.along[:, 0], self.along[:, 1]) * STUD
        return length


def cut_at_grid(start: Floats, end: Floats, corner: Floats) -> Pieces:
    """Cut edges at the lines of the 8 mm grid.

    Parameters
    ----------
    start, end : (n, 2) float64 arrays
        Ends of the edges in mm.
    corner : (2,) float64 array
        Corner of cell (0, 0) in mm.

    Returns
    -------
    Pieces
    """
    first, last = (start - corner) / STUD, (end - corner) / STUD
    vector = last - first
    edge, low, high = split_at_lattice(first, last)
    along = vector.take(edge, axis=0)
    middle = first.take(edge, axis=0) + ((low + high) / 2)[:, None] * along
    along *= (high - low)[:, None]
    length = np.maximum(np.hypot(vector[:, 0], vector[:, 1]), np.finfo(float).tiny)
    left = np.column_stack([-vector[:, 1], vector[:, 0]]) * (_LEFT / length)[:, None]
    return Pieces(edge, np.floor(middle + left.take(edge, axis=0)).astype(np.int64), middle, along)


def covered_area_shares(pieces: Pieces, level: Ints, n_levels: int, n_y: int, n_x: int) -> Floats:
    """Return the area of every cell that the loops of each level enclose.

    Parameters
    ----------
    pieces : Pieces
    level : (m,) int array
        Slice of each piece.
    n_levels, n_y, n_x : int
        Size of the grid; loops may leave it.

    Returns
    -------
    (n_levels, n_y, n_x) float64 array
        Signed area in mm^2: overlapping bodies add up, cavities subtract.
    """
    x, y = pieces.middle.T
    # beside the grid: what is left of it fills the row from its start on, what is right of it nothing
    column, line = np.clip(np.floor(x), 0, n_x).astype(np.int64), np.floor(y).astype(np.int64)
    fill = np.clip(x - column, 0, 1)
    rise = np.where((line >= 0) & (line < n_y), -pieces.along[:, 1], 0)
    width = n_x + 2
    place = (level * n_y + np.clip(line, 0, n_y - 1)) * width + column
    size = n_levels * n_y * width
    change = np.bincount(place, rise * (1 - fill), size) + np.bincount(place + 1, rise * fill, size)
    area: Floats = np.cumsum(change.reshape(n_levels, n_y, width), axis=2)[:, :, :n_x] * CELL_AREA
    return area


def covered_area(outline: Outline, n_levels: int, corner: Floats, n_y: int, n_x: int) -> Floats:
    """Return the area of every cell inside closed loops, 0 to 64 mm^2.

    Parameters
    ----------
    outline : Outline
        Linked segments in mm.
    n_levels : int
        Number of slices.
    corner : (2,) float64 array
        Corner of cell (0, 0) in mm.
    n_y, n_x : int

    Returns
    -------
    (n_levels, n_y, n_x) float64 array
    """
    pieces = cut_at_grid(outline.start, outline.ends, corner)
    area = covered_area_shares(pieces, outline.slice[pieces.edge].astype(np.int64), n_levels, n_y, n_x)
    return np.clip(area, 0, CELL_AREA)
