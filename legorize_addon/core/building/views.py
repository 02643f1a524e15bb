"""From which corner a step is seen best: what is put on behind the rest is looked at from the other side."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Mask
from ..model import NOBODY, Assembly, Rows
from .moves import Action
from .steps import Kind, Steps

WAYS: Final = ((1, -1), (1, 1), (-1, 1), (-1, -1))
"""Studs in x and y towards the eye, by quarter turns: it begins at the front, to the right."""

RISE: Final = 2
"""Plates by which a line of sight rises a stud further in x and y: 30 degrees above the table."""

SEEN: Final = 0.3
"""Share of what can be seen of a brick that is enough."""

MOST: Final = 0.75
"""Share of the bricks of a step that are seen from a corner that is good enough."""


def quarter_turns(steps: Steps, assembly: Assembly) -> NDArray[np.int8]:
    """Find the corner from which each step is seen.

    Parameters
    ----------
    steps : Steps
    assembly : Assembly
        Model and supports that they build.

    Returns
    -------
    (n_steps,) int8 array
        Quarter turns of the model, see ``WAYS``: 0 where most of what is put on is
        seen from the front, else that of the step before if this does, else the
        one from which most is seen.
    """
    turns = np.zeros(len(steps), dtype=np.int8)
    table = steps.submodel_of(len(assembly))
    seen = _Sight(assembly)
    last = np.zeros(len(steps.submodels), dtype=np.int8)
    for step in steps:
        for each in step.joined:
            table[table == each] = step.submodel
        rows = np.unique(np.concatenate([step.bricks, *(steps.all_rows(each) for each in step.joined)]))
        seen.placed[step.bricks] = step.action != Action.REMOVE
        if step.action != Action.REMOVE and steps.submodels[step.submodel].kind != Kind.SUBASSEMBLY:
            turns[step.number] = seen.turn(rows[seen.placed[rows]], table == step.submodel, int(last[step.submodel]))
        last[step.submodel] = turns[step.number]
    return turns


class _Sight:
    """Cells of bricks, and what lies between them and the eye."""

    def __init__(self, assembly: Assembly) -> None:
        graph = assembly.graph
        self.owner: Rows = graph.owner
        self.placed = np.zeros(len(assembly), dtype=bool)
        cells = np.argwhere(graph.owner != NOBODY)
        brick = graph.owner[tuple(cells.T)]
        order = np.argsort(brick, kind="stable")
        self.cells = np.split(cells[order], np.searchsorted(brick[order], np.arange(1, len(assembly))))

    def turn(self, rows: NDArray[np.int64], there: Mask, last: int) -> int:
        """Return the quarter turns from which bricks are seen best, among those there."""
        there = np.append(self.placed & there, False)
        shares: dict[int, Floats] = {}
        for turn in dict.fromkeys((0, last, 1, 3, 2)):
            shares[turn] = np.array([self._share(int(row), there, turn) for row in rows])
            if turn in (0, last) and (shares[turn] >= SEEN).mean() > MOST:
                return turn
        return max(shares, key=lambda turn: (int((shares[turn] >= SEEN).sum()), turn == 0))

    def _share(self, row: int, there: Mask, turn: int) -> float:
        """Return how much is seen of a brick, as a share of what is seen of it alone."""
        cells = self.cells[row]
        if not len(cells):
            return 1.0
        x_way, y_way = WAYS[turn]
        n_z, n_y, n_x = self.owner.shape
        far = np.arange(1, max(1, (n_z - int(cells[:, 0].min())) // RISE) + 1)
        z, y, x = (cells[:, axis, None] + way * far for axis, way in enumerate((RISE, y_way, x_way)))
        inside = (z < n_z) & (y >= 0) & (y < n_y) & (x >= 0) & (x < n_x)
        met = np.where(
            inside, self.owner[np.where(inside, z, 0), np.where(inside, y, 0), np.where(inside, x, 0)], NOBODY
        )
        alone = ~(met == row).any(axis=1)
        free = alone & ~there[met].any(axis=1)
        return float(free.sum() / max(alone.sum(), 1))
