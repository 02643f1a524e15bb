"""Which parts the layout prefers: known cheapest layouts, and that money is never wasted."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.layout.lay import lay, lay_unjoined
from legorize_addon.core.measures.lower_bound import least_cost
from legorize_addon.core.model.unit_grid import COLOUR_ANY
from legorize_addon.core.part_choice import PartChoice
from legorize_addon.core.settings import Settings
from legorize_addon.core.stock.prices import Prices
from tests.core.layout.cells import CATALOGUE, RED, assert_covers, brick_grid, random_sheet

ONE, TWO, FOUR = (CATALOGUE.part_row(number) for number in ("3005", "3004", "3010"))


def priced(price):
    """Return a choice of the cheapest at some prices."""
    return PartChoice(CATALOGUE, Prices(np.asarray(price, float), np.isfinite(price), "EUR", 0), cheapest=True)


def laid(choice, grid):
    """Return the layout that a choice makes of a grid, whether it holds together or not."""
    return choice.laid(lambda catalogue: lay_unjoined(grid, catalogue, rng=np.random.default_rng(0)))


def flat(price):
    """Return a table with the same price in all colours."""
    return np.tile(np.asarray(price, float)[:, None], (1, len(CATALOGUE.colours)))


@pytest.mark.parametrize(("dear", "parts"), [(1.0, {FOUR}), (2.5, {TWO})])
def test_a_row_of_four_is_laid_by_its_price(dear, parts):
    """A 1 x 4 lies there unless it costs more than two 1 x 2."""
    price = np.full(len(CATALOGUE.parts), 1.0)
    price[FOUR] = dear
    found = laid(priced(flat(price)), brick_grid(np.full((1, 1, 4), RED)))
    assert set(found.part.tolist()) == parts


def test_hidden_bricks_have_the_cheapest_colour():
    """Where the colour is free, it is the one that costs least."""
    price = flat(np.ones(len(CATALOGUE.parts)))
    price[:, CATALOGUE.colour_row(2)] = 0.5
    found = laid(priced(price), brick_grid(np.full((1, 2, 4), COLOUR_ANY)))
    assert set(found.colour.tolist()) == {2}


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=6, deadline=None)
def test_cheapest_is_never_dearer_than_fewest_and_never_below_the_bound(seed):
    """Whatever parts cost: bound <= cheapest <= fewest bricks, and the cells are covered as ever."""
    rng = np.random.default_rng(seed)
    sheets = [random_sheet([seed, number]) for number in range(2)]
    grid = brick_grid(*(np.stack(each) for each in zip(*sheets, strict=True)))
    price = rng.uniform(0.01, 1, CATALOGUE.exists.shape)
    choice = priced(price)
    cheapest, fewest = (
        choice.laid(partial(lay, grid, rng=np.random.default_rng(0))),
        lay(grid, CATALOGUE, rng=np.random.default_rng(0)),
    )
    cost, usual = (choice.prices.each(bricks, CATALOGUE).sum() for bricks in (cheapest, fewest))
    least = least_cost(grid, CATALOGUE, price)
    assert least * (1 - 1e-9) <= cost <= usual
    assert_covers(cheapest, grid)


def test_without_prices_or_masses_nothing_changes():
    """The same catalogue goes to the layout, once."""
    asked = []
    PartChoice.of(Settings(), CATALOGUE).laid(asked.append)
    assert asked == [CATALOGUE]


def test_parts_without_a_price_can_be_excluded(tmp_path):
    """Only the lots of the file are built with, if that is wanted."""
    (tmp_path / "prices.csv").write_text("part,colour,price\n3005,4,0.1\n3010,4,0.1\n")
    options = {"prices": str(tmp_path / "prices.csv"), "goal": "cheapest"}
    some = PartChoice.of(Settings(**options, unpriced="exclude"), CATALOGUE)
    assert set(zip(*map(list, some.catalogue.exists.nonzero()), strict=True)) == {
        (part, CATALOGUE.colour_row(4)) for part in (ONE, FOUR)
    }
    assert PartChoice.of(Settings(**options), CATALOGUE).catalogue is CATALOGUE
    grid = brick_grid(np.full((1, 2, 4), RED))
    assert set(laid(some, grid).part.tolist()) == {FOUR}


def test_goal_needs_prices():
    """Nothing is the cheapest without prices."""
    with pytest.raises(SettingsError, match=r"^goal is 'cheapest' but prices is empty: .*\.$"):
        PartChoice.of(Settings(goal="cheapest"), CATALOGUE)


def test_mass_weighs():
    """With a high price of grams, two light bricks lie where a heavy one would, if their mass says so."""
    heavy = list(CATALOGUE.parts)
    heavy[FOUR] = replace(heavy[FOUR], mass=5.0)
    catalogue, grid = replace(CATALOGUE, parts=tuple(heavy)), brick_grid(np.full((1, 1, 4), RED))
    for weight, part in ((0.0, FOUR), (0.1, FOUR), (1.0, TWO)):
        choice = PartChoice.of(Settings(mass_weight=weight), catalogue)
        assert set(laid(choice, grid).part.tolist()) == {part}
