"""Plates under roofs of one layer."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.lay import lay
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill, UnitGrid
from legorize_addon.core.shell.roofs import reinforce_roofs

RED, BLUE = 4, 1


def grid_of(colour) -> UnitGrid:
    """Make a grid of shell cells, all of which must be built."""
    colour = np.asarray(colour, np.int16)
    cover = np.where(colour == COLOUR_EMPTY, Fill.EMPTY, Fill.REQUIRED).astype(np.uint8)
    return UnitGrid(colour, cover, np.zeros(colour.shape, np.uint8), np.zeros(3))


def shed(roof_plates: int, side: int = 14) -> UnitGrid:
    """Make four walls two bricks high under a roof of one brick or of one plate."""
    colour = np.full((3, 3, side, side), COLOUR_EMPTY)
    colour[:2] = RED
    colour[:2, :, 1:-1, 1:-1] = COLOUR_EMPTY
    colour[2, :roof_plates] = RED
    return grid_of(colour)


def components(grid: UnitGrid) -> int:
    """Lay a grid and count what holds together."""
    catalogue = load_catalogue()
    return contact_graph(lay(grid, catalogue, rng=np.random.default_rng(0)), catalogue).n_components


@pytest.mark.parametrize("roof_plates", [1, 3])
def test_roof_of_one_layer_gets_a_second_one(roof_plates):
    """The roof of a shed falls apart as it is; with plates under its middle, reaching no wall, it is one piece."""
    grid = shed(roof_plates, side=24)
    found = reinforce_roofs(grid, plates=True)
    added = found.solid & ~grid.solid
    assert added.any()
    assert added[1, 2].sum() == added.sum()
    assert (found.colour[added] == COLOUR_ANY).all()
    assert (found.role[added] == Role.PLATE).all()
    assert (found.cover[added] == Fill.REQUIRED).all()
    assert components(grid) > 1
    assert components(found) == 1


def test_narrow_roof_is_held_by_its_walls():
    """Over a corridor of two studs nothing is added, nor under a solid block or a floor on the ground."""
    colour = np.full((2, 3, 12, 4), COLOUR_EMPTY)
    colour[1] = RED
    colour[0, :, :, [0, -1]] = RED
    for grid in (grid_of(colour), grid_of(np.full((2, 3, 9, 9), RED)), grid_of(np.full((1, 3, 9, 9), RED))):
        assert reinforce_roofs(grid, plates=True) is grid


def test_nothing_is_added_below_the_ground():
    """Plates that are the lowest of all lie on the ground, on whatever plane of the grid that is."""
    for ground in range(3):
        colour = np.full((2, 3, 12, 12), COLOUR_EMPTY)
        colour[0, ground] = RED
        grid = grid_of(colour)
        assert reinforce_roofs(grid, plates=True) is grid


def test_stair_of_plates_is_doubled():
    """Plates on the rims of each other, a stair up from a wall, get plates below, but not near the wall."""
    colour = np.full((5, 3, 6, 30), COLOUR_EMPTY)
    colour[:3, :, :, :1] = RED
    plates = colour.reshape(15, 6, 30)
    for step in range(5):
        plates[8 + step, :, 5 * step : 5 * step + 6] = RED
    added = (reinforce_roofs(grid_of(colour), plates=True).solid & ~grid_of(colour).solid).reshape(15, 6, 30)
    for step in range(1, 5):
        assert added[7 + step, :, 5 * step + 1 : 5 * step + 6].all()
    assert not added[:7].any()


def test_patch_of_another_colour_is_held_from_below():
    """A blue patch in a red roof near its wall cannot be held by red bricks: plates go under it and its rim."""
    grid = shed(3, side=6)
    grid.colour[2, :, 2:4, 2:4] = BLUE
    added = reinforce_roofs(grid, plates=True).solid & ~grid.solid
    assert added[1, 2, 2:4, 2:4].all()
    assert added[1, 2, 1:5, 1:5].all()
    plain = shed(3, side=6)
    assert not (reinforce_roofs(plain, plates=True).solid & ~plain.solid).any()


@settings(max_examples=30)
@given(st.integers(0, 2**32 - 1))
def test_only_empty_cells_below_the_model_are_filled(seed):
    """What was there stays as it is; every added plate lies right below a cell of the model."""
    rng = np.random.default_rng(seed)
    grid = grid_of(rng.choice([COLOUR_EMPTY, COLOUR_ANY, RED, BLUE], (3, 3, 6, 7), p=[0.5, 0.1, 0.3, 0.1]))
    found = reinforce_roofs(grid, plates=True)
    np.testing.assert_array_equal(found.colour[grid.solid], grid.colour[grid.solid])
    np.testing.assert_array_equal(found.role[grid.solid], grid.role[grid.solid])
    added = (found.solid & ~grid.solid).reshape(9, 6, 7)
    above = np.roll(grid.solid.reshape(9, 6, 7), -1, axis=0)
    above[-1] = False
    assert not (added & ~above).any()


def test_bricks_alone_get_bricks():
    """Where only bricks are asked for, the second layer is one of bricks."""
    grid = shed(3, side=24)
    found = reinforce_roofs(grid, plates=False)
    added = found.solid & ~grid.solid
    assert added.any()
    assert (added.all(axis=1) == added.any(axis=1)).all()
    assert (found.role[added] == Role.INSIDE).all()
    assert components(found) == 1
