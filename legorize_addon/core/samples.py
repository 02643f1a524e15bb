"""The surface as samples: where, facing which way, how much of it, in which colour.

Pieces of trajectories stand for the upright part of the surface, vertical rays
for the level part. On a slope, of unit normal n, the pieces see the share
|n_xy| of the area and the rays the share |n_z|; weighted by the same shares
again they add up to the area itself.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Final

import numpy as np
from numpy.typing import NDArray

from .colours import SurfaceColours
from .coverage import Pieces
from .grid import Grid
from .mesh import TriangleMesh
from .model import Floats, Ints, Mask
from .rays import vertical_hits
from .trajectories import Trajectories
from .units import BRICK, STUD

_RAYS: Final = 3
"""Vertical rays along each side of a cell."""


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
    colour : (n,) int16 array
        LDraw code.
    """

    place: Floats
    along: Floats
    cell: Ints
    normal: Floats
    area: Floats
    colour: NDArray[np.int16]

    def at(self, rows: Mask) -> SurfaceSamples:
        """Return the samples that a mask, (n,) bool, keeps."""
        return SurfaceSamples(*(getattr(self, entry.name).compress(rows, axis=0) for entry in fields(self)))

    def joined(self, other: SurfaceSamples) -> SurfaceSamples:
        """Return these samples followed by others."""
        return SurfaceSamples(
            *(np.concatenate([getattr(self, entry.name), getattr(other, entry.name)]) for entry in fields(self))
        )


def trajectory_samples(
    mesh: TriangleMesh,
    trajectories: Trajectories,
    pieces: Pieces,
    level: Ints,
    layer: NDArray[np.int32],
    heights: Floats,
    grid: Grid,
) -> SurfaceSamples:
    """Return a sample for every piece of trajectory within a cell.

    Parameters
    ----------
    mesh : TriangleMesh
    trajectories : Trajectories
    pieces : Pieces
        The trajectories' edges, cut at the grid.
    level : (n_edges,) int64 array
        Slice of every edge.
    layer : (n_slices,) int32 array
        Layer of every slice.
    heights : (n_slices,) float64 array
        Height of every slice in mm.
    grid : Grid

    Returns
    -------
    SurfaceSamples
        The gaps' edges are left out: there is no surface.
    """
    face = trajectories.face[pieces.edge]
    real = np.flatnonzero(face >= 0)
    face, slice_ = face[real], level[pieces.edge[real]]
    z = (heights[slice_] - grid.origin[2]) / BRICK
    upright = np.sqrt(1 - level_shares(mesh) ** 2)[face]
    thickness = BRICK / np.bincount(layer, minlength=grid.n_layers)[layer[slice_]]
    return SurfaceSamples(
        place=np.column_stack([z, pieces.middle[real][:, ::-1]]),
        along=np.column_stack([np.zeros(len(real)), pieces.along[real][:, ::-1]]),
        cell=np.column_stack([layer[slice_].astype(np.int64), pieces.cell[real][:, ::-1]]),
        normal=face_normals(mesh)[face],
        area=pieces.length[real] * thickness * upright,
        colour=trajectories.colour[pieces.edge[real]],
    )


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
    place = ((points - grid.origin) / [STUD, STUD, BRICK])[:, ::-1]
    cell = np.clip(np.floor(place).astype(np.int64), 0, np.array(grid.shape) - 1)
    return SurfaceSamples(
        place=place,
        along=np.zeros_like(place),
        cell=cell,
        normal=face_normals(mesh)[face],
        area=pitch * pitch * level_shares(mesh)[face],
        colour=surface.at(mesh.face_image[face], uvs),
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


def face_normals(mesh: TriangleMesh) -> Floats:
    """Return the outward normals in cells along layer, y and x, not of unit length, (n_f, 3)."""
    # a distance of one cell along an axis counts the same, whatever the cell's side
    cells: Floats = mesh.normals[:, ::-1] * np.array([1 / BRICK, 1 / STUD, 1 / STUD])
    return cells


def inner_cells(samples: SurfaceSamples, solid: Mask) -> Ints:
    """Return the cell whose skin each sample is: its own, or the nearest one inwards.

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
