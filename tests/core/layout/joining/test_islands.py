"""Loose bricks: those apart from others that parts of one colour could hold them to."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.layout.joining.islands import Islands, loose_bricks
from legorize_addon.core.layout.problem.problem import owners, with_margins
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY
from tests.core.layout.cells import RED, WHITE, brick_grid
from tests.core.standing import CATALOGUE, table


def loose(colour, *rows):
    """Return which of some bricks are loose in a grid of whole bricks of these colours."""
    bricks = table(*rows)
    links, planes = contact_graph(bricks, CATALOGUE), with_margins(brick_grid(colour).colour, COLOUR_EMPTY)
    islands = Islands.of(planes, owners(links, planes.shape), links.component)
    return loose_bricks(bricks, links, islands, CATALOGUE).tolist()


def test_the_smaller_of_two_towers_side_by_side_is_loose():
    """A part across both could hold the towers together: the one of fewer bricks is loose."""
    rows = [("3005", 0, 0, 0), ("3005", 0, 0, 3), ("14716", 1, 0, 0)]
    assert loose(np.full((3, 1, 2), RED), *rows) == [False, False, True]


def test_towers_of_two_colours_are_not_loose():
    """No part lies across two colours, so neither tower could be held to the other."""
    colour = np.full((3, 1, 2), RED)
    colour[..., 1] = WHITE
    assert loose(colour, ("3005", 0, 0, 0), ("3005", 0, 0, 3), ("14716", 1, 0, 0)) == [False] * 3


def test_what_floats_is_loose_however_large_it_is():
    """Of an island, what stands on the ground is the main part, even if it is the smaller one."""
    rows = [("3005", 0, 0, 0), ("3005", 1, 0, 3), ("3005", 1, 0, 6)]
    assert loose(np.full((3, 1, 2), RED), *rows) == [False, True, True]


def test_a_free_cell_may_be_what_joins():
    """Towers apart are in one island if the cells between them could be filled, and not otherwise."""
    rows = [("3005", 0, 0, 0), ("3005", 0, 0, 3), ("14716", 2, 0, 0)]
    assert loose(np.full((3, 1, 3), RED), *rows) == [False, False, True]
    gap = np.full((3, 1, 3), RED)
    gap[..., 1] = COLOUR_EMPTY
    assert loose(gap, *rows) == [False] * 3
