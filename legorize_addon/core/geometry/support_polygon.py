"""The outline of feet: their convex hull, and how far a point lies inside it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from scipy.spatial import ConvexHull

from ..arrays import Floats

ROUNDING: Final = 1e-9
"""Distance in the unit of the points by which one beyond a line is still on it."""


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


def inside_with(points: Floats, more: Floats, place: Floats) -> Floats:
    """Return the distance to the nearest edge of the hull of points and one more group of them at a time.

    Parameters
    ----------
    points : (n, 2) float64 array
        Points of all hulls.
    more : (k, m, 2) float64 array
        Points that each hull has besides; they are not all on one line with the others.
    place : (2,) float64 array
        Where the distance is taken from.

    Returns
    -------
    (k,) float64 array
        Less than 0 outside. As by :func:`inside` of each, without k hulls: an edge joins two of the points that are
        ends of others, and no point lies beyond it.
    """
    ends = points[ConvexHull(points).vertices]
    both = np.concatenate([np.broadcast_to(ends, (len(more), *ends.shape)), more], axis=1)
    first, second = np.nonzero(~np.eye(both.shape[1], dtype=bool))
    along = both[:, second] - both[:, first]
    length = np.hypot(along[..., 0], along[..., 1])
    outward = np.stack([along[..., 1], -along[..., 0]], axis=2) / np.where(length > 0, length, 1.0)[..., None]
    own = (outward * both[:, first]).sum(axis=2)
    farthest = (outward @ both.transpose(0, 2, 1)).max(axis=2)
    edge = (length > 0) & (farthest <= own + ROUNDING)
    found: Floats = np.where(edge, own - outward @ place, np.inf).min(axis=1)
    return found


def corners(cells: Sequence[tuple[int, int]]) -> Floats:
    """Return the corners of stud squares, (4 n, 2) float64."""
    low = np.array(cells, dtype=np.float64)
    return np.concatenate([low + shift for shift in ((0, 0), (1, 0), (0, 1), (1, 1))])
