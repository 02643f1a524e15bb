"""The outline of feet."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.geometry.support_polygon import corners, inside


def test_distance_inside_a_hull():
    """The middle of a square is half a side inside; a point beside it as far outside as it is away."""
    square = corners([(0, 0)])
    assert inside(square, np.array([0.5, 0.5])) == pytest.approx(0.5)
    assert inside(square, np.array([2.0, 0.5])) == pytest.approx(-1.0)
