"""Which bricks go on together: what hangs, with what it hangs from.

A brick is held when one below it is, or when it stands on the table. What then is
not held hangs under others. It is built upside down by nobody: the lowest held
brick over it takes all that hangs below along, and the whole is put on from above
as one unit. What rests on the unit is held from then on.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from ..arrays import Ints, Mask
from ..model import NOBODY, Assembly, Rows, components, stacked
from .blocking import knots, of_nodes, unique_pairs
from .items import MOST

LARGEST: Final = 0.25
"""Share of the bricks on a table that one sub-assembly of them has at most: a larger one is no detail any more.

On small tables it may have as many bricks as a step, for otherwise what hangs on these would be pressed from below.
"""


Leans = Callable[[Sequence[int]], bool]
"""Tells of some nodes whether they would fall over by themselves."""

_Turn = tuple[bool, int, bool, int, int]
"""Whether a node is a piece, its level, whether it comes after others of that, its rank and its number."""


def _never(_: Sequence[int]) -> bool:
    """Let everything stand."""
    return False


class Hangers(NamedTuple):
    """Which of the bricks of one level takes along first what hangs.

    Attributes
    ----------
    rank : (n,) int64 array
        The one of the least rank. Equal ranks of mirrored bricks give mirrored units.
    leans : callable
        Tells of some nodes whether they would fall over on a table: those with
        which a brick does so are left to others.
    """

    rank: Ints
    leans: Leans = _never


@dataclass(frozen=True, slots=True, eq=False)
class Units:
    """Bricks on one table as units that are put on one after the other.

    Attributes
    ----------
    unit : (n,) int64 array
        Number of the unit of each brick.
    pressed : (n,) bool array
        Bricks that no unit can take along: they are pressed from below.
    loose : (n,) bool array
        Bricks that nothing holds at all.
    before : (m, 2) int32 array
        Units of which the first must be in place before the second.
    """

    unit: Ints
    pressed: Mask
    loose: Mask
    before: Rows


def find_units(
    node: Ints,
    level: Ints,
    pairs: Rows,
    below: Rows,
    *,
    ground: Mask,
    hangers: Hangers | None = None,
    piece: Mask | None = None,
) -> Units:
    """Find what goes on together.

    Parameters
    ----------
    node : (n,) int64 array
        Number from 0 of what each brick is part of already: bricks of a piece
        that was built elsewhere share one, all others have their own.
    level : (n,) int array
        Plate on which each brick lies.
    pairs : (k, 2) int32 array
        Lower and upper brick of each contact.
    below : (l, 2) int32 array
        Lower and upper brick of those in a stud column, see :func:`column_pairs`.
    ground : (n,) bool array
        Bricks that stand on the table.
    hangers : Hangers, optional
        Which of the bricks of one level takes along first what hangs.
    piece : (n,) bool array, optional
        Bricks of pieces that were built elsewhere: those that share their number
        with others if it is not given.

    Returns
    -------
    Units
    """
    hangers = Hangers(np.zeros(len(node), dtype=np.int64)) if hangers is None else hangers
    piece = (np.bincount(node, minlength=1) > 1)[node] if piece is None else piece
    return _Hanging(node, level, pairs, below, ground, hangers, piece).units()


def presses(assembly: Assembly, below: Rows, node: Ints) -> bool:
    """Tell whether bricks would have to be pressed from below if others are put on as pieces.

    Parameters
    ----------
    assembly : Assembly
        n bricks.
    below : (m, 2) int32 array
        Lower and upper brick of those in a stud column, see :func:`column_pairs`.
    node : (n,) int64 array
        Number of what each brick is put on with.

    Returns
    -------
    bool
    """
    level = assembly.bricks.corner[:, 2].astype(np.int64)
    numbers = np.unique(node, return_inverse=True)[1].reshape(-1).astype(np.int64)
    found = find_units(numbers, level, assembly.graph.pairs, below, ground=level == level.min())
    return bool(found.pressed.any())


class _Hanging:
    """The search for units among nodes: single bricks, and pieces that are built already."""

    def __init__(
        self, node: Ints, level: Ints, pairs: Rows, below: Rows, ground: Mask, hangers: Hangers, piece: Mask
    ) -> None:
        self.leans = hangers.leans
        self.node, self.n = node, int(node.max(initial=NOBODY)) + 1
        self.piece = np.zeros(self.n, dtype=bool)
        self.piece[node[piece]] = True
        self.level = np.full(self.n, np.iinfo(np.int64).max)
        np.minimum.at(self.level, node, level)
        self.rank = np.zeros(self.n, dtype=np.int64)
        self.rank[node] = hangers.rank
        self.pairs, self.blocks = of_nodes(pairs, node, self.n), of_nodes(below, node, self.n)
        self.under, self.over = stacked(self.pairs, self.n)
        self.held = np.zeros(self.n, dtype=bool)
        self.owner = np.arange(self.n)
        self.pressed = np.zeros(self.n, dtype=bool)
        # what each hanging brick hangs from
        self.hanger = np.full(self.n, NOBODY)
        self._gather(np.unique(node[ground]).tolist())

    def units(self) -> Units:
        """Return the units, as many of them as can follow each other."""
        while self._untie():
            pass
        _, unit = np.unique(self.owner, return_inverse=True)
        unit = unit.reshape(-1).astype(np.int64)
        before = of_nodes(self._constraints(), unit, int(unit.max(initial=NOBODY)) + 1)
        return Units(unit[self.node], self.pressed[self.node], ~self.held[self.node], before)

    def _gather(self, standing: list[int]) -> None:
        """Let held bricks take along what hangs under them, the lowest first."""
        agenda: list[_Turn] = []
        self._hold(standing, agenda)
        while agenda:
            of_piece, level, late, rank, head = heapq.heappop(agenda)
            hanging = self._below(head)
            if not hanging:
                continue
            if not (of_piece or late) and self.leans([head, *hanging]):
                # others of its level may take along what hangs, and stand with it
                self.hanger[hanging] = NOBODY
                heapq.heappush(agenda, (of_piece, level, True, rank, head))
                continue
            if self.piece[[head, *hanging]].any():
                # a piece is finished when it is joined
                self.pressed[hanging] = True
            else:
                self.owner[hanging] = self.owner[head]
            self.held[hanging] = True
            self._hold([one for each in hanging for one in self.over[each]], agenda)

    def _hold(self, found: list[int], agenda: list[_Turn]) -> None:
        """Mark bricks as held, and all that rests on them."""
        while found:
            each = found.pop()
            if not self.held[each]:
                self.held[each] = True
                # a piece takes nothing along: it is asked when nobody else does
                turn = (bool(self.piece[each]), int(self.level[each]), False, int(self.rank[each]), each)
                heapq.heappush(agenda, turn)
                found += self.over[each]

    def _below(self, head: int) -> list[int]:
        """Return what is not held and hangs below a brick, from above."""
        found: list[int] = []
        agenda = [head]
        while agenda:
            each = agenda.pop(0)
            for one in self.under[each]:
                if not self.held[one] and self.hanger[one] == NOBODY:
                    self.hanger[one] = each
                    found.append(one)
                    agenda.append(one)
        return found

    def _constraints(self) -> Rows:
        """Return which nodes must come before which; what is pressed comes after what it hangs from."""
        lower, upper = self.blocks.T
        own = self.pressed[lower] & (self._root(lower) == self._root(upper))
        hanging = np.flatnonzero(self.pressed)
        # what lies below one that is pressed still comes before what that hangs from
        over = self.pressed[upper] & ~own
        extra = np.stack([lower[over], self._root(upper[over])], axis=1)
        down = np.stack([self.hanger[hanging], hanging], axis=1)
        return unique_pairs(np.concatenate([self.blocks[~own], down, extra]).astype(np.int32), self.n)

    def _root(self, nodes: Ints | Rows) -> Ints:
        """Return the brick that is not pressed from which others hang in the end."""
        root = np.asarray(nodes).astype(np.int64)
        while self.pressed[root].any():
            root = np.where(self.pressed[root], self.hanger[root], root)
        return root

    def _untie(self) -> bool:
        """Merge units that each must come before the other, or give them up; tell whether anything changed."""
        edges = of_nodes(self._constraints(), self.owner, self.n)
        knot = knots(edges, self.n)
        used = np.bincount(knot[np.unique(self.owner)], minlength=int(knot.max(initial=NOBODY)) + 1)
        changed = False
        for number in np.flatnonzero(used > 1).tolist():
            members = np.flatnonzero(knot[self.owner] == number)
            if self._one_thing(members):
                self.owner[members] = members[0]
                changed = True
            else:
                changed |= self._give_up(members)
        return changed

    def _one_thing(self, members: Ints) -> bool:
        """Whether bricks can be one sub-assembly: few, not all of the table, hanging together, without a piece."""
        inside = np.zeros(self.n, dtype=bool)
        inside[members] = True
        if (
            self.piece[members].any()
            or self.pressed[members].any()
            or len(members) > min(max(LARGEST * self.n, MOST), self.n - 1)
        ):
            return False
        found = components(self.pairs[inside[self.pairs].all(axis=1)], self.n)[members]
        return bool((found == found[0]).all())

    def _give_up(self, members: Ints) -> bool:
        """Let what hangs among some bricks be pressed from below."""
        # whole units, so that none is left in pieces
        members = np.flatnonzero(np.isin(self.owner, self.owner[members]))
        hanging = members[(self.hanger[members] != NOBODY) & ~self.pressed[members]]
        self.owner[members] = members
        self.pressed[hanging] = True
        return len(hanging) > 0
