"""The outline of feet: their convex hull, and how far a point lies inside it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial import ConvexHull

from ..arrays import Floats


def hull(points: Floats) -> Floats:
    """Return the half-planes of the convex hull of points (n, 2), as (k, 3): outward normal and offset."""
    planes: Floats = ConvexHull(points).equations
    return planes


def beyond(planes: Floats, place: Floats) -> Floats:
    """Return how far a place lies beyond each edge of a hull, less than 0 inside, (k,)."""
    distance: Floats = planes[:, :2] @ place + planes[:, 2]
    return distance


def inside(points: Floats, place: Floats) -> float:
    """Return the distance to the nearest edge of the convex hull of points, less than 0 outside."""
    return float(-beyond(hull(points), place).max())


def corners(cells: Sequence[tuple[int, int]]) -> Floats:
    """Return the corners of stud squares, (4 n, 2) float64."""
    low = np.array(cells, dtype=np.float64)
    return np.concatenate([low + shift for shift in ((0, 0), (1, 0), (0, 1), (1, 1))])
