"""What a brick costs in the end, against trying everything."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.learning.layer import LONELY
from legorize_addon.core.layout.learning.regret import regrets
from tests.core.layout.learning.layers import layer_of, random_layer
from tests.core.layout.learning.test_simulation import whole

NOTHING = np.zeros(0, np.intp)


def tried(layer, windows, axis, covered, rows):
    """Return the least cost of covering what is left, with mirror images about one axis, by trying everything."""
    needed = int(windows.needed[0]) & ~covered
    if not needed:
        lonely = sum(1 for row in rows if layer.mirror[axis, row] not in rows)
        return sum(layer.cost[row] for row in rows) + LONELY * lonely
    bit = needed & -needed
    return min(
        tried(layer, windows, axis, covered | int(bits), [*rows, row])
        for bits, row in zip(windows.bits[0].tolist(), windows.rows[0].tolist(), strict=True)
        if row < len(layer.cost) and bits & bit and not bits & covered
    )


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=4, deadline=None)
def test_against_trying_everything(seed):
    """The regrets of all candidates are those of the best of all fills."""
    layer = random_layer(seed, 3, 4)
    windows, laid = whole(layer), np.zeros(len(layer.cost), bool)
    [found] = windows.candidates(~windows.free)
    found = found[found >= 0]
    costs = [
        tried(layer, windows, 0, int(~windows.free[0]) | int(windows.bits[0, each]), [int(windows.rows[0, each])])
        for each in found
    ]
    expected = np.array(costs) - min(costs)
    np.testing.assert_allclose(regrets(layer, windows, laid, 0, NOTHING, found), expected, atol=1e-5)


def test_the_best_brick_costs_nothing():
    """On a strip of eight, the 1 x 8 costs nothing and a 1 x 6 one brick more; what lies there is counted in."""
    layer = layer_of("rrrrrrrr")
    windows, laid = whole(layer), np.zeros(len(layer.cost), bool)
    [found] = windows.candidates(~windows.free)
    found = found[found >= 0]
    size = layer.problem.placements.size[windows.rows[0, found]]
    cost = dict(zip(size.tolist(), regrets(layer, windows, laid, 0, NOTHING, found).tolist(), strict=True))
    assert cost[8] == 0
    assert cost[6] == pytest.approx(1.5, abs=0.3)
    column = found[size == 6]
    [rest] = windows.candidates(~windows.free | windows.bits[0, column])
    assert regrets(layer, windows, laid, 0, column, rest[rest >= 0]).min() == 0
