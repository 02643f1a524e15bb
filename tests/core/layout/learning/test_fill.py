"""The fill by decisions: what it keeps whoever decides, and that decisions are followed."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.learning.fill import decided, simulated
from legorize_addon.core.layout.learning.grade_training import cheapest
from tests.core.layout.learning.layers import layer_of, random_layer


def by_chance(outcome, candidates, rng):
    """Choose any candidate."""
    del outcome
    return rng.integers(np.maximum((candidates >= 0).sum(axis=1), 1))


def smallest(outcome, candidates, rng):
    """Choose the candidate behind which there are most bricks, which is a 1 x 1 mostly."""
    del rng
    return np.where(candidates >= 0, outcome.energies[..., 3], -np.inf).argmax(axis=1)


@given(st.integers(0, 2**32 - 1), st.sampled_from([by_chance, cheapest]))
@settings(max_examples=4, deadline=None)
def test_cells_are_covered_once(seed, choose):
    """Whatever is decided, required cells are covered once and others at most once."""
    layer = random_layer(seed, 8, 9)
    found = layer.problem.placements
    for chosen in (simulated(layer), decided(layer, choose, np.random.default_rng(seed))):
        times = np.bincount(found.cells[found.entries(chosen)], minlength=len(layer.colour))
        assert times.max() == 1
        assert (times[layer.problem.required] == 1).all()


def test_decisions_count():
    """The same search lays far dearer bricks when it is told to; chance is between."""
    layer = random_layer(3, 9, 9)
    cost = [
        layer.cost[decided(layer, each, np.random.default_rng(0))].sum() for each in (cheapest, by_chance, smallest)
    ]
    assert cost[0] < 0.9 * cost[1]
    assert cost[1] < cost[2]


def test_new_fills_are_kept_or_not():
    """From the second pass on it is decided as well which fill is kept, and what bricks cost is not looked at."""
    layer = random_layer(3, 9, 9)

    def old(outcome, candidates, rng):
        del outcome, rng
        assert candidates.shape[1] == 2
        return np.zeros(len(candidates), dtype=np.intp)

    def new(outcome, candidates, rng):
        return old(outcome, candidates, rng) + 1

    once = decided(layer, by_chance, np.random.default_rng(0), passes=1)
    kept = decided(layer, by_chance, np.random.default_rng(0), passes=3, keep=old)
    np.testing.assert_array_equal(kept, once)
    worse = layer.cost[decided(layer, by_chance, np.random.default_rng(0), passes=3, keep=new)].sum()
    assert layer.cost[decided(layer, by_chance, np.random.default_rng(0), passes=3, keep=cheapest)].sum() < worse


def test_later_passes_only_save():
    """If fills are kept by their cost, further passes never make a layer dearer."""
    layer = random_layer(5, 10, 10)
    cost = [layer.cost[decided(layer, cheapest, np.random.default_rng(0), passes=n)].sum() for n in (1, 3, 6)]
    assert np.diff(cost).max() < 0.5
    assert cost[-1] < cost[0]


@pytest.mark.parametrize(("rows", "n"), [(["rrrrrrrr"] * 2, 1), (["rrrr"] * 4, 2), (["rbrb"] * 2, 4)])
def test_known_best_fills(rows, n):
    """Where the best fill is known, it is found."""
    assert len(decided(layer_of(*rows), cheapest, np.random.default_rng(0))) == n


def test_the_same_seed_gives_the_same_fill():
    """Chance comes from the generator alone."""
    layer = random_layer(8, 6, 7)
    one, other = (decided(layer, by_chance, np.random.default_rng(4)) for _ in range(2))
    np.testing.assert_array_equal(one, other)


def test_every_decision_can_be_watched():
    """A watcher sees each step with its candidates, which lie on free cells."""
    seen = []

    def watch(layer, windows, laid, before, candidates, outcome):
        covered = np.bitwise_or.reduce(windows.covered(before), axis=1)
        assert not (windows.covered(candidates) & covered[:, None]).any()
        assert outcome.cost.shape == candidates.shape
        seen.append(before.shape[1])

    decided(random_layer(2), cheapest, np.random.default_rng(0), passes=2, watch=watch)
    assert seen.count(0) == 2
