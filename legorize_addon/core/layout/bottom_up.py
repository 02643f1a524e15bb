"""From the cells of a model to its bricks: one sheet after the other, bottom-up.

Laying a sheet knows the bricks below. It prefers placements that lie across the
seams there, and avoids those that would hang in the air. How a sheet is laid
within these costs is left to the tier (:mod:`greedy` is the fast one).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np

from ..catalogue import Catalogue
from ..connection import NOBODY
from ..errors import BuildError
from ..model import COLOUR_EMPTY, Bricks, Cover, Mask, UnitGrid
from ..progress import Progress, silent
from ..units import PLATES_PER_BRICK
from .exchange import fewer_small
from .greedy import cover
from .placements import Placements, placements
from .problem import GROUND, Problem, pose
from .repair import connect_loose
from .shapes import Index, Rows, Shapes, shapes
from .sheets import Sheets, split
from .table import bricks_of, gathered

FILLER: Final = 71
"""LDraw code of Light Bluish Gray, in which nearly every part is made: for bricks that nobody sees."""

_BATCH: Final = 1 << 18
"""Cells of the layers whose placements are enumerated together: enough to drown
the cost of a numpy call, few enough for the processor's cache."""


def lay(
    grid: UnitGrid,
    catalogue: Catalogue,
    *,
    rng: np.random.Generator,
    filler: int = FILLER,
    progress: Progress = silent,
) -> Bricks:
    """Cover a model by bricks.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model.
    catalogue : Catalogue
        Parts and colours.
    rng : numpy.random.Generator
        Decides between equals; the same state gives the same bricks.
    filler : int
        LDraw code of the bricks that nobody sees.
    progress : Progress
        Told after each sheet.

    Returns
    -------
    Bricks
        Every must cell lies in one brick, every may cell in one or none, each
        brick has the colour of its cells and is made in it. By ascending level,
        one step a layer.

    Raises
    ------
    BuildError
        There is nothing to build, or a must cell cannot be covered, because no
        part of one cell is made in its colour.
    """
    must = (grid.cover == Cover.MUST).reshape(-1, *grid.cover.shape[2:])
    if not must.any():
        raise BuildError("The model has 0 cells to build: make it larger.")
    codes = np.unique(grid.colour[grid.colour >= 0])
    work = [(each, shapes(catalogue, each.height, codes, filler)) for each in split(grid)]
    # one plane more below and above, so that every cell has something under and over it
    must = np.pad(must, ((1, 1), (0, 0), (0, 0)))
    owner = np.full(must.shape, NOBODY, dtype=np.int32)
    owner[: min(int(sheets.level[0]) for sheets, _ in work) + 1] = GROUND
    step = max(1, _BATCH // (must[0].size * PLATES_PER_BRICK)) * PLATES_PER_BRICK
    laid = []
    for first in range(0, len(must), step):
        batches = [
            (sheets.take((first <= sheets.level) & (sheets.level < first + step)), among) for sheets, among in work
        ]
        laid += _laid(batches, owner, must, rng, lambda level: progress("layout", level / len(must)))
    return connect_loose(gathered(laid), work, must, catalogue, rng)
