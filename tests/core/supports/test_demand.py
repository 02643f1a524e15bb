"""Which bricks need a support, and where it touches them."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model import columns
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.statics.forces import GRAVITY
from legorize_addon.core.supports.demand import support_demand
from legorize_addon.core.supports.hanging import NOT_HELD
from tests.core.standing import CATALOGUE, table

TEE = (
    *(("3003", 3, 0, z) for z in (0, 3, 6)),
    ("3008", 0, 0, 12),
    ("3008", 0, 1, 12),
    ("3010", 0, 0, 9),
    ("3010", 4, 1, 9),
)
"""A trunk, and on it two arms: bricks of four studs at the level of the trunk's top, held by beams above them."""


def need(*rows, deepest=3):
    """Return what bricks need."""
    bricks = table(*rows)
    return support_demand(Assembly(bricks, CATALOGUE), deepest=deepest)


def test_tower_needs_nothing():
    """What lies on each other needs no support, and has no depth."""
    found = need(("3003", 0, 0, 0), ("3003", 0, 0, 3))
    assert len(found.bricks) == len(found.contacts) == len(found.left) == 0
    assert found.depth.tolist() == [0, 0]


def test_islands_need_one_contact_each():
    """Two bricks in the air that a beam joins: each is an island until the beam comes, and needs one contact."""
    found = need(("3003", 0, 0, 0), ("3005", 4, 0, 9), ("3005", 8, 0, 9), ("3008", 2, 0, 12), deepest=0)
    assert found.bricks.tolist() == [1, 2, 3]
    assert found.carried.tolist() == [1, 2]
    assert found.contacts[:, 2].tolist() == [9, 9]


def test_hanging_bricks_need_none_within_the_limit():
    """A brick under the end of a beam hangs by its own height: allowed with a limit of three plates, not of two."""
    rows = (("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3009", 0, 0, 6), ("3005", 5, 0, 3))
    assert len(need(*rows, deepest=3).contacts) == 0
    assert need(*rows, deepest=2).carried.tolist() == [3]


def test_contact_is_under_the_middle_of_its_brick():
    """Of six studs the support takes one of the two in the middle."""
    found = need(
        ("3003", 0, 3, 0), ("3009", 4, 0, 3), ("3001", 0, 3, 3), ("3008", 1, 0, 6), ("3008", 1, 3, 6), deepest=0
    )
    x = found.contacts[0, 0] + found.room.low[0]
    assert x in (6, 7)


def test_load_is_the_weight_of_all_that_a_contact_carries():
    """A brick, and one on it: the contact under the lower one bears both."""
    found = need(("3003", 0, 0, 0), ("3003", 5, 5, 3), ("3003", 5, 5, 6))
    assert found.load == pytest.approx([2 * 1.15e-3 * GRAVITY])


def test_no_contact_over_the_model():
    """Over another brick there is no place from which a support could be pulled down: the brick is left."""
    found = need(("3001", 0, 0, 0), ("3001", 0, 0, 9))
    assert len(found.contacts) == 0
    assert found.left.tolist() == [1]
    assert found.depth[1] == NOT_HELD


def test_closed_hollow_is_told_apart():
    """Of three bricks that hang under each other in a closed box the lowest hangs too deep, and no air reaches it."""
    floor = [("3001", 0, 0, 0), ("3001", 0, 2, 0), ("3001", 0, 4, 0)]
    levels = (3, 6, 9, 12)
    walls = [("3010", 0, y, z) for y in (0, 5) for z in levels] + [("3010", x, 1, z, 1) for x in (0, 3) for z in levels]
    lid = [("3001", 0, 0, 15), ("3001", 0, 2, 15), ("3001", 0, 4, 15)]
    hanging = [("3005", 1, 2, 6), ("3005", 1, 2, 9), ("3005", 1, 2, 12)]
    found = need(*floor, *walls, *lid, *hanging, deepest=0)
    assert found.enclosed.tolist() == [len(floor) + len(walls) + len(lid)]
    assert len(found.contacts) == 0


def test_cells_are_all_undersides_in_need():
    """All studs of the bricks in need that look down on open ground, whether a support stands there or not."""
    found = need(("3003", 0, 0, 0), ("3001", 5, 5, 3), ("3001", 5, 5, 6))
    assert len(found.cells) == 8
    assert (found.cells[:, 2] == 3).all()


@pytest.mark.parametrize("deepest", [0, 3, 9])
def test_deeper_hanging_never_needs_more(deepest):
    """Whatever bricks may hang deeper need fewer contacts, never more."""
    fewer, more = need(*TEE, deepest=deepest + 3), need(*TEE, deepest=deepest)
    assert len(fewer.contacts) <= len(more.contacts)
    assert np.isin(fewer.bricks, more.bricks).all()


def test_falls_of_inverted_slopes_are_no_undersides():
    """Where a part has no socket below, a support would hold nothing."""
    found = need(("3003", 5, 0, 0), ("3665", 0, 0, 9))
    assert (found.undersides + found.room.low).tolist() == [[0, 0, 9]]


@pytest.mark.parametrize("part", [part for part in CATALOGUE.parts if part.wedge], ids=lambda part: part.number)
def test_notches_of_wedge_plates_are_no_undersides(part):
    """A support stands under the squares that clutch, never where a wedge plate only reaches into one."""
    own = columns(part, 1)
    found = need(("3003", 9, 0, 0), (part.number, 0, 0, 9, 1))
    places = (found.undersides + found.room.low)[found.over == 1]
    assert sorted(map(tuple, places.tolist())) == sorted((x, y, 9) for x, y in own.xy[own.socket].tolist())
