"""Trajectories as lines of one colour each."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.method.colour_runs import colour_runs
from tests.core.method.drafts import draft


def test_lines_cover_every_edge_once():
    """Their lengths add up to those of the edges, by colour, and they begin where the one before ends."""
    trajectories = draft().trajectories
    runs = colour_runs(trajectories)
    steps = np.linalg.norm(np.diff(runs.points, axis=0), axis=1)
    ends = np.cumsum(runs.count) - 1
    inside = np.ones(len(steps), dtype=bool)
    inside[ends[:-1]] = False
    line = np.repeat(np.arange(len(runs.count)), runs.count - 1)
    edges = np.linalg.norm(trajectories.ends - trajectories.points, axis=1)
    for code in np.unique(trajectories.colour):
        drawn = steps[inside][runs.colour[line] == code].sum()
        np.testing.assert_allclose(drawn, edges[trajectories.colour == code].sum())
    same = runs.loop[1:] == runs.loop[:-1]
    np.testing.assert_array_equal(runs.points[ends[:-1]][same], runs.points[ends[:-1] + 1][same])


def test_neighbouring_lines_differ():
    """A line goes on as long as its colour and its loop do."""
    runs = colour_runs(draft().trajectories)
    assert len(runs.count) > len(draft().trajectories.loop_slice)
    assert ((runs.colour[1:] != runs.colour[:-1]) | (runs.loop[1:] != runs.loop[:-1])).all()
    assert (runs.count >= 2).all()
