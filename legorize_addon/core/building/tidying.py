"""Steps that are too small are given up: what they put on moves into others, where the order lets it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..model import NOBODY
from .items import REACH, Atoms, in_turn, span


class Tidying:
    """Steps whose parts may move."""

    def __init__(self, atoms: Atoms, found: Sequence[Sequence[int]]) -> None:
        """Begin with the steps as they were found."""
        self.g = atoms
        self.found = [list(step) for step in found]
        self.step_of = np.zeros(len(atoms), dtype=np.int64)
        for number, step in enumerate(self.found):
            self.step_of[step] = number

    def steps(self) -> list[list[int]]:
        """Return the steps, each in an order in which it can be built."""
        for few in (1, 2, 3):
            for number in range(len(self.found)):
                if 0 < self.g.size[self.found[number]].sum() <= few:
                    self._dissolve(number)
        for number in range(len(self.found)):
            self._pair(number)
        for number in range(len(self.found)):
            self._accompany(number)
        return [in_turn(step, self.g.below, self.g.box, self.g.level) for step in self.found if step]

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

    def _pair(self, number: int) -> None:
        """Let a brick that is left alone join its image, if that is alone as well, however far away it is."""
        if len(self.found[number]) != 1:
            return
        [atom] = self.found[number]
        image = int(self.g.image[atom])
        if image == NOBODY or self.g.size[[atom, image]].max() > 1 or self.found[self.step_of[image]] != [image]:
            return
        first, last = self._bounds(atom)
        if first <= self.step_of[image] <= last and self.g.tile[atom] == self.g.tile[image]:
            self._move(atom, int(self.step_of[image]))

    def _accompany(self, number: int) -> None:
        """Let a part come from the nearest step that has enough to a brick that is still alone."""
        if self.g.size[self.found[number]].sum() != 1:
            return
        [alone] = self.found[number]
        for source in sorted(range(len(self.found)), key=lambda each: (abs(each - number), each)):
            for atom in self.found[source] if source != number else ():
                left = self.g.size[self.found[source]].sum() - self.g.size[atom]
                if left > 1 and number in self._beside_image(atom) and self._fits(atom, [alone]):
                    self._move(atom, number)
                    return

    def _bounds(self, atom: int) -> tuple[int, int]:
        """Return the first and the last step that a part may be in."""
        g = self.g
        first = max((int(self.step_of[each]) for each in g.below[atom]), default=0)
        last = min((int(self.step_of[each]) for each in g.above[atom]), default=len(self.found) - 1)
        return first, last

    def _beside_image(self, atom: int) -> range:
        """Return the steps that a part may be in, beside that of its image."""
        first, last = self._bounds(atom)
        image = int(self.g.image[atom])
        if image != NOBODY:
            beside = int(self.step_of[image])
            first, last = max(first, beside - 1), min(last, beside + 1)
        return range(first, last + 1)

    def _move(self, atom: int, target: int) -> None:
        self.found[int(self.step_of[atom])].remove(atom)
        self.found[target].append(atom)
        self.step_of[atom] = target

    def _target(self, atom: int, number: int) -> int | None:
        """Return the step nearest in order that a part may move into."""
        for target in sorted(self._beside_image(atom), key=lambda each: (abs(each - number), each)):
            step = self.found[target]
            if target != number and step and self._fits(atom, step):
                return target
        return None

    def _fits(self, atom: int, step: list[int]) -> bool:
        g = self.g
        return (
            int(g.size[[*step, atom]].sum()) <= g.most
            and span(g.box[[*step, atom]]) <= REACH
            and bool((g.tile[step] == g.tile[atom]).all())
        )
