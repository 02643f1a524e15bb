"""What a shell needs beyond its own cells to hold together once it is laid."""

from __future__ import annotations

from ..model import UnitGrid
from .near_bodies import with_bodies_joined
from .plate_seams import with_joints
from .roofs import reinforced


def held_together(grid: UnitGrid, *, plates: bool) -> UnitGrid:
    """Join bodies that nearly touch, reinforce thin roofs, open walls for what sticks out.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model.
    plates : bool
        Whether plates may be used for it, or bricks alone.

    Returns
    -------
    UnitGrid
    """
    grid = reinforced(with_bodies_joined(grid, plates=plates), plates=plates)
    return with_joints(grid) if plates else grid
