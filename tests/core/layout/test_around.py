"""Cells laid around bricks that stay: nothing overlaps, all is covered, and what is barred lies nowhere."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.around import lay_around
from legorize_addon.core.layout.lay import Manner
from legorize_addon.core.layout.problem import Bar, owners, with_margins
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, Fill, UnitGrid
from tests.core.any_bricks import table
from tests.core.layout.cells import CATALOGUE, brick_grid

ROW = CATALOGUE.part_row
RED = 4


def occupied(bricks, grid):
    """Return the bricks as cells of a grid."""
    return owners(contact_graph(bricks, CATALOGUE), with_margins(grid.colour, 0).shape)


def around(grid, bricks, bars=()):
    """Lay the rest of a grid, and return all bricks with their graph."""
    manner = Manner("standard", beside=occupied(bricks, grid), bars=bars)
    new = lay_around(grid, CATALOGUE, manner, rng=np.random.default_rng(0))
    rows = [bricks, new]
    together = type(bricks)(*(np.concatenate([getattr(each, name) for each in rows]) for name in bricks.__slots__))
    return new, contact_graph(together, CATALOGUE)


@given(st.integers(2, 8), st.integers(2, 8), st.integers(1, 3), st.data())
@settings(max_examples=12, deadline=None)
def test_the_rest_is_covered_once(n_x, n_y, layers, data):
    """Whatever lies there already, every other cell is covered once; bricks may stand out of the cells to be laid."""
    grid = brick_grid(np.full((layers, n_y, n_x), RED))
    x, y = data.draw(st.integers(0, n_x - 1)), data.draw(st.integers(0, n_y - 1))
    level = data.draw(st.integers(0, 3 * layers - 3))
    new, graph = around(grid, table([(ROW("3005"), x, y, level, 0, RED, 0, 0, 0)]))
    assert graph.collisions == 0
    assert (graph.owner >= 0).sum() == 3 * layers * n_y * n_x
    assert len(new) > 0


def test_bonded_with_what_lies_below():
    """Two bricks side by side that stay are joined by what is laid on them."""
    grid = brick_grid(np.full((2, 2, 8), RED))
    there = table([(ROW("3001"), x, 0, 0, 0, RED, 0, 0, 0) for x in (0, 4)])
    _, graph = around(grid, there)
    assert graph.n_components == 1


def test_nothing_is_left_to_lay():
    """Where bricks fill all cells, no brick is new."""
    grid = brick_grid(np.full((1, 2, 4), RED))
    assert len(around(grid, table([(ROW("3001"), 0, 0, 0, 0, RED, 0, 0, 0)]))[0]) == 0


@given(st.sampled_from(["3001", "3003", "3004", "3024"]), st.integers(0, 5), st.integers(0, 3), st.integers(0, 5))
@settings(max_examples=12, deadline=None)
def test_a_barred_part_lies_elsewhere(number, x, y, level):
    """A part that is barred at a cell does not cover it, in bricks nor in plates, and may lie where it is not."""
    grid = brick_grid(np.full((2, 4, 6), RED))
    marked = np.zeros(with_margins(grid.colour, 0).shape, dtype=bool)
    marked[level + 1, y, x] = True
    there = table([(ROW("3005"), 6, 0, 0, 0, RED, 0, 0, 0)])
    fills = ((grid.colour, COLOUR_EMPTY), (grid.cover, Fill.EMPTY), (grid.role, 0))
    right = [np.pad(each, ((0, 0), (0, 0), (0, 0), (0, 1)), constant_values=fill) for each, fill in fills]
    bars = (Bar(ROW(number), np.pad(marked, ((0, 0), (0, 0), (0, 1)))),)
    new, graph = around(UnitGrid(*right, grid.origin), there, bars)
    owner = graph.owner[level, y, x] - 1
    assert new.part[owner] != ROW(number)


def test_a_bar_changes_the_layout():
    """Without a bar, one brick of this size covers all; with it, another one does."""
    grid = brick_grid(np.full((1, 2, 4), RED))
    marked = np.zeros(with_margins(grid.colour, 0).shape, dtype=bool)
    marked[2, 1, 3] = True
    manner = Manner("standard", bars=(Bar(ROW("3001"), marked),))
    assert len(lay_around(grid, CATALOGUE, Manner("standard"), rng=np.random.default_rng(0))) == 1
    assert len(lay_around(grid, CATALOGUE, manner, rng=np.random.default_rng(0))) == 2
