"""From the cells of a model to its bricks: every other layer first, then those between.

Bricks of the second half prefer to lie across the seams of the layers below and
above; none may hang in the air. How sheets are laid within these costs is left
to the tier (:mod:`greedy` is the fast one).
"""

from __future__ import annotations

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
from .placements import placements
from .problem import GROUND, pose, with_margins
from .repair import connect_loose
from .shapes import Rows, Shapes, shapes
from .sheets import Sheets, split
from .table import bricks_of, gathered

FILLER: Final = 71
"""LDraw code of Light Bluish Gray, in which nearly every part is made: for bricks that nobody sees."""

_SLAB: Final = 1 << 15
"""Cells that are laid together: enough to drown the cost of a numpy call, few
enough for the memory (147 placements go through a cell in a wide area)."""


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
        Told before each slab of layers.

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
    must = with_margins(grid.cover == Cover.MUST, False)
    if not must.any():
        raise BuildError("The model has 0 cells to build: make it larger.")
    codes = np.unique(grid.colour[grid.colour >= 0])
    work = [(each, shapes(catalogue, each.height, codes, filler)) for each in split(grid)]
    owner = np.full(must.shape, NOBODY, dtype=np.int32)
    owner[: min(int(sheets.level[0]) for sheets, _ in work) + 1] = GROUND
    slab_of_layer = np.cumsum(grid.solid.any(axis=1).sum(axis=(1, 2))) // _SLAB
    laid = []
    for slab in np.unique(slab_of_layer):
        progress("layout", float(np.mean(slab_of_layer < slab)))
        for sheets, among in work:
            inside = slab_of_layer[sheets.level // PLATES_PER_BRICK] == slab
            # sheets of one half do not touch: they are laid at once
            odd = sheets.level // sheets.height % 2 == 1
            for half in (inside & ~odd, inside & odd):
                if half.any():
                    laid.append(_laid(sheets.take(half), among, owner, must, rng))
    return connect_loose(gathered(laid), grid, work, catalogue, rng, progress)


def _laid(sheets: Sheets, among: Shapes, owner: Rows, must: Mask, rng: np.random.Generator) -> Bricks:
    """Lay sheets that do not touch; write the owners of their cells into `owner`."""
    problem = pose(sheets, among, placements(sheets, among), owner, must)
    chosen = fewer_small(problem, cover(problem, rng), rng)
    covering = problem.owner(chosen)
    _check_covered(sheets, problem.must & (covering == NOBODY))
    here = np.full(sheets.colour.shape, NOBODY, dtype=np.int32)
    here.reshape(-1)[sheets.cells] = covering
    # bricks and plates of a layer share its planes
    for plate in range(1, sheets.height + 1):
        planes = owner[sheets.level + plate]
        owner[sheets.level + plate] = np.where(sheets.colour == COLOUR_EMPTY, planes, here)
    return bricks_of(problem, chosen)


def _check_covered(sheets: Sheets, missing: Mask) -> None:
    if not missing.any():
        return
    code = sheets.colour.reshape(-1)[sheets.cells[missing]][0]
    raise BuildError(
        f"{np.count_nonzero(missing)} cells cannot be covered, the first of them in colour {code}, because no part "
        "of one cell is made in it: leave it out of the palette."
    )
