"""Bodies of one model that nearly touch: a hat over a head, a wheel beside its arch.

Meshes are often put together of shells that pass close by each other without
touching. Bricks need something between them.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from scipy import ndimage
from scipy.spatial import cKDTree

from ..arrays import Ints
from ..model import Fill, Role, UnitGrid
from ..units import PLATES_PER_BRICK

_NEAR: Final = np.array([4.0, 2.0, 2.0])
"""Steps in plates and cells within which bodies are joined: a stud between them, or three plates."""

_ASIDE: Final = 1.5
"""Factor by which a step sideways counts more than one upwards: stacked bricks hold by themselves."""


def join_near_bodies(grid: UnitGrid, *, plates: bool) -> UnitGrid:
    """Fill the gap between bodies that pass within a stud of each other, where it is narrowest.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model.
    plates : bool
        Whether single plates may be used, or only whole bricks.

    Returns
    -------
    UnitGrid
        With cells that must be built along the shortest way from each smaller
        body to a larger one near to it, in the colour where the way starts.
    """
    shape = (-1, *grid.colour.shape[2:])
    solid = grid.solid.reshape(shape)
    label, n_bodies = ndimage.label(solid)
    if n_bodies <= 1:
        return grid
    places = np.argwhere(solid)
    body = label[solid]
    order = np.argsort(np.bincount(body)[1:], kind="stable") + 1
    ways = [way for each in order[:-1] for way in _ways(places, body, int(each))]
    if not ways:
        return grid
    colour, cover, role = grid.colour.copy(), grid.cover.copy(), grid.role.copy()
    for start, cells in ways:
        level, y, x = cells.T
        plate: Ints | slice = level % PLATES_PER_BRICK if plates else slice(None)
        at = level // PLATES_PER_BRICK, plate, y, x
        empty = cover[at] == Fill.EMPTY
        colour[at] = np.where(empty, colour.reshape(shape)[tuple(start)], colour[at])
        role[at] = np.where(empty, np.uint8(Role.SHELL), role[at])
        cover[at] = Fill.REQUIRED
    return replace(grid, colour=colour, cover=cover, role=role)


def free_bodies(grid: UnitGrid) -> int:
    """Count the separate bodies of a model.

    Parameters
    ----------
    grid : UnitGrid

    Returns
    -------
    int
        1 for a model in one piece.
    """
    return int(ndimage.label(grid.solid.reshape(-1, *grid.colour.shape[2:]))[1])


def _ways(places: Ints, body: Ints, number: int) -> list[tuple[Ints, Ints]]:
    """Return where a body starts to reach out for the nearest other one, and the cells between; or nothing."""
    own, other = places[body == number], places[body != number]
    scale = np.array([1 / _NEAR[0], _ASIDE / _NEAR[1], _ASIDE / _NEAR[2]])
    distance, nearest = cKDTree(other * scale).query(own * scale)
    near = (np.abs(other[nearest] - own) <= _NEAR).all(axis=1)
    if not near.any():
        return []
    best = int(np.where(near, distance, np.inf).argmin())
    return [(own[best], _between(own[best], other[nearest[best]]))]


def _between(start: Ints, end: Ints) -> Ints:
    """Return the cells on the way from one cell to another, aside first, then upwards or downwards, (n, 3)."""
    way = [start]
    for axis in (2, 1, 0):
        while way[-1][axis] != end[axis]:
            step = way[-1].copy()
            step[axis] += np.sign(end[axis] - step[axis])
            way.append(step)
    return np.array(way[1:-1]).reshape(-1, 3)
