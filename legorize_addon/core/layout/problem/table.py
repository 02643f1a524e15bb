"""From chosen placements to the table of bricks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ...model import Bricks, Role, concatenate
from ...units import PLATES_PER_BRICK
from .problem import Problem
from .shapes import Index


def brick_table(problem: Problem, chosen: Index) -> Bricks:
    """Write chosen placements down as bricks.

    Parameters
    ----------
    problem : Problem
        What they are placements of.
    chosen : (n_bricks,) intp array
        Their rows.

    Returns
    -------
    Bricks
        In the order of `chosen`. A brick has the role of its cells, ``INSIDE``
        only if all are; its step is the layer.
    """
    sheets, found = problem.sheets, problem.placements
    x, y, sheet = found.corner[chosen].T
    level = sheets.level[sheet]
    roles = sheets.role.reshape(-1)[sheets.cells[found.cells[found.entries(chosen)]]]
    return Bricks(
        part=problem.shapes.part[found.shape[chosen]],
        corner=np.stack([x, y, level], axis=1),
        turn=problem.shapes.turn[found.shape[chosen]],
        colour=found.colour[chosen],
        role=_outermost(roles, found.size[chosen]),
        piece=np.zeros(len(chosen), dtype=np.int16),
        step=level // np.int32(PLATES_PER_BRICK),
    )


def gather(tables: Sequence[Bricks]) -> Bricks:
    """Put tables together.

    Parameters
    ----------
    tables : sequence of Bricks
        At least one.

    Returns
    -------
    Bricks
        By ascending plate, then y, then x.
    """
    bricks = concatenate(tables)
    return bricks.take(np.lexsort(tuple(bricks.corner.T)))


def _outermost(roles: NDArray[np.uint8], size: Index) -> NDArray[np.uint8]:
    """Return the lowest role of each brick's cells, inside being the last of all."""
    inside, last = np.uint8(Role.INSIDE), np.uint8(np.iinfo(np.uint8).max)
    lowest = np.minimum.reduceat(np.where(roles == inside, last, roles), np.cumsum(size) - size)
    return np.where(lowest == last, inside, lowest)
