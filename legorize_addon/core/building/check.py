"""The building order walked move by move: whether every brick finds hold, and every support comes out."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import groupby
from typing import Final

import numpy as np

from ..arrays import Ints, Mask
from ..model import NOBODY, Assembly, Bricks, Catalogue, Rows, components, contact_graph, stacked, stud_columns
from ..progress import Progress, silent
from .contacts import BuildingContacts
from .moves import Action
from .skyline import Skyline
from .steps import Steps

_PAUSE: Final = 256
"""Moves between two words of progress."""

_FAULTS: Final = ("in_air", "squeezed", "covered", "cramped", "stuck", "loose_pieces")


ROOM: Final = 9
"""Plates that must be free below a brick that is pressed from below: three bricks, as much as fingers need."""


@dataclass(frozen=True, slots=True, eq=False)
class Walk:
    """What went wrong on the way; all of it empty if the model can be built.

    Attributes
    ----------
    in_air : int64 array
        Rows of bricks that touched nothing by studs when they were placed, or
        stood in the air after a support was taken out.
    squeezed : int64 array
        Rows of bricks that had studs of others below and above when they were placed.
    covered : int64 array
        Rows of bricks that others lay over when they were pushed on from above.
    cramped : int64 array
        Rows of bricks pressed from below with less than ``ROOM`` plates below them.
    stuck : int64 array
        Rows of supports that could not be taken straight down, as bricks were
        left below them.
    loose_pieces : int64 array
        Submodels that touched nothing when they were joined, or had bricks in their way.
    wrong_end : int64 array
        Rows of bricks that are there at the end but should not be, or the other way round.
    n_steps : int
        Steps of the order.
    bad_steps : int64 array
        Steps in which something of the above happened.
    """

    in_air: Ints
    squeezed: Ints
    covered: Ints
    cramped: Ints
    stuck: Ints
    loose_pieces: Ints
    wrong_end: Ints
    n_steps: int
    bad_steps: Ints

    @property
    def buildable(self) -> bool:
        """Whether the order can be followed."""
        return len(self.bad_steps) == 0 and len(self.wrong_end) == 0


def walk(
    steps: Steps,
    assembly: Assembly,
    contacts: BuildingContacts,
    *,
    temporary: Mask,
    progress: Progress = silent,
) -> Walk:
    """Follow a building order and note whatever cannot be done.

    Parameters
    ----------
    steps : Steps
        The order.
    assembly : Assembly
        Model and supports, n rows.
    contacts : BuildingContacts
        Contacts of these bricks.
    temporary : (n,) bool array
        Bricks that must be gone at the end.
    progress : Progress, optional
        Told how far the walk is, in between.

    Returns
    -------
    Walk
    """
    moves = steps.moves
    site = _Walked(steps, assembly.bricks, assembly.catalogue, contacts)
    for action, run in groupby(range(len(moves)), key=moves.action.tolist().__getitem__):
        rows = list(run)
        if action == Action.REMOVE:
            for _, same in groupby(rows, key=moves.submodel.tolist().__getitem__):
                taken = list(same)
                site.remove(moves.brick[taken], moves.step[taken])
        elif action == Action.PLACE:
            for row in rows:
                if row % _PAUSE == 0:
                    progress("supports", row / len(moves))
                site.place(int(moves.brick[row]), int(moves.step[row]), pressed=bool(moves.pressed[row]))
        else:
            for row in rows:
                site.join(int(moves.submodel[row]), int(moves.step[row]))
    return site.result(temporary)


class _Walked:
    """The bricks in place on the way; those of different tables do not touch each other."""

    def __init__(self, steps: Steps, bricks: Bricks, catalogue: Catalogue, contacts: BuildingContacts) -> None:
        n = len(bricks)
        self.steps, self.bricks, self.catalogue, self.contacts = steps, bricks, catalogue, contacts
        self.below, self.above = stacked(contacts.pairs, n)
        self.level = bricks.corner[:, 2].tolist()
        self.floor = [steps.floor(each.number, bricks, contacts.pairs) for each in steps.submodels]
        self.assembly = steps.submodel_of(n).astype(np.int64)
        self.placed = np.zeros(n, dtype=bool)
        self.skyline = Skyline(bricks, catalogue, len(steps.submodels))
        self.faults: dict[str, list[int]] = {name: [] for name in _FAULTS}
        self.bad: list[int] = []

    def place(self, brick: int, step: int, *, pressed: bool) -> None:
        """Put a brick in place; blame it if it finds no hold, or no way."""
        below, above = self._touches(self.below[brick], brick), self._touches(self.above[brick], brick)
        standing = self._stands(brick)
        if not (below or above or standing):
            self._blame("in_air", [brick], [step])
        if (below or standing) and above:
            self._blame("squeezed", [brick], [step])
        table = int(self.assembly[brick])
        if not pressed and self.skyline.covers(brick, table):
            self._blame("covered", [brick], [step])
        if pressed and self._room(brick) < ROOM:
            self._blame("cramped", [brick], [step])
        self.placed[brick] = True
        self.skyline.add(brick, table)

    def join(self, number: int, step: int) -> None:
        """Put a submodel onto the one it belongs to; blame it if they do not touch, or if something is in the way."""
        parent = self.steps.submodels[number].parent
        mine = np.flatnonzero((self.assembly == number) & self.placed)
        in_the_way = any(self.skyline.covers(brick, parent) for brick in mine.tolist())
        self.assembly[self.assembly == number] = parent
        if in_the_way or not any(self._stands(brick) or self._rests(brick, parent, mine) for brick in mine.tolist()):
            self._blame("loose_pieces", [number], [step])
        for brick in mine.tolist():
            self.skyline.add(brick, parent)

    def remove(self, rows: Rows, steps: Rows) -> None:
        """Take bricks out one after the other; looked at backwards, each one finds hold as it is put back."""
        stuck = self._blocked(rows)
        table = int(self.assembly[rows[0]])
        self.placed[rows] = False
        held = self._grounded(table)
        here = np.flatnonzero(self.placed & (self.assembly == table))
        self._blame("in_air", here[~held[here]], np.full(len(here), steps[-1]))
        for brick, step in zip(rows[::-1].tolist(), steps[::-1].tolist(), strict=True):
            held[brick] = self._stands(brick) or any(held[one] for one in (*self.below[brick], *self.above[brick]))
            if not held[brick]:
                self._blame("in_air", [brick], [step])
        self._blame("stuck", rows[stuck], steps[stuck])
        self.skyline.renew(table, here)

    def result(self, temporary: Mask) -> Walk:
        """Return what was found."""
        return Walk(
            **{name: np.array(rows, dtype=np.int64) for name, rows in self.faults.items()},
            wrong_end=np.flatnonzero(self.placed == temporary),
            n_steps=len(self.steps),
            bad_steps=np.unique(np.array(self.bad, dtype=np.int64)),
        )

    def _blame(self, fault: str, rows: Iterable[int], steps: Iterable[int]) -> None:
        for row, step in zip(rows, steps, strict=False):
            self.faults[fault].append(int(row))
            self.bad.append(int(step))

    def _stands(self, brick: int) -> bool:
        """Whether a brick stands on the table on which it is now."""
        return bool(self.level[brick] == self.floor[self.assembly[brick]])

    def _touches(self, others: list[int], brick: int) -> bool:
        """Whether one of a brick's neighbours is in place on the same table."""
        return any(self.placed[other] and self.assembly[other] == self.assembly[brick] for other in others)

    def _rests(self, brick: int, parent: int, mine: Ints) -> bool:
        """Whether a brick of a submodel lies on one of those that were there before it was joined."""
        own = set(mine.tolist())
        return any(
            self.placed[other] and self.assembly[other] == parent and other not in own for other in self.below[brick]
        )

    def _room(self, brick: int) -> int:
        """Return the plates that are free below a brick that is pressed."""
        table = self.assembly[brick]
        there = np.append(np.flatnonzero(self.placed & (self.assembly == table)), brick)
        graph = contact_graph(self.bricks.take(there), self.catalogue)
        own = graph.owner == len(there) - 1
        low, bottom = int(graph.low[2]), int(self.level[brick])
        under = (graph.owner[: bottom - low] != NOBODY) & own.any(axis=0)
        # plates that are filled there, and the table below all of them
        filled = np.flatnonzero(under.any(axis=(1, 2)))
        return bottom - int(max([low + int(plate) + 1 for plate in filled[-1:]] + [self.floor[table]]))

    def _grounded(self, table: int) -> Mask:
        """Tell which bricks in place hang together with bricks on the table."""
        n = len(self.placed)
        there = self.placed & (self.assembly == table)
        pairs = self.contacts.pairs
        pairs = pairs[there[pairs].all(axis=1)]
        component = components(pairs, n)
        standing = there & (np.array(self.level) == self.floor[table])
        found = np.zeros(n, dtype=bool)
        found[component[standing]] = True
        held: Mask = found[component] & there
        return held

    def _blocked(self, rows: Rows) -> Mask:
        """Tell which bricks, taken out in this order, have others left below them."""
        there = np.flatnonzero(self.placed & (self.assembly == self.assembly[rows[0]]))
        bricks = self.bricks.take(there)
        graph = contact_graph(bricks, self.catalogue)
        # the turn in which each is taken out, the last place being that of NOBODY
        turn = np.full(len(self.placed), len(rows))
        turn[rows] = np.arange(len(rows))
        turn = np.append(turn[there], -1)
        # the last turn of all bricks in a column, up to each plate
        latest = np.maximum.accumulate(turn[graph.owner], axis=0)
        brick, columns = stud_columns(bricks, self.catalogue)
        x, y, z = (columns - graph.low).T
        below = np.where(z > 0, latest[z - 1, y, x], -1)
        blocked = np.zeros(len(self.placed), dtype=bool)
        np.logical_or.at(blocked, there[brick], below > turn[brick])
        return blocked[rows]
