"""Cells that a shell needs in addition so that its bricks hold together."""

from __future__ import annotations

from ..model import UnitGrid
from .near_bodies import join_near_bodies
from .plate_seams import add_plate_seams
from .roofs import reinforce_roofs


def make_cohesive(grid: UnitGrid, *, plates: bool) -> UnitGrid:
    """Join bodies that nearly touch, reinforce thin roofs, and lay walls in plates where parts stick out.

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
    grid = reinforce_roofs(join_near_bodies(grid, plates=plates), plates=plates)
    return add_plate_seams(grid) if plates else grid
