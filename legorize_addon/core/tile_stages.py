"""What the settings mean for tiles: where they make tops smooth, and that the model stands as well as before."""

from __future__ import annotations

from typing import Final

import numpy as np

from .arrays import Ints, Mask
from .by_hand import ByHand
from .edits import Edit, ruled
from .layout import Smoothed, smooth_tops
from .model import Assembly, Bricks, Verdict
from .run import Run
from .statics import Effort, Stability, stability
from .strength import like_before, weaker
from .units import count_of

PRICE: Final = 2.0
"""Studs that a part more has to take out of sight for smooth tops. Of eight models at 24 and 48 studs, 30 to 50 % of
the studs in sight go then for 0 to 4 % more parts, and 75 % for 4 to 14 % on models with flat tops; with 1, twice as
many parts more; with 0, where all go, parts grow by 24 to 116 %."""

_ROUNDS: Final = 4
"""Times that tiles are laid anew with whole plates where the model would be weak."""


def smooth_surface(
    run: Run, assembly: Assembly, found: Stability, edits: tuple[Edit, ...]
) -> tuple[Assembly, Stability, tuple[str, ...]]:
    """Lay tiles where studs can be seen, as far as the model stands as well; say how many, and what they take.

    What edits laid stays. If nothing can be bought, plates become tiles of their size as long as there are some.
    """
    if not run.settings.smooth:
        return assembly, found, ()
    may = ~ruled(assembly.bricks, run.catalogue, edits)
    effort = Effort(near=found, programme=0, neighbours=not found.stable)
    for _ in range(_ROUNDS):
        made = _tiled(run, assembly, may)
        if len(made.bricks) == len(assembly):
            break
        other = Assembly(made.bricks, run.catalogue)
        tested = like_before(run, other, found, effort)
        if not weaker(tested, found):
            return other, _again(run, other, tested), (_told(made, len(assembly)),)
        weak = _weak(other, tested, made.origin, len(assembly))
        if not weak.any():
            break
        may &= ~weak
    made = _tiled(run, assembly, may, np.inf)
    other = Assembly(made.bricks, run.catalogue)
    tested = like_before(run, other, found, effort)
    if made.seen == made.left or weaker(tested, found):
        return assembly, found, ()
    return other, _again(run, other, tested), (_told(made, len(assembly)),)


def without_proof(run: Run, by_hand: ByHand) -> Bricks:
    """Return a layout as it was before edits, with tiles if there may be any: what is left when all are taken back."""
    if not run.settings.smooth or not by_hand.made:
        return by_hand.before
    return _tiled(run, Assembly(by_hand.before, run.catalogue), np.ones(len(by_hand.before), bool)).bricks


def _tiled(run: Run, assembly: Assembly, may: Mask, price: float | None = None) -> Smoothed:
    """Lay tiles by the settings."""
    parts, there = run.parts.joining, run.parts.at_most
    if price is None:
        price = 0.0 if run.settings.tops == "all" else PRICE
    # parts that are cut from what is owned may not be there
    price = price if there is None else np.inf
    return smooth_tops(assembly.bricks, parts, price=price, may=may, at_most=there)


def _weak(other: Assembly, tested: Stability, origin: Ints, n: int) -> Mask:
    """Return which of `n` bricks became too weak, or lie on or under what did."""
    weak = tested.margin < 0
    if tested.standing is Verdict.COLLAPSES:
        # of a motion that proves nothing all bricks may be a part
        weak |= tested.moves
    lower, upper = other.graph.pairs.T
    near = weak.copy()
    near[upper[weak[lower]]] = True
    near[lower[weak[upper]]] = True
    found = np.zeros(n, bool)
    found[origin[near]] = True
    return found


def _again(run: Run, assembly: Assembly, near: Stability) -> Stability:
    """Return how bricks stand with all of their clutch."""
    return stability(assembly, clutch=run.settings.clutch, effort=Effort(near=near), progress=run.progress)


def _told(made: Smoothed, before: int) -> str:
    """Say how many studs tiles hide, and how many parts more that takes."""
    more = len(made.bricks) - before
    parts = count_of(more, "additional part", "additional parts") if more else "no additional part"
    return f"Tiles hide {made.seen - made.left} of the {made.seen} studs that would show on top, with {parts}."
