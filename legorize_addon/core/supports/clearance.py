"""Where supports may stand: over the ground, with nothing of the model below them.

A support that stands in such a place can be pulled straight down and out when
the finished model is lifted from the table, whatever its shape.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import ndimage

from ..arrays import Mask
from ..model import NOBODY, ContactGraph
from ..units import PLATES_PER_BRICK

MARGIN: Final = 3
"""Studs around the model that supports may use as well: their feet are wider than what they carry."""


@dataclass(frozen=True, slots=True, eq=False)
class Clearance:
    """The free cells around a model, from the plate that it stands on.

    Attributes
    ----------
    open : (n_z, n_y, n_x) bool array
        Cells a plate high with no brick in them or anywhere below.
    free : (n_z, n_y, n_x) bool array
        Cells without a brick that the outer air reaches.
    filled : (n_z, n_y, n_x) bool array
        Cells of bricks.
    low : (3,) int32 array
        Cell of the grid (x, y, z) that is ``open[0, 0, 0]``.
    """

    open: Mask
    free: Mask
    filled: Mask
    low: np.ndarray

    def layer(self, number: int) -> Mask:
        """Return the columns in which a brick of a layer has room, (n_y, n_x); layers are counted from the ground."""
        top = min(PLATES_PER_BRICK * number + PLATES_PER_BRICK, len(self.open)) - 1
        columns: Mask = self.open[top]
        return columns


def clearance_around(graph: ContactGraph) -> Clearance:
    """Find the cells in which supports may stand.

    Parameters
    ----------
    graph : ContactGraph
        Cells of the model, whose lowest plate is the ground.

    Returns
    -------
    Clearance
    """
    occupied = graph.owner != NOBODY
    ground = int(np.flatnonzero(occupied.any(axis=(1, 2)))[0])
    wide = ((0, 0), (MARGIN, MARGIN), (MARGIN, MARGIN))
    occupied = np.pad(occupied[ground:], wide)
    above = np.logical_or.accumulate(occupied, axis=0)
    # one more plate on top lets the air pass over the model
    outside, _ = ndimage.label(~np.pad(occupied, ((0, 1), (0, 0), (0, 0))))
    low = graph.low + np.array([-MARGIN, -MARGIN, ground], dtype=np.int32)
    return Clearance(~above, (outside == outside[-1, 0, 0])[:-1], occupied, low)
