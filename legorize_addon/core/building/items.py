"""What is put on in a step: bricks and sub-assemblies, and how many of them a picture has room for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Ints, Mask
from ..model import NOBODY, Rows, stacked
from .blocking import of_nodes

MOST: Final = 12
"""Bricks of a step at most, but of a sub-assembly that is larger by itself."""

SMALL: Final = 4
"""Bricks of a sub-assembly at most that is built in the step that puts it on: fewer than a step of its own is worth."""

TILE_MOST: Final = 16
"""Bricks of a step in a mosaic at most."""

REACH: Final = 16
"""Studs that a step spans at most, and the side of a mosaic's tiles."""


@dataclass(frozen=True, slots=True, eq=False)
class Items:
    """What is put on: bricks and sub-assemblies, n of them.

    Attributes
    ----------
    box : (n, 4) int64 array
        First and last stud square in x, then in y.
    level : (n,) int64 array
        Lowest plate.
    due : (n,) int64 array
        Level that is built when an item is wanted: its own of a brick, of a
        support that of the first brick on it.
    size : (n,) int64 array
        Number of bricks.
    lot : (n,) int64 array
        Number of the part and colour, or of the sub-assemblies that are equal.
    temporary : (n,) bool array
        Supports that are taken out again.
    image : (n,) int64 array
        The mirrored one, ``NOBODY`` if there is none.
    tile : (n,) int64 array
        Number of the tile of a mosaic, 0 everywhere else.
    """

    box: Ints
    level: Ints
    due: Ints
    size: Ints
    lot: Ints
    temporary: Mask
    image: Ints
    tile: Ints

    def __len__(self) -> int:
        """Return the number of items."""
        return len(self.level)


def in_turn(step: Sequence[int], below: Sequence[Sequence[int]], box: Ints, level: Ints) -> list[int]:
    """Return the parts of a step, each after those of them that must be in place before, the lowest first.

    Parameters
    ----------
    step : sequence of int
        The parts.
    below : sequence of sequences of int
        What must be in place before each part.
    box, level : arrays
        Of all parts, as in :class:`Items`.

    Returns
    -------
    list of int
        Equal steps at different places give the same order.
    """
    waiting = sorted(step, key=lambda part: (int(level[part]), box[part].tolist()))
    found: list[int] = []
    while waiting:
        left = set(waiting)
        free = next((part for part in waiting if left.isdisjoint(below[part])), waiting[0])
        waiting.remove(free)
        found.append(free)
    return found


def span(boxes: Ints) -> int:
    """Return how many studs some boxes reach over, in x or in y."""
    return int(max(boxes[:, 1].max() - boxes[:, 0].min(), boxes[:, 3].max() - boxes[:, 2].min())) + 1


class Atoms:
    """What is never torn apart: items, or two mirrored ones of one level that lie in one picture.

    Attributes
    ----------
    members : list of list of int
        Items of each atom.
    box, level, due, size, lot, temporary, image, tile : arrays
        As of :class:`Items`; ``image`` is ``NOBODY`` where both halves are in the atom.
    sides : (4, n) int64 array
        The boxes, by side.
    below, above : list of list of int
        Atoms that must come before each one, and after it.
    most : int
        Bricks of a step at most.
    """

    def __init__(self, items: Items, before: Rows, copies: int = 1) -> None:
        """Make the atoms of items that follow each other in some order, of which some copies are built at once."""
        atom = _numbers(items)
        first = np.unique(atom, return_index=True)[1]
        self.members: list[list[int]] = [[] for _ in first]
        for item, number in enumerate(atom.tolist()):
            self.members[number].append(item)
        self.box = items.box[first].copy()
        for column, best in enumerate((np.minimum, np.maximum) * 2):
            best.at(self.box[:, column], atom, items.box[:, column])
        # one side of all after the other: distances from all of them are found in every turn
        self.sides = np.ascontiguousarray(self.box.T)
        self.level, self.due = items.level[first], items.due[first]
        self.lot: Ints = np.unique(items.lot, return_inverse=True)[1].reshape(-1)[first]
        self.temporary, self.tile = items.temporary[first], items.tile[first]
        self.size = np.bincount(atom, items.size).astype(np.int64)
        image = items.image[first]
        image = np.where(image == NOBODY, NOBODY, atom[image])
        self.image = np.where(image == np.arange(len(first)), NOBODY, image)
        edges = of_nodes(before, atom, len(first))
        self.below, self.above = stacked(edges, len(first))
        self.most = (TILE_MOST if items.tile.any() else MOST) // copies

    def __len__(self) -> int:
        """Return the number of atoms."""
        return len(self.level)


def _numbers(items: Items) -> Ints:
    """Return numbers of the items, two mirrored ones of one level that lie in one picture by the same number."""
    atom = np.arange(len(items))
    other = items.image
    pairs = np.flatnonzero((other != NOBODY) & (other > atom))
    both = np.concatenate([items.box[pairs], items.box[other[pairs]]], axis=1)
    wide = both[:, [1, 5]].max(axis=1) - both[:, [0, 4]].min(axis=1) + 1
    deep = both[:, [3, 7]].max(axis=1) - both[:, [2, 6]].min(axis=1) + 1
    close = (np.maximum(wide, deep) <= REACH) & (items.level[pairs] == items.level[other[pairs]])
    close &= (
        (items.size[pairs] == 1) & (items.size[other[pairs]] == 1) & (items.tile[pairs] == items.tile[other[pairs]])
    )
    pairs = pairs[close]
    atom[other[pairs]] = atom[pairs]
    numbers: Ints = np.unique(atom, return_inverse=True)[1].reshape(-1).astype(np.int64)
    return numbers
