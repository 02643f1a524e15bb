"""Fewer lots to buy: bricks of lots of one or two take the colour of another lot of their part, if it is close."""

from __future__ import annotations

from typing import Final

import numpy as np

from ..arrays import Floats, Ints
from ..model import Assembly
from .assignment import differences

SMALL: Final = 2
"""Most bricks of a lot that is merged into another one."""


def merge_lots(assembly: Assembly, visible: Ints, limit: float) -> Ints:
    """Merge small lots of a model into others of the same part.

    Parameters
    ----------
    assembly : Assembly
    visible : (n,) int array
        Cells of each brick that are seen; lots of hidden bricks may get any colour.
    limit : float
        Largest difference of two colours, CIEDE2000, at which bricks that are seen are merged.

    Returns
    -------
    (n,) int64 array
        LDraw code of each brick. The number of lots never grows, and each lot was there before.
    """
    bricks, catalogue, apart = assembly.bricks, assembly.catalogue, differences(assembly.catalogue)
    colour = catalogue.colour_rows(bricks.colour).astype(np.int64)
    for part in np.unique(bricks.part).tolist():
        rows = np.flatnonzero(bricks.part == part)
        colour[rows] = _merged(colour[rows], visible[rows], apart, limit)
    return catalogue.codes[colour].astype(np.int64)


def _merged(wanted: Ints, visible: Ints, apart: Floats, limit: float) -> Ints:
    """Return the colour rows of bricks of one part after the cheapest merger, again and again."""
    colour, seen = wanted, visible[:, None] > 0
    while True:
        lots, of, count = np.unique(colour, return_inverse=True, return_counts=True)
        # from the colours that the bricks had at first: mergers do not add up to more
        far = apart[wanted][:, lots]
        worst, price = np.zeros((len(lots), len(lots))), np.zeros((len(lots), len(lots)))
        np.maximum.at(worst, of, far * seen)
        np.add.at(price, of, far * visible[:, None])
        # into a lot that is as large at least, so that mergers do not go in circles
        allowed = (worst <= limit) & (count <= SMALL)[:, None] & (count[None] >= count[:, None])
        allowed &= ~np.eye(len(lots), dtype=bool)
        if not allowed.any():
            return colour
        price = np.where(allowed, price - 1e-6 * count[None], np.inf)
        small, large = np.unravel_index(price.argmin(), price.shape)
        colour = np.where(colour == lots[small], lots[large], colour)
