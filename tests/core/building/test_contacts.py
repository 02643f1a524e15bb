"""What touches what while a model is built."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.contacts import contact_graph
from tests.core.standing import CATALOGUE, table


def test_one_piece_is_the_whole_connection():
    """A model in one piece with a support has exactly the contacts of all its bricks."""
    bricks = table(("3003", 0, 0, 0), ("3001", 0, 0, 3), ("3005", 3, 0, 0))
    found = building_contacts(Assembly(bricks, CATALOGUE), temporary=np.array([False, False, True]))
    wanted = contact_graph(bricks, CATALOGUE)
    assert sorted(map(tuple, found.pairs.tolist())) == sorted(map(tuple, wanted.pairs.tolist()))
    assert found.studs.sum() == wanted.studs.sum()
    assert found.collisions == 0


def test_supports_of_a_piece_pass_through_the_others():
    """A support on the table of the upper piece meets nothing of the lower one, in whose cells it stands."""
    bricks = table(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3001", 0, 0, 6), ("3005", 3, 0, 3), ("3004", 2, 0, 3))
    bricks = replace(bricks, piece=np.array([0, 0, 1, 1, 0], np.int16))
    found = building_contacts(Assembly(bricks, CATALOGUE), temporary=np.array([False, False, False, True, False]))
    assert (3, 4) not in map(tuple, found.pairs.tolist())
    assert (3, 2) in map(tuple, found.pairs.tolist())
    assert found.collisions == 0


def test_supports_of_the_first_piece_are_in_the_way_of_all():
    """They are still there when the others are joined: sharing a cell with them is a collision."""
    bricks = table(("3003", 0, 0, 0), ("3001", 0, 0, 3), ("3005", 3, 0, 3))
    bricks = replace(bricks, piece=np.array([0, 1, 0], np.int16))
    assert building_contacts(Assembly(bricks, CATALOGUE), temporary=np.array([False, False, True])).collisions == 3
