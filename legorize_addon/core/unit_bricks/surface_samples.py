"""The surface as samples: where, facing which way, how much of it, in which colour.

Pieces of trajectories stand for the upright part of the surface, vertical rays
for the level part. On a slope, of unit normal n, the pieces see the share
|n_xy| of the area and the rays the share |n_z|; weighted by the same shares
again they add up to the area itself.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from ..colours import SurfaceColours, linear_from_srgb, texels_at
from ..mesh import TriangleMesh, vertical_hits, weight_at
from ..slicing import Grid, Levels, Pieces, Trajectories
from ..units import BRICK, STUD

_RAYS: Final = 3
"""Rays along each side of a cell, and rays for light along each stud's length."""


@dataclass(frozen=True, slots=True, eq=False)
class SurfaceSamples:
    """Points of the surface.

    Attributes
    ----------
    place : (n, 3) float64 array
        Position in cells from the grid's corner: layer, y, x.
    along : (n, 3) float64 array
        From end to end of the piece of surface in cells; zero for a ray's hit.
    cell : (n, 3) int64 array
        Cell of each sample: layer, y, x.
    normal : (n, 3) float64 array
        Outward direction, along layer, y and x, in cells; not of unit length.
    area : (n,) float64 array
        Surface that a sample stands for in mm^2.
    colour : (n,) int16 array or (n, 3) float64 array
        LDraw code, or light: red, green and blue from 0 to 1.
    height : float
        Height of a cell in mm.
    weight : (n,) float64 array or None
        How many times more than usual the surface counts; None where all of it counts alike.
    """

    place: Floats
    along: Floats
    cell: Ints
    normal: Floats
    area: Floats
    colour: NDArray[Any]
    height: float = BRICK
    weight: Floats | None = None

    @property
    def sides(self) -> Floats:
        """Sides of a cell along layer, y and x in studs, shape (3,)."""
        return np.array([self.height / STUD, 1.0, 1.0])

    def at(self, rows: Mask) -> SurfaceSamples:
        """Return the samples that a mask, (n,) bool, keeps."""
        kept: dict[str, Any] = {name: getattr(self, name).compress(rows, axis=0) for name in self._columns()}
        return replace(self, **kept)

    def joined(self, other: SurfaceSamples) -> SurfaceSamples:
        """Return these samples followed by others."""
        pairs = {name: (getattr(self, name), getattr(other, name)) for name in self._columns()}
        both: dict[str, Any] = {name: np.concatenate(pair) for name, pair in pairs.items()}
        return replace(self, **both)

    def _columns(self) -> list[str]:
        left_out = ("height",) if self.weight is not None else ("height", "weight")
        return [entry.name for entry in fields(self) if entry.name not in left_out]


def trajectory_samples(
    mesh: TriangleMesh,
    trajectories: Trajectories,
    pieces: Pieces,
    standing: tuple[Ints, Ints],
    levels: Levels,
    grid: Grid,
) -> SurfaceSamples:
    """Return samples for the pieces of trajectories on real surface.

    Parameters
    ----------
    mesh : TriangleMesh
    trajectories : Trajectories
    pieces : Pieces
        The trajectories' edges, cut at the grid.
    standing : tuple of (n,) int64 arrays
        Piece of each sample, and row of `levels`: see :func:`standing_pieces`.
    levels : Levels
    grid : Grid

    Returns
    -------
    SurfaceSamples
    """
    piece, pair = standing
    edge = pieces.edge.take(piece)
    face = trajectories.face.take(edge)
    upright = np.sqrt(1 - level_shares(mesh) ** 2)[face]
    none = np.zeros(len(piece))
    return SurfaceSamples(
        place=np.column_stack([levels.place.take(pair), pieces.middle.take(piece, axis=0)[:, ::-1]]),
        along=np.column_stack([none, pieces.along.take(piece, axis=0)[:, ::-1]]),
        cell=np.column_stack([levels.level.take(pair), pieces.cell.take(piece, axis=0)[:, ::-1]]),
        normal=face_normals(mesh, grid.height).take(face, axis=0),
        area=pieces.length.take(piece) * levels.thickness.take(pair) * upright,
        colour=trajectories.colour.take(edge),
        height=grid.height,
        weight=_weights(mesh, face, pieces.middle.take(piece, axis=0), levels.slice.take(pair), levels, grid),
    )


def _weights(
    mesh: TriangleMesh, face: NDArray[np.int32], middle: Floats, slice_: Ints, levels: Levels, grid: Grid
) -> Floats | None:
    """Return the weights where slices cut faces, as the colours are taken there; None where the mesh has none."""
    if mesh.weight is None and mesh.features is None:
        return None
    # a slice that stands for three plates is in the middle of them
    height = np.bincount(levels.slice, levels.place) / np.maximum(np.bincount(levels.slice), 1)
    return weight_at(
        mesh, face.astype(np.int64), grid.origin + np.column_stack([middle * STUD, height.take(slice_) * grid.height])
    )


def standing_pieces(trajectories: Trajectories, pieces: Pieces, levels: Levels) -> tuple[Ints, Ints]:
    """Return the pieces on real surface, once for every level that their slice stands for.

    Parameters
    ----------
    trajectories : Trajectories
    pieces : Pieces
        The trajectories' edges, cut at the grid.
    levels : Levels

    Returns
    -------
    piece, pair : (n,) int64 arrays
        Rows of `pieces` and of `levels`. The gaps' edges are left out: there is
        no surface.
    """
    real = np.flatnonzero(trajectories.face.take(pieces.edge) >= 0)
    slice_of_edge = trajectories.loop_slice[trajectories.edge_loop]
    row, pair = levels.standing(slice_of_edge[pieces.edge.take(real)].astype(np.int64))
    return real.take(row), pair


def horizontal_samples(mesh: TriangleMesh, surface: SurfaceColours, grid: Grid) -> SurfaceSamples:
    """Return a sample for every hit of a lattice of vertical rays.

    Parameters
    ----------
    mesh : TriangleMesh
    surface : SurfaceColours
    grid : Grid

    Returns
    -------
    SurfaceSamples
    """
    pitch = STUD / _RAYS
    face, points, uvs = vertical_hits(mesh, corner=grid.origin[:2], pitch=pitch)
    place = ((points - grid.origin) / [STUD, STUD, grid.height])[:, ::-1]
    cell = np.clip(np.floor(place).astype(np.int64), 0, np.array(grid.shape) - 1)
    return SurfaceSamples(
        place=place,
        along=np.zeros_like(place),
        cell=cell,
        normal=face_normals(mesh, grid.height)[face],
        area=pitch * pitch * level_shares(mesh)[face],
        colour=surface.at(mesh.face_image[face], uvs),
        height=grid.height,
        weight=weight_at(mesh, face, points),
    )


def light_samples(mesh: TriangleMesh, grid: Grid) -> SurfaceSamples:
    """Return the light of the texels where lattices of rays along all three axes meet the surface.

    Parameters
    ----------
    mesh : TriangleMesh
    grid : Grid

    Returns
    -------
    SurfaceSamples
        Together they stand for the whole area, whichever way it faces.
    """
    upward, *others = (_light_along(mesh, grid, axis) for axis in (2, 1, 0))
    for other in others:
        upward = upward.joined(other)
    return upward


def _light_along(mesh: TriangleMesh, grid: Grid, axis: int) -> SurfaceSamples:
    """Return the light where rays along an axis meet the surface."""
    pitch, shift = STUD / _RAYS, 2 - axis
    turned = replace(mesh, vertices=np.roll(mesh.vertices, shift, axis=1))
    face, points, uvs = vertical_hits(turned, corner=np.roll(grid.origin, shift)[:2], pitch=pitch)
    points = np.roll(points, -shift, axis=1)
    place = ((points - grid.origin) / [STUD, STUD, grid.height])[:, ::-1]
    return SurfaceSamples(
        place=place,
        along=np.zeros_like(place),
        cell=np.clip(np.floor(place).astype(np.int64), 0, np.array(grid.shape) - 1),
        normal=face_normals(mesh, grid.height)[face],
        area=pitch * pitch * level_shares(turned)[face],
        colour=linear_from_srgb(texels_at(mesh, mesh.face_image[face], uvs)),
        height=grid.height,
    )


def surface_area(samples: SurfaceSamples, shape: tuple[int, int, int]) -> Floats:
    """Return the surface in every cell in mm^2, (n_layers, n_y, n_x) float64."""
    cell = np.ravel_multi_index(tuple(samples.cell.T), shape)
    area: Floats = np.bincount(cell, samples.area, int(np.prod(shape))).reshape(shape)
    return area


def level_shares(mesh: TriangleMesh) -> Floats:
    """Return |n_z| of the unit normals, 1 for level faces and 0 for upright or empty ones, (n_f,)."""
    normals = mesh.normals
    length = np.linalg.norm(normals, axis=1)
    share: Floats = np.minimum(np.abs(normals[:, 2]) / np.maximum(length, np.finfo(float).tiny), 1)
    return share


def face_normals(mesh: TriangleMesh, height: float = BRICK) -> Floats:
    """Return the outward normals in cells of a height along layer, y and x, not of unit length, (n_f, 3)."""
    # a distance of one cell along an axis counts the same, whatever the cell's side
    cells: Floats = mesh.normals[:, ::-1] * np.array([1 / height, 1 / STUD, 1 / STUD])
    return cells


def inner_cells(samples: SurfaceSamples, solid: Mask) -> Ints:
    """Return the cell whose surface each sample is: its own, or the nearest one inwards.

    A sample in a cell that is not solid belongs to the neighbour behind the
    surface, along the steepest axis of the normal first.

    Parameters
    ----------
    samples : SurfaceSamples
    solid : (n_layers, n_y, n_x) bool array

    Returns
    -------
    (n,) int64 array
        Flat index of the cell, -1 where there is none.

    References
    ----------
    Paper, section "Unit bricks": the inner cell that shares the common edge.
    """
    padded = np.pad(solid, 1)
    found = np.full(len(samples.area), -1, dtype=np.int64)
    steepest = np.argsort(-np.abs(samples.normal), axis=1, kind="stable")
    inward = -np.sign(samples.normal).astype(np.int64)
    first = np.zeros_like(inward)
    np.put_along_axis(first, steepest[:, :1], np.take_along_axis(inward, steepest[:, :1], 1), 1)
    second = np.zeros_like(inward)
    np.put_along_axis(second, steepest[:, 1:2], np.take_along_axis(inward, steepest[:, 1:2], 1), 1)
    rest = np.arange(len(found))
    for step in (np.zeros_like(first), first, second, first + second, inward):
        cell = samples.cell[rest] + step[rest]
        hit = padded[tuple((cell + 1).T)]
        found[rest[hit]] = np.ravel_multi_index(tuple(cell[hit].T), solid.shape)
        rest = rest[~hit]
    return found
