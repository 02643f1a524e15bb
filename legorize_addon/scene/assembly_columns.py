"""How a build is put together: columns beside the table of bricks that the exploded view and the steps read.

No Blender in here; the columns are attributes of the points by the same names.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..core.arrays import Floats, Mask
from ..core.building import Action, Moves
from ..core.model import CELL_SIZE, NOBODY, Bricks, Catalogue
from .brick_points import sizes

Columns = Mapping[str, NDArray[np.generic]]

TIER: Final = "tier"
REMOVED: Final = "removed"
JOINED: Final = "joined"
ASIDE: Final = "aside"

NEVER: Final = np.iinfo(np.int32).max
"""Step of what does not happen."""

GAP: Final = 3
"""Studs between pieces that stand on the table side by side."""

BACK: Final = 0.7
"""Studs to the back for each stud to the right: seen from the front right, no piece stands before another."""


def assembly_columns(bricks: Bricks, moves: Moves, catalogue: Catalogue) -> dict[str, NDArray[np.generic]]:
    """Return what the points of a build know of how it is put together.

    Parameters
    ----------
    bricks : Bricks
        Model and supports, n rows.
    moves : Moves
        The building order, of the same rows.
    catalogue : Catalogue
        Parts and colours.

    Returns
    -------
    dict of str to array
        ``tier`` (n,) int32, the place of a brick's piece among the pieces from
        below, 0 for the first one; ``removed`` (n,) int32, the step in which a
        brick is taken out, ``NEVER`` for what stays; ``joined`` (n,) int32, the
        step in which its piece is joined, ``NOBODY`` for the first one; ``aside``
        (n, 3) float64, the way in mm from its place in the model to where its
        piece stands on the table until then.
    """
    pieces, row = np.unique(bricks.piece, return_inverse=True)
    row = row.reshape(-1)
    floor = np.full(len(pieces), NEVER)
    np.minimum.at(floor, row, bricks.corner[:, 2])
    order = np.lexsort((pieces, floor, pieces > 0))
    joins = moves.action == Action.JOIN
    joined = np.full(len(pieces), NOBODY, dtype=np.int32)
    joined[np.searchsorted(pieces, moves.piece[joins])] = moves.step[joins]
    removals = moves.action == Action.REMOVE
    removed = np.full(len(bricks), NEVER, dtype=np.int32)
    removed[moves.brick[removals]] = moves.step[removals]
    return {
        TIER: np.argsort(order).astype(np.int32)[row],
        REMOVED: removed,
        JOINED: joined[row],
        ASIDE: _aside(bricks, row, order, floor, catalogue)[row],
    }


def there_after(steps: int, step: NDArray[np.integer], removed: NDArray[np.generic]) -> Mask:
    """Tell which bricks are there after some building steps, as the brick tree does.

    Parameters
    ----------
    steps : int
        Building steps that are done; 0 for all bricks at once.
    step, removed : (n,) integer array
        Steps in which each brick is placed and taken out.

    Returns
    -------
    (n,) bool array
    """
    if steps == 0:
        return np.ones(len(step), dtype=bool)
    there: Mask = (step < steps) & (removed >= steps)
    return there


def way_after(steps: int, columns: Columns, lift: float) -> Floats:
    """Return how far from their places bricks are after some building steps, as the brick tree moves them.

    Parameters
    ----------
    steps : int
        Building steps that are done; 0 for all of them.
    columns : mapping of str to array
        Made by :func:`assembly_columns`, n rows.
    lift : float
        Way in mm by which each piece is lifted off the one below it.

    Returns
    -------
    (n, 3) float64 array
        In mm.
    """
    raised = np.outer(columns[TIER], (0.0, 0.0, lift))
    alone = (columns[JOINED] >= steps) & (steps > 0)
    return np.where(alone[:, None], columns[ASIDE], raised)


def _aside(
    bricks: Bricks, row: NDArray[np.intp], order: NDArray[np.intp], floor: NDArray[np.integer], catalogue: Catalogue
) -> Floats:
    """Return the ways of the pieces to their places in a line beside the first one, (n_pieces, 3) in mm."""
    left = bricks.corner[:, 0]
    right = left + sizes(bricks.part, bricks.turn, catalogue)[:, 0]
    way = np.zeros((len(floor), 3))
    free = 0
    for turn, piece in enumerate(order.tolist()):
        mine = row == piece
        low, high = int(left[mine].min()), int(right[mine].max())
        if turn == 0:
            free = high + GAP
            continue
        right_by = free - low
        way[piece] = (right_by, round(BACK * right_by), floor[order[0]] - floor[piece])
        free += high - low + GAP
    return way * CELL_SIZE
