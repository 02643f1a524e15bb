"""How far the surface of a model lies from its bricks, and how much their colours differ.

What is quick, because it is known where the bricks lie in the mesh; a judge that
knows nothing has to look for it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from legorize_addon.core.build import Build
from legorize_addon.core.colours.difference import ciede2000, lab_from_srgb
from legorize_addon.core.colours.texels import texel_at
from legorize_addon.core.geometry.neighbourhoods import outer_air
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.catalogue import Catalogue
from legorize_addon.core.model.unit_grid import CELL_SIZE, COLOUR_ANY
from legorize_addon.core.unit_bricks.surface_samples import SurfaceSamples, face_normals
from legorize_addon.core.unit_bricks.visibility import reached_by_air
from legorize_addon.core.units import PLATE, STUD
from scripts.benchmarks.dense import scattered

Bytes = NDArray[np.uint8]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]

POINTS: Final = 300_000
"""Of the surface, whether the air reaches them or not."""

THIRDS: Final = (-1 / 3, 0.0, 1 / 3)
"""Where on a face the points lie, in studs from its middle."""

LOST: Final = 1.0
"""Studs beyond which no brick stands for the surface."""


@dataclass(frozen=True, slots=True, eq=False)
class SeenSurface:
    """Points evenly over the surface that the air around it reaches.

    Attributes
    ----------
    points : (n, 3) float64 array
        In mm, in the coordinates of the scaled mesh.
    lab : (n, 3) float64 array
        CIELAB of their texels.
    """

    points: Floats
    lab: Floats


@dataclass(frozen=True, slots=True)
class Likeness:
    """How like a surface its bricks are.

    Attributes
    ----------
    mean, p95 : float
        Distance from the surface to the nearest outer face of a brick, in studs:
        its mean, and what 95 % of the surface keep.
    lost : float
        Share of the surface farther than a stud from any brick.
    colour : float
        Mean CIEDE2000 between the texels and the nearest faces, where these are
        within a stud.
    """

    mean: float
    p95: float
    lost: float
    colour: float


def seen_surface(build: Build, count: int = POINTS) -> SeenSurface:
    """Return the surface of a build's mesh that the air around it reaches.

    Parameters
    ----------
    build : Build
        In whose grid the air is looked for.
    count : int
        Points on all of the surface.

    Returns
    -------
    SeenSurface
    """
    mesh, shape = build.mesh, build.grid.solid.shape
    face, weight, area = scattered(mesh, count)
    points = np.einsum("ki,kij->kj", weight, mesh.vertices[mesh.faces[face]])
    levels = (shape[0] * shape[1], *shape[2:])
    place = ((points - build.grid.origin) / CELL_SIZE)[:, ::-1]
    samples = SurfaceSamples(
        place=place,
        along=np.zeros_like(place),
        cell=np.clip(np.floor(place).astype(np.int64), 0, np.array(levels) - 1),
        normal=face_normals(mesh, PLATE)[face],
        area=np.full(count, area / count),
        colour=np.full(count, COLOUR_ANY, dtype=np.int16),
        height=PLATE,
    )
    seen = reached_by_air(samples, levels)
    texels = _texels(mesh, face[seen], np.einsum("ki,kij->kj", weight[seen], mesh.uvs[face[seen]]))
    return SeenSurface(points[seen], lab_from_srgb(texels))


def _texels(mesh: TriangleMesh, face: NDArray[np.intp], uv: Floats) -> Bytes:
    image = mesh.face_image[face]
    texels = np.empty((len(uv), 3), dtype=np.uint8)
    for row, pixels in enumerate(mesh.images):
        here = image == row
        column, line = texel_at(uv[here], pixels.shape[:2], clamp=bool(mesh.image_clamp[row]))
        texels[here] = pixels[line, column]
    return texels


def likeness(surface: SeenSurface, build: Build, catalogue: Catalogue) -> Likeness:
    """Compare a surface with the bricks of a build.

    Parameters
    ----------
    surface : SeenSurface
        Of the same mesh in the same size.
    build : Build
    catalogue : Catalogue

    Returns
    -------
    Likeness
    """
    owner = build.graph.owner
    cells, cell = outer_faces(owner >= 0)
    places = build.grid.origin + (cells + build.graph.low) * CELL_SIZE
    distance, near = cKDTree(places / STUD).query(surface.points / STUD)
    code = build.bricks.colour[owner[tuple(cell[near].T)]]
    codes, row = np.unique(code, return_inverse=True)
    lab = lab_from_srgb(np.array([catalogue.rgb[catalogue.colour_row(int(each))] for each in codes], dtype=np.uint8))
    kept = distance < LOST
    return Likeness(
        mean=float(distance.mean()),
        p95=float(np.quantile(distance, 0.95)),
        lost=float((distance > LOST).mean()),
        colour=float(ciede2000(surface.lab, lab[row])[kept].mean()),
    )


def outer_faces(solid: Mask) -> tuple[Floats, Ints]:
    """Return points on the faces of cells that the air around them meets.

    Parameters
    ----------
    solid : (n_z, n_y, n_x) bool array
        Cells a plate high.

    Returns
    -------
    points : (n, 3) float64 array
        Along x, y and z in cells: nine on a level face, three in a row on an upright one.
    cell : (n, 3) int64 array
        Cell of each point: z, y, x.
    """
    solid = np.pad(solid, 1)
    air = outer_air(solid)
    points, cells = [], []
    for axis in range(3):
        # on an upright face the three lie side by side
        steps = [(0.0, y, x) for y in THIRDS for x in THIRDS if axis == 0 or (y, x)[axis - 1] == 0]
        for side in (-1, 1):
            cell = np.argwhere(solid & np.roll(air, -side, axis))
            middle = cell + 0.5
            middle[:, axis] += side / 2
            points += [(middle + step)[:, ::-1] - 1 for step in steps]
            cells += [cell - 1] * len(steps)
    return np.concatenate(points), np.concatenate(cells)
