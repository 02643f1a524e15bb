"""Placements written down as bricks, in a fixed order."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.layout.lay import lay
from legorize_addon.core.layout.problem.table import gather
from legorize_addon.core.model.bricks import Bricks, Role
from tests.core.layout.cells import CATALOGUE, brick_grid, grid_of


def laid(grid) -> Bricks:
    """Lay a grid."""
    return lay(grid, CATALOGUE, rng=np.random.default_rng(0))


def test_rows_are_sorted_and_numbered_by_layer():
    """Bricks come by plate, then y, then x, and the step is the layer."""
    bricks = laid(brick_grid(np.full((3, 5, 7), 4)))
    order = np.lexsort((bricks.corner[:, 0], bricks.corner[:, 1], bricks.corner[:, 2]))
    np.testing.assert_array_equal(order, np.arange(len(bricks)))
    np.testing.assert_array_equal(bricks.step, bricks.corner[:, 2] // 3)
    assert set(bricks.piece.tolist()) == {0}


def test_one_visible_cell_makes_a_visible_brick():
    """A brick is inside only if all of its cells are."""
    colour = np.full((1, 3, 1, 4), 4)
    for inside, expected in ((2, Role.SHELL), (4, Role.INSIDE)):
        role = np.full(colour.shape, Role.SHELL)
        role[..., :inside] = Role.INSIDE
        bricks = laid(grid_of(colour, role=role))
        assert bricks.role.tolist() == [expected]


def test_gathered_tables_keep_every_row():
    """Tables put together have the rows of all, in order, whichever came first."""
    bricks = laid(brick_grid(np.full((2, 4, 9), 4)))
    rows = np.arange(len(bricks)) % 2 == 0
    for parts in ((rows, ~rows), (~rows, rows)):
        again = gather([bricks.take(part) for part in parts])
        for name in Bricks.__slots__:
            np.testing.assert_array_equal(getattr(again, name), getattr(bricks, name))
