"""A grid split into sheets: every cell in one, whole bricks where three plates agree."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.layout.problem.sheets import split
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY
from tests.core.layout.cells import grid_of, planes

RED, WHITE = 4, 15


@given(st.integers(0, 2**32 - 1))
def test_every_cell_lies_in_one_sheet(seed):
    """Bricks and plates together hold every plate cell once, with its colour, and bricks are all they can be."""
    rng = np.random.default_rng(seed)
    colour = rng.choice([COLOUR_EMPTY, COLOUR_ANY, RED, WHITE], (3, 1, 4, 4))
    colour = np.where(rng.random((3, 3, 4, 4)) < 0.2, rng.choice([COLOUR_EMPTY, RED], (3, 3, 4, 4)), colour)
    grid = grid_of(colour)
    times = np.zeros(planes(grid.colour).shape, int)
    for sheets in split(grid):
        for level, code in zip(sheets.level, sheets.colour, strict=True):
            filled = code != COLOUR_EMPTY
            assert filled.any()
            for plate in range(level, level + sheets.height):
                times[plate] += filled
                assert np.isin(planes(grid.colour)[plate][filled], [COLOUR_ANY, *np.unique(code[filled])]).all()
                free = planes(grid.colour)[plate] == COLOUR_ANY
                assert (free | (planes(grid.colour)[plate] == code) | ~filled).all()
    np.testing.assert_array_equal(times, planes(grid.solid).astype(int))


def test_three_equal_plates_are_a_brick():
    """Columns of one colour are bricks, columns with a gap or two colours are plates."""
    colour = np.full((1, 3, 1, 4), RED)
    colour[0, 2, 0, 1] = COLOUR_EMPTY
    colour[0, 1, 0, 2] = WHITE
    colour[0, :2, 0, 3] = COLOUR_ANY
    bricks, plates = split(grid_of(colour))
    assert (bricks.height, plates.height) == (3, 1)
    assert bricks.colour[0, 0].tolist() == [RED, COLOUR_EMPTY, COLOUR_EMPTY, RED]
    assert plates.level.tolist() == [0, 1, 2]
    for sheets in (bricks, plates):
        np.testing.assert_array_equal(sheets.required, sheets.colour != COLOUR_EMPTY)
