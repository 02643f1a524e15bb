"""The outline of feet."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.geometry.support_polygon import corners, inside, inside_with


def test_distance_inside_a_hull():
    """The middle of a square is half a side inside; a point beside it as far outside as it is away."""
    square = corners([(0, 0)])
    assert inside(square, np.array([0.5, 0.5])) == pytest.approx(0.5)
    assert inside(square, np.array([2.0, 0.5])) == pytest.approx(-1.0)


@settings(deadline=None)
@given(st.integers(0, 10**6))
def test_hulls_with_one_more_square_are_those_made_one_by_one(seed):
    """Some squares, and one of several more at a time: the distance is that to the hull of both."""
    rng = np.random.default_rng(seed)
    feet = corners(rng.integers(0, 6, (rng.integers(1, 8), 2)))
    more = np.stack([corners([cell]) for cell in rng.integers(-3, 9, (rng.integers(1, 9), 2))])
    place = rng.uniform(-2, 8, 2)
    one_by_one = [inside(np.concatenate([feet, square]), place) for square in more]
    assert inside_with(feet, more, place) == pytest.approx(one_by_one, abs=1e-9)


def test_no_squares_give_no_distances():
    """Nothing to add, nothing to tell."""
    assert inside_with(corners([(0, 0)]), np.zeros((0, 4, 2)), np.zeros(2)).shape == (0,)
