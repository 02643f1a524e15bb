"""A model while edits are made: bricks that stay, cells whose colour is settled, and windows that are laid anew."""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import replace
from typing import Final

import numpy as np

from ..arrays import Ints, Mask
from ..errors import BuildError
from ..geometry import outer_air, visible
from ..layout import FILLER, Manner, lay_around
from ..layout.problem import GROUND, Bar, Plane
from ..model import (
    COLOUR_ANY,
    COLOUR_EMPTY,
    NOBODY,
    SUPPORTS,
    Bricks,
    Catalogue,
    ContactGraph,
    Fill,
    Role,
    UnitGrid,
    column_facts,
    concatenate,
    contact_graph,
    ground_of,
    stud_columns,
)
from ..units import PLATES_PER_BRICK
from .edit import Cell, Edit

REACHES: Final = ((0, 0), (2, 0), (4, 1), (7, PLATES_PER_BRICK))
"""Studs to all sides and plates up and down by which windows grow until the model holds together."""

APART: Final = "the model would come apart there"


class Workpiece:
    """Bricks that change edit by edit.

    Parameters
    ----------
    bricks : Bricks
        Without collisions, none at negative coordinates. Supports among them stay as they are.
    catalogue : Catalogue
        Parts that may be laid.
    shape : (int, int, int), optional
        Plates, rows and columns of the grid, at least those of the bricks.

    Attributes
    ----------
    bricks : Bricks
    graph : ContactGraph
        Of the bricks.
    owner : (n_plates, n_y, n_x) int32 array
        Row of the brick in each cell.
    fixed : (n,) bool array
        Bricks that an edit put there.
    settled : (n_plates, n_y, n_x) int16 array
        Colours that cells have by an edit, hidden or not; ``COLOUR_ANY`` elsewhere.
    """

    def __init__(self, bricks: Bricks, catalogue: Catalogue, shape: tuple[int, ...] | None = None) -> None:
        self.catalogue = catalogue
        graph = contact_graph(bricks, catalogue)
        lengths = np.maximum(graph.owner.shape, shape or (0, 0, 0)).tolist()
        lengths[0] += -lengths[0] % PLATES_PER_BRICK
        self.shape = tuple(lengths)
        self.fixed: Mask = np.zeros(len(bricks), dtype=bool)
        self.settled = np.full(self.shape, COLOUR_ANY, dtype=np.int16)
        self._bars: list[Bar] = []
        self._take(bricks, graph)

    def _take(self, bricks: Bricks, graph: ContactGraph) -> None:
        """Go on with other bricks."""
        self.bricks, self.graph = bricks, graph
        self.owner = np.full(self.shape, NOBODY, dtype=np.int32)
        n_z, n_y, n_x = graph.owner.shape
        self.owner[:n_z, :n_y, :n_x] = graph.owner
        self._laid_for_model = (self.catalogue.used_for("model") | self.catalogue.used_for("tiles"))[bricks.part]
        self._laid_for_model &= ~np.isin(bricks.role, SUPPORTS)
        self._chosen_before = self.catalogue.used_for("surface")[bricks.part]

    def inside(self, cells: Set[Cell]) -> list[Cell]:
        """Return the cells that lie in the grid, sorted."""
        n_z, n_y, n_x = self.shape
        return sorted(each for each in cells if 0 <= each[0] < n_x and 0 <= each[1] < n_y and 0 <= each[2] < n_z)

    def rows_in(self, cells: Sequence[Cell]) -> Ints:
        """Return the rows of the bricks in some cells of the grid, ascending."""
        found = np.unique(self.owner[_at(cells)])
        rows: Ints = found[found != NOBODY].astype(np.int64)
        return rows

    def filled(self, cells: Sequence[Cell]) -> list[Cell]:
        """Return the cells that bricks fill."""
        there = self.owner[_at(cells)] != NOBODY
        return [cell for cell, is_filled in zip(cells, there.tolist(), strict=True) if is_filled]

    def may_change(self, rows: Ints) -> bool:
        """Tell whether no edit put one of these bricks there, and none is a support or of a base."""
        return not self.fixed[rows].any() and bool(self._laid_for_model[rows].all())

    def may_go(self, rows: Ints) -> bool:
        """Tell whether bricks may change, or are slopes, in whose place others can lie."""
        return not self.fixed[rows].any() and bool((self._laid_for_model | self._chosen_before)[rows].all())

    def fix(self, row: int, *, fixed: bool = True) -> None:
        """Let a brick stay, or no longer."""
        self.fixed[row] = fixed

    def shown(self, cells: Sequence[Cell]) -> set[int]:
        """Return the colours that are seen on filled cells, or that edits gave them."""
        filled, at = self.owner != NOBODY, _at(cells)
        own = np.where(visible(filled, outer_air(filled))[at], self.bricks.colour[self.owner[at]], COLOUR_ANY)
        colour = np.where(self.settled[at] == COLOUR_ANY, own, self.settled[at])
        return set(colour[colour != COLOUR_ANY].tolist())

    def lie_in(self, rows: Ints, cells: Sequence[Cell]) -> Mask:
        """Return which bricks, (k,), have no cell but these."""
        inside = np.bincount(self.owner[_at(cells)], minlength=len(self.bricks))
        facts = column_facts(self.bricks, self.catalogue)
        brick = stud_columns(self.bricks, self.catalogue)[0]
        whole: Mask = (inside == np.bincount(brick, facts.high - facts.low, len(self.bricks)))[rows]
        return whole

    def settle(self, cells: Sequence[Cell], colour: int | Plane) -> Plane:
        """Let cells keep a colour, or one each; return those that they had to keep before."""
        before = self.settled[_at(cells)]
        self.settled[_at(cells)] = colour
        return before

    def bar(self, part: int, cells: Sequence[Cell]) -> Bar:
        """Return the bar of a part, (see :class:`~..layout.problem.Bar`), for cells of the grid."""
        marked = np.zeros((self.shape[0] + 2, *self.shape[1:]), dtype=bool)
        z, y, x = _at(cells)
        marked[z + 1, y, x] = True
        return Bar(part, marked)

    def keep(self, bar: Bar) -> None:
        """Keep a part from some cells from now on."""
        self._bars.append(bar)

    def paint(self, rows: Ints, colour: int) -> None:
        """Give bricks another colour."""
        coloured = self.bricks.colour.copy()
        coloured[rows] = colour
        self.bricks = replace(self.bricks, colour=coloured)

    def relay(
        self,
        rows: Ints,
        *,
        put: Edit | None = None,
        emptied: Sequence[Cell] = (),
        bars: Sequence[Bar] = (),
    ) -> str:
        """Lay some bricks anew, and more around them until the model holds together as before.

        Parameters
        ----------
        rows : (k,) int64 array
            Bricks that have to go.
        put : Edit, optional
            Its brick lies there from now on.
        emptied : sequence of (int, int, int)
            Cells that become empty.
        bars : sequence of Bar
            What may not lie where, besides what was kept.

        Returns
        -------
        str
            Empty if it was done; else why not, and nothing has changed.
        """
        reason = APART
        tried: Ints = np.zeros(0, dtype=np.int64)
        for studs, plates in REACHES:
            out = self._around(rows, put, studs, plates)
            if len(out) == len(tried) and studs:
                continue
            tried = out
            try:
                new = self._laid(out, put, emptied, bars)
            except BuildError:
                reason = "no parts that may lie there are made in the colours around it"
                continue
            if self._replaced(out, put, new):
                return ""
            reason = APART
        return reason

    def _around(self, rows: Ints, put: Edit | None, studs: int, plates: int) -> Ints:
        """Return the bricks to be laid anew with some others: what may change in a box around these."""
        marked = np.isin(self.owner, rows)
        if put is not None:
            marked[_at(sorted(put.cells(self.catalogue)))] = True
        box = tuple(
            slice(max(int(each[0]) - reach, 0), int(each[-1]) + reach + 1)
            for each, reach in zip(map(np.unique, np.nonzero(marked)), (plates, studs, studs), strict=True)
        )
        near = np.unique(self.owner[box]) if studs or plates else rows
        near = near[near != NOBODY].astype(np.int64)
        return np.union1d(rows, near[self._laid_for_model[near] & ~self.fixed[near]])

    def _laid(self, out: Ints, put: Edit | None, emptied: Sequence[Cell], bars: Sequence[Bar]) -> Bricks:
        """Lay the cells of bricks anew, but for those that become empty or get a brick."""
        going = np.isin(self.owner, out)
        beside = np.where(going, NOBODY, self.owner)
        ground = ground_of(self.owner != NOBODY)
        if emptied:
            going[_at(emptied)] = False
        if put is not None:
            going[_at(sorted(put.cells(self.catalogue)))] = False
            beside[_at(sorted(put.cells(self.catalogue)))] = len(self.bricks)
        if not going.any():
            return self.bricks.take(np.zeros(0, dtype=np.intp))
        # a few columns are laid much faster than all of them
        (y0, y1), (x0, x1) = (_span(going.any(axis=axes)) for axes in ((0, 2), (0, 1)))
        box = (slice(None), slice(max(y0 - 1, 0), y1 + 2), slice(max(x0 - 1, 0), x1 + 2))
        there = np.pad(beside[box], ((1, 1), (0, 0), (0, 0)), constant_values=NOBODY)
        there[: ground + 1] = GROUND
        manner = Manner("standard", beside=there, bars=tuple(_cut(each, box) for each in (*self._bars, *bars)))
        new = lay_around(self._grid(going, box), self.catalogue, manner, rng=np.random.default_rng(0), filler=FILLER)
        moved = new.corner + np.array([box[2].start, box[1].start, 0], dtype=np.int32)
        return replace(new, corner=moved)

    def _grid(self, going: Mask, box: tuple[slice, ...]) -> UnitGrid:
        """Return cells to be laid in the colours that they show now, or that edits gave them."""
        filled = self.owner != NOBODY
        shown = visible(filled, outer_air(filled))[box]
        going, owner, settled = going[box], self.owner[box], self.settled[box]
        own = np.where(shown, self.bricks.colour[owner], COLOUR_ANY)
        colour = np.where(settled == COLOUR_ANY, own, settled)
        shape = (-1, PLATES_PER_BRICK, *going.shape[1:])
        return UnitGrid(
            colour=np.where(going, colour, COLOUR_EMPTY).astype(np.int16).reshape(shape),
            cover=np.where(going, Fill.REQUIRED, Fill.EMPTY).astype(np.uint8).reshape(shape),
            role=np.where(going, self.bricks.role[owner], Role.SHELL).astype(np.uint8).reshape(shape),
            origin=np.zeros(3),
        )

    def _brick(self, put: Edit) -> Bricks:
        """Return the brick of an edit, in the role of what lies there."""
        rows = self.rows_in(self.filled(sorted(put.cells(self.catalogue))))
        brick = put.brick(self.catalogue)
        return replace(brick, role=self.bricks.role[rows[:1]]) if len(rows) else brick

    def _replaced(self, out: Ints, put: Edit | None, new: Bricks) -> bool:
        """Put bricks in the place of others, if the model holds together as well as before."""
        stay = np.delete(np.arange(len(self.bricks)), out)
        bricks = concatenate([self.bricks.take(stay), new, *([] if put is None else [self._brick(put)])])
        if not len(bricks):
            return False
        order = np.lexsort(tuple(bricks.corner.T))
        fixed = np.concatenate(
            [self.fixed[stay], np.zeros(len(new), bool), np.ones(len(bricks) - len(stay) - len(new))]
        )
        bricks = bricks.take(order)
        graph = contact_graph(bricks, self.catalogue)
        if graph.n_components > self.graph.n_components or graph.n_floating > self.graph.n_floating:
            return False
        self.fixed = fixed.astype(bool)[order]
        self._take(bricks, graph)
        return True


def _at(cells: Sequence[Cell]) -> tuple[Ints, Ints, Ints]:
    """Return the indices (z, y, x) of cells."""
    x, y, z = np.array(cells, dtype=np.int64).reshape(-1, 3).T
    return z, y, x


def _span(marked: Mask) -> tuple[int, int]:
    """Return the first and the last one that is marked."""
    rows = np.flatnonzero(marked)
    return int(rows[0]), int(rows[-1])


def _cut(bar: Bar, box: tuple[slice, ...]) -> Bar:
    """Return a bar in a part of the grid, all planes of it."""
    return Bar(bar.part, bar.cells[:, box[1], box[2]])
