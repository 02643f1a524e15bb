"""Where supports may stand: over the ground, with nothing of the model below them.

A support that stands in such a place can be pulled straight down and out when
the finished model is lifted from the table, whatever its shape.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..arrays import Mask
from ..model import NOBODY, ContactGraph
from ..units import PLATES_PER_BRICK

MARGIN: Final = 3
"""Studs around the model that supports may use as well: their feet are wider than what they carry."""


_ALONG_Y: Final = (..., slice(None, -1), slice(None)), (..., slice(1, None), slice(None))

Kinds = NDArray[np.uint8]


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


def clearance_around(graph: ContactGraph, kinds: Kinds | None = None) -> Clearance:
    """Find the cells in which supports may stand.

    Parameters
    ----------
    graph : ContactGraph
        Cells of the model, whose lowest plate is the ground.
    kinds : (n_layers, n_y, n_x) uint8 array, optional
        The half studs of the cells of its grid, in layers of bricks: supports that carry what has some, and lie so
        themselves, keep a column off all that has others.

    Returns
    -------
    Clearance
    """
    occupied = graph.owner != NOBODY
    ground = int(np.flatnonzero(occupied.any(axis=(1, 2)))[0])
    wide = ((0, 0), (MARGIN, MARGIN), (MARGIN, MARGIN))
    occupied = np.pad(occupied[ground:], wide)
    low = graph.low + np.array([-MARGIN, -MARGIN, ground], dtype=np.int32)
    closed = occupied if kinds is None else occupied | _between(occupied, kinds, low)
    above = np.logical_or.accumulate(closed, axis=0)
    # one more plate on top lets the air pass over the model
    outside, _ = ndimage.label(~np.pad(occupied, ((0, 1), (0, 0), (0, 0))))
    return Clearance(~above, (outside == outside[-1, 0, 0])[:-1], occupied, low)


def _between(occupied: Mask, kinds: Kinds, low: np.ndarray) -> Mask:
    """Return the cells beside which there is one of another kind: that of its brick, or else of the first one above."""
    size = occupied.shape
    z, y, x = (
        np.clip(np.arange(size[axis]) + low[2 - axis], 0, last - 1)
        for axis, last in enumerate((PLATES_PER_BRICK * len(kinds), *kinds.shape[1:]))
    )
    own = kinds[np.ix_(z // PLATES_PER_BRICK, y, x)]
    number = np.where(occupied, np.arange(size[0])[:, None, None], size[0])
    first = np.minimum.accumulate(number[::-1], axis=0)[::-1]
    known = first < size[0]
    kind = np.take_along_axis(own, np.minimum(first, size[0] - 1), axis=0)
    for here, there in zip(kind, known, strict=True):
        if there.any():
            # what carries nothing may widen what does
            at = ndimage.distance_transform_edt(~there, return_distances=False, return_indices=True)
            here[:] = here[tuple(at)]
    beside = np.zeros(size, bool)
    for one, other in (((..., slice(None, -1)), (..., slice(1, None))), _ALONG_Y):
        differs = kind[one] != kind[other]
        beside[one] |= differs
        beside[other] |= differs
    return beside
