"""What a builder does in one picture: a few parts near each other, of few kinds, mirrored halves together.

Steps grow one after the other, from the lowest part that could be next: the
nearest of the same kind and level join it, until the picture is full. What is
mirrored comes in the same step or in the next one. In the end what is left alone
moves into other steps that it may belong to.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..model import NOBODY, Rows
from ..progress import Progress, silent
from .items import REACH, Atoms, Items, span
from .tidying import Tidying

FEW: Final = 5
"""Bricks of a step at least, where it can be chosen."""

MANY: Final = 10
"""Bricks of a step at most, where it can be chosen."""

LOTS: Final = 6
"""Different parts and colours in a step, where it can be chosen."""

LAYER: Final = 3
"""Plates by which the parts of a step differ in height, where it can be chosen."""

SOON: Final = 6
"""Plates ahead for which supports are built together with those that are wanted now."""

NEW_LOT: Final = 3.0
"""Studs of way that are gone for a part of a kind that the step has already."""

HIGHER: Final = 1.5
"""Studs of way that are gone for a part a plate lower."""

WAITS: Final = 6.0
"""Studs of way that are gone for a part whose image can be built as well."""

ASIDE: Final = 5.0
"""Studs from which on what is left belongs to another step, if this one has parts enough."""


_FAR: Final = 2**31
"""A stud square beyond all others."""


def group(items: Items, before: Rows, *, copies: int = 1, progress: Progress = silent) -> list[list[int]]:
    """Put items into steps.

    Parameters
    ----------
    items : Items
    before : (m, 2) int32 array
        Items of which the first must be in place before the second.
    copies : int, optional
        How many of all this are built at once: steps have room for as many of each brick.
    progress : Progress, optional
        Told how many are in steps, in between.

    Returns
    -------
    list of list of int
        The items of each step, in the order in which they are put on.
    """
    return _Grouping(Atoms(items, before, copies), MANY // copies).steps(progress) if len(items) else []


class _Grouping:
    """Atoms on their way into steps."""

    def __init__(self, atoms: Atoms, many: int) -> None:
        self.atoms, self.n, self.many = atoms, len(atoms), many
        self.box, self.level, self.lot, self.size = atoms.box, atoms.level, atoms.lot, atoms.size
        self.temporary, self.tile, self.image = atoms.temporary, atoms.tile, atoms.image
        # twice the middle: places are only compared
        self.middle = self.box[:, ::2] + self.box[:, 1::2]
        self.left = np.array([len(below) for below in atoms.below])
        self.ready, self.done = self.left == 0, np.zeros(self.n, dtype=bool)
        self.found: list[list[int]] = []
        self.last: Floats | None = None

    def steps(self, progress: Progress) -> list[list[int]]:
        """Return the items of each step."""
        n_done = 0
        while n_done < self.n:
            progress("supports", n_done / self.n)
            step = self._filled([self._seed()], self.many)
            n_done += len(step) + len(self._mirrored(step))
        found = Tidying(self.atoms, self.found).steps()
        return [[item for atom in step for item in self.atoms.members[atom]] for step in found]

    def _seed(self) -> int:
        """Return what comes first: the lowest, or what bears it, supports first, not before its image can come."""
        ready = np.flatnonzero(self.ready)
        if not len(ready):
            # what is in the other's way cannot be helped: the check of the order tells of it
            ready = np.flatnonzero(~self.done)
            ready = ready[self.level[ready] == self.level[ready].min()][:1]
        due = self.atoms.due[ready]
        ready = ready[due == due.min()]
        way = np.zeros(len(ready)) if self.last is None else np.abs(self.middle[ready] - self.last).max(axis=1)
        corner = self.middle[ready].sum(axis=1)
        keys = (ready, corner, way, self._waits(ready), self.tile[ready], ~self.temporary[ready])
        return int(ready[np.lexsort(keys)[0]])

    def _waits(self, ready: Ints, step: _Begun | None = None) -> Mask:
        """Tell which atoms have an image that cannot be built yet, nor right after the images of a step."""
        image = self.image[ready]
        waits: Mask = (image != NOBODY) & ~self.ready[image] & ~self.done[image]
        if step is not None:
            for turn in np.flatnonzero(waits).tolist():
                below = self.atoms.below[int(image[turn])]
                waits[turn] = not all(self.done[each] or step.mirrored[each] for each in below)
        return waits

    def _filled(self, begun: list[int], enough: int, *, unpaired: bool = False) -> list[int]:
        """Fill a step that is begun with what fits to it, up to some bricks; if asked for, without images elsewhere."""
        step = _Begun(self.atoms)
        for atom in begun:
            self._take(atom, step)
        enough = self.atoms.most if step.tile else enough
        while step.size < enough and (best := self._best(step, unpaired=unpaired)) is not None:
            self._take(best, step)
        self.found.append(step.taken)
        self.last = self.middle[step.taken].mean(axis=0)
        return step.taken

    def _take(self, atom: int, step: _Begun) -> None:
        step.take(atom)
        self.done[atom], self.ready[atom] = True, False
        for other in self.atoms.above[atom]:
            self.left[other] -= 1
            self.ready[other] = self.left[other] == 0 and not self.done[other]

    def _best(self, step: _Begun, *, unpaired: bool) -> int | None:
        """Return what fits best to a step, if it shall go on."""
        ready = np.flatnonzero(self.ready & (self.image == NOBODY) if unpaired else self.ready)
        ready = ready[step.fits(ready)]
        waits = self._waits(ready, step)
        higher = np.abs(self.level[ready] - step.level)
        if step.temporary:
            soon = self.atoms.due[ready] <= step.due + SOON
            ready, higher, waits = ready[soon], higher[soon], waits[soon]
        else:
            # one layer after the other, unless there is too little
            most = LAYER - 1 if step.size >= FEW else 2 * LAYER if step.size > 1 else 3 * LAYER
            near_enough = higher <= most
            ready, higher, waits = ready[near_enough], higher[near_enough], waits[near_enough]
        if not len(ready):
            return None
        new, near = ~step.has_lot[self.lot[ready]], step.near[ready]
        cost = near + NEW_LOT * new + HIGHER * (0 if step.temporary else 1) * higher + WAITS * waits
        if step.size >= FEW:
            cost[(near > ASIDE) | (new & (step.n_lots >= LOTS)) | waits] = np.inf
        best = int(np.argmin(cost))
        return int(ready[best]) if np.isfinite(cost[best]) else None

    def _mirrored(self, step: list[int]) -> list[int]:
        """Build the image of a step next, as far as it can be built."""
        found: list[int] = []
        for image in self.image[step].tolist():
            # what rests on images of the same step can follow them
            if image != NOBODY and not self.done[image]:
                below = [each for each in self.atoms.below[image] if not self.done[each]]
                if set(below) <= set(found) and self._has_room([*found, image]):
                    found.append(image)
        return self._filled(found, FEW, unpaired=True) if found else found

    def _has_room(self, step: list[int]) -> bool:
        """Whether a step may hold some atoms: images need not have as many bricks."""
        return int(self.size[step].sum()) <= self.atoms.most and span(self.box[step]) <= REACH


class _Begun:
    """A step on its way."""

    def __init__(self, atoms: Atoms) -> None:
        self.atoms = atoms
        self.taken: list[int] = []
        self.size = self.n_lots = self.level = self.due = self.tile = 0
        self.temporary = False
        self.near = np.full(len(atoms), _FAR, dtype=np.int64)
        self.has_lot = np.zeros(int(atoms.lot.max()) + 1, dtype=bool)
        self.mirrored = np.zeros(len(atoms) + 1, dtype=bool)
        self.low, self.high = (_FAR, _FAR), (-_FAR, -_FAR)

    def take(self, atom: int) -> None:
        """Put an atom into the step."""
        atoms = self.atoms
        if not self.taken:
            self.level, self.tile = int(atoms.level[atom]), int(atoms.tile[atom])
            self.temporary, self.due = bool(atoms.temporary[atom]), int(atoms.due[atom])
        self.taken.append(atom)
        self.size += int(atoms.size[atom])
        self.n_lots += not self.has_lot[atoms.lot[atom]]
        self.has_lot[atoms.lot[atom]] = True
        # the last place is that of nobody
        self.mirrored[atoms.image[atom]] = True
        x0, x1, y0, y1 = atoms.box[atom].tolist()
        self.low = min(self.low[0], x0), min(self.low[1], y0)
        self.high = max(self.high[0], x1), max(self.high[1], y1)
        left, right, front, back = atoms.sides
        gap = np.maximum(left - x1, x0 - right)
        for other in (front - y1, y0 - back):
            np.maximum(gap, other, out=gap)
        gap -= 1
        np.minimum(self.near, np.maximum(gap, 0, out=gap), out=self.near)

    def fits(self, ready: Ints) -> Mask:
        """Tell which atoms the step has room for: of its kind, not too far away, without the mirrored ones."""
        atoms = self.atoms
        left, right, front, back = atoms.sides.take(ready, axis=1)
        fits: Mask = np.maximum(right, self.high[0]) - np.minimum(left, self.low[0]) < REACH
        fits &= np.maximum(back, self.high[1]) - np.minimum(front, self.low[1]) < REACH
        fits &= (atoms.size[ready] <= atoms.most - self.size) & ~self.mirrored[ready]
        fits &= (atoms.temporary[ready] == self.temporary) & (atoms.tile[ready] == self.tile)
        return fits
