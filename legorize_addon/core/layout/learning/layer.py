"""One layer as the learned fill meets it: what may lie there, and what each brick adds to the paper's energies.

Two of the four energies, stability and efficiency, are sums over bricks of what
each has by itself once the layer below is laid. So they are computed for all
placements at once, before anything is laid; only pairs of 1 x 1 bricks and mirror
images are matters of two bricks.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from scipy.ndimage import label

from ...arrays import Floats, Mask
from ...model import COLOUR_ANY, NOBODY
from ..problem import Index, Plane, Problem, Rows, Shapes, part_costs
from ..solvers import guessed_prices
from .energies import CORNER_AREA, LARGEST, RING

SINGLE: Final = 0.5
LOOSE: Final = 0.5
LONELY: Final = 0.1
HANGING: Final = 2.0
OPTIONAL: Final = 0.004
"""What a brick costs besides itself, in bricks: being a 1 x 1; its horizontal
instability; having no mirror image; having nothing below and nothing above; each
cell that need not be covered. These weights are the ones that "fewest bricks, then
the paper's energies" stands for: changing them means training anew."""


@dataclass(frozen=True, slots=True, eq=False)
class Layer:
    """The placements of one sheet, and what each brings along.

    Attributes
    ----------
    problem : Problem
        Of one sheet.
    colour : (n_cells,) int16 array
        LDraw code of each cell, or ``COLOUR_ANY``.
    polygon : (n_cells,) intp array
        Number of the polygon of each cell: of the region of its colour that touches, corners included.
    cells : (n, k) intp array
        Cells of each placement, filled up with the number of cells.
    home : (n,) intp array
        A cell of each placement, of its colour where it has one.
    single : (n,) bool array
        Whether it is a 1 x 1.
    unstable : (n,) float64 array
        Its vertical and its horizontal term of the stability.
    small : (n,) float64 array
        Its term of the efficiency, (16 - A) / 15.
    cost : (n,) float64 array
        What it costs in bricks, but for its mirror image.
    mirror : (2, n) intp array
        Row of its mirror image along x and along y, the number of placements where nothing may lie there.
    ranks : (3, n) intp array
        Three orders in which simulations lay: the cheapest for what its cells are
        estimated to be worth first, for each required cell, and the one with most required cells.
    """

    problem: Problem
    colour: Plane
    polygon: Index
    cells: Index
    home: Index
    single: Mask
    unstable: Floats
    small: Floats
    cost: Floats
    mirror: Index
    ranks: Index

    @classmethod
    def of(cls, problem: Problem, below: Rows, above: Mask) -> Layer:
        """Prepare a layer.

        Parameters
        ----------
        problem : Problem
            Of one sheet with at least one placement.
        below : (n_y, n_x) int array
            Brick in each cell below, ``NOBODY`` or ``GROUND``.
        above : (n_y, n_x) bool array
            Cells above that are or will be built.

        Returns
        -------
        Layer
        """
        found, among, sheets = problem.placements, problem.shapes, problem.sheets
        at = sheets.cells
        size = found.size
        carried, covered = (each.reshape(-1)[at] for each in (below != NOBODY, above))
        bare = 2 - (found.totals(carried) + found.totals(covered)) / size
        loose = (RING - _bridged(problem, below)) / RING
        corner = np.array([len(each) for each in among.cells]) < among.extent.prod(axis=1)
        area = np.where(corner[found.shape], CORNER_AREA, size)
        cost = part_costs(found, among, sheets) + SINGLE * (size == 1) + LOOSE * loose + HANGING * (bare == 2)
        cost += OPTIONAL * found.totals(~problem.required)
        colour = sheets.colour.reshape(-1)[at]
        cells = _padded(problem)
        coloured = np.append(colour != COLOUR_ANY, False)[cells]
        return cls(
            problem=problem,
            colour=colour,
            polygon=_polygons(sheets.colour[0]).reshape(-1)[at],
            cells=cells,
            home=cells[np.arange(len(found)), coloured.argmax(axis=1)],
            single=size == 1,
            # the layer above is not laid yet: nothing there holds on to a brick
            unstable=bare + loose + 1,
            small=(LARGEST - area) / (LARGEST - 1),
            cost=cost,
            mirror=_mirror_images(problem),
            ranks=_ranks(problem, cost),
        )

    def may_join(self, cell: int) -> Mask:
        """Return which cells may be part of a brick together with one cell, by their colours."""
        code = self.colour[cell]
        joined: Mask = (self.colour == code) | (self.colour == COLOUR_ANY) | (code == COLOUR_ANY)
        return joined


def _polygons(plane: Plane) -> Index:
    """Return a number for each region of one colour, (n_y, n_x)."""
    number = np.zeros(plane.shape, dtype=np.intp)
    first = 0
    for code in np.unique(plane):
        parts, count = label(plane == code, structure=np.ones((3, 3)))
        number[parts > 0] = parts[parts > 0] + first
        first += count
    return number


def _padded(problem: Problem) -> Index:
    """Return the cells of each placement in a row, filled up with the number of cells."""
    found = problem.placements
    table = np.full((len(found), int(found.size.max())), len(problem.required), dtype=np.intp)
    table[np.arange(table.shape[1]) < found.size[:, None]] = found.cells
    return table


def _ranks(problem: Problem, cost: Floats) -> Index:
    """Return the place of each placement in the three orders, (3, n)."""
    found = problem.placements
    needed = found.totals(problem.required)
    price = guessed_prices(replace(problem, cost=cost))
    worth = np.add.reduceat(price[found.cells], found.start[:-1])
    ranks = np.empty((3, len(found)), dtype=np.intp)
    # rounded, so that sums in another order do not change who comes first
    for rank, key in zip(ranks, (cost - worth, cost / needed, -needed + found.size / (LARGEST + 1)), strict=True):
        rank[np.lexsort((np.arange(len(found)), np.round(key, 9)))] = np.arange(len(found))
    return ranks


def _bridged(problem: Problem, below: Rows) -> Index:
    """Count, for each placement, the cells around it over bricks of the layer below that it lies on as well."""
    found, among = problem.placements, problem.shapes
    margin = 1
    beneath = np.pad(np.where(below > NOBODY, below, NOBODY), margin, constant_values=NOBODY)
    bridged = np.zeros(len(found), dtype=np.intp)
    for shape in np.unique(found.shape):
        rows = np.flatnonzero(found.shape == shape)
        x, y = found.corner[rows, :2].T + margin
        own, around = among.cells[shape], _ring(among.cells[shape])
        under = beneath[y[:, None] + own[:, 1], x[:, None] + own[:, 0]]
        near = beneath[y[:, None] + around[:, 1], x[:, None] + around[:, 0]]
        same = (near[:, :, None] == under[:, None, :]) & (near != NOBODY)[:, :, None]
        bridged[rows] = same.any(axis=2).sum(axis=1)
    return np.minimum(bridged, RING)


def _ring(cells: Rows) -> Rows:
    """Return the cells around a shape, corners included."""
    steps = np.array([(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)], dtype=np.int32)
    every = np.unique((cells[:, None] + steps).reshape(-1, 2), axis=0)
    ring: Rows = every[~(every[:, None] == cells).all(axis=2).any(axis=1)]
    return ring


def _mirror_images(problem: Problem) -> Index:
    """Find the row of the mirror image of each placement, along x and along y, about the middle of the layer."""
    found, among = problem.placements, problem.shapes
    needed = problem.corner[problem.required, :2]
    ends = needed.min(axis=0) + needed.max(axis=0) + 1
    images = np.full((2, len(found)), len(found), dtype=np.intp)
    for axis in range(2):
        shape = _mirrored_shapes(among, axis)[found.shape]
        corner = found.corner.astype(np.intp)
        corner[:, axis] = ends[axis] - corner[:, axis] - among.extent[found.shape, axis]
        inside = np.flatnonzero((corner >= 0).all(axis=1) & (shape >= 0))
        rows = found.find(shape[inside], corner[inside])
        same = (rows >= 0) & (found.colour[rows] == found.colour[inside])
        images[axis, inside[same]] = rows[same]
    return images


def _mirrored_shapes(among: Shapes, axis: int) -> Index:
    """Return the row of the mirror image of each shape, -1 where there is none."""
    known = {frozenset(map(tuple, cells.tolist())): row for row, cells in enumerate(among.cells)}
    rows = []
    for cells, extent in zip(among.cells, among.extent, strict=True):
        flipped = cells.copy()
        flipped[:, axis] = extent[axis] - 1 - flipped[:, axis]
        rows.append(known.get(frozenset(map(tuple, flipped.tolist())), -1))
    return np.array(rows, dtype=np.intp)
