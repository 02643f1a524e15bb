"""Windows: every brick in one, none too large, none of two polygons, and what may be laid is all that may."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.learning.fill import simulated
from legorize_addon.core.layout.learning.simulation import MOST_CELLS
from legorize_addon.core.layout.learning.windows import Lists, grouped
from tests.core.layout.learning.layers import random_layer


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=6, deadline=None)
def test_windows_divide_the_bricks(seed):
    """Each brick is in the window that has all of its cells; no cell is in two; polygons stay apart."""
    layer = random_layer(seed, 10, 12)
    chosen = simulated(layer)
    cells, window = grouped(layer, chosen, np.random.default_rng(seed).permutation(len(chosen)))
    n_cells, found = len(layer.colour), layer.problem.placements
    used = cells[cells < n_cells]
    assert len(np.unique(used)) == len(used)
    assert (np.diff(cells, axis=1) >= 0).all()
    for number, row in enumerate(chosen):
        assert np.isin(found.cells[found.start[row] : found.start[row + 1]], cells[window[number]]).all()
    for number in range(len(cells)):
        assert len(np.unique(layer.polygon[layer.home[chosen[window == number]]])) == 1


@given(st.integers(0, 2**32 - 1), st.integers(0, 5))
@settings(max_examples=6, deadline=None)
def test_everything_inside_is_listed(seed, turn):
    """The placements of a window are those all of whose cells it has, in the order of its turn."""
    layer = random_layer(seed, 9, 12)
    n_cells, rng = len(layer.colour), np.random.default_rng(seed)
    cells = np.full((3, MOST_CELLS), n_cells)
    for number, part in enumerate(np.array_split(rng.permutation(n_cells)[: 3 * 40], 3)):
        cells[number, : len(part)] = np.sort(part)
    windows = Lists(layer).windows(cells, turn)
    for number in range(3):
        inside = np.isin(np.append(np.arange(n_cells), -1), cells[number])
        inside[-1] = True
        expected = np.flatnonzero(inside[np.minimum(layer.cells, n_cells)].all(axis=1))
        rows = windows.rows[number][windows.rows[number] < len(layer.cost)]
        np.testing.assert_array_equal(rows, expected[np.argsort(layer.ranks[turn % 3, expected])])
        assert int(windows.free[number]).bit_count() == (cells[number] < n_cells).sum()
        needed = layer.problem.required[cells[number][cells[number] < n_cells]].sum()
        assert int(windows.needed[number]).bit_count() == needed
        bits = [int(each).bit_count() for each in windows.bits[number][: len(rows)]]
        np.testing.assert_array_equal(bits, layer.problem.placements.size[rows])
        np.testing.assert_array_equal(windows.inside[number].sum(axis=1)[: len(rows)], bits)
