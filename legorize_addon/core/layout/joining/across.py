"""Ties across seams that hold too weakly: between parts of a model that would come apart under their weight."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np

from ...arrays import Floats, Ints
from ...model import COLOUR_EMPTY, Bricks, Catalogue, UnitGrid, contact_graph
from ...units import PLATES_PER_BRICK
from ..problem import owners, with_margins
from .contacts import RECOLOURED, near_contacts
from .cutting import Bench
from .ties import as_laid, seams_of, tie_seam

_PLACES: Final = 60
"""Most places that are looked at between two parts."""

_STEPS: Final = (0.6, RECOLOURED)
"""Prices below which a tie shows nowhere, and below which it shows as a plate more, but in no other colour."""

Worth = Callable[[Ints, Ints], Floats]
"""Of places between bricks, (n, 2), at cells, (n, 3) as plane, y and x of the grid: what a tie there is worth, (n,)."""


def tie_across(
    bricks: Bricks, grid: UnitGrid, catalogue: Catalogue, part: Ints, weak: Ints, worth: Worth, *, plates: bool
) -> tuple[Bricks, UnitGrid]:
    """Lay one tie between each two parts that are told to hold weakly, in no other colour than has to be seen.

    Parameters
    ----------
    bricks : Bricks
        A layout without collisions.
    grid : UnitGrid
        The cells that it covers.
    catalogue : Catalogue
    part : (n,) int64 array
        Part of the model that each brick belongs to.
    weak : (m, 2) int64 array
        Pairs of parts.
    worth : callable
        What a tie at a place is worth; of places that show as little, the best is
        tried first.
    plates : bool
        Whether bricks may be cut into plates, and plates be added.

    Returns
    -------
    bricks : Bricks
        The same object if no tie was laid.
    grid : UnitGrid
        With the cells that were added.
    """
    links = contact_graph(bricks, catalogue)
    colour = with_margins(grid.colour, COLOUR_EMPTY)
    bench = Bench(bricks, owners(links, colour.shape), catalogue)
    found = near_contacts(bench.owner, part.astype(np.int32), colour, plates=plates, places=_PLACES, fixed=bench.fixed)
    pair = np.sort(part[found.bricks], axis=1) @ (len(bricks), 1)
    # the margin below the grid is a plane of its own
    better = np.lexsort((-worth(found.bricks, found.place - (1, 0, 0)), np.digitize(found.price, _STEPS), pair))
    seams, height = seams_of(found), 1 if plates else PLATES_PER_BRICK
    laid = 0
    for number in np.unique(np.sort(weak, axis=1) @ (len(bricks), 1)).tolist():
        places = better[(pair[better] == number) & (found.price[better] < RECOLOURED)]
        laid += any(tie_seam(bench, seams[place], colour, height, 0) for place in places.tolist())
    if not laid:
        return bricks, grid
    bricks = bench.bricks()
    return bricks, as_laid(grid, bricks, contact_graph(bricks, catalogue))
