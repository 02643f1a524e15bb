"""What the settings mean for slopes: which are chosen, and how bricks are laid around them."""

from __future__ import annotations

from copy import deepcopy
from functools import partial
from typing import Final

from .build import Draft
from .layout import Manner, lay_around, lay_around_slopes, lay_fixed, owners_of, paying, with_fixed
from .layout.joining import add_ties
from .layout.learning import NO_EXCHANGES
from .model import Bricks, UnitGrid, concatenate
from .run import Run
from .slopes import Slopes, choose_slopes
from .stages import lay_bricks

_HOPE: Final = 0.5
"""Share of their price at which slopes are tried: what they save in parts shows only when the model is laid."""


def find_slopes(run: Run, made: Draft) -> Slopes:
    """Choose the slopes of a model."""
    settings = run.settings
    return choose_slopes(
        made.mesh,
        made.grid,
        made.hollow,
        run.parts.joining,
        price=_HOPE * settings.slope_price,
        plates=settings.plates != "none",
        symmetric=settings.symmetric,
    )


def lay_with_slopes(run: Run, shell: UnitGrid, given: Slopes | None) -> tuple[Bricks, UnitGrid]:
    """Lay the bricks around slopes, if there are any; return the cells that they cover as well.

    Slopes that cost more parts than they are worth are left out, and those that keep the model from hanging together.
    """
    layout = run.settings.layout
    if given is None or not len(given.bricks) or layout == "learned":
        return lay_bricks(run, shell)
    manner, filler = Manner(layout, run.exchanges), run.filler

    def lay(grid: UnitGrid, fixed: Bricks) -> tuple[Bricks, UnitGrid]:
        """Lay the cells around slopes as the settings ask, and tie what is loose."""
        there = partial(lay_fixed, grid, fixed=fixed, manner=manner, rng=run.rng, filler=filler, progress=run.progress)
        return add_ties(run.parts.laid(there), grid, run.parts.joining, plates=run.settings.plates != "none")

    def lay_roughly(fixed: Bricks) -> Bricks:
        """Lay the cells the fast way without exchanges, from the same random numbers each time, and join nothing.

        The machine that proposes exchanges takes longer to train than they save; the slopes that stay are as good.
        """
        cells = with_fixed(shell, fixed, run.catalogue)
        around = Manner("fast", NO_EXCHANGES, beside=owners_of(fixed, cells, run.catalogue))
        bricks = lay_around(cells, run.catalogue, around, rng=deepcopy(run.rng), filler=filler, progress=run.progress)
        return concatenate([fixed, bricks])

    pays = paying(given.bricks, given.worth, given.pair, run.catalogue, lay_roughly, price=run.settings.slope_price)
    return lay_around_slopes(shell, given.bricks.take(pays), run.catalogue, lay)
