"""The colours that unit bricks would have if the surface were sampled densely.

Many points, evenly over the area, stand in for the pieces of trajectories; what
is done with them, the rule of the colour, stays the same.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from legorize_addon.core.colours.dominant import SurfaceColours
from legorize_addon.core.geometry.neighbourhoods import outer_air
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.slicing.coverage import Pieces
from legorize_addon.core.slicing.lattice import Grid
from legorize_addon.core.slicing.trajectories import Trajectories
from legorize_addon.core.unit_bricks.colour_votes import count_votes, likeliest_colours, winning_colours
from legorize_addon.core.unit_bricks.longest_trajectory import excluded_neighbours, participants
from legorize_addon.core.unit_bricks.surface_samples import SurfaceSamples, face_normals, inner_cells
from legorize_addon.core.units import BRICK, STUD

Codes = NDArray[np.int16]
Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

_INWARDS: Final = 1e-7
"""A point on a border of cells belongs to the inner one, as an edge of a trajectory does; in cells."""


def dense_samples(
    mesh: TriangleMesh, surface: SurfaceColours, grid: Grid, count: int, *, seed: int = 0
) -> SurfaceSamples:
    """Return points evenly over the surface, each in the brick colour of its texel.

    Parameters
    ----------
    mesh : TriangleMesh
    surface : SurfaceColours
    grid : Grid
    count : int
        Points.
    seed : int
        Of their places.

    Returns
    -------
    SurfaceSamples
    """
    face, weight, area = scattered(mesh, count, seed)
    points = np.einsum("ki,kij->kj", weight, mesh.vertices[mesh.faces[face]])
    place = ((points - grid.origin) / [STUD, STUD, BRICK])[:, ::-1]
    normal = face_normals(mesh)[face]
    within = place - _INWARDS * normal / np.linalg.norm(normal, axis=1, keepdims=True)
    return SurfaceSamples(
        place=place,
        along=np.zeros_like(place),
        cell=np.clip(np.floor(within).astype(np.int64), 0, np.array(grid.shape) - 1),
        normal=normal,
        area=np.full(count, area / count),
        colour=surface.at(mesh.face_image[face], np.einsum("ki,kij->kj", weight, mesh.uvs[face])),
    )


def scattered(mesh: TriangleMesh, count: int, seed: int = 0) -> tuple[NDArray[np.intp], Floats, float]:
    """Choose points evenly over the surface.

    Parameters
    ----------
    mesh : TriangleMesh
    count : int
    seed : int

    Returns
    -------
    face : (count,) int array
        Triangle of each point.
    weight : (count, 3) float64 array
        Shares of the triangle's corners.
    area : float
        Of the whole surface, in mm^2.
    """
    corners = mesh.vertices[mesh.faces]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    rng = np.random.default_rng(seed)
    comb = (np.arange(count) + rng.random()) / count * area.sum()
    face = np.minimum(np.searchsorted(np.cumsum(area), comb), len(area) - 1)
    return face, _barycentric(count, rng), float(area.sum())


def _barycentric(count: int, rng: np.random.Generator) -> Floats:
    """Return shares of three corners that spread points evenly over a triangle, (count, 3)."""
    a, b = rng.random((2, count))
    root = np.sqrt(a)
    return np.stack([1 - root, root * (1 - b), root * b], axis=1)


def dense_likeliest(samples: SurfaceSamples, solid: Mask, seen: Mask, surface: SurfaceColours) -> Codes:
    """Return the colours by the default rule, (n_seen,)."""
    return likeliest_colours(samples, outer_air(solid), seen, load_catalogue(), surface).winners(seen)


def dense_longest(
    samples: SurfaceSamples, trajectories: Trajectories, pieces: Pieces, passed: SurfaceSamples, solid: Mask, seen: Mask
) -> Codes:
    """Return the colours by the paper's rule, as they would be with ever more slices.

    The length of trajectory in a square, summed over all heights, is the surface
    there times the sine of its slope. Which neighbours take part is asked of the
    trajectories, as no cloud of points has a former and a latter brick.

    Parameters
    ----------
    samples : SurfaceSamples
        Dense points.
    trajectories : Trajectories
    pieces : Pieces
        The trajectories' edges, cut at the grid.
    passed : SurfaceSamples
        The pieces on real surface, in the same order.
    solid, seen : (n_layers, n_y, n_x) bool arrays

    Returns
    -------
    (n_seen,) int16 array
    """
    real = trajectories.face[pieces.edge] >= 0
    bounding = inner_cells(passed, solid)
    excluded = excluded_neighbours(trajectories, pieces.edge[real], bounding, solid.shape)
    brick = inner_cells(samples, solid)
    on_trajectory = np.isin(brick, bounding)
    cell, entry = participants(samples.cell, np.where(on_trajectory, brick, -1), excluded, solid)
    level = _level_share(samples)
    upright = samples.area * np.sqrt(1 - level**2)
    codes, votes = count_votes(
        np.concatenate([cell, brick]),
        np.concatenate([samples.colour[entry], samples.colour]),
        # as in the core: level surface decides only where no trajectory does
        np.concatenate([upright[entry], samples.area * level * 1e-9]),
        seen,
    )
    return winning_colours(codes, votes, votes, seen)


def _level_share(samples: SurfaceSamples) -> Floats:
    """Return |n_z| of the unit normals in mm, (n,)."""
    normal = samples.normal * [BRICK, STUD, STUD]
    length = np.linalg.norm(normal, axis=1)
    share: Floats = np.clip(np.abs(normal[:, 0]) / np.maximum(length, np.finfo(float).tiny), 0, 1)
    return share
