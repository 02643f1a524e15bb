"""Bricks that lie in a grid before its other cells are laid: their cells are theirs, and nothing else changes."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.layout.fixed import owners_of, with_fixed
from legorize_addon.core.layout.lay import Manner, lay_fixed
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, Fill
from tests.core.any_bricks import table
from tests.core.layout.cells import CATALOGUE, RED, WHITE, brick_grid

ROW = CATALOGUE.part_row


def stairs():
    """Return two layers of 6 x 4 cells, the upper one a column shorter, and a slope of two studs on its edge."""
    colour = np.full((2, 4, 6), RED)
    colour[1, :, 5] = COLOUR_EMPTY
    return brick_grid(colour), table([(ROW("3039"), 4, y, 3, 0, WHITE, Role.SHELL, 0, 1) for y in (0, 2)])


def test_the_cells_are_fixed():
    """Cells that slopes claim are fixed in their colour, those of the shell and those of the air; all others stay."""
    grid, slopes = stairs()
    fixed = with_fixed(grid, slopes, CATALOGUE)
    at = fixed.cover == Fill.FIXED
    assert sorted(np.argwhere(at)[:, [0, 3]].tolist()) == sorted([[1, x] for x in (4, 5)] * 12)
    assert (fixed.colour[at] == WHITE).all()
    np.testing.assert_array_equal(fixed.colour[~at], grid.colour[~at])
    np.testing.assert_array_equal(fixed.cover[~at], grid.cover[~at])
    assert (owners_of(slopes, grid, CATALOGUE)[1:-1].reshape(at.shape) >= 0).tolist() == at.tolist()


def test_no_brick_is_fixed():
    """Without bricks the grid is as it was."""
    grid, slopes = stairs()
    fixed = with_fixed(grid, slopes.take(np.zeros(0, int)), CATALOGUE)
    np.testing.assert_array_equal(fixed.cover, grid.cover)
    np.testing.assert_array_equal(fixed.colour, grid.colour)


def test_bricks_are_laid_around_slopes():
    """All other cells are covered once, and the slopes hold to what is below them."""
    grid, slopes = stairs()
    fixed = with_fixed(grid, slopes, CATALOGUE)
    bricks = lay_fixed(fixed, CATALOGUE, slopes, Manner("standard"), rng=np.random.default_rng(0))
    links = contact_graph(bricks, CATALOGUE)
    assert links.collisions == 0
    assert links.n_components == 1
    assert (links.owner >= 0).sum() == fixed.solid.sum()
    assert np.count_nonzero(bricks.part == ROW("3039")) == 2
