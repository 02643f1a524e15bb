"""Symmetric layouts: one half of the cells is laid, and the other one like it.

A grid whose middle is a plane of symmetry is folded there. Bricks of the half that touch the fold are those that
lie across the plane, cut in two: they count once where all others count twice. Where the plane lies in the middle of
a column of cells, only bricks whose middle is there may cover it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Ints, Mask
from ..geometry import mirror_axis, outer_air
from ..model import COLOUR_ANY, COLOUR_EMPTY, MISSING_CELL, Bricks, Catalogue, Fill, Role, UnitGrid
from .problem import Placements, Problem, Shapes, gather

ACROSS: Final = 0.5
"""What a brick across the plane costs, as a share of two that mirror each other."""

_MIRRORED: Final = tuple(
    np.array([MISSING_CELL.index((1 - x, y) if axis == 0 else (x, 1 - y)) for x, y in MISSING_CELL]) for axis in (0, 1)
)
"""Turns of the images of corner parts, by axis and turn."""

LEAST: Final = 0.98
"""Share of the cells that have an equal image from which on a model is laid symmetrically; others are laid after."""


@dataclass(frozen=True, slots=True, eq=False)
class Fold:
    """Where a grid is folded.

    Attributes
    ----------
    axis : int
        0 if the plane lies across x, 1 if across y.
    length : int
        Cells of the grid along that axis.
    catalogue : Catalogue
    """

    axis: int
    length: int
    catalogue: Catalogue

    @property
    def first(self) -> int:
        """The first cell of the half that is laid."""
        return self.length // 2

    @property
    def odd(self) -> int:
        """1 if the plane lies in the middle of a column of cells, 0 if between two."""
        return self.length % 2

    def half(self, grid: UnitGrid, which: Mask) -> UnitGrid:
        """Return some of the cells of the half that is laid."""
        at = (slice(None), slice(None)) + (slice(None),) * (1 - self.axis) + (slice(self.first, None),)
        return some_cells(UnitGrid(grid.colour[at], grid.cover[at], grid.role[at], grid.origin), which[at])

    def across(self, extent: Ints) -> Ints:
        """Return how long bricks are that lie across the plane, given how far they reach into the half."""
        long: Ints = 2 * extent - self.odd
        return long

    def possible(self, found: Placements, among: Shapes) -> Placements:
        """Return the placements without those that would overlap their images."""
        if not self.odd:
            return found
        lies = found.corner[:, self.axis] == 0
        return found.take(np.flatnonzero(~lies | self._joined(found, among)))

    def priced(self, problem: Problem) -> Problem:
        """Let bricks across the plane count once, and others twice; in bricks of the half."""
        found = problem.placements
        less = (found.corner[:, self.axis] == 0) & self._joined(found, problem.shapes)
        return replace(problem, cost=problem.cost - ACROSS * less)

    def unfold(self, bricks: Bricks) -> Bricks:
        """Return the bricks of both halves, given those of the one that is laid."""
        catalogue, axis = self.catalogue, self.axis
        extent, corner_part = _extents(bricks, catalogue)
        part, there = self._parts_across(extent, catalogue.height[bricks.part], corner_part)
        one = (bricks.corner[:, axis] == 0) & there & catalogue.exists_in(np.maximum(part, 0), bricks.colour)
        own, image = bricks.corner.copy(), bricks.corner.copy()
        own[:, axis] += self.first
        image[:, axis] = self.length - own[:, axis] - extent[:, axis]
        size = extent.copy()
        size[:, axis] = self.across(extent[:, axis])
        whole = replace(
            bricks,
            # what lies across the plane begins where its image does
            corner=np.where(one[:, None], image, own),
            part=np.where(one, part, bricks.part).astype(np.int16),
            turn=np.where(one, size[:, 1] > size[:, 0], bricks.turn).astype(np.uint8),
        )
        turn = np.where(corner_part, _MIRRORED[axis][bricks.turn], bricks.turn).astype(np.uint8)
        return gather([whole, replace(bricks, corner=image, turn=turn).take(np.flatnonzero(~one))])

    def _joined(self, found: Placements, among: Shapes) -> Mask:
        """Tell of placements that touch the plane whether they are one brick with their image."""
        corner = np.prod(among.extent, axis=1) != among.size
        part, there = self._parts_across(among.extent, self.catalogue.height[among.part], corner)
        shape = found.shape
        return there[shape] & self.catalogue.exists_in(np.maximum(part, 0)[shape], found.colour)

    def _parts_across(self, extent: Ints, height: NDArray[np.integer], corner: Mask) -> tuple[Ints, Mask]:
        """Return the parts that lie across the plane and reach into the half as others do, and whether they exist."""
        size = extent.astype(np.int64)
        size[:, self.axis] = self.across(size[:, self.axis])
        known = {
            (part.length, part.width, part.height): row
            for row, part in enumerate(self.catalogue.parts)
            if part.use == "model" and not part.corner
        }
        keys = np.column_stack([size.max(axis=1), size.min(axis=1), height]).tolist()
        part = np.array([known.get(tuple(key), -1) for key in keys], dtype=np.int64)
        return part, (part >= 0) & ~corner


def fold_of(grid: UnitGrid, catalogue: Catalogue) -> Fold | None:
    """Return where a grid is folded, None if it is not symmetric."""
    axis = mirror_axis(grid.solid.reshape(-1, *grid.solid.shape[2:]))
    return None if axis is None else Fold(2 - axis, grid.solid.shape[1 + axis], catalogue)


def mirrored(grid: UnitGrid, fold: Fold) -> tuple[UnitGrid, Mask]:
    """Make what is hidden in a grid symmetric, and tell which of its cells are equal to their image.

    Parameters
    ----------
    grid : UnitGrid
        A hollowed model.
    fold : Fold

    Returns
    -------
    grid : UnitGrid
        Cells inside that have to be built on one side have to be on both.
    same : (n_layers, 3, n_y, n_x) bool array
        Cells that are equal to their image.
    """
    axis = 3 - fold.axis
    colour, cover, role = (np.flip(each, axis) for each in (grid.colour, grid.cover, grid.role))
    solid = grid.solid.reshape(-1, *grid.solid.shape[2:])
    inside = ~outer_air(solid).reshape(grid.solid.shape)
    inside &= np.flip(inside, axis)
    hidden = inside & ((grid.colour == COLOUR_EMPTY) | (grid.colour == COLOUR_ANY) | ~grid.solid)
    hidden &= (colour == COLOUR_ANY) | (colour == grid.colour)
    more = hidden & (cover > grid.cover)
    found = UnitGrid(
        np.where(more, colour, grid.colour),
        np.where(inside & grid.solid | more, np.maximum(cover, grid.cover), grid.cover),
        np.where(more, role, grid.role),
        grid.origin,
    )
    same = (found.colour == np.flip(found.colour, axis)) & (found.cover == np.flip(found.cover, axis))
    plates = np.flip(found.role, axis)
    same &= (found.role == Role.PLATE) == (plates == Role.PLATE)
    return found, same & found.solid


def some_cells(grid: UnitGrid, which: Mask) -> UnitGrid:
    """Return a grid with some of its cells alone."""
    colour = np.where(which, grid.colour, np.int16(COLOUR_EMPTY))
    return replace(grid, colour=colour, cover=np.where(which, grid.cover, np.uint8(Fill.EMPTY)))


def _extents(bricks: Bricks, catalogue: Catalogue) -> tuple[Ints, Mask]:
    """Return how long bricks are along x and y, (n, 2), and which are corners."""
    long = np.array([(part.length, part.width) for part in catalogue.parts], dtype=np.int64)[bricks.part]
    corner = np.array([part.corner for part in catalogue.parts], dtype=bool)[bricks.part]
    return np.where((bricks.turn % 2 == 1)[:, None], long[:, ::-1], long), corner
