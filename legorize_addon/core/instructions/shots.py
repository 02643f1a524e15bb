"""What each step's picture shows: what is on the table before, and what comes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays import Ints, Mask
from ..building import Action, Step, Steps


@dataclass(frozen=True, slots=True, eq=False)
class Shot:
    """One step on the table of one submodel.

    Attributes
    ----------
    step : Step
    submodel : int
        The table: that of the step, or a small submodel that is built in it.
    times : int
        How many equal submodels are built at once.
    alone : bool
        Whether nothing else is to be seen of the step.
    placed : (k,) int64 array
        Rows of the bricks that are placed or taken out one by one, of one of several equal submodels.
    joined : tuple of int
        Numbers of the submodels that are put on.
    came : (m,) int64 array
        Rows of the bricks of those.
    before : (n,) int64 array
        Rows of what is on the table before.
    """

    step: Step
    submodel: int
    times: int
    alone: bool
    placed: Ints
    joined: tuple[int, ...]
    came: Ints
    before: Ints

    @property
    def new(self) -> Ints:
        """Rows of all that the picture shows as new, or as to be taken out."""
        return np.concatenate([self.placed, self.came])

    @property
    def stays(self) -> Ints:
        """Rows of what else is in the picture."""
        if self.step.action == Action.REMOVE:
            return np.setdiff1d(self.before, self.placed)
        return self.before


def shots(steps: Steps, *, temporary: Mask) -> Iterator[Shot]:
    """Follow the steps, table by table.

    Parameters
    ----------
    steps : Steps
    temporary : (n,) bool array
        Bricks that are taken out again before what they carry is put on.

    Yields
    ------
    Shot
        One a step, in order, and before it one for each kind of small submodel
        that is built in it.
    """
    on_table = {each.number: np.zeros(len(temporary), dtype=bool) for each in steps.submodels}
    for step in steps:
        # equal ones are shown once
        tables = [each for each in step.made if steps.submodels[each].like == each]
        for table in (*tables, step.submodel):
            there = on_table[table]
            # what is taken out may have come within a sub-assembly
            removed = step.action == Action.REMOVE
            own = steps.all_rows(table) if removed else steps.submodels[table].rows
            placed = step.bricks[np.isin(step.bricks, own)]
            joined = tuple(each for each in step.joined if steps.submodels[each].parent == table)
            came = np.concatenate([np.zeros(0, np.int64), *(_finished(steps, each, temporary) for each in joined)])
            times = steps.times(step, table)
            yield Shot(step, table, times, not tables, placed, joined, came, np.flatnonzero(there))
            there[placed] = not removed
            there[came] = True


def _finished(steps: Steps, number: int, temporary: Mask) -> Ints:
    """Return the rows of a submodel as it is put on, without its supports."""
    rows = steps.all_rows(number)
    return rows[~temporary[rows]]
