"""Random maximal merging: bricks of one stud grow by their neighbours until none can grow any more.

References
----------
R. Testuz, Y. Schwartzburg and M. Pauly, "Automatic generation of constructable
brick sculptures", Eurographics 2013 (short papers), where a brick taken by chance
grows until it cannot; S.-J. Luo et al., "Legolization: optimizing LEGO designs",
ACM TOG 34(6), 2015, which begins from such a layout.
"""

from __future__ import annotations

import numpy as np

from legorize_addon.core.layout.problem.problem import Problem
from legorize_addon.core.layout.problem.shapes import Shapes
from scripts.research.rules import Index

_SHEET, _SHAPE, _ROW = 40, 32, 16
"""Bits below sheet, shape and y in the keys of placements."""


def merged(problem: Problem, rng: np.random.Generator) -> Index:
    """Merge unit bricks by chance until nothing can be merged.

    Parameters
    ----------
    problem : Problem
        All sheets; every cell has to be covered.
    rng : numpy.random.Generator
        Which brick grows next, and by which neighbour.

    Returns
    -------
    (n_bricks,) intp array
        Rows of the placements.
    """
    growth = _Growth(problem)
    order = rng.permutation(len(problem.required)).tolist()
    # what could not grow may when its neighbours have
    while sum(growth.grow(cell, rng) for cell in order):
        pass
    return np.unique(growth.brick).astype(np.intp)


class _Growth:
    """A layout that only ever merges.

    Attributes
    ----------
    brick : list of int
        Row of the placement that lies on each cell.
    """

    def __init__(self, problem: Problem) -> None:
        found = problem.placements
        self._row = {key: row for row, key in enumerate(found.key.tolist())}
        self._key = found.key.tolist()
        self._cells = [part.tolist() for part in np.split(found.cells, found.start[1:-1])]
        self._beside = neighbours(problem)
        self._unions = Unions(problem.shapes)
        single = np.flatnonzero(found.size == 1)
        self.brick = [-1] * len(problem.required)
        for cell, row in zip(found.cells[found.start[single]].tolist(), single.tolist(), strict=True):
            self.brick[cell] = row

    def grow(self, cell: int, rng: np.random.Generator) -> bool:
        """Let the brick on a cell grow as long as it can, and tell whether it did."""
        grown = False
        while choice := self._larger(self.brick[cell]):
            row = choice[int(rng.random() * len(choice))]
            for each in self._cells[row]:
                self.brick[each] = row
            grown = True
        return grown

    def _larger(self, row: int) -> list[int]:
        """Return the placements that a brick and one neighbour could become."""
        around = {self.brick[other]: None for cell in self._cells[row] for other in self._beside[cell]}
        around.pop(row, None)
        keys = (self._unions.key(self._key[row], self._key[other]) for other in around)
        return [self._row[key] for key in keys if key in self._row]


def neighbours(problem: Problem) -> list[list[int]]:
    """Return the numbers of the cells beside each cell of its sheet."""
    number = np.full(np.add(problem.sheets.colour.shape, (0, 2, 2)), -1)
    x, y, sheet = problem.corner.T
    number[sheet, y + 1, x + 1] = np.arange(len(x))
    steps = ((0, 1), (0, -1), (1, 0), (-1, 0))
    beside = np.stack([number[sheet, y + 1 + up, x + 1 + right] for up, right in steps], axis=1)
    return [[other for other in row if other >= 0] for row in beside.tolist()]


class Unions:
    """What two placements side by side make together, remembered by their shapes and their offset."""

    def __init__(self, shapes: Shapes) -> None:
        self._cells = [frozenset(map(tuple, cells.tolist())) for cells in shapes.cells]
        self._shape = {cells: shape for shape, cells in enumerate(self._cells)}
        self._known: dict[tuple[int, int, int, int], tuple[int, int, int] | None] = {}

    def key(self, one: int, other: int) -> int:
        """Return the key of the placement that covers the cells of two others, -1 if there is no such shape."""
        first, second = (one >> _SHAPE) & 0xFF, (other >> _SHAPE) & 0xFF
        x, y = one & 0xFFFF, (one >> _ROW) & 0xFFFF
        question = (first, second, (other & 0xFFFF) - x, ((other >> _ROW) & 0xFFFF) - y)
        if question not in self._known:
            self._known[question] = self._union(*question)
        if (found := self._known[question]) is None:
            return -1
        shape, left, down = found
        return (one >> _SHEET << _SHEET) | (shape << _SHAPE) | ((y + down) << _ROW) | (x + left)

    def _union(self, first: int, second: int, right: int, up: int) -> tuple[int, int, int] | None:
        """Return the shape of the union and where its corner lies from that of the first shape."""
        cells = self._cells[first] | {(x + right, y + up) for x, y in self._cells[second]}
        left, down = min(right, 0), min(up, 0)
        shape = self._shape.get(frozenset((x - left, y - down) for x, y in cells))
        return None if shape is None else (shape, left, down)
