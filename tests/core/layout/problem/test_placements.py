"""Sheets, shapes and placements: everything that may be laid, and nothing else."""

from __future__ import annotations

import sys
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.problem.placements import placements
from legorize_addon.core.layout.problem.shapes import shapes
from legorize_addon.core.layout.problem.sheets import split
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill
from tests.core.layout.cells import CATALOGUE, brick_grid

FILLER = 71
RED, WHITE, SAND_GREEN = 4, 15, 378


def shapes_for(grid, height=3):
    """Return the shapes for the colours of a grid."""
    return shapes(CATALOGUE, height, np.unique(grid.colour[grid.colour >= 0]), FILLER)


def cells_of(found, row):
    """Return the numbers of the cells that a placement covers."""
    return found.cells[found.start[row] : found.start[row + 1]]


@pytest.mark.parametrize(("n_y", "n_x"), [(1, 1), (3, 9), (8, 8), (12, 5)])
def test_number_of_placements_in_a_rectangle(n_y, n_x):
    """A shape of w x l fits (n_x - w + 1)(n_y - l + 1) times into a rectangle of one colour."""
    grid = brick_grid(np.full((1, n_y, n_x), RED))
    among = shapes_for(grid)
    found = placements(split(grid)[0], among)
    fits = np.maximum([n_x, n_y] - among.extent + 1, 0).prod(axis=1)
    np.testing.assert_array_equal(np.bincount(found.shape, minlength=24), fits)


grids = st.integers(0, 2**32 - 1)


def random_grid(seed, shape=(2, 5, 6)):
    """Return whole bricks at random: empty, any colour or one of three, must or may."""
    rng = np.random.default_rng(seed)
    colour = rng.choice([COLOUR_EMPTY, COLOUR_ANY, COLOUR_ANY, RED, WHITE, SAND_GREEN], shape)
    cover = np.where(
        colour == COLOUR_EMPTY, Fill.EMPTY, rng.choice([Fill.OPTIONAL, Fill.REQUIRED, Fill.REQUIRED], shape)
    )
    return brick_grid(colour, cover)


@given(grids)
@settings(max_examples=30)
def test_same_as_trying_every_place(seed):
    """The placements of two sheets are exactly those found by trying every shape in every cell."""
    grid = random_grid(seed)
    among = shapes_for(grid)
    (sheets,) = split(grid)
    found = placements(sheets, among)
    expected = set()
    for sheet, row, y, x in product(range(len(sheets)), range(24), range(5), range(6)):
        places = among.cells[row] + [x, y]
        if (places >= [6, 5]).any():
            continue
        colours = set(sheets.colour[sheet, places[:, 1], places[:, 0]].tolist())
        fixed = colours - {COLOUR_ANY}
        required = sheets.required[sheet, places[:, 1], places[:, 0]].any()
        code = fixed.pop() if fixed else int(among.hidden[row])
        if not fixed and code != COLOUR_EMPTY and required and CATALOGUE.exists_in(among.part[row], code):
            expected.add((sheet, row, x, y, code))
    listed = [
        (int(sheet), int(row), int(x), int(y), int(code))
        for row, (x, y, sheet), code in zip(found.shape, found.corner, found.colour, strict=True)
    ]
    assert len(listed) == len(set(listed))
    assert set(listed) == expected
    assert (np.diff(found.key) > 0).all()


@given(grids)
@settings(max_examples=20)
def test_cells_are_those_of_the_shape(seed):
    """The cells of a placement are the shape's, moved to its corner, in the numbering of the sheets."""
    grid = random_grid(seed)
    among = shapes_for(grid)
    (sheets,) = split(grid)
    found = placements(sheets, among)
    sheet, y, x = np.unravel_index(sheets.cells, sheets.colour.shape)
    for row in range(0, len(found), 7):
        cells = cells_of(found, row)
        np.testing.assert_array_equal(
            np.stack([x, y], axis=1)[cells], among.cells[found.shape[row]] + found.corner[row, :2]
        )
        assert (sheet[cells] == found.corner[row, 2]).all()


@given(st.integers(0, 2**32 - 1))
def test_entries_are_cells_of_their_shapes(seed):
    """Corner and cell of the shape together are the cell that is covered, entry by entry."""
    grid = random_grid(seed)
    (sheets,) = split(grid)
    among = shapes_for(grid)
    found = placements(sheets, among)
    at = np.concatenate(among.cells)[found.in_shapes(among)] + np.repeat(found.corner[:, :2], found.size, axis=0)
    _, y, x = np.unravel_index(sheets.cells[found.cells], sheets.colour.shape)
    np.testing.assert_array_equal(at, np.stack([x, y], axis=1))


def test_lookups():
    """Placements are found by shape and corner, by the cells they cover, and summed over."""
    found = placements(split(random_grid(1))[0], shapes_for(random_grid(1)))
    rows = np.arange(len(found))
    np.testing.assert_array_equal(found.find(found.shape, found.corner), rows)
    assert found.find(np.array([0]), np.array([[99, 0, 0]])).tolist() == [-1]
    marked = np.zeros(found.cells.max() + 1, bool)
    marked[::5] = True
    totals = [np.count_nonzero(marked[cells_of(found, row)]) for row in rows]
    assert found.totals(marked).tolist() == totals
    np.testing.assert_array_equal(found.through(marked), np.flatnonzero(totals))
    some = np.array([3, 5, 8])
    np.testing.assert_array_equal(found.take(some).cells, np.concatenate([cells_of(found, row) for row in some]))


def test_only_parts_that_exist():
    """A part that is not made in a colour is not offered in it, though it would fit."""
    part = CATALOGUE.part_row("3007")
    missing = int(CATALOGUE.codes[~CATALOGUE.exists[part]][0])
    grid = brick_grid(np.full((1, 2, 8), missing))
    among = shapes_for(grid)
    found = placements(split(grid)[0], among)
    assert len(found) > 0
    assert part not in among.part[found.shape]


def test_placements_are_found_on_many_sheets():
    """Three hundred sheets of one cell: each placement has a key of its own, in their order."""
    grid = brick_grid(np.full((300, 1, 1), RED))
    found = placements(split(grid)[0], shapes_for(grid))
    assert len(found) == 300
    assert (np.diff(found.key) > 0).all()
    np.testing.assert_array_equal(found.find(found.shape, found.corner), np.arange(300))


@given(grids)
@settings(max_examples=20)
def test_portions_of_sheets_change_nothing(seed):
    """Sheet by sheet, two at a time or all at once, the placements are the same."""
    grid = random_grid(seed, (5, 3, 4))
    found = []
    for entries in (1, 2 * 12, 1 << 16):
        with pytest.MonkeyPatch.context() as patched:
            patched.setattr(sys.modules[placements.__module__], "_ENTRIES", entries)
            found.append(placements(split(grid)[0], shapes_for(grid)))
    for name in ("shape", "corner", "colour", "cells", "start", "key"):
        for other in found[1:]:
            np.testing.assert_array_equal(getattr(found[0], name), getattr(other, name))
