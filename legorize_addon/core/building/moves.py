"""The moves by which a model is built, one after the other."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from ..model import NOBODY


class Action(IntEnum):
    """What a move does."""

    PLACE = 0
    """A brick is pushed onto what lies below it, or pressed from below under what holds above it."""

    REMOVE = 1
    """A brick of a support is taken out."""

    JOIN = 2
    """A piece or sub-assembly that was built on the table by itself is put onto what it belongs to."""


@dataclass(frozen=True, slots=True, eq=False)
class Moves:
    """All moves of a model, in order.

    Attributes
    ----------
    action : (n_moves,) uint8 array
        ``Action``.
    brick : (n_moves,) int32 array
        Row of the brick in the table of model and supports, ``NOBODY`` of a join.
    piece : (n_moves,) int16 array
        Piece that the move belongs to.
    submodel : (n_moves,) int32 array
        Number of the submodel that a brick is placed into or taken from, or that
        is joined.
    pressed : (n_moves,) bool array
        Whether a brick is pressed from below.
    step : (n_moves,) int32 array
        Building step, from 0: moves that a builder sees in one picture.
    """

    action: NDArray[np.uint8]
    brick: NDArray[np.int32]
    piece: NDArray[np.int16]
    submodel: NDArray[np.int32]
    pressed: NDArray[np.bool_]
    step: NDArray[np.int32]

    def __len__(self) -> int:
        """Return the number of moves."""
        return len(self.action)

    def step_of(self, n_bricks: int) -> NDArray[np.int32]:
        """Return the step in which each brick is placed, (n_bricks,), ``NOBODY`` if it never is."""
        step = np.full(n_bricks, NOBODY, dtype=np.int32)
        placed = self.action == Action.PLACE
        step[self.brick[placed]] = self.step[placed]
        return step
