"""The simulation, against a plain walk that lays one brick after the other."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.learning import energies
from legorize_addon.core.layout.learning.fill import simulated
from legorize_addon.core.layout.learning.layer import LONELY
from legorize_addon.core.layout.learning.simulation import CANDIDATES, MOST_CELLS, measured, simulate
from legorize_addon.core.layout.learning.windows import Lists
from tests.core.layout.learning.layers import layer_of, random_layer
from tests.core.layout.learning.test_layer import planes_of


def whole(layer):
    """Return the windows of a layer in which it is one, which it has to fit into."""
    cells = np.full((1, MOST_CELLS), len(layer.colour))
    cells[0, : len(layer.colour)] = np.arange(len(layer.colour))
    return Lists(layer).windows(cells, 0)


def walked(layer, first):
    """Lay a placement, then always the first one in order that fits."""
    found = layer.problem.placements
    rows, covered = [first], set(found.cells[found.start[first] : found.start[first + 1]].tolist())
    for row in np.argsort(layer.ranks[0]).tolist():
        cells = set(found.cells[found.start[row] : found.start[row + 1]].tolist())
        if not cells & covered:
            rows.append(row)
            covered |= cells
    return np.array(rows)


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=6, deadline=None)
def test_the_rest_is_filled_behind_each_candidate(seed):
    """Costs and the four energies are those of the layout that a plain walk lays."""
    layer = random_layer(seed)
    windows, n = whole(layer), len(layer.cost)
    candidates = windows.candidates(~windows.free)
    nothing, before = np.zeros(n, bool), np.zeros((1, 0), np.intp)
    outcome = simulate(layer, windows, nothing, before, candidates)
    for number in np.flatnonzero(candidates[0] >= 0):
        rows = walked(layer, windows.rows[0, candidates[0, number]])
        owner, colour = planes_of(layer, rows), layer.problem.placements.colour[rows]
        lonely = min(np.count_nonzero(~np.isin(images[rows], rows)) for images in layer.mirror)
        assert outcome.cost[0, number] == pytest.approx(layer.cost[rows].sum() + LONELY * lonely)
        assert outcome.energies[0, number, 1] == pytest.approx(layer.unstable[rows].sum())
        assert outcome.energies[0, number, 2] == lonely
        assert outcome.energies[0, number, 3] == pytest.approx(layer.small[rows].sum())
        if len(np.unique(colour)) == 1:
            assert outcome.energies[0, number, 0] == len(rows) * energies.minimum_unit_connection(owner, colour)


def test_candidates_cover_the_cell_with_the_fewest_ways():
    """In an L of cells that is its end or the cell alone; as many as there are, the first in order first."""
    layer = layer_of("r....", "...rr", "...rr")
    windows = whole(layer)
    [found] = windows.candidates(~windows.free)
    assert (found >= 0).sum() == 1
    assert layer.problem.placements.cells[layer.problem.placements.start[windows.rows[0, found[0]]]] == 0
    again = windows.candidates(~windows.free | windows.covered(found[None, :1])[:, 0])
    columns = again[again >= 0]
    assert 1 < len(columns) <= CANDIDATES
    assert (np.diff(columns) > 0).all()


def test_nothing_is_left_of_what_is_covered():
    """When all is covered there are no candidates, and optional cells do not ask for any."""
    layer = layer_of("roo")
    windows = whole(layer)
    first = windows.candidates(~windows.free)
    covered = ~windows.free | windows.covered(first[:, :1])[:, 0]
    assert (windows.candidates(covered) == -1).all()


def test_full_windows_keep_their_padding_out():
    """A window of as many cells as there are bits takes no placement that is not there."""
    layer = layer_of(*["r" * 9] * 7)
    windows = whole(layer)
    outcome = simulate(
        layer, windows, np.zeros(len(layer.cost), bool), np.zeros((1, 0), np.intp), windows.candidates(~windows.free)
    )
    assert np.isfinite(outcome.cost).all()
    assert (outcome.cost > 3).all()


def test_mirror_images_outside_count():
    """A brick whose image lies outside the window has one."""
    layer = layer_of("r.r")
    lists = Lists(layer)
    cells = np.full((1, MOST_CELLS), len(layer.colour))
    cells[0, 0] = 0
    windows = lists.windows(cells, 0)
    laid, columns = np.zeros(len(layer.cost), bool), np.array([[[0]]])
    # about the other axis it mirrors itself
    assert measured(layer, windows, laid, columns).energies[0, 0, 2] == 0
    laid[simulated(layer)] = True
    assert measured(layer, windows, laid, columns).energies[0, 0, 2] == 0
