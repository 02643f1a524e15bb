"""Cells in mixed colours: from afar they look like the mean of the texture on them.

First every cell gets its closest colour, and it is decided where plates pay: by the texture, not by the mixture. Then
the plates of a column that have one colour are mixed as one, with any colour of the palette. They are not changed
again.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..arrays import Floats, Ints, Mask
from ..colours import PaletteMixer, SurfaceColours
from ..mesh import TriangleMesh
from ..model import COLOUR_ANY, COLOUR_EMPTY, Catalogue
from ..slicing import Grid
from ..units import BRICK, STUD
from .colour_votes import Codes
from .facing import Facing, facing_of, is_flat
from .occlusion import occluded
from .surface_samples import SurfaceSamples, light_samples
from .visibility import air_around, nearest_faces

_NONE: Final = -1
_ACROSS: Final = np.array([[1, 2], [0, 2], [0, 1]])
"""The axes of the plane across layer, y and x."""


@dataclass(frozen=True, slots=True, eq=False)
class Dithering:
    """How colours are mixed.

    Attributes
    ----------
    palette : (k,) int16 array
        LDraw codes of the colours to mix.
    facing : Facing or None
        The direction that a flat model faces; errors are passed on across its front. None mixes in a fixed pattern
        everywhere.
    """

    palette: Codes
    facing: Facing | None = None


@dataclass(frozen=True, slots=True, eq=False)
class _Units:
    """The units that get one colour: the visible plates of a column, or the cell of a brick, that had one before.

    Attributes
    ----------
    at : (n_layers, n_y, n_x) int64 array
        Unit of each cell of the grid, -1 for none.
    place : (n, 3) int64 array
        Layer of bricks, y and x.
    levels : int
        Cells of the grid in a layer of bricks.
    """

    at: Ints
    place: Ints
    levels: int

    @classmethod
    def of(cls, colour: Codes, seen: Mask, levels: int) -> _Units:
        shown = seen & (colour > COLOUR_ANY)
        z, y, x = np.nonzero(shown)
        key = np.stack([z // levels, y, x, colour[shown]], axis=1).astype(np.int64)
        kinds, row = np.unique(key, axis=0, return_inverse=True)
        at = np.full(colour.shape, _NONE, dtype=np.int64)
        at[shown] = row.reshape(-1)
        return cls(at, kinds[:, :3], levels)

    def sums(self, cell: Ints, weight: NDArray[np.floating]) -> Floats:
        """Return sums of weights, (k, m), of the units of cells, (k,) flat indices or -1, shape (n, m)."""
        unit = np.where(cell >= 0, self.at.ravel()[cell], _NONE)
        valid = unit >= 0
        return np.stack([np.bincount(unit[valid], each[valid], len(self.place)) for each in weight.T], axis=1)


def dithering_of(
    kind: str, palette: Codes, mesh: TriangleMesh, surface: SurfaceColours, facing: Facing | None = None
) -> Dithering | None:
    """Return how the colours of a model are mixed; errors are passed on only across a flat one.

    Parameters
    ----------
    kind : {"none", "ordered", "diffusion"}
    palette : (k,) int16 array
        LDraw codes of the colours to mix.
    mesh : TriangleMesh
    surface : SurfaceColours
        The brick colours of its texels.
    facing : Facing, optional
        The way that it looks, if that is known.

    Returns
    -------
    Dithering or None
    """
    if kind == "none":
        return None
    if kind == "ordered" or not is_flat(mesh):
        return Dithering(palette)
    return Dithering(palette, facing or facing_of(mesh, surface))


def remarks_on_dithering(mesh: TriangleMesh, kind: str) -> tuple[str, ...]:
    """Return a sentence if errors cannot be passed on.

    Parameters
    ----------
    mesh : TriangleMesh
        In the size of the model.
    kind : {"none", "ordered", "diffusion"}

    Returns
    -------
    tuple of str
    """
    if kind != "diffusion" or is_flat(mesh):
        return ()
    return (
        "The colours are mixed in a fixed pattern (dithering 'ordered'), because 'diffusion' needs a flat picture "
        "or relief.",
    )


def light_in_the_open(mesh: TriangleMesh, samples: SurfaceSamples, grid: Grid) -> SurfaceSamples:
    """Return the light of the surface that the air around the model reaches.

    Parameters
    ----------
    mesh : TriangleMesh
    samples : SurfaceSamples
        All surface, to find the air.
    grid : Grid
        Of the cells.

    Returns
    -------
    SurfaceSamples
    """
    light = light_samples(mesh, grid)
    return light.at(air_around(samples, grid.shape, on_ground=False).reaches(light) & ~occluded(light))


def dither(
    colour: Codes,
    seen: Mask,
    air: Mask,
    light: SurfaceSamples,
    dithering: Dithering,
    catalogue: Catalogue,
) -> Codes:
    """Mix the colours of visible cells.

    Parameters
    ----------
    colour : (n_layers, n_y, n_x) int16 array
        Settled colours: LDraw codes, ``COLOUR_ANY`` or ``COLOUR_EMPTY``.
    seen, air : (n_layers, n_y, n_x) bool arrays
        Visible cells, and those of the air around the model.
    light : SurfaceSamples
        Of :func:`light_in_the_open`.
    dithering : Dithering
    catalogue : Catalogue

    Returns
    -------
    (n_layers, n_y, n_x) int16 array
    """
    units = _Units.of(colour, seen, round(BRICK / light.height))
    goal, faces = _goals(units, light, seen, air)
    if not faces.any():
        return colour
    mixer = PaletteMixer(dithering.palette, catalogue)
    across = _ACROSS[faces.argmax(axis=1)]
    row, column = np.take_along_axis(units.place, across, axis=1).T
    mixed = mixer.ordered(goal, row, column)
    if dithering.facing is not None:
        # the front is seen from the front alone
        ahead, _ = _goals(units, dithering.facing.weighed(light), seen, air)
        _diffuse(mixed, ahead, units, colour != COLOUR_EMPTY, dithering.facing, mixer)
    changed = colour.copy()
    changed[units.at >= 0] = mixed[units.at[units.at >= 0]]
    return changed


def _goals(units: _Units, light: SurfaceSamples, seen: Mask, air: Mask) -> tuple[Floats, Floats]:
    """Return the mean light on each unit, else on the nearest one, and how much it faces along the axes, (n, 3)."""
    cell = nearest_faces(light.place, light.sides, seen, air)
    normal = light.normal * light.sides
    squares = normal**2 / np.maximum((normal**2).sum(axis=1, keepdims=True), np.finfo(float).tiny)
    area = light.area[:, None]
    weight = units.sums(cell, area)
    goal = units.sums(cell, area * light.colour) / np.where(weight > 0, weight, 1)
    lit = weight[:, 0] > 0
    if lit.any() and not lit.all():
        place = units.place * np.array([BRICK, STUD, STUD])
        goal[~lit] = goal[lit][cKDTree(place[lit]).query(place[~lit])[1]]
    return goal, units.sums(cell, area * squares)


def _diffuse(mixed: Codes, goal: Floats, units: _Units, solid: Mask, facing: Facing, mixer: PaletteMixer) -> None:
    """Pass errors on across the front of a flat model; its units get their colours in place."""
    front = _front(units, solid, facing)
    there = front >= 0
    found = mixer.diffused(np.where(there[..., None], goal[front], 0.0), there)
    mixed[front[there]] = found[there]


def _front(units: _Units, solid: Mask, facing: Facing) -> Ints:
    """Return the units in front, -1 for none: rows, columns, and the plates of a layer of a standing model."""
    axis = 2 - facing.axis
    cells, at = (np.moveaxis(each, axis, 0) for each in (solid, units.at))
    if facing.sign > 0:
        cells, at = cells[::-1], at[::-1]
    first = cells.argmax(axis=0)[None]
    front: Ints = np.where(cells.any(axis=0), np.take_along_axis(at, first, axis=0)[0], _NONE)
    if axis == 0:
        return front[..., None]
    return front.reshape(-1, units.levels, front.shape[1]).transpose(0, 2, 1)
