"""What the settings mean for slopes: which are chosen, and how bricks are laid around them."""

from __future__ import annotations

from copy import deepcopy
from functools import partial
from typing import Final

import numpy as np

from .arrays import Mask
from .build import Draft
from .layout import (
    Manner,
    lay_around,
    lay_around_slopes,
    lay_fixed,
    lie_among,
    owners_of,
    paying,
    slopes_beside,
    with_fixed,
)
from .layout.joining import add_ties
from .layout.learning import NO_EXCHANGES
from .model import NOBODY, Bricks, UnitGrid, Verdict, concatenate, contact_graph
from .run import Run
from .slopes import Slopes, choose_slopes, open_up
from .stages import lay_bricks
from .statics import Stability, torn_by
from .strength import strengthen_joints, tie_parts

_LEFT: Final = 0.5
"""Share of the slopes that have to be left for a model that stands without pillars: else these are the lesser evil."""

_TIES: Final = 0.03
"""Share of its parts that may strengthen a model before slopes beside them are in question: a fox of 48 studs took 9 %,
and had 394 parts without those slopes in place of 431."""

_TRIES: Final = 7
"""Rounds of ties after which slopes are in question: a van of 48 studs took seven, none of eight models more."""

Laid = tuple[Bricks, UnitGrid, Stability | None]
"""Bricks, the cells that they cover, and how they stand with something to spare, if that is known."""

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

    def cells_around(fixed: Bricks) -> UnitGrid:
        """Return the cells of the model with some slopes in them."""
        return with_fixed(open_up(shell, given.solid, fixed, run.catalogue, filled=given.filled), fixed, run.catalogue)

    def lay(fixed: Bricks) -> tuple[Bricks, UnitGrid]:
        """Lay the cells around slopes as the settings ask, and tie what is loose."""
        grid = cells_around(fixed)
        there = partial(lay_fixed, grid, fixed=fixed, manner=manner, rng=run.rng, filler=filler, progress=run.progress)
        return add_ties(run.parts.laid(there), grid, run.parts.joining, plates=run.settings.plates != "none")

    def lay_roughly(fixed: Bricks) -> Bricks:
        """Lay the cells the fast way without exchanges, from the same random numbers each time, and join nothing.

        The machine that proposes exchanges takes longer to train than they save; the slopes that stay are as good.
        """
        cells = cells_around(fixed)
        around = Manner("fast", NO_EXCHANGES, beside=owners_of(fixed, cells, run.catalogue))
        bricks = lay_around(cells, run.catalogue, around, rng=deepcopy(run.rng), filler=filler, progress=run.progress)
        return concatenate([fixed, bricks])

    pays, price = np.ones(len(given.bricks), bool), run.settings.slope_price
    if not given.pays:
        pays = paying(given.bricks, given.worth, given.pair, run.catalogue, lay_roughly, price=price)
    worth, pair, dear = given.worth[pays], given.pair[pays], given.dear[pays]
    laid = lay_around_slopes(given.bricks.take(pays), worth, pair, dear, run.catalogue, lay)
    if given.filled or contact_graph(laid[0], run.catalogue).n_components <= 1:
        return laid
    return lay_with_slopes(run, shell, given.settled(lie_among(given.bricks, laid[0]), filled=True))


def tries_of(given: Slopes | None) -> int | None:
    """Return in how many rounds ties are laid at first, None if there are no slopes that might leave instead."""
    return None if given is None or not len(given.bricks) else _TRIES


def without_weak_slopes(run: Run, shell: UnitGrid, given: Slopes | None, before: Bricks, laid: Laid) -> Laid:
    """Lay a model anew whose studs do not bear it with what is to spare: without the slopes at which it comes apart.

    Ties do not hold it there, and pillars would be seen. All is filled behind the slopes that stay then: all of them
    if most touch what comes apart. Where many ties hold a model, slopes beside them leave if that saves parts. What
    tips over needs pillars anyway.

    Parameters
    ----------
    run : Run
    shell : UnitGrid
        The model without slopes.
    given : Slopes, optional
    before : Bricks
        The model before it was strengthened.
    laid : tuple
        The model, strengthened.

    Returns
    -------
    tuple
        The model, with fewer slopes maybe.
    """
    stands = _stands(laid)
    if given is None or laid[2] is None or (laid[2].tipping < 0).any():
        return laid
    if stands and len(laid[0]) <= (1 + _TIES) * len(before):
        return laid

    def again(slopes: Mask) -> Laid:
        """Lay the model around some slopes, with all behind them if it has not stood yet."""
        bricks, cells = lay_with_slopes(run, shell, given.settled(slopes, filled=not stands))
        return strengthen_joints(run, *tie_parts(run, bricks, cells))

    stay = lie_among(given.bricks, laid[0])
    weak = _torn(laid[2]) | ~lie_among(laid[0], before)
    left = stay & ~lie_among(given.bricks, laid[0].take(slopes_beside(laid[0], weak, run.catalogue)))
    if not _LEFT * np.count_nonzero(stay) <= np.count_nonzero(left) < np.count_nonzero(stay):
        return laid if stands else _nearer(again(stay), laid)
    other = again(left)
    if stands:
        return other if _stands(other) and len(other[0]) < len(laid[0]) else laid
    return _nearer(other, laid)


def _nearer(one: Laid, other: Laid) -> Laid:
    """Return which of two models needs fewer pillars, as far as one can tell: that it falls is proven of the other."""
    open_only = other[2] is not None and other[2].standing is Verdict.UNDECIDED
    return other if open_only and not _stands(one) else one


def _stands(laid: Laid) -> bool:
    """Return whether studs bear a model with what is to spare."""
    return laid[2] is not None and laid[2].standing is Verdict.STABLE


def _torn(found: Stability) -> Mask:
    """Return the bricks that come off others where a model comes apart."""
    torn = np.zeros(len(found.yielding), bool)
    if found.standing is not Verdict.STABLE:
        pairs = torn_by(found.statics, found.yielding)
        torn[pairs[pairs != NOBODY]] = True
    return torn
