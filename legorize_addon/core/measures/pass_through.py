"""How trajectories pass through the cells of the grid: around one, two or three of a cell's corners.

References
----------
Paper, section "Classification of pass through types": the types are told apart by
the number of corners of the cell inside the trajectory.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..geometry import ranges
from ..slicing import Pieces
from ..units import STUD


def pass_through_types(pieces: Pieces, level: Ints, windings: Ints) -> tuple[Ints, NDArray[np.int8]]:
    """Return the cells that edges pass, and how many of their corners lie inside.

    Parameters
    ----------
    pieces : Pieces
        Edges cut at the grid.
    level : (m,) int64 array
        Slice of each piece.
    windings : (n_levels, n_y + 1, n_x + 1) int64 array
        From ``corner_windings`` of the same edges.

    Returns
    -------
    cell : (k, 3) int64 array
        Slice, row and column of every cell that is passed, rising; cells beside the
        grid are left out.
    inside : (k,) int8 array
        1, 2 or 3 as in the paper; 0 or 4 where edges enter and leave by the same
        side, or stay inside the cell.
    """
    shape = windings.shape[0], windings.shape[1] - 1, windings.shape[2] - 1
    place = np.column_stack([level, pieces.cell[:, ::-1]])
    here = ((place >= 0) & (place < shape)).all(axis=1) & pieces.along.any(axis=1)
    passed = np.bincount(np.ravel_multi_index(tuple(place[here].T), shape), minlength=1)
    cell = np.stack(np.unravel_index(np.flatnonzero(passed), shape), axis=1)
    layer, y, x = cell.T
    corners = [windings[layer, y + up, x + right] != 0 for up in (0, 1) for right in (0, 1)]
    return cell, np.sum(corners, axis=0, dtype=np.int8)


def corner_windings(
    start: Floats, end: Floats, level: Ints, *, corner: Floats, n_levels: int, n_y: int, n_x: int
) -> Ints:
    """Return how often closed loops wind around the corners of the cells.

    Every edge that crosses a horizontal grid line changes the winding of all
    corners to its right: noted once, and summed up along the line. A corner on a
    loop counts as moved a little to the right and less downwards.

    Parameters
    ----------
    start, end : (n, 2) float64 arrays
        Ends of the edges in mm.
    level : (n,) int64 array
        Slice of each edge.
    corner : (2,) float64 array
        Corner of cell (0, 0) in mm.
    n_levels, n_y, n_x : int
        Size of the grid; loops may leave it.

    Returns
    -------
    (n_levels, n_y + 1, n_x + 1) int64 array
        1 inside an outer loop, 0 outside or in a cavity; overlapping bodies add up.
    """
    (x0, y0), (x1, y1) = ((start - corner) / STUD).T, ((end - corner) / STUD).T
    below = np.floor(np.minimum(y0, y1)).astype(np.int64)
    edge, line = ranges(below + 1, np.floor(np.maximum(y0, y1)).astype(np.int64) - below)
    here = (line >= 0) & (line <= n_y)
    edge, line = edge[here], line[here]
    rise = (y1 - y0)[edge]
    x = x0[edge] + (line - y0[edge]) / rise * (x1 - x0)[edge]
    column = np.clip(np.ceil(x), 0, n_x + 1).astype(np.int64)
    place = (level[edge] * (n_y + 1) + line) * (n_x + 2) + column
    change = np.bincount(place, -np.sign(rise), n_levels * (n_y + 1) * (n_x + 2))
    windings = np.cumsum(change.reshape(n_levels, n_y + 1, n_x + 2), axis=2)[:, :, : n_x + 1]
    return np.round(windings).astype(np.int64)
