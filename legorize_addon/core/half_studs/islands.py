"""Islands: what hangs together in a layer of bricks, how it fits a grid in four phases, and what lies on what."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..arrays import Floats, Ints
from ..mesh import TriangleMesh, cell_factors
from ..slicing import Grid, covered_area, linked, slice_mesh
from ..units import CELL_AREA, PLATE, PLATES_PER_BRICK, STUD

PHASES: Final = ((0, 0), (1, 0), (0, 1), (1, 1))
"""Half studs along x and y that a grid may lie further on."""

PARTS: Final = 4
"""Squares in a stud, along each side, in which islands are told apart."""

BESIDE: Final = 2
"""Studs around the grid, which other phases and what is moved by half a stud reach."""

_LEAST: Final = 0.01
"""Share of a square that an island covers in one plate at least: rounding of areas makes no islands."""

_HALF: Final = 0.5
"""Share of a cell in one of its plates from which on bricks may lie there."""

_SQUARES: Final = 4_000_000
"""Squares at a time: 32 MB."""


@dataclass(frozen=True, eq=False)
class Islands:
    """The islands of a mesh, n of them, by ascending layer.

    Attributes
    ----------
    corner : (2,) float64 array
        Corner of the raster of squares in mm.
    label : (n_layers, height, width) int32 array
        Island in each square, or -1.
    layer : (n,) int64 array
    error : (n, 4) float64 array
        By how many cells its plates err in each phase: those that are filled or left empty in spite of the mesh, as
        much as they count.
    cells : tuple of tuple of (k, 2) int64 arrays
        Where bricks may lie, for each island and phase: half studs from the corner of the raster to their cells.
    links : (m, 2) int64 array
        Lower and upper island that lie one over the other.
    overlap : (m,) float64 array
        By how many studs.
    """

    corner: Floats
    label: NDArray[np.int32]
    layer: Ints
    error: Floats
    cells: tuple[tuple[Ints, ...], ...]
    links: Ints
    overlap: Floats

    @cached_property
    def nearest(self) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
        """The island nearest to each square, and how far away it is in studs; -1 and infinity in empty layers."""
        near, far = np.full(self.label.shape, -1, np.int32), np.full(self.label.shape, np.inf, np.float32)
        for label, island, away in zip(self.label, near, far, strict=True):
            if (label >= 0).any():
                distance, (y, x) = ndimage.distance_transform_edt(label < 0, return_indices=True)
                island[:], away[:] = label[y, x], distance / PARTS
        return near, far

    def squares(self, points: Floats) -> tuple[Ints, Ints]:
        """Return rows and columns of the squares of points (n, 2) in mm; of the nearest where they are outside."""
        x, y = np.floor((points - self.corner) / STUD * PARTS).astype(np.int64).T
        return np.clip(y, 0, self.label.shape[1] - 1), np.clip(x, 0, self.label.shape[2] - 1)


def find_islands(mesh: TriangleMesh, grid: Grid) -> Islands:
    """Find the islands of a mesh.

    Parameters
    ----------
    mesh : TriangleMesh
        In its size, in mm.
    grid : Grid
        In layers of bricks.

    Returns
    -------
    Islands
    """
    labels: list[NDArray[np.int32]] = []
    layer: list[int] = []
    error, cells, links, overlap = [], [], [], []
    plates = PLATES_PER_BRICK * grid.n_layers
    factors = cell_factors(
        mesh,
        np.array([*(grid.origin[:2] - BESIDE * STUD), grid.origin[2]]),
        (plates, grid.n_y + 2 * BESIDE, grid.n_x + 2 * BESIDE),
    )
    for number, shares in enumerate(_layers(mesh, grid)):
        factor = factors[PLATES_PER_BRICK * number : PLATES_PER_BRICK * (number + 1)]
        label, n = ndimage.label(shares.max(axis=0) > _LEAST, np.ones((3, 3)))
        label = np.where(label > 0, label - 1 + len(layer), -1).astype(np.int32)
        for island, box in enumerate(ndimage.find_objects(label - len(layer) + 1), len(layer)):
            made = _fitted(shares, label, island, box, factor)
            error.append(made[0])
            cells.append(made[1])
        layer += [number] * n
        if labels:
            both = (labels[-1] >= 0) & (label >= 0)
            pairs, count = np.unique(np.stack([labels[-1][both], label[both]], axis=1), axis=0, return_counts=True)
            links.append(pairs)
            overlap.append(count / PARTS**2)
        labels.append(label)
    return Islands(
        corner=grid.origin[:2] - BESIDE * STUD,
        label=np.stack(labels),
        layer=np.array(layer, np.int64),
        error=np.array(error).reshape(-1, len(PHASES)),
        cells=tuple(cells),
        links=np.concatenate([np.zeros((0, 2), np.int64), *links]).astype(np.int64),
        overlap=np.concatenate([np.zeros(0), *overlap]),
    )


def _layers(mesh: TriangleMesh, grid: Grid) -> Iterator[Floats]:
    """Yield the share of each square that is inside the mesh in the plates of each layer, (3, height, width)."""
    height, width = PARTS * (grid.n_y + 2 * BESIDE), PARTS * (grid.n_x + 2 * BESIDE)
    corner = grid.origin[:2] - BESIDE * STUD
    layers = np.arange(grid.n_layers)
    for some in np.array_split(layers, -(-grid.n_layers * PLATES_PER_BRICK * height * width // _SQUARES)):
        if not len(some):
            continue
        plates = (PLATES_PER_BRICK * some[:, None] + np.arange(PLATES_PER_BRICK)).reshape(-1)
        outline = linked(mesh.faces, slice_mesh(mesh, grid.origin[2] + (plates + 0.5) * PLATE))
        fine = replace(outline, start=outline.start * PARTS)
        area = covered_area(fine, len(plates), corner * PARTS, height, width) / CELL_AREA
        yield from area.reshape(-1, PLATES_PER_BRICK, height, width)


def _fitted(
    shares: Floats, label: NDArray[np.int32], island: int, box: tuple[slice, slice], factor: Floats
) -> tuple[Floats, tuple[Ints, ...]]:
    """Return by how many cells an island errs in each phase, and where its bricks would lie."""
    # whole studs around it, one more on each side
    low = [max(side.start // PARTS - 1, 0) * PARTS for side in box]
    high = [min((-(-side.stop // PARTS) + 2) * PARTS, size) for side, size in zip(box, label.shape, strict=True)]
    within = slice(low[0], high[0]), slice(low[1], high[1])
    own = np.where(label[within] == island, shares[:, within[0], within[1]], 0)
    error, cells = np.zeros(len(PHASES)), []
    for phase, half in enumerate(PHASES):
        x, y = (PARTS // 2 * each for each in half)
        moved = own[:, y : own.shape[1] - (PARTS - y) % PARTS, x : own.shape[2] - (PARTS - x) % PARTS]
        share = moved.reshape(len(own), moved.shape[1] // PARTS, PARTS, -1, PARTS).mean(axis=(2, 4))
        counts = factor[:, low[0] // PARTS :, low[1] // PARTS :][:, : share.shape[1], : share.shape[2]]
        error[phase] = (counts * np.minimum(share, 1 - share)).sum()
        row, column = np.nonzero((share >= _HALF).any(axis=0))
        place = 2 * np.stack([column + low[1] // PARTS, row + low[0] // PARTS], axis=1) + half
        cells.append(place.astype(np.int64))
    return error, tuple(cells)
