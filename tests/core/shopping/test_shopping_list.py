"""The figures of a model: size, mass, time."""

from __future__ import annotations

from dataclasses import replace

import pytest

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.shopping.lots import priced
from legorize_addon.core.shopping.shopping_list import extent, shopping_list
from tests.core.any_bricks import CATALOGUE, table
from tests.core.shopping.wanted import assembly_of

ROW = CATALOGUE.part_row


def test_size_is_that_of_the_bricks():
    """A 2 x 4 along x and one turned by a quarter upon it: 4 x 4 studs, two bricks high, 3.2 x 3.2 x 1.92 cm."""
    bricks = table([(ROW("3001"), 5, 7, 3, 0, 4, 0, 0, 0), (ROW("3001"), 5, 7, 6, 1, 4, 0, 0, 1)])
    wanted = shopping_list(Assembly(bricks, CATALOGUE))
    assert (wanted.studs, wanted.plates) == ((4, 4), 6)
    assert wanted.cm == pytest.approx((3.2, 3.2, 1.92))
    assert (wanted.count, wanted.mass) == (2, pytest.approx(4.32))


def test_size_of_a_corner_and_of_nothing():
    """A corner plate takes up 2 x 2 studs; no bricks take up nothing."""
    corner = table([(ROW("2420"), 0, 0, 0, 3, 4, 0, 0, 0)])
    assert extent(Assembly(corner, CATALOGUE)) == (2, 2, 1)
    assert extent(Assembly(table([]), CATALOGUE)) == (0, 0, 0)


def test_time_grows_with_the_moves():
    """A brick takes 350 hours by 133,000; supports that are placed and taken out count as two moves."""
    assembly = assembly_of([(0, 4)] * 133)
    assert shopping_list(assembly).seconds == pytest.approx(0.35 * 3600)
    assert shopping_list(assembly, moves=266).seconds == pytest.approx(0.7 * 3600)


def test_cost_is_of_what_has_a_price():
    """The sum is of the lots with a price, and the bricks without are counted."""
    wanted = shopping_list(assembly_of([(0, 4), (0, 4), (1, 4)]))
    assert (wanted.cost, wanted.unpriced) == (None, 3)
    some = replace(wanted, lots=priced(wanted.lots, lambda part, _: {"3005": 0.1}.get(part.number)))
    assert (some.cost, some.unpriced) == (pytest.approx(0.2), 1)
