"""Choosing among placements while a sheet fills up."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.layout.problem.candidates import Candidates

LIVE = Candidates(np.array([3, 5, 8, 9]), np.array([2, 1, 2, 1]), np.array([0, 1, 1, 2, 3, 4]))
"""Placements on cells 0 and 1, 1 alone, 2 and 3, 4 alone."""


def test_totals():
    """Amounts are summed placement by placement."""
    assert LIVE.totals(np.arange(6)).tolist() == [1, 2, 7, 5]


def test_winners_have_the_greatest_key_everywhere():
    """Of two placements on a cell the one with the greater key wins; one without rivals wins anyway."""
    assert LIVE.winners(np.array([1, 2, 0, -5]), 5).tolist() == [False, True, True, True]


def test_clear_of_covered_cells():
    """Placements on a covered cell are dropped."""
    left = LIVE.clear_of(np.array([False, True, False, False, False]))
    assert left.rows.tolist() == [8, 9]
    assert left.cells.tolist() == [2, 3, 4]


def test_within_leaves_parts():
    """Cells outside are left out, and placements without cells inside."""
    inside = LIVE.within(np.array([True, False, False, True, True]))
    assert inside.rows.tolist() == [3, 8, 9]
    assert inside.size.tolist() == [1, 1, 1]
    assert inside.cells.tolist() == [0, 3, 4]


def test_groups_share_cells():
    """Placements hang together through common cells."""
    group = LIVE.groups(5)
    assert group[0] == group[1]
    assert len(set(group.tolist())) == 3
