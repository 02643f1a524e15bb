"""What a builder does in one picture: a few parts near each other, of few kinds, mirrored halves together.

Steps grow one after the other, from the lowest part that could be next: the
nearest of the same kind and level join it, until the picture is full. What is
mirrored comes in the same step or in the next one. In the end what is left alone
moves into other steps that it may belong to.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..model import NOBODY, Rows, stacked
from ..progress import Progress, silent
from .blocking import of_nodes

FEW: Final = 5
"""Bricks of a step at least, where it can be chosen."""

MANY: Final = 10
"""Bricks of a step at most, where it can be chosen."""

MOST: Final = 12
"""Bricks of a step at most, but of a sub-assembly that is larger by itself."""

TILE_MOST: Final = 16
"""Bricks of a step in a mosaic at most."""

REACH: Final = 16
"""Studs that a step spans at most, and the side of a mosaic's tiles."""

LOTS: Final = 6
"""Different parts and colours in a step, where it can be chosen."""

LAYER: Final = 3
"""Plates by which the parts of a step differ in height, where it can be chosen."""

NEW_LOT: Final = 3.0
"""Studs of way that are gone for a part of a kind that the step has already."""

HIGHER: Final = 1.5
"""Studs of way that are gone for a part a plate lower."""

ASIDE: Final = 5.0
"""Studs from which on what is left belongs to another step, if this one has parts enough."""


@dataclass(frozen=True, slots=True, eq=False)
class Items:
    """What is put on: bricks and sub-assemblies, n of them.

    Attributes
    ----------
    box : (n, 4) int64 array
        First and last stud square in x, then in y.
    level : (n,) int64 array
        Lowest plate.
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
    size: Ints
    lot: Ints
    temporary: Mask
    image: Ints
    tile: Ints

    def __len__(self) -> int:
        """Return the number of items."""
        return len(self.level)

    @property
    def most(self) -> int:
        """Bricks of a step at most."""
        return TILE_MOST if self.tile.any() else MOST


def group(items: Items, before: Rows, *, progress: Progress = silent) -> list[list[int]]:
    """Put items into steps.

    Parameters
    ----------
    items : Items
    before : (m, 2) int32 array
        Items of which the first must be in place before the second.
    progress : Progress, optional
        Told how many are in steps, in between.

    Returns
    -------
    list of list of int
        The items of each step, in the order in which they are put on.
    """
    return _Grouping(items, before).steps(progress) if len(items) else []


def span(boxes: Ints) -> int:
    """Return how many studs some boxes reach over, in x or in y."""
    return int(max(boxes[:, 1].max() - boxes[:, 0].min(), boxes[:, 3].max() - boxes[:, 2].min())) + 1


class _Grouping:
    """Atoms, which are items or two mirrored ones, on their way into steps."""

    def __init__(self, items: Items, before: Rows) -> None:
        self.items = items
        self.atom = _atoms(items)
        n = self.n = int(self.atom.max()) + 1
        first = np.unique(self.atom, return_index=True)[1]
        self.members: list[list[int]] = [[] for _ in range(n)]
        for item, atom in enumerate(self.atom.tolist()):
            self.members[atom].append(item)
        self.box = items.box[first].copy()
        for column, best in enumerate((np.minimum, np.maximum) * 2):
            best.at(self.box[:, column], self.atom, items.box[:, column])
        self.middle = (self.box[:, ::2] + self.box[:, 1::2] + 1) / 2
        self.level, self.lot = items.level[first], items.lot[first]
        self.temporary, self.tile = items.temporary[first], items.tile[first]
        self.size = np.bincount(self.atom, items.size).astype(np.int64)
        image = items.image[first]
        self.image = np.where(image == NOBODY, NOBODY, self.atom[image])
        self.image[self.image == np.arange(n)] = NOBODY
        edges = of_nodes(before, self.atom, n)
        self.below, self.above = stacked(edges, n)
        self.left = np.bincount(edges[:, 1], minlength=n)
        self.ready, self.done = self.left == 0, np.zeros(n, dtype=bool)
        self.found: list[list[int]] = []
        self.last: Floats | None = None

    def steps(self, progress: Progress) -> list[list[int]]:
        """Return the items of each step."""
        n_done = 0
        while n_done < self.n:
            progress("supports", n_done / self.n)
            step = self._step([self._seed()])
            n_done += len(step)
            other = self._mirrored(step)
            n_done += len(other)
        found = _tidy(self)
        return [[item for atom in step for item in self.members[atom]] for step in found]

    def _seed(self) -> int:
        """Return what comes first: the lowest, supports before the rest, near where the builder is."""
        ready = np.flatnonzero(self.ready & ~self.done)
        if not len(ready):
            # what is in the other's way cannot be helped: the check of the order tells of it
            ready = np.flatnonzero(~self.done)
            ready = ready[self.level[ready] == self.level[ready].min()][:1]
        way = np.zeros(len(ready)) if self.last is None else np.abs(self.middle[ready] - self.last).max(axis=1)
        order = np.lexsort(
            (
                ready,
                self.middle[ready, 0] + self.middle[ready, 1],
                way,
                self.tile[ready],
                ~self.temporary[ready],
                self.level[ready],
            )
        )
        return int(ready[order[0]])

    def _step(self, begun: list[int]) -> list[int]:
        """Fill a step that is begun with what fits to it."""
        step: list[int] = []
        near = np.full(self.n, np.inf)
        for atom in begun:
            self._take(atom, step, near)
        while (best := self._best(step, near)) is not None:
            self._take(best, step, near)
        self._close(step)
        return step

    def _close(self, step: list[int]) -> None:
        self.found.append(step)
        self.last = self.middle[step].mean(axis=0)

    def _take(self, atom: int, step: list[int], near: Floats) -> None:
        step.append(atom)
        self.done[atom] = True
        for other in self.above[atom]:
            self.left[other] -= 1
            self.ready[other] = self.left[other] == 0
        np.minimum(near, self._way(atom), out=near)

    def _way(self, atom: int) -> Floats:
        """Return how far all others lie from one, in studs between their boxes."""
        x0, x1, y0, y1 = self.box[atom].tolist()
        gap_x = np.maximum(self.box[:, 0] - x1, x0 - self.box[:, 1])
        gap_y = np.maximum(self.box[:, 2] - y1, y0 - self.box[:, 3])
        way: Floats = np.maximum(np.maximum(gap_x, gap_y) - 1, 0).astype(np.float64)
        return way

    def _best(self, step: list[int], near: Floats) -> int | None:
        """Return what fits best to a step, if it shall go on."""
        size, most = int(self.size[step].sum()), self.items.most
        if size >= (most if self.tile[step[0]] else MANY):
            return None
        ready = np.flatnonzero(self.ready & ~self.done)
        fits = self._fitting(step, ready, most - size)
        lots = set(self.lot[step].tolist())
        new = ~np.isin(self.lot[ready], list(lots))
        higher = np.abs(self.level[ready] - self.level[step[0]])
        if not self.temporary[step[0]]:
            # one layer after the other, unless there is too little
            fits &= higher <= (LAYER - 1 if size >= FEW else LAYER if size > 1 else 3 * LAYER)
        ready, new, higher = ready[fits], new[fits], higher[fits]
        if not len(ready):
            return None
        cost = near[ready] + NEW_LOT * new + HIGHER * higher * ~self.temporary[ready]
        if size >= FEW:
            cost[(near[ready] > ASIDE) | (new & (len(lots) >= LOTS))] = np.inf
        best = int(np.argmin(cost))
        return int(ready[best]) if np.isfinite(cost[best]) else None

    def _fitting(self, step: list[int], ready: Ints, room: int) -> Mask:
        """Tell which parts a step has room for: of its kind, not too far away, without the mirrored ones."""
        box = self.box[step]
        low_x, high_x = box[:, 0].min(), box[:, 1].max()
        low_y, high_y = box[:, 2].min(), box[:, 3].max()
        wide = np.maximum(self.box[ready, 1], high_x) - np.minimum(self.box[ready, 0], low_x) + 1
        deep = np.maximum(self.box[ready, 3], high_y) - np.minimum(self.box[ready, 2], low_y) + 1
        fits: Mask = (np.maximum(wide, deep) <= REACH) & (self.size[ready] <= room)
        fits &= (self.temporary[ready] == self.temporary[step[0]]) & (self.tile[ready] == self.tile[step[0]])
        return fits & ~np.isin(ready, self.image[step])

    def _mirrored(self, step: list[int]) -> list[int]:
        """Build the image of a step next, as far as it can be built."""
        found: list[int] = []
        near = np.full(self.n, np.inf)
        for image in self.image[step].tolist():
            if image != NOBODY and not self.done[image] and self.ready[image]:
                self._take(image, found, near)
        if not found:
            return found
        while self.size[found].sum() < FEW and (best := self._best(found, near)) is not None:
            self._take(best, found, near)
        self._close(found)
        return found


def _atoms(items: Items) -> Ints:
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


def _tidy(grouping: _Grouping) -> list[list[int]]:
    """Move the parts of steps that are too small into others, where the order lets them."""
    return _Tidying(grouping).steps()


class _Tidying:
    """Steps whose parts may move."""

    def __init__(self, grouping: _Grouping) -> None:
        self.g = grouping
        self.found = [list(step) for step in grouping.found]
        self.step_of = np.zeros(grouping.n, dtype=np.int64)
        for number, step in enumerate(self.found):
            self.step_of[step] = number

    def steps(self) -> list[list[int]]:
        """Return the steps, each in an order in which it can be built."""
        for few in (1, 2, 3):
            for number in range(len(self.found)):
                if 0 < self.g.size[self.found[number]].sum() <= few:
                    self._dissolve(number)
        return [self._in_turn(step) for step in self.found if step]

    def _in_turn(self, step: list[int]) -> list[int]:
        """Return the parts of a step, each after those of them that must be in place before, the lowest first."""
        waiting, found = sorted(step, key=lambda atom: (int(self.g.level[atom]), atom)), []
        while waiting:
            left = set(waiting)
            free = next((atom for atom in waiting if left.isdisjoint(self.g.below[atom])), waiting[0])
            waiting.remove(free)
            found.append(free)
        return found

    def _dissolve(self, number: int) -> None:
        """Move all parts of a step into others, or none."""
        moved: list[int] = []
        for atom in list(self.found[number]):
            target = self._target(atom, number)
            if target is None:
                for each in moved:
                    self._move(each, number)
                return
            self._move(atom, target)
            moved.append(atom)

    def _move(self, atom: int, target: int) -> None:
        self.found[int(self.step_of[atom])].remove(atom)
        self.found[target].append(atom)
        self.step_of[atom] = target

    def _target(self, atom: int, number: int) -> int | None:
        """Return the step nearest in order that a part may move into."""
        g = self.g
        first = max((int(self.step_of[each]) for each in g.below[atom]), default=0)
        last = min((int(self.step_of[each]) for each in g.above[atom]), default=len(self.found) - 1)
        image = int(g.image[atom])
        if image != NOBODY:
            beside = int(self.step_of[image])
            first, last = max(first, beside - 1), min(last, beside + 1)
        for target in sorted(range(first, last + 1), key=lambda each: (abs(each - number), each)):
            step = self.found[target]
            if target != number and step and self._fits(atom, step):
                return target
        return None

    def _fits(self, atom: int, step: list[int]) -> bool:
        g = self.g
        return (
            int(g.size[[*step, atom]].sum()) <= g.items.most
            and span(g.box[[*step, atom]]) <= REACH
            and bool((g.tile[step] == g.tile[atom]).all())
        )
