"""How high tables are built up."""

from __future__ import annotations

from legorize_addon.core.building.skyline import Skyline
from tests.core.standing import CATALOGUE, table


def test_what_lies_over_a_brick_covers_it():
    """A roof covers what is below it, not what lies on it, beside it, or on another table."""
    bricks = table(("3003", 0, 0, 6), ("3003", 0, 0, 0), ("3003", 0, 0, 9), ("3003", 2, 0, 0))
    sky = Skyline(bricks, CATALOGUE, 2)
    sky.add(0, 0)
    assert [sky.covers(brick, 0) for brick in (1, 2, 3)] == [True, False, False]
    assert not sky.covers(1, 1)


def test_what_is_taken_out_covers_no_more():
    """After a removal, only what is left counts."""
    bricks = table(("3003", 0, 0, 6), ("3003", 0, 0, 0), ("3003", 0, 0, 3))
    sky = Skyline(bricks, CATALOGUE, 1)
    sky.add(0, 0)
    sky.add(2, 0)
    sky.renew(0, [2])
    assert sky.covers(1, 0)
    sky.renew(0, [])
    assert not sky.covers(1, 0)
