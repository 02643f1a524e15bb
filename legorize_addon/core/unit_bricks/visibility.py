"""Which surface can be seen: the surface that the air around the model reaches.

Bodies that overlap, the inside of a hollow vehicle, the surface of a sealed
cavity: none of these may give its colour to a brick in front of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import ndimage

from ..arrays import Floats, Ints, Mask
from ..units import STUD
from .surface_samples import SurfaceSamples

_FINEST: Final = 4.5
"""About the side of a fine cell in mm: half a stud, half a brick, a plate."""

_FINE_LIMIT: Final = 80_000_000
"""Fine cells beyond which unit cells are used instead, to bound the memory."""

_TIE: Final = 1e-12
"""Squared distances that differ by less than this are equal: the first cell keeps the point."""

_MARGIN: Final = 4
"""Fine cells of air around the grid on every side."""

_AHEAD: Final = (0.5, 1.0, 1.5, 2.0, 2.5)
"""Steps in fine cells in front of a sample at which air is looked for."""

_STEPS: Final = 5
"""Marks along a piece of trajectory, so that none of its fine cells is missed."""


@dataclass(frozen=True, slots=True, eq=False)
class OuterAir:
    """The space around a surface, on a lattice of half studs and half bricks.

    Crevices and holes narrower than a stud are closed: the bricks close them as well.

    Attributes
    ----------
    free : (n_z, n_y, n_x) bool array
        Fine cells that the air reaches, up to one fine cell from the surface.
    fine : (3,) int array
        Fine cells to a unit cell along layer, y and x.
    """

    free: Mask
    fine: Ints

    def reaches(self, samples: SurfaceSamples) -> Mask:
        """Return the samples that free air lies in front of, shape (n,).

        In front means on the outward side, within the two fine cells and a half
        by which the drawn surface is thicker than the real one.
        """
        free = _grown(self.free)
        around = _grown(_grown(free)).ravel()
        ahead = samples.normal * self.fine
        ahead /= np.maximum(np.sqrt(np.einsum("ij,ij->i", ahead, ahead)), np.finfo(float).tiny)[:, None]
        ahead /= self.fine
        reached = around[_fine_cells(samples.place, self.fine, free.shape)]
        rest = np.flatnonzero(reached)
        for step in _AHEAD:
            place = samples.place.take(rest, axis=0) + step * ahead.take(rest, axis=0)
            rest = rest[~free.ravel()[_fine_cells(place, self.fine, free.shape)]]
        reached[rest] = False
        return reached

    def fills(self, shape: tuple[int, int, int]) -> Mask:
        """Return the unit cells that are mostly air, right up to the surface, shape (n_layers, n_y, n_x)."""
        layers, rows, columns = shape
        inner = tuple(slice(_MARGIN, -_MARGIN) for _ in shape)
        cells = _grown(self.free)[inner].reshape(layers, self.fine[0], rows, self.fine[1], columns, self.fine[2])
        filled: Mask = cells.mean(axis=(1, 3, 5)) > 0.5
        return filled


def air_around(samples: SurfaceSamples, shape: tuple[int, int, int], *, on_ground: bool) -> OuterAir:
    """Find out how far the air around a surface reaches.

    Parameters
    ----------
    samples : SurfaceSamples
    shape : tuple of int
        Unit cells along layer, y and x.
    on_ground : bool
        Whether the ground stops the air, so that an open underside counts as closed.

    Returns
    -------
    OuterAir
    """
    fine = np.round(samples.sides * STUD / _FINEST).astype(int)
    if np.prod(np.array(shape) * fine) > _FINE_LIMIT:
        fine = np.ones(3, dtype=int)
    drawn = np.zeros(np.array(shape) * fine + 2 * _MARGIN, dtype=bool)
    pieces = samples.along.any(axis=1)
    drawn.ravel()[_fine_cells(samples.place[~pieces], fine, drawn.shape)] = True
    middle, along = samples.place[pieces], samples.along[pieces]
    for share in (np.arange(_STEPS) + 0.5) / _STEPS - 0.5:
        drawn.ravel()[_fine_cells(middle + share * along, fine, drawn.shape)] = True
    drawn = _grown(drawn)
    if on_ground:
        drawn[:_MARGIN] = True
    label, _ = ndimage.label(~drawn)
    return OuterAir(label == label[-1, 0, 0], fine)


def reached_by_air(samples: SurfaceSamples, shape: tuple[int, int, int]) -> Mask:
    """Return the samples that the air around the model reaches, shape (n,).

    Parameters
    ----------
    samples : SurfaceSamples
    shape : tuple of int
        Unit cells along layer, y and x.
    """
    return air_around(samples, shape, on_ground=False).reaches(samples)


def _grown(mask: Mask) -> Mask:
    """Return the mask grown by one cell face to face; ten times as fast as binary_dilation."""
    grown = mask.copy()
    for axis in range(mask.ndim):
        source, target = np.moveaxis(mask, axis, 0), np.moveaxis(grown, axis, 0)
        target[1:] |= source[:-1]
        target[:-1] |= source[1:]
    return grown


def _fine_cells(place: Floats, fine: Ints, shape: tuple[int, ...]) -> Ints:
    """Return the flat index of the fine cell of each place, that at the rim for places beyond."""
    flat = np.zeros(len(place), dtype=np.intp)
    for along, factor, size in zip(place.T, fine, shape, strict=True):
        flat *= size
        flat += np.minimum(np.maximum(np.floor(along * factor) + _MARGIN, 0), size - 1).astype(np.intp)
    return flat


def nearest_faces(place: Floats, sides: Floats, solid: Mask, air: Mask) -> Ints:
    """Return the cell whose outer face is nearest to each point.

    Only the eight cells around a point are tested.

    Parameters
    ----------
    place : (n, 3) float64 array
        Points in cells: layer, y, x.
    sides : (3,) float64 array
        Sides of a cell along layer, y and x in studs.
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
    air_around = np.pad(air, margin, constant_values=True).ravel()
    base = np.floor(place - 0.5)
    strides = np.array(solid_around.strides)
    flat_along = [
        [np.clip(along + side + margin, 1, size - 2).astype(np.int64) * stride for side in range(2)]
        for along, stride, size in zip(base.T, strides, solid_around.shape, strict=True)
    ]
    found = np.full(len(place), -1, dtype=np.int64)
    least = np.full(len(place), np.inf)
    for z, y, x in np.ndindex(2, 2, 2):
        flat = flat_along[0][z] + flat_along[1][y] + flat_along[2][x]
        rows = np.flatnonzero(solid_around.ravel()[flat])
        flat = flat[rows]
        offset = place.take(rows, axis=0) - base.take(rows, axis=0) - (z + 0.5, y + 0.5, x + 0.5)
        distance = _face_distances(offset, sides, flat, strides, air_around)
        nearer = distance < least[rows] - _TIE
        rows = rows[nearer]
        least[rows] = distance[nearer]
        found[rows] = flat[nearer]
    around = np.unravel_index(np.maximum(found, 0), solid_around.shape)
    inside = np.ravel_multi_index(tuple(axis - margin for axis in around), solid.shape, mode="clip")
    return np.where(found >= 0, inside, -1)


def _face_distances(offset: Floats, sides: Floats, flat: Ints, strides: Ints, air: Mask) -> Floats:
    """Return the squared distance from points to the nearest open face of their cells, in studs.

    Parameters
    ----------
    offset : (n, 3) float64 array
        Points relative to the middle of the cell, in cells.
    sides : (3,) float64 array
        Sides of a cell in studs.
    flat : (n,) int64 array
        Flat index of the cells.
    strides : (3,) int64 array
        Steps of the flat index along the axes.
    air : (n_cells,) bool array
        Cells of the air.

    Returns
    -------
    (n,) float64 array
        Infinite for a cell without an open face.
    """
    beside = [(np.maximum(np.abs(along) - 0.5, 0) * side) ** 2 for along, side in zip(offset.T, sides, strict=True)]
    least = np.full(len(offset), np.inf)
    for axis in range(3):
        aside = beside[axis - 2] + beside[axis - 1]
        for side in (-1, 1):
            open_ = air[flat + side * strides[axis]]
            reach = ((offset[:, axis] - side * 0.5) * sides[axis]) ** 2 + aside
            np.minimum(least, reach, out=least, where=open_)
    return least
