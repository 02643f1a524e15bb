"""Leaving placements out that others make superfluous."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.problem.candidates import Candidates
from legorize_addon.core.layout.problem.dominance import dominated
from legorize_addon.core.layout.solvers.covering_lp import shares
from legorize_addon.core.model.unit_grid import COLOUR_ANY, Fill
from tests.core.layout.cells import RED, problem_of, random_sheet


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=25, deadline=None)
def test_the_least_cost_stays(seed):
    """The best shares cost the same with and without the dominated placements."""
    problem = problem_of(*random_sheet(seed))
    everything = Candidates.of(problem.placements)
    rest = everything.only(~dominated(problem.placements, problem.shapes, problem.required, problem.cost))
    least, again = (
        shares(each, problem.required, problem.cost[each.rows]) @ problem.cost[each.rows] for each in (everything, rest)
    )
    assert again == pytest.approx(least, abs=1e-5)


def test_nothing_is_dominated_where_all_cells_must_be_covered():
    """Without optional cells every placement covers other cells."""
    problem = problem_of(np.full((5, 6), RED))
    assert not dominated(problem.placements, problem.shapes, problem.required, problem.cost).any()


def test_a_wall_need_not_reach_inwards():
    """Beside a straight wall of one row only parts of that row are left, if all cost the same."""
    colour = np.full((2, 9), RED)
    colour[1] = COLOUR_ANY
    cover = np.where(colour == RED, Fill.REQUIRED, Fill.OPTIONAL)
    problem = problem_of(colour, cover)
    cost = np.ones(len(problem.placements))
    rest = np.flatnonzero(~dominated(problem.placements, problem.shapes, problem.required, cost))
    assert (problem.shapes.extent[problem.placements.shape[rest], 1] == 1).all()
