"""More bricks behind what tears: where a layout collapses, its walls are made thicker."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .catalogue import Catalogue
from .connection import stud_columns
from .model import Bricks, Cover, Ints, Mask, Role, UnitGrid
from .units import PLATES_PER_BRICK


def thickened(
    shell: UnitGrid, model: UnitGrid, bricks: Bricks, catalogue: Catalogue, *, weak: Ints, reach: int
) -> UnitGrid:
    """Fill the inside of a model around its weak bricks.

    Parameters
    ----------
    shell : UnitGrid
        What was laid.
    model : UnitGrid
        All unit bricks, before hollowing; cavities of the mesh stay empty.
    bricks : Bricks
        The layout.
    catalogue : Catalogue
    weak : (m,) int64 array
        Rows of bricks.
    reach : int
        Studs, and layers, around them.

    Returns
    -------
    UnitGrid
        With the cells of the model in reach that must be built, the added ones
        of role ``INSIDE`` in whichever colour they had.
    """
    near = _near(shell, bricks, catalogue, weak, reach) & model.solid
    added = near & ~shell.solid
    return replace(
        shell,
        colour=np.where(added, model.colour, shell.colour),
        role=np.where(added, np.uint8(Role.INSIDE), shell.role),
        cover=np.where(near, np.uint8(Cover.MUST), shell.cover),
    )


def _near(shell: UnitGrid, bricks: Bricks, catalogue: Catalogue, weak: Ints, reach: int) -> Mask:
    """Return the cells in reach of some bricks, (n_layers, 3, n_y, n_x)."""
    _, columns = stud_columns(bricks.take(weak), catalogue)
    x, y, level = columns.T
    layers: NDArray[np.bool_] = np.zeros((len(shell.cover), *shell.cover.shape[2:]), dtype=bool)
    layers[level // PLATES_PER_BRICK, y, x] = True
    grown = ndimage.binary_dilation(layers, np.ones((3, 3, 3), dtype=bool), iterations=reach)
    return np.broadcast_to(grown[:, None], shell.cover.shape)
