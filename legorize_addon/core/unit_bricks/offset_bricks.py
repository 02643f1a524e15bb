"""Offset bricks in the grid: their role, and the colours of cells that need none.

References
----------
Paper, section on overhangs: offset bricks close the horizontal faces between
trajectories of adjacent height.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..geometry import outer_air
from ..model import COLOUR_ANY, Role, UnitGrid
from ..units import BRICK, PLATE, PLATES_PER_BRICK
from .offset_rings import Offsets, offset_rings, recolour_rings


def add_offset_bricks(
    grid: UnitGrid, *, plates: bool, critical_angle: float, literal: bool
) -> tuple[UnitGrid, Offsets]:
    """Give offset bricks their role.

    Parameters
    ----------
    grid : UnitGrid
        All unit bricks, before hollowing.
    plates : bool
        Whether neighbouring levels are plates or bricks.
    critical_angle : float
        See :func:`~.overhangs.offset_rings`.
    literal : bool
        Give visible cells that need no offset the colour of the nearest brick of
        a trajectory or an offset, as the paper does, instead of their own.

    Returns
    -------
    grid : UnitGrid
    offsets : Offsets
        By plates or by bricks.
    """
    shape = (-1, *grid.colour.shape[2:])
    colour = grid.colour.reshape(shape) if plates else grid.colour[:, 0]
    # cells that no air reaches have no horizontal faces to close
    filled = ~outer_air(colour >= COLOUR_ANY)
    offsets = offset_rings(filled, height=PLATE if plates else BRICK, critical_angle=critical_angle)
    if literal:
        own = (colour > COLOUR_ANY) & ~offsets.left_alone
        colour = recolour_rings(colour, offsets.left_alone & (colour > COLOUR_ANY), own)
    offset = (offsets.ring > 0) & (colour > COLOUR_ANY)
    if not plates:
        colour, offset = (np.repeat(each[:, None], PLATES_PER_BRICK, axis=1) for each in (colour, offset))
    role = np.where(offset.reshape(grid.role.shape), np.uint8(Role.OFFSET), grid.role)
    return replace(grid, colour=colour.reshape(grid.colour.shape), role=role), offsets
