"""How high tables are built up."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.skyline import Skyline
from tests.core.building.heaps import cells_of, heap
from tests.core.standing import CATALOGUE, table


def test_what_lies_over_a_brick_covers_it():
    """A roof covers what is below it, not what lies on it, beside it, or on another table."""
    bricks = table(("3003", 0, 0, 6), ("3003", 0, 0, 0), ("3003", 0, 0, 9), ("3003", 2, 0, 0))
    sky = Skyline(bricks, CATALOGUE, 2)
    sky.add(0, 0)
    assert [sky.covers(brick, 0) for brick in (1, 2, 3)] == [True, False, False]
    assert not sky.covers(1, 1)


def test_what_is_taken_out_covers_no_more():
    """After a removal, only what is left counts."""
    bricks = table(("3003", 0, 0, 6), ("3003", 0, 0, 0), ("3003", 0, 0, 3))
    sky = Skyline(bricks, CATALOGUE, 1)
    sky.add(0, 0)
    sky.add(2, 0)
    sky.renew(0, [2])
    assert sky.covers(1, 0)
    sky.renew(0, [])
    assert not sky.covers(1, 0)


@settings(deadline=None, max_examples=80)
@given(st.integers(0, 10**6))
def test_covered_is_what_has_a_cell_over_it(seed):
    """Bricks come to two tables and go again, and each time all cells of all bricks are looked at."""
    rng, bricks = np.random.default_rng(seed), heap(seed)
    bricks.corner[:, :2] -= rng.integers(0, 9, 2)
    cells, n = cells_of(bricks), len(bricks)
    sky, there = Skyline(bricks, CATALOGUE, 2), [set(), set()]
    for _ in range(12):
        table, brick = int(rng.integers(2)), int(rng.integers(n))
        if rng.random() < 0.2:
            there[table] = {row for row in there[table] if rng.random() < 0.5}
            sky.renew(table, there[table])
        else:
            there[table].add(brick)
            sky.add(brick, table)
        for one in range(n):
            low = min(z for *_, z in cells[one])
            filled = {(x, y) for row in there[table] for x, y, z in cells[row] if z >= low}
            assert sky.covers(one, table) == bool(filled & {(x, y) for x, y, _ in cells[one]})


def test_columns_of_a_slope_have_heights_of_their_own():
    """Over the low end of a slope there is room; under the high end of a curve only what came before it."""
    bricks = table(("4286", 0, 0, 0), ("3024", 2, 0, 2), ("50950", 0, 1, 0), ("3024", 0, 1, 0), ("3024", 1, 0, 2))
    sky = Skyline(bricks, CATALOGUE, 1)
    sky.add(0, 0)
    assert not sky.covers(1, 0)
    assert sky.covers(4, 0)
    sky.add(3, 0)
    assert not sky.covers(2, 0)
    sky.renew(0, [2])
    assert sky.covers(3, 0)
