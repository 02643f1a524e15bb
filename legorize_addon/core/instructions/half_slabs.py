"""Pictures of bricks half a stud off the others: drawn by themselves, slab over slab, each moved to its place.

The lattice of :mod:`.lattice` has no place for half a stud. But what lies above a layer is before all that lies in it,
wherever one looks from above, and behind it from below; and in one layer, regions of different half studs keep a column
apart. So bricks of the same half studs are drawn as if they were alone, from the farthest slab to the nearest.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
from scipy import ndimage

from ..arrays import Floats, Ints
from ..units import PLATES_PER_BRICK
from .lattice import Cells, Sight, View, look
from .picture import ACROSS, DOWN

_NEAR: Final = 3
"""Studs between regions of a layer within which one can hide the other: a layer is 1.2 studs high."""


class Slab(NamedTuple):
    """What is seen of bricks with the same half studs, and how far to move it, in units of pictures."""

    sight: Sight
    by: Floats


def slabs_of(sight: Sight) -> Iterator[Slab]:
    """Yield the slabs of what is seen, from the farthest to the nearest; all at once where nothing is off by half."""
    cells = sight.cells
    if cells is None or cells.model is None or not cells.model.bricks.halved:
        yield Slab(sight, np.zeros(2))
        return
    bricks, view = cells.model.bricks, cells.model.view
    number = slab_numbers(cells)
    for each in np.unique(number).tolist():
        mine = number == each
        half = bricks.shift[cells.brick[mine][0], :2]
        yield Slab(look(cells.take(mine), len(bricks)), moved_by(half, view))


def slab_numbers(cells: Cells) -> Ints:
    """Return the number of the slab of each cell, from the farthest: a new one begins where the half studs change."""
    assert cells.model is not None
    bricks, view = cells.model.bricks, cells.model.view
    kind = (bricks.shift[:, :2] @ (2, 4)).astype(np.int64)[cells.brick]
    layer = bricks.corner[cells.brick, 2].astype(np.int64) // PLATES_PER_BRICK * (-1 if view.below else 1)
    depth = np.zeros(len(kind))
    for each in np.unique(layer).tolist():
        mine = np.flatnonzero(layer == each)
        if (kind[mine] != kind[mine[0]]).any():
            depth[mine] = _depths(cells.place[mine, :2], kind[mine])
    order = np.lexsort((kind, depth, layer))
    number = np.empty(len(kind), np.int64)
    number[order] = np.cumsum(np.diff(kind[order], prepend=kind[order[:1]]) != 0)
    return number


def _depths(place: Ints, kind: Ints) -> Floats:
    """Return how near what hangs together in a layer is to the viewer, where it is near others; of each cell, (n,)."""
    x, y = (place - place.min(axis=0) + _NEAR).T
    shape = (int(y.max()) + _NEAR + 1, int(x.max()) + _NEAR + 1)
    depth = np.zeros(len(kind))
    for each in np.unique(kind).tolist():
        mine, others = np.zeros((2, *shape), bool)
        mine[y[kind == each], x[kind == each]] = True
        others[y[kind != each], x[kind != each]] = True
        label, n = ndimage.label(mine, np.ones((3, 3)))
        near = ndimage.distance_transform_cdt(~others, "chessboard") <= _NEAR
        for island in range(1, n + 1):
            there = label == island
            at = np.argwhere(there & near if (there & near).any() else there)
            depth[(kind == each) & there[y, x]] = at.sum(axis=1).mean()
    return depth


def moved_by(half: Floats, view: View) -> Floats:
    """Return how far studs along x and y go in a picture, to the right and downwards."""
    x, y = half.tolist()
    for _ in range(view.turns % 4):
        x, y = -y, x
    if view.below:
        x, y = y, x
    return np.array([3 * ACROSS * (y - x), 3 * DOWN * (x + y)])
