"""Light on a grid of cells: what can be seen through a shell."""

from __future__ import annotations

import numpy as np

DIRECTIONS = tuple(step for step in np.ndindex(3, 3, 3) if step != (1, 1, 1))
"""The 26 directions along z, y and x, each step counted from 0 to 2 instead of -1 to 1."""


def holes(solid, shell, *, ground=False) -> int:
    """Count the cells inside a shell that light from outside meets before the shell.

    Rays leave every border cell of the padded grid and go from cell to cell, in
    all three coordinates at once. So a diagonal ray slips between two cells that
    share only an edge, and a ray along a space diagonal between cells that share
    only a corner: a shell of the 26 neighbours is tight, one of six is not.

    Parameters
    ----------
    solid, shell : (n_z, n_y, n_x) bool arrays
        Cells of the model, and those of them that stay.
    ground : bool
        No light comes from below.
    """
    inside = np.pad(solid & ~shell, 1)
    empty = np.pad(~solid, 1, constant_values=True)
    if ground:
        empty[0] = False
    return sum(_met(empty, inside, np.array(step) - 1) for step in DIRECTIONS)


def _met(empty, inside, step) -> int:
    """Count the cells inside that rays along a step meet first."""
    axis = int(np.flatnonzero(step)[0])
    empty, inside = np.moveaxis(empty, axis, 0), np.moveaxis(inside, axis, 0)
    aside = np.delete(step, axis)
    border = np.ones(empty.shape[1:], bool)
    border[1:-1, 1:-1] = False
    count, lit = 0, np.ones(empty.shape[1:], bool)
    for row in range(len(empty))[:: step[axis]]:
        count += np.count_nonzero(lit & inside[row])
        # beyond the array it is light everywhere, so nothing that wraps around matters
        lit = np.roll((lit | border) & empty[row], aside, axis=(0, 1))
    return count
