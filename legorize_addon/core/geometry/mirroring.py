"""The plane in the middle of a grid that its cells are mirrored in."""

from __future__ import annotations

from typing import Final

import numpy as np

from ..arrays import Mask

SYMMETRIC: Final = 0.95
"""Share of the cells that have an image from which on a body counts as symmetric."""


def mirror_axis(cells: Mask) -> int | None:
    """Find the axis along which cells are mirrored in the middle of their grid.

    Parameters
    ----------
    cells : (n_z, n_y, n_x) bool array

    Returns
    -------
    int or None
        2 for x or 1 for y, that along which more cells have an image; None if
        fewer than :data:`SYMMETRIC` of them have one, or there are none.
    """
    shares = {axis: mirrored_share(cells, axis) for axis in (2, 1)}
    best = max(shares, key=lambda axis: shares[axis])
    return best if shares[best] >= SYMMETRIC else None


def mirrored_share(cells: Mask, axis: int) -> float:
    """Return the share of cells, (n_z, n_y, n_x) bool, that have an image in the middle of an axis, 0 to 1."""
    image = np.flip(cells, axis)
    either = np.count_nonzero(cells | image)
    return np.count_nonzero(cells & image) / either if either else 0.0
