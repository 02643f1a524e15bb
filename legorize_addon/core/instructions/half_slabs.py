"""Pictures of bricks half a stud off the others: drawn by themselves, slab over slab, each moved to its place.

The lattice of :mod:`.lattice` has no place for half a stud. But what lies above a plane is before all that lies below
it, wherever one looks from above, and behind it from below. So the bricks between two planes are drawn as if they were
alone, from the farthest slab to the nearest.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..arrays import Floats, Ints
from ..model import Bricks
from .lattice import Sight, View, look
from .picture import ACROSS, DOWN


class Slab(NamedTuple):
    """What is seen of the bricks between two planes, and how far to move it, in units of pictures."""

    sight: Sight
    by: Floats


def slabs_of(sight: Sight) -> Iterator[Slab]:
    """Yield the slabs of what is seen, from the farthest to the nearest; all at once where nothing is off by half."""
    cells = sight.cells
    if cells is None or cells.model is None or not cells.model.bricks.halved:
        yield Slab(sight, np.zeros(2))
        return
    bricks, view = cells.model.bricks, cells.model.view
    number = slab_numbers(bricks)
    there = np.unique(number[cells.brick])
    for each in there[::-1] if view.below else there:
        mine = number[cells.brick] == each
        half = bricks.shift[cells.brick[mine][0], :2]
        yield Slab(look(cells.take(mine), len(bricks)), moved_by(half, view))


def slab_numbers(bricks: Bricks) -> Ints:
    """Return the number of the slab of each brick, from below: a new one begins where the half studs change."""
    half = bricks.shift[:, :2]
    order = np.lexsort((half[:, 1], half[:, 0], bricks.corner[:, 2]))
    changes = (np.diff(half[order], axis=0, prepend=half[order[:1]]) != 0).any(axis=1)
    number = np.empty(len(bricks), np.int64)
    number[order] = np.cumsum(changes)
    return number


def moved_by(half: Floats, view: View) -> Floats:
    """Return how far studs along x and y go in a picture, to the right and downwards."""
    x, y = half.tolist()
    for _ in range(view.turns % 4):
        x, y = -y, x
    if view.below:
        x, y = y, x
    return np.array([3 * ACROSS * (y - x), 3 * DOWN * (x + y)])
