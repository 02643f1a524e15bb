"""In which order and in which steps a model is built, so that every brick is pushed onto something that holds.

On each table bricks come from above, those below in a stud column first. What
hangs is put on with what it hangs from, as a sub-assembly that is built by
itself in the same way; pieces of a split model are put on like that, too. A
sub-assembly is built right before the step that needs it, or in that step if it
is small, and equal ones that are needed soon are built together.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from ..arrays import Mask
from ..model import NOBODY, Assembly, Bricks, Catalogue, Role, Rows
from ..progress import Progress, silent
from .contacts import building_contacts
from .items import MOST, REACH, SMALL, span
from .moves import Action, Moves
from .steps import MAIN, Kind, Steps
from .tables import Planner, Put, Shape, Table

SOON: Final = 12
"""Steps ahead for which an equal sub-assembly is built together with the first."""


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
    planner = Planner(bricks, catalogue, pairs, temporary)
    planner.plan_pieces(progress)
    writer = _Writer(planner)
    writer.build([MAIN])
    submodels = (replace(each, like=writer.like.get(each.number, each.number)) for each in planner.submodels)
    return Steps(writer.moves(), tuple(submodels))


def steps_of(assembly: Assembly) -> Steps:
    """Find building order and steps of a model with its supports, as :func:`plan_steps` does, from the bricks alone.

    Parameters
    ----------
    assembly : Assembly
        Model and supports; those of the role ``SUPPORT_OUTSIDE`` are taken out again.

    Returns
    -------
    Steps
    """
    temporary = assembly.bricks.role == Role.SUPPORT_OUTSIDE
    contacts = building_contacts(assembly, temporary=temporary)
    return plan_steps(assembly.bricks, assembly.catalogue, contacts.pairs, temporary=temporary)


class _Writer:
    """The moves of all tables, one after the other."""

    def __init__(self, planner: Planner) -> None:
        self.planner = planner
        self.rows: list[tuple[int, int, int, int, bool, int]] = []
        self.step = NOBODY
        self.built: set[int] = set()
        # the first of equal submodels that are built together
        self.like: dict[int, int] = {}
        # the first of each shape that is built in the step that puts it on
        self.inside: dict[Shape, int] = {}

    def build(self, numbers: Sequence[int]) -> None:
        """Build equal submodels, and before each step what it needs."""
        self.built.update(numbers)
        tables = [self.planner.tables[number] for number in numbers]
        for turn in range(len(tables[0].steps)):
            self._prepare(tables, turn)
            self.step += 1
            self.inside.clear()
            for number, table in zip(numbers, tables, strict=True):
                self._note(number, table.steps[turn])
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

    def _prepare(self, tables: Sequence[Table], turn: int) -> None:
        """Build the submodels that a step needs, and with each those equal ones that are needed soon.

        What the mirrored step after it needs is built before both, so that they follow each other.
        """
        ahead = [[put.submodel for table in tables for put in table.steps[each]] for each in _next(tables, turn)]
        ahead = [[each for each in numbers if each != NOBODY and not self._small(each)] for numbers in ahead]
        soon = [number for numbers in ahead for number in numbers]
        both = len(ahead) > 1 and self._mirrored(tables[0], turn)
        needed = [number for numbers in ahead[: 1 + both] for number in numbers]
        for number in needed:
            for each in (number, *self._images(number, needed)):
                if each not in self.built:
                    self._build_alike(each, [other for other in soon if other not in self.built])

    def _mirrored(self, table: Table, turn: int) -> bool:
        """Whether a step has images in the next one."""
        here, there = (self._rows_in(table.steps[each]) for each in (turn, turn + 1))
        return bool(np.isin(self.planner.image[here], there).any())

    def _images(self, number: int, others: Sequence[int]) -> list[int]:
        """Return the submodel that is the mirror image of one, if it is among some others."""
        images = set(self.planner.image[self.planner.all_rows(number)].tolist())
        return [other for other in others if images == set(self.planner.all_rows(other))]

    def _rows_in(self, step: Sequence[Put]) -> list[int]:
        """Return the bricks that a step puts on, those of submodels included."""
        return [
            row for put in step for row in ([put.brick] if put.brick != NOBODY else self.planner.all_rows(put.submodel))
        ]

    def _alike(self, one: int, other: int) -> bool:
        shape = self.planner.shape
        return one == other or (one in shape and shape[one] == shape.get(other))

    def _build_alike(self, number: int, others: Sequence[int]) -> None:
        """Build a submodel, together with equal ones that belong near it."""
        alike, rows = [number], self.planner.all_rows(number)
        most = self._copies(number)
        for other in others:
            near = [*rows, *self.planner.all_rows(other)] if self._alike(other, number) else []
            if near and other != number and len(alike) < most and span(self.planner.box[near]) <= REACH:
                alike, rows = [*alike, other], near
        self.like.update(dict.fromkeys(alike, min(alike)))
        self.build(sorted(alike))

    def _copies(self, number: int) -> int:
        """Return how many equal submodels can be built at once: what is built of them at a time is one step."""
        if self.planner.submodels[number].kind == Kind.SUBASSEMBLY:
            return MOST // len(self.planner.all_rows(number))
        steps = self.planner.tables[number].steps
        inside = [put.submodel for step in steps for put in step if put.submodel != NOBODY]
        largest = max(
            len(self._rows_in([put for put in step if put.submodel == NOBODY or self._small(put.submodel)]))
            for step in steps
        )
        # where every step puts on large sub-assemblies alone, these decide
        return min([MOST // max(largest, 1), *(MOST // len(self.planner.all_rows(each)) for each in inside)])

    def _small(self, number: int) -> bool:
        """Whether a submodel is built in the step that puts it on."""
        return (
            self.planner.submodels[number].kind == Kind.SUBASSEMBLY
            and len(self.planner.all_rows(number)) <= SMALL
            and len(self.planner.tables[number].steps) == 1
        )

    def _note(self, number: int, step: Sequence[Put]) -> None:
        """Note what is put on in a step, and before that the small submodels that are built in it."""
        for put in step:
            if put.submodel != NOBODY and put.submodel not in self.built:
                self._build_inside(put.submodel)
        for put in step:
            if put.submodel == NOBODY:
                self._row(Action.PLACE, put.brick, number, pressed=put.pressed)
            else:
                self._row(Action.JOIN, NOBODY, put.submodel, pressed=False)

    def _build_inside(self, number: int) -> None:
        """Build a small submodel in the step at hand."""
        self.built.add(number)
        [step] = self.planner.tables[number].steps
        self._note(number, step)
        self.like[number] = self.inside.setdefault(self.planner.shape[number], number)

    def _row(self, action: Action, brick: int, submodel: int, *, pressed: bool) -> None:
        piece = self.planner.submodels[submodel].piece
        self.rows.append((action, brick, piece, submodel, pressed, self.step))


def _next(tables: Sequence[Table], turn: int) -> range:
    """Return the numbers of a step and of those after it."""
    return range(turn, min(turn + SOON, len(tables[0].steps)))
