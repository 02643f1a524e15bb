"""Whether what stands on the table keeps its balance while the model grows: each tower by itself, step by step.

Towers that are not joined yet stand alone, and one that leans would fall before
the bricks come that hold it in the finished model.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Floats, Ints
from ..geometry import beyond, corners, hull
from ..model import NOBODY, Assembly, Bricks, Catalogue, Rows, column_facts, middles, stud_columns
from ..progress import Progress, silent
from .moves import Action
from .steps import MAIN, Kind, Steps

STEADY: Final = 0.1
"""Studs that the middle of the weight must lie within the feet of a tower."""


@dataclass(frozen=True, slots=True, eq=False)
class Tipping:
    """A tower that falls over.

    Attributes
    ----------
    step : int
        First step at whose end it does.
    bricks : (n,) int64 array
        Rows of its bricks in place by then.
    middle : (2,) float64 array
        Middle of its weight in studs, x and y.
    feet : (k, 2) float64 array
        Corners of the cells in which it stands on the table, in studs.
    """

    step: int
    bricks: Ints
    middle: Floats
    feet: Floats


Prop = Callable[[Tipping], tuple[int, int] | None]
"""Puts a stud square under a tower that would fall, if one helps."""


_PAUSE: Final = 256
"""Bricks between two words of progress."""


def no_prop(_: Tipping) -> None:
    """Let every tower fall."""


def tipping(
    steps: Steps,
    assembly: Assembly,
    pairs: Rows,
    *,
    table: int = MAIN,
    prop: Prop = no_prop,
    progress: Progress = silent,
) -> list[Tipping]:
    """Find the towers that fall over while a submodel is built.

    Parameters
    ----------
    steps : Steps
        How all is built.
    assembly : Assembly
        Model and supports, n rows.
    pairs : (n_pairs, 2) int32 array
        Lower and upper brick of each contact.
    table : int
        Number of the submodel; what comes after its first removal is not looked
        at, because then it is whole.
    prop : function
        Asked for each tower that falls: the stud square (x, y) that is put under
        it from then on, or None, with which it falls.
    progress : Progress, optional
        Told how many bricks are in place, in between.

    Returns
    -------
    list of Tipping
        Of each tower that falls the first time, by step. A tower that grows
        together with one that falls is not named again.
    """
    arrivals = list(_arrivals(steps, table))
    floor = steps.floor(table, assembly.bricks, pairs)
    return falling(arrivals, assembly, pairs, floor=floor, prop=prop, progress=progress)


def unbalanced(steps: Steps, assembly: Assembly, pairs: Rows) -> tuple[tuple[Tipping, ...], tuple[Tipping, ...]]:
    """Find what a hand has to hold while it is built, on all tables.

    Parameters
    ----------
    steps : Steps
        How all is built.
    assembly : Assembly
        Model and supports, n rows.
    pairs : (n_pairs, 2) int32 array
        Lower and upper brick of each contact.

    Returns
    -------
    towers : tuple of Tipping
        Of the model and its pieces, by step.
    leaning : tuple of Tipping
        Of the sub-assemblies that have steps of their own, by step. Smaller ones are built between two fingers.
    """
    in_hand = {each for step in steps for each in step.made}
    found: tuple[list[Tipping], list[Tipping]] = [], []
    for each in steps.submodels:
        if each.number not in in_hand:
            found[each.kind == Kind.SUBASSEMBLY].extend(tipping(steps, assembly, pairs, table=each.number))
    towers, leaning = (tuple(sorted(each, key=lambda tower: tower.step)) for each in found)
    return towers, leaning


def falling(
    arrivals: Sequence[tuple[int, list[int]]],
    assembly: Assembly,
    pairs: Rows,
    *,
    floor: int,
    prop: Prop = no_prop,
    progress: Progress = silent,
) -> list[Tipping]:
    """Find the towers that fall over as bricks arrive on a table.

    Parameters
    ----------
    arrivals : sequence of (int, list of int)
        Step and rows of what comes at once, by step.
    assembly, pairs, prop, progress
        As for :func:`tipping`.
    floor : int
        Plate on which the table is.

    Returns
    -------
    list of Tipping
        As :func:`tipping`.
    """
    # of many small tables each looks at its own bricks alone
    there = np.unique(np.array([row for _, rows in arrivals for row in rows], dtype=np.int64))
    local = np.full(len(assembly), NOBODY, dtype=np.int64)
    local[there] = np.arange(len(there))
    inside = local[pairs]
    inside = inside[(inside != NOBODY).all(axis=1)]
    towers = _Towers(assembly.bricks.take(there), assembly.catalogue, inside, floor, there)
    found = []
    changed: set[int] = set()
    for number, (step, rows) in enumerate(arrivals):
        if number % _PAUSE == 0:
            progress("supports", number / len(arrivals))
        changed.update([towers.place(row) for row in local[rows].tolist()])
        if number + 1 == len(arrivals) or arrivals[number + 1][0] != step:
            for tower in sorted({towers.root(each) for each in changed}):
                found += towers.fallen_or_propped(tower, step, prop)
            changed = set()
    return found


def _arrivals(steps: Steps, table: int) -> Iterator[tuple[int, list[int]]]:
    """Yield which bricks come to a table in which step, until the first is taken out there."""
    moves, joins = steps.moves, steps.moves.action == Action.JOIN
    onto = np.array([each.parent for each in steps.submodels])[moves.submodel] == table
    rows = np.flatnonzero(np.where(joins, onto, (moves.submodel == table) | (moves.action == Action.REMOVE)))
    gone: set[int] = set()
    columns = (moves.action, moves.brick, moves.submodel, moves.step)
    for action, brick, submodel, step in zip(*(column[rows].tolist() for column in columns), strict=True):
        if action == Action.REMOVE:
            if submodel == table:
                return
            gone.add(brick)
        elif action == Action.JOIN:
            yield step, [row for row in steps.all_rows(submodel).tolist() if row not in gone]
        else:
            yield step, [brick]


class _Towers:
    """Bricks in place, as trees of a union-find; the root of each knows weight, moments and feet."""

    def __init__(self, bricks: Bricks, catalogue: Catalogue, pairs: Ints, floor: int, named: Ints) -> None:
        # what others call these bricks
        self.named = named
        n = len(bricks)
        brick, columns = stud_columns(bricks, catalogue)
        mass = catalogue.mass[bricks.part]
        self.mass = mass.tolist()
        self.moment = (middles(bricks, catalogue) * mass[:, None]).tolist()
        standing = column_facts(bricks, catalogue).foot & (columns[:, 2] == floor)
        self.feet: list[list[tuple[int, int]]] = [[] for _ in range(n)]
        for row, x, y in zip(brick[standing].tolist(), *columns[standing, :2].T.tolist(), strict=True):
            self.feet[row].append((x, y))
        # of the feet, as long as they stay the same
        self.hull: list[Floats | None] = [None] * n
        self.members = [[row] for row in range(n)]
        self.parent = list(range(n))
        self.placed = [False] * n
        self.fallen = [False] * n
        self.near: list[list[int]] = [[] for _ in range(n)]
        for lower, upper in pairs.tolist():
            self.near[lower].append(upper)
            self.near[upper].append(lower)

    def root(self, row: int) -> int:
        """Return the brick that stands for the tower of one."""
        while self.parent[row] != row:
            self.parent[row] = self.parent[self.parent[row]]
            row = self.parent[row]
        return row

    def place(self, row: int) -> int:
        """Put a brick in place; return the tower that it belongs to."""
        self.placed[row] = True
        for other in self.near[row]:
            if self.placed[other]:
                self._join(self.root(row), self.root(other))
        return self.root(row)

    def fallen_or_propped(self, tower: int, step: int, prop: Prop) -> list[Tipping]:
        """Return a tower if it falls over whatever is put under it."""
        while self.falls(tower):
            bricks = self.named[sorted(self.members[tower])]
            found = Tipping(step, bricks, self._middle(tower), corners(self.feet[tower]))
            square = prop(found)
            if square is None:
                self.fallen[tower] = True
                return [found]
            self.feet[tower].append(square)
            self.hull[tower] = None
        return []

    def falls(self, tower: int) -> bool:
        """Whether a tower falls over, which none does twice."""
        if self.fallen[tower] or not self.feet[tower]:
            return False
        middle = self._middle(tower)
        x, y = np.floor(middle).astype(int).tolist()
        # well inside of one cell is well inside of the outline of all
        if (x, y) in self.feet[tower] and np.abs(middle - (x + 0.5, y + 0.5)).max() <= 0.5 - STEADY:
            return False
        planes = self.hull[tower]
        if planes is None:
            planes = self.hull[tower] = hull(corners(self.feet[tower]))
        return bool(-beyond(planes, middle).max() < STEADY)

    def _middle(self, tower: int) -> Floats:
        """Return the middle of a tower's weight in studs, x and y."""
        middle: Floats = np.array(self.moment[tower]) / self.mass[tower]
        return middle

    def _join(self, one: int, other: int) -> None:
        if one == other:
            return
        if len(self.members[one]) < len(self.members[other]):
            one, other = other, one
        self.parent[other] = one
        self.mass[one] += self.mass[other]
        self.moment[one] = [a + b for a, b in zip(self.moment[one], self.moment[other], strict=True)]
        if self.feet[other]:
            self.feet[one] += self.feet[other]
            self.hull[one] = None
        self.members[one] += self.members[other]
        self.fallen[one] = self.fallen[one] or self.fallen[other]
