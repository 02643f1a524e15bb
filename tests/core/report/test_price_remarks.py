"""What a model costs, in sentences."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.report.price_remarks import remarks_on_prices
from legorize_addon.core.stock.prices import Prices
from tests.core.any_bricks import CATALOGUE, table

BRICKS = table([(0, 0, 0, 0, 0, 4, 0, 0, 0), (0, 4, 0, 0, 0, 15, 0, 0, 0), (0, 8, 0, 0, 0, 15, 0, 0, 0)])


def told(stated, removed=0):
    """Return the remarks where every part costs a tenth, and some lots are stated."""
    known = np.zeros(CATALOGUE.exists.shape, bool)
    for code in stated:
        known[0, CATALOGUE.colour_row(code)] = True
    prices = Prices(np.full(known.shape, 0.1), known, "EUR", 0)
    return remarks_on_prices(prices, BRICKS, BRICKS.take(np.arange(removed)), CATALOGUE)


def test_sum_and_supports():
    """One sentence if all prices are known; supports are named if there are any."""
    assert told((4, 15)) == ("By the price file the model costs 0.30 EUR.",)
    assert told((4, 15), 2) == ("By the price file the model costs 0.30 EUR, and its temporary supports 0.20 EUR.",)


def test_estimates_are_told():
    """How many lots and bricks have no price, and what they were reckoned at."""
    assert told((4,))[1].startswith("The price file has no price for 1 of the model's lots (2 bricks): 0.20 EUR of")


def test_nothing_without_prices():
    """No file, no words."""
    assert remarks_on_prices(None, BRICKS, BRICKS, CATALOGUE) == ()
