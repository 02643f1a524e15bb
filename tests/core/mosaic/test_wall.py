"""Mosaics that stand."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill
from legorize_addon.core.mosaic.wall import DEEP, wall_of


def test_the_front_shows_the_image():
    """A layer for each row, all plates alike; behind each stud is one of any colour, behind a hole none."""
    colour = np.array([[4, 15, COLOUR_EMPTY], [1, COLOUR_EMPTY, 0]], np.int16)
    grid = wall_of(colour)
    assert grid.colour.shape == (2, 3, DEEP, 3)
    assert (grid.colour[:, :, 0] == colour[:, None]).all()
    hole = colour == COLOUR_EMPTY
    assert (grid.colour[:, :, 1] == np.where(hole, COLOUR_EMPTY, COLOUR_ANY)[:, None]).all()
    assert (grid.cover == np.where(hole, Fill.EMPTY, Fill.REQUIRED)[:, None, None]).all()
    assert (grid.role[:, :, 0] == Role.SHELL).all()
    assert (grid.role[:, :, 1] == Role.INSIDE).all()
