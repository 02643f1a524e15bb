"""Smooth tops of whole layouts: same cells, same colours, as whole as before, and no tile holds anything."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout import lay, smooth_tops
from legorize_addon.core.layout.top_pieces import HIDDEN, HOLDS, NONE, SEEN
from legorize_addon.core.layout.tops import stud_states
from legorize_addon.core.model import COLOUR_EMPTY, NOBODY, Role, contact_graph
from tests.core.any_bricks import CATALOGUE, table
from tests.core.layout.cells import RED, WHITE, brick_grid, grid_of

ROW = CATALOGUE.part_row
TILE = np.array([part.profile == "tile" for part in CATALOGUE.parts])


def smoothed(bricks, price, **options):
    """Return a layout with smooth tops, all of whose bricks may change."""
    return smooth_tops(bricks, CATALOGUE, price=price, may=np.ones(len(bricks), bool), **options)


def cells(bricks):
    """Return the colour of every cell, -1 where there is none."""
    graph = contact_graph(bricks, CATALOGUE)
    assert graph.collisions == 0
    return np.append(bricks.colour, -1)[graph.owner]


def heap(seed):
    """Return a layout of a heap of cells whose columns end at random, in plates."""
    rng = np.random.default_rng(seed)
    high = rng.integers(1, 10, (6, 7))
    solid = np.arange(9)[:, None, None] < high
    colour = np.where(solid, np.where(rng.random((6, 7)) < 0.2, WHITE, RED), COLOUR_EMPTY)
    grid = grid_of(colour.reshape(3, 3, 6, 7))
    return lay(grid, CATALOGUE, rng=np.random.default_rng(0))


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.0, 1.0, 2.0, np.inf]))
@settings(max_examples=20, deadline=None)
def test_what_holds_for_all_layouts(seed, price):
    """Cells and colours stay, all is as whole as before, nothing lies on a tile, parts pay, colours are made."""
    bricks = heap(seed)
    made = smoothed(bricks, price)
    assert (cells(made.bricks) == cells(bricks)).all()
    graph, before = (contact_graph(each, CATALOGUE) for each in (made.bricks, bricks))
    tiles = np.flatnonzero(TILE[made.bricks.part])
    x, y, z = made.bricks.corner[tiles].T
    assert not np.isin(graph.pairs[:, 0], tiles).any()
    roof = np.pad(graph.owner, ((0, 1), (0, 0), (0, 0)), constant_values=NOBODY)
    assert (roof[z + 1, y, x] == NOBODY).all()
    assert graph.n_components <= before.n_components
    assert graph.n_floating <= before.n_floating
    assert CATALOGUE.exists_in(made.bricks.part, made.bricks.colour).all()
    more = len(made.bricks) - len(bricks)
    assert more == 0 if price == np.inf else made.seen - made.left >= price * more
    # what is in sight before and after, counted anew
    for each, count in ((bricks, made.seen), (made.bricks, made.left)):
        assert np.count_nonzero(stud_states(each, CATALOGUE).state == SEEN) == count
    assert (bricks.colour[made.origin] == made.bricks.colour).all()


def test_a_plate_that_ties_stays():
    """Without it, what lies below falls apart: cut or not, it costs nothing to try."""
    rows = [(ROW("3005"), x, 0, 0, 0, RED, 0, 0, 0) for x in range(2)]
    rows += [(ROW("3023"), 0, 0, 3, 0, RED, 0, 0, 1), (ROW("3005"), 0, 0, 4, 0, RED, 0, 0, 1)]
    bricks = table(rows)
    made = smoothed(bricks, 0.0)
    assert contact_graph(made.bricks, CATALOGUE).n_components == 1
    assert np.count_nonzero(made.bricks.part == ROW("3023")) == 1


def test_studs_in_a_hollow_stay():
    """Nobody sees them: the plate on the bottom of a closed box is none of those that change."""
    colour = np.full((3, 5, 5), RED)
    colour[1, 1:-1, 1:-1] = COLOUR_EMPTY
    bricks = lay(brick_grid(colour), CATALOGUE, rng=np.random.default_rng(0))
    states = stud_states(bricks, CATALOGUE)
    assert np.count_nonzero(states.state == HIDDEN) == 9
    assert np.count_nonzero(states.state == SEEN) == 25
    assert np.count_nonzero(states.state == HOLDS) == 32
    assert not (states.state == NONE).any()
    made = smoothed(bricks, 0.0)
    assert np.count_nonzero(stud_states(made.bricks, CATALOGUE).state == HIDDEN) == 9
    assert made.left == 0


def test_what_may_not_change():
    """Bricks that are kept, and pillars, keep their studs."""
    bricks = table([(ROW("3022"), 3 * x, 0, 0, 0, RED, role, 0, 0) for x, role in enumerate((0, 0, Role.SUPPORT_KEPT))])
    made = smooth_tops(bricks, CATALOGUE, price=0.0, may=np.array([True, False, True]))
    assert made.bricks.part.tolist() == [ROW("3068b"), ROW("3022"), ROW("3022")]
    assert (made.seen, made.left) == (12, 8)


@pytest.mark.parametrize("there", [0, 1, 5])
def test_as_many_as_there_are(there):
    """Where few tiles are owned, the highest plates get them."""
    bricks = table([(ROW("3022"), 3 * x, 0, z, 0, RED, 0, 0, 0) for x, z in enumerate((0, 2, 1))])
    at_most = np.zeros(len(CATALOGUE.parts), np.int64)
    at_most[ROW("3068b")] = there
    made = smoothed(bricks, np.inf, at_most=at_most)
    found = made.bricks.part == ROW("3068b")
    assert found.tolist() == {0: [False] * 3, 1: [False, True, False], 5: [True] * 3}[there]


def test_tiles_that_are_there_count():
    """Of two owned tiles one lies there already: one more plate becomes a tile."""
    bricks = table([(ROW(part), 3 * x, 0, 0, 0, RED, 0, 0, 0) for x, part in enumerate(("3022", "3022", "3068b"))])
    at_most = np.zeros(len(CATALOGUE.parts), np.int64)
    at_most[ROW("3068b")] = 2
    assert np.count_nonzero(smoothed(bricks, np.inf, at_most=at_most).bricks.part == ROW("3068b")) == 2
