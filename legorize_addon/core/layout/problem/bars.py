"""Parts that may not lie at some places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import Mask
from .placements import Placements
from .shapes import Shapes
from .sheets import Sheets


@dataclass(frozen=True, slots=True, eq=False)
class Bar:
    """A part, and the cells that it may not cover.

    Attributes
    ----------
    part : int
        Row of the part in the catalogue.
    cells : (n_plates + 2, n_y, n_x) bool array
        With the planes of :func:`~.problem.with_margins`.
    """

    part: int
    cells: Mask


def without_barred(found: Placements, among: Shapes, sheets: Sheets, bars: Sequence[Bar]) -> Placements:
    """Return the placements that no bar forbids.

    Parameters
    ----------
    found : Placements
        On the sheets.
    among : Shapes
    sheets : Sheets
    bars : sequence of Bar

    Returns
    -------
    Placements
        The same object where nothing is forbidden.
    """
    allowed = np.ones(len(found), dtype=bool)
    for bar in bars:
        planes = np.stack([bar.cells[sheets.level + plate] for plate in range(1, sheets.height + 1)])
        barred = planes.any(axis=0).reshape(-1)[sheets.cells]
        allowed &= (among.part[found.shape] != bar.part) | (found.totals(barred) == 0)
    return found if allowed.all() else found.take(np.flatnonzero(allowed))
