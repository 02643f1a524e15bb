"""Some cells laid around bricks that lie already and stay: they are bonded with these as with bricks of their own."""

from __future__ import annotations

import numpy as np

from ..model import NOBODY, Bricks, Catalogue, Fill, UnitGrid
from ..progress import Progress, silent
from .lay import FILLER, Manner, cover, sheets_and_shapes
from .symmetric import some_cells


def lay_around(
    grid: UnitGrid,
    catalogue: Catalogue,
    manner: Manner,
    *,
    rng: np.random.Generator,
    filler: int = FILLER,
    progress: Progress = silent,
) -> Bricks:
    """Cover the cells of a grid that no brick fills yet.

    Parameters
    ----------
    grid : UnitGrid
        Cells that bricks fill already are left out, whatever it says of them.
    catalogue : Catalogue
    manner : Manner
        How the cells are laid; ``beside`` has the bricks that stay, of which parts
        they may ever be (:func:`~.problem.owners` returns it of any bricks), and
        ``bars`` what may not lie where.
    rng : numpy.random.Generator
        Decides between equals.
    filler : int
        LDraw code of hidden bricks.
    progress : Progress
        Told before each batch of sheets.

    Returns
    -------
    Bricks
        The new bricks alone; they overlap nothing. Whether all hangs together is
        not looked at.

    Raises
    ------
    BuildError
        A required cell cannot be covered, because no part that may lie there is
        made in its colour.
    """
    if manner.beside is not None:
        grid = some_cells(grid, (manner.beside[1:-1] == NOBODY).reshape(grid.colour.shape))
    if not (grid.cover == Fill.REQUIRED).any():
        return _nothing()
    return cover(grid, sheets_and_shapes(grid, catalogue, filler), rng, manner, progress)


def _nothing() -> Bricks:
    """Return a table without rows."""
    none = np.zeros(0)
    return Bricks(
        part=none.astype(np.int16),
        corner=np.zeros((0, 3), dtype=np.int32),
        turn=none.astype(np.uint8),
        colour=none.astype(np.int16),
        role=none.astype(np.uint8),
        piece=none.astype(np.int16),
        step=none.astype(np.int32),
    )
