"""Bricks behind a flat picture or relief, which hold it together.

Nothing joins the bricks of a lying picture, because they lie side by side. A layer behind them joins them, as its
bricks lie across their seams. A row behind a standing picture does the same, and may also become part of its bricks,
because its colour is hidden.

References
----------
Paper, section of the results: its third model, whose layers are all the same,
becomes a mosaic of the upper surface.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Ints, Mask
from ..geometry import outer_air, visible
from ..model import CELL_SIZE, COLOUR_ANY, COLOUR_EMPTY, Fill, Role, UnitGrid
from ..units import PLATES_PER_BRICK
from .facing import Facing

_MARGIN: Final = 1
"""Free cells around the model along x and y."""


def add_backing(grid: UnitGrid, facing: Facing, *, depth: int) -> UnitGrid:
    """Put layers or rows behind a flat model, down to a level back.

    Parameters
    ----------
    grid : UnitGrid
        All unit bricks of the model, before hollowing.
    facing : Facing
        The direction that the model faces.
    depth : int
        Layers of bricks below a lying model, or rows of studs behind a standing
        one, where the model reaches farthest back; more where it does not.

    Returns
    -------
    UnitGrid
        Enlarged towards the back where the backing needs room. The backing is required, in any colour, and so are the
        bricks and plates that it hides.
    """
    solid = grid.solid.reshape(-1, *grid.solid.shape[2:])
    if not solid.any() or depth == 0:
        return grid
    rear = _from_behind(solid, facing)
    step = PLATES_PER_BRICK if facing.axis == 2 else 1
    # a layer of bricks cannot begin within the one of the picture's plates
    level = (int(rear.min()) // step - depth) * step
    missing = max(0, (_MARGIN if step == 1 else 0) - level)
    larger = _extended(grid, facing, missing)
    solid = larger.solid.reshape(-1, *larger.solid.shape[2:])
    behind = _filled(solid, facing, level + missing).reshape(larger.solid.shape)
    return _painted(larger, behind)


def _axis_of(facing: Facing) -> int:
    """Return the axis of arrays of cells, (z, y, x)."""
    return 2 - facing.axis


def _seen_from_behind(cells: Mask, facing: Facing) -> Mask:
    """Return a view of cells with the axis of the picture first, from the back to the front."""
    turned = np.moveaxis(cells, _axis_of(facing), 0)
    return turned if facing.sign > 0 else turned[::-1]


def _from_behind(solid: Mask, facing: Facing) -> Ints:
    """Return the first cell of the model in each line of sight that meets it, from the back, (n,)."""
    turned = _seen_from_behind(solid, facing)
    return turned.argmax(axis=0)[turned.any(axis=0)]


def _filled(solid: Mask, facing: Facing, level: int) -> Mask:
    """Return the cells from a level, counted from the back, to the model, (n_z, n_y, n_x)."""
    filled = np.zeros_like(solid)
    turned, target = _seen_from_behind(solid, facing), _seen_from_behind(filled, facing)
    target[level:] = turned.any(axis=0) & ~np.logical_or.accumulate(turned[level:], axis=0)
    return filled


def _extended(grid: UnitGrid, facing: Facing, cells: int) -> UnitGrid:
    """Return the grid with more empty cells at the back."""
    axis = _axis_of(facing)
    before = facing.sign > 0
    # along z the cells come by threes, the plates of a layer
    width = [(0, 0)] * 4
    number = cells // PLATES_PER_BRICK if axis == 0 else cells
    width[axis + (axis > 0)] = (number, 0) if before else (0, number)
    origin = grid.origin.copy()
    origin[facing.axis] -= cells * CELL_SIZE[facing.axis] * before
    return UnitGrid(
        np.pad(grid.colour, width, constant_values=COLOUR_EMPTY),
        np.pad(grid.cover, width, constant_values=Fill.EMPTY),
        np.pad(grid.role, width),
        origin,
    )


def _painted(grid: UnitGrid, behind: Mask) -> UnitGrid:
    """Return the grid with the backing, and no colours where it hides them."""
    plates = (-1, *grid.solid.shape[2:])
    solid = (grid.solid | behind).reshape(plates)
    seen = visible(solid, outer_air(solid)).reshape(behind.shape)
    # what is a brick stays one: all three plates are free or none is
    brick = grid.solid.all(axis=1, keepdims=True)
    free = behind | (grid.solid & ~np.where(brick, seen.any(axis=1, keepdims=True), seen))
    cover: NDArray[np.uint8] = np.where(behind, np.uint8(Fill.REQUIRED), grid.cover)
    colour: NDArray[np.int16] = np.where(free, np.int16(COLOUR_ANY), grid.colour)
    role: NDArray[np.uint8] = np.where(free, np.uint8(Role.INSIDE), grid.role)
    return UnitGrid(colour, cover, role, grid.origin)
