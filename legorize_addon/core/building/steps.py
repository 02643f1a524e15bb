"""The building steps: what a builder sees in one picture, and on which table it is done.

The model, its pieces and the small sub-assemblies are submodels: each is built on
the table by itself, brick by brick, and is then put as a whole onto the one that
it belongs to. There is one numbering of steps through all of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Ints
from ..model import NOBODY, Bricks, Rows
from .moves import Action, Moves

MAIN: Final = 0
"""Number of the submodel that all others are put onto in the end."""


class Kind(IntEnum):
    """What a submodel is."""

    MAIN = 0
    """The model, or its first piece, onto which the others are put."""

    PIECE = 1
    """A piece of a split model."""

    SUBASSEMBLY = 2
    """A few bricks of which some hang: put on from above together with what they hang from."""


@dataclass(frozen=True, slots=True, eq=False)
class Submodel:
    """What is built on the table by itself.

    Attributes
    ----------
    number : int
        From 0, which is the main model; a submodel has a higher number than the
        one it is put onto.
    kind : Kind
    parent : int
        Number of the submodel that it is put onto, ``NOBODY`` of the main model.
    piece : int
        Number of the piece that it is or belongs to.
    rows : (k,) int64 array
        Rows of the bricks that are placed in it one by one: not those of
        submodels that are put onto it, but those of supports. Equal submodels
        list theirs in the same order.
    like : int
        Number of the submodel that is built in the same steps, as the two are
        equal up to their places; of the first of them its own.
    """

    number: int
    kind: Kind
    parent: int
    piece: int
    rows: Ints
    like: int

    @property
    def name(self) -> str:
        """What it is called in files and sentences."""
        if self.kind == Kind.SUBASSEMBLY:
            return f"sub-{self.number}"
        return f"piece-{self.piece}" if self.kind == Kind.PIECE else "model"


@dataclass(frozen=True, slots=True, eq=False)
class Step:
    """One building step.

    Attributes
    ----------
    number : int
        From 0, through all submodels.
    submodel : int
        Where it is done; of equal ones the first.
    action : Action
        ``REMOVE`` if bricks are taken out, ``PLACE`` if at least one is placed,
        ``JOIN`` if submodels alone are put on.
    bricks : (k,) int64 array
        Rows of the bricks that are placed or taken out one by one, in order; of
        equal submodels those of all of them.
    joined : tuple of int
        Numbers of the submodels that are put on.
    pressed : bool
        Whether a brick is pressed from below.
    times : int
        How many equal submodels are built at once.
    made : tuple of int
        Numbers of the small submodels among ``joined`` that are built in the step
        itself; ``bricks`` has theirs as well.
    """

    number: int
    submodel: int
    action: Action
    bricks: Ints
    joined: tuple[int, ...]
    pressed: bool
    times: int
    made: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Steps:
    """All steps of a model.

    Attributes
    ----------
    moves : Moves
        The moves, each with its step.
    submodels : tuple of Submodel
        By their numbers.
    """

    moves: Moves
    submodels: tuple[Submodel, ...]

    def __len__(self) -> int:
        """Return the number of steps."""
        return int(self.moves.step.max(initial=NOBODY)) + 1

    def __iter__(self) -> Iterator[Step]:
        """Yield the steps in order."""
        ends = np.flatnonzero(np.diff(self.moves.step)) + 1
        for moves in np.split(np.arange(len(self.moves)), ends):
            if len(moves):
                yield self._step(moves)

    def times(self, step: Step, number: int) -> int:
        """Return how many submodels a step builds that are like one of those in which it is done."""
        alike = sum(self.submodels[each].like == self.submodels[number].like for each in step.made)
        return alike or step.times

    def all_rows(self, number: int) -> Ints:
        """Return the rows of a submodel and of all that is put onto it, supports included."""
        inside = {number}
        for each in self.submodels:
            if each.parent in inside:
                inside.add(each.number)
        rows: Ints = np.concatenate([self.submodels[each].rows for each in sorted(inside)])
        return rows

    def floor(self, number: int, bricks: Bricks, pairs: Rows) -> int:
        """Return the plate on which a submodel stands while it is built: the lowest of its bricks.

        Below the plate under the raised end of a curved slope its other end may reach farther down: a sub-assembly
        of both stands on that plate. `pairs` are the lower and the upper brick of each contact.
        """
        rows, level = self.all_rows(number), bricks.corner[:, 2]
        # other pieces are put onto the first one, which stands by itself
        own = rows[bricks.piece[rows] == self.submodels[number].piece]
        if self.submodels[number].kind == Kind.SUBASSEMBLY:
            raised = pairs[level[pairs[:, 0]] >= level[pairs[:, 1]]]
            own = own[~np.isin(own, raised[np.isin(raised, own).all(axis=1), 1])]
        return int(level[own].min(initial=np.iinfo(np.int32).max))

    def submodel_of(self, n_bricks: int) -> NDArray[np.int32]:
        """Return the submodel that each brick is placed into, (n_bricks,), ``NOBODY`` if it never is."""
        owner = np.full(n_bricks, NOBODY, dtype=np.int32)
        for each in self.submodels:
            owner[each.rows] = each.number
        return owner

    def outermost(self, *, within_pieces: bool = False) -> NDArray[np.int32]:
        """Return with which submodel each one comes to the main one, (n_submodels,), 0 of that itself.

        With ``within_pieces``, with which one it comes to its piece, and of a piece
        its own number.
        """
        outer = np.arange(len(self.submodels), dtype=np.int32)
        for each in self.submodels:
            above = self.submodels[max(each.parent, MAIN)]
            if above.number > MAIN and not (within_pieces and above.kind == Kind.PIECE):
                outer[each.number] = outer[each.parent]
        return outer

    def arrival(self, n_bricks: int, *, within_pieces: bool = False) -> NDArray[np.int32]:
        """Return the step in which each brick comes to the main model, (n_bricks,).

        Of a brick that is placed there it is the step of that; of one in a
        submodel the step in which that is put on, ``NOBODY`` if it never is. With
        ``within_pieces``, the step in which it comes to its piece.
        """
        moves = self.moves
        joins = moves.action == Action.JOIN
        joined = np.full(len(self.submodels), NOBODY, dtype=np.int32)
        joined[moves.submodel[joins]] = moves.step[joins]
        owner, placed = self.submodel_of(n_bricks), moves.step_of(n_bricks)
        large = np.array(
            [each.kind == Kind.MAIN or (within_pieces and each.kind == Kind.PIECE) for each in self.submodels]
        )
        outer = self.outermost(within_pieces=within_pieces)
        return np.where(large[owner], placed, joined[outer[owner]]).astype(np.int32)

    def _step(self, rows: Ints) -> Step:
        moves = self.moves
        action = moves.action[rows]
        joins = rows[action == Action.JOIN]
        bricks = moves.brick[rows[action != Action.JOIN]].astype(np.int64)
        found = Action.JOIN if not len(bricks) else Action(int(action[action != Action.JOIN][0]))
        # a join is done where the joined one belongs
        where = {self.submodels[each].parent for each in moves.submodel[joins].tolist()}
        where.update(moves.submodel[rows[action != Action.JOIN]].tolist())
        joined = tuple(moves.submodel[joins].tolist())
        made = tuple(each for each in joined if each in where)
        where.difference_update(made)
        return Step(
            number=int(moves.step[rows[0]]),
            submodel=min(where),
            action=found,
            bricks=bricks,
            joined=joined,
            pressed=bool(moves.pressed[rows].any()),
            times=len(where),
            made=made,
        )
