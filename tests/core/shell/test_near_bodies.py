"""Bodies that nearly touch are joined; those that stand free are counted."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, Fill, UnitGrid
from legorize_addon.core.shell.near_bodies import free_bodies, join_near_bodies
from tests.core.shell.test_plate_seams import grid_of

RED, BLUE = 4, 1


def two(*, up: int = 0, aside: int = 0) -> UnitGrid:
    """Make a red block and a blue one above or beside it, with so many plates or studs of air between."""
    colour = np.full((30, 4, 12), COLOUR_EMPTY)
    colour[:6, :, :3] = RED
    low = 6 + up if up else 0
    left = 3 + aside if aside else 0
    colour[low : low + 6, :, left : left + 3] = BLUE
    return grid_of(colour.reshape(10, 3, 4, 12))


@pytest.mark.parametrize("gap", [1, 2, 3])
def test_hat_over_a_head(gap):
    """One to three plates of air are filled by one column in the colour of the smaller body."""
    grid = two(up=gap)
    assert free_bodies(grid) == 2
    found = join_near_bodies(grid, plates=True)
    added = found.solid & ~grid.solid
    assert added.sum() == gap
    assert (found.cover[added] == Fill.REQUIRED).all()
    assert free_bodies(found) == 1


def test_one_stud_beside():
    """One stud of air is filled by one plate."""
    grid = two(aside=1)
    found = join_near_bodies(grid, plates=True)
    assert (found.solid & ~grid.solid).sum() == 1
    assert free_bodies(found) == 1


@pytest.mark.parametrize("gap", [{"up": 4}, {"aside": 2}])
def test_what_stands_free_stays_free(gap):
    """Bodies farther apart are left as they are."""
    grid = two(**gap)
    assert join_near_bodies(grid, plates=True) is grid
    assert free_bodies(grid) == 2


def test_nearest_pair_is_taken_and_stacking_preferred():
    """A way upwards of three plates is shorter than one aside of a stud."""
    colour = np.full((30, 6, 12), COLOUR_EMPTY)
    colour[:6, :, :4] = RED
    colour[9:12, 0, 0] = BLUE
    colour[0:3, 3, 5] = BLUE
    grid = grid_of(colour.reshape(10, 3, 6, 12))
    found = join_near_bodies(grid, plates=True)
    assert free_bodies(found) == 1
    assert (found.solid & ~grid.solid).sum() == 3 + 1


@pytest.mark.parametrize(("top", "aside"), [(7, True), (6, False)])
def test_a_step_aside_counts_half_as_much_again(top, aside):
    """A slanting way aside wins against three plates straight up if it rises by two plates, not if by three."""
    colour = np.full((12, 3, 10), COLOUR_EMPTY)
    colour[:6] = RED
    colour[: top + 1, :, 6:] = RED
    colour[9:, :, :6] = BLUE
    grid = grid_of(colour.reshape(4, 3, 3, 10))
    found = join_near_bodies(grid, plates=True)
    added = np.argwhere((found.solid & ~grid.solid).reshape(colour.shape))
    assert (added[:, 2] == 6).any() == aside
    assert free_bodies(found) == 1


def test_one_body_is_left_alone():
    """A model in one piece comes back as it is."""
    grid = grid_of(np.full((2, 3, 3, 3), RED))
    assert join_near_bodies(grid, plates=True) is grid


def test_bricks_alone_fill_with_bricks():
    """Without plates the gap is filled by a whole brick's height."""
    grid = two(aside=1)
    found = join_near_bodies(grid, plates=False)
    added = found.solid & ~grid.solid
    assert added.sum() == 3
    assert added.all(axis=1).sum() == 1
