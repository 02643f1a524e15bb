"""Where slopes may go: the cells of a hollowed model as they lie in its mesh."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final, Self, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..arrays import Floats, Ints, Mask
from ..geometry import outer_air
from ..mesh import TriangleMesh, cell_factors
from ..model import COLOUR_EMPTY, Fill, UnitGrid
from ..slicing import fine_shares
from ..units import PLATES_PER_BRICK, STUD
from .forms import PARTS

Cell = TypeVar("Cell", bound=np.generic)

MARGIN: Final = 4
ROOF: Final = 10
"""Cells around the grid, and above it, that no slope reaches across."""

_WHOLE: Final = 0.98
"""How far inside or outside of the mesh a cell is, -1 to 1, that its surface does not go through."""

_KEPT: Final = 0.9
"""How far outside of the mesh what the model fills of a brick's column lies that it fills in spite of that."""

_AIR: Final = 0
_INSIDE: Final = 1
_OPEN: Final = 2
"""Rows of the cells that are far from the surface, and of those that are left empty inside of it."""


@dataclass(frozen=True, slots=True, eq=False)
class Site:
    """The cells of a model with a margin around them; all arrays but `gain` are (n_z, n_y, n_x), flattened.

    Attributes
    ----------
    shape : tuple of int
    solid : bool array
        What the model fills before it is hollowed.
    required : bool array
        Cells that have to be built.
    air : bool array
        Empty cells that are connected with the outside.
    room : bool array
        Cells that a slope may claim: of the shell, or empty and open, where the cut of the mesh tells what is inside.
    hidden : bool array
        Cells without a colour of their own.
    colour : int16 array
        LDraw code; ``COLOUR_ANY`` or ``COLOUR_EMPTY``.
    row : int32 array
        Row of each cell in `gain`.
    gain : (n_rows, PARTS) float32 array
        What it costs to fill a part of a cell: 1 where it is all outside of the mesh, -1 where it is all inside.
    mixed : int64 array
        Flat indices of the cells that the surface goes through.
    factor : float64 array
        How many times as much as elsewhere likeness counts in each cell.
    """

    shape: tuple[int, int, int]
    solid: Mask
    required: Mask
    air: Mask
    room: Mask
    hidden: Mask
    colour: NDArray[np.int16]
    row: NDArray[np.int32]
    gain: NDArray[np.float32]
    mixed: Ints
    factor: Floats

    @classmethod
    def of(cls, mesh: TriangleMesh, grid: UnitGrid, shell: UnitGrid) -> Self:
        """Cut a mesh at the cells of a model, before and after it was hollowed."""
        solid = _wide((grid.solid | shell.solid).reshape(-1, *grid.solid.shape[2:]), False)
        cover = _wide(shell.cover.reshape(-1, *grid.solid.shape[2:]), Fill.EMPTY)
        colour = _wide(shell.colour.reshape(-1, *grid.solid.shape[2:]), COLOUR_EMPTY)
        inner = _wide(np.ones((solid.shape[0] - ROOF, *grid.solid.shape[2:]), bool), False)
        air = outer_air(solid)
        near = _near(solid) & inner
        low, high = MARGIN, [size - MARGIN for size in solid.shape[1:]]
        shares = fine_shares(mesh, grid.origin, near[: -ROOF or None, low : high[0], low : high[1]])
        row = np.where(solid, _INSIDE, _AIR).astype(np.int32)
        row[near] = _OPEN + 1 + np.arange(len(shares))
        far = [np.full((1, PARTS), cost) for cost in (1.0, -1.0, 0.0)]
        gain = np.concatenate([*far, 1 - 2 * shares.reshape(-1, PARTS)])
        whole = gain.mean(axis=1)
        mixed = np.flatnonzero((np.abs(whole) < _WHOLE)[row.reshape(-1)])
        told = _told(solid, whole[row])
        # to fill what is empty inside of an open surface is neither right nor wrong
        row[~solid & (whole[row] < 0)] = _OPEN
        return cls(
            shape=solid.shape,
            solid=solid.reshape(-1),
            required=(cover == Fill.REQUIRED).reshape(-1),
            air=air.reshape(-1),
            room=(np.where(solid, cover == Fill.REQUIRED, air) & inner & told).reshape(-1),
            hidden=(solid & (colour < 0)).reshape(-1),
            colour=colour.reshape(-1),
            row=row.reshape(-1),
            gain=gain.astype(np.float32),
            mixed=mixed,
            factor=cell_factors(mesh, grid.origin - [MARGIN * STUD, MARGIN * STUD, 0], solid.shape).reshape(-1),
        )

    def flat(self, cells: Ints) -> Ints:
        """Return steps (z, y, x) as steps among the flattened cells."""
        _, n_y, n_x = self.shape
        steps: Ints = cells @ np.array([n_y * n_x, n_x, 1])
        return steps

    def corners(self, place: Ints) -> Ints:
        """Return flat places as cells (x, y, z) of the grid without its margin."""
        z, y, x = np.unravel_index(place, self.shape)
        return np.column_stack([x - MARGIN, y - MARGIN, z])


def _wide(cells: NDArray[Cell], fill: Any) -> NDArray[Cell]:
    """Put a margin around cells, (n_z, n_y, n_x); nothing below the ground."""
    return np.pad(cells, ((0, ROOF), (MARGIN, MARGIN), (MARGIN, MARGIN)), constant_values=fill)


def _near(solid: Mask) -> Mask:
    """Return the cells at the surface on both sides."""
    whole = np.ones((3, 3, 3), bool)
    inner = ndimage.binary_erosion(solid, whole, border_value=1)
    near: Mask = ndimage.binary_dilation(solid, whole) & ~inner
    return near


def _told(solid: Mask, outside: Floats) -> Mask:
    """Return where a model is filled as the cut of its mesh says, which thin walls and open surfaces are not.

    Parameters
    ----------
    solid : (n_z, n_y, n_x) bool array
        Whole bricks from the ground on.
    outside : (n_z, n_y, n_x) float array
        How far outside of the mesh each cell is, -1 to 1.
    """
    by_brick = (-1, PLATES_PER_BRICK, *solid.shape[1:])
    high = -len(solid) % PLATES_PER_BRICK
    there, cost = (np.pad(each, ((0, high), (0, 0), (0, 0))).reshape(by_brick) for each in (solid, outside))
    many = there.sum(axis=1, keepdims=True)
    kept = np.where(there, cost, 0).sum(axis=1, keepdims=True) > _KEPT * many
    told: Mask = ~(there & kept).reshape(-1, *solid.shape[1:])[: len(solid)]
    return told
