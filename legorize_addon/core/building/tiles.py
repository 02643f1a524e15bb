"""Tiles of a mosaic: a picture of one or two layers is laid, or built up, tile by tile."""

from __future__ import annotations

from typing import Final

import numpy as np

from ..arrays import Ints
from ..model import Bricks, Catalogue, stud_columns

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
    row, column = _places(box, level).T
    return 1 + row * (column.max(initial=0) + 1) + column if (column >= 0).any() else np.zeros(len(level), np.int64)


def tile_places(bricks: Bricks, catalogue: Catalogue) -> Ints:
    """Return the tile of each brick of a mosaic.

    Parameters
    ----------
    bricks : Bricks
        n rows.
    catalogue : Catalogue

    Returns
    -------
    (n, 2) int64 array
        Row and column of the tile in which its middle lies, from 0 at the front left; -1 if the model is no mosaic.
    """
    brick, columns = stud_columns(bricks, catalogue)
    first = np.searchsorted(brick, np.arange(len(bricks)))
    if not len(bricks):
        return np.zeros((0, 2), dtype=np.int64)
    low, high = (each.reduceat(columns[:, :2], first).astype(np.int64) for each in (np.minimum, np.maximum))
    box = np.stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1]], axis=1)
    return _places(box, bricks.corner[:, 2].astype(np.int64))


def _places(box: Ints, level: Ints) -> Ints:
    """Return row and column of the tile of each part, (n, 2); -1 of all parts if they are no mosaic."""
    nothing = np.full((len(level), 2), -1, dtype=np.int64)
    if not len(level):
        return nothing
    low_x, low_y = box[:, 0].min(), box[:, 2].min()
    wide, deep = box[:, 1].max() - low_x + 1, box[:, 3].max() - low_y + 1
    if min(wide, deep) < SIDE or max(wide, deep) <= SIDE or level.max() - level.min() >= FLAT:
        return nothing
    # the tile in which its middle lies
    column = ((box[:, 0] + box[:, 1]) // 2 - low_x) // SIDE
    row = ((box[:, 2] + box[:, 3]) // 2 - low_y) // SIDE
    return np.stack([row, column], axis=1)
