"""The cells of a model in its mesh: what may be claimed, and what it costs to fill it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from legorize_addon.core.model import COLOUR_ANY, Fill
from legorize_addon.core.slopes.site import Site
from tests.core.slopes.ramps import cells_of_ramp, ramp


def at(site, x, y, z):
    """Return the flat place of a cell."""
    return int(np.ravel_multi_index((z, y + 4, x + 4), site.shape))


def test_cells_in_the_mesh():
    """A cell inside costs -1, one outside 1, and the halved ones of the ramp what is in them."""
    grid = cells_of_ramp()
    site = Site.of(ramp(), grid, grid)
    cost = site.gain.mean(axis=1)[site.row]
    assert cost[at(site, 3, 3, 1)] == -1
    assert cost[at(site, 8, 2, 3)] == 1
    # of the uppermost cell under the fall a fifth is filled
    assert abs(cost[at(site, 6, 2, 5)] - (1 - 2 * 0.2)) < 0.05
    assert at(site, 6, 2, 5) in site.mixed
    assert at(site, 3, 3, 1) not in site.mixed
    np.testing.assert_array_equal(site.corners(np.array([at(site, 2, 1, 4)])), [[2, 1, 4]])


def test_what_may_be_claimed():
    """Required cells and open air within the grid may be claimed, optional ones and those around the grid may not."""
    grid = cells_of_ramp()
    cover, colour = grid.cover.copy(), grid.colour.copy()
    cover[0, 1, 2, 2], colour[0, 2, 2, 2] = Fill.OPTIONAL, COLOUR_ANY
    site = Site.of(ramp(), grid, replace(grid, cover=cover, colour=colour))
    assert site.room[at(site, 3, 3, 1)]
    assert site.room[at(site, 8, 2, 3)]
    assert not site.room[at(site, 2, 2, 1)]
    assert not site.room[at(site, -1, 2, 3)]
    assert not site.room[at(site, 3, 3, 9)]
    assert site.hidden[at(site, 2, 2, 2)]


def test_closed_hollows_are_no_air():
    """What is empty inside a model cannot be claimed."""
    grid = cells_of_ramp()
    cover = grid.cover.copy()
    cover[0, 1, 2, 3] = Fill.EMPTY
    site = Site.of(ramp(), grid, replace(grid, cover=cover))
    assert not site.room[at(site, 3, 2, 1)]
    assert not site.air[at(site, 3, 2, 1)]


def test_the_cut_has_to_tell_what_is_filled():
    """What is empty inside of the mesh brings nothing; what is filled outside of it may not be claimed."""
    grid = cells_of_ramp()
    cover = grid.cover.copy()
    cover[0, 1, 1, 2] = Fill.EMPTY
    # a wall of a stud that stands in front of the ramp
    cover[:, :, 2, 8] = Fill.REQUIRED
    wall = replace(grid, cover=cover)
    site = Site.of(ramp(), wall, wall)
    assert not site.gain[site.row[at(site, 2, 1, 1)]].any()
    assert not site.room[at(site, 8, 2, 3)]
    # the uppermost cell under the fall is filled to a fifth alone, but its brick by more than a half
    assert site.room[at(site, 6, 2, 5)]
    assert site.room[at(site, 8, 3, 3)]
