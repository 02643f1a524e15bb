"""Fewer lots to buy: bricks of small lots are split, or joined with a neighbour, into parts that are there anyway.

The colours stay as they are, so this costs no likeness, but a brick more for each
that is split. A lot goes only as a whole: one brick of it that is left has to be
bought all the same.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Final, NamedTuple

import numpy as np

from ..layout.problem import gather
from ..model import SUPPORTS, Assembly, Bricks, Catalogue, Part
from .assignment import visible_cells
from .few_lots import SMALL, merge_lots

_AGAIN: Final = 3
"""Times that all small lots are tried: one that went may let another one go."""

Lot = tuple[int, int]
"""Part and colour of a brick: row of the catalogue and LDraw code."""


class Box(NamedTuple):
    """Cells of a brick: its lowest corner, and its extent along x, y and z, in studs and plates."""

    x: int
    y: int
    z: int
    across: int
    deep: int
    high: int


class Exchange(NamedTuple):
    """What lies in place of a brick, or of two that are joined: rows of the old, cells and lots of the new bricks."""

    out: tuple[int, ...]
    boxes: tuple[Box, ...]
    lots: tuple[Lot, ...]


def exchange_small(assembly: Assembly, limit: float) -> tuple[Assembly, int, int]:
    """Lay other parts in place of the bricks of small lots, as far as such parts are in the model.

    Parameters
    ----------
    assembly : Assembly
        Without collisions.
    limit : float
        Largest difference of two colours, CIEDE2000, at which small lots are merged afterwards: those need no other
        parts.

    Returns
    -------
    assembly : Assembly
        Fills the same cells and shows the same colours, and comes apart nowhere where the given one does not; the same
        object if nothing was exchanged.
    n_split, n_joined : int
        Bricks that were split, and pairs that were joined.
    """
    n_split = n_joined = 0
    lots = _Lots(assembly, limit)
    for _ in range(_AGAIN):
        before = lots
        for lot in lots.small:
            exchanges = lots.without(lot) if lot in lots.small else []
            found = _Lots(_exchanged(lots.assembly, exchanges), limit) if exchanges else lots
            if found.better_than(lots):
                lots = found
                n_split += sum(len(each.out) == 1 for each in exchanges)
                n_joined += sum(len(each.out) > 1 for each in exchanges)
        if lots is before:
            break
    return lots.assembly, n_split, n_joined


@dataclass(frozen=True, eq=False)
class _Lots:
    """The lots of a model once close colours are merged, and what may lie in place of its bricks."""

    assembly: Assembly
    limit: float

    @cached_property
    def visible(self) -> list[bool]:
        """Which bricks are seen."""
        return [bool(cells) for cells in visible_cells(self.assembly.graph)]

    @cached_property
    def of_brick(self) -> list[Lot]:
        """The lot of each brick."""
        colour = merge_lots(self.assembly, np.array(self.visible, dtype=np.int64), self.limit)
        return list(zip(self.assembly.bricks.part.tolist(), colour.tolist(), strict=True))

    @cached_property
    def small(self) -> list[Lot]:
        """Those that are small, of fewest bricks first."""
        count = Counter(self.of_brick)
        return sorted((lot for lot in count if count[lot] <= SMALL), key=lambda lot: (count[lot], lot))

    @cached_property
    def large(self) -> dict[int, list[int]]:
        """The colours of all others by part, those of most bricks first."""
        found: dict[int, list[int]] = {}
        for (part, colour), count in Counter(self.of_brick).most_common():
            if count > SMALL:
                found.setdefault(part, []).append(colour)
        return found

    @cached_property
    def boxes(self) -> list[Box]:
        """Where each brick lies."""
        bricks, parts = self.assembly.bricks, self.assembly.catalogue.parts
        rows = zip(bricks.part.tolist(), bricks.turn.tolist(), bricks.corner.tolist(), strict=True)
        return [_box(parts[part], turn, *corner) for part, turn, corner in rows]

    @cached_property
    def at(self) -> dict[tuple[int, int, int], int]:
        """The brick that begins at a corner."""
        return {box[:3]: row for row, box in enumerate(self.boxes)}

    @cached_property
    def ending(self) -> dict[tuple[int, int, int, int], int]:
        """The brick that ends along an axis (0 x, 1 y) before a corner."""
        along_x = {(0, box.x + box.across, box.y, box.z): row for row, box in enumerate(self.boxes)}
        return along_x | {(1, box.x, box.y + box.deep, box.z): row for row, box in enumerate(self.boxes)}

    def better_than(self, other: _Lots) -> bool:
        """Tell whether a model takes fewer lots than another one, and does not come apart more."""
        fewer = len(set(self.of_brick)) < len(set(other.of_brick))
        return fewer and self.assembly.graph.n_components <= other.assembly.graph.n_components

    def without(self, lot: Lot) -> list[Exchange]:
        """Return exchanges by which a lot goes; none if one of its bricks has no place in other parts."""
        chosen: list[Exchange] = []
        taken: set[int] = set()
        for row in (row for row, each in enumerate(self.of_brick) if each == lot):
            if row in taken:
                continue
            best = next((each for each in self._options(row) if taken.isdisjoint(each.out)), None)
            if best is None:
                return []
            chosen.append(best)
            taken.update(best.out)
        return chosen

    def _options(self, row: int) -> Iterator[Exchange]:
        """Yield what may lie in place of a brick, what takes fewest bricks first."""
        if self._movable(row):
            yield from self._joins(row)
            yield from self._splits(row)

    def _movable(self, row: int) -> bool:
        bricks = self.assembly.bricks
        part = self.assembly.catalogue.parts[bricks.part[row]]
        return part.profile == "box" and part.use == "model" and int(bricks.role[row]) not in SUPPORTS

    def _joins(self, row: int) -> Iterator[Exchange]:
        x, y, z, across, deep, high = box = self.boxes[row]
        sides = (
            (self.at.get((x + across, y, z)), 0), (self.ending.get((0, x, y, z)), 0),
            (self.at.get((x, y + deep, z)), 1), (self.ending.get((1, x, y, z)), 1),
        )  # fmt: skip
        for other, axis in sides:
            if other is None or not self._movable(other):
                continue
            beside = self.boxes[other]
            if beside.high != high or (beside.deep != deep if axis == 0 else beside.across != across):
                continue
            low = Box(min(x, beside.x), min(y, beside.y), z, *_together(box, beside, axis), high)
            lot = self._lot(low, row, other)
            if lot is not None and lot not in (self.of_brick[row], self.of_brick[other]):
                yield Exchange((row, other), (low,), (lot,))

    def _splits(self, row: int) -> Iterator[Exchange]:
        x, y, z, across, deep, high = self.boxes[row]
        cuts = [
            *((Box(x, y, z, k, deep, high), Box(x + k, y, z, across - k, deep, high)) for k in range(1, across)),
            *((Box(x, y, z, across, k, high), Box(x, y + k, z, across, deep - k, high)) for k in range(1, deep)),
        ]
        for pair in cuts:
            one, other = (self._lot(box, row) for box in pair)
            if one is not None and other is not None:
                yield Exchange((row,), pair, (one, other))

    def _lot(self, box: Box, *rows: int) -> Lot | None:
        """Return a large lot for a brick that shows what some bricks show; None if there is none."""
        part = _part_of(self.assembly.catalogue, box)
        shown = {int(self.assembly.bricks.colour[row]) for row in rows if self.visible[row]}
        if part is None or len(shown) > 1:
            return None
        colours = [colour for colour in self.large.get(part, ()) if not shown or colour in shown]
        return (part, colours[0]) if colours else None


def _box(part: Part, turn: int, x: int, y: int, z: int) -> Box:
    across, deep = (part.width, part.length) if turn % 2 else (part.length, part.width)
    return Box(x, y, z, across, deep, part.height)


def _together(one: Box, other: Box, axis: int) -> tuple[int, int]:
    """Return how far two boxes reach that lie side by side along an axis."""
    return (one.across + other.across, one.deep) if axis == 0 else (one.across, one.deep + other.deep)


def _part_of(catalogue: Catalogue, box: Box) -> int | None:
    """Return the part that fills a box."""
    long, short = max(box.across, box.deep), min(box.across, box.deep)
    for row, part in enumerate(catalogue.parts):
        if (part.length, part.width, part.height) == (long, short, box.high) and part.profile == "box":
            return row if part.use == "model" else None
    return None


def _exchanged(assembly: Assembly, exchanges: list[Exchange]) -> Assembly:
    """Return a model with other bricks in place of some."""
    bricks, parts = assembly.bricks, assembly.catalogue.parts
    kept = np.ones(len(bricks), dtype=bool)
    tables = []
    for out, boxes, lots in exchanges:
        kept[list(out)] = False
        # of a pair the one that shows lends its role
        like = bricks.take(np.full(len(boxes), min(out, key=lambda row: int(bricks.role[row]))))
        part = np.array([lot[0] for lot in lots], dtype=bricks.part.dtype)
        turned = [box.across < box.deep and parts[row].turns > 1 for box, row in zip(boxes, part, strict=True)]
        tables.append(
            Bricks(
                part=part,
                corner=np.array([box[:3] for box in boxes], dtype=np.int32),
                turn=np.array(turned, dtype=np.uint8),
                colour=np.array([lot[1] for lot in lots], dtype=bricks.colour.dtype),
                role=like.role,
                piece=like.piece,
                step=like.step,
            )
        )
    return Assembly(gather([bricks.take(kept), *tables]), assembly.catalogue)
