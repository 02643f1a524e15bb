"""Small lots are merged into close colours, and only these."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.owned.assignment import differences
from legorize_addon.core.owned.few_lots import SMALL, merge_lots
from tests.core.any_bricks import CATALOGUE, table

BRICK = CATALOGUE.part_row("3001")


def row_of(*codes):
    """Return 2 x 4 bricks side by side in some colours."""
    return Assembly(table([(BRICK, 4 * at, 0, 0, 0, code, 0, 0, 0) for at, code in enumerate(codes)]), CATALOGUE)


def merged(codes, *, limit, visible=None):
    """Return the codes after merging."""
    seen = np.ones(len(codes), dtype=int) if visible is None else np.array(visible)
    return merge_lots(row_of(*codes), seen, limit).tolist()


def test_a_single_brick_takes_the_close_colour_of_many():
    """One dark red among five red and five blue ones becomes red, if red is close enough."""
    codes = [4] * 5 + [1] * 5 + [320]
    assert merged(codes, limit=60)[-1] == 4
    assert merged(codes, limit=1) == codes


def test_hidden_bricks_go_into_any_lot():
    """A hidden brick takes the colour of the most, whatever it is."""
    assert merged([1] * 4 + [14], limit=1, visible=[1, 1, 1, 1, 0]) == [1] * 5


def test_lots_of_three_stay():
    """Three bricks are no small lot."""
    codes = [4] * 9 + [320] * (SMALL + 1)
    assert merged(codes, limit=100) == codes


@given(st.lists(st.sampled_from([0, 4, 320, 1, 272, 15, 71]), min_size=1, max_size=14), st.floats(0, 60), st.data())
def test_no_new_lots_and_no_colour_beyond_the_limit(codes, limit, data):
    """Lots never grow in number, each was there before, and what is seen moves by mergers within the limit."""
    visible = data.draw(st.lists(st.integers(0, 3), min_size=len(codes), max_size=len(codes)))
    after = merged(codes, limit=limit, visible=visible)
    assert set(after) <= set(codes)
    apart = differences(CATALOGUE)[CATALOGUE.colour_rows(codes), CATALOGUE.colour_rows(after)]
    assert all(far <= limit for far, seen in zip(apart, visible, strict=True) if seen)
