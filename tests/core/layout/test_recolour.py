"""Bricks of free colour that can be seen take a colour from what they hold."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.layout.recolour import recolour_visible
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill, UnitGrid
from tests.core.standing import table

CATALOGUE = load_catalogue()
RED, BLACK, FILLER = 4, 0, 71


def coloured(rows, colours, free):
    """Return the colours of bricks afterwards, of which some are free and laid in the filler's colour."""
    bricks = table(*rows)
    bricks = replace(bricks, colour=np.where(free, FILLER, colours).astype(np.int16))
    graph = contact_graph(bricks, CATALOGUE)
    # the grid has a margin of a cell, as models have
    cells = np.pad(graph.owner, ((0, -len(graph.owner) % 3), (0, 1), (0, 1)), constant_values=-1)
    colour = np.where(cells < 0, COLOUR_EMPTY, np.where(np.append(free, False)[cells], COLOUR_ANY, RED))
    colour = colour.reshape(-1, 3, *cells.shape[1:]).astype(np.int16)
    cover = np.where(colour == COLOUR_EMPTY, Fill.EMPTY, Fill.REQUIRED).astype(np.uint8)
    grid = UnitGrid(colour, cover, np.zeros_like(cover), np.zeros(3))
    found = recolour_visible(bricks, grid, graph, CATALOGUE)
    assert np.array_equal(found.corner, bricks.corner)
    return found.colour.tolist()


def test_plate_under_a_roof_takes_its_colour():
    """A free plate under a red roof is seen from below: it becomes red; the roof stays."""
    assert coloured([("3001", 1, 1, 1), ("3020", 1, 1, 0)], [RED, 0], [False, True]) == [RED, RED]


def test_most_of_what_lies_above_counts():
    """Under three black studs and one red one a free brick becomes black."""
    rows = [("3622", 1, 1, 3), ("3005", 4, 1, 3), ("3010", 1, 1, 0)]
    assert coloured(rows, [BLACK, RED, 0], [False, False, True])[2] == BLACK


def test_without_anything_above_the_sides_count():
    """A free brick beside a red one takes red."""
    assert coloured([("3005", 1, 1, 0), ("3005", 2, 1, 0)], [RED, 0], [False, True]) == [RED, RED]


def test_what_is_held_counts_before_all_beside():
    """Under one red stud, between two long black beams, a free beam becomes red."""
    rows = [("3005", 1, 2, 3), ("3008", 1, 2, 0), ("3008", 1, 1, 0), ("3008", 1, 3, 0)]
    assert coloured(rows, [RED, 0, BLACK, BLACK], [False, True, False, False])[1] == RED


def test_colour_is_handed_on():
    """Under a free plate that becomes red, another one becomes red as well."""
    rows = [("3001", 1, 1, 2), ("3020", 1, 1, 1), ("3023", 2, 1, 0)]
    assert coloured(rows, [RED, 0, 0], [False, True, True]) == [RED, RED, RED]


@pytest.mark.parametrize("ground", [0, 1])
def test_what_nobody_sees_stays(ground):
    """A free brick on the ground with bricks on all other sides keeps the filler's colour."""
    walls = [("3009", 1, 1, 0), ("3009", 1, 3, 0), ("3005", 1, 2, 0), ("3005", 6, 2, 0)]
    lid = [("3001", 1, 1, 3), ("3003", 5, 1, 3), ("3009", 1, 3, 3)]
    rows = [(part, x, y, z + ground) for part, x, y, z in [*walls, *lid, ("3010", 2, 2, 0)]]
    assert coloured(rows, [RED] * len(rows), [False] * (len(rows) - 1) + [True])[-1] == FILLER


def test_colour_must_exist_for_the_part():
    """Where the part is not made in the commonest colour above, the next one is taken, or none."""
    plate = CATALOGUE.part_row("3034")
    never = next(int(code) for code in CATALOGUE.codes if not CATALOGUE.exists_in(plate, code))
    assert coloured([("3007", 1, 1, 1), ("3034", 1, 1, 0)], [never, 0], [False, True]) == [never, FILLER]
    rows = [("3002", 1, 1, 1), ("3001", 4, 1, 1), ("3005", 8, 1, 1), ("3034", 1, 1, 0)]
    assert coloured(rows, [never, never, RED, 0], [False, False, False, True])[3] == RED


@pytest.mark.parametrize("step", [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 3), (0, 0, -3)])
def test_a_colour_comes_from_each_side(step):
    """A free brick has one coloured neighbour: before, behind, beside, above or below it."""
    place = [2 + step[0], 2 + step[1], 3 + step[2]]
    assert coloured([("3005", 2, 2, 3), ("3005", *place)], [0, RED], [True, False]) == [RED, RED]
    apart = [2 + 2 * step[0], 2 + 2 * step[1], 3 + step[2]]
    if not step[2]:
        assert coloured([("3005", 2, 2, 3), ("3005", *apart)], [0, RED], [True, False]) == [FILLER, RED]
