"""The building order walked move by move: whether every brick finds hold, and every support comes out."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import groupby
from typing import Final

import numpy as np

from ..arrays import Ints, Mask
from ..model import NOBODY, Bricks, Catalogue, Rows, components, contact_graph, stacked, stud_columns
from ..progress import Progress, silent
from .contacts import BuildingContacts
from .moves import Action, Moves

_PAUSE: Final = 256
"""Moves between two words of progress."""


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
    stuck : int64 array
        Rows of supports that could not be taken straight down, as bricks were
        left below them.
    loose_pieces : int64 array
        Pieces that touched nothing when they were joined, or had bricks in their way.
    wrong_end : int64 array
        Rows of bricks that are there at the end but should not be, or the other way round.
    n_steps : int
        Steps of the order.
    bad_steps : int64 array
        Steps in which something of the above happened.
    """

    in_air: Ints
    squeezed: Ints
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
    moves: Moves,
    bricks: Bricks,
    catalogue: Catalogue,
    found: BuildingContacts,
    *,
    temporary: Mask,
    progress: Progress = silent,
) -> Walk:
    """Follow a building order and note whatever cannot be done.

    Parameters
    ----------
    moves : Moves
        The order.
    bricks : Bricks
        Model and supports, n rows.
    catalogue : Catalogue
    found : BuildingContacts
        Contacts of these bricks.
    temporary : (n,) bool array
        Bricks that must be gone at the end.
    progress : Progress, optional
        Told how far the walk is, in between.

    Returns
    -------
    Walk
    """
    site = _Walked(bricks, catalogue, found)
    for action, run in groupby(range(len(moves)), key=moves.action.tolist().__getitem__):
        rows = list(run)
        if action == Action.REMOVE:
            site.remove(moves.brick[rows], moves.step[rows])
        elif action == Action.PLACE:
            for row in rows:
                if row % _PAUSE == 0:
                    progress("supports", row / len(moves))
                site.place(int(moves.brick[row]), int(moves.step[row]))
        else:
            for row in rows:
                site.join(int(moves.piece[row]), int(moves.step[row]))
    return site.result(moves, temporary)


class _Walked:
    """The bricks in place on the way; those of different assemblies do not touch each other."""

    def __init__(self, bricks: Bricks, catalogue: Catalogue, found: BuildingContacts) -> None:
        n = len(bricks)
        self.bricks, self.catalogue, self.links = bricks, catalogue, found
        self.below, self.above = stacked(found.pairs, n)
        level = bricks.corner[:, 2]
        table = {int(piece): int(level[bricks.piece == piece].min()) for piece in np.unique(bricks.piece)}
        self.on_table = [table[piece] == z for piece, z in zip(bricks.piece.tolist(), level.tolist(), strict=True)]
        self.assembly = bricks.piece.astype(np.int64)
        self.placed = np.zeros(n, dtype=bool)
        self.in_air: list[int] = []
        self.squeezed: list[int] = []
        self.stuck: list[int] = []
        self.loose: list[int] = []
        self.bad: list[int] = []

    def place(self, brick: int, step: int) -> None:
        """Put a brick in place; blame it if it finds no hold, or no room for its studs."""
        below, above = self._touches(self.below[brick], brick), self._touches(self.above[brick], brick)
        standing = self.on_table[brick] and self.assembly[brick] == self.bricks.piece[brick]
        if not (below or above or standing):
            self._blame(self.in_air, [brick], [step])
        if (below or standing) and above:
            self._blame(self.squeezed, [brick], [step])
        self.placed[brick] = True

    def join(self, piece: int, step: int) -> None:
        """Put a piece onto the first one; blame it if they do not touch, or if something is in the way."""
        mine = np.flatnonzero((self.assembly == piece) & self.placed)
        if not self._contacts(mine) or self._in_the_way(mine):
            self._blame(self.loose, [piece], [step])
        self.assembly[self.assembly == piece] = 0

    def remove(self, rows: Rows, steps: Rows) -> None:
        """Take bricks out one after the other; looked at backwards, each one finds hold as it is put back."""
        stuck = self._blocked(rows)
        self.placed[rows] = False
        held = self._grounded(int(self.assembly[rows[0]]))
        here = np.flatnonzero(self.placed & (self.assembly == self.assembly[rows[0]]))
        self._blame(self.in_air, here[~held[here]], np.full(len(here), steps[-1]))
        for brick, step in zip(rows[::-1].tolist(), steps[::-1].tolist(), strict=True):
            held[brick] = self.on_table[brick] or any(held[one] for one in (*self.below[brick], *self.above[brick]))
            if not held[brick]:
                self._blame(self.in_air, [brick], [step])
        self._blame(self.stuck, rows[stuck], steps[stuck])

    def result(self, moves: Moves, temporary: Mask) -> Walk:
        """Return what was found."""
        return Walk(
            in_air=np.array(self.in_air, dtype=np.int64),
            squeezed=np.array(self.squeezed, dtype=np.int64),
            stuck=np.array(self.stuck, dtype=np.int64),
            loose_pieces=np.array(self.loose, dtype=np.int64),
            wrong_end=np.flatnonzero(self.placed == temporary),
            n_steps=int(moves.step.max(initial=NOBODY)) + 1,
            bad_steps=np.unique(np.array(self.bad, dtype=np.int64)),
        )

    def _blame(self, list_: list[int], rows: Iterable[int], steps: Iterable[int]) -> None:
        for row, step in zip(rows, steps, strict=False):
            list_.append(int(row))
            self.bad.append(int(step))

    def _touches(self, others: list[int], brick: int) -> bool:
        """Whether one of a brick's neighbours is in place in the same assembly."""
        return any(self.placed[other] and self.assembly[other] == self.assembly[brick] for other in others)

    def _contacts(self, mine: Ints) -> int:
        """Count the studs between a piece and the first one."""
        first = self.placed & (self.assembly == 0)
        own = np.zeros(len(self.placed), dtype=bool)
        own[mine] = True
        lower, upper = self.links.pairs.T
        between = (own[lower] & first[upper]) | (own[upper] & first[lower])
        return int(self.links.studs[between].sum())

    def _in_the_way(self, mine: Ints) -> bool:
        """Whether a brick of the first piece lies above one of a piece, which then cannot come from above."""
        first = np.flatnonzero(self.placed & (self.assembly == 0))
        there = np.concatenate([mine, first])
        owner = contact_graph(self.bricks.take(there), self.catalogue).owner
        own = (owner != NOBODY) & (owner < len(mine))
        return bool((np.logical_or.accumulate(own, axis=0) & (owner >= len(mine))).any())

    def _grounded(self, assembly: int) -> Mask:
        """Tell which bricks in place hang together with bricks on the table."""
        n = len(self.placed)
        there = self.placed & (self.assembly == assembly)
        pairs = self.links.pairs
        pairs = pairs[there[pairs].all(axis=1)]
        component = components(pairs, n)
        standing = there & np.array(self.on_table) & (self.bricks.piece == assembly)
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
