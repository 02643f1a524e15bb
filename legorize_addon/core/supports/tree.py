"""Trees: thin branches from the contacts downwards, which meet and go on as one trunk.

From the top layer down, every tip stands straight, steps one stud aside towards
a tip that it can meet, or joins tips near to it in one brick. Every step is a
brick that covers the old place and the new one, so that studs hold the whole way.

References
----------
Paper, section on support bricks: struts are thinner at the top than below, and a
node between two layers becomes a brick of the lower one. Schmidt and Umetani,
"Branching support structures for 3D printing" (2014); Vanek et al., "Clever
Support" (2014).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from ..model import Rows
from ..units import PLATES_PER_BRICK
from .boxes import Area, Boxes, boxes_of, cells_of
from .clearance import Clearance

LONGEST_NODE: Final = 4
"""Studs that the brick of a node spans at most."""

FAR: Final = np.iinfo(np.int64).max
"""Studs between tips that never meet."""

LEAST: Final = 0.01
"""Load in N that every contact is taken to have, that of a few small bricks."""

REACH: Final = 0.4
"""Studs that two tips may lie apart for each layer that is left below them; stepping farther costs more bricks than
a trunk of their own."""

_STURDY: Final = ((7, (2, 2)), (3, (2, 1)), (0, (1, 1)))
"""Contacts from which on a trunk gets a size, greatest first."""

_FEET: Final = ((2, 1), (2, 2), (3, 2), (4, 2), (6, 2))
"""Sizes of feet in studs."""

_USUAL_FOOT: Final = 4
"""Studs of a foot where there is room."""

_WELL_INSIDE: Final = 0.75
"""Studs from the edge of a foot at which a load lies well inside."""


@dataclass(frozen=True, slots=True)
class _Tip:
    """The lower end of a branch: its columns, the contacts it carries, their load in N, and the middle of that."""

    box: Area
    contacts: int
    load: float
    centre: tuple[float, float]
    straight: bool


def tree(contacts: Rows, load: Floats, room: Clearance, *, straight: Mask) -> Boxes:
    """Grow trees under contacts.

    Parameters
    ----------
    contacts : (n, 3) int32 array
        Cells (x, y, z) in the room, z the plate on which the carried brick lies,
        more than 0. Each has room from there down to the ground.
    load : (n,) float64 array
        Weight in N that lies on each.
    room : Clearance
    straight : (n,) bool array
        Contacts that get a trunk of their own.

    Returns
    -------
    (n_boxes, 6) int32 array
        Boxes in the room's cells: bricks, and single plates right under contacts.
    """
    cells = contacts.tolist()
    rows = [(x, y, z - plate - 1, 1, 1, 1) for x, y, z in cells for plate in range(z % PLATES_PER_BRICK)]
    waiting: dict[int, list[_Tip]] = {}
    for (x, y, z), weight, alone in zip(cells, (load + LEAST).tolist(), straight.tolist(), strict=True):
        waiting.setdefault(z // PLATES_PER_BRICK - 1, []).append(
            _Tip((x, y, 1, 1), 1, weight, (x + 0.5, y + 0.5), alone)
        )
    tips: list[_Tip] = []
    for layer in range(max(waiting, default=-1), -1, -1):
        tips += waiting.get(layer, [])
        boxes, tips = _Layer(room, layer, tips).laid()
        rows += [(x, y, layer * PLATES_PER_BRICK, a, b, PLATES_PER_BRICK) for x, y, a, b in boxes]
    return boxes_of(rows)


class _Layer:
    """One layer of all trees: which brick each tip gets, and where it goes on below."""

    def __init__(self, room: Clearance, number: int, tips: list[_Tip]) -> None:
        self.open = room.layer(number)
        self.number = number
        self.tips = tips
        self.taken = {cell for tip in tips for cell in cells_of(tip.box)}
        self.apart = _apart(np.array([tip.box for tip in tips], dtype=np.int64).reshape(-1, 4))
        self.gap = np.abs(self.apart).sum(axis=0)
        alone = np.array([tip.straight for tip in tips], dtype=bool)
        self.gap[alone] = self.gap[:, alone] = FAR
        self.load = np.array([tip.load for tip in tips])
        self.index = {id(tip): row for row, tip in enumerate(tips)}

    def laid(self) -> tuple[list[Area], list[_Tip]]:
        """Return the bricks of the layer, and the tips of the one below."""
        boxes, below, alone = [], [], []
        for group in self._groups():
            if len(group) == 1:
                alone.append(group[0])
                continue
            box, trunk = self._node(_around(tip.box for tip in group), group)
            self.taken.update(cells_of(box))
            boxes.append(box)
            below.append(_Tip(trunk, *_together(group), straight=False))
        for tip in alone:
            box, place = self._step(tip)
            self.taken.update(cells_of(box))
            boxes.append(box)
            below.append(_Tip(place, tip.contacts, tip.load, tip.centre, tip.straight))
        return boxes, below

    def _groups(self) -> list[list[_Tip]]:
        """Put tips together that one brick can join, the nearest first."""
        groups = [[tip] for tip in self.tips]
        first, second = np.nonzero(np.triu(self.gap < LONGEST_NODE, 1))
        nearest = np.lexsort((second, first, self.gap[first, second]))
        number = list(range(len(groups)))
        for one, other in zip(first[nearest].tolist(), second[nearest].tolist(), strict=True):
            mine, others = number[one], number[other]
            if mine == others:
                continue
            own = [_around(tip.box for tip in groups[each]) for each in (mine, others)]
            if self._fits(_around(own), own):
                self.taken.update(cells_of(_around(own)))
                groups[mine], groups[others] = groups[mine] + groups[others], []
                number = [mine if each == others else each for each in number]
        return [group for group in groups if group]

    def _fits(self, box: Area, own: Sequence[Area], *, longest: int = LONGEST_NODE) -> bool:
        """Whether there is a part of the size of a box, and room for it beside what is not its own."""
        _, _, a, b = box
        if max(a, b) > longest or min(a, b) > 2:
            return False
        mine = {cell for each in own for cell in cells_of(each)}
        return self._free(box) and not any(cell in self.taken and cell not in mine for cell in cells_of(box))

    def _free(self, box: Area) -> bool:
        x, y, a, b = box
        n_y, n_x = self.open.shape
        return x >= 0 and y >= 0 and x + a <= n_x and y + b <= n_y and bool(self.open[y : y + b, x : x + a].all())

    def _node(self, box: Area, group: Sequence[_Tip]) -> tuple[Area, Area]:
        """Return the brick of a node and where its trunk goes on: as near as can be to the middle of the loads."""
        contacts, _, centre = _together(group)
        best = None
        for trunk in self._trunks(box, contacts):
            brick = _around([box, trunk])
            if brick != box and not self._fits(brick, [box]):
                continue
            middle = _middle(trunk)
            off = abs(middle[0] - centre[0]) + abs(middle[1] - centre[1])
            key = (brick[2] * brick[3], off, trunk)
            if best is None or key < best[0]:
                best = key, brick, trunk
        if best is None:
            return box, max((tip.box for tip in group), key=lambda each: each[2] * each[3])
        return best[1], best[2]

    def _trunks(self, box: Area, contacts: int) -> Iterator[Area]:
        """Yield the places for a trunk of the size that its contacts ask for, in a box or one stud beyond it."""
        long, short = next(size for least, size in _STURDY if contacts >= least)
        x, y, a, b = box
        for size_x, size_y in sorted({(long, short), (short, long)}):
            for at_y in range(y - 1, y + b - size_y + 2):
                for at_x in range(x - 1, x + a - size_x + 2):
                    if at_x < x + a and at_y < y + b and at_x + size_x > x and at_y + size_y > y:
                        yield at_x, at_y, size_x, size_y

    def _step(self, tip: _Tip) -> tuple[Area, Area]:
        """Return the brick under a tip that meets no other one in this layer, and where it goes on."""
        if self.number == 0:
            foot = self._foot(tip)
            return foot, foot
        for place in self._ways(tip):
            brick = _around([tip.box, place])
            if self._fits(brick, [tip.box]):
                return brick, place
        return tip.box, tip.box

    def _ways(self, tip: _Tip) -> Iterator[Area]:
        """Yield the steps towards the nearest tip that can be met, the longer way first."""
        mine = self.index[id(tip)]
        gap = np.where(self.load >= tip.load, self.gap[mine], FAR)
        gap[mine] = FAR
        partner = int(gap.argmin())
        if gap[partner] > REACH * self.number:
            return
        apart = self.apart[:, mine, partner].tolist()
        x, y, a, b = tip.box
        for axis in sorted((0, 1), key=lambda each: -abs(apart[each])):
            if apart[axis]:
                way = 1 if apart[axis] > 0 else -1
                yield (x + way, y, a, b) if axis == 0 else (x, y + way, a, b)

    def _foot(self, tip: _Tip) -> Area:
        """Return the smallest foot round a trunk that its load lies well inside of, or as well as there is room."""
        x, y, a, b = tip.box
        best = (*_unsteady(tip.box, tip.centre), tip.box)
        for long, short in _FEET:
            for wide_x, wide_y in ((long, short), (short, long)):
                for at_y in range(y + b - wide_y, y + 1):
                    for at_x in range(x + a - wide_x, x + 1):
                        foot = at_x, at_y, wide_x, wide_y
                        worth = (*_unsteady(foot, tip.centre), foot)
                        if worth < best and self._fits(foot, [tip.box], longest=long):
                            best = worth
        return best[2]


def _unsteady(foot: Area, load: tuple[float, float]) -> tuple[float, int]:
    """Return what a better foot has less of: how near to its edge a load lies, and how far it is from 2 x 2 studs."""
    edges = [min(load[axis] - foot[axis], foot[axis] + foot[axis + 2] - load[axis]) for axis in (0, 1)]
    return -min(*edges, _WELL_INSIDE), abs(foot[2] * foot[3] - _USUAL_FOOT)


def _together(group: Sequence[_Tip]) -> tuple[int, float, tuple[float, float]]:
    """Return the number of contacts of some tips, their load, and its middle."""
    load = sum(tip.load for tip in group)
    x, y = (sum(tip.load * tip.centre[axis] for tip in group) / load for axis in (0, 1))
    return sum(tip.contacts for tip in group), load, (x, y)


def _middle(box: Area) -> tuple[float, float]:
    x, y, a, b = box
    return x + a / 2, y + b / 2


def _around(boxes: Iterator[Area] | Sequence[Area]) -> Area:
    """Return the box around boxes."""
    rows = list(boxes)
    x, y = min(row[0] for row in rows), min(row[1] for row in rows)
    return x, y, max(row[0] + row[2] for row in rows) - x, max(row[1] + row[3] for row in rows) - y


def _apart(boxes: Ints) -> NDArray[np.int64]:
    """Return the free studs between boxes along x and y, (2, n, n), with the sign of the way from row to column."""
    low, high = boxes[:, :2].T, (boxes[:, :2] + boxes[:, 2:]).T
    beyond = low[:, None, :] - high[:, :, None]
    before = low[:, :, None] - high[:, None, :]
    # side by side is 0, as it is already if they overlap along an axis; a diagonal neighbour is a step away
    apart: NDArray[np.int64] = np.where(beyond >= 0, beyond + 1, np.where(before >= 0, -before - 1, 0))
    return apart
