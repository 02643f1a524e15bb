"""Slopes that cost more parts than they are worth go: what they cost is what the layout itself takes."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from legorize_addon.core.layout.around import lay_around
from legorize_addon.core.layout.fixed import owners_of, with_fixed
from legorize_addon.core.layout.lay import Manner
from legorize_addon.core.layout.paying import _batches, _parts_in, paying
from legorize_addon.core.model import COLOUR_EMPTY, concatenate
from legorize_addon.core.model.bricks import Role
from tests.core.any_bricks import table
from tests.core.layout.cells import CATALOGUE, RED, brick_grid

ROW = CATALOGUE.part_row


def slopes_at(*places):
    """Return slopes of two studs along x in the second layer, at x and y."""
    return table([(ROW("3040b"), x, y, 3, 0, RED, Role.SHELL, 0, 1) for x, y in places])


class Layout:
    """Lays walls of a stud's width, and counts how often."""

    def __init__(self, walls, length):
        colour = np.full((2, 4 * walls, length), COLOUR_EMPTY)
        colour[:, ::4] = RED
        self.grid, self.times = brick_grid(colour), 0

    def __call__(self, fixed):
        """Return the walls around some slopes."""
        self.times += 1
        cells = with_fixed(self.grid, fixed, CATALOGUE)
        manner = Manner("standard", beside=owners_of(fixed, cells, CATALOGUE))
        return concatenate([fixed, lay_around(cells, CATALOGUE, manner, rng=np.random.default_rng(0))])


def asked(layout, places, worth, price, pair=None):
    """Return which slopes pay."""
    slopes = slopes_at(*places)
    pair = np.arange(len(slopes)) if pair is None else np.array(pair)
    return paying(slopes, np.array(worth, float), pair, CATALOGUE, layout, price=price).tolist()


@pytest.mark.parametrize(("price", "stays"), [(0.4, True), (0.6, False)])
def test_a_slope_in_the_middle_costs_two_parts(price, stays):
    """It divides a brick of eight studs into two of three, beside itself: two parts more."""
    assert asked(Layout(1, 8), [(3, 0)], [1], price) == [stays]


@pytest.mark.parametrize(("price", "stays"), [(0.9, True), (1.1, False)])
def test_a_slope_at_the_end_costs_one_part(price, stays):
    """It leaves a brick of six studs beside itself: one part more."""
    assert asked(Layout(1, 8), [(6, 0)], [1], price) == [stays]


def test_each_by_itself():
    """Of two slopes that lie apart, each is asked for its own parts; the model is laid twice."""
    layout = Layout(2, 8)
    assert asked(layout, [(3, 0), (6, 4)], [1, 1], 0.8) == [False, True]
    assert layout.times == 2


def test_neighbours_are_left_out_one_after_the_other():
    """Where windows meet, parts would be counted for both: each has a layout of its own."""
    layout = Layout(2, 8)
    asked(layout, [(0, 0), (2, 0)], [1, 1], 0.5)
    assert layout.times == 3


def test_pairs_stay_or_go_together():
    """What one of them gains too little, the other one may gain."""
    assert asked(Layout(2, 8), [(3, 0), (6, 4)], [1, 1.5], 0.8, [7, 7]) == [True, True]
    assert asked(Layout(2, 8), [(3, 0), (6, 4)], [1, 1.2], 0.8, [7, 7]) == [False, False]


def test_what_has_to_stay():
    """Nothing is asked of what is worth any part, nor where parts cost nothing."""
    layout = Layout(1, 8)
    assert asked(layout, [(3, 0)], [np.inf], 100) == [True]
    assert asked(layout, [(3, 0)], [0.1], 0) == [True]
    assert layout.times == 0


def test_a_crowd():
    """Of more slopes in one place than layouts are made, the last ones are not asked and stay."""
    crowd = np.array(asked(lambda fixed: fixed, [(0, 0)] * 6, [0.1] * 6, 1.0))
    assert crowd.tolist() == [False] * 3 + [True] * 3


def test_what_reaches_into_windows_takes_little_room():
    """Boxes near each window alone are looked at, with the same result as all; 4,000 windows do not take 16 MB."""
    rng = np.random.default_rng(5)
    low = rng.integers(0, (400, 30, 30), (4000, 3))
    high = low + rng.integers(1, 5, low.shape)
    found = _parts_in(low[:50], high[:50], low, high)
    meets = (low[:50, None] < high) & (low < high[:50, None])
    assert found.tolist() == meets.all(axis=2).sum(axis=1).tolist()
    tracemalloc.start()
    batch = _batches(low, high, np.arange(len(low)), np.ones(len(low), bool))
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most < 16e6
    assert batch.max() == 2
    for number in range(3):
        mine = batch == number
        assert (_parts_in(low[mine], high[mine], low[mine], high[mine]) == 1).all()
