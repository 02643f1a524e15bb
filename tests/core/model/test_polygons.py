"""Convex outlines: what they cover, where their middle is, how deep a place lies in them."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model.polygons import area, centroid, depths, shares

TRIANGLE = np.array([(0.0, 0.0), (2.0, 0.0), (0.0, 1.0)])


def test_shares_of_a_triangle():
    """A side of 1:2 leaves three quarters of the first square and a quarter of the second, of small parts likewise."""
    assert shares(TRIANGLE, 2, 1).tolist() == [[0.75], [0.25]]
    small = shares(TRIANGLE, 3, 1, 2)
    assert small.shape == (6, 2)
    assert small[:, 0].tolist() == [1.0, 1.0, 0.75, 0.25, 0.0, 0.0]
    assert small.sum() / 4 == pytest.approx(area(TRIANGLE))


def test_middle_of_a_triangle():
    """The middle of a triangle is the mean of its corners."""
    assert centroid(TRIANGLE).tolist() == pytest.approx([2 / 3, 1 / 3])


def test_depths_are_distances_from_the_nearest_side():
    """Inside they are positive, on a side zero, outside negative."""
    found = depths(TRIANGLE, np.array([(0.5, 0.25), (1.0, 0.5), (1.0, 1.0), (0.1, 0.4)]))
    assert found == pytest.approx([0.25, 0.0, -1 / np.sqrt(5), 0.1])
