"""Trajectories as lines in space."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.method.lines import trajectory_lines
from legorize_addon.core.method.trajectory_maps import EXTERIOR
from tests.core.any_bricks import CATALOGUE
from tests.core.method.drafts import HEIGHT, LEVELS, draft


@pytest.mark.parametrize("shown", ["sides", "colours"])
def test_lines_lie_in_their_layers(shown):
    """Points are relative to the grid, within the model, at the height of their slice."""
    lines = trajectory_lines(draft(), CATALOGUE, shown=shown)
    assert lines.count.sum() == len(lines.points)
    heights = lines.points[:, 2]
    within = heights / 9.6 - np.repeat(lines.layer, lines.count)
    np.testing.assert_allclose(np.unique(within.round(6)), [1 / 6, 1 / 2, 5 / 6], atol=1e-6)
    assert 0 < heights.min() < heights.max() < HEIGHT
    assert (lines.points[:, :2] > 0).all()


def test_sides_are_closed_loops():
    """A line a loop, half of them exterior."""
    lines = trajectory_lines(draft(), CATALOGUE, shown="sides")
    assert lines.closed
    assert len(lines.count) == LEVELS * 3 * 5
    assert lines.paints[0] == ("exterior", EXTERIOR)
    assert np.bincount(lines.paint).tolist() == [30, 30]


def test_colours_are_those_of_the_bricks():
    """Red and blue lines, open ones."""
    lines = trajectory_lines(draft(), CATALOGUE, shown="colours")
    assert not lines.closed
    assert [name for name, _ in lines.paints] == ["Blue", "Red"]
