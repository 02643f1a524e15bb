"""Cells that a shell needs in addition so that its bricks hold together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Mask
from ..model import Fill, UnitGrid, brick_columns
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


@dataclass(frozen=True, slots=True)
class Additions:
    """What a shell was given so that its bricks hold together.

    Attributes
    ----------
    between : int
        Columns of a brick's height, or parts of them, between bodies that nearly touch.
    under_roofs : int
        The same under thin roofs.
    in_plates : int
        Brick columns that are laid in plates.
    """

    between: int
    under_roofs: int
    in_plates: int


def count_additions(grid: UnitGrid, *, plates: bool) -> Additions:
    """Count what :func:`make_cohesive` adds.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model.
    plates : bool
        As there.

    Returns
    -------
    Additions
    """
    joined = join_near_bodies(grid, plates=plates)
    roofed = reinforce_roofs(joined, plates=plates)
    seamed = add_plate_seams(roofed) if plates else roofed
    whole, left = (brick_columns(each)[0] for each in (roofed, seamed))
    return Additions(_columns(joined, grid), _columns(roofed, joined), int(np.count_nonzero(whole & ~left)))


def _columns(more: UnitGrid, less: UnitGrid) -> int:
    """Count the columns in which cells must be built that need not before."""
    added: Mask = (more.cover == Fill.REQUIRED) & (less.cover != Fill.REQUIRED)
    return int(np.count_nonzero(added.any(axis=1)))
