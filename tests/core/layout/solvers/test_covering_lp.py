"""The linear programme of a sheet, its whole solutions and its dual."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.problem.candidates import Candidates
from legorize_addon.core.layout.solvers.covering_lp import prices, shares, whole_shares
from tests.core.layout.cells import problem_of, random_sheet

TRIANGLE = Candidates(np.arange(6), np.array([2, 2, 2, 1, 1, 1]), np.array([0, 1, 1, 2, 2, 0, 0, 1, 2]))
"""Three cells of which any two fit under one placement, and each under one of its own."""


def test_shares_may_be_halves():
    """Three pairs of three cells cost one and a half; whole, they cost two."""
    required, cost = np.ones(3, dtype=bool), np.ones(6)
    assert shares(TRIANGLE, required, cost) == pytest.approx([0.5, 0.5, 0.5, 0, 0, 0])
    assert whole_shares(TRIANGLE, required, cost, 100).sum() == 2


def test_optional_cells_are_covered_once_at_most():
    """With one required cell one placement suffices, with two that share an optional cell as well."""
    assert shares(TRIANGLE, np.array([True, False, False]), np.ones(6)).sum() == pytest.approx(1)
    chain = Candidates(np.arange(2), np.array([2, 2]), np.array([0, 1, 1, 2]))
    assert shares(chain, np.array([True, False, True]), np.ones(2)).sum() == pytest.approx(1)


def test_what_cannot_be_covered_stays_bare():
    """Two overlapping pairs cannot both lie on three cells: one cell stays bare."""
    chain = Candidates(np.arange(2), np.array([2, 2]), np.array([0, 1, 1, 2]))
    assert whole_shares(chain, np.ones(3, dtype=bool), np.ones(2), 10).sum() == 1


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=20, deadline=None)
def test_prices_and_shares_agree(seed):
    """Strong duality: the cells are worth what the best shares cost, and no placement is worth more than its cost."""
    problem = problem_of(*random_sheet(seed))
    candidates = Candidates.of(problem.placements)
    cell, price = prices(candidates, problem.required, problem.cost)
    assert price.sum() == pytest.approx(shares(candidates, problem.required, problem.cost) @ problem.cost)
    worth = np.zeros(len(problem.required))
    worth[cell] = price
    assert (
        np.bincount(np.repeat(candidates.rows, candidates.size), weights=worth[candidates.cells]) <= problem.cost + 1e-6
    ).all()
    assert worth[~problem.required].max(initial=0) <= 0
