"""Tiles of a mosaic: a picture of one or two layers is laid, or built up, tile by tile."""

from __future__ import annotations

from typing import Final

import numpy as np

from ..arrays import Ints

SIDE: Final = 16
"""Studs of a tile's side."""

FLAT: Final = 6
"""Plates up to which a model that lies counts as a mosaic."""


def tiles_of(box: Ints, level: Ints) -> Ints:
    """Give a number to the tile of each part of a mosaic that lies on the table.

    Parameters
    ----------
    box : (n, 4) int64 array
        First and last stud square of each part in x, then in y.
    level : (n,) int64 array
        Its lowest plate.

    Returns
    -------
    (n,) int64 array
        From 1, row by row from the front; 0 of all parts if they are no mosaic.
    """
    nothing = np.zeros(len(level), dtype=np.int64)
    if not len(level):
        return nothing
    low_x, low_y = box[:, 0].min(), box[:, 2].min()
    wide, deep = box[:, 1].max() - low_x + 1, box[:, 3].max() - low_y + 1
    if min(wide, deep) < SIDE or max(wide, deep) <= SIDE or level.max() - level.min() >= FLAT:
        return nothing
    # the tile in which its middle lies
    column = ((box[:, 0] + box[:, 1]) // 2 - low_x) // SIDE
    row = ((box[:, 2] + box[:, 3]) // 2 - low_y) // SIDE
    return 1 + row * (wide // SIDE + 1) + column
