"""Shells made to hold, whatever they lack."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.layout.joining.ties import add_ties
from legorize_addon.core.layout.lay import lay
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, UnitGrid
from legorize_addon.core.shell.cohesion import count_additions, make_cohesive
from tests.core.shell.test_near_bodies import two
from tests.core.shell.test_plate_seams import grid_of

RED, BLUE = 4, 1


def house() -> UnitGrid:
    """Make a shed with a wide roof of one layer, a shelf of plates in its wall and a blue claw beside it."""
    colour = np.full((5, 3, 26, 32), COLOUR_EMPTY)
    colour[:4, :, 1:25, 1:25] = RED
    colour[:4, :, 2:24, 2:24] = COLOUR_EMPTY
    colour[4, :, 1:25, 1:25] = RED
    colour[2, 1, 10:12, 25:28] = RED
    colour[3, :, 20, 25:27] = BLUE
    return grid_of(colour)


@pytest.mark.parametrize("plates", [True, False])
def test_house_is_one_piece(plates):
    """Each of three lacks leaves loose bricks; mended and tied they are none; bricks mend all but the shelf."""
    catalogue = load_catalogue()
    shell = make_cohesive(house(), plates=plates)
    before, laid = (lay(grid, catalogue, rng=np.random.default_rng(0)) for grid in (house(), shell))
    assert contact_graph(before, catalogue).n_components > 3
    bricks, _ = add_ties(laid, shell, catalogue, plates=plates)
    found = contact_graph(bricks, catalogue)
    assert found.n_components == (1 if plates else 2)


def test_bricks_alone_add_no_plates():
    """Without plates every column is a whole brick or as partial as it was."""
    before, after = house(), make_cohesive(house(), plates=False)
    added = after.solid & ~before.solid
    assert added.any()
    assert (added.any(axis=1) == added.all(axis=1)).all()
    assert not (after.role[before.solid.all(axis=1)[:, None].repeat(3, axis=1)] == Role.PLATE).any()


def test_additions_are_counted():
    """A roof of one layer has columns below it, and the wall is laid in plates where the shelf enters."""
    found, after = count_additions(house(), plates=True), make_cohesive(house(), plates=True)
    more = (after.solid & ~house().solid).any(axis=1)
    assert found.between + found.under_roofs == more.sum() > 0
    assert found.in_plates > 0
    assert count_additions(house(), plates=False).in_plates == 0
    bodies = two(aside=1)
    assert count_additions(bodies, plates=True).between == 1
