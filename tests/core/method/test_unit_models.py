"""Models of unit bricks."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from legorize_addon.core.method.unit_models import CARRYING, OPTIONAL, PILLARS, hollowed_model, initial_model
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill, UnitGrid
from tests.core.any_bricks import CATALOGUE
from tests.core.method.drafts import draft


def cells_of(bricks, shape):
    """Return how often each cell of a grid is covered by single parts."""
    found = np.zeros(shape, dtype=int)
    for part, (x, y, z) in zip(bricks.part.tolist(), bricks.corner.tolist(), strict=True):
        kind = CATALOGUE.parts[part]
        assert (kind.length, kind.width) == (1, 1)
        for plane in range(z, z + kind.height):
            found[plane // 3, plane % 3, y, x] += 1
    return found


def test_initial_model_is_the_coloured_cells():
    """Each cell with a colour is covered once, in it, and no other one; columns of one colour are bricks."""
    grid = draft().grid
    bricks = initial_model(grid, CATALOGUE)
    np.testing.assert_array_equal(cells_of(bricks, grid.colour.shape), grid.colour >= 0)
    x, y, z = bricks.corner.T
    np.testing.assert_array_equal(bricks.colour, grid.colour[z // 3, z % 3, y, x])
    assert (CATALOGUE.height[bricks.part] == 3).all()
    # the walls are three cells thick: what lies between their faces is not seen
    assert 0 < len(bricks) < grid.solid.any(axis=1).sum()


def test_plates_stay_plates():
    """A column in two colours, and one with a role of plates, is three plates; a lone plate is one."""
    colour = np.full((1, 3, 1, 5), COLOUR_EMPTY, dtype=np.int16)
    colour[0, :, 0, 0] = 4
    colour[0, :, 0, 1] = (4, 4, 1)
    colour[0, :, 0, 2] = 4
    colour[0, 1, 0, 3] = 15
    role = np.zeros(colour.shape, np.uint8)
    role[0, :, 0, 2] = Role.PLATE
    cover = np.where(colour >= 0, np.uint8(Fill.REQUIRED), np.uint8(Fill.EMPTY))
    grid = UnitGrid(colour=colour, cover=cover, role=role, origin=np.zeros(3))
    bricks = initial_model(grid, CATALOGUE)
    assert sorted(CATALOGUE.height[bricks.part].tolist()) == [1] * 7 + [3]
    np.testing.assert_array_equal(cells_of(bricks, colour.shape), colour >= 0)


def test_hollowed_model_tells_kinds_by_colour():
    """Seen cells keep their colours; those that carry, pillars and optional ones have one each."""
    shell = draft().hollow
    cover, colour, role = shell.cover.copy(), shell.colour.copy(), shell.role.copy()
    hidden = np.argwhere((colour == COLOUR_ANY).all(axis=1))
    (one, *_), (other, *_) = hidden[:1].tolist(), hidden[-1:].tolist()
    for column, fill, kind in ((one, Fill.OPTIONAL, Role.INSIDE), (other, Fill.REQUIRED, Role.SUPPORT_INSIDE)):
        at = (column[0], slice(None), column[1], column[2])
        cover[at], role[at] = fill, kind
    shell = replace(shell, cover=cover, colour=colour, role=role)
    bricks = hollowed_model(shell, CATALOGUE)
    np.testing.assert_array_equal(cells_of(bricks, cover.shape), shell.solid)
    x, y, z = bricks.corner.T
    given, fill = colour[z // 3, z % 3, y, x], cover[z // 3, z % 3, y, x]
    seen = (given >= 0) & (fill != Fill.OPTIONAL)
    np.testing.assert_array_equal(bricks.colour[seen], given[seen])
    assert set(bricks.colour[fill == Fill.OPTIONAL].tolist()) == {OPTIONAL}
    assert set(bricks.colour[bricks.role == Role.SUPPORT_INSIDE].tolist()) == {PILLARS}
    assert CARRYING in bricks.colour
