"""Hollowing: which cells must be built, which may be, and which stay empty.

A shell of constant thickness around everything empty must be built: it shows,
or it carries what shows. The cells one stud further in may be built, which lets
the layout use larger bricks that hold the shell together; the rest is left out.

References
----------
Section on hollowing of the paper: its four cases applied to the layer above
*and* to the layer below give the same cells as a shell of one cell measured
over all 26 neighbours, so the shell is computed as an erosion.
"""

from __future__ import annotations

import numpy as np

from .model import COLOUR_ANY, COLOUR_EMPTY, Cover, Mask, Role, UnitGrid
from .units import PLATES_PER_BRICK

_MAY_DEPTH = 1
"""Cells that may be built inside the shell, in studs."""


def hollow(grid: UnitGrid, *, shell: int | None) -> UnitGrid:
    """Sort the cells of a solid model into must, may and empty.

    Parameters
    ----------
    grid : UnitGrid
        A solid model; cavities that it encloses are empty cells.
    shell : int or None
        Thickness of the shell that must be built: studs along x and y, bricks
        along z. None leaves the model solid.

    Returns
    -------
    UnitGrid
        ``MUST`` in the shell, ``MAY`` one stud further in, ``EMPTY`` deeper
        inside; everything ``MUST`` when `shell` is None. Colours stay as they
        are in the cells that remain. Shell cells without a colour of their own,
        which nobody sees, get the role ``INSIDE``.
    """
    solid = grid.solid
    cover = np.where(solid, np.uint8(Cover.MUST), np.uint8(Cover.EMPTY))
    if shell is not None:
        cover[eroded(solid, shell)] = Cover.MAY
        cover[eroded(solid, shell + _MAY_DEPTH)] = Cover.EMPTY
    colour = np.where(cover == Cover.EMPTY, np.int16(COLOUR_EMPTY), grid.colour)
    hidden = (colour == COLOUR_ANY) & (grid.role == Role.SHELL)
    role = np.where(hidden, np.uint8(Role.INSIDE), grid.role)
    return UnitGrid(colour=colour, cover=cover, role=role, origin=grid.origin)


def eroded(solid: Mask, thickness: int) -> Mask:
    """Return the cells that lie deeper than a shell of the given thickness.

    Parameters
    ----------
    solid : (n_layers, 3, n_y, n_x) bool array
        Cells of the model; everything outside the array counts as empty.
    thickness : int
        Studs along x and y, bricks along z.

    Returns
    -------
    (n_layers, 3, n_y, n_x) bool array
        True where no empty cell lies within `thickness` along x, y and z at once
        (all 26 neighbours for 1). The three plates of a brick are deep together
        or not at all, so that hollowing never cuts a brick into plates.
    """
    plates = solid.reshape(-1, *solid.shape[2:])
    for axis, reach in enumerate((PLATES_PER_BRICK * thickness, thickness, thickness)):
        plates = _shrunk(plates, axis, reach)
    deep = plates.reshape(solid.shape).all(axis=1, keepdims=True)
    return np.broadcast_to(deep, solid.shape)


def _shrunk(mask: Mask, axis: int, reach: int) -> Mask:
    """Keep the cells whose neighbours up to `reach` away along an axis are all True."""
    margins = [(reach, reach) if each == axis else (0, 0) for each in range(mask.ndim)]
    kept = np.moveaxis(np.pad(mask, margins), axis, 0)
    span = 1
    # windows grow by doubling: a window of 7 cells costs three passes
    while span <= 2 * reach:
        step = min(span, 2 * reach + 1 - span)
        kept = kept[:-step] & kept[step:]
        span += step
    return np.moveaxis(kept, 0, axis)
