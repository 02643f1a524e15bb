"""In which order and in which steps a model is built, so that every brick is pushed onto something that holds.

On each table bricks come from above, those below in a stud column first. What
hangs is put on with what it hangs from, as a sub-assembly that is built by
itself in the same way; pieces of a split model are put on like that, too. A
sub-assembly is built right before the step that needs it, and equal ones that
are needed soon are built together.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from ..arrays import Ints, Mask
from ..model import NOBODY, Bricks, Catalogue, Rows
from ..progress import Progress, part, silent
from .blocking import blocking
from .grouping import Items, group
from .mirror import boxes, mirror_images
from .moves import Action, Moves
from .steps import MAIN, Kind, Steps, Submodel
from .tiles import tiles_of
from .units import Units, find_units

SOON: Final = 12
"""Steps ahead for which an equal sub-assembly is built together with the first."""


@dataclass(frozen=True, slots=True)
class _Put:
    """A brick that is put on, or a submodel if there is one."""

    brick: int
    submodel: int
    pressed: bool


@dataclass(frozen=True, slots=True, eq=False)
class _Table:
    """How one submodel is built."""

    steps: list[list[_Put]]
    removals: list[list[int]]


def plan_steps(
    bricks: Bricks, catalogue: Catalogue, pairs: Rows, *, temporary: Mask, progress: Progress = silent
) -> Steps:
    """Find building order and steps.

    Parameters
    ----------
    bricks : Bricks
        Model and supports, n rows. Pieces above 0 are built on the table by
        themselves, lose their supports, and are put onto the first one.
    catalogue : Catalogue
    pairs : (n_pairs, 2) int32 array
        Lower and upper brick of each contact.
    temporary : (n,) bool array
        Bricks of supports that are taken out again.
    progress : Progress, optional
        Told how far it is, in between.

    Returns
    -------
    Steps
        Every brick placed once, every temporary one removed, every piece and
        sub-assembly joined. Bricks that nothing holds are placed last.
    """
    planner = _Planner(bricks, catalogue, pairs, temporary)
    planner.plan_pieces(progress)
    writer = _Writer(planner)
    writer.build([MAIN])
    return Steps(writer.moves(), tuple(planner.submodels))


class _Planner:
    """The tables on which a model is built, one a submodel."""

    def __init__(self, bricks: Bricks, catalogue: Catalogue, pairs: Rows, temporary: Mask) -> None:
        self.bricks, self.catalogue, self.pairs, self.temporary = bricks, catalogue, pairs, temporary
        self.box = boxes(bricks, catalogue)
        self.lot = _numbers(np.column_stack([bricks.part, bricks.colour]))
        stays = np.flatnonzero(~temporary)
        image = mirror_images(bricks.take(stays), catalogue)
        self.image = np.full(len(bricks), NOBODY, dtype=np.int64)
        self.image[stays] = np.where(image == NOBODY, NOBODY, stays[image])
        self.submodels: list[Submodel] = []
        self.tables: dict[int, _Table] = {}
        # what a sub-assembly looks like, wherever it stands
        self.shape: dict[int, tuple[object, ...]] = {}

    def plan_pieces(self, progress: Progress) -> None:
        """Plan the main model and with it all pieces."""
        piece = self.bricks.piece
        self._add(Kind.MAIN, NOBODY, int(piece.min(initial=0)))
        numbers = {int(each): self._add(Kind.PIECE, MAIN, int(each)) for each in np.unique(piece)[1:]}
        for turn, (each, number) in enumerate(numbers.items()):
            share = part(progress, turn / (2 * len(numbers)), (turn + 1) / (2 * len(numbers)))
            self._plan(number, np.flatnonzero(piece == each), {}, share)
        first = piece == piece.min(initial=0)
        given = {number: np.flatnonzero((piece == each) & ~self.temporary) for each, number in numbers.items()}
        self._plan(MAIN, np.flatnonzero(first | ~self.temporary), given, part(progress, 0.5, 1.0))

    def _add(self, kind: Kind, parent: int, piece: int) -> int:
        number = len(self.submodels)
        self.submodels.append(Submodel(number, kind, parent, piece, np.zeros(0, dtype=np.int64), number))
        return number

    def _plan(self, number: int, rows: Ints, given: dict[int, Ints], progress: Progress = silent) -> None:
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
        units = self._units(rows, node, own)
        of_unit = self._submodels(number, rows, node, units, pieces)
        steps, placed = self._grouped(rows, units, of_unit, progress)
        gone = rows[own & self.temporary[rows]]
        self.tables[number] = _Table(steps, self._removals(gone))
        self.submodels[number] = replace(self.submodels[number], rows=placed)

    def _units(self, rows: Ints, node: Ints, own: Mask) -> Units:
        """Return what goes on together on one table."""
        level = self.bricks.corner[rows, 2].astype(np.int64)
        local = np.full(len(self.bricks), NOBODY, dtype=np.int64)
        local[rows] = np.arange(len(rows))
        pairs = local[self.pairs]
        pairs = pairs[(pairs != NOBODY).all(axis=1)]
        below = blocking(self.bricks.take(rows), self.catalogue)
        ground = own & (level == level[own].min(initial=np.iinfo(np.int64).max))
        return find_units(node, level, pairs, below, ground=ground)

    def _submodels(self, number: int, rows: Ints, node: Ints, units: Units, pieces: dict[int, int]) -> dict[int, int]:
        """Return the submodel that each unit is, if it is one, and plan those that are new."""
        found = {int(units.unit[node == first][0]): each for first, each in pieces.items()}
        count = np.bincount(units.unit)
        for unit in np.flatnonzero(count > 1).tolist():
            if unit not in found:
                made = found[unit] = self._add(Kind.SUBASSEMBLY, number, self.submodels[number].piece)
                self._plan(made, rows[units.unit == unit], {})
        return found

    def _grouped(
        self, rows: Ints, units: Units, of_unit: dict[int, int], progress: Progress
    ) -> tuple[list[list[_Put]], Ints]:
        """Return the steps of a table, and the bricks that are placed there themselves, in order."""
        n = int(units.unit.max(initial=NOBODY)) + 1
        loose = np.zeros(n, dtype=bool)
        loose[units.unit[units.loose]] = True
        first = np.unique(units.unit, return_index=True)[1]
        items = self._items(rows, units, of_unit)
        steps: list[list[int]] = []
        for which in (~loose, loose):
            steps += _some(items, units.before, np.flatnonzero(which), progress)
        pressed = units.pressed[first]
        puts = [
            [
                _Put(NOBODY, of_unit[unit], pressed=False)
                if unit in of_unit
                else _Put(int(rows[first[unit]]), NOBODY, bool(pressed[unit]))
                for unit in step
            ]
            for step in steps
        ]
        return puts, np.array([put.brick for step in puts for put in step if put.brick != NOBODY], dtype=np.int64)

    def _items(self, rows: Ints, units: Units, of_unit: dict[int, int]) -> Items:
        """Return the units of a table as what is put on."""
        unit = units.unit
        n = int(unit.max(initial=NOBODY)) + 1
        first = np.unique(unit, return_index=True)[1]
        box = self.box[rows[first]].copy()
        for column, best in enumerate((np.minimum, np.maximum) * 2):
            best.at(box[:, column], unit, self.box[rows, column])
        level = np.full(n, np.iinfo(np.int64).max)
        np.minimum.at(level, unit, self.bricks.corner[rows, 2].astype(np.int64))
        lot = self.lot[rows[first]].copy()
        shapes = {shape: turn for turn, shape in enumerate(dict.fromkeys(self.shape.values()))}
        for each, number in of_unit.items():
            lot[each] = -1 - shapes.get(self.shape.get(number, ()), -1 - number)
        return Items(
            box=box,
            level=level,
            size=np.bincount(unit, minlength=n),
            lot=lot,
            temporary=self.temporary[rows[first]],
            image=self._images(rows, unit, n),
            tile=tiles_of(box, level),
        )

    def _images(self, rows: Ints, unit: Ints, n: int) -> Ints:
        """Return the mirrored unit of each: that to which the images of all its bricks belong."""
        of_row = np.full(len(self.bricks) + 1, NOBODY, dtype=np.int64)
        of_row[rows] = unit
        other = of_row[self.image[rows]]
        low, high = np.full(n, n), np.full(n, NOBODY)
        np.minimum.at(low, unit, other)
        np.maximum.at(high, unit, other)
        size = np.bincount(unit, minlength=n)
        found = np.where((low == high) & (low != NOBODY), low, NOBODY)
        same = (found != NOBODY) & (size[found] == size)
        return np.where(same & (found != np.arange(n)), found, NOBODY)

    def _removals(self, gone: Ints) -> list[list[int]]:
        """Return the steps in which supports are taken out, from below."""
        if not len(gone):
            return []
        n = len(gone)
        before = blocking(self.bricks.take(gone), self.catalogue)
        nothing = np.full(n, NOBODY, dtype=np.int64)
        level = self.bricks.corner[gone, 2].astype(np.int64)
        ones, all_ = np.ones(n, dtype=np.int64), np.ones(n, dtype=bool)
        tile = np.zeros(n, dtype=np.int64)
        steps = group(Items(self.box[gone], level, ones, self.lot[gone], all_, nothing, tile), before)
        return [gone[step].tolist() for step in steps]


def _some(items: Items, before: Rows, which: Ints, progress: Progress) -> list[list[int]]:
    """Return the steps of some of the items."""
    local = np.full(len(items), NOBODY, dtype=np.int64)
    local[which] = np.arange(len(which))
    inside = local[before]
    image = items.image[which]
    image = np.where(image == NOBODY, NOBODY, local[image])
    fields = {name: getattr(items, name)[which] for name in Items.__slots__ if name != "image"}
    inside = inside[(inside != NOBODY).all(axis=1)].astype(np.int32)
    steps = group(Items(**fields, image=image), inside, progress=progress)
    return [which[step].tolist() for step in steps]


def _numbers(columns: Ints) -> Ints:
    """Return a number of each row, the same of equal ones."""
    found: Ints = np.unique(columns, axis=0, return_inverse=True)[1].reshape(-1).astype(np.int64)
    return found


class _Writer:
    """The moves of all tables, one after the other."""

    def __init__(self, planner: _Planner) -> None:
        self.planner = planner
        self.rows: list[tuple[int, int, int, int, bool, int]] = []
        self.step = NOBODY
        self.built: set[int] = set()

    def build(self, numbers: Sequence[int]) -> None:
        """Build equal submodels, and before each step what it needs."""
        self.built.update(numbers)
        tables = [self.planner.tables[number] for number in numbers]
        for turn in range(len(tables[0].steps)):
            for ahead in range(turn, turn + 1):
                self._prepare([put.submodel for table in tables for put in table.steps[ahead]], tables[0], turn)
            self.step += 1
            for number, table in zip(numbers, tables, strict=True):
                for put in table.steps[turn]:
                    self._note(number, put)
        for turn in range(len(tables[0].removals)):
            self.step += 1
            for number, table in zip(numbers, tables, strict=True):
                for brick in table.removals[turn]:
                    self._row(Action.REMOVE, brick, number, pressed=False)

    def moves(self) -> Moves:
        """Return all moves so far."""
        table = np.array(self.rows, dtype=np.int64).reshape(-1, 6)
        return Moves(
            action=table[:, 0].astype(np.uint8),
            brick=table[:, 1].astype(np.int32),
            piece=table[:, 2].astype(np.int16),
            submodel=table[:, 3].astype(np.int32),
            pressed=table[:, 4].astype(bool),
            step=table[:, 5].astype(np.int32),
        )

    def _prepare(self, needed: Sequence[int], table: _Table, turn: int) -> None:
        """Build the submodels that a step needs."""
        for number in needed:
            if number != NOBODY and number not in self.built:
                self.build([number])

    def _note(self, number: int, put: _Put) -> None:
        if put.submodel == NOBODY:
            self._row(Action.PLACE, put.brick, number, pressed=put.pressed)
        else:
            self._row(Action.JOIN, NOBODY, put.submodel, pressed=False)

    def _row(self, action: Action, brick: int, submodel: int, *, pressed: bool) -> None:
        piece = self.planner.submodels[submodel].piece
        self.rows.append((action, brick, piece, submodel, pressed, self.step))
