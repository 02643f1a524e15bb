"""The grid of unit bricks."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.model.bricks import Bricks, Role
from legorize_addon.core.model.unit_grid import CELL_SIZE, COLOUR_ANY, COLOUR_EMPTY, Fill, UnitGrid, ground_of
from legorize_addon.core.units import BRICK, LDU_PER_MM, PLATE, PLATE_LDU, PLATES_PER_BRICK, STUD, STUD_LDU


def bricks(n: int) -> Bricks:
    """Make a table of n rows, each value telling its row."""
    row = np.arange(n)
    kinds = {"part": np.int16, "corner": np.int32, "turn": np.uint8, "colour": np.int16, "role": np.uint8,
             "piece": np.int16, "step": np.int32}  # fmt: skip
    columns = {name: row.astype(kind) for name, kind in kinds.items()}
    columns["corner"] = np.column_stack([row, row, row]).astype(np.int32)
    return Bricks(**columns)


def test_solid_is_what_must_or_may_be_built():
    """Only empty cells are not solid."""
    cover = np.resize(np.array(list(Fill), np.uint8), (2, 3, 1, 1))
    colour = np.where(cover == Fill.EMPTY, COLOUR_EMPTY, COLOUR_ANY).astype(np.int16)
    grid = UnitGrid(colour, cover, np.full_like(cover, Role.INSIDE), np.zeros(3))
    assert grid.solid.ravel().tolist() == [False, True, True, True, False, True]


def test_ground_is_the_first_plane_with_anything():
    """Empty planes below do not count; of nothing it is the first plane, if there is any."""
    filled = np.zeros((5, 3, 4), dtype=bool)
    assert ground_of(filled) == ground_of(filled[:0]) == 0
    filled[3:, 1, 2] = True
    assert ground_of(filled) == 3


def test_marks_of_cells_are_no_colours():
    """The marks for any and no colour are different and below every LDraw code."""
    assert COLOUR_EMPTY != COLOUR_ANY
    assert max(COLOUR_EMPTY, COLOUR_ANY) < 0


def test_sizes_agree():
    """Three plates are a brick; the same lengths in LDraw units; a grid cell is a plate high."""
    np.testing.assert_allclose([PLATES_PER_BRICK * PLATE, STUD * LDU_PER_MM, PLATE * LDU_PER_MM], [BRICK, 20, 8])
    assert (STUD_LDU, PLATE_LDU) == (20, 8)
    np.testing.assert_array_equal(CELL_SIZE, [8.0, 8.0, 3.2])
