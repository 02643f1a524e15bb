"""Where the grid of unit cells lies over the model.

References
----------
Paper, section "Unit bricks": the rectangle B around the model is enlarged by
alpha = 1.1 so that no trajectory meets the partial cells at its rim.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from ..geometry import corners, inside
from ..mesh import TriangleMesh
from ..units import BRICK, CELL_AREA, PLATE, PLATES_PER_BRICK, STUD
from .coverage import covered_area
from .slices import slice_mesh
from .trajectories import linked

ALPHA: Final = 1.1
"""Enlargement of the rectangle B (paper)."""

_STEADY_SHARE: Final = 0.05
"""How far inside its base a model's centre of mass should lie, as a share of its width."""


@dataclass(frozen=True, slots=True, eq=False)
class Grid:
    """A box of unit cells.

    Attributes
    ----------
    origin : (3,) float64 array
        Lowest corner in mm.
    n_layers, n_y, n_x : int
        Layers, and cells along y and x.
    height : float
        Height of a layer in mm: that of a brick or of a plate.
    moved : (n_layers of bricks, n_y, n_x) uint8 array, optional
        Half studs along x plus twice those along y by which what lies in a cell was moved against the rest, so that
        it is no image of what lies across the middle.
    """

    origin: Floats
    n_layers: int
    n_y: int
    n_x: int
    height: float = BRICK
    moved: NDArray[np.uint8] | None = None

    @property
    def shape(self) -> tuple[int, int, int]:
        """Cells: (n_layers, n_y, n_x)."""
        return self.n_layers, self.n_y, self.n_x

    def plates(self) -> Grid:
        """Return the same box in layers of plates."""
        return replace(self, n_layers=PLATES_PER_BRICK * self.n_layers, height=PLATE)


def fit_grid(mesh: TriangleMesh, *, symmetric: bool, plates: bool = False) -> Grid:
    """Lay the grid over a mesh that has its final size.

    Parameters
    ----------
    mesh : TriangleMesh
    symmetric : bool
        Put the middle of the model on a cell border or a cell centre, whichever
        lets the outer cells fit better; else the cells start at the corner of the
        rectangle B, enlarged about the middle of the model, as in the paper.
    plates : bool
        Whether the model stands on a layer of plates instead of bricks.

    Returns
    -------
    Grid
    """
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    middle, size = (low + high)[:2] / 2, (high - low)[:2]
    cells = np.maximum(np.ceil(ALPHA * size / STUD), np.ceil(size / STUD) + 2).astype(int)
    start = middle - ALPHA * size / 2
    # the enlargement of a small model is less than the one free cell that every side needs
    start -= np.where(low[:2] - start < STUD, STUD, 0)
    if symmetric:
        # a thin model has one row of cells around its middle, unless it is too small everywhere
        fewest = 1 if size.max() >= STUD / 2 else 0
        odd = np.maximum(np.round(size / STUD), fewest).astype(int) % 2
        cells += (cells + odd) % 2
        start = middle - cells * STUD / 2
    else:
        cells = np.maximum(cells, np.ceil((high[:2] - start) / STUD).astype(int) + 1)
    return _on_ground(mesh, start, cells, plates=plates)


def begun_earlier(grid: Grid, mesh: TriangleMesh, by: Floats, *, plates: bool, raised: float = 0.0) -> Grid:
    """Return the grid that begins some mm earlier along x and y, at most a cell, and ends no earlier.

    Its planes may be raised by some mm, less than a plate, against those that begin at the lowest point.
    """
    cells = np.array([grid.n_x, grid.n_y]) + (by > 0)
    return _on_ground(mesh, grid.origin[:2] - by, cells, plates=plates, raised=raised)


def _on_ground(mesh: TriangleMesh, start: Floats, cells: Ints, *, plates: bool, raised: float = 0.0) -> Grid:
    """Return the grid with a corner at x and y and so many cells, at the height where the model stands best."""
    ground, n_layers = _ground(mesh, start, cells, 1 if plates else PLATES_PER_BRICK, raised)
    return Grid(np.array([*start, ground]), n_layers, int(cells[1]), int(cells[0]))


def _ground(mesh: TriangleMesh, start: Floats, cells: np.ndarray, base: int, raised: float) -> tuple[float, int]:
    """Choose the height of the first layer so that it carries the model.

    A rounded or pointed underside would stand on a few cells; the model is sunk
    by up to one brick, a plate at a time, until its centre of mass lies well
    inside the hull of its lowest plates, as many as `base`, or as well as it can.
    """
    low, high = mesh.vertices[:, 2].min() + raised, mesh.vertices[:, 2].max()
    n_layers = max(1, int(np.ceil((high - low) / BRICK - 1e-9)))
    if n_layers < 3:
        return float(low), n_layers
    plates = low + (np.arange(2 * PLATES_PER_BRICK) + 0.5) * PLATE
    outline = linked(mesh.faces, slice_mesh(mesh, plates))
    coverage = covered_area(outline, len(plates), start, int(cells[1]), int(cells[0]))
    centre = (_centre_of_mass(mesh)[:2] - start) / STUD
    width = (mesh.vertices.max(axis=0) - mesh.vertices.min(axis=0))[:2].max() / STUD
    steady = max(1.0, _STEADY_SHARE * width)
    margins = []
    for sunk in range(PLATES_PER_BRICK + 1):
        first = coverage[sunk : sunk + base].mean(axis=0) >= CELL_AREA / 2
        margins.append(min(_margin(first, centre), steady))
    sunk = int(np.argmax(margins))
    ground = float(low + sunk * PLATE)
    return ground, max(1, int(np.ceil((high - ground) / BRICK - 1e-9)))


def _margin(cells: Mask, point: Floats) -> float:
    """Return how far in studs a point lies inside the hull of some cells; negative outside."""
    y, x = np.nonzero(cells)
    if len(x) == 0:
        return -np.inf
    return inside(corners(list(zip(x.tolist(), y.tolist(), strict=True))), point)


def _centre_of_mass(mesh: TriangleMesh) -> Floats:
    """Return the centre of the volume, or of the surface if the mesh encloses no volume."""
    corners = mesh.vertices[mesh.faces] - mesh.vertices[0]
    middle = corners.sum(axis=1)
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
    area = np.linalg.norm(mesh.normals, axis=1)
    box = np.prod(np.ptp(mesh.vertices, axis=0))
    if volume.sum() / 6 > 1e-3 * box:
        centre = (middle * volume[:, None]).sum(axis=0) / (4 * volume.sum())
    else:
        centre = (middle * area[:, None]).sum(axis=0) / (3 * area.sum())
    shifted: Floats = mesh.vertices[0] + centre
    return shifted
