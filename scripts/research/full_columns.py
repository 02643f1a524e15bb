"""Full columns, the supports that others are compared with.

References
----------
Paper, section on segmentation (the three types of bricks) and Table 4, which
compares supports with full columns.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from legorize_addon.core.arrays import Mask
from legorize_addon.core.supports.boxes import TALL, Boxes
from legorize_addon.core.supports.clearance import Clearance
from legorize_addon.core.supports.columns import Cells, covered, within_clearance
from legorize_addon.core.units import PLATES_PER_BRICK

FLAT: Final = ((6, 2), (4, 2), (6, 1), (3, 2), (4, 1), (2, 2), (3, 1), (2, 1), (1, 1))
"""Types 1 and 2 of the paper: lengths of bricks and plates in studs, the largest first."""

TALL_SIZES: Final = ((4, 2), (2, 2))
"""Type 3: bricks three times as high."""


def full_columns(cells: Cells, room: Clearance) -> Boxes:
    """Fill all room below cells with the largest bricks that fit, as support without any optimisation does.

    Parameters
    ----------
    cells : (n, 3) integer array
        Cells (x, y, z) in the room, z the plate on which the carried brick lies.
        Those without room down to the ground are left out.
    room : Clearance

    Returns
    -------
    (n, 6) int32 array
        Boxes of the paper's three types, and plates right under the cells.
    """
    x, y, z = within_clearance(cells, room).T
    height = np.zeros(room.open.shape[1:], dtype=np.int64)
    height[y, x] = z
    layers, plates = np.divmod(height, PLATES_PER_BRICK)
    filled = np.arange(layers.max(initial=0))[:, None, None] < layers
    tall, left = _tall(filled)
    flat = _boxes(covered(left, FLAT), PLATES_PER_BRICK, PLATES_PER_BRICK)
    levels = np.arange(int(height.max(initial=0)))[:, None, None]
    thin = _boxes(covered((levels >= height - plates) & (levels < height), FLAT), 1, 1)
    return np.concatenate([tall, flat, thin])


def _tall(filled: Mask) -> tuple[Boxes, Mask]:
    """Take tall bricks from layers that are filled downwards; return them and the cells that are left."""
    n = TALL // PLATES_PER_BRICK
    found = covered(filled[n - 1 :: n], TALL_SIZES)
    left = filled.copy()
    for group, x, y, a, b in found.tolist():
        left[n * group : n * group + n, y : y + b, x : x + a] = False
    return _boxes(found, TALL, TALL), left


def _boxes(found: NDArray[np.int64], step: int, height: int) -> Boxes:
    """Write rectangles down as boxes of a height, on levels of so many plates."""
    level, *sides = found.T
    x, y, a, b = sides
    return np.stack([x, y, level * step, a, b, np.full_like(x, height)], axis=1).astype(np.int32)
