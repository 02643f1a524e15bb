"""Table 1 of the paper: which share of a model's volume each brick has in each colour."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.catalogue import Catalogue, footprint
from legorize_addon.core.shopping import count_lots
from legorize_addon.core.units import PLATES_PER_BRICK
from scripts.benchmarks.tables import Row

ROUNDING: Final = 0.01
"""What the percentages may add up to besides 100."""

ALL: Final = "all"


def count_rows(start: Row, bricks: Bricks, catalogue: Catalogue) -> list[Row]:
    """Return how many bricks of each part there are in each colour, and of all colours together.

    Parameters
    ----------
    start : dict
        First columns of every row.
    bricks : Bricks
        A model of bricks, without plates.
    catalogue : Catalogue

    Returns
    -------
    list of dict
        A row for each colour of the model, and one for all.
    """
    counts = _counts(bricks, catalogue)
    return [
        start | _colour(catalogue, code) | _cells(catalogue, row.tolist(), int(row.sum()))
        for code, row in _with_sum(counts)
    ]


def volume_rows(start: Row, bricks: Bricks, catalogue: Catalogue) -> list[Row]:
    """Return the share of the volume that each part has in each colour, in percent, as :func:`count_rows`."""
    counts = _counts(bricks, catalogue)
    volume = counts * np.array([len(footprint(part, 0)) * part.height for part in catalogue.parts])
    percent = np.round(100 * volume / volume.sum(), 4)
    rows = [
        start | _colour(catalogue, code) | _cells(catalogue, row.tolist(), float(row.sum()))
        for code, row in _with_sum(percent)
    ]
    met = bool(abs(percent.sum() - 100) <= ROUNDING)
    return [row | {"sum_met": met if row["code"] is None else None} for row in rows]


def _counts(bricks: Bricks, catalogue: Catalogue) -> NDArray[np.int64]:
    """Return the number of bricks by colour row and part row."""
    counts = np.zeros((len(catalogue.colours), len(catalogue.parts)), dtype=np.int64)
    for lot in count_lots(Assembly(bricks, catalogue)):
        counts[catalogue.colour_row(lot.colour.code), catalogue.part_row(lot.part.number)] = lot.count
    return counts


def _with_sum(table: NDArray[np.generic]) -> list[tuple[int | None, NDArray[np.generic]]]:
    """Return the rows that are not empty with their numbers, and the sum of all."""
    return [*((row, table[row]) for row in np.flatnonzero(table.any(axis=1)).tolist()), (None, table.sum(axis=0))]


def _colour(catalogue: Catalogue, row: int | None) -> Row:
    if row is None:
        return {"code": None, "colour": ALL}
    colour = catalogue.colours[row]
    return {"code": colour.code, "colour": colour.name}


def _cells(catalogue: Catalogue, values: list[int] | list[float], total: float) -> Row:
    bricks = [(part, row) for row, part in enumerate(catalogue.parts) if part.height == PLATES_PER_BRICK]
    return {part.title: values[row] for part, row in bricks} | {ALL: total}
