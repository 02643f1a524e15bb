"""Brick columns laid as plates where nothing else holds what sticks out of them."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.model.brick_columns import brick_columns
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY
from legorize_addon.core.shell.plate_seams import add_plate_seams
from tests.core.layout.cells import RED, grid_of
from tests.core.shelves import wall_with_a_shelf

BLUE = 1


def test_shelf_is_held_by_plates_in_the_wall():
    """Where a shelf of plates leaves a wall of bricks the wall becomes plates, one stud deep, in that layer only."""
    grid = add_plate_seams(wall_with_a_shelf())
    plates = (grid.role == Role.PLATE).all(axis=1)
    assert plates[1, :, 1].all()
    assert not plates[[0, 2]].any()
    assert not plates[1, :, 0].any()
    assert (grid.role[1, 1, :, 2:] == Role.PLATE).all()


def test_other_colours_cannot_be_held_so():
    """A blue shelf finds no part that covers it and the red wall: the wall stays as it is."""
    grid = add_plate_seams(wall_with_a_shelf(shelf=BLUE))
    assert (grid.role[:, :, :, :2] == Role.SHELL).all()


def test_bricks_alone_stay_as_they_are():
    """Without plates there is nothing to do, and the very same grid comes back."""
    grid = grid_of(np.full((2, 3, 4, 5), RED))
    assert add_plate_seams(grid) is grid


def test_what_rests_needs_no_joint():
    """A plate on top of a wall is held by it."""
    colour = np.full((2, 3, 3, 3), COLOUR_EMPTY)
    colour[0] = RED
    colour[1, 0, :, :2] = RED
    grid = add_plate_seams(grid_of(colour))
    assert (grid.role[0] == Role.SHELL).all()


@settings(max_examples=40)
@given(st.integers(0, 2**32 - 1))
def test_only_roles_change_and_twice_is_once(seed):
    """Colours and covers stay; bricks only ever become plates; a second pass finds nothing more to do."""
    rng = np.random.default_rng(seed)
    grid = grid_of(rng.choice([COLOUR_EMPTY, COLOUR_ANY, RED, BLUE], (3, 3, 5, 6), p=[0.4, 0.1, 0.4, 0.1]))
    once = add_plate_seams(grid)
    assert once.colour is grid.colour
    assert once.cover is grid.cover
    assert not (brick_columns(once)[0] & ~brick_columns(grid)[0]).any()
    np.testing.assert_array_equal(add_plate_seams(once).role, once.role)
