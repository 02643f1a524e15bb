"""Convex outlines in a plane: what they cover of its squares, their middles, and how deep a place lies in them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats


def shares(outline: Floats, wide: int, deep: int, parts: int = 1) -> Floats:
    """Return the exact share of each square, or of each of its small parts, that lies within an outline.

    Parameters
    ----------
    outline : (n, 2) float64 array
        Convex, counter-clockwise.
    wide, deep : int
        Squares along x and y, from 0 on.
    parts : int, optional
        Small parts of a square along each axis.

    Returns
    -------
    (wide * parts, deep * parts) float64 array
        0 to 1, by x, then y.
    """
    found = np.zeros((wide * parts, deep * parts))
    scaled = outline * parts
    for x in range(len(found)):
        strip = _clipped(_clipped(scaled, (1.0, 0.0), x), (-1.0, 0.0), -x - 1)
        if len(strip):
            for y in range(found.shape[1]):
                found[x, y] = area(_clipped(_clipped(strip, (0.0, 1.0), y), (0.0, -1.0), -y - 1))
    return np.clip(np.round(found, 9), 0.0, 1.0)


def area(outline: Floats) -> float:
    """Return the area within an outline, (n, 2); 0 of none."""
    return float(_cross(outline).sum() / 2)


def centroid(outline: Floats) -> Floats:
    """Return the middle of the area within an outline, (2,)."""
    pieces = _cross(outline)[:, None]
    middle: Floats = ((outline + np.roll(outline, -1, axis=0)) * pieces).sum(axis=0) / (3 * pieces.sum())
    return middle


def depths(outline: Floats, places: Floats) -> Floats:
    """Return how far places, (k, 2), lie within a convex outline: from its nearest edge, negative outside, (k,)."""
    inwards = sides(outline)[1]
    found: Floats = ((places[:, None] - outline) * inwards).sum(axis=2).min(axis=1)
    return found


def sides(outline: Floats) -> tuple[Floats, Floats]:
    """Return the unit vectors along the edges of an outline, (n, 2), and those across them, which point inwards."""
    along = np.roll(outline, -1, axis=0) - outline
    along = along / np.linalg.norm(along, axis=1, keepdims=True)
    return along, np.stack([-along[:, 1], along[:, 0]], axis=1)


def _cross(outline: Floats) -> Floats:
    """Return twice the area between each edge and the origin."""
    after = np.roll(outline, -1, axis=0)
    found: Floats = outline[:, 0] * after[:, 1] - outline[:, 1] * after[:, 0]
    return found


def _clipped(outline: Floats, normal: tuple[float, float], least: float) -> NDArray[np.float64]:
    """Return what of an outline lies on one side of a line, by Sutherland and Hodgman, 1974."""
    if not len(outline):
        return outline
    side = outline @ np.array(normal) - least
    found = []
    for row in range(len(outline)):
        after = (row + 1) % len(outline)
        if side[row] >= 0:
            found.append(outline[row])
        if side[row] * side[after] < 0:
            at = side[row] / (side[row] - side[after])
            found.append(outline[row] + at * (outline[after] - outline[row]))
    return np.array(found).reshape(-1, 2)
