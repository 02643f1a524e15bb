"""Which half studs each cell of a model that is drawn together has."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..arrays import Floats, Ints, Mask
from ..slicing import Grid
from ..units import BRICK, STUD
from .islands import PARTS, PHASES, Islands
from .regions import Choice, Region


@dataclass(frozen=True, slots=True, eq=False)
class Halves:
    """The half studs of the cells of a model.

    Attributes
    ----------
    half : (n_layers, n_y, n_x) uint8 array
        Half studs along x plus twice those along y by which all in a cell lies beyond it, by layers of bricks.
    rest : int
        The same of all that is in no region.
    origin : (3,) float64 array
        Corner of the first cell in mm.
    below : int
        Layers of the regions below that one.
    regions : tuple of Region
        What lies off the rest.
    """

    half: NDArray[np.uint8]
    rest: int
    origin: Floats
    below: int
    regions: tuple[Region, ...]

    def lying_in(self, origin: Floats, shape: tuple[int, ...]) -> Halves:
        """Return those of a grid, n_layers, n_y and n_x, that begins some cells elsewhere in mm: room for feet.

        What lies outside has the half studs of the nearest cell.
        """
        steps = np.round((origin - self.origin) / [STUD, STUD, BRICK]).astype(np.int64)[::-1]
        if not steps.any() and shape == self.half.shape:
            return self
        cells = (
            np.clip(np.arange(many) + step, 0, size - 1)
            for many, step, size in zip(shape, steps.tolist(), self.half.shape, strict=True)
        )
        return replace(self, half=self.half[np.ix_(*cells)], origin=origin, below=self.below + int(steps[0]))

    def at(self, cells: Ints) -> Ints:
        """Return the half studs of cells (n, 3), x, y and layer, along x and y, (n, 2); of the nearest outside."""
        x, y, z = (np.clip(cells[:, axis], 0, self.half.shape[2 - axis] - 1) for axis in range(3))
        found = self.half[z, y, x].astype(np.int64)
        return np.stack([found & 1, found >> 1], axis=1)

    def near(self, layers: Ints) -> tuple[Region, ...]:
        """Return the regions that begin, end or lie at some layers; all where none does."""
        at = layers[:, None] + self.below
        low, high = (np.array([getattr(each, name) for each in self.regions]) for name in ("low", "high"))
        there = ((at >= low - 1) & (at <= high + 1)).any(axis=0)
        return tuple(each for each, one in zip(self.regions, there.tolist(), strict=True) if one or not there.any())


def halves_of(choice: Choice, islands: Islands) -> Ints:
    """Return the half studs of islands on the grid of :func:`grid_together`, (n, 2), x and y."""
    off = np.array(PHASES)[choice.off]
    used = off.any(axis=0)
    half: Ints = np.where(used, off ^ np.array(choice.forward), off)
    return half


def grid_together(grid: Grid, choice: Choice) -> Grid:
    """Return the grid of a model that is drawn together, with room for what is moved."""
    off = np.array(PHASES)[choice.off]
    used = off.any(axis=0)
    base = np.array(choice.base)
    # all that is moved back or forth keeps a free row of cells beside it
    before = base + used
    after = used.astype(np.int64)
    corner = grid.origin[:2] + STUD * (base / 2 - (np.array(choice.forward) & used) / 2 - before)
    more = (before + after).tolist()
    return replace(
        grid,
        origin=np.array([*corner, grid.origin[2]]),
        n_x=grid.n_x + more[0],
        n_y=grid.n_y + more[1],
    )


def halves_in(grid: Grid, islands: Islands, choice: Choice) -> Halves:
    """Return the half studs of the cells of a grid that lies over a model that is drawn together."""
    of_island = halves_of(choice, islands) @ (1, 2)
    rest = int((np.array(choice.forward) & np.array(PHASES)[choice.off].any(axis=0)) @ (1, 2))
    found = np.full(grid.shape, rest, np.uint8)
    for layer, label in enumerate(islands.label):
        here = np.unique(of_island[np.unique(label[label >= 0])])
        if len(here) < 2:
            found[layer] = here[0] if len(here) else found[layer]
            continue
        squares = [np.isin(label, np.flatnonzero(of_island == each)) for each in here]
        many = np.stack([_covered(some, grid, islands, int(each)) for some, each in zip(squares, here, strict=True)])
        there = many.any(axis=0)
        y, x = ndimage.distance_transform_edt(~there, return_distances=False, return_indices=True)
        found[layer] = here[many.argmax(axis=0)[y, x]]
    return Halves(found, rest, grid.origin, 0, choice.regions)


def _covered(squares: Mask, grid: Grid, islands: Islands, half: int) -> Ints:
    """Count the squares in each cell of a layer, where cells lie some half studs further on."""
    corner = grid.origin[:2] + STUD / 2 * np.array([half & 1, half >> 1])
    y, x = np.nonzero(squares)
    middle = islands.corner + (np.stack([x, y], axis=1) + 0.5) * STUD / PARTS
    cell = np.floor((middle - corner) / STUD).astype(np.int64)
    inside = ((cell >= 0) & (cell < (grid.n_x, grid.n_y))).all(axis=1)
    count: Ints = np.bincount(cell[inside] @ (1, grid.n_x), minlength=grid.n_x * grid.n_y)
    return count.reshape(grid.n_y, grid.n_x)
