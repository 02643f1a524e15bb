"""The standard tier on single sheets: exact covers, close to the best, always the same."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.problem.candidates import Candidates
from legorize_addon.core.layout.solvers import greedy, linear
from legorize_addon.core.layout.solvers.covering_lp import shares, whole_shares
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill
from tests.core.layout.cells import RED, WHITE, assert_covered_once, disc, problem_of, random_sheet, ring


def laid(problem, seed=0):
    """Return the chosen rows."""
    return linear.cover(problem, np.random.default_rng(seed))


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=30, deadline=None)
def test_must_cells_once_and_others_at_most_once(seed):
    """No two bricks overlap and every required cell is covered."""
    problem = problem_of(*random_sheet(seed))
    assert_covered_once(problem, laid(problem))


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=15, deadline=None)
def test_close_to_the_best_cost(seed):
    """On small sheets the cost is at least that of the best shares and at most a brick above the best layout."""
    problem = problem_of(*random_sheet(seed, (7, 7)))
    cost = problem.cost[laid(problem)].sum()
    candidates = Candidates.of(problem.placements)
    best = whole_shares(candidates, problem.required, problem.cost, 10_000) @ problem.cost
    assert shares(candidates, problem.required, problem.cost) @ problem.cost - 1e-6 <= best
    assert best - 1e-3 <= cost <= best + 1


@pytest.mark.parametrize(
    "colour",
    [np.full((16, 16), RED), np.full((25, 30), RED), np.full((3, 40), RED), disc(7), disc(12), ring(18), ring(31)],
    ids=["square", "wide", "strip", "small disc", "disc", "small ring", "ring"],
)
def test_not_dearer_than_the_fast_tier(colour):
    """Known shapes cost no more than what the fast tier makes of them."""
    problem = problem_of(colour)
    quick = greedy.cover(problem, np.random.default_rng(0))
    rows = laid(problem)
    assert_covered_once(problem, rows)
    assert problem.cost[rows].sum() <= problem.cost[quick].sum() + 1e-9


@pytest.mark.parametrize(
    ("n_y", "n_x", "bricks"), [(1, 1, 1), (2, 8, 1), (1, 5, 2), (1, 7, 2), (3, 3, 2), (5, 5, 3), (16, 16, 16)]
)
def test_rectangles_take_few_bricks(n_y, n_x, bricks):
    """Rectangles take the bricks that their cells and the largest parts ask for, two more where parts do not fit."""
    rows = laid(problem_of(np.full((n_y, n_x), RED)))
    assert bricks <= len(rows) <= bricks + 2 * (n_y * n_x in (9, 25))


def test_a_wide_slab_takes_nearly_the_largest_parts():
    """A slab of one colour, 60 x 60, is laid with at least 14.5 of the 16 cells that the largest part has."""
    problem = problem_of(np.full((60, 60), RED))
    rows = laid(problem)
    assert_covered_once(problem, rows)
    assert 3600 / len(rows) >= 14.5


def test_wide_slabs_of_two_colours():
    """Where two wide slabs meet every cell keeps its colour."""
    colour = np.full((40, 44), RED)
    colour[:, 19:] = WHITE
    problem = problem_of(colour)
    rows = laid(problem)
    assert_covered_once(problem, rows)
    found = problem.placements
    inside = colour.reshape(-1)[found.cells[found.entries(rows)]]
    np.testing.assert_array_equal(np.repeat(found.colour[rows], found.size[rows]), inside)


def test_optional_cells_save_bricks():
    """Two cells that touch at a corner are one brick if a cell beside both may be covered."""
    colour = [[RED, COLOUR_ANY], [COLOUR_EMPTY, RED]]
    assert len(laid(problem_of(colour, [[Fill.REQUIRED, Fill.OPTIONAL], [Fill.EMPTY, Fill.REQUIRED]]))) == 1


def test_seams_below_are_bridged():
    """Over two bricks of 2 x 4 end to end, a brick lies across their seam if it costs no brick more."""
    below = np.where(np.arange(8) < 4, 0, 1) * np.ones((2, 1), np.int32)
    problem = problem_of(np.full((2, 8), RED), owner=below)
    (row,) = laid(problem)
    assert problem.placements.size[row] == 16
    assert problem.cost[row] == pytest.approx(1 - 2 * 0.12)


def test_same_seed_same_bricks():
    """The same state of the generator gives the same bricks; the problem is not changed."""
    problem = problem_of(disc(11))
    before = problem.cost.copy()
    np.testing.assert_array_equal(laid(problem, 3), laid(problem, 3))
    np.testing.assert_array_equal(problem.cost, before)


def test_a_cell_that_cannot_be_covered_stays_bare():
    """Where no part of one cell exists, the rest is covered all the same."""
    problem = problem_of(np.full((1, 5), RED))
    found = problem.placements
    pairs = np.flatnonzero((found.size == 2) & (found.corner[:, 0] % 2 == 0))
    candidates = Candidates.of(found).only(np.isin(np.arange(len(found)), pairs))
    covered = linear.dive(candidates, problem.required, problem.cost)
    assert covered.rows.tolist() == pairs.tolist()
    assert shares(candidates, problem.required, problem.cost[pairs]) == pytest.approx(1)


def test_a_cheap_layout_with_holes_is_not_taken(monkeypatch):
    """Where the blocks of a wide sheet leave cells bare, the quick layout covers them."""
    problem = problem_of(np.full((30, 30), RED))
    monkeypatch.setattr(linear, "_piecewise", lambda problem, candidates, cost: np.zeros(0, dtype=np.intp))
    assert_covered_once(problem, laid(problem))
