"""The table of bricks: one row a brick, one array a column."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Mask

NOBODY: Final = -1
"""Stands for no brick: the owner of an empty cell, or the brick of a move that joins a whole piece."""


class Role(IntEnum):
    """The purpose of a brick or cell; the scene can show each role by itself.

    Supports outside are removed when the model is built. Those inside stay, and so do those outside without which a
    part of the model would fall.
    """

    SHELL = 0
    INSIDE = 1
    PLATE = 2
    OFFSET = 3
    SUPPORT_OUTSIDE = 4
    SUPPORT_INSIDE = 5
    SUPPORT_KEPT = 6


SUPPORTS: Final = (Role.SUPPORT_OUTSIDE, Role.SUPPORT_INSIDE, Role.SUPPORT_KEPT)
"""Roles of supports."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class _Apart:
    """What tables may know besides their columns."""

    half: NDArray[np.uint8] | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Bricks(_Apart):
    """A table of bricks, one row each, on the grid of a :class:`UnitGrid`.

    Attributes
    ----------
    part : (n,) int16 array
        Row of the part in the catalogue.
    corner : (n, 3) int32 array
        Lowest corner of the brick's bounding box: x and y in studs, z in plates.
    turn : (n,) uint8 array
        Quarter turns, counter-clockwise as seen from above. At 0 the long side
        lies along x and the arms of a corner part along +x and +y.
    colour : (n,) int16 array
        LDraw colour code.
    role : (n,) uint8 array
        ``Role``.
    piece : (n,) int16 array
        Number of the split piece, 0 for a model in one piece.
    step : (n,) int32 array
        Building step, from 0.
    half : (n, 2) uint8 array, optional
        Half studs, 0 or 1, by which the brick lies beyond its corner along x and y, on jumpers. Without it the bricks
        lie on one grid, or they are drawn together onto one while they are laid (see ``half_studs``).
    """

    part: NDArray[np.int16]
    corner: NDArray[np.int32]
    turn: NDArray[np.uint8]
    colour: NDArray[np.int16]
    role: NDArray[np.uint8]
    piece: NDArray[np.int16]
    step: NDArray[np.int32]

    def __len__(self) -> int:
        """Return the number of bricks."""
        return len(self.part)

    def take(self, rows: NDArray[np.integer] | Mask) -> Bricks:
        """Return the given rows as a table of their own."""
        columns = {name: getattr(self, name)[rows] for name in self.__slots__}
        return Bricks(**columns, half=None if self.half is None else self.half[rows])

    @property
    def shift(self) -> NDArray[np.float64]:
        """Studs by which each brick lies beyond its corner, x, y and z, (n, 3): 0 or a half along x and y."""
        moved = np.zeros((len(self), 3))
        if self.half is not None:
            moved[:, :2] = self.half / 2
        return moved

    @property
    def halved(self) -> bool:
        """Whether any brick lies half a stud beyond its corner."""
        return self.half is not None and bool(self.half.any())


def concatenate(tables: Sequence[Bricks]) -> Bricks:
    """Concatenate tables, at least one; if any knows half studs, those of the others are 0."""
    half = None
    if any(each.half is not None for each in tables):
        half = np.concatenate([_halves(each) for each in tables])
    return Bricks(
        **{name: np.concatenate([getattr(each, name) for each in tables]) for name in Bricks.__slots__}, half=half
    )


def _halves(bricks: Bricks) -> NDArray[np.uint8]:
    return np.zeros((len(bricks), 2), np.uint8) if bricks.half is None else bricks.half
