"""The paper's way to lay a model: upwards, every brick chosen by a machine (see :mod:`.learning.fill`)."""

from __future__ import annotations

import numpy as np

from ..errors import BuildError
from ..model import Bricks, Catalogue, Fill, UnitGrid
from ..progress import Progress, silent
from .lay import FILLER, check_covered, join_loose, sheets_and_shapes
from .learning import FillLog, Layer, decided, fill_upwards, learned_grader
from .problem import Index


def lay_learned(
    grid: UnitGrid,
    catalogue: Catalogue,
    *,
    rng: np.random.Generator,
    learned_from: str = "",
    log: FillLog | None = None,
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
    learned_from : str
        File of the machine's samples; empty for the built-in training.
    log : FillLog, optional
        Is told what is done.
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
    SettingsError
        The file is no file of samples.
    """
    if not (grid.cover == Fill.REQUIRED).any():
        raise BuildError("The model has no cells to build: make it larger.")
    work = sheets_and_shapes(grid, catalogue, filler)
    log = FillLog() if log is None else log
    with log.timed("training"):
        grader, log.facts = learned_grader(learned_from)
    choose = log.watched(grader)

    def fill(layer: Layer) -> Index:
        chosen = decided(layer, choose, rng)
        check_covered(layer.problem.sheets, layer.problem.required & (layer.problem.owner(chosen) < 0))
        return chosen

    with log.timed("filling"):
        bricks = fill_upwards(grid, work, fill, check=check_covered, progress=progress)
    return join_loose(bricks, grid, catalogue, work, rng, progress)
