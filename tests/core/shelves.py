"""A wall with a shelf of plates, for the tests of what is laid as bricks and what as plates."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, UnitGrid
from tests.core.layout.cells import RED, grid_of


def wall_with_a_shelf(wall=RED, shelf=RED) -> UnitGrid:
    """Make a wall of three bricks' height with a shelf of one plate halfway up."""
    colour = np.full((3, 3, 4, 6), COLOUR_EMPTY)
    colour[:, :, :, :2] = wall
    colour[1, 1, :, 2:] = shelf
    return grid_of(colour)
