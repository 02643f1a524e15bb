"""How each submodel is built on its table: what goes on together, in which steps, and what comes out again."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..arrays import Ints, Mask
from ..model import NOBODY, Bricks, Catalogue, Rows, stacked
from ..progress import Progress, part, silent
from .alike import COPIES, alike_pieces
from .blocking import column_pairs
from .grouping import group
from .halves import match_halves
from .items import MOST, Items, in_turn
from .leaning import Leaning
from .mirror import boxes, mirror_images
from .steps import MAIN, Kind, Submodel
from .tiles import tiles_of
from .units import Hangers, Units, find_units

Shape = tuple[object, ...]


@dataclass(frozen=True, slots=True)
class Put:
    """A brick that is put on, or a submodel if there is one."""

    brick: int
    submodel: int
    pressed: bool


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """How one submodel is built."""

    steps: list[list[Put]]
    removals: list[list[int]]


class Planner:
    """The tables on which a model is built, one a submodel."""

    def __init__(self, bricks: Bricks, catalogue: Catalogue, pairs: Rows, temporary: Mask) -> None:
        self.bricks, self.catalogue, self.pairs, self.temporary = bricks, catalogue, pairs, temporary
        self.box, self.level = boxes(bricks, catalogue), bricks.corner[:, 2].tolist()
        self.below, _ = stacked(pairs, len(bricks))
        self.leaning = Leaning(bricks, catalogue, self.box)
        self.rank = _off_middle(self.box)
        self.lot = _numbers(np.column_stack([bricks.part, bricks.colour]))
        stays = np.flatnonzero(~temporary)
        # tiles of a picture: the wide floor of a model is none, on whatever table it lies
        self.flat = bool(tiles_of(self.box[stays], bricks.corner[stays, 2].astype(np.int64)).any())
        image = mirror_images(bricks.take(stays), catalogue)
        self.image = np.full(len(bricks), NOBODY, dtype=np.int64)
        self.image[stays] = np.where(image == NOBODY, NOBODY, stays[image])
        self.submodels: list[Submodel] = []
        self.tables: dict[int, Table] = {}
        # what a sub-assembly looks like, wherever it stands
        self.shape: dict[int, Shape] = {}
        self.low: dict[int, Ints] = {}

    def plan_pieces(self, progress: Progress) -> None:
        """Plan the main model and with it all pieces."""
        piece = self.bricks.piece
        lowest = int(piece.min()) if len(piece) else 0
        self._add(Kind.MAIN, NOBODY, lowest)
        # of what is supports alone, nothing is left to be joined
        pieces = [each for each in np.unique(piece[~self.temporary]).tolist() if each != lowest]
        numbers = {each: self._add(Kind.PIECE, MAIN, each) for each in pieces}
        alike = alike_pieces(self.bricks, self.box, pieces)
        first = {each: int(piece[next(iter(row_of))]) for each, row_of in alike.items()}
        for turn, (each, number) in enumerate(numbers.items()):
            share = part(progress, turn / (2 * len(numbers)), (turn + 1) / (2 * len(numbers)))
            if each in alike:
                self._copy(numbers[first[each]], number, alike[each])
                self.shape[number] = self.shape[numbers[first[each]]] = ("piece", first[each])
            else:
                copies = COPIES if each in first.values() else 1
                self._plan(number, np.flatnonzero(piece == each), {}, share, copies=copies)
        given = {number: np.flatnonzero((piece == each) & ~self.temporary) for each, number in numbers.items()}
        main = ~np.isin(piece, pieces)
        self._plan(MAIN, np.flatnonzero(main | ~self.temporary), given, part(progress, 0.5, 1.0))

    def _add(self, kind: Kind, parent: int, piece: int) -> int:
        number = len(self.submodels)
        self.submodels.append(Submodel(number, kind, parent, piece, np.zeros(0, dtype=np.int64), number))
        return number

    def _copy(self, first: int, number: int, row_of: Mapping[int, int]) -> None:
        """Plan a submodel like another one, whose bricks and its own are equal up to their place."""

        def put(one: Put) -> Put:
            if one.brick != NOBODY:
                return replace(one, brick=row_of[one.brick])
            inside = self._add(Kind.SUBASSEMBLY, number, self.submodels[number].piece)
            self._copy(one.submodel, inside, row_of)
            self.shape[inside] = self.shape[one.submodel]
            self.low[inside] = self.bricks.corner[self.all_rows(inside)].min(axis=0).astype(np.int64)
            return replace(one, submodel=inside)

        table, rows = self.tables[first], self.submodels[first].rows.tolist()
        self.tables[number] = Table(
            [[put(one) for one in step] for step in table.steps],
            [[row_of[brick] for brick in step] for step in table.removals],
        )
        of_both = np.array([row_of[row] for row in rows], dtype=np.int64)
        self.submodels[number] = replace(self.submodels[number], rows=of_both)

    def _plan(
        self, number: int, rows: Ints, given: Mapping[int, Ints], progress: Progress = silent, *, copies: int = 1
    ) -> None:
        """Plan how the bricks of a submodel are put on, of which some are submodels already."""
        node, own = np.arange(len(rows)), np.ones(len(rows), dtype=bool)
        submodel = {}
        for each, members in given.items():
            inside = np.searchsorted(rows, members)
            own[inside] = False
            node[inside] = inside[0]
            submodel[int(inside[0])] = each
        used, node = np.unique(node, return_inverse=True)
        node = node.reshape(-1)
        pieces = {int(np.searchsorted(used, first)): each for first, each in submodel.items()}
        units = self._units(number, rows, node, own)
        of_unit = self._submodels(number, rows, node, units, pieces)
        small = self.submodels[number].kind == Kind.SUBASSEMBLY
        steps, placed = self._grouped(rows, units, of_unit, progress, small=small, copies=copies)
        gone = rows[own & self.temporary[rows]]
        self.tables[number] = Table(steps, self._removals(gone, copies))
        self.submodels[number] = replace(self.submodels[number], rows=placed)

    def _plan_small(self, number: int, rows: Ints) -> None:
        """Plan a sub-assembly; where all of it comes from above onto the rest, one step is all it takes."""
        order = sorted(rows.tolist(), key=lambda row: (self.level[row], self.box[row].tolist()))
        if len(rows) <= MOST and self._holds(order):
            self.tables[number] = Table([[Put(row, NOBODY, pressed=False) for row in order]], [])
            self.submodels[number] = replace(self.submodels[number], rows=np.array(order, dtype=np.int64))
        else:
            self._plan(number, rows, {})
        self.low[number] = self.bricks.corner[rows].min(axis=0).astype(np.int64)
        self.shape[number] = self._shape(number)

    def _holds(self, order: list[int]) -> bool:
        """Whether each of some bricks, from the lowest, stands on the table or on one before it, and under none."""
        there: set[int] = set()
        later = set(order)
        for row in order:
            stands = self.level[row] == self.level[order[0]] or not there.isdisjoint(self.below[row])
            # what fills the step under a slope may begin as low as that slope
            if not stands or not later.isdisjoint(self.below[row]):
                return False
            there.add(row)
            later.discard(row)
        return True

    def all_rows(self, number: int) -> list[int]:
        """Return the bricks of a submodel, with those of others in it."""
        puts = [put for step in self.tables[number].steps for put in step]
        return [row for put in puts for row in (self.all_rows(put.submodel) if put.brick == NOBODY else [put.brick])]

    def _shape(self, number: int) -> Shape:
        """Return what a sub-assembly looks like and how it is built, wherever it stands."""
        return tuple(
            tuple(
                (self.shape[put.submodel], *(self.low[put.submodel] - self.low[number]).tolist())
                if put.submodel != NOBODY
                else self._look(put.brick, number)
                for put in step
            )
            for step in self.tables[number].steps
        )

    def _look(self, brick: int, number: int) -> tuple[int, ...]:
        bricks = self.bricks
        what = (bricks.part[brick], bricks.turn[brick], bricks.colour[brick], bricks.role[brick])
        return (*map(int, what), *(bricks.corner[brick] - self.low[number]).tolist())

    def _units(self, number: int, rows: Ints, node: Ints, own: Mask) -> Units:
        """Return what goes on together on one table."""
        level = self.bricks.corner[rows, 2].astype(np.int64)
        local = np.full(len(self.bricks), NOBODY, dtype=np.int64)
        local[rows] = np.arange(len(rows))
        pairs = local[self.pairs]
        pairs = pairs[(pairs != NOBODY).all(axis=1)]
        below = column_pairs(self.bricks.take(rows), self.catalogue)
        ground = self._ground(number, level, own, below)
        hangers = Hangers(self.rank[rows], partial(self.leaning, rows[np.unique(node, return_index=True)[1]]))
        units = find_units(node, level, pairs, below, ground=ground, hangers=hangers, piece=~own)
        image = np.where(own & (self.image[rows] != NOBODY), local[self.image[rows]], NOBODY)
        # what is built elsewhere is whole
        return match_halves(units, np.where(own[image], image, NOBODY), pairs)

    def _ground(self, number: int, level: Ints, own: Mask, below: Rows) -> Mask:
        """Return which bricks of a table stand on it; see :meth:`.Steps.floor`."""
        if self.submodels[number].kind == Kind.SUBASSEMBLY:
            raised = below[level[below[:, 0]] >= level[below[:, 1]]]
            own = own & ~np.isin(np.arange(len(own)), raised[:, 1])
        # a piece may stand beside the first one
        ground: Mask = level == level[own].min(initial=np.iinfo(np.int64).max)
        return ground

    def _submodels(self, number: int, rows: Ints, node: Ints, units: Units, pieces: dict[int, int]) -> dict[int, int]:
        """Return the submodel that each unit is, if it is one, and plan those that are new."""
        found = {int(units.unit[node == first][0]): each for first, each in pieces.items()}
        count = np.bincount(units.unit)
        for unit in np.flatnonzero(count > 1).tolist():
            if unit not in found:
                made = found[unit] = self._add(Kind.SUBASSEMBLY, number, self.submodels[number].piece)
                self._plan_small(made, rows[units.unit == unit])
        return found

    def _grouped(
        self, rows: Ints, units: Units, of_unit: dict[int, int], progress: Progress, *, small: bool, copies: int
    ) -> tuple[list[list[Put]], Ints]:
        """Return the steps of a table, and the bricks that are placed there themselves, in order."""
        n = int(units.unit.max(initial=NOBODY)) + 1
        loose = np.zeros(n, dtype=bool)
        loose[units.unit[units.loose]] = True
        first = np.unique(units.unit, return_index=True)[1]
        items = self._items(rows, units, of_unit, small=small)
        if small and len(rows) <= MOST:
            below, _ = stacked(units.before, n)
            steps = [in_turn(range(n), below, items.box, items.level)]
        else:
            parts = (np.flatnonzero(which) for which in (~loose, loose))
            steps = [step for part in parts for step in _some(items, units.before, part, copies, progress)]
        pressed = units.pressed[first]
        puts = [
            [
                Put(NOBODY, of_unit[unit], pressed=False)
                if unit in of_unit
                else Put(int(rows[first[unit]]), NOBODY, bool(pressed[unit]))
                for unit in step
            ]
            for step in steps
        ]
        return puts, np.array([put.brick for step in puts for put in step if put.brick != NOBODY], dtype=np.int64)

    def _items(self, rows: Ints, units: Units, of_unit: dict[int, int], *, small: bool) -> Items:
        """Return the units of a table as what is put on."""
        unit = units.unit
        n = int(unit.max(initial=NOBODY)) + 1
        first = np.unique(unit, return_index=True)[1]
        box = self.box[rows[first]].copy()
        for column, best in enumerate((np.minimum, np.maximum) * 2):
            best.at(box[:, column], unit, self.box[rows, column])
        level = np.full(n, np.iinfo(np.int64).max)
        np.minimum.at(level, unit, self.bricks.corner[rows, 2].astype(np.int64))
        lot, size = self.lot[rows[first]].copy(), np.bincount(unit, minlength=n)
        alike = {shape: -1 - turn for turn, shape in enumerate(dict.fromkeys(self.shape.values()))}
        for each, number in of_unit.items():
            # pieces are like nothing else
            if self.submodels[number].kind == Kind.PIECE:
                # it is put on in a step of its own
                size[each] = max(size[each], MOST + 1)
            lot[each] = alike.get(self.shape.get(number, ()), -1 - len(alike) - number)
        return Items(
            box=box,
            level=level,
            due=_due(level, self.temporary[rows[first]], units.before),
            size=size,
            lot=lot,
            temporary=self.temporary[rows[first]],
            image=self._images(rows, unit, n),
            tile=tiles_of(box, level) if self.flat and not small else np.zeros(n, dtype=np.int64),
        )

    def _images(self, rows: Ints, unit: Ints, n: int) -> Ints:
        """Return the mirrored unit of each: the one to which the images of most of its bricks belong, if each is so."""
        of_row = np.full(len(self.bricks) + 1, NOBODY, dtype=np.int64)
        of_row[rows] = unit
        other = of_row[self.image[rows]]
        known = other != NOBODY
        both, count = np.unique(unit[known] * n + other[known], return_counts=True)
        # of several that have as many, the first one
        best = np.lexsort((both, -count, both // n))
        own, first = np.unique(both[best] // n, return_index=True)
        found = np.full(n + 1, NOBODY, dtype=np.int64)
        found[own] = both[best][first] % n
        mutual = found[found[:n]] == np.arange(n)
        return np.where(mutual & (found[:n] != np.arange(n)), found[:n], NOBODY)

    def _removals(self, gone: Ints, copies: int) -> list[list[int]]:
        """Return the steps in which supports are taken out, from below."""
        if not len(gone):
            return []
        n = len(gone)
        before = column_pairs(self.bricks.take(gone), self.catalogue)
        nothing = np.full(n, NOBODY, dtype=np.int64)
        level = self.bricks.corner[gone, 2].astype(np.int64)
        ones, all_ = np.ones(n, dtype=np.int64), np.ones(n, dtype=bool)
        tile = np.zeros(n, dtype=np.int64)
        steps = group(
            Items(self.box[gone], level, level, ones, self.lot[gone], all_, nothing, tile), before, copies=copies
        )
        return [gone[step].tolist() for step in steps]


def _some(items: Items, before: Rows, which: Ints, copies: int, progress: Progress) -> list[list[int]]:
    """Return the steps of some of the items."""
    local = np.full(len(items), NOBODY, dtype=np.int64)
    local[which] = np.arange(len(which))
    inside = local[before]
    image = items.image[which]
    image = np.where(image == NOBODY, NOBODY, local[image])
    fields = {name: getattr(items, name)[which] for name in Items.__slots__ if name != "image"}
    inside = inside[(inside != NOBODY).all(axis=1)].astype(np.int32)
    steps = group(Items(**fields, image=image), inside, copies=copies, progress=progress)
    return [which[step].tolist() for step in steps]


def _off_middle(box: Ints) -> Ints:
    """Return a number that grows with the way from the middle, in x and then in y; that of mirrored bricks is equal."""
    if not len(box):
        return np.zeros(0, dtype=np.int64)
    x, y = (np.abs(box[:, k] + box[:, k + 1] - box[:, k].min() - box[:, k + 1].max()) for k in (0, 2))
    rank: Ints = x * (y.max() + 1) + y
    return rank


def _due(level: Ints, temporary: Mask, before: Rows) -> Ints:
    """Return the level of the first brick over each support, and that of all other bricks."""
    due = np.where(temporary, np.iinfo(np.int64).max, level)
    lower, upper = before[temporary[before[:, 0]]].T
    # what lies higher first: it hands its own down
    order = np.argsort(-level[upper], kind="stable")
    for below, above in zip(lower[order].tolist(), upper[order].tolist(), strict=True):
        due[below] = min(due[below], due[above])
    return np.where(due == np.iinfo(np.int64).max, level, due)


def _numbers(columns: Ints) -> Ints:
    """Return a number of each row, the same of equal ones."""
    found: Ints = np.unique(columns, axis=0, return_inverse=True)[1].reshape(-1).astype(np.int64)
    return found
