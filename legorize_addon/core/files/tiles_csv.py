"""What each tile of a mosaic takes, so that its bricks can be sorted before it is laid."""

from __future__ import annotations

import numpy as np

from ..building import tile_places
from ..model import Assembly, Role
from ..safe_text import csv_text
from ..shopping import count_lots

COLUMNS = ("row", "column", "part", "title", "colour", "colour_name", "count")


def tiles_csv(assembly: Assembly) -> str:
    """Write the parts of each tile of a mosaic as CSV.

    Parameters
    ----------
    assembly : Assembly
        A mosaic; what nobody sees of it is its base.

    Returns
    -------
    str
        ``row`` and ``column`` of the tile of 16 x 16 studs from 1 at the front left, 0 for the base; then a lot in each
        line, as in ``parts.csv``. Bricks across the border of two tiles belong to the one in which their middle lies.
        A mosaic of a single tile is row 1, column 1.
    """
    tile = np.maximum(tile_places(assembly.bricks, assembly.catalogue), 0) + 1
    tile[assembly.bricks.role == Role.INSIDE] = 0
    rows = [
        (row, column, lot.part.number, lot.part.title, lot.colour.code, lot.colour.name, lot.count)
        for row, column in np.unique(tile, axis=0).tolist()
        for lot in count_lots(assembly.take((tile == (row, column)).all(axis=1)))
    ]
    return csv_text(COLUMNS, rows)
