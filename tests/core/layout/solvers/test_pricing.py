"""Guessing what cells are worth, and leaving out what costs more."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.problem.candidates import Candidates
from legorize_addon.core.layout.solvers.covering_lp import shares
from legorize_addon.core.layout.solvers.pricing import guessed_prices, promising
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, Fill
from tests.core.layout.cells import RED, problem_of, random_sheet


def least(problem, kept=None):
    """Return what the best shares cost, of all placements or of those kept."""
    candidates = Candidates.of(problem.placements)
    candidates = candidates if kept is None else candidates.only(kept)
    cost = problem.cost[candidates.rows]
    return shares(candidates, problem.required, cost) @ cost


@pytest.mark.parametrize("length", [1, 2, 3, 4, 6, 8])
def test_the_cells_under_one_brick_are_worth_about_that_brick(length):
    """Where a single part covers everything, the prices add up to nearly its cost."""
    problem = problem_of(np.full((1, length), RED))
    assert guessed_prices(problem).sum() == pytest.approx(problem.cost.min(), abs=0.25)


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=25, deadline=None)
def test_what_need_not_be_covered_is_worth_nothing(seed):
    """Prices of optional cells are never positive."""
    problem = problem_of(*random_sheet(seed))
    assert (guessed_prices(problem)[~problem.required] <= 0).all()


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=25, deadline=None)
def test_what_can_be_covered_still_can(seed):
    """The least cost without the placements left out is finite, and not below that of all, whatever the prices are."""
    problem = problem_of(*random_sheet(seed))
    price = np.random.default_rng(seed).normal(size=len(problem.required))
    found, kept = problem.placements, promising(problem, price)
    there = np.zeros(len(problem.required), dtype=bool)
    there[Candidates.of(found).only(kept).cells] = True
    assert there[problem.required].all()
    assert least(problem, kept) >= least(problem) - 1e-5


def test_good_placements_stay():
    """On sheets at random the best shares of a part of the placements cost hardly more than those of all."""
    rest, everything, n_kept, n_all = 0.0, 0.0, 0, 0
    for seed in range(12):
        problem = problem_of(*random_sheet(seed, (12, 14)))
        kept = promising(problem, guessed_prices(problem))
        rest, everything = rest + least(problem, kept), everything + least(problem)
        n_kept, n_all = n_kept + np.count_nonzero(kept), n_all + len(kept)
    assert rest < 1.01 * everything
    assert n_kept < 0.7 * n_all


def test_cells_without_a_brick_of_their_own_keep_all_placements():
    """Where no brick of one cell is made, nothing is left out."""
    problem = problem_of(np.full((4, 9), RED))
    found = problem.placements
    rows = np.flatnonzero(found.size > 1)
    problem = replace(problem, placements=found.take(rows), cost=problem.cost[rows])
    assert promising(problem, np.full(len(problem.required), -9.0)).all()


def test_nothing_to_cover():
    """A sheet on which nothing has to be covered has no placements and no prices."""
    colour = np.full((3, 4), RED)
    colour[1, 2] = COLOUR_EMPTY
    problem = problem_of(colour, np.where(colour == RED, Fill.OPTIONAL, Fill.EMPTY))
    assert not guessed_prices(problem).any()
    assert not len(promising(problem, guessed_prices(problem)))
