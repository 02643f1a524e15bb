"""What the settings mean for slopes: which are chosen, and how bricks are laid around them."""

from __future__ import annotations

from functools import partial

from .build import Draft
from .layout import Manner, lay_around_slopes, lay_fixed
from .layout.joining import add_ties
from .model import Bricks, UnitGrid
from .run import Run
from .slopes import choose_slopes
from .stages import lay_bricks


def find_slopes(run: Run, made: Draft) -> Bricks:
    """Choose the slopes of a model."""
    settings = run.settings
    return choose_slopes(
        made.mesh,
        made.grid,
        made.hollow,
        run.parts.joining,
        price=settings.slope_price,
        plates=settings.plates != "none",
        symmetric=settings.symmetric,
    )


def lay_with_slopes(run: Run, shell: UnitGrid, slopes: Bricks | None) -> tuple[Bricks, UnitGrid]:
    """Lay the bricks around slopes, if there are any; return the cells that they cover as well.

    Slopes that keep the model from hanging together are left out.
    """
    layout = run.settings.layout
    if slopes is None or not len(slopes) or layout == "learned":
        return lay_bricks(run, shell)
    manner, filler = Manner(layout, run.exchanges), run.filler

    def lay(grid: UnitGrid, fixed: Bricks) -> tuple[Bricks, UnitGrid]:
        there = partial(lay_fixed, grid, fixed=fixed, manner=manner, rng=run.rng, filler=filler, progress=run.progress)
        return add_ties(run.parts.laid(there), grid, run.parts.joining, plates=run.settings.plates != "none")

    return lay_around_slopes(shell, slopes, run.catalogue, lay)
