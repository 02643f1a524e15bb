"""What slopes leave behind them: cells that are seen have a colour and are built, others need not be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.layout import with_fixed
from legorize_addon.core.model import COLOUR_ANY, COLOUR_EMPTY, Fill
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.slopes import open_up
from tests.core.any_bricks import table
from tests.core.layout.cells import CATALOGUE, RED, brick_grid

WHITE = 15
SLOPE, BRICK, PLATE = map(CATALOGUE.part_row, ("3040b", "3004", "3024"))


def block():
    """Return cells of 3 x 3 x 6 with nothing known of the middle, hollow in one half: what is behind the surface."""
    grid = brick_grid(np.full((3, 3, 6), RED))
    colour, cover = grid.colour.copy(), grid.cover.copy()
    colour[1, :, 1], cover[1, :, 1] = COLOUR_ANY, Fill.REQUIRED
    colour[1, :, 1, 1:2], cover[1, :, 1, 1:2] = COLOUR_EMPTY, Fill.EMPTY
    return replace(grid, colour=colour, cover=cover), np.ones(cover.shape, bool)


def at(part, x, y, colour=WHITE):
    """Return a brick along x in the second layer."""
    return table([(part, x, y, 3, 0, colour, Role.SHELL, 0, 1)])


@pytest.mark.parametrize("filled", [True, False])
def test_what_is_seen(filled):
    """Beside the fall of a slope hidden cells are required, in its colour, also where the model was hollow."""
    grid, solid = block()
    opened = open_up(grid, solid, at(SLOPE, 0, 0), CATALOGUE, filled=filled)
    assert (opened.colour[1, :, 1, 1] == WHITE).any()
    assert ((opened.cover[1, :, 1, 1] == Fill.REQUIRED) == (opened.colour[1, :, 1, 1] == WHITE)).all()
    # what had a colour keeps it, and what is outside stays empty
    known = grid.colour >= 0
    assert (opened.colour[known] == grid.colour[known]).all()
    assert (open_up(grid, grid.solid, at(SLOPE, 0, 0), CATALOGUE).colour[1, :, 1, 1] == COLOUR_EMPTY).all()


@pytest.mark.parametrize(("filled", "left"), [(True, Fill.REQUIRED), (False, Fill.OPTIONAL)])
def test_what_is_hidden(filled, left):
    """Hidden cells around a slope need not be filled, unless all is to be; further on they have to be."""
    grid, solid = block()
    opened = open_up(grid, solid, at(SLOPE, 0, 0), CATALOGUE, filled=filled)
    assert (opened.cover[1, :, 1, 2] == left).all()
    assert (opened.cover[1, :, 1, 3:] == Fill.REQUIRED).all()
    assert (opened.colour[1, :, 1, 2:] == COLOUR_ANY)[opened.cover[1, :, 1, 2:] == left].all()


def test_what_a_jumper_lies_on():
    """Hidden cells below and above what else is fixed stay required, whatever slopes are beside."""
    grid, solid = block()
    grid = with_fixed(grid, table([(PLATE, 2, 1, 4, 0, RED, Role.PLATE, 0, 1)]), CATALOGUE)
    opened = open_up(grid, solid, at(SLOPE, 0, 0), CATALOGUE)
    assert opened.cover[1, :, 1, 2].tolist() == [Fill.REQUIRED, Fill.FIXED, Fill.REQUIRED]


def test_nothing_but_slopes():
    """Without slopes, and around other bricks, all is as it was."""
    grid, solid = block()
    for bricks in (at(BRICK, 0, 0), at(SLOPE, 0, 0).take(np.zeros(0, int))):
        opened = open_up(grid, solid, bricks, CATALOGUE)
        assert (opened.cover == grid.cover).all()
        assert (opened.colour == grid.colour).all()
