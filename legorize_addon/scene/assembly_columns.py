"""How a build is put together: columns beside the table of bricks that the exploded view and the steps read.

No Blender in here; the columns are attributes of the points by the same names.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..core.arrays import Floats, Mask
from ..core.building import MAIN, Action, Kind, Steps
from ..core.model import CELL_SIZE, NOBODY, Assembly, Bricks, Catalogue
from .brick_points import sizes

_SMALL: Final = (MAIN, Kind.SUBASSEMBLY)
"""Where and what a sub-assembly of the first piece is."""

Columns = Mapping[str, NDArray[np.generic]]

TIER: Final = "tier"
REMOVED: Final = "removed"
JOINED: Final = "joined"
ASIDE: Final = "aside"
MOMENT: Final = "moment"

FALL: Final = 0.3
"""Share of a step that a brick takes to fall into place."""

READY: Final = 0.85
"""Share of a step after which everything is in its place, so that one sees it."""

NEVER: Final = np.iinfo(np.int32).max
"""Step of what does not happen."""

GAP: Final = 3
"""Studs between pieces that stand on the table side by side."""

BACK: Final = 0.7
"""Studs to the back for each stud to the right: seen from the front right, no piece stands before another."""


def assembly_columns(assembly: Assembly, steps: Steps) -> dict[str, NDArray[np.generic]]:
    """Return what the points of a build know of how it is put together.

    Parameters
    ----------
    assembly : Assembly
        Model and supports, n rows.
    steps : Steps
        How they are built.

    Returns
    -------
    dict of str to array
        ``tier`` (n,) int32, the place of a brick's piece among the pieces from
        below, 0 for the first one; ``removed`` (n,) int32, the step in which a
        brick is taken out, ``NEVER`` for what stays; ``joined`` (n,) int32, the
        step in which its piece or sub-assembly is put onto the first piece,
        ``NOBODY`` for what is placed there itself; ``aside`` (n, 3) float64, the
        way in mm from its place in the model to where it stands on the table
        until then; ``moment`` (n,) float64, the share of its step after which a
        brick is placed when the steps are animated.
    """
    pieces, row = np.unique(assembly.bricks.piece, return_inverse=True)
    row = row.reshape(-1)
    floor = np.full(len(pieces), NEVER)
    np.minimum.at(floor, row, assembly.bricks.corner[:, 2])
    order = np.lexsort((pieces, floor, pieces > 0))
    return {
        TIER: np.argsort(order).astype(np.int32)[row],
        REMOVED: _removed(steps, len(assembly.bricks)),
        JOINED: _joined(steps, len(assembly.bricks)),
        ASIDE: _aside(assembly.bricks, steps, pieces[order], assembly.catalogue),
        MOMENT: _moment(steps, len(assembly.bricks)),
    }


def _moment(steps: Steps, n: int) -> Floats:
    """Return the shares of their steps after which bricks begin to fall: one after another, all in time."""
    placed = steps.moves.action == Action.PLACE
    brick, step = steps.moves.brick[placed], steps.moves.step[placed]
    order = np.lexsort((np.arange(len(step)), step))
    numbers = np.unique(step[order], return_index=True, return_counts=True)
    rank = np.arange(len(step)) - np.repeat(numbers[1], numbers[2])
    moment = np.zeros(n)
    moment[brick[order]] = (READY - FALL) * rank / np.maximum(np.repeat(numbers[2], numbers[2]) - 1, 1)
    return moment


def _removed(steps: Steps, n: int) -> NDArray[np.int32]:
    """Return the step in which each brick is taken out."""
    moves = steps.moves
    removals = moves.action == Action.REMOVE
    removed = np.full(n, NEVER, dtype=np.int32)
    removed[moves.brick[removals]] = moves.step[removals]
    return removed


def _joined(steps: Steps, n: int) -> NDArray[np.int32]:
    """Return the step in which each brick comes to the main model with others."""
    alone = steps.submodel_of(n) == MAIN
    return np.where(alone, NOBODY, steps.arrival(n)).astype(np.int32)


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


def _aside(bricks: Bricks, steps: Steps, pieces: NDArray[np.integer], catalogue: Catalogue) -> Floats:
    """Return the ways of all bricks to their places in a line beside the first piece, (n, 3) in mm.

    Each piece has a place of its own there; sub-assemblies of the first one are
    put on soon after they are built, and share the last.
    """
    left = bricks.corner[:, 0]
    right = left + sizes(bricks.part, bricks.turn, catalogue)[:, 0]
    way = np.zeros((len(bricks), 3))
    first = bricks.piece == pieces[0]
    ground, free = int(bricks.corner[first, 2].min()), int(right[first].max()) + GAP
    of_piece = [np.flatnonzero(bricks.piece == piece) for piece in pieces[1:]]
    small = [steps.all_rows(each.number) for each in steps.submodels if (each.parent, each.kind) == _SMALL]
    for turn, rows in enumerate([*of_piece, *small]):
        low, high = int(left[rows].min()), int(right[rows].max())
        right_by = free - low
        way[rows] = (right_by, round(BACK * right_by), ground - int(bricks.corner[rows, 2].min()))
        if turn < len(of_piece):
            free += high - low + GAP
    return way * CELL_SIZE
