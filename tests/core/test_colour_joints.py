"""Plates in a neighbour's colour that join parts of different colours."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.catalogue import load_catalogue
from legorize_addon.core.colour_joints import with_colour_joints
from legorize_addon.core.connection import connect
from legorize_addon.core.joints import Touching, brick_columns, every_plate, parts_of
from legorize_addon.core.layout import lay
from legorize_addon.core.model import COLOUR_ANY, COLOUR_EMPTY, UnitGrid
from tests.core.test_joints import grid_of

RED, BLUE = 4, 1


def n_parts(grid: UnitGrid) -> int:
    """Count what can hold together."""
    touching = Touching.of(grid.solid)
    whole = every_plate(brick_columns(grid)[0]).reshape(-1)[touching.cell]
    return len(parts_of(touching, grid.colour.reshape(-1)[touching.cell], whole)[1])


def claw(gap: int = 0) -> UnitGrid:
    """Make a red block with a blue claw beside it that hangs in the air."""
    colour = np.full((4, 3, 4, 8), COLOUR_EMPTY)
    colour[:, :, :, :3] = RED
    colour[2:, :, 1, 3 + gap : 5 + gap] = BLUE
    return grid_of(colour)


def test_claw_is_joined_by_one_plate():
    """One cell of the two colours' contact changes its colour, and the built model is one piece."""
    grid = claw()
    assert n_parts(grid) == 2
    found = with_colour_joints(grid, plates=True)
    changed = found.colour != grid.colour
    assert changed.sum() == 1
    assert n_parts(found) == 1
    catalogue = load_catalogue()
    assert connect(lay(found, catalogue, rng=np.random.default_rng(0)), catalogue).n_components == 1


def test_hidden_cells_are_taken_first():
    """Where the contact has a cell inside, nobody sees the joint."""
    grid = claw()
    wide = np.full((4, 3, 4, 8), COLOUR_EMPTY)
    wide[:, :, :, :3] = RED
    wide[2:, :, 0:3, 3:5] = BLUE
    grid = grid_of(wide)
    found = with_colour_joints(grid, plates=True)
    [[layer, plate, y, x]] = np.argwhere(found.colour != grid.colour)
    around = np.pad(grid.colour == COLOUR_EMPTY, ((0, 0), (0, 0), (1, 1), (1, 1)), constant_values=True)
    open_sides = sum(around[layer, plate, y + 1 + dy, x + 1 + dx] for dy, dx in ((0, 1), (0, -1), (1, 0), (-1, 0)))
    assert open_sides == 0


def test_what_does_not_touch_stays_apart():
    """A claw a stud away from the block is left as it is."""
    grid = claw(gap=1)
    assert with_colour_joints(grid, plates=True) is grid


def test_one_piece_stays_as_it_is():
    """A model that holds together is not changed."""
    grid = grid_of(np.full((2, 3, 4, 4), RED))
    assert with_colour_joints(grid, plates=True) is grid


@settings(max_examples=30)
@given(st.integers(0, 2**32 - 1))
def test_joints_never_part_what_held(seed):
    """Occupied cells stay, colours are only copied from neighbours, and there are no more parts than before."""
    rng = np.random.default_rng(seed)
    grid = grid_of(rng.choice([COLOUR_EMPTY, COLOUR_ANY, RED, BLUE], (3, 3, 5, 6), p=[0.4, 0.05, 0.35, 0.2]))
    found = with_colour_joints(grid, plates=True)
    np.testing.assert_array_equal(found.solid, grid.solid)
    assert np.isin(found.colour, np.unique(grid.colour)).all()
    assert n_parts(found) <= n_parts(grid)


def test_bricks_alone_stay_bricks():
    """Where only bricks are asked for, a whole column changes its colour, and no cell becomes a plate."""
    grid = claw()
    found = with_colour_joints(grid, plates=False)
    changed = found.colour != grid.colour
    assert changed.sum() == 3
    assert changed.all(axis=1).sum() == 1
    np.testing.assert_array_equal(found.role, grid.role)
    assert n_parts(found) == 1
