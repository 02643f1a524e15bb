"""What lies behind slopes: coloured where one looks past them, and free to be left out where nobody does."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np
from scipy import ndimage

from ..arrays import Ints, Mask
from ..model import Bricks, Catalogue, Fill, UnitGrid
from .forms import forms


def open_up(shell: UnitGrid, solid: Mask, slopes: Bricks, catalogue: Catalogue, *, filled: bool = False) -> UnitGrid:
    """Return a hollowed model as slopes leave it.

    Parameters
    ----------
    shell : UnitGrid
    solid : (n_layers, 3, n_y, n_x) bool array
        What the model fills before it is hollowed.
    slopes : Bricks
        Within the grid; what else is among them is left alone.
    catalogue : Catalogue
    filled : bool, optional
        Whether all that is hidden has to be filled as it would be without slopes.

    Returns
    -------
    UnitGrid
        Hidden cells beside the open sides of slopes have the colours of these and are required. Other hidden cells
        around slopes need not be filled: they joined the cells for which slopes stand now, and what is loose without
        them is tied later.
    """
    shape = (-1, *shell.colour.shape[2:])
    colour, cover = (each.reshape(shape).copy() for each in (shell.colour, shell.cover))
    taken = np.zeros(cover.shape, bool)
    taken[tuple(_cells_of(slopes, catalogue, "cells")[0].T)] = True
    at, row = _cells_of(slopes, catalogue, "beside")
    inside = ((at >= 0) & (at < cover.shape)).all(axis=1)
    beside, code = tuple(at[inside].T), slopes.colour[row[inside]]
    seen = np.zeros(cover.shape, bool)
    seen[beside] = (solid.reshape(shape) & (colour < 0))[beside]
    around = ndimage.binary_dilation(taken, np.ones((3, 3, 3), bool))
    # what else is fixed stands on something, and something on it: a jumper
    given = (cover == Fill.FIXED) & ~taken
    around &= ~ndimage.binary_dilation(given, np.ones((3, 1, 1), bool))
    if not filled:
        cover[around & (cover == Fill.REQUIRED) & (colour < 0)] = Fill.OPTIONAL
    cover[seen] = Fill.REQUIRED
    colour[beside] = np.where(seen[beside], code, colour[beside])
    return replace(shell, colour=colour.reshape(shell.colour.shape), cover=cover.reshape(shell.cover.shape))


def _cells_of(slopes: Bricks, catalogue: Catalogue, which: Literal["cells", "beside"]) -> tuple[Ints, Ints]:
    """Return cells (z, y, x) of slopes as their forms name them, (k, 3), and the row of the slope of each."""
    found, rows = [np.zeros((0, 3), np.int64)], [np.zeros(0, np.int64)]
    for form in forms(catalogue.parts, plates=True):
        mine = np.flatnonzero((slopes.part == form.part) & (slopes.turn == form.turn))
        cells: Ints = getattr(form, which)
        found.append((slopes.corner[mine, None, ::-1] + cells).reshape(-1, 3))
        rows.append(np.repeat(mine, len(cells)))
    return np.concatenate(found), np.concatenate(rows)
