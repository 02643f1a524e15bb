"""The layouts of the field on a model of bricks: one way over all layers, or layer by layer upwards."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from legorize_addon.core.layout.lay import FILLER
from legorize_addon.core.layout.problem.placements import placements
from legorize_addon.core.layout.problem.problem import Problem, pose, with_margins
from legorize_addon.core.layout.problem.shapes import shapes
from legorize_addon.core.layout.problem.sheets import split
from legorize_addon.core.layout.problem.table import brick_table, gather
from legorize_addon.core.model.bricks import NOBODY, Bricks
from legorize_addon.core.model.catalogue import Catalogue
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, Fill, UnitGrid
from legorize_addon.core.shell.hollowing import hollow
from legorize_addon.core.units import PLATES_PER_BRICK
from scripts.research.rules import Index, Way
from scripts.research.seams import Layer

Lay = Callable[[UnitGrid, Catalogue, np.random.Generator], Bricks]
LayerWay = Callable[[Layer, np.random.Generator], Index]


def at_once(way: Way) -> Lay:
    """Return a layout whose layers know nothing of each other."""

    def laid(grid: UnitGrid, catalogue: Catalogue, rng: np.random.Generator) -> Bricks:
        problem = posed(grid, catalogue)
        return gather([brick_table(problem, way(problem, rng))])

    return laid


def upwards(way: LayerWay) -> Lay:
    """Return a layout of one layer after the other, each of which knows the one below."""

    def laid(grid: UnitGrid, catalogue: Catalogue, rng: np.random.Generator) -> Bricks:
        below = np.full(grid.colour.shape[2:], NOBODY, dtype=np.int32)
        level, tables = 0, []
        for problem in layers(posed(grid, catalogue)):
            [above] = problem.sheets.level
            if above > level:
                below[:] = NOBODY
            chosen = way(Layer.of(problem, below), rng)
            below = np.full_like(below, NOBODY)
            below.reshape(-1)[problem.sheets.cells] = problem.owner(chosen)
            tables.append(brick_table(problem, chosen))
            level = above + PLATES_PER_BRICK
        return gather(tables)

    return laid


def posed(grid: UnitGrid, catalogue: Catalogue) -> Problem:
    """Return the task of laying all layers of a model of bricks."""
    [sheets] = split(grid)
    codes = np.unique(grid.colour[grid.colour >= 0])
    among = shapes(catalogue, PLATES_PER_BRICK, codes, FILLER)
    required = with_margins(grid.cover == Fill.REQUIRED, False)
    return pose(sheets, among, placements(sheets, among), np.full(required.shape, NOBODY, dtype=np.int32), required)


def layers(problem: Problem) -> Iterator[Problem]:
    """Yield the task of each layer, upwards."""
    sheets, cell_sheet = problem.sheets, problem.corner[:, 2]
    for row in range(len(sheets)):
        found = problem.placements.on(np.array([row]), sheets.n_cells)
        corner = problem.corner[cell_sheet == row] - (0, 0, row)
        cost = problem.cost[problem.placements.corner[:, 2] == row]
        required = problem.required[cell_sheet == row]
        yield Problem(sheets.take(np.array([row])), problem.shapes, found, required, corner, cost)


def shell_of(grid: UnitGrid, thickness: int, *, columns: bool) -> UnitGrid:
    """Return a grid whose shell must be built, perhaps with columns that carry its ceilings, and nothing else may.

    Parameters
    ----------
    grid : UnitGrid
        The solid model.
    thickness : int
        Cells of the shell.
    columns : bool
        Whether ceilings inside are carried.

    Returns
    -------
    UnitGrid
    """
    shell = hollow(grid, shell=thickness, ceilings="pillars" if columns else "free")
    required = shell.cover == Fill.REQUIRED
    cover = np.where(required, shell.cover, np.uint8(Fill.EMPTY))
    return replace(shell, cover=cover, colour=np.where(required, shell.colour, np.int16(COLOUR_EMPTY)))
