"""The paper's way to lay a model: what every layout keeps, and that it can be told and stopped."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.errors import BuildError, Cancelled
from legorize_addon.core.layout.lay_learned import lay_learned
from legorize_addon.core.model import COLOUR_EMPTY, contact_graph
from tests.core.layout.cells import CATALOGUE, assert_covers, brick_grid
from tests.core.layout.test_lay import random_grid, rows


def laid(grid, **options):
    """Return the bricks of a grid."""
    return lay_learned(grid, CATALOGUE, rng=np.random.default_rng(0), **options)


@given(st.integers(0, 2**32 - 1), st.booleans())
@settings(max_examples=5, deadline=None)
def test_what_every_layout_keeps(seed, plates):
    """Required cells once, optional cells at most once; colours kept; parts exist; nothing overlaps."""
    grid = random_grid(seed, plates)
    assert_covers(laid(grid), grid)


def test_bricks_lie_across_the_seams_below():
    """A solid block is one piece of few bricks, the same for the same seed."""
    grid = brick_grid(np.full((4, 8, 12), 4))
    bricks = laid(grid)
    assert contact_graph(bricks, CATALOGUE).n_components == 1
    assert len(bricks) <= 4 * 8
    assert rows(bricks) == rows(laid(grid))


def test_nothing_to_build_is_refused():
    """An empty grid gives one sentence."""
    with pytest.raises(BuildError, match="no cells to build"):
        laid(brick_grid(np.full((1, 3, 3), COLOUR_EMPTY)))


def test_a_stop_is_heard_between_layers():
    """Progress rises, and what it raises ends the work."""
    told = []

    def progress(stage, share):
        told.append(share)
        if len(told) == 3:
            raise Cancelled

    with pytest.raises(Cancelled):
        laid(brick_grid(np.full((6, 4, 4), 4)), progress=progress)
    assert told == sorted(told)
