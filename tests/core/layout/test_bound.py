"""The lower bound: what is known of special models, and that no layout falls below it."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.errors import Cancelled
from legorize_addon.core.layout import Tier, bound, lay
from legorize_addon.core.layout.bound import cell_prices
from legorize_addon.core.layout.live import Live
from legorize_addon.core.model import COLOUR_ANY, COLOUR_EMPTY, Cover

from .cells import CATALOGUE, RED, WHITE, brick_grid, disc, grid_of, problem_of, random_sheet


@given(st.integers(0, 2**32 - 1), st.sampled_from(get_args(Tier)))
@settings(max_examples=20, deadline=None)
def test_no_layout_has_fewer_bricks(seed, tier):
    """The bound is at most the number of bricks of every tier."""
    sheets = [random_sheet([seed, number]) for number in range(3)]
    colour, cover = (np.stack(each) for each in zip(*sheets, strict=True))
    grid = brick_grid(colour, cover)
    bricks = lay(grid, CATALOGUE, rng=np.random.default_rng(0), tier=tier)
    assert 1 <= bound(grid, CATALOGUE) <= len(bricks)


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=20, deadline=None)
def test_no_placement_is_worth_more_than_a_brick(seed):
    """The prices prove the bound: they are feasible for every placement, and optional cells are worth nothing more."""
    problem = problem_of(*random_sheet(seed))
    live = Live.of(problem.placements)
    price = cell_prices(live, problem.must, problem.corner)
    worth = np.bincount(np.repeat(live.rows, live.size), weights=price[live.cells])
    assert worth.max() <= 1 + 1e-9
    assert price[~problem.must].max(initial=0) <= 0


@pytest.mark.parametrize(
    ("colour", "least"),
    [
        ([[RED]], 1),
        ([[RED, WHITE, RED]], 3),
        (np.full((1, 5), RED), 2),
        (np.full((1, 17), RED), 3),
        (np.full((16, 16), RED), 16),
        ([[RED, COLOUR_EMPTY, RED, RED]], 2),
    ],
)
def test_known_sheets(colour, least):
    """Where the fewest bricks are known, the bound is this number."""
    assert bound(brick_grid(np.asarray(colour)[None]), CATALOGUE) == least


def test_bricks_and_plates_are_added():
    """A brick and two plates on it need three parts."""
    colour = np.full((2, 3, 1, 1), RED)
    colour[1, 2] = COLOUR_EMPTY
    assert bound(grid_of(colour), CATALOGUE) == 3


def test_optional_cells_count_only_where_they_help():
    """Two cells that touch at a corner need one brick with a cell between that may be covered, two without."""
    colour = [[RED, COLOUR_ANY], [COLOUR_EMPTY, RED]]
    grid = brick_grid([colour], [[[Cover.MUST, Cover.MAY], [Cover.EMPTY, Cover.MUST]]])
    without = brick_grid([[[RED, COLOUR_EMPTY], [COLOUR_EMPTY, RED]]])
    assert (bound(grid, CATALOGUE), bound(without, CATALOGUE)) == (1, 2)


def test_wide_slabs_are_priced_in_blocks():
    """A slab of 64 x 64 needs 256 bricks; a wide disc needs more than its cells ask for."""
    assert bound(brick_grid(np.full((1, 64, 64), RED)), CATALOGUE) == 256
    wide = disc(20)
    assert bound(brick_grid(wide[None]), CATALOGUE) > 1.05 * np.count_nonzero(wide == RED) / 16


def test_progress_may_cancel():
    """A request to stop comes through."""

    def stop(stage, share):
        raise Cancelled

    with pytest.raises(Cancelled):
        bound(brick_grid([[[RED]]]), CATALOGUE, progress=stop)
