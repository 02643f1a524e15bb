"""A layer upon another one: the energy of Min, Park, Yang and Yun, prepared for searching.

A *seam* is an edge between two cells of the layer under which two bricks of the
layer below meet. A brick that covers both cells bridges it; else the seams of
both layers coincide there. A seam that coincides costs more the farther the next
bridge is along its line.

References
----------
K. Min, C. Park, H. Yang and G. Yun, "Legorization from silhouette-fitted
voxelization", KSII TIIS 12(6), 2018: ``G = w_s g_s + w_a g_a + w_h g_h``. That
the distance runs along the seam is our reading.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array

from legorize_addon.core.layout.problem.problem import Problem
from legorize_addon.core.layout.problem.shapes import Shapes, pattern_bits
from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY
from scripts.research.rules import Index

Plane = NDArray[np.int32]

NEAR: Final = 2
"""Edges along a seam within which a bridge is near."""

PENALTY: Final = (0.1, 0.5, 1.0)
"""Of a seam that coincides: with a bridge near, farther away, and without one on its line."""

Weights = tuple[float, float, float]
"""Of stability, aesthetics (mirror symmetry) and efficiency in the energy."""

EQUAL: Final[Weights] = (1.0, 1.0, 1.0)
"""As published."""

FEW: Final[Weights] = (0.1, 0.1, 1.0)
"""For few bricks: with equal weights up to half as many again are laid."""

LARGEST: Final = 16
"""Cells of the largest brick."""


@dataclass(frozen=True, slots=True, eq=False)
class Layer:
    """A layer to be laid, in Python's own numbers: searching looks at single placements.

    Attributes
    ----------
    problem : Problem
        One sheet.
    cells : list of list of int
        Cells of each placement.
    mask : list of int
        The same as bits.
    first : list of list of int
        Placements by the first cell that they cover, the largest ones first.
    mirror : list of int
        Mirror image of each placement: itself if it lies across the axis, -1 if
        there is none in its colour.
    bridged : list of int
        Seams that each placement bridges, as bits.
    rim : list of list of int
        Seams on the rim of each placement.
    near, line : list of int
        Seams near each seam and all on its line, as bits.
    """

    problem: Problem
    cells: list[list[int]]
    mask: list[int]
    first: list[list[int]]
    mirror: list[int]
    bridged: list[int]
    rim: list[list[int]]
    near: list[int]
    line: list[int]

    @classmethod
    def of(cls, problem: Problem, below: Plane) -> Layer:
        """Prepare a layer; `below` are the bricks of the layer below, (n_y, n_x), ``NOBODY`` where there is none."""
        found = problem.placements
        cells = [part.tolist() for part in np.split(found.cells, found.start[1:-1])]
        order = np.lexsort((np.arange(len(found)), -found.size)).tolist()
        first: list[list[int]] = [[] for _ in problem.required]
        for row in order:
            first[min(cells[row])].append(row)
        pairs, line, place = _seams(problem, below)
        once, twice = _touched(problem, pairs)
        same = [np.flatnonzero(line == number) for number in line]
        near = [each[np.abs(place[each] - here) <= NEAR] for each, here in zip(same, place, strict=True)]
        return cls(
            problem=problem,
            cells=cells,
            mask=[bits(row) for row in cells],
            first=first,
            mirror=_mirror(problem).tolist(),
            bridged=[bits(row) for row in twice],
            rim=once,
            near=[bits(each.tolist()) for each in near],
            line=[bits(each.tolist()) for each in same],
        )

    def penalty(self, seam: int, bridged: int) -> float:
        """Return what a seam that coincides costs, given the bridged seams as bits."""
        if self.near[seam] & bridged:
            return PENALTY[0]
        return PENALTY[1] if self.line[seam] & bridged else PENALTY[2]

    def energies(self, chosen: Index) -> tuple[float, float, float]:
        """Return stability, aesthetics and efficiency of a whole layout, each 0 at best and 1 at worst."""
        rows = chosen.tolist()
        bridged = 0
        for row in rows:
            bridged |= self.bridged[row]
        loss = sum(self.penalty(seam, bridged) for seam in range(len(self.near)) if not bridged >> seam & 1)
        laid = set(rows)
        alone = sum(self.mirror[row] not in laid for row in rows)
        size = self.problem.placements.size[chosen]
        efficiency = float((LARGEST - size).mean()) / (LARGEST - 1)
        return loss / max(len(self.near), 1), alone / len(rows), efficiency


def bits(numbers: list[int]) -> int:
    """Return a number with the given bits."""
    made = 0
    for number in numbers:
        made |= 1 << number
    return made


def _seams(problem: Problem, below: Plane) -> tuple[Index, Index, Index]:
    """Return the cells beside each seam, (m, 2), the number of its line and its place on that, (m,)."""
    [colour] = problem.sheets.colour
    number = np.full(colour.shape, NOBODY)
    number[colour != COLOUR_EMPTY] = np.arange(len(problem.required))
    pairs, lines, places = [], [], []
    for cells, under in ((number, below), (number.T, below.T)):
        there = (cells[:, :-1] >= 0) & (cells[:, 1:] >= 0) & (under[:, :-1] >= 0) & (under[:, 1:] >= 0)
        # column after column, so that seams on one line follow one another
        across, along = np.nonzero((there & (under[:, :-1] != under[:, 1:])).T)
        broken = (np.diff(along, prepend=-1) != 1) | (np.diff(across, prepend=-1) != 0)
        pairs.append(np.stack([cells[along, across], cells[along, across + 1]], axis=1))
        lines.append(np.cumsum(broken) + sum(len(each) for each in lines))
        places.append(along)
    return np.concatenate(pairs), np.concatenate(lines), np.concatenate(places)


def _touched(problem: Problem, pairs: Index) -> tuple[list[list[int]], list[list[int]]]:
    """Return the seams of which each placement covers one cell, and those of which it covers both."""
    found = problem.placements
    n, m, n_cells = len(found), len(pairs), len(problem.required)
    if m == 0:
        return [[] for _ in range(n)], [[] for _ in range(n)]
    covers = coo_array(
        (np.ones(len(found.cells), dtype=np.int8), (np.repeat(np.arange(n), found.size), found.cells)),
        shape=(n, n_cells),
    )
    beside = coo_array((np.ones(2 * m, dtype=np.int8), (pairs.ravel(), np.repeat(np.arange(m), 2))), shape=(n_cells, m))
    counts = (covers.tocsr() @ beside.tocsr()).tocoo()
    return tuple(_by_row(counts.row[counts.data == k], counts.col[counts.data == k], n) for k in (1, 2))


def _by_row(row: Index, column: Index, n: int) -> list[list[int]]:
    order = np.lexsort((column, row))
    ends = np.cumsum(np.bincount(row, minlength=n))[:-1]
    return [part.tolist() for part in np.split(column[order], ends)]


def _mirror(problem: Problem) -> Index:
    """Return the mirror image of each placement, at the axis that more cells have an image at."""
    found, among = problem.placements, problem.shapes
    there = problem.sheets.colour[0] != COLOUR_EMPTY
    y, x = np.nonzero(there)
    box = there[y.min() : y.max() + 1, x.min() : x.max() + 1]
    axis = 0 if (box & box[:, ::-1]).sum() >= (box & box[::-1]).sum() else 1
    ends = (x, y)[axis].min() + (x, y)[axis].max()
    shape = _mirrored(among, axis)[found.shape]
    corner = found.corner.copy()
    corner[:, axis] = ends - found.corner[:, axis] - among.extent[found.shape, axis] + 1
    inside = (corner >= 0).all(axis=1)
    image = np.where(inside, found.find(shape, np.maximum(corner, 0)), NOBODY)
    return np.where(found.colour[image] == found.colour, image, NOBODY)


def _mirrored(among: Shapes, axis: int) -> Index:
    """Return the row of each shape's mirror image."""
    rows = {int(pattern): row for row, pattern in enumerate(among.pattern)}
    images = []
    for cells, extent in zip(among.cells, among.extent, strict=True):
        image = cells.copy()
        image[:, axis] = extent[axis] - 1 - cells[:, axis]
        images.append(rows[int(pattern_bits(*image.T, among.side).sum())])
    return np.array(images)
