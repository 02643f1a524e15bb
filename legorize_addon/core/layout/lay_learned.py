"""The paper's way to lay a model: upwards, every brick chosen by a machine (see :mod:`.learning.fill`)."""

from __future__ import annotations

import numpy as np

from ..errors import BuildError
from ..model import Bricks, Catalogue, Fill, UnitGrid
from ..progress import Progress, silent
from .lay import FILLER, check_covered, join_loose, sheets_and_shapes
from .learning import Grader, Layer, decided, fill_upwards, shipped_grader
from .problem import Index


def lay_learned(
    grid: UnitGrid,
    catalogue: Catalogue,
    *,
    rng: np.random.Generator,
    grader: Grader | None = None,
    filler: int = FILLER,
    progress: Progress = silent,
) -> Bricks:
    """Cover a model by bricks that a machine chooses, and join what is loose as :func:`~.lay.lay` does.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model.
    catalogue : Catalogue
        Parts and colours.
    rng : numpy.random.Generator
        Draws the windows that are filled; the same state gives the same bricks.
    grader : Grader, optional
        The machine; by default the one of the built-in training.
    filler : int
        LDraw code of hidden bricks.
    progress : Progress
        Told before each layer.

    Returns
    -------
    Bricks
        As of :func:`~.lay.lay`.

    Raises
    ------
    BuildError
        There is nothing to build, or a required cell cannot be covered.
    """
    if not (grid.cover == Fill.REQUIRED).any():
        raise BuildError("The model has no cells to build: make it larger.")
    work = sheets_and_shapes(grid, catalogue, filler)
    choose = (grader or shipped_grader()).choose

    def fill(layer: Layer) -> Index:
        chosen = decided(layer, choose, rng)
        check_covered(layer.problem.sheets, layer.problem.required & (layer.problem.owner(chosen) < 0))
        return chosen

    bricks = fill_upwards(grid, work, fill, check=check_covered, progress=progress)
    return join_loose(bricks, grid, catalogue, work, rng, progress)
