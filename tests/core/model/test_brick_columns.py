"""Which cell columns are laid as whole bricks."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.model.brick_columns import brick_columns
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill, UnitGrid

RED, BLUE = 4, 1


def grid_of(colour) -> UnitGrid:
    """Make a grid of shell cells, all of which must be built."""
    colour = np.asarray(colour, np.int16)
    cover = np.where(colour == COLOUR_EMPTY, Fill.EMPTY, Fill.REQUIRED).astype(np.uint8)
    return UnitGrid(colour, cover, np.zeros(colour.shape, np.uint8), np.zeros(3))


def wall_with_a_shelf(wall=RED, shelf=RED) -> UnitGrid:
    """Make a wall of three bricks' height with a shelf of one plate halfway up."""
    colour = np.full((3, 3, 4, 6), COLOUR_EMPTY)
    colour[:, :, :, :2] = wall
    colour[1, 1, :, 2:] = shelf
    return grid_of(colour)


def test_bricks_are_whole_columns_of_one_colour():
    """Three solid plates of one colour, or any, are a brick; mixed, gappy and plate columns are not."""
    colour = np.array([[RED, RED, RED], [RED, COLOUR_ANY, RED], [RED, RED, BLUE], [RED, COLOUR_EMPTY, RED], [RED] * 3])
    grid = grid_of(colour.T[None, :, None])
    grid.role[0, :, 0, 4] = Role.PLATE
    brick, found = brick_columns(grid)
    np.testing.assert_array_equal(brick[0, 0], [True, True, False, False, False])
    assert found[0, 0, 0] == found[0, 0, 1] == RED
