"""Which cell columns are laid as whole bricks."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.model.brick_columns import brick_columns
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY
from tests.core.layout.cells import RED, grid_of

BLUE = 1


def test_bricks_are_whole_columns_of_one_colour():
    """Three solid plates of one colour, or any, are a brick; mixed, gappy and plate columns are not."""
    colour = np.array([[RED, RED, RED], [RED, COLOUR_ANY, RED], [RED, RED, BLUE], [RED, COLOUR_EMPTY, RED], [RED] * 3])
    grid = grid_of(colour.T[None, :, None])
    grid.role[0, :, 0, 4] = Role.PLATE
    brick, found = brick_columns(grid)
    np.testing.assert_array_equal(brick[0, 0], [True, True, False, False, False])
    assert found[0, 0, 0] == found[0, 0, 1] == RED
