"""High stacks of single studs, which wobble under a builder's hands: they get wider, or share bricks."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import Final, NamedTuple

import numpy as np

from ..arrays import Ints, Mask
from ..model import NOBODY, SUPPORTS, Assembly
from ..units import PLATES_PER_BRICK
from .boxes import Area, Boxes, boxes_of, cells_of

SLIM: Final = 4 * PLATES_PER_BRICK
"""Plates up to which supports of one stud stand on each other: four bricks."""

_WIDER: Final = ((2, 2), (2, 1), (1, 2))
"""Sizes in studs that take the place of a single stud, the best first."""


class SlimStacks(NamedTuple):
    """Stacks of supports of a single stud that are higher than four bricks.

    Attributes
    ----------
    top : (k,) int64 array
        Row of the highest brick of each.
    height : (k,) int64 array
        In plates.
    """

    top: Ints
    height: Ints


def slim_stacks(assembly: Assembly) -> SlimStacks:
    """Find the stacks of supports of a single stud that are higher than :data:`SLIM`.

    Parameters
    ----------
    assembly : Assembly
        A model with its supports, those that stay and those that do not.

    Returns
    -------
    SlimStacks
        By the rows of their highest bricks.
    """
    bricks, catalogue = assembly.bricks, assembly.catalogue
    single = np.array([part.length == 1 for part in catalogue.parts], dtype=bool)
    rows = np.flatnonzero(np.isin(bricks.role, SUPPORTS) & single[bricks.part])
    boxes = np.column_stack([bricks.corner[rows], np.ones((len(rows), 2)), catalogue.height[bricks.part[rows]]])
    runs = [run for run in _runs(boxes.astype(np.int32)) if _height(boxes[run]) > SLIM]
    found = sorted((int(rows[run[-1]]), _height(boxes[run])) for run in runs)
    top, height = np.array(found, dtype=np.int64).reshape(-1, 2).T
    return SlimStacks(top, height)


def widen(boxes: Boxes, free: Mask, sizes: Collection[tuple[int, int, int]]) -> Boxes:
    """Make stacks of a single stud wider below their highest four bricks, as far as there is room.

    Parameters
    ----------
    boxes : (n, 6) int32 array
        Supports that do not overlap.
    free : (n_z, n_y, n_x) bool array
        Cells in which supports may be.
    sizes : collection of (int, int, int)
        Longer side, shorter side and height of the parts there are.

    Returns
    -------
    (m, 6) int32 array
        Boxes that cover the same cells and more. Stacks side by side share bricks.
    """
    runs = [run for run in _runs(boxes) if _height(boxes[run]) > SLIM]
    if not runs:
        return boxes
    bench = _Bench(boxes, free, sizes)
    for run in runs:
        bench.widen(run)
    return bench.boxes()


def _height(boxes: Boxes) -> int:
    return int(boxes[:, 5].sum())


def _runs(boxes: Boxes) -> Iterator[list[int]]:
    """Yield the rows of boxes of a single stud that stand on each other, from below."""
    single = [row for row, (*_, a, b, _) in enumerate(boxes.tolist()) if a == b == 1]
    ends: dict[tuple[int, int, int], list[int]] = {}
    for row in sorted(single, key=lambda each: int(boxes[each, 2])):
        x, y, z, _, _, height = boxes[row].tolist()
        run = ends.pop((x, y, z), [])
        run.append(row)
        ends[x, y, z + height] = run
    yield from ends.values()


class _Bench:
    """Boxes on their way to wider ones."""

    def __init__(self, boxes: Boxes, free: Mask, sizes: Collection[tuple[int, int, int]]) -> None:
        self.rows = boxes.tolist()
        self.kept = [True] * len(self.rows)
        self.free, self.sizes = free, sizes
        self.owner = np.full(free.shape, NOBODY, dtype=np.int64)
        self.middle = (free.shape[2] / 2, free.shape[1] / 2)
        for row, box in enumerate(self.rows):
            self.owner[cells_in(box)] = row

    def boxes(self) -> Boxes:
        """Return the boxes as they are now."""
        return boxes_of(tuple(row) for row, kept in zip(self.rows, self.kept, strict=True) if kept)

    def widen(self, run: list[int]) -> None:
        """Widen a stack from above."""
        slim, last, foot = 0, None, self._below(run[0])
        for row in reversed(run):
            _, _, _, a, b, height = self.rows[row]
            if not self.kept[row] or max(a, b) > 1:
                slim, last = SLIM, None
                continue
            wide = slim + height > SLIM and height == PLATES_PER_BRICK
            place = self._place(row, last, foot) if wide else None
            if place is None:
                slim += height
                continue
            last = place
            self._put(row, place)

    def _put(self, row: int, place: Area) -> None:
        """Let a box grow, and take in those that lie in its way."""
        box = [*place[:2], self.rows[row][2], *place[2:], PLATES_PER_BRICK]
        for other in np.unique(self.owner[cells_in(box)]).tolist():
            if other != NOBODY:
                self.kept[other] = False
        self.rows[row], self.kept[row] = box, True
        self.owner[cells_in(box)] = row

    def _below(self, row: int) -> Area | None:
        """Return the area of the box on which a box stands."""
        x, y, z = self.rows[row][:3]
        below = int(self.owner[z - 1, y, x]) if z else NOBODY
        if below == NOBODY:
            return None
        at_x, at_y, _, a, b, _ = self.rows[below]
        return at_x, at_y, a, b

    def _place(self, row: int, last: Area | None, foot: Area | None) -> Area | None:
        """Return where a wider box lies best: as that above, wide, for many, on its foot, near the middle."""
        x, y, z = self.rows[row][:3]
        places = [
            (at_x, at_y, a, b)
            for a, b in _WIDER
            for at_x in range(x - a + 1, x + 1)
            for at_y in range(y - b + 1, y + 1)
            if self._fits((at_x, at_y, a, b), z)
        ]
        if last in places:
            return last
        largest = max((a * b for *_, a, b in places), default=0)
        places = [place for place in places if place[2] * place[3] == largest]
        beside = set(cells_of(foot)) if foot else set()

        def worth(place: Area) -> tuple[object, ...]:
            """Return what a better place has less of."""
            on_foot = len(beside.intersection(cells_of(place)))
            return -self._single(place, z), -on_foot, self._off(place), place

        return min(places, key=worth, default=None)

    def _single(self, place: Area, z: int) -> int:
        """Return how many single studs a box takes in."""
        x, y, a, b = place
        return int(np.count_nonzero(self.owner[z, y : y + b, x : x + a] != NOBODY))

    def _off(self, place: Area) -> float:
        """Return how far a place lies from the middle, the same of mirrored ones."""
        return float(sum(abs(place[axis] + place[axis + 2] / 2 - self.middle[axis]) for axis in (0, 1)))

    def _fits(self, place: Area, z: int) -> bool:
        """Whether there is such a part, and room for it beside single studs that it takes in."""
        x, y, a, b = place
        if min(x, y) < 0 or (max(a, b), min(a, b), PLATES_PER_BRICK) not in self.sizes:
            return False
        cells = cells_in([x, y, z, a, b, PLATES_PER_BRICK])
        if self.free[cells].shape != (PLATES_PER_BRICK, b, a) or not self.free[cells].all():
            return False
        inside = set(self.owner[cells].ravel().tolist()) - {NOBODY}
        return all(self.rows[each][2:] == [z, 1, 1, PLATES_PER_BRICK] for each in inside)


def cells_in(box: list[int]) -> tuple[slice, slice, slice]:
    """Return the cells of a box as an index of an array (n_z, n_y, n_x)."""
    x, y, z, a, b, height = box
    return slice(z, z + height), slice(y, y + b), slice(x, x + a)
