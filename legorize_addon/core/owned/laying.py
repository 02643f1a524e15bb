"""Laying a model with owned parts: what is scarce becomes dear until no lot is overdrawn, or nothing more is gained.

The limits on parts and lots are relaxed (Held and Karp 1971): each part has a price
that rises while more of it lie in the model than are owned, and falls while many are
left. What colours cost follows from the transport problem that gives bricks their
lots. The layout of the least overdraft is kept, and repaired exactly later.

References
----------
M. Held, R. M. Karp, "The traveling-salesman problem and minimum spanning trees: Part II", Math. Programming 1, 1971.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..model import Assembly, Bricks, Catalogue, contact_graph
from ..units import PLATES_PER_BRICK
from .assignment import assign, differences, visible_cells

ROUNDS: Final = 10
"""Most layouts."""

RISE: Final = 0.5
"""Bricks by which the price of a part rises at most in a round."""

FALL: Final = 0.1
"""Share of the price of a part by which it falls in a round while a fifth of what is owned is left."""

LEFT: Final = 0.2

COLOUR: Final = 0.02
"""Bricks that a difference of one CIEDE2000 is worth on one stud that is seen."""

BOUGHT: Final = 0.6
"""Bricks that it costs more to buy a part than to take one that is owned."""

LACKING: Final = 3.0
"""Bricks that a 1 x 1 costs more that nobody owns."""

SMOOTH: Final = 0.5
"""Weight of the newest prices of colours in their running mean."""

Lay = Callable[[Catalogue], Bricks]


def lay_owned(lay: Lay, catalogue: Catalogue, count: Ints, *, only: bool) -> Bricks:
    """Lay a model with owned parts.

    Parameters
    ----------
    lay : callable
        Lays the model by what a catalogue says of parts and their costs.
    catalogue : Catalogue
        Its costs are added to.
    count : (n_parts, n_colours) int64 array
        Owned bricks.
    only : bool
        Whether nothing can be bought; bricks may then have other colours than the model.

    Returns
    -------
    Bricks
        In the colours of the model, not yet of the lots. Of all layouts tried, the one with the fewest bricks that are
        not owned.
    """
    scarce, spread = np.zeros(len(count)), np.zeros(count.shape)
    best, least = None, (np.inf, np.inf)
    for _ in range(ROUNDS if only else ROUNDS // 2):
        bricks = lay(_priced(catalogue, count, scarce, spread, only=only))
        graph = contact_graph(bricks, catalogue)
        visible = visible_cells(graph)
        found = assign(Assembly(bricks, catalogue), visible, count, keep=not only)
        over = np.bincount(bricks.part[found.missing], minlength=len(count))
        changed = found.colour != bricks.colour
        value = (float(over.sum()), float(visible[changed].sum() * only) + len(bricks))
        if value < least:
            best, least = bricks, value
        if not over.any() and only:
            break
        scarce = _adjusted(scarce, over, bricks, count)
        spread = (1 - SMOOTH) * spread + SMOOTH * np.minimum(found.scarcity * COLOUR, RISE)
    if best is None:
        raise AssertionError("no layout was tried")
    return best


def _adjusted(scarce: Floats, over: Ints, bricks: Bricks, count: Ints) -> Floats:
    """Return the prices of parts after a layout."""
    used, owned = np.bincount(bricks.part, minlength=len(count)), count.sum(axis=1)
    raised = scarce + RISE * np.minimum(over / np.maximum(LEFT * owned, 1), 1)
    adjusted: Floats = np.where((over == 0) & (used < (1 - LEFT) * owned), raised * (1 - FALL), raised)
    return adjusted


def _priced(catalogue: Catalogue, count: Ints, scarce: Floats, spread: Floats, *, only: bool) -> Catalogue:
    """Return a catalogue in which scarce lots are dear."""
    usual = np.ones(count.shape) if catalogue.cost is None else catalogue.cost
    if not only:
        lots = np.where(count > 0, np.minimum(scarce[:, None] + spread, BOUGHT), BOUGHT)
        return replace(catalogue, cost=usual + lots)
    # a brick may be taken from any lot of its part, for what its colour differs on half of its studs
    studs = np.array([part.length * part.width for part in catalogue.parts])
    loss = COLOUR * differences(catalogue)[None] * studs[:, None, None] / 2 + spread[:, None, :]
    nearest = np.where(count[:, None, :] > 0, loss, np.inf).min(axis=2)
    owned = count.any(axis=1)
    cost = usual + scarce[:, None] + np.where(owned[:, None], nearest, LACKING)
    return replace(catalogue, exists=np.repeat(usable(catalogue, count)[:, None], count.shape[1], axis=1), cost=cost)


def usable(catalogue: Catalogue, count: Ints) -> Mask:
    """Return the parts that are owned, and the 1 x 1 that fit where nothing else does, (n_parts,).

    Without them there might be no layout at all, and nobody could say what is missing.
    """
    single = np.array(
        [part.length == 1 and part.height <= PLATES_PER_BRICK and part.use == "model" for part in catalogue.parts]
    )
    there: Mask = count.any(axis=1) | single
    return there
