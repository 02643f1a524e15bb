"""Which surface can be seen: what the air around the model reaches.

Bodies that overlap, the inside of a hollow vehicle, the surface of a sealed
cavity: none of these must give its colour to a brick that stands in front.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .model import Floats, Ints, Mask
from .samples import SurfaceSamples

_FINE: Final = np.array([3, 2, 2])
"""Fine cells to a unit cell along layer, y and x: a plate and half a stud."""

_FINE_LIMIT: Final = 80_000_000
"""Fine cells beyond which unit cells are used instead, to bound the memory."""

_STEPS: Final = 5
"""Marks along a piece of trajectory, so that none of its fine cells is missed."""


def reached_by_air(samples: SurfaceSamples, shape: tuple[int, int, int]) -> Mask:
    """Return the samples that the air around the model reaches.

    The surface is drawn into a lattice of half studs and closed over its pin
    holes; a sample is reached if it lies within two fine cells of the outer air.
    Crevices narrower than a stud count as closed: the bricks close them as well.

    Parameters
    ----------
    samples : SurfaceSamples
    shape : tuple of int
        Unit cells along layer, y and x.

    Returns
    -------
    (n,) bool array
    """
    fine = _FINE if np.prod(np.array(shape) * _FINE) < _FINE_LIMIT else np.ones(3, dtype=int)
    margin = 4
    drawn = np.zeros(np.array(shape) * fine + 2 * margin, dtype=bool)
    for share in (np.arange(_STEPS) + 0.5) / _STEPS - 0.5:
        drawn[_fine_cells(samples.place + share * samples.along, fine, drawn.shape, margin)] = True
    label, _ = ndimage.label(~ndimage.binary_dilation(drawn))
    air = ndimage.binary_dilation(label == label[0, 0, 0], iterations=2)
    reached: Mask = air[_fine_cells(samples.place, fine, drawn.shape, margin)]
    return reached


def _fine_cells(place: Floats, fine: Ints, shape: tuple[int, ...], margin: int) -> tuple[Ints, ...]:
    cell = np.floor(place * fine).astype(np.int64) + margin
    return tuple(np.clip(cell, 0, np.array(shape) - 1).T)


def nearest_faces(place: Floats, solid: Mask, air: Mask) -> Ints:
    """Return the cell whose outer face is nearest to each point.

    Only the eight cells around a point are looked at.

    Parameters
    ----------
    place : (n, 3) float64 array
        Points in cells: layer, y, x.
    solid : (n_layers, n_y, n_x) bool array
        Cells of the model.
    air : (n_layers, n_y, n_x) bool array
        Cells of the air around it.

    Returns
    -------
    (n,) int64 array
        Flat index of the cell, -1 where no outer face is near.
    """
    margin = 2
    solid_around = np.pad(solid, margin)
    air_around = np.pad(air, margin, constant_values=True)
    found = np.full(len(place), -1, dtype=np.int64)
    least = np.full(len(place), np.inf)
    base = np.floor(place - 0.5).astype(np.int64)
    for corner in np.ndindex(2, 2, 2):
        cell = np.clip(base + corner + margin, 1, np.array(solid_around.shape) - 2)
        rows = np.flatnonzero(solid_around[tuple(cell.T)])
        cell = cell[rows]
        distance = _face_distances(place[rows] - (cell - margin) - 0.5, cell, air_around)
        nearer = distance < least[rows] - 1e-12
        rows, cell = rows[nearer], cell[nearer]
        least[rows] = distance[nearer]
        found[rows] = np.ravel_multi_index(tuple((cell - margin).T), solid.shape)
    return found


def _face_distances(offset: Floats, cell: Ints, air: Mask) -> Floats:
    """Return the squared distance from points to the nearest open face of their cells, in studs.

    Parameters
    ----------
    offset : (n, 3) float64 array
        Points relative to the middle of the cell, in cells.
    cell : (n, 3) int64 array
    air : bool array
        Cells of the air, in the same frame as ``cell``.
    """
    size: NDArray[np.float64] = np.array([1.2, 1.0, 1.0])
    beside = np.maximum(np.abs(offset) - 0.5, 0) * size
    aside = (beside**2).sum(axis=1, keepdims=True) - beside**2
    least = np.full(len(offset), np.inf)
    for axis in range(3):
        for side in (-1, 1):
            neighbour = cell.copy()
            neighbour[:, axis] += side
            reach = (offset[:, axis] - side * 0.5) * size[axis]
            least = np.where(air[tuple(neighbour.T)], np.minimum(least, reach**2 + aside[:, axis]), least)
    return least
