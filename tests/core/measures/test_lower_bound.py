"""The lower bound: what is known of special models, and that no layout falls below it."""

from __future__ import annotations

import sys
from typing import get_args

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.errors import Cancelled
from legorize_addon.core.layout.lay import Tier, lay
from legorize_addon.core.layout.problem.candidates import Candidates
from legorize_addon.core.layout.solvers import covering_lp as programme
from legorize_addon.core.measures.lower_bound import cell_prices, least_cost, lower_bound
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill
from tests.core.layout.cells import CATALOGUE, RED, WHITE, brick_grid, disc, grid_of, problem_of, random_sheet


@given(st.integers(0, 2**32 - 1), st.sampled_from(get_args(Tier)))
@settings(max_examples=20, deadline=None)
def test_no_layout_has_fewer_bricks(seed, tier):
    """The bound is at most the number of bricks of every tier."""
    sheets = [random_sheet([seed, number]) for number in range(3)]
    colour, cover = (np.stack(each) for each in zip(*sheets, strict=True))
    grid = brick_grid(colour, cover)
    bricks = lay(grid, CATALOGUE, rng=np.random.default_rng(0), tier=tier)
    assert 1 <= lower_bound(grid, CATALOGUE) <= len(bricks)


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=20, deadline=None)
def test_no_placement_is_worth_more_than_a_brick(seed):
    """The prices prove the bound: they are feasible for every placement, and optional cells are worth nothing more."""
    problem = problem_of(*random_sheet(seed))
    candidates = Candidates.of(problem.placements)
    price = cell_prices(candidates, problem.required, problem.corner)
    worth = np.bincount(np.repeat(candidates.rows, candidates.size), weights=price[candidates.cells])
    assert worth.max() <= 1 + 1e-9
    assert price[~problem.required].max(initial=0) <= 0


@pytest.mark.parametrize("many", [0, 10**6])
@given(st.integers(0, 2**32 - 1))
@settings(max_examples=10, deadline=None)
def test_the_prices_are_worth_the_linear_programme(many, seed):
    """Either method finds prices that are worth as much as the least shares, and the best layout is not worth less."""
    problem = problem_of(*random_sheet(seed))
    candidates, cost = Candidates.of(problem.placements), np.ones(len(problem.placements))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(programme, "_MANY", many)
        worth = cell_prices(candidates, problem.required, problem.corner).sum()
    whole = programme.whole_shares(candidates, problem.required, cost, 10_000)
    assert worth == pytest.approx(programme.shares(candidates, problem.required, cost).sum(), abs=1e-6)
    assert worth <= whole.sum() + 1e-6


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
    assert lower_bound(brick_grid(np.asarray(colour)[None]), CATALOGUE) == least


def test_bricks_and_plates_are_added():
    """A brick and two plates on it need three parts."""
    colour = np.full((2, 3, 1, 1), RED)
    colour[1, 2] = COLOUR_EMPTY
    assert lower_bound(grid_of(colour), CATALOGUE) == 3


def test_optional_cells_count_only_where_they_help():
    """Two cells that touch at a corner need one brick with a cell between that may be covered, two without."""
    colour = [[RED, COLOUR_ANY], [COLOUR_EMPTY, RED]]
    grid = brick_grid([colour], [[[Fill.REQUIRED, Fill.OPTIONAL], [Fill.EMPTY, Fill.REQUIRED]]])
    without = brick_grid([[[RED, COLOUR_EMPTY], [COLOUR_EMPTY, RED]]])
    assert (lower_bound(grid, CATALOGUE), lower_bound(without, CATALOGUE)) == (1, 2)


def test_wide_slabs():
    """A slab of 64 x 64 needs 256 bricks; a wide disc needs more than its cells ask for."""
    assert lower_bound(brick_grid(np.full((1, 64, 64), RED)), CATALOGUE) == 256
    wide = disc(20)
    assert lower_bound(brick_grid(wide[None]), CATALOGUE) > 1.3 * np.count_nonzero(wide == RED) / 16


@pytest.mark.parametrize(("large", "wide"), [(0, 10**6), (0, 0)])
def test_prices_around_the_middle_lose_little(large, wide):
    """At once or in blocks, prices are feasible, and worth nearly as much as those of the whole disc."""
    problem = problem_of(disc(14))
    candidates = Candidates.of(problem.placements)
    whole = cell_prices(candidates, problem.required, problem.corner).sum()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys.modules[cell_prices.__module__], "_LARGE", large)
        patch.setattr(sys.modules[cell_prices.__module__], "_WIDE", wide)
        price = cell_prices(candidates, problem.required, problem.corner)
    worth = np.bincount(np.repeat(candidates.rows, candidates.size), weights=price[candidates.cells])
    assert worth.max() <= 1 + 1e-9
    assert 0.9 * whole <= price.sum() <= whole + 1e-6


def test_a_checkerboard_needs_a_brick_a_cell():
    """Where all cells have one placement each, nothing is left to be priced."""
    colour = np.where(np.indices((20, 20)).sum(axis=0) % 2, RED, WHITE)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys.modules[cell_prices.__module__], "_LARGE", 0)
        assert lower_bound(brick_grid(colour[None]), CATALOGUE) == 400


def test_progress_may_cancel():
    """A request to stop comes through."""

    def stop(stage, share):
        raise Cancelled

    with pytest.raises(Cancelled):
        lower_bound(brick_grid([[[RED]]]), CATALOGUE, progress=stop)


def test_least_cost_of_known_sheets():
    """A row of four costs a 1 x 4, or two 1 x 2 where they are cheaper; hidden bricks have the cheapest colour."""
    two, four = CATALOGUE.part_row("3004"), CATALOGUE.part_row("3010")
    price = np.ones(CATALOGUE.exists.shape)
    row = brick_grid(np.full((1, 1, 4), RED))
    assert least_cost(row, CATALOGUE, price) == pytest.approx(1, abs=1e-5)
    price[two], price[four] = 0.3, 0.7
    assert least_cost(row, CATALOGUE, price) == pytest.approx(0.6, abs=1e-5)
    price[four, CATALOGUE.colour_row(2)] = 0.25
    assert least_cost(row, CATALOGUE, price) == pytest.approx(0.6, abs=1e-5)
    assert least_cost(brick_grid(np.full((1, 1, 4), COLOUR_ANY)), CATALOGUE, price) == pytest.approx(0.25, abs=1e-5)
    assert least_cost(row, CATALOGUE, np.zeros_like(price)) == 0
