"""Bricks that lie in a grid before its other cells are laid: slopes, and whatever else is given."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..model import NOBODY, Bricks, Catalogue, Fill, UnitGrid, contact_graph
from .problem import Rows, owners, with_margins


def with_fixed(grid: UnitGrid, fixed: Bricks, catalogue: Catalogue) -> UnitGrid:
    """Return a grid in which some bricks lie already.

    Parameters
    ----------
    grid : UnitGrid
        A hollowed model.
    fixed : Bricks
        Within the grid, without collisions.
    catalogue : Catalogue

    Returns
    -------
    UnitGrid
        The cells of these bricks are fixed, in their colours and roles.
    """
    owner = owners_of(fixed, grid, catalogue)[1:-1].reshape(grid.cover.shape)
    taken = owner != NOBODY
    return replace(
        grid,
        colour=np.where(taken, fixed.colour[owner] if len(fixed) else 0, grid.colour).astype(np.int16),
        cover=np.where(taken, np.uint8(Fill.FIXED), grid.cover),
        role=np.where(taken, fixed.role[owner] if len(fixed) else 0, grid.role).astype(np.uint8),
    )


def owners_of(bricks: Bricks, grid: UnitGrid, catalogue: Catalogue) -> Rows:
    """Return the row of the brick in each cell of a grid, with the planes of :func:`~.problem.with_margins`."""
    return owners(contact_graph(bricks, catalogue), with_margins(grid.colour, 0).shape)
