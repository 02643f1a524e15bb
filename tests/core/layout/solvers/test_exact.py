"""The exact tier: the best cost on small sheets, and never more than the standard tier."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.problem.candidates import Candidates
from legorize_addon.core.layout.solvers import exact, linear
from legorize_addon.core.layout.solvers.covering_lp import whole_shares
from tests.core.layout.cells import RED, assert_covered_once, disc, problem_of, random_sheet


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=15, deadline=None)
def test_the_best_cost(seed):
    """Branch and bound over all placements of the sheet at once finds nothing cheaper."""
    problem = problem_of(*random_sheet(seed, (7, 8)))
    rows = exact.cover(problem, np.random.default_rng(0))
    assert_covered_once(problem, rows)
    best = whole_shares(Candidates.of(problem.placements), problem.required, problem.cost, 10_000) @ problem.cost
    assert problem.cost[rows].sum() == pytest.approx(best, rel=2e-4)


@pytest.mark.parametrize("colour", [disc(5), np.full((7, 9), RED)], ids=["disc", "rectangle"])
def test_not_dearer_than_the_standard_tier(colour):
    """Where shares are not whole, branch and bound can only gain."""
    problem = problem_of(colour)
    rows, standard = (cover(problem, np.random.default_rng(0)) for cover in (exact.cover, linear.cover))
    assert_covered_once(problem, rows)
    assert problem.cost[rows].sum() <= problem.cost[standard].sum() + 1e-6


def test_too_large_a_sheet_is_left_to_the_standard_tier():
    """A wide slab is laid as the standard tier does."""
    problem = problem_of(np.full((32, 32), RED))
    rows, standard = (cover(problem, np.random.default_rng(1)) for cover in (exact.cover, linear.cover))
    np.testing.assert_array_equal(rows, standard)
